"""Frames with a line for each curve, or row of a map, in place of one for each of its points."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

QUANTITY = "quantity"
"""The column that says which of several columns a line holds."""


def spread(frame: "pd.DataFrame", across: str) -> "pd.DataFrame":
    """The frame with the values of the column `across` as heads: a line for each combination of the columns before it.

    Where several columns come after it, each has lines of its own; a line without any value is left out. Raises ValueError
    where two rows are for the same place.

    >>> import pandas as pd
    >>> rows = pd.DataFrame({"R": ["3/2", "3/2", "2", "2"], "kh": [0.0, 0.5, 0.0, 0.5], "D": [0.0, 0.25, 0.0, 0.75]})
    >>> print(spread(rows, "kh").to_csv(index=False), end="")
    R,kh = 0,kh = 0.5
    3/2,0.0,0.25
    2,0.0,0.75
    """
    import pandas as pd

    names = list(frame.columns)
    at = names.index(across)
    keys, values = names[:at], names[at + 1 :]
    several = len(values) > 1
    heads: dict[str, None] = {}
    lines: dict[tuple[Any, ...], dict[str, Any]] = {}
    for *key, place, rest in zip(*(frame[name] for name in names[: at + 1]), zip(*(frame[name] for name in values))):
        head = f"{across} = {f'{place:.12g}' if isinstance(place, float) else place}"
        heads.setdefault(head)
        for name, value in zip(values, rest, strict=True):
            line = lines.setdefault((*key, *([name] if several else [])), {})
            if head in line:
                raise ValueError(f"two rows of the table are for {', '.join(map(str, key))}, {head}")
            line[head] = value
    titles = [*keys, *([QUANTITY] if several else [])]
    found = [
        dict(zip(titles, key, strict=True)) | line
        for key, line in lines.items()
        if not all(map(pd.isna, line.values()))
    ]
    return pd.DataFrame(found, columns=[*titles, *heads])
