"""The five rules by which a recomputed artefact is held against the committed one.

Each family pairs a text that a rule lets pass with a twin just beyond it: a rule that lets everything pass, or
nothing, fails one of the two. A departure without place and excess could not be acted on.
"""

import pytest

from rkverify.workflow.compare import Certified, Exact, Numeric, Record, Visual

WHY = "made up"
RECORD = '{"says": "at least 1.000 of it", "margin": 2.0, "list": [1, 3.0]}'

# rule, committed, within the rule, beyond the rule, place of the departure, part of the excess
FAMILY = {
    "exact": (Exact(), "x\n1\n", "x\n1\n", "x\n2\n", "line 2", "byte for byte"),
    "exact, a line less": (Exact(), "x\n1\n", "x\n1\n", "x\n", "line 2", "byte for byte"),
    "exact, line ends": (Exact(), "x\n1\n", "x\n1\n", "x\n1", "line ends", "byte for byte"),
    "certified": (Certified(), "x\n0.33333\n", "x\n0.33334\n", "x\n0.33335\n", "row 1, column x", "2 units"),
    "certified, shorter": (Certified(), "x\n0.333333\n", "x\n0.334\n", "x\n0.335\n", "row 1, column x", "1.67 units"),
    "certified, zero": (Certified(), "x\n0e-33\n", "x\n1e-12\n", "x\n3e-12\n", "row 1, column x", "apart by 3"),
    "certified, text": (Certified(), "n,x\na,1\n", "n,x\na,1\n", "n,x\nb,1\n", "row 1, column n", "same text"),
    "relative": (Numeric(1e-6, 0, WHY), "x\n1000\n", "x\n1000.0005\n", "x\n1000.002\n", "row 1, column x", "allowed 0.001"),
    "absolute": (Numeric(0, 1e-3, WHY), "x,y\n1,0\n", "x,y\n1,9e-4\n", "x,y\n1,-2e-3\n", "row 1, column y", "apart by 0.002"),
    "numeric, text": (Numeric(1, 1, WHY), "x\nyes\n", "x\nyes\n", "x\nno\n", "row 1, column x", "same text"),
    "visual": (Visual(0.05, WHY), '<path d="M 1 2"/>', '<path d="M 1 2.04"/>', '<path d="M 1 2.06"/>', "number 1", "apart by 0.06"),
    "visual, a point more": (
        Visual(0.05, WHY), '<path d="M 1 2 L 3 4"/>', '<path d="M 1 2 L 2 2.5 L 3 4"/>', '<path d="M 1 2 L 2 2.5 L 3 4.1"/>',
        "number 3", "apart by 0.1",
    ),
    "visual, words": (Visual(0.05, WHY), "<text>a</text>", "<text>a</text>", "<text>b</text>", "structure", "words"),
    "visual, colour": (Visual(0.05, WHY), 'fill="#009E73"', 'fill="#009E73"', 'fill="#009E74"', "number 0", "allowed 0.05"),
    "record, margin": (Record(1e-3, WHY), RECORD, RECORD.replace("2.0", "2.001"), RECORD.replace("2.0", "2.01"), "margin", "apart by"),
    "record, sentence": (Record(1e-3, WHY), RECORD, RECORD.replace("1.000", "1.0005"), RECORD.replace("1.000", "1.01"), "says", "apart by"),
    "record, list": (Record(1e-3, WHY), RECORD, RECORD.replace("3.0", "3.001"), RECORD.replace("3.0", "3.1"), "list[1]", "apart by"),
    "record, count": (Record(1e-3, WHY), '{"n": 1000}', '{"n": 1000}', '{"n": 1001}', "n", ""),
    "record, word": (Record(1e-3, WHY), RECORD, RECORD, RECORD.replace("least", "most"), "says", ""),
    "record, verdict": (Record(1e-3, WHY), '{"holds": true}', '{"holds": true}', '{"holds": false}', "holds", ""),
    "record, undecided": (Record(1e-3, WHY), '{"holds": true}', '{"holds": true}', '{"holds": null}', "holds", ""),
}  # fmt: skip


