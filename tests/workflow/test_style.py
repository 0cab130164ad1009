"""Drawings whose layouts differ by rounding are the same drawing.

Matplotlib names clip paths by a hash of unrounded coordinates: such names alone made one run's drawing another's. And a drawing
that is made smaller must still be the drawing: the same elements in the same places, to a hundredth of a point.
"""

import re
from io import StringIO
from xml.etree import ElementTree

import numpy as np

from rkverify.workflow.compare import Visual
from rkverify.workflow.style import HASHED, new_figure, svg


def drawn(shift: float, *, named: bool = True) -> str:
    figure = new_figure(3, 2)
    figure.set_layout_engine("none")
    axes = figure.add_axes((0.2 + shift, 0.2, 0.7, 0.7))
    axes.plot([0, 1], [0, 2], marker="o")
    if named:
        return svg(figure, "a title", "an alternative text")
    stream = StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def test_rounding_of_the_layout_changes_no_name() -> None:
    same = Visual(0.05, "points")
    assert same.differences(drawn(0.0), drawn(1e-12)) == []
    assert same.differences(drawn(0.0, named=False), drawn(1e-12, named=False))  # the names that were
    assert not HASHED.search(drawn(0.0))


def test_every_name_that_is_used_is_defined_once() -> None:
    text = drawn(0.0)
    assert text.count('id="p0"') == 1
    assert "url(#p0)" in text
    used = set(re.findall(r'href="#([^"]+)"|url\(#([^)]+)\)', text))
    for name in {one or other for one, other in used}:
        assert text.count(f'id="{name}"') == 1, name


def elements(text: str) -> list[tuple[str, str, str, list[float]]]:
    """What a drawing has beside its words, in order: element, style, kinds of strokes, and all places."""
    found = []
    styles = dict(re.findall(r"\.(s\d+)\{([^}]*)\}", text))
    for element in ElementTree.fromstring(text).iter():
        kind, given = element.tag.rpartition("}")[2], element.attrib
        if kind in ("title", "desc", "metadata") or "purl" in element.tag or "creativecommons" in element.tag:
            continue
        # A letter is placed by x alone or by a translation: the same.
        letter = re.fullmatch(r"translate\((\S+) 0\)", given.get("transform", "")) if kind == "use" else None
        places = [letter[1] if letter else given.get("x", ""), given.get("y", ""), given.get("d", "")]
        places.append("" if letter else given.get("transform", ""))
        numbers = [float(n) for place in places for n in re.findall(r"-?\d+\.?\d*", place)]
        found.append(
            (
                kind,
                given.get("style") or styles.get(given.get("class", ""), ""),
                "".join(re.findall("[A-Za-z]", given.get("d", ""))),
                numbers,
            )
        )
    return [one for one in found if one[0] not in ("RDF", "Work")]


def test_no_place_moves_by_more_than_half_a_hundredth_of_a_point() -> None:
    ours, theirs = elements(drawn(1 / 7)), elements(drawn(1 / 7, named=False))
    assert [one[:3] for one in ours] == [one[:3] for one in theirs]
    numbers, exact = (np.concatenate([one[3] for one in part]) for part in (ours, theirs))
    assert abs(numbers - exact).max() <= 0.005 + 1e-9
    assert abs(numbers - exact).max() > 0.003  # and digits have gone
    assert len(drawn(1 / 7)) < 0.8 * len(drawn(1 / 7, named=False))
