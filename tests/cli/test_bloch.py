"""rkverify bloch: columns, parts, several wave vectors, readings, and every fault of the input in one line."""

import csv
from io import StringIO

import pytest

from rkverify.cli import main

BASE = ["bloch", "--lattice", "square", "--integration", "dni", "--support-ratio", "1.6", "--stress", "-0.2,0.1,0"]


def table(capsys: pytest.CaptureFixture[str], *more: str, base: list[str] = BASE) -> list[dict[str, str]]:
    assert main([*base, *more]) == 0
    return list(csv.DictReader(StringIO(capsys.readouterr().out)))


def test_columns_for_one_and_for_several_wave_vectors(capsys: pytest.CaptureFixture[str]) -> None:
    one = table(capsys, "--k", "1,0.5")
    assert list(one[0]) == ["mode", "omega2_re", "omega2_im", "growth"]
    assert [row["mode"] for row in one] == ["0", "1"]
    several = table(capsys, "--k", "1,0.5", "-3,1/2")
    assert list(several[0]) == ["kx", "ky", "mode", "omega2_re", "omega2_im", "growth"]
    assert [(row["kx"], row["ky"]) for row in several] == [("1.0", "0.5")] * 2 + [("-3.0", "0.5")] * 2
    assert [row["omega2_re"] for row in several[:2]] == [row["omega2_re"] for row in one]


def test_parts_add_up_and_growth_is_the_root(capsys: pytest.CaptureFixture[str]) -> None:
    """Along an axis K is diagonal, so that parts of omega^2 add up mode by mode."""
    at = ("--k", "3,0")
    parts = {name: table(capsys, *at, "--part", name) for name in ("total", "geometric", "material")}
    sums = {name: sum(float(row["omega2_re"]) for row in rows) for name, rows in parts.items()}
    assert sums["total"] == pytest.approx(sums["geometric"] + sums["material"], abs=1e-12)
    for row in parts["geometric"]:
        assert float(row["growth"]) == pytest.approx(max(-float(row["omega2_re"]), 0) ** 0.5, abs=1e-12)


def test_scni_has_no_geometric_part_and_readings_of_measures_do_not_matter(capsys: pytest.CaptureFixture[str]) -> None:
    base = [*BASE[:4], "scni", *BASE[5:]]
    assert {row["omega2_re"] for row in table(capsys, "--k", "2,1", "--part", "geometric", base=base)} == {"0.0"}
    found = {tuple(map(str, table(capsys, "--k", "2,1", "--cell-measure", m, base=base))) for m in ("edges", "fixed")}
    assert len(found) == 1


def test_choices_change_the_numbers(capsys: pytest.CaptureFixture[str]) -> None:
    default = table(capsys, "--k", "2,1")
    for more in (
        ["--derivative", "diffuse"], ["--cell-measure", "fixed"], ["--stress-law", "jaumann"], ["--moduli", "2,1"],
        ["--kernel", "quintic"], ["--window", "tensor"], ["--order", "2", "--support-ratio", "2.5"],
    ):  # fmt: skip
        assert table(capsys, "--k", "2,1", *more) != default


@pytest.mark.parametrize(
    ("more", "says"),
    [
        (["--k", "1"], "--k 1: 1 numbers; write KX,KY"),
        (["--k", "1,x"], "--k x: 'x' is not a finite number"),
        (["--k", "1,1", "--stress", "1,2"], "--stress 1,2: 2 numbers; write SXX,SYY,SXY"),
        (["--k", "1,1", "--moduli", "1,-1"], "give a positive mu"),
        (["--k", "1,1", "--lattice", "cubic"], "unknown lattice 'cubic': choose one of hexagonal, square"),
        (["--k", "1,1", "--part", "all"], "unknown part 'all'"),
        (["--k", "1,1", "--edge-rule", "midpoint"], "leave it out"),
        (["--k", "1,1", "--integration", "scni", "--edge-rule", "simpson"], "unknown edge rule 'simpson'"),
        (["--k", "1,1", "--integration", "scni", "--derivative", "diffuse"], "is for dni"),
        (["--k", "1,1", "--order", "0"], "order 0 does not reproduce linear motions"),
        (["--k", "1,1", "--kernel", "tent"], "kernel 'tent' of node 0 has a joint or peak"),
        (["--k", "1,1", "--support-ratio", "0.9"], "is covered by the supports of 1 node"),
        (["--k", "1,1", "--support-ratio", "-1"], "support radius -1: it must be positive"),
        (["--k", "1,1", "--support-ratio", "1e9"], "support radius"),
        (["--k", "1,1", "--stress-law", "oldroyd"], "unknown stress law 'oldroyd'"),
        (["--k", "1,1", "--window", "round"], "unknown window 'round'"),
    ],
)
def test_faults_are_named_in_one_line(more: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*BASE, *more]) == 2
    said = capsys.readouterr().err
    assert says in said
    assert said.count("\n") == 1
