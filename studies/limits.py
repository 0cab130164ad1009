"""Long waves and the wave kh = pi of every relation, printed and linearised, against the continuum; conditioning."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rkverify.certify import limit_tables
from rkverify.workflow.compare import Certified, Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

SEMI = ("(86) edge", "(86) literal", "(87) full", "(87) diffuse", "(87) frozen-b", "(87) frozen")
LAGRANGIAN = ("(63)", "Lagrangian SCNI", "Lagrangian DNI")
METHOD = ("SCNI", "DNI full", "DNI diffuse")


@dataclass(frozen=True)
class Parameters:
    """Support ratios, all exact, and kernels; stress sigma/C^sigma or S/C^SE and stretch F; the rules' bounds.

    close: share of the peak that 'nearly vanishes' may mean. ill: how many times worse than at `usual` a condition must
    be at every `large` support ratio to be called ill.
    """

    ratios: tuple[str, ...] = ("21/20", *(str(Fraction(n, 10)) for n in range(11, 41)))
    other_ratios: tuple[str, ...] = ("21/20", "3/2", "7/4", "2", "5/2", "3", "7/2", "4")
    lagrangian_ratios: tuple[str, ...] = ("21/20", "3/2", "7/4", "5/2", "7/2", "4")
    agreement_ratios: tuple[str, ...] = ("7/4",)
    kernel: str = "cubic"
    other_kernels: tuple[str, ...] = ("quartic", "quintic", "wendland-c2", "wendland-c4")
    stress: str = "1/3"
    stretch: str = "6/5"
    flat_ratios: tuple[str, ...] = ("11/10", "3/2", "2", "5/2", "3", "7/2")
    samples: int = 240
    named: str = "7/2"
    close: float = 0.05
    condition_ratios: tuple[str, ...] = ("3/2", "7/4", "2", "5/2", "3", "7/2", "4", "9/2", "5", "11/2", "6")
    nodes: int = 64
    shift: float = 0.2
    seed: int = 7
    usual: str = "3/2"
    large: str = "7/2"
    ill: float = 100.0


QUICK = Parameters(
    ratios=("13/10", "7/4"),
    other_ratios=(),
    lagrangian_ratios=("3/2",),
    agreement_ratios=(),
    other_kernels=(),
    samples=24,
    flat_ratios=("3/2", "7/2"),
    condition_ratios=("3/2", "7/2"),
)


def compute(p: Parameters) -> Tables:
    """Both ends of every relation, the checks of what they rest on, and the conditioning."""
    s, F = Fraction(p.stress), Fraction(p.stretch)
    every = (p.kernel, *p.other_kernels)
    ends = limit_tables.end_rows((*SEMI, *METHOD), p.ratios, (p.kernel,))
    ends += limit_tables.end_rows((*SEMI, *METHOD), p.other_ratios, p.other_kernels)
    ends += limit_tables.end_rows(LAGRANGIAN, p.lagrangian_ratios, every)
    return {
        "ends": table(
            ends,
            [
                ("relation", "", "printed, with its reading, or linearised"),
                ("kernel", "", "of class C2"),
                ("support_ratio", "1", "R"),
                ("material", "1", "factor of C + sigma in lim omega^2 rho/k^2"),
                ("geometric", "1", "factor of sigma in it"),
                ("material_at_pi", "1", "factor of C + sigma in omega^2(pi) rho h^2"),
                ("geometric_at_pi", "1", "factor of sigma in it"),
                ("continuum", "", "whether the long-wave limit is exactly C + sigma"),
            ],
            "Long waves and kh = pi; the continuum has material 1 and geometric 0.",
            Numeric(1e-11, 0, "exact rationals, rounded once when they are printed"),
        ),
        "agreement": table(
            limit_tables.agreement_rows(p.agreement_ratios, every, s),
            [
                ("kernel", "", "of class C2"),
                ("support_ratio", "1", "R"),
                ("integration", "", "scni or dni"),
                ("derivative", "", "reading of the derivative for DNI"),
                ("long_wave", "", "whether the long-wave limits are the same rational"),
                ("at_pi", "", "whether omega^2(pi) is"),
            ],
            "The ends from the gradients of one cell against the whole equations, summed cell by cell.",
            Exact(),
        ),
        "lagrangian": table(
            limit_tables.lagrangian_rows(p.lagrangian_ratios, every, s, F),
            [
                ("kernel", "", "of class C2"),
                ("support_ratio", "1", "R"),
                ("equal", "", "whether every coefficient of cos(n kh) is the same rational"),
            ],
            "(63) against the linearised (56) with SCNI.",
            Exact(),
        ),
        "near_pi": table(
            limit_tables.near_pi_rows(p.flat_ratios, p.samples),
            [
                ("support_ratio", "1", "R"),
                ("peak", "1", "largest omega h/c over the samples"),
                ("ratio_090", "1", "omega at 0.9 pi over it"),
                ("at_pi", "1", "omega h/c at kh = pi"),
            ],
            "The linearised Lagrangian bar with SCNI near kh = pi; every digit is certain.",
            Certified(),
        ),
        "condition": table(
            limit_tables.condition_rows(p.condition_ratios, p.nodes, p.shift, p.seed),
            [
                ("nodes", "", "which set"),
                ("support_ratio", "1", "R in mean spacings"),
                ("zeros", "1", "eigenvalues that are zero"),
                ("smallest", "1", "smallest other eigenvalue of the stiffness"),
                ("largest", "1", "largest eigenvalue"),
                ("condition", "1", "their ratio"),
            ],
            f"Stiffness with SCNI on {p.nodes} nodes; eigenvalues are squared singular values.",
            Numeric(1e-6, 0, "the least singular value, 1e-7 of the largest, carries nine digits of double precision"),
        ),
    }


def _ratio(text: str) -> float:
    return float(Fraction(text))


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """The factors of C + sigma and of sigma in the long-wave limit over R, printed against linearised."""
    frame = tables["ends"].frame
    part = frame[frame["kernel"] == p.kernel]
    figure = new_figure(9.6, 4.2)
    shown = {
        "material": ("(86) edge", "(86) literal", "(87) full", "(87) diffuse", "(87) frozen"),
        "geometric": ("(87) full", "(87) diffuse", "(87) frozen"),
    }
    titles = {"material": "factor of C + σ", "geometric": "factor of σ"}
    styles = dict(zip(shown["material"], LINES[1:], strict=False))
    panels = dict(zip(shown, figure.subplots(1, 2), strict=True))
    for column, axes in panels.items():
        own = part[part["relation"] == "DNI full"]
        axes.plot(own["support_ratio"].map(_ratio), own[column], label="linearised DNI, full", **LINES[0])
        for relation in shown[column]:
            printed = part[part["relation"] == relation]
            axes.plot(printed["support_ratio"].map(_ratio), printed[column], label=relation, **styles[relation])
        axes.set(
            xlabel="support ratio  R = a/h  (1)",
            ylabel=f"{titles[column]} in ω²ρ/k² as kh → 0  (1)",
            title=titles[column],
        )
    panels["geometric"].set_ylim(-8, 0.6)
    figure.legend(*panels["material"].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    caption = (
        f"Long-wave limits at rest, {p.kernel} kernel, linear basis. Black: the linearised DNI with the full derivative; SCNI, DNI with the diffuse derivative and the Lagrangian bar are in the table. "
        "R is ours; the paper gives (86) and (87) for 1 < R < 2."
    )
    frozen, frozen_b = (
        part[part["relation"] == f"(87) {name}"][["material", "geometric"]].to_numpy()
        for name in ("frozen", "frozen-b")
    )
    if (frozen == frozen_b).all():
        caption += " (87) with the reading frozen-b is the same as with frozen."
    words = []
    for relation in SEMI[:4]:
        printed = part[part["relation"] == relation]
        words.append(
            f"{relation}: factor of C + sigma from {printed['material'].min():.3g} to {printed['material'].max():.3g}, "
            f"of sigma from {printed['geometric'].min():.3g} to {printed['geometric'].max():.3g}"
        )
    linearised = part[~part["relation"].str.startswith("(")]
    meant = int(((linearised["material"] == 1) & (linearised["geometric"] == 0)).sum())
    alternative = (
        f"The linearised equations have the continuum's factors 1 and 0 at {meant} of {len(linearised)} settings of formulation and R. "
        f"In print: {'; '.join(words)}."
    )
    return {"long_waves": Drawing(figure, caption, alternative)}


def _gap(part: Any) -> tuple[float, str]:
    """The largest distance of a long-wave limit from the continuum's over both factors, and where it is."""
    off = (
        (part["material"] - 1)
        .abs()
        .where((part["material"] - 1).abs() > part["geometric"].abs(), part["geometric"].abs())
    )
    worst = part.loc[off.idxmax()]
    return float(off.max()), f"R = {worst['support_ratio']}, {worst['kernel']}"


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Which relation has the continuum's long waves, and what follows for stability and conditioning."""
    ends = tables["ends"].frame
    R = ends["support_ratio"].map(Fraction)
    every = ", ".join((p.kernel, *p.other_kernels))
    tried = f"R = {p.ratios[0]} … {p.ratios[-1]} ({len(p.ratios)} values for the {p.kernel} kernel, {len(p.other_ratios)} for each other); {every}; linear basis"
    method = ends[ends["relation"].isin(METHOD)]
    dni = method[method["relation"].str.startswith("DNI")]
    exact_limit = bool(method["continuum"].all())
    return [
        *_scni_statements(ends, R, tried),
        _dni_statement(ends, R, tried),
        _lagrangian_statement(p, tables),
        *_flat_statements(p, tables),
        _condition_statement(p, tables),
        *_unstable_statements(ends, R, bool(dni["continuum"].all()) and exact_limit, tried),
    ]


