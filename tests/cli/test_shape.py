"""`rkverify shape`: the values that other people hold their own codes against, so that columns and digits are a promise."""

import json
from decimal import Decimal
from fractions import Fraction
from itertools import groupby

import pytest

NODES = "x\n0\n1/3\n1\n1.6\n2\n2.75\n"
OWN = "x,a\n0,2\n1/3,1.8\n1,2\n1.6,5/2\n2,2\n2.75,2\n"
POINTS = "x\n0.25\n1\n5/4\n2\n"


@pytest.fixture
def shape(rkverify, table):
    """shape("--order", 1, nodes=…, points=…) -> Done."""

    def call(*words, nodes=NODES, points=POINTS, support=2):
        given = ["--support", support] if support else []
        return rkverify("shape", "--nodes", table("nodes", nodes), "--points", table("points", points), *given, *words)

    return call


def test_columns_and_ids(shape):
    done = shape()
    assert (done.status, done.err, done.header) == (0, "", "point,node,psi,dpsi_dx")
    pairs = [(int(row["point"]), int(row["node"])) for row in done.rows]
    assert pairs == sorted(set(pairs))
    assert {point for point, _ in pairs} == {0, 1, 2, 3}


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("nodes", [NODES, OWN])
def test_exact_values_sum_to_one_and_reproduce(order, nodes, shape):
    """Printed p/q, not a rounded decimal: the sums are equal to the last digit, or the print is wrong."""
    done = shape("--arithmetic", "exact", "--order", order, nodes=nodes)
    assert all("." not in row["psi"] + row["dpsi_dx"] for row in done.rows)
    places = [Fraction(line.split(",")[0]) for line in nodes.split()[1:]]
    points = [Fraction(x) for x in POINTS.split()[1:]]
    for point, rows in groupby(done.rows, key=lambda row: int(row["point"])):
        values = [(places[int(r["node"])], Fraction(r["psi"]), Fraction(r["dpsi_dx"])) for r in rows]
        for power in range(order + 1):
            x = points[point]
            slope = power * x ** (power - 1) if power else 0
            assert sum(psi * X**power for X, psi, _ in values) == x**power
            assert sum(dpsi * X**power for X, _, dpsi in values) == slope


def test_nodes_without_influence_are_left_out(shape):
    """At x = 1 with support 1 the nodes at 0 and 2 end exactly: neither zeros nor 1e-17 may be listed."""
    for name in ("exact", "float", "mp:30"):
        rows = shape("--arithmetic", name, nodes="x\n0\n0.5\n1\n1.5\n2\n", points="x\n1\n", support=1).rows
        assert [row["node"] for row in rows] == ["1", "2", "3"], name
        assert all(float(Fraction(row["psi"])) or float(Fraction(row["dpsi_dx"])) for row in rows)


def test_mp_50_prints_50_right_digits(shape):
    exact = shape("--arithmetic", "exact").rows
    digits = shape("--arithmetic", "mp:50").rows
    assert [row["node"] for row in digits] == [row["node"] for row in exact]
    for wide, row in zip(digits, exact, strict=True):
        for column in ("psi", "dpsi_dx"):
            if Fraction(row[column]):
                printed = Decimal(wide[column])
                assert len(printed.as_tuple().digits) == 50, wide[column]
                unit = Fraction(Decimal(1).scaleb(int(printed.as_tuple().exponent)))
                assert abs(Fraction(printed) - Fraction(row[column])) <= unit


def test_float_values_are_the_exact_ones_rounded(shape):
    for row, exact in zip(shape().rows, shape("--arithmetic", "exact").rows, strict=True):
        assert float(row["psi"]) == pytest.approx(float(Fraction(exact["psi"])), rel=1e-12, abs=1e-14)


def test_float_values_lose_no_digit_in_print(shape):
    """Read back they are the same doubles, whichever way they were printed."""
    text = [(float(row["psi"]), float(row["dpsi_dx"])) for row in shape().rows]
    assert text == [(row["psi"], row["dpsi_dx"]) for row in json.loads(shape("--json").out)]


def test_a_column_a_gives_each_node_its_own_support(shape):
    """A blank cell takes the common support; without one it is missing."""
    own = shape("--arithmetic", "exact", nodes=OWN, support=None)
    assert own.status == 0
    assert own.out != shape("--arithmetic", "exact").out
    same = OWN.replace("1.8", "2").replace("5/2", "2")
    assert shape("--arithmetic", "exact", nodes=same, support=None).out == shape("--arithmetic", "exact").out
    blank = OWN.replace(",2\n", ",\n")
    assert shape("--arithmetic", "exact", nodes=blank).out == own.out
    assert "node 0" in shape(nodes=blank, support=None).complaint()


def test_numbers_mean_the_same_however_they_are_written(shape):
    """0.1 is one tenth, not the double next to it."""
    one = shape("--arithmetic", "exact", nodes="x\n0\n0.1\n0.2\n", points="x\n0.15\n", support="0.25")
    other = shape("--arithmetic", "exact", nodes="x\n0\n1/10\n2e-1\n", points="x\n 3/20 \n", support="1/4")
    assert one.out == other.out


def test_a_table_as_spreadsheets_write_it_is_read(shape):
    """Byte order mark, CRLF and empty lines."""
    assert shape(nodes="\ufeff" + NODES.replace("\n", "\r\n") + "\r\n").out == shape().out


def test_json_holds_the_same_rows(shape):
    rows = json.loads(shape("--arithmetic", "exact", "--json").out)
    assert [{key: str(value) for key, value in row.items()} for row in rows] == shape("--arithmetic", "exact").rows


@pytest.mark.parametrize("form", [[], ["--json"]])
def test_out_writes_what_would_have_been_printed(form, shape, tmp_path):
    out = tmp_path / "new folder" / "table"
    done = shape(*form, "--out", out)
    assert (done.status, done.out, done.err) == (0, "", "")
    assert out.read_text(encoding="utf-8") == shape(*form).out


@pytest.mark.parametrize("reading", ["full", "diffuse", "frozen-b", "frozen"])
def test_readings_change_the_derivative_and_nothing_else(reading, shape):
    full, other = shape().rows, shape("--derivative", reading).rows
    assert [row["psi"] for row in other] == [row["psi"] for row in full]
    assert ([row["dpsi_dx"] for row in other] == [row["dpsi_dx"] for row in full]) == (reading == "full")
