"""Entries of the ledger whose best evidence is sampled: what is sampled, and why it is neither proved nor refuted by exact means."""

from dataclasses import dataclass


@dataclass(frozen=True)
class OpenEnd:
    """An entry, in a layer where it has layers: what is only sampled, and why. part: a half of the verdict, or "" for all of it."""

    entry: str
    layer: str
    what: str
    why: str
    part: str = ""


def _each(entries: str, layers: str, what: str, why: str, part: str = "") -> list[OpenEnd]:
    return [OpenEnd(entry, layer, what, why, part) for entry in entries.split() for layer in layers.split() or ("",)]


LINEARISED = "as-defined consistent"
HOLDS, FAILS = "where it holds", "where it fails"
NO_RELATION = (
    "the coefficients follow a moving base, which has no closed relation; growth is measured over a finite time"
)
FLOATING = (
    "the claim is about what a computation loses or survives, digit by digit: floating point is what it speaks of"
)
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
    *_each(
        "C2 C42 C62",
        "as-defined",
        "growth seen from a node that moves, at chosen states",
        "one unstable setting refutes; its growth is an eigenvalue in double precision, far above rounding and not enclosed",
        FAILS,
    ),
    *_each(
        "C4 C56", "consistent", "growth of chosen waves with and without N on an expanding base", NO_RELATION, HOLDS
    ),
    *_each(
        "C57 C69",
        "consistent",
        "the gain from N on an expanding base for chosen waves",
        f"that it is slight is a matter of degree, with a threshold of ours; {NO_RELATION}",
        HOLDS,
    ),
    *_each(
        "E14 C18",
        "",
        "boundary integrals against averages over a cell, by rules that get finer",
        "the divergence theorem is no question; sampled is that our boundaries and rules meet it: integrals of such rational functions over polygons are not rational",
    ),
    *_each(
        "E16",
        "",
        "the sum over coefficients against the boundary integral of the sum, by the same rule",
        "two finite sums that are equal term by term, compared to rounding, since the radial window takes roots; the sums over nodes are exact (E17)",
    ),
    *_each(
        "F1",
        "",
        "properties of the cells of one set of nodes",
        "a sketch without data: which cells it shows cannot be proved, only that cells of ours have its properties",
    ),
    *_each(
        "C5",
        "",
        "signs of omega^2 of SPH's forms over waves, R and kernels",
        "five forms of SPH and five kernels on a grid of R: a closed relation was derived at kh = pi alone (C61)",
    ),
    *_each(
        "C6",
        "",
        "the least omega^2 over waves, for SPH and for DNI with a Lagrangian kernel",
        "on a grid of R and stress; that omega^2 is a square times C F^2 + S where gradients do not move is proved for SCNI (C34)",
    ),
    *_each("C7 C8 C22 C65 C66", "", "digits lost on the way to a fold, forces across gaps and folds", FLOATING),
    *_each(
        "C11",
        "",
        "rates of nodal masses in chosen flows",
        "that mass is not conserved needs one flow, in which the rate is above rounding by thirty powers of ten; the radial window takes roots",
    ),
    *_each(
        "C13",
        "",
        "modes without strain and growing waves, counted on lattices",
        "ranks and eigenvalues of symbols in double precision at chosen waves, lattices, stresses and R",
    ),
    *_each(
        "C14",
        "",
        "return mapping, unloading and Newton's method on bodies",
        "solutions for a body under a path-dependent law have no closed form; material points have, and the bodies agree with them",
    ),
    *_each(
        "C19",
        "",
        "large homogeneous deformations held by Newton's method to rounding",
        "over sets of nodes as they come; the sums from which it follows are exact (E17, C17)",
    ),
    *_each(
        "C33",
        "",
        "condition numbers of the stiffness along R",
        "ill-conditioned is a matter of degree, with a threshold of ours, and a condition number is a number of floating point",
    ),
    *_each(
        "C51",
        "",
        "unstable ranges of DNI beside those of SPH on a grid of states",
        "whether two instabilities are the same is decided by a rule on a grid, as for C3",
    ),
    *_each(
        "C55",
        "",
        "(87) beside the relations of SPH's forms at chosen kernels, R, stresses and waves",
        "that they differ needs one point, far above rounding; where they agree they do to rounding on the grid",
    ),
    *_each(
        "C61",
        "",
        "the sign of Psi,xx(h) beside that of W''(h), on a grid of R and kernels",
        "each sign is proved by itself at every 1 < R < 2 (printed.json, kernels.json); only that they are those of one criterion was compared on a grid",
    ),
    *_each(
        "C75",
        "",
        "finite and uneven sets of nodes, by seed",
        "the sets are a family without end: no theorem over all of them was found, and where the claim fails an example suffices",
    ),
)