def _scni_statements(ends: Any, R: Any, tried: str) -> list[Statement]:
    inside, narrow = R < 2, Fraction(3, 2) >= R
    edge, literal = (inside & (ends["relation"] == f"(86) {half}") for half in ("edge", "literal"))
    parts = {
        "C(h/2) at the edge, R <= 3/2": ends[edge & narrow],
        "C(h/2) at the edge, R > 3/2": ends[edge & ~narrow],
        "C(h/2) literal": ends[literal],
    }
    found = []
    for j, (reading, part) in enumerate(parts.items()):
        if len(part):
            gap, where = _gap(part)
            found.append(
                Statement(
                    f"scni_long_waves_{j}",
                    ("E86",),
                    f"The long-wave limit of (86) {'is' if gap == 0 else 'is not'} that of the linearised equations, C + sigma: off by up to {gap:.3g} of it ({where}).",
                    bool(part["continuum"].all()),
                    f"1 < R < 2 of {tried}",
                    "exact",
                    -gap if gap else 0.0,
                    "minus the largest relative error of the limit",
                    layer="as-defined",
                    reading=reading,
                )
            )
    return found


def _dni_statement(ends: Any, R: Any, tried: str) -> Statement:
    inside = ends[ends["relation"].str.startswith("(87)") & (R < 2)]
    sizes = "; ".join(f"{name} {part['geometric'].abs().min():.3g}" for name, part in inside.groupby("relation"))
    gap, where = _gap(inside)
    return Statement(
        "dni_long_waves",
        ("E87",),
        f"The linearised equations have the long waves of the continuum, omega^2 rho/k^2 -> C + sigma; (87) has a part -h^2 Psi,xx(h) sigma beside it, for R < 2 at least (in size): {sizes}. "
        f"Largest error {gap:.3g} of C at sigma = C ({where}).",
        bool(inside["continuum"].any()),
        f"1 < R < 2 of {tried}",
        "exact",
        -float(inside["geometric"].abs().min()),
        "minus the least factor of sigma that the continuum does not have",
        layer="as-defined",
    )


