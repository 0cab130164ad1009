"""Worst cases that searches found, replayed: the largest errors known are below bounds that are derived, and not far below.

A bound that holds on random cases may fail where rounding is worst; one that is never approached says nothing. Both are
decided here, on the cases where a climb ended.
"""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import isfinite

import numpy as np
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.arithmetic.native import Exact
from rkverify.certify.worst import catalogue, file, measures, patch, running, smoothed, tiling
from rkverify.certify.worst.case import KINDS, WorstCase
from rkverify.certify.worst.catalogue import SEARCHES
from rkverify.certify.worst.file import committed, read_cases, written
from rkverify.certify.worst.kernel_rounding import kernel_rounding
from rkverify.certify.worst.measures import Measured
from rkverify.certify.worst.measuring import measured
from rkverify.certify.worst.moments import answers, dependent, pivots
from rkverify.certify.worst.running import UNIT, Book, Rounded, constant, rounded, stacked
from rkverify.certify.worst.search import Search, climb
from rkverify.certify.worst.tabulated import NEAR, kind_rows, tabulated, verdict
from rkverify.certify.worst.window_rounding import window
from rkverify.errors import BadInput, Undecided, UnknownName
from rkverify.kernels import KERNELS
from rkverify.solid.blocks import blocks
from rkverify.solid.neighbours import neighbours

CASES = {case.name: case for case in read_cases()}
WITH_POINT = [name for name, case in CASES.items() if case.point is not None]


@cache
def replayed(name: str) -> Measured:
    return measured(CASES[name])


@pytest.mark.parametrize("name", CASES)
def test_no_error_is_above_its_bound(name: str) -> None:
    """Every number of the case by itself, not only the largest. Without a bound are those that were searched for it alone."""
    found = replayed(name)
    assert not found.exceeded, found
    assert isfinite(found.bound) or "aim='condition'" in CASES[name].found_by
    assert found.error > 0, "an error of 0 is no worst case: search again"


@pytest.mark.parametrize("quantity", KINDS)
def test_every_bound_is_approached(quantity: str) -> None:
    """A bound a thousand times too large would let a float32 pass, or a coefficient off by 1e-13."""
    ratios = [replayed(case.name).ratio for case in CASES.values() if case.quantity == quantity]
    assert max(r for r in ratios if isfinite(r)) >= NEAR


def test_the_list_is_checked_both_ways() -> None:
    """Every search has its case and every case its search, from which it can be found again, perhaps with another seed."""
    assert list(CASES) == list(SEARCHES)
    for name, case in CASES.items():
        assert case.quantity == SEARCHES[name].quantity
        seed = int(case.found_by.partition("seed=")[2].partition(",")[0])
        assert case.found_by == replace(SEARCHES[name], seed=seed).words


def test_the_twin_with_half_of_its_error_as_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    """The replay can fail: a bound of half the error is exceeded, by the factor 2."""
    name = "values on a line"
    monkeypatch.setattr(running, "SLACK", running.SLACK * replayed(name).share / 2)
    found = measured(CASES[name])
    assert found.exceeded
    assert found.share == pytest.approx(2, rel=1e-9)
    assert verdict(found, 1.0) == "exceeded"


@pytest.mark.parametrize("name", ["values on a line", "slopes in space", "curvatures on a line, order 2"])
def test_a_fault_of_one_part_in_1e12_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Supports off in the twelfth digit, in `solid/` alone: far below any tolerance of old, above the derived bound."""
    original = measures.shape
    monkeypatch.setattr(measures, "shape", lambda cloud, *more: original(cloud.at(cloud.positions, cloud.supports * (1 + 1e-12)), *more))  # fmt: skip
    assert measured(CASES[name]).exceeded


@pytest.mark.parametrize("name", ["psi_star", "true_rate"])
def test_a_rate_for_the_other_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Psi* for the true rate, in one of the routes."""
    other = "true_rate" if name == "psi_star" else "psi_star"
    monkeypatch.setitem(measures.RATES, name, (measures.RATES[other][0], measures.RATES[name][1]))
    case = next(case for case in CASES.values() if case.quantity == name)
    assert measured(case).exceeded


