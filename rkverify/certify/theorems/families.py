"""The theorems by family: what each says, over which ranges, and how it is proved."""

from collections.abc import Callable
from fractions import Fraction
from functools import cache, partial

from rkverify.certify.theorems import at_rest, identities, of_kernels, printed_squares
from rkverify.certify.theorems import support_functions as functions
from rkverify.certify.theorems import wave_functions as surfaces
from rkverify.certify.theorems.logs import Theorem
from rkverify.certify.theorems.waves import prove_counts_over_R, prove_counts_over_tension, prove_positive
from rkverify.kernels import KERNELS
from rkverify.readings import Convection, Derivative

F = Fraction
SMOOTH = ("cubic", "quartic", "quintic", "wendland-c2", "wendland-c4")
READINGS: tuple[Derivative, ...] = ("full", "diffuse", "frozen-b", "frozen")
BASES: tuple[Derivative, ...] = ("full", "diffuse")
RATES: tuple[Convection, ...] = ("psi-star", "true")
REACH = 6
GROWTH = F(37, 20)
"""In motion no wave grows faster than this times |Q| with SCNI, as far as the coefficients are held still."""

Prove = Callable[[], Theorem]


def _reproduction() -> dict[str, Prove]:
    sizes: dict[str, Prove] = {f"reproduction-{p}": partial(identities.reproduction, p) for p in (1, 2, 3, 4)}
    nodes = ((1, 1), (2, 1), (2, 2), (2, 3), (3, 1), (3, 2), (3, 3), (3, 4))
    return sizes | {f"moment-matrix-{p}-functions-{N}-nodes": partial(identities.singular, p, N) for p, N in nodes}


def _kernels() -> dict[str, Prove]:
    return {f"kernel-{name}": partial(of_kernels.prove_kernel, k) for name, k in KERNELS.items()}


def _scni() -> dict[str, Prove]:
    found: dict[str, Prove] = {"scni-telescopes-8": partial(identities.integration_constraint, 8)}
    for m in range(1, REACH + 1):
        found[f"scni-zero-at-pi-{m}"] = partial(identities.zero_at_pi, m)
        found[f"scni-long-waves-{m}"] = partial(identities.long_waves, m)
    for m in (1, 2, 3):
        found[f"lagrangian-square-{m}"] = partial(identities.squared_modulus, m)
    found["scni-gradient-not-zero"] = lambda: prove_positive(
        "scni-gradient-not-zero",
        "With SCNI no wave between kh = 0 and pi has the frequency 0 where the tangent is not 0: its gradient over sin kh stays positive",
        surfaces.scni_gradient("cubic"),
        surfaces.scni_cuts("cubic", F(1), F(39, 10)),
        True,
    )
    return found


def _printed() -> dict[str, Prove]:
    found: dict[str, Prove] = {}
    for n, name in enumerate(
        ("printed-scni-not-negative", "printed-scni-exact-set", "printed-dni-exact-set", "printed-dni-compressed")
    ):
        found[name] = partial(lambda n: _squares()[n], n)
    for kernel in SMOOTH:
        for function, words in (("Psi(h)", "Psi(h) > 0"), ("1 - 4 Psi(h)", "Psi(h) < 1/4")):
            found[f"{words}-{kernel}"] = _sign(f"{words}-{kernel}", words, functions.printed(function, kernel, "full"))
        for reading in READINGS:
            for function in ("Psi,xx(h)", "Psi,xx(h) - 4 Psi,x(h)^2"):
                name = f"{function} > 0-{kernel}-{reading}"
                found[name] = _sign(name, f"{function} > 0", functions.printed(function, kernel, reading))
    for name, words, integration, at, signs in _COUNTEREXAMPLES:
        found[name] = partial(at_rest.prove_printed, name, words, integration, at, signs)
    return found


@cache
def _squares() -> tuple[Theorem, ...]:
    return tuple(printed_squares.printed_squares())


def _sign(name: str, words: str, subject: functions.Subject) -> Prove:
    return lambda: functions.prove_signs(name, words, subject, (F(1), F(2)), (1,))


_COUNTEREXAMPLES: tuple[tuple[str, str, str, dict[str, str], tuple[int, ...]], ...] = (
    (
        "counterexample-45",
        "C + sigma < 0 and D of (79) > 0 at every kh: Q makes every printed frequency real",
        "scni",
        {"R": "3/2", "C": "1", "sigma": "-3/2", "Q": "2"},
        (1, 1, 1),
    ),
    (
        "counterexample-49",
        "sigma Psi,xx(h) > 0 and D of (85) > 0 at every kh: with Q the sign of the stress does not decide",
        "dni",
        {"R": "3/2", "C": "1", "sigma": "1/10", "Q": "2"},
        (1, 1, 1),
    ),
    (
        "example-50",
        "In tension, at rest, D of (85) < 0 near kh = pi and > 0 for long waves",
        "dni",
        {"R": "3/2", "C": "1", "sigma": "1/10", "Q": "0"},
        (-1, -1, 1, 1),
    ),
)


