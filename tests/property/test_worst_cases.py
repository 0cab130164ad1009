"""Derived bounds on rounding, on cases that hypothesis draws and climbs with: where it comes near, `make fuzz` prints the case to keep."""

from hypothesis import assume, event, example, given, note, target
from hypothesis import strategies as st

from rkverify.certify.worst.file import written
from rkverify.certify.worst.measuring import measured
from rkverify.certify.worst.search import changed, one_score
from rkverify.certify.worst.starts import Search

KERNELS = ("cubic", "quartic", "quintic", "wendland-c2", "wendland-c4")


@st.composite
def searches(draw: st.DrawFn) -> Search:
    """A start for one quantity, flattened by up to ten powers of ten."""
    quantity = draw(st.sampled_from(["value", "first", "eigenvalue", "psi_star", "true_rate", "measures", "closure"]))
    # Facets of cells on a line have no rounding, and every cell is closed.
    d = draw(st.sampled_from([2, 3] if quantity == "closure" else [1, 2, 3]))
    return Search(
        quantity,
        d,
        draw(st.integers(0, 1 if d == 3 else 2)),
        draw(st.sampled_from(["radial", "tensor"])),
        draw(st.sampled_from(KERNELS)),
        flat=draw(st.integers(0, 20)) / 2,
        seed=draw(st.integers(0, 2**32 - 1)),
        steps=1,
    )


@given(search=searches(), moves=st.lists(st.integers(0, 2**32 - 1), max_size=6))
@example(search=Search("value", 2, 2, flat=1.0, seed=3, steps=1), moves=[1, 2])
def test_no_case_is_beyond_its_bound(search: Search, moves: list[int]) -> None:
    """The seeds of a start and of a few changes are what is drawn, so that a failure shrinks to the fewest changes.

    Singular and uncovered points are other tests' business; without a bound, where rounding may make a matrix singular,
    nothing is promised.
    """
    import numpy as np

    case = search.start(np.random.default_rng(search.seed))
    for seed in moves:
        case = changed(case, np.random.default_rng(seed), 10.0**-search.flat)
    score = one_score(case, "ratio")
    assume(score is not None)
    assert score is not None
    target(score, label=search.quantity)
    event(f"{search.quantity}, within {10 ** -int(-np.log10(max(score, 1e-9)))} of the bound")
    note(written([case]))
    assert not measured(case).exceeded
