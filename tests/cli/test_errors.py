"""Bad input is answered in one line that names the place and the value, with status 2 and no output of any kind.

A table that was cut off, or a traceback in a batch of a thousand runs, would be taken for a result or read by nobody.
"""

import os
import stat

import pytest

NODES = "x\n0\n1\n2\n3\n"
TABLES = {
    "cell missing": ("x,a\n0,1\n1\n2,1\n", ["row 1", "1 cells"]),
    "cell too many": ("x\n0\n1\n2,5\n", ["row 2", "2 cells"]),
    "word": ("x\n0\n1\n2\nthree\n", ["row 3", "'three'"]),
    "nan": ("x\n0\nnan\n", ["row 1", "'nan'"]),
    "infinite": ("x\n0\ninf\n", ["row 1", "'inf'"]),
    "by nothing": ("x\n0\n1/0\n", ["row 1", "'1/0'"]),
    "empty cell": ('x\n0\n""\n', ["row 1", "''"]),
    "nan support": ("x,a\n0,1\n1,nan\n", ["row 1", "column a", "'nan'"]),
    "too large": ("x\n0\n1e400\n", ["too large"]),
    "endless number": ("x\n0\n1e999999999\n", ["row 1", "column x", "'1e999999999'", "exponent"]),
    "endless fraction": ("x\n0\n1e-999999999\n", ["row 1", "column x", "'1e-999999999'", "exponent"]),
    "endless cell": ("x\n" + "1" * 200_000 + "\n", []),
    "no header": ("0\n1\n2\n", ["header", "'0'"]),
    "other header": ("y\n0\n1\n", ["header", "'y'"]),
    "header twice": ("x,x\n0,1\n", ["header", "'x,x'"]),
    "no rows": ("x\n", ["no rows"]),
    "empty": ("", ["header"]),
    "two dimensions": ("x,y\n0,1\n1,1\n", ["2 coordinates"]),
}


@pytest.fixture
def refused(rkverify, table, tmp_path):
    """refused(words, nodes=…, points=…) -> the complaint, after a look that nothing was written."""

    def call(*words, nodes=NODES, points="x\n1.5\n", support="2"):
        out = tmp_path / "out.csv"
        files = {"nodes": nodes, "points": points}
        given = [w for name, text in files.items() for w in (f"--{name}", table(name, text))]
        before = sorted(tmp_path.iterdir())
        complaint = rkverify("shape", *given, *(["--support", support] if support else []), "--out", out, *words)
        assert sorted(tmp_path.iterdir()) == before
        return complaint.complaint()

    return call


@pytest.mark.parametrize("which", ["nodes", "points"])
@pytest.mark.parametrize("case", [case for case in TABLES if "a\n" not in TABLES[case][0][:4]])
def test_a_table_that_cannot_be_used(case, which, refused):
    text, words = TABLES[case]
    complaint = refused(**{which: text})
    assert [w for w in words if w not in complaint] == [], complaint


@pytest.mark.parametrize("case", ["cell missing", "nan support"])
def test_a_table_with_supports_that_cannot_be_used(case, refused):
    text, words = TABLES[case]
    complaint = refused(nodes=text, support=None)
    assert [w for w in words if w not in complaint] == [], complaint


def test_a_table_that_is_not_there(rkverify, tmp_path, table):
    for path in (tmp_path / "gone.csv", tmp_path):
        complaint = rkverify(
            "shape", "--nodes", path, "--points", table("points", "x\n1\n"), "--support", "1"
        ).complaint()
        assert str(path) in complaint


def test_a_table_that_is_not_text(rkverify, tmp_path, table):
    path = tmp_path / "binary.csv"
    path.write_bytes(b"x\n\xff\xfe\x00")
    complaint = rkverify("shape", "--nodes", path, "--points", table("points", "x\n1\n"), "--support", "1").complaint()
    assert str(path) in complaint