def _lagrangian_statement(p: Parameters, tables: Tables) -> Statement:
    frame = tables["lagrangian"].frame
    return Statement(
        "lagrangian_relation",
        ("E63",),
        f"omega^2 of the linearised (56) with SCNI is (63): every coefficient of cos(n kh) is the same rational in {len(frame)} cases.",
        bool(frame["equal"].all()),
        f"R = {', '.join(p.lagrangian_ratios)}; {p.kernel}, {', '.join(p.other_kernels)}; S/C = {p.stress}, F = {p.stretch}",
        "exact",
        layer="as-defined",
    )


def _flat_statements(p: Parameters, tables: Tables) -> list[Statement]:
    near = tables["near_pi"].frame.set_index("support_ratio")
    share = near["ratio_090"].astype(float)
    zero = bool((near["at_pi"].astype(float) == 0).all())
    return [
        Statement(
            f"flat_before_pi_{layer}",
            ("C32",),
            f"In the linearised Lagrangian bar, which has no convective term, the frequency at kh = 0.9 pi for R = {p.named} is {share[p.named]:.3g} of its peak (for R = {share.index[0]} it is "
            f"{share.iloc[0]:.3g}); 'nearly vanishes' is taken as below {p.close:g}. At kh = pi itself it {'is' if zero else 'is not'} zero for every R tried.",
            bool(share[p.named] < p.close),
            f"R = {', '.join(p.flat_ratios)}, peak over kh = pi n/{p.samples}; cubic kernel",
            "enclosed",
            p.close - float(share[p.named]),
            "share of the peak below the rule's bound",
            layer=layer,
        )
        for layer in ("as-defined", "consistent")
    ]