@pytest.mark.parametrize("case", FAMILY)
def test_within_passes(case):
    rule, committed, within, *_ = FAMILY[case]
    assert rule.differences(committed, within) == []


@pytest.mark.parametrize("case", FAMILY)
def test_beyond_is_told_with_its_place(case):
    rule, committed, _, beyond, place, _ = FAMILY[case]
    assert [d.place for d in rule.differences(committed, beyond)] == [place]


@pytest.mark.parametrize("case", FAMILY)
def test_beyond_is_told_by_how_much(case):
    rule, committed, _, beyond, _, excess = FAMILY[case]
    (difference,) = rule.differences(committed, beyond)
    assert excess in difference.excess
    assert str(difference).endswith(f"({difference.excess})")


@pytest.mark.parametrize("case", [c for c in FAMILY if not isinstance(FAMILY[c][0], Numeric)])
def test_the_order_of_the_two_does_not_matter(case):
    """A departure that depended on which text was committed first would vanish at the next commit."""
    rule, committed, within, beyond, *_ = FAMILY[case]
    assert rule.differences(within, committed) == []
    assert len(rule.differences(beyond, committed)) == 1


def test_every_cell_that_departs_is_told():
    found = Certified().differences("n,x,y\n1,1.0,1.0\n2,1.0,1.0\n", "n,x,y\n1,2.0,1.0\n2,1.0,3.0\n")
    assert [d.place for d in found] == ["row 1, column x", "row 2, column y"]


SHAPES = {
    "row more": "x,y\n1,2\n3,4\n5,6\n",
    "row less": "x,y\n1,2\n",
    "column more": "x,y,z\n1,2,0\n3,4,0\n",
    "column less": "x\n1\n3\n",
    "cell less": "x,y\n1,2\n3\n",
    "columns exchanged": "y,x\n1,2\n3,4\n",
    "renamed": "x,t\n1,2\n3,4\n",
    "empty": "",
}


@pytest.mark.parametrize("rule", [Certified(), Numeric(1, 1e9, WHY)], ids=lambda rule: rule.kind)
@pytest.mark.parametrize("shape", SHAPES)
def test_another_shape_never_passes(rule, shape):
    """However wide a tolerance is, it is one for numbers: a table with other cells is another table."""
    (difference,) = rule.differences("x,y\n1,2\n3,4\n", SHAPES[shape])
    assert difference.place == "shape or header"


@pytest.mark.parametrize("shape", SHAPES)
def test_another_shape_is_told_by_what_is_not_the_same(shape):
    (difference,) = Certified().differences("x,y\n1,2\n3,4\n", SHAPES[shape])
    assert difference.committed != difference.recomputed


@pytest.mark.parametrize(
    "other", ['{"a": 1.0}', '{"a": 1.0, "c": 2.0}', "[1.0, 2.0]", '{"a": 1.0, "b": [2.0]}', "null"]
)
def test_a_record_of_another_shape_never_passes(other):
    assert Record(1e9, WHY).differences('{"a": 1.0, "b": 2.0}', other)


def test_a_drawing_with_another_element_never_passes():
    assert Visual(1e9, WHY).differences('<g><path d="M 1"/></g>', '<g><path d="M 1"/><path d="M 1"/></g>')


@pytest.mark.parametrize("rule", [Exact(), Certified(), Numeric(1, 2, WHY), Visual(3, WHY), Record(4, WHY)])
def test_the_manifest_holds_the_rule(rule):
    """A reader of the results must see under which rule they were confirmed, and why a tolerance was taken."""
    record = rule.record()
    assert record["kind"] == type(rule).__name__.lower()
    assert ("why" in record) == hasattr(rule, "why")
