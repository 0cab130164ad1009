"""What the theorems say about the ledger's entries; not decidable where a proof is missing."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rkverify.certify.theorems.families import GROWTH, RATES, REACH, READINGS, SMOOTH
from rkverify.workflow.study import Statement

if TYPE_CHECKING:
    import pandas as pd

PRINTED, METHOD = ("printed",), ("as-defined", "consistent")
CUBIC = "cubic kernel, linear basis"
LATTICE = f"any even kernel, 1/2 < R <= {REACH + 0.5}, all kh"
STILL = tuple(f"scni-{what}-{m}" for what in ("zero-at-pi", "long-waves") for m in range(1, REACH + 1))
SQUARE = ("lagrangian-square-1", "lagrangian-square-2", "lagrangian-square-3")
CURVED = tuple(f"Psi,xx(h) > 0-cubic-{reading}" for reading in READINGS)
FORM = ("dni-form-cubic-full", "dni-at-pi-cubic-full")


@dataclass(frozen=True)
class Teller:
    """Statements as they come, decided where every theorem that they need is proved."""

    frame: "pd.DataFrame"
    found: list[Statement] = field(default_factory=list)

    def say(
        self,
        name: str,
        about: tuple[str, ...],
        says: str,
        holds: bool,
        tried: str,
        needs: tuple[str, ...],
        layers: tuple[str, ...] = ("",),
        reading: str = "",
    ) -> None:
        """One statement for each layer."""
        proved = set(self.frame[self.frame["status"] == "proved"]["theorem"])
        decided = holds if proved.issuperset(needs) else None
        for layer in layers:
            label = f"{name}_{layer}" if layer else name
            self.found.append(Statement(label, about, says, decided, tried, "proved", layer=layer, reading=reading))

    def value(self, theorem: str, characters: int) -> str:
        """The first number that a theorem encloses; a question mark where there is none."""
        values = self.frame[self.frame["theorem"] == theorem]["values"]
        return str(values.iloc[0]).partition(";")[0][:characters] if len(values) else "?"


def statements(frame: "pd.DataFrame") -> Sequence[Statement]:
    """Everything that follows from the theorems in the table."""
    t = Teller(frame)
    for part in (_building_blocks, _at_rest, _in_motion, _printed_scni, _printed_dni, _dni_at_rest):
        part(t)
    return t.found


def _building_blocks(t: Teller) -> None:
    t.say(
        "reproduction",
        ("E3",),
        "Wherever det M(x) is not 0, (4) reproduces its basis: (adj M) M = (det M) I. In one dimension det M is a sum of products of kernel values times squared Vandermonde determinants, so that it is 0 "
        "exactly where fewer distinct nodes than basis functions lie under the kernels.",
        True,
        "any nodes, supports and kernel; 1 to 4 basis functions, det M of up to 4 nodes (more add terms that are not negative)",
        ("reproduction-1", "reproduction-2", "reproduction-3", "reproduction-4", "moment-matrix-2-functions-3-nodes", "moment-matrix-3-functions-4-nodes", "moment-matrix-3-functions-2-nodes"),
    )  # fmt: skip
    t.say(
        "cubic_kernel",
        ("C16",),
        f"(12) is of class C^2 exactly, positive and falling on 0 < z < 1, zero beyond, and its curvature turns at z = {t.value('kernel-cubic', 8)} alone.",
        True,
        "all z >= 0",
        ("kernel-cubic",),
    )


def _at_rest(t: Teller) -> None:
    t.say(
        "lagrangian_square",
        ("C34", "C67"),
        "omega^2 is (C^SE F^2 + S)/rho_0 times a squared modulus that is not 0 for long waves, since the gradients of a Lagrangian kernel do not move: omega^2 >= 0 at every kh exactly where C^SE F^2 + S >= 0.",
        True,
        f"{LATTICE}; gradients of half-width up to 3 expanded",
        SQUARE + STILL,
        ("printed", *METHOD),
    )
    t.say(
        "scni_at_rest",
        ("C2", "C42", "C44", "C46", "C62"),
        "With SCNI at rest the resultant of a uniform stress is 0 whatever the nodes are, so that omega^2 = (C + sigma)/rho times a squared modulus, which tends to (kh)^2: omega^2 >= 0 at every kh exactly "
        "where C + sigma >= 0.",
        True,
        LATTICE,
        ("scni-telescopes-8", *SQUARE, *STILL),
        METHOD,
        "Q = 0",
    )
    t.say(
        "scni_no_tensile_instability",
        ("C59",),
        "With SCNI at rest omega^2 is C + sigma times a squared modulus: tension alone makes no wave grow.",
        True,
        LATTICE,
        ("scni-telescopes-8", *SQUARE),
        METHOD,
    )
    t.say(
        "scni_unstable_at_rest",
        ("C45",),
        "With SCNI at rest and C + sigma < 0 every wave with 0 < kh < pi grows: the gradient is not 0 there.",
        True,
        f"all 0 < kh < pi, 1 < R < 3.9; {CUBIC}",
        ("scni-telescopes-8", "scni-gradient-not-zero"),
        METHOD,
        "Q = 0",
    )


def _in_motion(t: Teller) -> None:
    growing = tuple(
        f"{function}-{rate}-{motion}"
        for function in ("room-for-growth", "room-for-damping")
        for rate in RATES
        for motion in ("Q>0", "Q<0")
    )
    t.say(
        "scni_growth_in_motion",
        ("C2", "C42", "C62"),
        f"With SCNI and N, where C + sigma >= 0, no wave grows faster than {float(GROWTH)} |Q|, where |Q| is the rate of the base itself, as far as the coefficients are held still; the rule asks for 3 |Q|. The cubic of the symbol has the factors lambda - Q and lambda^2 - b lambda + W (study closed_forms); it is the second that is bounded.",
        True,
        f"all kh, 1 < R < 2, all Q and sigma; {CUBIC}",
        (*growing, "scni-telescopes-8", *SQUARE),
        METHOD,
        "Q not 0",
    )
    for rate, layer in zip(RATES, METHOD, strict=True):
        t.say(
            f"sign_of_Q_{rate}".replace("-", "_"),
            ("C43",),
            "While |Q| is small N gives the SCNI waves kh = pi/2 the growth Q beta/2 with a number beta < 0 at every R: Q > 0 damps them, Q < 0 drives them.",
            False,
            f"kh = pi/2, all 1 < R < 2, C + sigma > 0, coefficients held still; {CUBIC}",
            (f"damping-{rate}", "scni-gradient-not-zero"),
            (layer,),
        )
        t.say(
            f"compression_with_N_{rate}".replace("-", "_"),
            ("C4", "C56", "C57", "C69"),
            "In compression, Q < 0, N drives the SCNI waves kh = pi/2: while |Q| is small their growth is Q beta/2 > 0, with a number beta < 0 at every R; without N they do not grow.",
            False,
            f"kh = pi/2, all 1 < R < 2, C + sigma > 0, coefficients held still; {CUBIC}",
            (f"damping-{rate}", "scni-gradient-not-zero"),
            (layer,),
            "compression, Q < 0",
        )
        t.say(
            f"frequencies_in_motion_{rate}".replace("-", "_"),
            ("C44",),
            "With N and SCNI the waves kh = pi/2 have the coefficient Q beta of omega, beta < 0 and imaginary in the equation for omega: no frequency is real there while |Q| is small and not 0.",
            False,
            f"kh = pi/2, all 1 < R < 2, C + sigma > 0, coefficients held still; {CUBIC}",
            (f"damping-{rate}", "scni-gradient-not-zero"),
            (layer,),
            "Q not 0",
        )


def _printed_scni(t: Teller) -> None:
    t.say(
        "printed_scni",
        ("C40", "C42", "C43"),
        "D of (79) is a sum of squares with weights that are not negative where C + sigma >= 0, and even in Q.",
        True,
        "any kernel, all kh, R, Q, sigma",
        ("printed-scni-not-negative",),
        PRINTED,
    )
    t.say(
        "printed_scni_real",
        ("C2", "C44", "C62"),
        "D of (79) >= 0 at every kh where C + sigma >= 0.",
        True,
        "any kernel, all kh, R, Q, sigma",
        ("printed-scni-not-negative",),
        PRINTED,
        "Q of any size",
    )
    exact = ("printed-scni-exact-set", *(f"Psi(h) {bound}-{kernel}" for kernel in SMOOTH for bound in ("> 0", "< 1/4")))
    bound = "-(3/4) rho h^2 [Q C(h) phi'(h)/R]^2/[C(h/2) phi(h/2)]^2"
    t.say(
        "printed_scni_unstable",
        ("C45",),
        f"D of (79) < 0 at some kh exactly where C + sigma < {bound}; long waves go first. Without Q this is C + sigma < 0.",
        True,
        f"all kh, Q, sigma, 1 < R < 2; {CUBIC}, and the other kernels",
        exact,
        PRINTED,
        f"C + sigma < {bound}",
    )
    t.say(
        "printed_scni_stable_where_the_continuum_is_not",
        ("C45",),
        f"With Q not 0 and C + sigma between {bound} and 0 D of (79) >= 0 at every kh: at R = 3/2, C = 1, sigma = -3/2, Q = 2, h = rho = 1 D > 0 throughout.",
        False,
        f"all kh, Q, sigma, 1 < R < 2; {CUBIC}, and the other kernels",
        (*exact, "counterexample-45"),
        PRINTED,
        f"C + sigma between {bound} and 0",
    )
    t.say(
        "printed_scni_like_the_continuum",
        ("C46",),
        "At rest D of (79) < 0 at some kh exactly where C + sigma < 0.",
        True,
        f"all kh, sigma, 1 < R < 2; {CUBIC}, and the other kernels",
        exact,
        PRINTED,
        "Q = 0",
    )
    t.say(
        "printed_scni_unlike_the_continuum",
        ("C46",),
        f"With Q not 0 the print calls stable what lies between {bound} and 0, where the continuum is not.",
        False,
        f"all kh, Q, sigma, 1 < R < 2; {CUBIC}, and the other kernels",
        (*exact, "counterexample-45"),
        PRINTED,
        "Q not 0",
    )


def _printed_dni(t: Teller) -> None:
    dni = ("printed-dni-exact-set", *CURVED)
    limit = "2 rho [Q C(h) phi'(h)/R]^2"
    t.say(
        "printed_tension",
        ("C50", "C71"),
        f"In tension D of (85) < 0 at some kh exactly where sigma Psi,xx(h) > {limit}, since Psi,xx(h) > 0 at every R in every reading; kh = pi goes first. At rest this is every tension.",
        True,
        f"all kh, sigma > 0, Q, 1 < R < 2; {CUBIC}",
        (*dni, "example-50"),
        PRINTED,
        f"sigma Psi,xx(h) > {limit}",
    )
    t.say(
        "printed_tension_with_Q",
        ("C50", "C71"),
        f"Where sigma Psi,xx(h) <= {limit} D of (85) >= 0 at every kh in tension: at R = 3/2, C = 1, sigma = 1/10, Q = 2, h = rho = 1 D > 0 throughout.",
        False,
        f"all kh, sigma > 0, Q, 1 < R < 2; {CUBIC}",
        (*dni, "counterexample-49"),
        PRINTED,
        f"sigma Psi,xx(h) <= {limit}",
    )
    t.say(
        "printed_sign_decides",
        ("C49",),
        "Where C + sigma >= 0 and Q = 0 the sign of sigma Psi,xx(h) decides on D of (85), and as Psi,xx(h) > 0 so does the sign of the stress.",
        True,
        f"all kh, sigma, 1 < R < 2; {CUBIC}",
        dni,
        PRINTED,
        "Q = 0",
    )
    t.say(
        "printed_sign_does_not_decide",
        ("C49",),
        f"With Q not 0 D of (85) turns where sigma Psi,xx(h) = {limit}, not with a sign.",
        False,
        f"all kh, sigma, 1 < R < 2; {CUBIC}",
        (*dni, "counterexample-49"),
        PRINTED,
        "Q not 0",
    )
    t.say(
        "printed_tensile_instability",
        ("C60",),
        "(87) has omega^2 < 0 at some kh exactly where sigma Psi,xx(h) > 0, as long as C + sigma >= 0; kh = pi goes first.",
        True,
        f"all kh, sigma, 1 < R < 2; {CUBIC}",
        dni,
        PRINTED,
    )
    t.say(
        "printed_dni_grows_somewhere",
        ("C62",),
        "(85) has D < 0 near kh = pi in every tension at rest.",
        True,
        f"all sigma > 0, 1 < R < 2; {CUBIC}",
        dni,
        PRINTED,
    )
    steep = tuple(f"Psi,xx(h) - 4 Psi,x(h)^2 > 0-cubic-{reading}" for reading in READINGS)
    t.say(
        "printed_turns_stable",
        ("C52",),
        "Where C + sigma <= 0 D of (85) >= 0 at every kh, since Psi,xx(h) >= 4 Psi,x(h)^2 at every R in every reading.",
        True,
        f"all kh, Q, sigma <= -C, 1 < R < 2; {CUBIC}",
        ("printed-dni-compressed", *steep),
        PRINTED,
    )


def _dni_at_rest(t: Teller) -> None:
    t.say(
        "long_waves_follow_the_continuum",
        ("C52",),
        "With DNI at rest omega^2/(kh)^2 tends to (C + sigma)/(rho h^2): long waves grow wherever the continuum is unstable.",
        False,
        f"all sigma, 1 < R < 4; {CUBIC}, full and diffuse derivative",
        ("dni-long-waves-full", "dni-long-waves-diffuse"),
        METHOD,
    )
    turn, end = t.value("dni-at-pi-cubic-full", 32), t.value("dni-window-cubic", 32)
    t.say(
        "sign_full",
        ("C49", "C60"),
        f"With DNI at rest, full derivative, omega^2(pi)/sigma is negative up to R = {turn} and not negative from there to R = 4, while Psi,xx(h) > 0 throughout 1 < R < 2: its sign does not decide.",
        False,
        f"all sigma, 1 < R < 4; {CUBIC}",
        (*FORM, *CURVED),
        METHOD,
        "full derivative",
    )
    t.say(
        "sign_diffuse",
        ("C49", "C60"),
        "With DNI at rest, diffuse derivative, and 1 < R < 2, omega^2 >= 0 at every kh exactly where -C <= sigma <= 0: the sign of the stress decides.",
        True,
        f"all kh and sigma, 1 < R < 2; {CUBIC}",
        ("dni-form-cubic-diffuse", "dni-at-pi-cubic-diffuse"),
        METHOD,
        "diffuse derivative",
    )
    t.say(
        "tension_diffuse",
        ("C50", "C71"),
        "With DNI at rest, diffuse derivative, kh = pi grows in every tension.",
        True,
        f"all sigma > 0, 1 < R < 4; {CUBIC}",
        ("dni-at-pi-cubic-diffuse",),
        METHOD,
        "diffuse derivative",
    )
    t.say(
        "tension_below_the_turn",
        ("C50", "C71"),
        f"With DNI at rest, full derivative, kh = pi grows in every tension where R < {turn}.",
        True,
        f"all sigma > 0, 1 < R < {turn[:6]}; {CUBIC}",
        FORM,
        METHOD,
        f"full derivative, R < {turn[:6]}",
    )
    t.say(
        "tension_in_the_window",
        ("C50", "C71"),
        f"With DNI at rest, full derivative, no wave grows in any tension for {turn} < R < {end}.",
        False,
        f"all kh, all sigma > 0, {turn[:6]} < R < {end[:6]} but R = 2; {CUBIC}",
        (*FORM, "dni-window-cubic"),
        METHOD,
        f"full derivative, {turn[:6]} < R < {end[:6]}",
    )
    t.say(
        "tension_beyond_the_window",
        ("C50", "C71"),
        f"With DNI at rest, full derivative, waves between kh = 0 and pi grow in high tension for {end} < R < 4: at R = 5/2 beyond sigma/C = {t.value('dni-greatest-tension-5-2', 32)}, at R = 3 beyond "
        f"{t.value('dni-greatest-tension-3', 32)}, at R = 7/2 beyond {t.value('dni-greatest-tension-7-2', 32)}.",
        True,
        f"{end[:6]} < R < 4; {CUBIC}",
        ("dni-window-cubic", "dni-beyond-window", "dni-greatest-tension-5-2", "dni-greatest-tension-3", "dni-greatest-tension-7-2"),
        METHOD,
        f"full derivative, R > {end[:6]}, sigma beyond a greatest tension",
    )  # fmt: skip
    t.say(
        "dni_grows_somewhere",
        ("C62",),
        f"With DNI at rest some wave grows although the continuum is stable: in every tension below R = {turn[:6]}, in every compression between it and R = 2.",
        True,
        f"1 < R < 2; {CUBIC}, full derivative",
        FORM,
        METHOD,
    )
