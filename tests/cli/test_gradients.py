"""`rkverify gradients`: operators that others hold their own against, so that pairs, sums and rules are a promise."""

import json
import re
from collections import defaultdict

import pytest

NODES = [(0.1, 0.2), (0.5, 0.1), (0.95, 0.2), (0.2, 0.6), (0.55, 0.5), (0.9, 0.6), (0.1, 0.9), (0.45, 1.0), (1.0, 0.95)]
BOX = ("--box", "0,0,1,1")
# Sums of some tens of products of shape functions, of gradients of some 10 per unit of length; condition numbers below 100.
ROUNDING = 100 * 10 * 30 * 2.0**-52


def text(places):
    return "\n".join(["x,y,z"[: 2 * len(places[0]) - 1], *(",".join(map(repr, p)) for p in places)]) + "\n"


@pytest.fixture
def gradients(rkverify, table):
    """gradients("--integration", "dni", nodes=…, cells=…, domain=…) -> Done."""

    def call(*words, nodes=NODES, support="1", **files):
        given = [w for name, content in files.items() for w in (f"--{name}", table(name, content))]
        nodes = nodes if isinstance(nodes, str) else text(nodes)
        given += ["--support", support] if support else []
        return rkverify("gradients", "--nodes", table("nodes", nodes), *given, *words)

    return call


@pytest.fixture
def polygons(rkverify, table):
    """The cells of NODES in the unit square, as `rkverify cells` prints them."""
    return rkverify("cells", "--nodes", table("nodes", text(NODES)), *BOX).out


def sums(done, nodes):
    """cell -> (sum of b, sum of b x as rows of j)."""
    found = defaultdict(lambda: [[0.0] * len(nodes[0]) for _ in range(1 + len(nodes[0]))])
    for row in done.rows:
        b = [float(value) for name, value in row.items() if name.startswith("b")]
        for j, factor in enumerate([1.0, *nodes[int(row["node"])]]):
            for i, part in enumerate(b):
                found[int(row["cell"])][j][i] += factor * part
    return found


WAYS = [
    ("scni",),
    ("scni", "--edge-rule", "midpoint"),
    ("scni", "--edge-rule", "gauss:3"),
    ("snni",),
    ("snni", "--edge-rule", "trapezoid"),
    ("dni",),
    ("scni", "--order", "2"),
    ("scni", "--window", "tensor"),
    ("scni", "--kernel", "quintic"),
]


@pytest.mark.parametrize("way", WAYS, ids=" ".join)
def test_columns_ids_and_linear_sums(way, gradients):
    """sum_I b_iI = 0 and sum_I b_iI x_jI = delta_ij are what the patch test needs; order 0, below, does not have them."""
    done = gradients("--integration", *way, *BOX)
    assert (done.status, done.err, done.header) == (0, "", "cell,node,bx,by")
    pairs = [(int(row["cell"]), int(row["node"])) for row in done.rows]
    assert pairs == sorted(set(pairs))
    assert {cell for cell, _ in pairs} == set(range(len(NODES)))
    assert all(float(row["bx"]) or float(row["by"]) for row in done.rows)
    for rows in sums(done, NODES).values():
        for row, wanted in zip(rows, [(0, 0), (1, 0), (0, 1)], strict=True):
            assert row == pytest.approx(wanted, rel=0, abs=ROUNDING)


def test_order_zero_has_no_linear_sums(gradients):
    done = gradients("--integration", "scni", "--order", "0", *BOX)
    assert max(abs(rows[1][0] - 1) for rows in sums(done, NODES).values()) > 0.1


@pytest.mark.parametrize("integration", ["scni", "snni", "dni"])
@pytest.mark.parametrize(
    ("nodes", "box", "header"),
    [
        ([(0.0,), (0.4,), (1.1,), (1.5,)], "0,2", "cell,node,bx"),
        (
            [(x + 0.1 * y, y + 0.1 * z, z) for x in (0.2, 1.1, 2.0) for y in (0.3, 1.2, 2.0) for z in (0.5, 1.0, 2.2)],
            "0,0,0,3,3,3",
            "cell,node,bx,by,bz",
        ),
    ],
)
def test_in_one_and_three_dimensions(nodes, box, header, integration, gradients):
    done = gradients("--integration", integration, "--box", box, nodes=nodes, support="3")
    assert (done.status, done.err, done.header) == (0, "", header)
    for rows in sums(done, nodes).values():
        for j, row in enumerate(rows):
            assert row == pytest.approx([float(j == i + 1) for i in range(len(row))], rel=0, abs=ROUNDING)


def test_default_rules_are_the_trapezoid_and_the_midpoint(gradients):
    """Rules differ, so that the default is part of the promise."""
    for integration, rule in (("scni", "trapezoid"), ("snni", "midpoint")):
        words = ["--integration", integration, *BOX]
        printed = {r: gradients(*words, "--edge-rule", r).out for r in ("trapezoid", "midpoint", "gauss:2")}
        assert len(set(printed.values())) == 3
        assert gradients(*words).out == printed[rule]


