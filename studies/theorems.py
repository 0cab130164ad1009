"""Theorems over continuous ranges with proof logs: reproduction, kernels, SCNI, the printed and the computed conditions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rkverify.certify.theorems import catalogue
from rkverify.certify.theorems.open_ends import OPEN_ENDS
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import new_figure


@dataclass(frozen=True)
class Parameters:
    """The families of theorems that are proved."""

    families: tuple[str, ...] = tuple(catalogue.FAMILIES)


def compute(p: Parameters) -> Tables:
    """Every theorem, the stable windows, and what is neither proved nor refuted."""
    theorems = catalogue.rows(p.families)
    return {
        "theorems": table(
            theorems,
            [
                ("family", "", "its proof is in the log FAMILY.json"),
                ("theorem", "", "name in the log"),
                ("says", "", "the statement; why not, where it is not proved"),
                ("range", "", "of its parameters"),
                ("method", "", "of the proof"),
                ("steps", "1", "boxes, terms or squares"),
                ("status", "", "proved or not"),
                ("claim", "", "whether a claim of the paper holds or fails by it"),
                ("values", "1", "zeros that it encloses, to 30 decimals"),
                ("counterexample", "", "rational parameters at which a claim fails"),
            ],
            "Theorems; `rkverify recheck` repeats every step of their proofs with other code.",
            Exact(),
        ),
        "windows": table(
            catalogue.windows() if set(p.families) >= {"at_pi", "tension"} else [],
            [
                ("kernel", "", ""),
                ("from", "1", "R from which omega^2(pi)/sigma is positive"),
                ("to", "1", "R from which some wave grows at a high enough tension"),
                ("ended_by", "", "the wave that ends the window"),
            ],
            "DNI at rest with the full derivative: the R at which every tension is stable.",
            Exact(),
        ),
        "open_ends": table(
            [vars(end) for end in OPEN_ENDS],
            [
                ("claim", "", "entry of the ledger"),
                ("layer", "", ""),
                ("what", "", "what is only sampled"),
                ("why", "", "why it is neither proved nor refuted by exact means"),
            ],
            "Sign and stability claims that are only sampled, and why.",
            Exact(),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The proved windows of R per kernel."""
    rows = tables["windows"].frame.to_dict("records")
    figure = new_figure(6.8, 3.0)
    axes = figure.subplots()
    for height, row in enumerate(rows):
        start, end = float(row["from"]), float(row["to"])
        parts = ((1, start, "#404040", ""), (start, end, "#d9d9d9", ""), (end, 4, "#8c8c8c", "////"))
        for low, high, colour, hatch in parts:
            axes.barh(height, high - low, left=low, color=colour, hatch=hatch, edgecolor="white", height=0.7)
    axes.set_yticks(range(len(rows)), [row["kernel"] for row in rows])
    axes.set(xlabel="support ratio  R = a/h  (1)", xlim=(1, 4))
    axes.text(1.05, -0.95, "dark: kh = π grows in every tension; light: no tension grows; hatched: a high tension grows", fontsize=8)  # fmt: skip
    axes.set_ylim(-1.3, len(rows) - 0.4)
    caption = (
        "DNI at rest with the full derivative and a linear basis: proved stretches of the support ratio, for the other kernels than the cubic to within 1e-4 "
        "of the ends. Where kh = pi ends the window, it grows in every tension beyond."
    )
    spans = "; ".join(f"{row['kernel']} from {row['from'][:6]} to {row['to'][:6]}" for row in rows)
    alternative = (
        f"One bar per kernel over R: light, stable in every tension, between {spans}; unstable before and beyond."
    )
    return {"windows": Drawing(figure, caption, alternative)}