def test_faults_of_cells_and_gradients_are_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """A measure off by 1e-13 of itself; the midpoint for the trapezoid; measures of a body off by 1e-9."""
    original = tiling.voronoi

    def larger(nodes, domain):
        cells = original(nodes, domain)
        return replace(cells, measures=cells.measures * (1 + 1e-13))

    monkeypatch.setattr(tiling, "voronoi", larger)
    assert measured(CASES["measures in the plane"]).exceeded
    scni = smoothed.scni
    with monkeypatch.context() as context:
        context.setattr(smoothed, "scni", lambda cloud, cells, rule: scni(cloud, cells, "midpoint"))
        assert measured(CASES["smoothed gradients in the plane"]).exceeded

    def off(cloud, cells, rule):
        operator = scni(cloud, cells, rule)
        return replace(operator, measures=operator.measures * (1 + 1e-9 * np.arange(len(operator.measures))))

    monkeypatch.setattr(patch, "scni", off)
    assert measured(CASES["patch test of a bar"]).exceeded


@pytest.mark.parametrize("name", WITH_POINT)
def test_our_pivots_are_those_of_the_compiled_code(name: str) -> None:
    """The margin counts what `solid/` refuses by: it answers exactly where the margin is above 1."""
    case = CASES[name]
    assert answers(case) == (pivots(case).margin > 1)


def test_singular_matrices_are_refused_and_regular_ones_are_not_called_singular() -> None:
    """Rank in rationals decides which is which; the twin moves one node off the line by one unit of its last place."""
    singular = [case for case in CASES.values() if case.quantity == "pivot"]
    assert all(dependent(case) is not None and not answers(case) for case in singular)
    assert all(dependent(CASES[name]) is None for name in WITH_POINT if CASES[name].quantity != "pivot")
    case = CASES["nodes on a line"]
    nodes = case.nodes.copy()
    nodes[4, 1] = np.nextafter(nodes[4, 1], 9.0)
    assert dependent(replace(case, nodes=nodes)) is None


@pytest.mark.parametrize("name", WITH_POINT)
def test_the_analysis_follows_the_compiled_code(name: str) -> None:
    """Weights of the kernel and its derivatives, and offsets, are the compiled ones within their own bounds."""
    case = CASES[name]
    made, x = case.cloud(), case.array("point")
    near = window(made, x)
    known = neighbours(made, x[None])
    block = next(blocks(made, x[None], known, 2, factorise=False))
    own = np.isin(near.nodes, known.of(0))
    ours = [near.phi, *near.slopes, *near.seconds]
    assert near.scale == block.scale[0]
    for part, theirs in zip([*near.y, *ours], [*block.offsets, *block.weights], strict=True):
        assert (abs(part.value[own] - theirs) <= 2 * part.bound[own]).all()


@pytest.mark.parametrize("kernel", sorted(name for name, k in KERNELS.items() if k.continuity >= 2))
def test_kernels_are_within_their_running_errors(kernel: str) -> None:
    """phi, phi'/z and (phi'' - phi'/z)/z^2 at doubles on both sides of every joint and near 0, against rationals."""
    data, K = KERNELS[kernel], Exact()
    joints = [float(b) for b in data.joints]
    z = np.array(sorted({1e-9, 0.1, 0.3, 0.45, 0.8, *joints, *(np.nextafter(b, 0) for b in joints), *(b - 1e-3 for b in joints)}))  # fmt: skip
    found = kernel_rounding(data, rounded(z))
    for n, text in enumerate(z.tolist()):
        at = Fraction(text)
        g = data.phi.derivative().over_z(at, K)
        exact = (data.phi(at, K), g, (data.phi.derivative(2)(at, K) - g) / at**2)
        for part, value in zip((found.f, found.g, found.s), exact, strict=True):
            assert abs(Fraction(float(part.value[n])) - value) <= Fraction(float(part.bound[n])), (text, value)


