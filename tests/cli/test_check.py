"""`rkverify check`: what the author of another code reads about their numbers, told in words and by the status."""

import json

import numpy as np
import pytest

NODES = "x,y\n" + "".join(
    f"{i + 0.1 * ((i * 7 + j * 3) % 4 - 1.5):.3f},{j + 0.1 * ((i * 5 + j * 2) % 4 - 1.5):.3f}\n"
    for i in range(7)
    for j in range(7)
)
POINTS = "x,y\n2.2,2.3\n3.1,2.7\n3.4,3.9\n2.6,4.1\n"
BOX = ("--box", "-0.5,-0.5,6.5,6.5")


@pytest.fixture
def files(table):
    return {"nodes": table("nodes", NODES), "points": table("points", POINTS)}


@pytest.fixture
def ours(rkverify):
    """ours("shape", …) -> the rows that `rkverify shape` prints, as text."""
    return lambda *words: rkverify(*words).out


@pytest.fixture
def shape(rkverify, files, table):
    """shape(text of theirs, …) -> Done."""

    def call(theirs, *words):
        given = ["--nodes", files["nodes"], "--points", files["points"], "--support", "2.3"]
        return rkverify("check", "shape", *given, "--values", table("theirs", theirs), *words)

    return call


@pytest.fixture
def printed(ours, files):
    """printed(…) -> what `rkverify shape` prints with these options."""
    return lambda *words: ours(
        "shape", "--nodes", files["nodes"], "--points", files["points"], "--support", "2.3", *words
    )


def test_what_rkverify_prints_passes(shape, printed):
    done = shape(printed())
    assert (done.status, done.err) == (0, "")
    assert done.out.rstrip().endswith("PASS: the shape functions are as claimed.")


def test_rows_and_columns_may_come_in_any_order(shape, printed):
    header, *rows = printed().splitlines()
    names = header.split(",")
    order = [3, 0, 4, 2, 1]
    turned = [",".join(row.split(",")[k] for k in order) for row in reversed(rows)]
    assert shape("\n".join([",".join(names[k] for k in order), *turned]) + "\n").status == 0


def test_another_derivative_is_named_and_the_way_on_is_told(shape, printed):
    done = shape(printed("--derivative", "diffuse"))
    assert (done.status, done.err) == (1, "")
    text = " ".join(done.out.split())
    assert "FAIL: your numbers have diffuse derivatives, and what is claimed is full derivatives" in text
    assert "give --derivative diffuse if it is meant" in text
    assert shape(printed("--derivative", "diffuse"), "--derivative", "diffuse").status == 0


def test_the_command_that_prints_ours_works_as_it_is_told(shape, printed, rkverify):
    import shlex

    done = shape(printed("--kernel", "quintic"))
    command = next(line for line in done.out.splitlines() if line.endswith(" prints ours"))
    words = shlex.split(command.removeprefix("-> ").removesuffix(" prints ours"))
    assert rkverify(*words[1:]).out == printed()


def test_json_has_the_same_verdict(shape, printed):
    data = json.loads(shape(printed("--derivative", "diffuse"), "--json").out)
    assert data["passed"] is False
    assert "diffuse" in data["verdict"]
    assert {"row", "node", "column", "theirs", "ours", "bound"} == set(data["largest_difference"])
    assert json.loads(shape(printed(), "--json").out)["passed"] is True


def test_numbers_with_six_decimals_are_checked_to_six_decimals(shape, printed):
    header, *rows = printed().splitlines()
    rounded = [",".join(c if k < 2 else f"{float(c):.6f}" for k, c in enumerate(row.split(","))) for row in rows]
    done = shape("\n".join([header, *rounded]) + "\n")
    assert done.status == 0
    assert "finer differences are not looked for" in done.out


def test_a_tolerance_lets_larger_differences_pass(shape, printed):
    header, *rows = printed().splitlines()
    off = [",".join(c if k < 2 else repr(float(c) * (1 + 1e-7)) for k, c in enumerate(row.split(","))) for row in rows]
    theirs = "\n".join([header, *off]) + "\n"
    assert shape(theirs).status == 1
    assert shape(theirs, "--tolerance", "1e-6").status == 0


