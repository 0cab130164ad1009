"""Sign and stability claims that are neither proved nor refuted by exact means, and why."""

from dataclasses import dataclass


@dataclass(frozen=True)
class OpenEnd:
    """A claim in a layer: what is only sampled, and why."""

    claim: str
    layer: str
    what: str
    why: str


def _each(claims: str, layers: str, what: str, why: str) -> list[OpenEnd]:
    return [OpenEnd(claim, layer, what, why) for claim in claims.split() for layer in layers.split()]


LINEARISED = "as-defined consistent"
OPEN_ENDS: tuple[OpenEnd, ...] = (
    *_each(
        "C2 C3 C4 C32 C34 C42 C43 C44 C45 C46 C49 C50 C52 C53 C56 C57 C58 C59 C60 C62 C64 C67 C69 C70 C71 C72 C73",
        "simulated",
        "growth or decay in nonlinear computations at chosen states",
        "a run in double precision over a finite time is a sample; what carries over a range is the linearised relation, to which the runs agree",
    ),
    *_each(
        "C3 C72",
        f"printed {LINEARISED}",
        "unstable ranges of DNI beside those of SPH on a grid of states",
        "to resemble is a matter of degree, decided by a rule on a grid; the criteria that are compared are proved one by one (C49, C50, C60)",
    ),
    *_each(
        "C57 C69",
        "printed",
        "the gain in D from the convective term at the states of Figure 5",
        "that it is a gain is proved (C56); that it is slight is a matter of degree, with a threshold of ours",
    ),
    *_each(
        "C58",
        LINEARISED,
        "growth with and without N under DNI on a moving base",
        "that both effects are similar is a matter of degree; the coefficients follow a moving base, which has no closed relation",
    ),
    *_each(
        "C64 C73",
        f"printed {LINEARISED}",
        "unstable ranges of SPH with smoothing and with N, on a grid of states",
        "a gain over a grid of states and forms of SPH; no relation in closed form was derived for SPH with smoothing and N together",
    ),
    *_each(
        "C70",
        f"printed {LINEARISED}",
        "stable ranges of both formulations side by side on a grid",
        "to be similar is a matter of degree; at rest both conditions are proved one by one (C34, C42)",
    ),
    *_each(
        "C74",
        "as-defined simulated",
        "dispersion over directions and stresses on lattices in the plane and in space",
        "the symbol depends on two or three angles, a stress tensor and R at once: eigenvalues at chosen states, not polynomials in one variable",
    ),
)