def _at_pi() -> dict[str, Prove]:
    """omega^2(pi)/sigma of DNI at rest: which sign, on 1 < R < 4."""
    found: dict[str, Prove] = {}
    for kernel in SMOOTH:
        for derivative in BASES:
            signs = (-1,) if derivative == "diffuse" else (-1, 1, 1) if kernel == "cubic" else (-1, 1, -1)
            name = f"dni-at-pi-{kernel}-{derivative}"
            words = (
                "DNI at rest: omega^2(pi) has the sign of -sigma at every R"
                if derivative == "diffuse"
                else "DNI at rest: omega^2(pi)/sigma turns where it is said, and nowhere else"
            )
            subject = functions.at_pi(kernel, derivative)
            found[name] = partial(functions.prove_signs, name, words, subject, (F(1), F(4)), signs)
            name = f"dni-form-{kernel}-{derivative}"
            words = "DNI at rest, 1 < R < 2: omega^2 >= 0 at every kh exactly where C + sigma >= 0 and omega^2(pi) >= 0"
            found[name] = partial(at_rest.prove_form, name, words, kernel, derivative, "affine", F(2))
    for derivative in BASES:
        name = f"dni-long-waves-{derivative}"
        words = "DNI at rest: long waves see C + sigma, so that they grow where the continuum is unstable"
        found[name] = partial(at_rest.prove_form, name, words, "cubic", derivative, "long waves", F(4))
    return found


WINDOWS: dict[str, tuple[tuple[Fraction, Fraction], tuple[int, ...]]] = {
    "cubic": ((F(2), F(3)), (0, 2)),
    "quartic": ((F(2), F(26168, 10**4)), (0, 2)),
    "quintic": ((F(20613, 10**4), F(27323, 10**4)), (0,)),
    "wendland-c2": ((F(2), F(21947, 10**4)), (0,)),
    "wendland-c4": ((F(21271, 10**4), F(25850, 10**4)), (0,)),
}
"""Kernel -> a stretch of R in which omega^2(pi)/sigma > 0, within 10^-4 of its turns, and the zeros of S + G in kh as R grows through it."""
TENSIONS: dict[str, tuple[int, ...]] = {"9/4": (0,), "5/2": (0, 2), "11/4": (0, 2), "3": (0, 2), "7/2": (0, 2)}


def _tension() -> dict[str, Prove]:
    found: dict[str, Prove] = {}
    for kernel, (span, counts) in WINDOWS.items():
        name = f"dni-window-{kernel}"
        words = "DNI at rest, full derivative: every tension is stable up to the R that is said, and beyond it a high one is not"
        subject = surfaces.high_tension(kernel, "full")
        found[name] = partial(prove_counts_over_R, name, words, subject, span, counts)
    beyond = "DNI at rest, full derivative: beyond the window a high tension is unstable at every R"
    found["dni-beyond-window"] = lambda: prove_counts_over_R(
        "dni-beyond-window", beyond, surfaces.high_tension("cubic", "full"), (F(3), F(4)), (2,)
    )
    for R, counts in TENSIONS.items():
        name = f"dni-greatest-tension-{R.replace('/', '-')}"
        words = f"DNI at rest, full derivative, R = {R}: stable in tension up to the sigma/C that is said, and not beyond; all where none is said"
        found[name] = partial(prove_counts_over_tension, name, words, F(R), "full", (F(0), F(1)), counts)
    return found


def _motion() -> dict[str, Prove]:
    found: dict[str, Prove] = {}
    for rate in RATES:
        name = f"damping-{rate}"
        words = "With N the waves kh = pi/2 are damped by one sign of Q and driven by the other: lambda = Q beta/2 +- i …, beta < 0"
        subject = functions.damping(rate)
        found[name] = partial(functions.prove_signs, name, words, subject, (F(1), F(2)), (-1,), False)
        for motion in ("Q > 0", "Q < 0"):
            for function in ("room for growth", "room for damping"):
                name = f"{function.replace(' ', '-')}-{rate}-{motion.replace(' ', '')}"
                words = f"SCNI with N where C + sigma >= 0: lambda^2 - b lambda + W = 0 has no real part above {GROWTH} |Q|: k^2 - k |b|/|Q| - a > 0 and k > |b|/(2 |Q|)"
                subject_2 = surfaces.room(function, rate, GROWTH, motion)
                found[name] = partial(prove_positive, name, words, subject_2, [F(1), F(2)])
    return found


FAMILIES: dict[str, Callable[[], dict[str, Prove]]] = {
    "reproduction": _reproduction,
    "kernels": _kernels,
    "scni": _scni,
    "printed": _printed,
    "at_pi": _at_pi,
    "tension": _tension,
    "motion": _motion,
}
