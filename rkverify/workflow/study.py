"""What a study is: parameters, tables with units, figures with alternative text, statements with margins."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import ceil, log10
from typing import TYPE_CHECKING, Any

from rkverify.workflow.compare import Certified, Comparison
from rkverify.workflow.spread import QUANTITY, spread

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

LAYERS = ("printed", "as-defined", "consistent", "simulated")


@dataclass(frozen=True)
class Column:
    """A column's name, its unit ('1' for a pure number, '' for text) and what it holds."""

    name: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Table:
    """A named table: columns with units over a frame, what it shows, and how reruns are compared.

    across: a column whose values head the columns of the file, which then has a line for each combination of the
    columns before it, and for each column after it where there are several: a curve or a row of a map in one line.
    """

    columns: tuple[Column, ...]
    frame: "pd.DataFrame"
    caption: str
    comparison: Comparison = field(default_factory=Certified)
    across: str = ""

    def __post_init__(self) -> None:
        """Raises ValueError where the frame does not have the columns that are described."""
        described = [column.name for column in self.columns]
        if list(self.frame.columns) != described:
            raise ValueError(f"the table describes the columns {described} and has {list(self.frame.columns)}")

    def text(self) -> str:
        """The table as CSV."""
        frame = spread(self.frame, self.across) if self.across else self.frame
        return str(frame.to_csv(index=False, lineterminator="\n", float_format="%.12g"))

    @property
    def columns_of_file(self) -> list[Column]:
        """The columns of the file; those that `across` heads, such as 'kh = 0', are described in one."""
        if not self.across:
            return list(self.columns)
        at = [column.name for column in self.columns].index(self.across)
        head, values = self.columns[at], self.columns[at + 1 :]
        where = f"at this {head.name} ({head.unit}), {head.meaning}"
        if len(values) == 1:
            return [*self.columns[:at], Column(f"{head.name} = …", values[0].unit, f"{values[0].meaning}, {where}")]
        told = "; ".join(f"{v.name} ({v.unit}): {v.meaning}" for v in values)
        return [
            *self.columns[:at],
            Column(QUANTITY, "", f"what the line holds. {told}"),
            Column(f"{head.name} = …", "", f"the quantity, in its own unit, {where}"),
        ]


def table(
    rows: Sequence[Mapping[str, Any]],
    columns: Sequence[tuple[str, str, str]],
    caption: str,
    comparison: Comparison,
    across: str = "",
) -> Table:
    """A table from rows (dicts) and its columns as (name, unit, meaning); across: see `Table`."""
    import pandas as pd

    described = tuple(Column(*column) for column in columns)
    frame = pd.DataFrame(list(rows), columns=[c.name for c in described])
    return Table(described, frame, caption, comparison, across)


def rounding(size: float) -> str:
    """A difference that is rounding alone, as the power of ten that it stays below by a factor of ten or more.

    The digits of rounding are another machine's others, and have no place in a sentence.

    >>> rounding(2.7e-15), rounding(0.0)
    ('1e-13', '1e-15')
    """
    return f"1e{max(ceil(log10(size)) + 1, -15) if size > 0 else -15}"


@dataclass(frozen=True)
class Drawing:
    """A figure with its caption (every parameter, and which are ours) and its alternative text (the finding)."""

    figure: "Figure"
    caption: str
    alternative: str


@dataclass(frozen=True)
class Statement:
    """What a study found on entries of the ledger.

    name: unique in the study. about: ids such as E75, F5, C40. says: the finding, values filled in. holds: true,
    false, or None where it cannot be decided. margin: how far from turning over, a number with its meaning. layer
    and reading: under which it was tried. routes: the independent routes that agree, where the entry is a
    definition. tried: the range. evidence: 'proved', 'enclosed', 'exact' or 'sampled'.
    """

    name: str
    about: tuple[str, ...]
    says: str
    holds: bool | None
    tried: str
    evidence: str
    margin: float | None = None
    margin_means: str = ""
    layer: str = ""
    reading: str = ""
    routes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Raises ValueError for a layer or an evidence grade that does not exist."""
        if self.layer and self.layer not in LAYERS:
            raise ValueError(f"layer {self.layer!r} is none of {LAYERS}")
        if self.evidence not in ("proved", "enclosed", "exact", "sampled"):
            raise ValueError(f"evidence {self.evidence!r} is not a grade")


Tables = Mapping[str, Table]


@dataclass(frozen=True)
class Study:
    """A study: `compute` gives tables, `draw` figures, `judge` statements; `quick` are parameters for a smoke run.

    code: names of the functions of the library that the study shows, for links from the report. documents: texts
    beside the tables, such as proof logs, that come out the same byte for byte: file name -> text.
    """

    title: str
    parameters: Any
    quick: Any
    compute: Callable[[Any], Tables]
    judge: Callable[[Any, Tables], Sequence[Statement]]
    draw: Callable[[Any, Tables], Mapping[str, Drawing]] = lambda parameters, tables: {}
    documents: Callable[[Any, Tables], Mapping[str, str]] = lambda parameters, tables: {}