def test_running_errors_hold_and_are_near() -> None:
    """(a + b)(a - b)/(1 + c) + sqrt(c) and sums of such, for random doubles: the error is below the bound, and near it for some."""
    rng = np.random.default_rng(2006)
    K = Multiprecision(60)
    best = 0.0
    for _ in range(200):
        a, b, c = rng.uniform(0.5, 2, (3, 4))

        def formula(a, b, c, root):
            return (a + b) * (a - b) / (c + 1.0) + root(c)

        bound = formula(rounded(a), rounded(b), rounded(c), Rounded.sqrt).total()
        computed = 0.0
        for value in formula(a, b, c, np.sqrt):
            computed += value
        exact = sum((formula(*(K.number(float(v)) for v in row), lambda q: K.context.sqrt(q)) for row in zip(a, b, c, strict=True)), K.zero())  # fmt: skip
        error = float(abs(K.number(computed) - exact))
        assert error <= bound.bound
        best = max(best, error / float(bound.bound))
    assert best > 0.1


def test_what_rounds_nothing_has_no_error() -> None:
    """Powers of 2, zeros, and short fractions as coefficients; the twins 3 and 1/3 have one."""
    x = rounded(np.array([0.3, 5.0]))
    assert ((x * 4.0).reach == 0).all()
    assert ((x + 0.0).reach == 0).all()
    assert ((x / 2.0).reach == 0).all()
    assert ((x * 3.0).reach > 0).all()
    assert constant(0.75).error == 0
    assert constant(1 / 3).error > 0


def test_an_error_that_many_numbers_share_cancels_with_its_sign() -> None:
    """x - x is 0 whatever the error of x is, but for u of it, if that is kept as a source; added without sign it counts twice."""
    x = Rounded(np.array([1.0, 2.0]), np.array([7.0, 9.0]))
    kept = Book().own(x)
    assert ((kept - kept).reach <= 4 * UNIT * x.error).all()
    assert ((x - x).reach >= 2 * x.error).all()
    assert (stacked([kept, 3.0 * kept]).total().reach >= kept.reach.sum()).all()
    assert (kept.alone().error == x.error).all()


def test_no_divisor_that_may_be_0_has_a_bound() -> None:
    assert np.isinf((rounded(1.0) / Rounded(np.array(UNIT), np.array(1.0))).bound)


def test_a_climb_is_the_same_each_time_and_rises() -> None:
    """From one seed always the same; from a start it never goes down."""
    search = Search("closure", 2, seed=5, steps=40)
    (one, first), (other, second) = climb(search), climb(search)
    assert first == second
    assert (one.nodes == other.nodes).all()
    assert climb(replace(search, steps=1))[1].ratio <= first.ratio
    assert (climb(replace(search, seed=6))[0].nodes != one.nodes).any()


def test_a_search_that_cannot_be_is_an_error() -> None:
    with pytest.raises(UnknownName, match="unknown aim 'size': choose one of condition, margin, ratio"):
        climb(Search("value", 1, aim="size"))
    with pytest.raises(BadInput, match=r"no case that .* starts from can be measured"):
        climb(Search("value", 2, flat=9.0, steps=3))


def test_tables_tell_too_loose_from_within() -> None:
    """The twin: the same cases beside a bound ten thousand times larger."""
    rows = tabulated(("closure",))
    assert {row["verdict"] for row in rows} == {"within"}
    assert kind_rows(rows)[0]["verdict"] == "within"
    found = replayed("closure in the plane")
    assert verdict(replace(found, bound=found.bound * 1e4), found.ratio / 1e4) == "too loose"
    assert verdict(replace(found, bound=float("inf"), share=float("nan")), 1.0) == "no bound"


def test_the_file_loses_nothing() -> None:
    """Written again it is the same text, and every number the same double."""
    assert written(list(CASES.values())) == committed().read_text(encoding="utf-8")


