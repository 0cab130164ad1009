"""Support ratios and stresses at which the verdict on DNI turns: the state at kh = pi, per kernel and reading."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rkverify.certify.tension_window import window_rows
from rkverify.certify.turn_tables import agreement_rows, profile_rows, range_rows, turn_rows
from rkverify.readings import Derivative
from rkverify.workflow.compare import Certified, Exact, Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure


@dataclass(frozen=True)
class Parameters:
    """Kernels of class C2, readings of the derivative, and the support ratios up to which zeros are searched and shown."""

    kernels: tuple[str, ...] = ("cubic", "quartic", "quintic", "wendland-c2", "wendland-c4")
    derivatives: tuple[Derivative, ...] = ("full", "diffuse")
    printed: tuple[Derivative, ...] = ("full", "diffuse", "frozen-b", "frozen")
    upper: str = "4"
    shown: tuple[str, ...] = ("21/20", *(str(Fraction(n, 15)) for n in range(16, 61)))
    range_ratios: tuple[str, ...] = tuple(str(Fraction(n, 10)) for n in range(11, 41))
    other_range_ratios: tuple[str, ...] = tuple(str(Fraction(n, 4)) for n in range(5, 17))
    samples: int = 200
    window_tenths: tuple[int, int] = (15, 31)
    tensions_at: tuple[str, ...] = ("5/2", "3", "7/2")
    decided_kernel: str = "cubic"
    decided_upper: str = "2"


QUICK = Parameters(
    kernels=("cubic",),
    derivatives=("full",),
    printed=("diffuse",),
    shown=("3/2", "7/4"),
    range_ratios=("5/2",),
    samples=20,
)


def compute(p: Parameters) -> Tables:
    """All zeros with their signs, the functions themselves, and the ranges of stress."""
    upper = Fraction(p.upper)
    others: tuple[Derivative, ...] = tuple(d for d in p.printed if d not in p.derivatives)
    return {
        "turns": table(
            turn_rows("method", p.derivatives, p.kernels, upper)
            + turn_rows("method", others, (p.decided_kernel,), upper)
            + turn_rows("(87)", p.printed, p.kernels, upper),
            [
                ("function", "", "method: the linearised equations with DNI at rest; (87): -4 Psi,xx(h)"),
                ("kernel", "", "of class C2"),
                ("derivative", "", "reading of the derivative"),
                ("degree", "1", "of the largest polynomial whose zeros were isolated"),
                ("zero", "1", "R at which omega^2(pi)/sigma vanishes, every digit certain"),
                ("before", "1", "sign of omega^2(pi)/sigma for smaller R"),
                ("behind", "1", "sign for larger R; 0 at the end of the search"),
                ("kind", "", "turn where the sign changes, touch where it does not"),
            ],
            f"All zeros of omega^2(pi)/sigma for 1 < R <= {p.upper}, isolated with rational ends and counted by Sturm's sequence.",
            Exact(),
        ),
        "agreement": table(
            agreement_rows(p.decided_kernel, p.printed, Fraction(p.decided_upper)),
            [
                ("kernel", "", "of class C2"),
                ("derivative", "", "reading of the derivative"),
                ("method", "1", "signs of omega^2(pi)/sigma of the method between the zeros"),
                ("printed", "1", "signs of -4 Psi,xx(h) there"),
                ("zeros", "1", "every zero of either"),
                ("same", "", "whether the signs agree everywhere"),
            ],
            f"Signs of the method and of (87) at kh = pi for 1 < R < {p.decided_upper}.",
            Exact(),
        ),
        "profile": table(
            profile_rows("method", p.derivatives, p.kernels, p.shown)
            + profile_rows("(87)", p.derivatives, (p.decided_kernel,), p.shown),
            [
                ("function", "", "method or (87)"),
                ("kernel", "", "of class C2"),
                ("derivative", "", "reading of the derivative"),
                ("support_ratio", "1", "R"),
                ("value", "1", "omega^2 rho h^2/sigma at kh = pi"),
            ],
            "The state at kh = pi over R.",
            Numeric(1e-11, 0, "exact rationals, rounded once when they are printed"),
        ),
        "window": table(
            window_rows(p.kernels, range(*p.window_tenths), p.tensions_at),
            [
                ("kernel", "", "of class C2"),
                ("window_end", "1", "R beyond which some wave grows at a high enough tension, rounded"),
                ("kh", "rad", "of that wave"),
                *(
                    (
                        f"greatest_at_{R.replace('/', '_')}",
                        "1",
                        f"greatest sigma/C^sigma at R = {R} at which no wave grows",
                    )
                    for R in p.tensions_at
                ),
            ],
            "DNI with the full derivative at rest: where the supports end at which every tension is stable.",
            Certified(),
        ),
        "stress_range": table(
            range_rows(p.range_ratios, (p.decided_kernel,), p.derivatives, p.samples)
            + range_rows(
                p.other_range_ratios, [k for k in p.kernels if k != p.decided_kernel], p.derivatives, p.samples
            ),
            [
                ("kernel", "", "of class C2"),
                ("derivative", "", "reading of the derivative"),
                ("support_ratio", "1", "R"),
                ("lowest", "1", "lowest sigma/C^sigma at which omega^2 >= 0 at every kh looked at"),
                ("kh_lowest", "rad", "the kh that sets it, 0 for the longest waves"),
                ("highest", "1", "highest sigma/C^sigma, none where there is no end"),
                ("kh_highest", "rad", "the kh that sets it"),
            ],
            f"Stresses at which DNI at rest is stable; cos kh = -1 + 2 n/{p.samples}.",
            Exact(),
        ),
    }


def _ratio(text: str) -> float:
    return float(Fraction(text))


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """omega^2(pi)/sigma over R for every kernel, with the turns marked."""
    profile, turns = tables["profile"].frame, tables["turns"].frame
    figure = new_figure(9.6, 4.2)
    panels = figure.subplots(1, len(p.derivatives), sharey=True, squeeze=False)[0]
    for axes, derivative in zip(panels, p.derivatives, strict=True):
        for style, kernel in zip(LINES, p.kernels, strict=False):
            part = profile[
                (profile["function"] == "method")
                & (profile["kernel"] == kernel)
                & (profile["derivative"] == derivative)
            ]
            axes.plot(part["support_ratio"].map(_ratio), part["value"], label=kernel, **style)
            marked = _turns(turns, "method", kernel, derivative)
            axes.plot(
                marked,
                [0] * len(marked),
                linestyle="",
                marker="o",
                markersize=6,
                color=style["color"],
                markerfacecolor="#FFFFFF",
            )
        part = profile[(profile["function"] == "(87)") & (profile["derivative"] == derivative)]
        axes.plot(
            part["support_ratio"].map(_ratio),
            part["value"],
            label=f"(87), {p.decided_kernel}",
            color="#808080",
            linewidth=0.9,
        )
        axes.axhline(0, color="#606060", linewidth=0.8)
        axes.set_yscale("symlog", linthresh=0.1)
        axes.set(xlabel="support ratio  R = a/h  (1)", title=f"{derivative} derivative")
    panels[0].set_ylabel("ω²ρh²/σ at kh = π  (1)")
    panels[0].legend(loc="lower right")
    caption = (
        "DNI at rest, as defined: where the curve is negative a tensile stress makes kh = pi grow, where it is positive a compressive one does. Circles: turns. Grey: (87) in the panel's reading. "
        f"Vertical axis linear between -0.1 and 0.1, logarithmic beyond. h = rho = 1, linear basis, all kernels of class C2 (the paper names the cubic one); 1 < R <= {p.upper} is ours."
    )
    spans = []
    for derivative in p.derivatives:
        each = {kernel: _turns(turns, "method", kernel, derivative) for kernel in p.kernels}
        found = "; ".join(
            f"{kernel} at R = {', '.join(f'{R:.4g}' for R in where)}" for kernel, where in each.items() if where
        )
        spans.append(
            f"with the {derivative} derivative " + (f"the sign turns for {found}" if found else "no kernel turns")
        )
    least = min(profile["support_ratio"], key=_ratio)
    start = profile[(profile["function"] == "method") & (profile["support_ratio"] == least)]["value"].astype(float)
    alternative = (
        f"omega^2 at kh = pi over sigma is {start.max():.3g} or less at R = {_ratio(least):.4g}: {'; '.join(spans)}."
    )
    return {"turns": Drawing(figure, caption, alternative)}


def _turns(turns: Any, function: str, kernel: str, derivative: str) -> list[float]:
    part = turns[
        (turns["function"] == function)
        & (turns["kernel"] == kernel)
        & (turns["derivative"] == derivative)
        & (turns["kind"] == "turn")
    ]
    return [float(zero) for zero in part["zero"]]


_WORDS = {"1": "positive", "-1": "negative"}


def _signs(signs: str, zeros: str) -> str:
    """Signs between zeros in words.

    >>> _signs("-1 1", "1.5"), _signs("-1 -1", "1.5"), _signs("1 -1 1", "1.2 1.4")
    ('negative up to R = 1.5, positive from there on', 'negative throughout', 'positive up to R = 1.2, negative from there to R = 1.4, positive from there on')
    >>> _signs("1 -1", "1.2 1.4")
    'positive, negative in turn, with zeros at R = 1.2 1.4'
    """
    each = [_WORDS[sign] for sign in signs.split()]
    if len(set(each)) == 1:
        return f"{each[0]} throughout"
    places = zeros.split()
    if len(places) == len(each) - 1:
        return f"{each[0]} up to R = {places[0]}" + "".join(
            f", {word} from there {f'to R = {end}' if end else 'on'}"
            for word, end in zip(each[1:], [*places[1:], ""], strict=True)
        )
    return f"{', '.join(each)} in turn, with zeros at R = {zeros}"


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Whether the sign of sigma Psi,xx(h) decides the method's stability as it decides (87)'s."""
    statements = []
    for row in tables["agreement"].frame.itertuples():
        method = _signs(str(row.method), str(row.zeros))
        opposite = _signs(str(row.printed), str(row.zeros))  # of -4 Psi,xx(h)
        verdict = "decides" if row.same else "does not decide"
        statements += [
            Statement(
                f"{name}_{row.derivative}_{layer}",
                (about,),
                f"At rest omega^2(pi)/sigma of the linearised equations is {method}, and -Psi,xx(h) is {opposite}: the sign of sigma Psi,xx(h) {verdict} whether the wave kh = pi grows.",
                bool(row.same),
                f"all 1 < R < {p.decided_upper}, Q = 0, kh = pi; {p.decided_kernel} kernel, linear basis",
                "proved",
                layer=layer,
                reading=f"{row.derivative} derivative",
            )
            for name, about in (("sign_decides", "C49"), ("tensile_instability", "C60"))
            for layer in ("as-defined", "consistent")
        ]
    end = tables["window"].frame.set_index("kernel").loc[p.decided_kernel]
    start = _turns(tables["turns"].frame, "method", p.decided_kernel, p.derivatives[0])
    ranges = tables["stress_range"].frame
    between = ranges["support_ratio"].map(lambda R: bool(start) and start[0] < _ratio(R) < float(end["window_end"]))
    chosen = ranges[(ranges["kernel"] == p.decided_kernel) & (ranges["derivative"] == p.derivatives[0]) & between]
    at, inside = list(chosen["support_ratio"]), list(chosen["highest"])
    statements += [
        Statement(
            f"tension_window_{layer}",
            ("C50", "C71"),
            f"For {start[0]:.10g} < R < {float(end['window_end']):.10g} no tension makes a wave grow with DNI at rest at {inside.count('none')} of {len(inside)} R; from there on a wave near kh = {float(end['kh']):.3g} grows at high tension "
            f"({', '.join(f'sigma/C above {float(end[column]):.4g} at R = {R}' for R, column in zip(p.tensions_at, end.index[2:], strict=True) if end[column] != 'none')}).",
            any(highest != "none" for highest in inside),
            f"{p.decided_kernel} kernel, linear basis, Q = 0; zeros of exact polynomials, and the ranges of stress at R = {', '.join(at)}",
            "exact",
            layer=layer,
            reading=f"{p.derivatives[0]} derivative, {start[0]:.4g} < R < {float(end['window_end']):.4g}",
        )
        for layer in ("as-defined", "consistent")
        if inside
    ]
    return statements


STUDY = Study("Where the verdict on DNI turns", Parameters(), QUICK, compute, judge, draw)