def _condition_statement(p: Parameters, tables: Tables) -> Statement:
    frame = tables["condition"].frame
    words, worse, zeros = [], [], []
    for nodes, part in frame.groupby("nodes", sort=False):
        usual = float(part[part["support_ratio"] == p.usual]["condition"].iloc[0])
        large = part[part["support_ratio"].map(Fraction) >= Fraction(p.large)]
        worse.append(float(large["condition"].min()) / usual)
        zeros.append(f"{part['zeros'].min()} on the {nodes}")
        words.append(
            f"{usual:.3g} at R = {p.usual} and at least {large['condition'].min():.3g} from R = {p.large} on for the {nodes}"
        )
    return Statement(
        "ill_conditioned",
        ("C33",),
        f"The largest over the smallest nonzero eigenvalue of the stiffness is {'; '.join(words)}. It is called ill where it is {p.ill:g} times that at R = {p.usual}. "
        f"It does not grow with R at every step, and the zeros themselves ({', '.join(zeros)} at every R, the wave kh = pi among those of the lattice) do not come from large supports.",
        min(worse) >= p.ill,
        f"R = {', '.join(p.condition_ratios)}; {p.nodes} nodes, irregular by up to {p.shift:g} of a spacing; cubic kernel",
        "sampled",
        min(worse) / p.ill,
        "least worsening over the rule's bound",
    )


def _unstable_statements(ends: Any, R: Any, exact_limit: bool, tried: str) -> list[Statement]:
    """What becomes of long waves where C + sigma < 0."""
    printed = ends[ends["relation"].isin(("(87) full", "(87) diffuse")) & (R < 2)]
    # omega^2 -> material (C + sigma) + geometric sigma, and at pi geometric sigma: both positive for every s < -1.
    stable = printed[(printed["material"] + printed["geometric"] < 0) & (printed["geometric"] < 0)]
    span = ", ".join(stable["support_ratio"].unique())
    found = [
        Statement(
            "unphysical_printed",
            ("C53",),
            f"Where (87) is stable for C + sigma < 0 its long waves are not the continuum's: they oscillate while the continuum's grow at the rate k sqrt(-(C + sigma)/rho). "
            f"For sigma/C < -1 every kh is stable at R in {{{span}}}: {len(stable)} of {len(printed)} cases.",
            bool(len(stable)) and not stable["continuum"].any(),
            f"1 < R < 2 of {tried}; full and diffuse derivative, all sigma/C < -1",
            "exact",
            layer="printed",
        )
    ]
    for layer in ("as-defined", "consistent"):
        found += [
            Statement(
                f"unphysical_{layer}",
                ("C53",),
                "The linearised equations at rest have exactly the continuum's long waves, so that for C + sigma < 0 they grow at its rate: a stable discrete system, which would be unphysical, does not arise, and the claim has nothing to be about.",
                None if exact_limit else False,
                f"{tried}; full and diffuse derivative, Q = 0",
                "exact",
                layer=layer,
            ),
            Statement(
                f"stable_where_continuum_is_not_{layer}",
                ("C52",),
                "At rest lim omega^2 rho/k^2 is exactly C + sigma with DNI: where the continuum is unstable the long waves of the discrete system are, too.",
                not exact_limit,
                f"{tried}; full and diffuse derivative, Q = 0",
                "exact",
                layer=layer,
            ),
        ]
    return found


STUDY = Study("Long waves and the wave kh = pi", Parameters(), QUICK, compute, judge, draw)