def test_given_cells_are_the_same_as_computed_ones(gradients, polygons):
    """What `cells` prints, read back: vertices are the same doubles, so that only sums in another order may differ."""
    for integration in ("scni", "snni", "dni"):
        own, given = (
            gradients("--integration", integration, *BOX),
            gradients("--integration", integration, cells=polygons),
        )
        assert (given.status, given.err) == (0, "")
        assert [(r["cell"], r["node"]) for r in given.rows] == [(r["cell"], r["node"]) for r in own.rows]
        for one, other in zip(own.rows, given.rows, strict=True):
            for column in ("bx", "by"):
                assert float(one[column]) == pytest.approx(float(other[column]), rel=0, abs=ROUNDING)


def test_given_cells_may_lack_the_ring_and_be_in_any_order(gradients, polygons):
    head, *rows = polygons.split()
    plain = "\n".join(["node,vertex,x,y", *(",".join(row.split(",")[:1] + row.split(",")[2:]) for row in rows)]) + "\n"
    shuffled = "\n".join([head, *sorted(rows, key=lambda row: row[::-1])]) + "\n"
    one = gradients("--integration", "scni", cells=polygons).out
    assert gradients("--integration", "scni", cells=plain).out == one
    assert gradients("--integration", "scni", cells=shuffled).out == one


def test_rings_in_either_direction_are_the_same_cell(gradients):
    """The outer ring of somebody's cell may run clockwise: which side is inside is no question of direction."""
    rows = ["4,0.4,0.4", "4,0.7,0.4", "4,0.5,0.7"]
    one, other = (
        "node,vertex,x,y\n" + "".join(f"4,{k},{row[2:]}\n" for k, row in enumerate(way)) for way in (rows, rows[::-1])
    )
    one, other = (sums(gradients("--integration", "scni", cells=way), NODES)[4] for way in (one, other))
    assert one[1] == pytest.approx([1, 0], rel=0, abs=ROUNDING)
    assert other[1] == pytest.approx(one[1], rel=0, abs=ROUNDING)


def test_given_cells_that_do_not_conform_are_used_as_they_are(gradients):
    """One triangle, about node 4 alone: its mean gradient, by vertex values, and nothing for the other nodes."""
    triangle = "node,vertex,x,y\n4,0,0.4,0.4\n4,1,0.7,0.4\n4,2,0.5,0.7\n"
    done = gradients("--integration", "scni", cells=triangle)
    assert {row["cell"] for row in done.rows} == {"4"}
    rows = sums(done, NODES)[4]
    assert rows[1] == pytest.approx([1, 0], rel=0, abs=ROUNDING)
    for integration in ("dni", "snni"):
        some = gradients("--integration", integration, cells=triangle)
        assert {row["cell"] for row in some.rows} == {"4"}


def test_dni_needs_no_cells_and_has_every_reading(gradients, rkverify, table):
    """b of DNI is the gradient of the shape functions at the node, in the reading asked for, digit for digit."""
    for reading in ("full", "diffuse", "frozen-b", "frozen"):
        words = ["--integration", "dni", "--derivative", reading]
        done = gradients(*words)
        assert done.out == gradients(*words, *BOX).out
        nodes = table("nodes", text(NODES))
        shape = rkverify("shape", "--nodes", nodes, "--points", nodes, "--support", "1", "--derivative", reading)
        slopes = [
            (r["point"], r["node"], r["dpsi_dx"], r["dpsi_dy"])
            for r in shape.rows
            if (r["dpsi_dx"], r["dpsi_dy"]) != ("0.0", "0.0")
        ]
        assert [tuple(row.values()) for row in done.rows] == slopes


def test_a_domain_that_is_the_box_gives_the_same(gradients):
    domain = "ring,x,y\n0,0,0\n0,1,0\n0,1,1\n0,0,1\n"
    assert gradients("--integration", "scni", domain=domain).out == gradients("--integration", "scni", *BOX).out


def test_a_column_a_gives_each_node_its_own_support(gradients):
    own = text(NODES).replace("x,y", "x,y,a").replace("\n", ",1\n").replace("a,1", "a")
    assert (
        gradients("--integration", "scni", *BOX, nodes=own, support=None).out
        == gradients("--integration", "scni", *BOX).out
    )


def test_json_and_out_hold_the_same_rows(gradients, tmp_path):
    words = ["--integration", "scni", *BOX]
    rows = json.loads(gradients(*words, "--json").out)
    assert [{key: str(value) for key, value in row.items()} for row in rows] == gradients(*words).rows
    done = gradients(*words, "--out", tmp_path / "b.csv")
    assert (done.status, done.out) == (0, "")
    assert (tmp_path / "b.csv").read_text(encoding="utf-8") == gradients(*words).out


