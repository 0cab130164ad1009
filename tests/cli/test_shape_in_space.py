"""`rkverify shape` in two and three dimensions: columns, sums and reproduction, and the same numbers in every arithmetic."""

import json
from fractions import Fraction
from itertools import groupby, product

import pytest

GRID = [
    (Fraction(i) + Fraction((3 * i + j) % 5, 20), Fraction(j) - Fraction((i + 2 * j) % 4, 20))
    for i in range(5)
    for j in range(4)
]
CUBE = [
    (i + Fraction((j + k) % 3, 10), Fraction(j), k + Fraction((i * j) % 4, 10))
    for i, j, k in product(range(4), repeat=3)
]
POINTS = {
    2: [(Fraction(3, 2), Fraction(4, 3)), (Fraction(2), Fraction(1))],
    3: [(Fraction(3, 2), Fraction(4, 3), Fraction(7, 5))],
}
NODES = {2: GRID, 3: CUBE}
SUPPORT = {0: "2", 1: "2", 2: "3"}


def text(places):
    axes = "xyz"[: len(places[0])]
    return "\n".join([",".join(axes), *(",".join(map(str, place)) for place in places)]) + "\n"


@pytest.fixture
def shape(rkverify, table):
    def call(*words, d=2, nodes=None, points=None, support="2"):
        files = [
            "--nodes",
            table("nodes", nodes or text(NODES[d])),
            "--points",
            table("points", points or text(POINTS[d])),
        ]
        return rkverify("shape", *files, *(["--support", support] if support else []), *words)

    return call


@pytest.mark.parametrize(
    ("d", "header"), [(2, "point,node,psi,dpsi_dx,dpsi_dy"), (3, "point,node,psi,dpsi_dx,dpsi_dy,dpsi_dz")]
)
def test_columns_and_ids(d, header, shape):
    done = shape(d=d)
    assert (done.status, done.err, done.header) == (0, "", header)
    pairs = [(int(row["point"]), int(row["node"])) for row in done.rows]
    assert pairs == sorted(set(pairs))
    assert {point for point, _ in pairs} == set(range(len(POINTS[d])))


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("d", [2, 3])
def test_exact_values_reproduce_in_space(d, order, shape):
    """With the tensor window every number is rational: each monomial up to the order and its slope come out to the last digit."""
    done = shape("--arithmetic", "exact", "--window", "tensor", "--order", order, d=d, support=SUPPORT[order])
    assert (done.status, done.err) == (0, "")
    for point, rows in groupby(done.rows, key=lambda row: int(row["point"])):
        x = POINTS[d][point]
        values = [(NODES[d][int(r["node"])], [Fraction(c) for c in list(r.values())[2:]]) for r in rows]
        for powers in (p for p in product(range(order + 1), repeat=d) if sum(p) <= order):
            at = [monomial(X, powers) for X, _ in values]
            assert sum(m * v[0] for m, (_, v) in zip(at, values, strict=True)) == monomial(x, powers)
            for axis in range(d):
                lower = [p - (j == axis) for j, p in enumerate(powers)]
                slope = powers[axis] * monomial(x, lower) if powers[axis] else 0
                assert sum(m * v[1 + axis] for m, (_, v) in zip(at, values, strict=True)) == slope


def monomial(x, powers):
    result = Fraction(1)
    for c, p in zip(x, powers, strict=True):
        result *= c**p
    return result


@pytest.mark.parametrize("window", ["radial", "tensor"])
@pytest.mark.parametrize("reading", ["full", "diffuse", "frozen-b", "frozen"])
@pytest.mark.parametrize("d", [2, 3])
def test_float_and_many_digits_agree(d, reading, window, shape):
    """Double precision goes the fast route and 30 digits the literal one: what both print is no slip of either."""
    words = ["--derivative", reading, "--window", window]
    fast, literal = shape(*words, d=d), shape(*words, "--arithmetic", "mp:30", d=d)
    assert [(r["point"], r["node"]) for r in fast.rows] == [(r["point"], r["node"]) for r in literal.rows]
    for one, other in zip(fast.rows, literal.rows, strict=True):
        for column in list(one)[2:]:
            # Sums of some tens of products, a moment matrix with a condition number below a hundred, gradients of size 1.
            assert float(one[column]) == pytest.approx(float(other[column]), rel=0, abs=100 * 50 * 2.0**-52)