def documents(p: Parameters, tables: Tables) -> Mapping[str, str]:
    """The proof logs, one per family."""
    return {f"{family}.json": catalogue.prove(family).log() for family in p.families}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """What the theorems say about the ledger's entries; not decidable where a proof is missing."""
    frame = tables["theorems"].frame
    proved = set(frame[frame["status"] == "proved"]["theorem"])
    found: list[Statement] = []

    def say(
        name: str,
        about: tuple[str, ...],
        says: str,
        holds: bool,
        tried: str,
        needs: tuple[str, ...],
        layers: tuple[str, ...] = ("",),
        reading: str = "",
    ) -> None:
        decided = holds if proved.issuperset(needs) else None
        for layer in layers:
            label = f"{name}_{layer}" if layer else name
            found.append(Statement(label, about, says, decided, tried, "proved", layer=layer, reading=reading))

    cubic = "cubic kernel, linear basis"
    method = ("as-defined", "consistent")
    reach = tuple(range(1, catalogue.REACH + 1))
    still = tuple(f"scni-{what}-{m}" for what in ("zero-at-pi", "long-waves") for m in reach)
    lattice = f"any even kernel, 1/2 < R <= {catalogue.REACH + 0.5}, all kh"
    say(
        "reproduction",
        ("E3",),
        "Wherever det M(x) is not 0, (4) reproduces its basis: (adj M) M = (det M) I. In one dimension det M is a sum of products of kernel values times squared Vandermonde determinants, so that it is 0 "
        "exactly where fewer distinct nodes than basis functions lie under the kernels.",
        True,
        "any nodes, supports and kernel; 1 to 4 basis functions, det M of up to 4 nodes (more add terms that are not negative)",
        ("reproduction-1", "reproduction-2", "reproduction-3", "reproduction-4", "moment-matrix-2-functions-3-nodes", "moment-matrix-3-functions-4-nodes", "moment-matrix-3-functions-2-nodes"),
    )  # fmt: skip
    say(
        "cubic_kernel",
        ("C16",),
        f"(12) is of class C^2 exactly, positive and falling on 0 < z < 1, zero beyond, and its curvature turns at z = {catalogue.value('kernel-cubic', 6)} alone.",
        True,
        "all z >= 0",
        ("kernel-cubic",),
    )
    square = ("lagrangian-square-1", "lagrangian-square-2", "lagrangian-square-3")
    say(
        "lagrangian_square",
        ("C34", "C67"),
        "omega^2 is (C^SE F^2 + S)/rho_0 times a squared modulus that is not 0 for long waves, since the gradients of a Lagrangian kernel do not move: omega^2 >= 0 at every kh exactly where C^SE F^2 + S >= 0.",
        True,
        f"{lattice}; gradients of half-width up to 3 expanded",
        square + still,
        ("printed", *method),
    )
    say(
        "scni_at_rest",
        ("C2", "C42", "C44", "C46", "C62"),
        "With SCNI at rest the resultant of a uniform stress is 0 whatever the nodes are, so that omega^2 = (C + sigma)/rho times a squared modulus, which tends to (kh)^2: omega^2 >= 0 at every kh exactly "
        "where C + sigma >= 0.",
        True,
        lattice,
        ("scni-telescopes-8", *square, *still),
        method,
        "Q = 0",
    )
    say(
        "scni_no_tensile_instability",
        ("C59",),
        "With SCNI at rest omega^2 is C + sigma times a squared modulus: tension alone makes no wave grow.",
        True,
        lattice,
        ("scni-telescopes-8", *square),
        method,
    )
    say(
        "scni_unstable_at_rest",
        ("C45",),
        "With SCNI at rest and C + sigma < 0 every wave with 0 < kh < pi grows: the gradient is not 0 there.",
        True,
        f"all 0 < kh < pi, 1 < R < 3.9; {cubic}",
        ("scni-telescopes-8", "scni-gradient-not-zero"),
        method,
        "Q = 0",
    )
    growing = tuple(
        f"{function}-{rate}-{motion}"
        for function in ("room-for-growth", "room-for-damping")
        for rate in catalogue.RATES
        for motion in ("Q>0", "Q<0")
    )
    say(
        "scni_growth_in_motion",
        ("C2", "C42", "C62"),
        f"With SCNI and N, where C + sigma >= 0, no wave grows faster than {float(catalogue.GROWTH)} |Q|, the rate of the base itself, as far as the coefficients are held still; the rule asks for 3 |Q|.",
        True,
        f"all kh, 1 < R < 2, all Q and sigma; {cubic}",
        (*growing, "scni-telescopes-8", *square),
        method,
        "Q not 0",
    )
    for rate, layer in zip(catalogue.RATES, method, strict=True):
        say(
            f"sign_of_Q_{rate}".replace("-", "_"),
            ("C43",),
            "With N and SCNI the waves kh = pi/2 have the growth Q beta/2 with beta < 0 at every R while |Q| is small: one sign of Q damps them, the other drives them.",
            False,
            f"kh = pi/2, all 1 < R < 2, C + sigma > 0, coefficients held still; {cubic}",
            (f"damping-{rate}",),
            (layer,),
        )
        say(
            f"compression_with_N_{rate}".replace("-", "_"),
            ("C4", "C56", "C57", "C69"),
            "In compression at a rate Q < 0 N drives the waves kh = pi/2 with the growth Q beta/2 > 0 while |Q| is small; without N they do not grow.",
            False,
            f"kh = pi/2, all 1 < R < 2, C + sigma > 0, coefficients held still; {cubic}",
            (f"damping-{rate}",),
            (layer,),
            "compression, Q < 0",
        )
        say(
            f"frequencies_in_motion_{rate}".replace("-", "_"),
            ("C44",),
            "With N and SCNI the waves kh = pi/2 have the coefficient Q beta of omega, beta < 0 and imaginary in the equation for omega: no frequency is real there while Q is not 0.",
            False,
            f"kh = pi/2, all 1 < R < 2, C + sigma > 0, coefficients held still; {cubic}",
            (f"damping-{rate}",),
            (layer,),
            "Q not 0",
        )
    printed = ("printed",)
    say(
        "printed_scni",
        ("C40", "C42", "C43"),
        "D of (79) is a sum of squares with weights that are not negative where C + sigma >= 0, and even in Q.",
        True,
        "any kernel, all kh, R, Q, sigma",
        ("printed-scni-not-negative",),
        printed,
    )
    say(
        "printed_scni_real",
        ("C2", "C44", "C62"),
        "D of (79) >= 0 at every kh where C + sigma >= 0.",
        True,
        "any kernel, all kh, R, Q, sigma",
        ("printed-scni-not-negative",),
        printed,
        "Q of any size",
    )
    exact = ("printed-scni-exact-set", "Psi(h) > 0-cubic", "Psi(h) < 1/4-cubic")
    bound = "-(3/4) rho h^2 [Q C(h) phi'(h)/R]^2/[C(h/2) phi(h/2)]^2"
    say(
        "printed_scni_unstable",
        ("C45",),
        f"D of (79) < 0 at some kh exactly where C + sigma < {bound}; long waves go first. Without Q this is C + sigma < 0.",
        True,
        f"all kh, Q, sigma, 1 < R < 2; {cubic}, and the other kernels",
        exact,
        printed,
        f"C + sigma < {bound}",
    )
    say(
        "printed_scni_stable_where_the_continuum_is_not",
        ("C45",),
        f"With Q not 0 and C + sigma between {bound} and 0 D of (79) >= 0 at every kh: at R = 3/2, C = 1, sigma = -3/2, Q = 2, h = rho = 1 D > 0 throughout.",
        False,
        f"all kh, Q, sigma, 1 < R < 2; {cubic}, and the other kernels",
        (*exact, "counterexample-45"),
        printed,
        f"C + sigma between {bound} and 0",
    )
    say(
        "printed_scni_like_the_continuum",
        ("C46",),
        "At rest D of (79) < 0 at some kh exactly where C + sigma < 0.",
        True,
        f"all kh, sigma, 1 < R < 2; {cubic}, and the other kernels",
        exact,
        printed,
        "Q = 0",
    )
    say(
        "printed_scni_unlike_the_continuum",
        ("C46",),
        f"With Q not 0 the print calls stable what lies between {bound} and 0, where the continuum is not.",
        False,
        f"all kh, Q, sigma, 1 < R < 2; {cubic}, and the other kernels",
        (*exact, "counterexample-45"),
        printed,
        "Q not 0",
    )
    curved = tuple(f"Psi,xx(h) > 0-cubic-{reading}" for reading in catalogue.READINGS)
    dni = ("printed-dni-exact-set", *curved)
    limit = "2 rho [Q C(h) phi'(h)/R]^2"
    say(
        "printed_tension",
        ("C50", "C71"),
        f"In tension D of (85) < 0 at some kh exactly where sigma Psi,xx(h) > {limit}, since Psi,xx(h) > 0 at every R in every reading; kh = pi goes first. At rest this is every tension.",
        True,
        f"all kh, sigma > 0, Q, 1 < R < 2; {cubic}",
        (*dni, "example-50"),
        printed,
        f"sigma Psi,xx(h) > {limit}",
    )
    say(
        "printed_tension_with_Q",
        ("C50", "C71"),
        f"Where sigma Psi,xx(h) <= {limit} D of (85) >= 0 at every kh in tension: at R = 3/2, C = 1, sigma = 1/10, Q = 2, h = rho = 1 D > 0 throughout.",
        False,
        f"all kh, sigma > 0, Q, 1 < R < 2; {cubic}",
        (*dni, "counterexample-49"),
        printed,
        f"sigma Psi,xx(h) <= {limit}",
    )
    say(
        "printed_sign_decides",
        ("C49",),
        "Where C + sigma >= 0 and Q = 0 the sign of sigma Psi,xx(h) decides on D of (85), and as Psi,xx(h) > 0 so does the sign of the stress.",
        True,
        f"all kh, sigma, 1 < R < 2; {cubic}",
        dni,
        printed,
        "Q = 0",
    )
    say(
        "printed_sign_does_not_decide",
        ("C49",),
        f"With Q not 0 D of (85) turns where sigma Psi,xx(h) = {limit}, not with a sign.",
        False,
        f"all kh, sigma, 1 < R < 2; {cubic}",
        (*dni, "counterexample-49"),
        printed,
        "Q not 0",
    )
    say(
        "printed_tensile_instability",
        ("C60",),
        "(87) has omega^2 < 0 at some kh exactly where sigma Psi,xx(h) > 0, as long as C + sigma >= 0; kh = pi goes first.",
        True,
        f"all kh, sigma, 1 < R < 2; {cubic}",
        dni,
        printed,
    )
    say(
        "printed_dni_grows_somewhere",
        ("C62",),
        "(85) has D < 0 near kh = pi in every tension at rest.",
        True,
        f"all sigma > 0, 1 < R < 2; {cubic}",
        dni,
        printed,
    )
    steep = tuple(f"Psi,xx(h) - 4 Psi,x(h)^2 > 0-cubic-{reading}" for reading in catalogue.READINGS)
    say(
        "printed_turns_stable",
        ("C52",),
        "Where C + sigma <= 0 D of (85) >= 0 at every kh, since Psi,xx(h) >= 4 Psi,x(h)^2 at every R in every reading.",
        True,
        f"all kh, Q, sigma <= -C, 1 < R < 2; {cubic}",
        ("printed-dni-compressed", *steep),
        printed,
    )
    say(
        "long_waves_follow_the_continuum",
        ("C52",),
        "With DNI at rest omega^2/(kh)^2 tends to (C + sigma)/(rho h^2): long waves grow wherever the continuum is unstable.",
        False,
        f"all sigma, 1 < R < 4; {cubic}, full and diffuse derivative",
        ("dni-long-waves-full", "dni-long-waves-diffuse"),
        method,
    )
    turn, end = catalogue.value("dni-at-pi-cubic-full", 31), catalogue.value("dni-window-cubic", 31)
    form = ("dni-form-cubic-full", "dni-at-pi-cubic-full")
    say(
        "sign_full",
        ("C49", "C60"),
        f"With DNI at rest, full derivative, omega^2(pi)/sigma is negative up to R = {turn} and not negative from there to R = 4, while Psi,xx(h) > 0 throughout 1 < R < 2: its sign does not decide.",
        False,
        f"all sigma, 1 < R < 4; {cubic}",
        (*form, *curved),
        method,
        "full derivative",
    )
    say(
        "sign_diffuse",
        ("C49", "C60"),
        "With DNI at rest, diffuse derivative, and 1 < R < 2, omega^2 >= 0 at every kh exactly where -C <= sigma <= 0: the sign of the stress decides.",
        True,
        f"all kh and sigma, 1 < R < 2; {cubic}",
        ("dni-form-cubic-diffuse", "dni-at-pi-cubic-diffuse"),
        method,
        "diffuse derivative",
    )
    say(
        "tension_diffuse",
        ("C50", "C71"),
        "With DNI at rest, diffuse derivative, kh = pi grows in every tension.",
        True,
        f"all sigma > 0, 1 < R < 4; {cubic}",
        ("dni-at-pi-cubic-diffuse",),
        method,
        "diffuse derivative",
    )
    say(
        "tension_below_the_turn",
        ("C50", "C71"),
        f"With DNI at rest, full derivative, kh = pi grows in every tension where R < {turn}.",
        True,
        f"all sigma > 0, 1 < R < {turn[:6]}; {cubic}",
        form,
        method,
        f"full derivative, R < {turn[:6]}",
    )
    say(
        "tension_in_the_window",
        ("C50", "C71"),
        f"With DNI at rest, full derivative, no wave grows in any tension for {turn} < R < {end}.",
        False,
        f"all kh, all sigma > 0, {turn[:6]} < R < {end[:6]} but R = 2; {cubic}",
        (*form, "dni-window-cubic"),
        method,
        f"full derivative, {turn[:6]} < R < {end[:6]}",
    )
    say(
        "tension_beyond_the_window",
        ("C50", "C71"),
        f"With DNI at rest, full derivative, waves between kh = 0 and pi grow in high tension for {end} < R < 4: at R = 5/2 beyond sigma/C = {catalogue.value('dni-greatest-tension-5-2', 31)}, at R = 3 beyond "
        f"{catalogue.value('dni-greatest-tension-3', 31)}, at R = 7/2 beyond {catalogue.value('dni-greatest-tension-7-2', 31)}.",
        True,
        f"{end[:6]} < R < 4; {cubic}",
        ("dni-window-cubic", "dni-beyond-window", "dni-greatest-tension-5-2", "dni-greatest-tension-3", "dni-greatest-tension-7-2"),
        method,
        f"full derivative, R > {end[:6]}, sigma beyond a greatest tension",
    )  # fmt: skip
    say(
        "dni_grows_somewhere",
        ("C62",),
        f"With DNI at rest some wave grows although the continuum is stable: in every tension below R = {turn[:6]}, in every compression between it and R = 2.",
        True,
        f"1 < R < 2; {cubic}, full derivative",
        form,
        method,
    )
    return found


STUDY = Study(
    "Theorems over continuous ranges, with proof logs",
    Parameters(),
    Parameters(families=("reproduction", "kernels")),
    compute,
    judge,
    draw,
    documents=documents,
)
