"""DNI at rest: the form of omega^2 on 1 < R < 2, its long waves beyond, and the print at rational parameters."""

from fractions import Fraction
from itertools import pairwise
from typing import Any

from rkverify.arithmetic.native import Exact
from rkverify.arithmetic.rational_functions import RationalFunctions
from rkverify.certify.theorems.isolation import NotProved, boxes, polynomial, sign, zeros
from rkverify.certify.theorems.logs import Theorem, text, texts
from rkverify.certify.theorems.wave_functions import dni_parts
from rkverify.certify.turns import pieces
from rkverify.paper.notation import lattice_values
from rkverify.readings import Derivative

ONE, TWO = Fraction(1), Fraction(2)


def prove_form(name: str, words: str, kernel: str, derivative: Derivative, form: str, upper: Fraction) -> Theorem:
    """omega^2 = (1 - c)[(1 + s) S + s G]: S = 1 + c and G a multiple of 1 - c (affine), or S = 2 and G = 0 at c = 1.

    Raises NotProved where it is not so.
    """
    ends = pieces(kernel, upper)
    for a, b in ends:
        K = RationalFunctions({"R": (a + b) / 2})
        S, G = dni_parts(kernel, derivative, K.generator("R"), K, int((a + b) / 2) + 1)
        if form == "affine":
            fits = len(S) == 2 and all(K.is_zero(p - 1) for p in S) and K.is_zero(G[0] + G[1])
        else:
            fits = K.is_zero(sum(S, K.zero()) - 2) and K.is_zero(sum(G, K.zero()))
        if not fits:
            raise NotProved(f"{name}: omega^2 is not of this form for {a} < R < {b}")
    claim = {
        "kind": "at rest",
        "kernel": kernel,
        "derivative": derivative,
        "form": form,
        "from": 1,
        "to": text(upper),
    }
    log = {"pieces": [texts(end) for end in ends]}
    return Theorem(name, words, f"1 < R < {upper}, all kh, sigma", claim, log, "identity over Q(R)", len(ends))


def prove_printed(
    name: str,
    words: str,
    integration: str,
    at: dict[str, str],
    expected: tuple[int, ...],
    derivative: Derivative = "full",
    holds: bool | None = False,
) -> Theorem:
    """The signs of D of (79) or (85) over 1 - cos kh at rational R, C, sigma, Q (h = rho = 1) as c runs from -1 to 1.

    The first and the last are those at kh = pi and of the longest waves. Raises NotProved where there are others.
    """
    R, C, sigma, Q = (Fraction(at[key]) for key in ("R", "C", "sigma", "Q"))
    v = lattice_values(1, R, Exact(), "edge", derivative)
    slope = Q * v.C_h * v.slope_h / R
    # B = -2 slope sin kh (Psi(0) + 2 Psi(h) c); D/16 over 1 - c.
    wave = [v.Psi_0, 2 * v.Psi_h]
    square = [wave[0] ** 2, 2 * wave[0] * wave[1], wave[1] ** 2]
    material = (C + sigma) * ((v.C_half * v.phi_half) ** 2 if integration == "scni" else v.Psi_x_h**2)
    inner = [slope**2 / 4 * s for s in square]
    inner[0] += material
    found = [p + q for p, q in zip([*inner, Fraction(0)], [Fraction(0), *inner], strict=True)]
    found[0] += slope**2 - (0 if integration == "scni" else sigma * v.Psi_xx_h / 2)
    while found and not found[-1]:
        found.pop()
    p = polynomial(found)
    isolated = boxes(p, -ONE, ONE)
    places = [-ONE, *(end for zero in zeros(p, isolated) for end in zero), ONE]
    between = [sign(p, (x + y) / 2) for x, y in pairwise(places)][::2]
    signs = (sign(p, -ONE), *between, sign(p, ONE))
    if signs != expected:
        raise NotProved(f"{name}: D has the signs {signs}, not {expected}")
    subject: dict[str, Any] = {
        "function": "D/(1 - cos kh)",
        "integration": integration,
        "kernel": "cubic",
        "derivative": derivative,
        **{key: text(Fraction(value)) for key, value in at.items()},
    }
    claim = {"kind": "signs over c", "subject": subject, "signs": list(signs)}
    log = {"polynomial": texts(found), "boxes": [[text(a), text(b), n] for a, b, n in isolated]}
    tried = "all kh; " + ", ".join(f"{key} = {value}" for key, value in at.items())
    return Theorem(name, words, tried, claim, log, "exact polynomial in cos kh, boxes", len(isolated), holds)