def test_a_node_at_the_end_of_its_support_is_left_out(shape):
    """At distance A to the last digit there is neither a zero nor a 1e-17, where squares are exact."""
    nodes = text([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (Fraction(5, 2), 0), (Fraction(3, 2), -2)])
    for name in ("float", "mp:20"):
        rows = shape("--arithmetic", name, nodes=nodes, points="x,y\n0,0\n", support="5/2").rows
        assert [int(row["node"]) for row in rows] == [0, 1, 2, 3, 4], name


def test_the_window_changes_the_numbers(shape):
    assert shape().out != shape("--window", "tensor").out


def test_in_one_dimension_the_windows_are_one(shape):
    nodes, points = "x\n0\n1\n2\n", "x\n1.25\n"
    one, other = (shape("--window", w, nodes=nodes, points=points).out for w in ("radial", "tensor"))
    assert one == other


def test_a_column_a_gives_each_node_its_own_support(shape):
    own = text(GRID).replace("x,y", "x,y,a").replace("\n", ",2\n").replace("a,2", "a")
    assert shape(nodes=own, support=None).out == shape().out
    wider = own.replace(",2\n", ",5/2\n", 3)
    assert shape(nodes=wider, support=None).out != shape().out


def test_json_and_out_hold_the_same_rows(shape, tmp_path):
    rows = json.loads(shape("--json").out)
    assert [{key: str(value) for key, value in row.items()} for row in rows] == shape().rows
    done = shape("--out", tmp_path / "new" / "table.csv")
    assert (done.status, done.out) == (0, "")
    assert (tmp_path / "new" / "table.csv").read_text(encoding="utf-8") == shape().out


def test_printed_doubles_lose_no_digit(shape):
    text = [[float(value) for value in row.values()] for row in shape(d=3).rows]
    assert text == [list(row.values()) for row in json.loads(shape("--json", d=3).out)]


COLLINEAR = text([(i, i) for i in range(5)])
REFUSED = {
    "collinear nodes": ({"nodes": COLLINEAR, "points": "x,y\n2,2\n"}, ["point 0", "(2"]),
    "too few nodes": ({"points": "x,y\n1,1\n-1.5,0\n"}, ["point 1", "-1.5", "order 1 needs 3"]),
    "gap": ({"points": "x,y\n1,1\n2,2\n99,0\n"}, ["point 2", "99"]),
    "coincident nodes": ({"nodes": text([*GRID, GRID[3]])}, ["nodes 3 and 20"]),
    "nan": ({"nodes": "x,y\n0,0\n1,nan\n"}, ["row 1", "column y", "'nan'"]),
    "short row": ({"nodes": "x,y\n0,0\n1\n"}, ["row 1", "1 cells"]),
    "other dimension": ({"points": "x\n1\n"}, ["2 coordinates (x,y)", "1 coordinates (x)"]),
    "too large": ({"nodes": "x,y\n0,0\n1e400,0\n"}, ["row 1, x", "too large"]),
    "header": ({"nodes": "x,z\n0,0\n"}, ["'x,z'"]),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_used_is_refused_in_one_line(case, shape, tmp_path):
    given, words = REFUSED[case]
    out = tmp_path / "out.csv"
    complaint = shape("--out", out, **given).complaint()
    assert [w for w in words if w not in complaint] == [], complaint
    assert not out.exists()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--window", "square"], "'square'"),
        (["--order", "3"], "order 3"),
        (["--derivative", "half"], "'half'"),
        (["--order", "0", "--derivative", "diffuse"], "order"),
        (["--kernel", "cubique"], "'cubique'"),
        (["--arithmetic", "exact"], "--window tensor"),
    ],
)
def test_options_that_do_not_exist(words, told, shape):
    assert told in shape(*words).complaint()
