"""Drawings whose layouts differ by rounding are the same drawing.

Matplotlib names clip paths by a hash of unrounded coordinates: such names alone made one run's drawing another's.
"""

from io import StringIO

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