WRONG = {
    "no TOML": (lambda t: t.replace("[[case]]", "[[case]", 1), "no worst cases can be read"),
    "version": (lambda t: t.replace("version = 1", "version = 2", 1), "version 2 .* asked for as version 1"),
    "cut off": (lambda t: t[: len(t) // 2], "no worst cases can be read|is missing"),
    "decimal": (lambda t: t.replace('"0x', '"', 1), "error: '.*' is no double in hexadecimal: write float.hex"),
    "nan": (lambda t: _first(t, "nan"), "'nan' is no double in hexadecimal"),
    "inf": (lambda t: _first(t, "0x1p+5000"), "'0x1p.5000' is no double in hexadecimal"),
    "quantity": (lambda t: t.replace('"value"', '"values"', 1), "unknown quantity 'values'"),
    "kernel": (lambda t: t.replace('"cubic"', '"tent"', 1), "unknown C2 kernel 'tent'"),
    "window": (lambda t: t.replace('"radial"', '"round"', 1), "unknown window 'round'"),
    "order": (lambda t: t.replace("order = 1", "order = 3", 1), "order 3 is not offered"),
    "missing": (lambda t: t.replace("found_by", "found", 1), "found_by is missing"),
    "more": (lambda t: t.replace("order = 1", 'order = 1\nlow = ["0x1p+0"]', 1), "low is nothing that 'value' takes"),
    "count": (lambda t: t.replace("supports = [", 'supports = ["0x1p+0", ', 1), "supports has the shape"),
    "rows": (lambda t: t.replace("nodes = [\n  [", 'nodes = [\n  ["0x1p+0", ', 1), "every row needs as many numbers"),
    "twice": (lambda t: t.replace('"slopes in space"', '"values on a line"', 1), "two cases are named 'values on a line'"),
}  # fmt: skip


def _first(text: str, number: str) -> str:
    """The first number of the first case in place of another."""
    start = text.index('"0x')
    return f'{text[:start]}"{number}{text[text.index(chr(34), start + 1) :]}'


@pytest.mark.parametrize("what", WRONG)
def test_a_spoilt_file_gives_one_clear_line(what: str, tmp_path) -> None:
    """The file, the case and the entry are named, with what to write."""
    spoil, says = WRONG[what]
    spoilt = tmp_path / "cases.toml"
    spoilt.write_text(spoil(committed().read_text(encoding="utf-8")), encoding="utf-8")
    with pytest.raises(BadInput, match=says) as caught:
        read_cases(spoilt)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("cases.toml")


def test_a_file_that_is_not_there(tmp_path) -> None:
    with pytest.raises(BadInput, match=r"none.toml: no worst cases can be read: .*No such file"):
        read_cases(tmp_path / "none.toml")


def test_searching_on_tells_what_came_nearer(monkeypatch: pytest.MonkeyPatch, tmp_path, capsys) -> None:
    """A case that another seed beats is printed as a table to keep; one that it does not beat is not."""
    weak = replace(catalogue.SEARCHES["closure in the plane"], steps=1)
    monkeypatch.setattr(catalogue, "SEARCHES", {"closure in the plane": weak})
    place = tmp_path / "cases.toml"
    monkeypatch.setattr(catalogue, "committed", lambda: place)
    monkeypatch.setattr(catalogue, "read_cases", lambda: read_cases(place))
    assert catalogue.main(["--write"]) == 0
    ratios = {seed: climb(replace(weak, seed=seed))[1].ratio for seed in range(8)}
    better, worse = max(ratios, key=ratios.__getitem__), min(ratios, key=ratios.__getitem__)
    assert ratios[worse] <= ratios[0] <= ratios[better]
    assert catalogue.main([str(better)]) == 0
    printed = capsys.readouterr().out
    assert (ratios[better] > ratios[0]) == ("[[case]]" in printed)
    assert catalogue.main([str(worse)]) == 0
    assert "0 of 1 searches" in capsys.readouterr().out
    assert catalogue.main(["many"]) == 2
    assert capsys.readouterr().err == "give a seed, such as 1, or --write\n"


def test_a_stiffness_without_inverse_is_an_error() -> None:
    """Supports a million times the bar: every cell has the same gradient, and no displacement a digit."""
    case = CASES["patch test of a bar"]
    with pytest.raises(Undecided, match="the stiffness has no inverse in double precision"):
        measured(replace(case, supports=1e6 * case.array("supports")))


def test_doubles_in_hexadecimal_are_read_as_written() -> None:
    for x in (0.1, -1e-300, 2.0**-1074, 1.0):
        assert file._double(x.hex(), "") == x


def test_a_case_of_another_quantity_can_be_made_by_hand() -> None:
    """What CONTRIBUTING says: any node set of one's own is measured."""
    case = WorstCase("own", "value", "by hand", 0.0, np.array([[0.0], [1.0], [2.0]]), np.full(3, 1.5), "cubic", 1, "radial", point=np.array([0.75]))  # fmt: skip
    assert not measured(case).exceeded