def test_supports_of_the_points_are_their_nodes_where_they_are_at_nodes(rkverify, table):
    rng = np.random.default_rng(2)
    lines = [f"{line},{2.2 + 0.5 * rng.random():.3f}" for line in NODES.splitlines()[1:]]
    nodes, points = (
        table("own", "x,y,a\n" + "\n".join(lines)),
        table("at", "x,y\n" + "\n".join(NODES.splitlines()[24:27])),
    )
    with_own = table("with_own", "x,y,a\n" + "\n".join(lines[23:26]))
    theirs = []
    for number, line in enumerate(lines[23:26]):  # as a code would that takes the support of the point for all nodes
        one = table("one", f"x,y\n{line.rpartition(',')[0]}\n")
        common = table("common", "x,y\n" + "\n".join(NODES.splitlines()[1:]))
        done = rkverify("shape", "--nodes", common, "--points", one, "--support", line.rpartition(",")[2])
        theirs += [f"{number},{row.partition(',')[2]}" for row in done.out.splitlines()[1:]]
    values = table("values", "point,node,psi,dpsi_dx,dpsi_dy\n" + "\n".join(theirs))
    for file in (points, with_own):
        done = rkverify("check", "shape", "--nodes", nodes, "--points", file, "--values", values)
        assert done.status == 1
        assert "supports owned by the point (target)" in " ".join(done.out.split())


@pytest.fixture
def gradients(rkverify, files, table):
    """gradients(integration and rule of theirs, …of the claim) -> Done."""

    def call(used, *claimed):
        given = ["--nodes", files["nodes"], "--support", "2.3", *BOX]
        theirs = rkverify("gradients", *given, *used).out
        return rkverify("check", "gradients", *given, "--values", table("theirs", theirs), *claimed)

    return call


def test_gradients_that_are_what_is_claimed(gradients):
    done = gradients(["--integration", "scni"], "--integration", "scni")
    assert (done.status, done.err) == (0, "")
    assert "the integration constraint" in done.out


def test_an_edge_rule_other_than_claimed(gradients):
    done = gradients(["--integration", "scni", "--edge-rule", "gauss:2"], "--integration", "scni")
    assert done.status == 1
    assert "scni with the edge rule gauss:2, and what is claimed is scni with the edge rule trapezoid" in " ".join(
        done.out.split()
    )


def test_direct_gradients_without_cells(rkverify, files, table):
    given = ["--nodes", files["nodes"], "--support", "2.3", "--integration", "dni"]
    theirs = table("theirs", rkverify("gradients", *given).out)
    assert rkverify("check", "gradients", *given, "--values", theirs).status == 0
    assert rkverify("check", "gradients", *given, "--derivative", "diffuse", "--values", theirs).status == 1


@pytest.mark.parametrize(
    ("theirs", "words"),
    [
        ("point,node,phi\n0,0,1\n", ["header", "point,node,phi"]),
        ("point,node,psi\n", ["no rows"]),
        ("point,node,psi\n9,0,1\n", ["row 0", "no point 9", "0 to 3"]),
        ("point,node,psi\n0,99,1\n", ["row 0", "no node 99"]),
        ("point,node,psi\n0,1,0.5\n0,1,0.5\n", ["point 0 has node 1 twice"]),
        ("point,node,psi\n0,1,nan\n", ["row 0", "column psi", "'nan'"]),
        ("point,node,psi\n0,1,half\n", ["row 0", "'half'"]),
        ("point,node,psi\n0,-1,1\n", ["row 0", "'-1'"]),
        ("point,node,psi\n0,1\n", ["row 0", "2 cells"]),
    ],
)
def test_values_that_cannot_be_used(theirs, words, shape):
    complaint = shape(theirs).complaint()
    assert [w for w in words if w not in complaint] == [], complaint


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--integration", "scni"], "--integration is for check gradients"),
        (["--box", "0,0,1,1"], "--box is for check gradients"),
        (["--tolerance", "-1"], "--tolerance -1"),
        (["--tolerance", "much"], "--tolerance much"),
        (["--derivative", "half"], "'half'"),
    ],
)
def test_options_that_cannot_be_used(words, said, shape, printed):
    assert said in shape(printed(), *words).complaint()


def test_what_is_missing_is_asked_for(rkverify, files, table):
    theirs = table("theirs", "point,node,psi\n0,0,1\n")
    given = ["--nodes", files["nodes"], "--support", "2.3", "--values", theirs]
    assert "--points" in rkverify("check", "shape", *given).complaint()
    assert "--integration" in rkverify("check", "gradients", *given).complaint()
