"""`rkverify cells`: a table of polygons that tile the domain, on which other people's integration rests."""

import json
from itertools import groupby

import pytest

NODES = "x,y\n0.2,0.3\n0.8,0.25\n0.5,0.75\n0,1\n1,0.9\n0.4,0.1\n"
L_WITH_HOLE = "ring,x,y\n0,0,0\n0,2,0\n0,2,1\n0,1,1\n0,1,2\n0,0,2\n1,0.4,0.4\n1,0.6,0.4\n1,0.6,0.6\n1,0.4,0.6\n"
IN_L = "x,y\n0.2,0.2\n0.9,0.3\n1.6,0.5\n0.2,0.9\n0.8,0.8\n0.5,1.6\n1,1\n0,2\n"
# Exact sums of doubles in the unit of the domain: a few additions for each vertex.
ROUNDING = 64 * 2.0**-52


@pytest.fixture
def cells(rkverify, table):
    """cells("--box", "0,0,1,1", nodes=…, domain=…) -> Done."""

    def call(*words, nodes=NODES, domain=None):
        given = ["--domain", table("domain", domain)] if domain else []
        return rkverify("cells", "--nodes", table("nodes", nodes), *given, *words)

    return call


def polygons(rows):
    """node -> ring -> vertices in the order of the table, after a look that everything is numbered 0, 1, 2, …"""
    found = {}
    for (node, ring), part in groupby(rows, key=lambda row: (int(row["node"]), int(row["ring"]))):
        part = list(part)
        assert [int(row["vertex"]) for row in part] == list(range(len(part)))
        assert ring == len(found.setdefault(node, []))
        found[node].append([(float(row["x"]), float(row["y"])) for row in part])
    assert list(found) == list(range(len(found)))
    return found


def area(ring):
    (x0, y0), *_ = ring
    shifted = [(x - x0, y - y0) for x, y in ring]
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(shifted, [*shifted[1:], shifted[0]], strict=True)) / 2


def test_columns_and_numbering(cells):
    done = cells("--box", "0,0,1,1")
    assert (done.status, done.err, done.header) == (0, "", "node,ring,vertex,x,y")
    assert len(polygons(done.rows)) == 6


@pytest.mark.parametrize(("given", "whole"), [({}, 1.0), ({"nodes": IN_L, "domain": L_WITH_HOLE}, 3 - 0.04)])
def test_cells_tile_the_domain_and_their_measures_are_their_areas(given, whole, cells):
    """Areas of the printed rings, outer ones positive and holes negative, add up to the domain's area."""
    words = [] if "domain" in given else ["--box", "0,0,1,1"]
    areas = [sum(map(area, rings)) for rings in polygons(cells(*words, **given).rows).values()]
    assert sum(areas) == pytest.approx(whole, rel=ROUNDING)
    measures = cells(*words, "--measures", **given)
    assert measures.header == "node,measure"
    assert [int(row["node"]) for row in measures.rows] == list(range(len(areas)))
    for row, a in zip(measures.rows, areas, strict=True):
        assert float(row["measure"]) == pytest.approx(a, rel=0, abs=ROUNDING)


def test_outer_rings_run_counter_clockwise_and_holes_clockwise(cells):
    """A node whose cell surrounds a hole of the domain has two rings."""
    domain = "ring,x,y\n0,0,0\n0,1,0\n0,1,1\n0,0,1\n1,0.3,0.3\n1,0.3,0.4\n1,0.4,0.4\n1,0.4,0.3\n"
    found = polygons(cells(nodes="x,y\n0.5,0.5\n", domain=domain).rows)
    assert [len(ring) for ring in found[0]] == [4, 4]
    assert [area(ring) > 0 for ring in found[0]] == [True, False]


def test_orientation_of_the_given_rings_and_a_repeated_last_vertex_do_not_matter(cells):
    one = "ring,x,y\n0,0,0\n0,1,0\n0,1,1\n0,0,1\n"
    for other in ("ring,x,y\n0,0,0\n0,0,1\n0,1,1\n0,1,0\n", one + "0,0,0\n", "x,ring,y\n0,0,0\n1,0,0\n1,0,1\n0,0,1\n"):
        assert cells(domain=other).out == cells(domain=one).out
    assert cells(domain=one).out == cells("--box", "0,0,1,1").out


def test_every_point_of_a_cell_is_nearest_to_its_node(cells):
    places = [tuple(map(float, line.split(","))) for line in NODES.split()[1:]]

    def distance(p, node):
        return ((p[0] - places[node][0]) ** 2 + (p[1] - places[node][1]) ** 2) ** 0.5

    for node, rings in polygons(cells("--box", "0,0,1,1").rows).items():
        for vertex in rings[0]:
            assert all(distance(vertex, node) <= distance(vertex, other) + ROUNDING for other in range(len(places)))


def test_in_one_dimension_cells_end_half_way(cells):
    done = cells("--box", "-1,3", nodes="x\n2\n0\n1\n")
    assert (done.status, done.header) == (0, "node,ring,vertex,x")
    assert done.out.split()[1:] == ["0,0,0,1.5", "0,0,1,3.0", "1,0,0,-1.0", "1,0,1,0.5", "2,0,0,0.5", "2,0,1,1.5"]
    assert cells("--box", "-1,3", "--measures", nodes="x\n2\n0\n1\n").out.split()[1:] == ["0,1.5", "1,1.5", "2,1.0"]


