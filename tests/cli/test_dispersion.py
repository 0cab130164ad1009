"""`rkverify dispersion`: columns, signs and options on which scripts rely; what the numbers are is tested elsewhere."""

import json
import math

import pytest

COLUMNS = "kh,root,omega_re,omega_im,omega2_re,omega2_im,growth"
SEMI = ("--formulation", "semi-lagrangian", "--support-ratio", "1.5")
BAR = ("--formulation", "lagrangian", "--support-ratio", "1.5", "--integration", "scni")


@pytest.fixture
def dispersion(rkverify):
    return lambda *words: rkverify("dispersion", *words)


@pytest.mark.parametrize("integration", ["scni", "dni"])
@pytest.mark.parametrize("convective", [True, False])
def test_the_columns_of_the_semi_lagrangian_relations(integration, convective, dispersion):
    """D is defined in (79) and (85), with the convective term; (86) and (87) have none."""
    words = [*SEMI, "--integration", integration, "--kh", "1", *([] if convective else ["--no-convective"])]
    done = dispersion(*words)
    assert (done.status, done.err, done.header) == (0, "", COLUMNS + (",D" if convective else ""))


def test_the_columns_of_the_lagrangian_relation(dispersion):
    assert dispersion(*BAR, "--kh", "1").header == COLUMNS


def test_every_kh_has_two_roots_in_the_order_asked_for(dispersion):
    rows = dispersion(*SEMI, "--integration", "scni", "--kh", "2", "1/2", "-1e-3", "-1/2", "-.25").rows
    assert [float(row["kh"]) for row in rows[::2]] == [2, 0.5, -1e-3, -0.5, -0.25]
    assert [row["root"] for row in rows] == ["0", "1"] * 5
    assert [row["kh"] for row in rows[::2]] == [row["kh"] for row in rows[1::2]]


def test_samples_are_even_up_to_pi(dispersion):
    rows = dispersion(*BAR, "--samples", "4").rows
    assert [float(row["kh"]) for row in rows[::2]] == pytest.approx([math.pi * j / 4 for j in (1, 2, 3, 4)], rel=1e-15)
    assert len(dispersion(*BAR).rows) == 64


TENSION = [
    *SEMI,
    "--integration",
    "dni",
    "--stress-ratio",
    "1/2",
    "--velocity-gradient",
    "-1e-3",
    "--kh",
    "0.5",
    "2",
    "3",
]


def test_growth_is_minus_the_imaginary_part(dispersion):
    """The wave is e^{i(kx + omega t)}: a negative imaginary part grows. Tension makes one root of (82) do so."""
    rows = dispersion(*TENSION).rows
    assert any(float(row["growth"]) > 0 for row in rows)
    for row in rows:
        assert float(row["growth"]) == -float(row["omega_im"])
        omega = complex(float(row["omega_re"]), float(row["omega_im"]))
        assert complex(float(row["omega2_re"]), float(row["omega2_im"])) == pytest.approx(
            omega**2, rel=1e-14, abs=1e-18
        )
        assert (float(row["D"]) < 0) == (float(row["growth"]) != 0)


def test_no_negative_zero_is_printed(dispersion):
    """0.0 and -0.0 are the same frequency; two prints of it would differ in a comparison of files."""
    cells = dispersion(*BAR, "--samples", "8").out.replace("\n", ",").split(",")
    assert "-0.0" not in cells


@pytest.mark.parametrize("option", ["--stress-ratio", "--velocity-gradient"])
@pytest.mark.parametrize(("one", "other"), [("-1e-3", "-1/1000"), ("-1/2", "-0.5"), ("-.5", "-5e-1"), ("-2", "-2.0")])
def test_negative_numbers_are_values_and_no_options(option, one, other, dispersion):
    words = [*SEMI, "--integration", "dni", "--kh", "1"]
    first, second = dispersion(*words, option, one), dispersion(*words, option, other)
    assert (first.status, first.err) == (0, "")
    assert first.out == second.out
    assert first.out != dispersion(*words).out


def test_json_holds_the_same_rows(dispersion):
    rows = json.loads(dispersion(*TENSION, "--json").out)
    assert [{key: str(value) for key, value in row.items()} for row in rows] == dispersion(*TENSION).rows


def test_out_writes_what_would_have_been_printed(dispersion, tmp_path):
    done = dispersion(*TENSION, "--out", tmp_path / "out.csv")
    assert (done.status, done.out, done.err) == (0, "", "")
    assert (tmp_path / "out.csv").read_text(encoding="utf-8") == dispersion(*TENSION).out


REFUSED = {
    ("--formulation", "eulerian"): ["'eulerian'", "semi-lagrangian"],
    ("--integration", "gauss"): ["'gauss'", "scni"],
    ("--layer", "painted"): ["'painted'", "printed"],
    ("--half-point", "middle"): ["'middle'", "edge"],
    ("--derivative", "half"): ["'half'", "frozen"],
    ("--kernel", "cubique"): ["'cubique'", "cubic"],
    ("--order", "5"): ["order 5"],
    ("--support-ratio", "0"): ["support ratio", "positive"],
    ("--support-ratio", "-3/2"): ["support ratio", "positive"],
    ("--support-ratio", "0.4"): ["order 1 needs 2"],
    ("--support-ratio", "wide"): ["'wide'"],
    ("--spacing", "0"): ["spacing", "positive"],
    ("--spacing", "1e400"): ["1e400"],
    ("--velocity-gradient", "nan"): ["'nan'"],
    ("--velocity-gradient", "1e200"): [],
    ("--stress-ratio", "1/0"): ["'1/0'"],
    ("--stretch", "2"): ["--stretch"],
    ("--kh", "inf"): ["'inf'"],
    ("--kh", "1", "one"): ["'one'"],
    ("--samples", "0"): ["--samples 0"],
    ("--samples", "3", "--kh", "1"): ["--kh", "--samples"],
    ("--stress-law", "hooke"): ["'hooke'", "truesdell"],
    ("--arithmetic", "mp"): ["mp:50"],
    ("--no-such-option",): ["--no-such-option"],
}


@pytest.mark.parametrize("words", REFUSED, ids=" ".join)
def test_what_cannot_be_used_is_refused_in_one_line(words, dispersion, tmp_path):
    out = tmp_path / "out.csv"
    complaint = dispersion(*SEMI, "--integration", "scni", "--out", out, *words).complaint()
    assert [w for w in REFUSED[words] if w not in complaint] == [], complaint
    assert not out.exists()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--integration", "dni"], "DNI"),
        (["--velocity-gradient", "1"], "velocity"),
        (["--stretch", "x"], "'x'"),
    ],
)
def test_what_the_lagrangian_relation_does_not_have_is_refused(words, told, dispersion):
    assert told in dispersion(*BAR, *words).complaint()