OPTIONS = {
    ("--kernel", "cubique"): ["'cubique'", "cubic", "wendland-c4"],
    ("--derivative", "half"): ["'half'", "full", "frozen-b"],
    ("--arithmetic", "double"): ["'double'", "mp:DIGITS"],
    ("--arithmetic", "mp"): ["mp:50"],
    ("--arithmetic", "mp:0"): ["mp:0"],
    ("--arithmetic", "mp:-3"): ["mp:-3"],
    ("--arithmetic", "mp:²"): ["mp:²"],
    ("--arithmetic", "exact:5"): ["exact:5"],
    ("--order", "3"): ["order 3", "0, 1 or 2"],
    ("--order", "-1"): ["order -1"],
    ("--order", "one"): ["--order", "'one'"],
    ("--support", "0"): ["node 0", "positive"],
    ("--support", "-1/2"): ["node 0", "-0.5"],
    ("--support", "wide"): ["'wide'"],
    ("--support", "nan"): ["'nan'"],
    ("--support", "1e200"): [],
    ("--support", "1e400"): ["1e400"],
    ("--order", "0", "--derivative", "diffuse"): ["diffuse", "order"],
}


@pytest.mark.parametrize("words", OPTIONS, ids=" ".join)
def test_an_option_that_cannot_be_used(words, refused):
    complaint = refused(*words)
    assert [w for w in OPTIONS[words] if w not in complaint] == [], complaint


@pytest.mark.parametrize("name", ["float", "mp:20", "exact"])
def test_coincident_nodes_are_named(name, refused):
    complaint = refused("--arithmetic", name, nodes="x\n0\n1/2\n1\n0.5\n")
    assert "nodes 1 and 3" in complaint


@pytest.mark.parametrize("name", ["float", "mp:20", "exact"])
@pytest.mark.parametrize("place", ["9", "5/4"])
def test_a_point_that_too_few_supports_cover_is_named(name, place, refused):
    complaint = refused("--arithmetic", name, points=f"x\n1/2\n{place}\n", support="0.51")
    shown = place if name == "exact" else {"9": "9.0", "5/4": "1.25"}[place]
    assert f"x = ({shown}" in complaint
    assert "order 1 needs 2" in complaint


def test_a_place_that_cannot_be_written_is_named(rkverify, table):
    nodes, points = table("nodes", NODES), table("points", "x\n1.5\n")
    inside = points / "out.csv"  # points is a plain file
    complaint = rkverify("shape", "--nodes", nodes, "--points", points, "--support", "2", "--out", inside).complaint()
    assert str(inside) in complaint
    assert points.read_text(encoding="utf-8") == "x\n1.5\n"


def test_out_keeps_the_old_file_when_the_input_is_bad(rkverify, table):
    """A batch that fails in the middle must not take away what an earlier one had made."""
    old = table("out", "old\n")
    nodes, points = table("nodes", NODES), table("points", "x\n9\n")
    rkverify("shape", "--nodes", nodes, "--points", points, "--support", "1", "--out", old).complaint()
    assert old.read_text(encoding="utf-8") == "old\n"


def test_out_writes_into_a_special_file_and_does_not_replace_it(rkverify, table, tmp_path):
    """--out /dev/null, or a pipe: as root an atomic replacement would put a plain file in the device's place."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    nodes, points = table("nodes", NODES), table("points", "x\n1.5\n")
    done = rkverify("shape", "--nodes", nodes, "--points", points, "--support", "2", "--out", pipe)
    text = os.read(reader, 10_000)
    os.close(reader)
    assert done.status == 0
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert text.startswith(b"point,node,psi,dpsi_dx\n0,0,")


def test_exact_results_of_endless_digits(refused):
    """Python writes no integer beyond 4300 digits, and says so by a ValueError."""
    given = {"nodes": "x\n0\n1\n2\n", "points": "x\n1e5000\n", "support": "1e5001"}
    assert "digits" in refused("--arithmetic", "exact", **given)