def test_in_three_dimensions_there_are_measures_alone(cells):
    nodes = "x,y,z\n0.25,0.5,0.5\n0.75,0.5,0.5\n"
    done = cells("--box", "0,0,0,1,1,1", "--measures", nodes=nodes)
    assert [float(row["measure"]) for row in done.rows] == pytest.approx([0.5, 0.5], rel=ROUNDING)
    assert "--measures" in cells("--box", "0,0,0,1,1,1", nodes=nodes).complaint()


def test_json_and_out_hold_the_same_rows(cells, tmp_path):
    rows = json.loads(cells("--box", "0,0,1,1", "--json").out)
    assert [{key: str(value) for key, value in row.items()} for row in rows] == cells("--box", "0,0,1,1").rows
    done = cells("--box", "0,0,1,1", "--out", tmp_path / "cells.csv")
    assert (done.status, done.out) == (0, "")
    assert (tmp_path / "cells.csv").read_text(encoding="utf-8") == cells("--box", "0,0,1,1").out


def square(*more):
    return "ring,x,y\n0,0,0\n0,1,0\n0,1,1\n0,0,1\n" + "".join(f"{row}\n" for row in more)


DOMAINS = {
    "header": ("x,y\n0,0\n", ["'x,y'", "ring,x,y"]),
    "no rows": ("ring,x,y\n", ["no rows"]),
    "nan": ("ring,x,y\n0,0,0\n0,nan,0\n0,1,1\n", ["row 1", "'nan'"]),
    "short row": ("ring,x,y\n0,0,0\n0,1\n0,1,1\n", ["row 1", "2 cells"]),
    "ring no number": ("ring,x,y\nouter,0,0\n0,1,0\n0,1,1\n", ["row 0", "'outer'"]),
    "negative ring": ("ring,x,y\n-1,0,0\n0,1,0\n0,1,1\n", ["row 0", "'-1'"]),
    "ring counted from 1": ("ring,x,y\n1,0,0\n1,1,0\n1,1,1\n", ["ring 0 is missing"]),
    "ring left out": (square("2,.2,.2", "2,.4,.2", "2,.4,.4"), ["ring 1 is missing"]),
    "ring interrupted": (square("1,.2,.2", "0,2,2", "1,.4,.2"), ["row 5", "ring 0"]),
    "two vertices": ("ring,x,y\n0,0,0\n0,1,0\n", ["ring 0", "2", "three"]),
    "crosses itself": ("ring,x,y\n0,0,0\n0,1,1\n0,1,0\n0,0,1\n", ["ring 0", "(0.5, 0.5)"]),
    "no area": ("ring,x,y\n0,0,0\n0,1,1\n0,2,2\n", ["ring 0"]),
    "hole outside": (square("1,2,2", "1,3,2", "1,3,3"), ["ring 1", "outside"]),
    "node outside": ("ring,x,y\n0,0,0\n0,0.7,0\n0,0.7,1\n0,0,1\n", ["node 1", "(0.8, 0.25)", "outside"]),
    "node in a hole": (square("1,.45,.7", "1,.55,.7", "1,.55,.8", "1,.45,.8"), ["node 2", "(0.5, 0.75)", "outside"]),
}


@pytest.mark.parametrize("case", DOMAINS)
def test_a_domain_that_cannot_be_used(case, cells, tmp_path):
    text, words = DOMAINS[case]
    out = tmp_path / "out.csv"
    complaint = cells("--out", out, domain=text).complaint()
    assert [w for w in words if w not in complaint] == [], complaint
    assert not out.exists()


BOXES = {
    "0,1": ["2 numbers", "x0,y0,x1,y1"],
    "0,0,0,1,1,1": ["6 numbers", "x0,y0,x1,y1"],
    "0,0,1": ["3 numbers"],
    "0,0,1,x": ["--box 0,0,1,x", "'x'"],
    "0,0,1e400,1": ["too large"],
    "0,0,1,nan": ["'nan'"],
    "0,0,1,": ["''"],
    "1,0,0,1": ["from 1 to 0", "axis 0"],
    "0,0,1,0": ["axis 1"],
    "0,0,0.7,1": ["node 1", "outside"],
}


@pytest.mark.parametrize("text", BOXES)
def test_a_box_that_cannot_be_used(text, cells):
    complaint = cells("--box", text).complaint()
    assert [w for w in BOXES[text] if w not in complaint] == [], complaint


def test_nodes_that_cannot_be_used(cells, table):
    assert "nodes 0 and 2" in cells("--box", "0,0,1,1", nodes="x,y\n0,1\n1,0\n0,1.0\n").complaint()
    assert "row 1" in cells("--box", "0,0,1,1", nodes="x,y\n0,1\n1,inf\n").complaint()
    assert "--domain" in cells(domain=square(), nodes="x,y,z\n0,1,0\n").complaint()
    assert "--domain" in cells(domain=square(), nodes="x\n0\n").complaint()


def test_one_of_domain_and_box_is_to_be_given(cells):
    assert "--box" in cells().complaint()
    assert "--box" in cells("--box", "0,0,1,1", domain=square()).complaint()


def test_on_the_boundary_is_normal(cells):
    nodes = "x,y\n0,0\n1,0\n0.5,0\n0,1\n1,1\n"
    assert cells("--box", "0,0,1,1", nodes=nodes).status == 0
    assert cells(nodes=nodes, domain=square()).out == cells("--box", "0,0,1,1", nodes=nodes).out