HEAD = "node,ring,vertex,x,y\n"
CELLS = {
    "header": ("node,x,y\n0,0,0\n", ["'node,x,y'", "vertex"]),
    "no rows": (HEAD, ["no rows"]),
    "nan": (HEAD + "0,0,0,0,nan\n", ["row 0", "column y", "'nan'"]),
    "short row": (HEAD + "0,0,0,0\n", ["row 0", "4 cells"]),
    "no such node": (HEAD + "9,0,0,0,0\n", ["row 0", "node 9"]),
    "node no number": (HEAD + "first,0,0,0,0\n", ["row 0", "'first'"]),
    "vertex twice": (HEAD + "0,0,0,0,0\n0,0,0,1,0\n0,0,1,1,1\n", ["row 1", "vertex 0", "twice"]),
    "vertex missing": (HEAD + "0,0,0,0,0\n0,0,1,1,0\n0,0,3,1,1\n", ["node 0", "vertex 2 is missing"]),
    "ring missing": (HEAD + "0,1,0,0,0\n0,1,1,1,0\n0,1,2,1,1\n", ["node 0", "ring 0 is missing"]),
    "two vertices": (HEAD + "0,0,0,0,0\n0,0,1,1,0\n", ["node 0", "2 different vertices"]),
    "no area": (HEAD + "3,0,0,0,0\n3,0,1,1,1\n3,0,2,0.5,0.5\n", ["node 3", "area 0"]),
    "crosses itself": (
        HEAD + "5,0,0,0,0\n5,0,1,1,1\n5,0,2,1,0\n5,0,3,0,3\n",
        ["cells.csv", "the cell of node 5", "not simple"],
    ),
}


@pytest.mark.parametrize("case", CELLS)
def test_cells_that_cannot_be_used(case, gradients, tmp_path):
    content, words = CELLS[case]
    out = tmp_path / "out.csv"
    complaint = gradients("--integration", "scni", "--out", out, cells=content).complaint()
    assert [w for w in words if w not in complaint] == [], complaint
    assert not out.exists()


OPTIONS = {
    ("--integration", "gauss", *BOX): ["'gauss'", "dni, scni, snni"],
    ("--integration", "scni"): ["--domain", "--box", "--cells"],
    ("--integration", "snni"): ["--box"],
    ("--integration", "scni", "--edge-rule", "simpson", *BOX): ["'simpson'", "trapezoid"],
    ("--integration", "scni", "--edge-rule", "gauss:0", *BOX): ["gauss:0"],
    ("--integration", "dni", "--edge-rule", "midpoint"): ["--edge-rule"],
    ("--integration", "scni", "--derivative", "diffuse", *BOX): ["--derivative"],
    ("--integration", "dni", "--derivative", "half"): ["'half'", "diffuse"],
    ("--integration", "scni", "--box", "0,0,0,1,1,1"): ["6 numbers"],
    ("--integration", "scni", "--box", "0,0,0.8,1"): ["node 2", "outside"],
    ("--integration", "scni", "--kernel", "cubique", *BOX): ["'cubique'"],
    ("--integration", "scni", "--order", "3", *BOX): ["order 3"],
    ("--integration", "scni", "--window", "square", *BOX): ["'square'"],
    ("--integration", "scni", "--box", "0,0,1,1", "--domain", "x.csv"): ["--domain", "--box"],
    ("--box", "0,0,1,1"): ["--integration"],
}


@pytest.mark.parametrize("words", OPTIONS, ids=" ".join)
def test_options_that_cannot_be_used(words, gradients):
    complaint = gradients(*words).complaint()
    assert [w for w in OPTIONS[words] if w not in complaint] == [], complaint


def test_nodes_that_cannot_be_used(gradients):
    words = ["--integration", "scni", *BOX]
    assert "nodes 1 and 9" in gradients(*words, nodes=[*NODES, NODES[1]]).complaint()
    gap = gradients(*words, support="0.2").complaint()
    assert re.search(r"on a cell's facet, point \d+ at \([\d.]+, [\d.]+\) .*order 1 needs 3", gap)
    assert "on the side of a box about a node" in gradients("--integration", "snni", *BOX, support="0.2").complaint()
    assert "order 1 needs 3" in gradients(*words, nodes=NODES[:2], support="9").complaint()
    line = [(0.1 * k, 0.1 * k) for k in range(1, 9)]
    assert "(" in gradients(*words, nodes=line, support="3").complaint()
    assert "node 0 has no support" in gradients(*words, support=None).complaint()
    polygon = "node,vertex,x,y\n0,0,0,0\n0,1,1,0\n0,2,1,1\n"
    assert "--cells" in gradients("--integration", "scni", nodes=[(0.0,), (1.0,)], cells=polygon).complaint()
