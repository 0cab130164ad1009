"""Manufactured solutions in small and finite strain: observed orders by integration, edge rule, order and kind of nodes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

from rkverify.certify.mechanics.manufactured import ERRORS, SMOOTHINGS, Case, errors
from rkverify.certify.order import SPREAD, Observed, observed
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, table
from rkverify.workflow.style import LINES, new_figure

EXPECTED = 2.0
"""The order that a method exact for linear fields is hoped to have in L2."""


@dataclass(frozen=True)
class Parameters:
    """Divisions of the unit of length, seed, support ratios of orders 1 and 2, and what is tried."""

    divisions: tuple[int, ...] = (6, 12, 24, 48)
    finite_divisions: tuple[int, ...] = (6, 12, 24)
    seed: int = 20075
    ratios: tuple[float, float] = (2.3, 3.2)
    kinds: tuple[str, ...] = ("uniform", "jittered")
    fine_rule: str = "gauss:4"
    orders: tuple[int, ...] = (1, 2)


def _cases(p: Parameters) -> list[tuple[Case, tuple[int, ...]]]:
    integrations = [("scni", "trapezoid"), ("scni", p.fine_rule), ("dni", p.fine_rule), ("snni", p.fine_rule)]
    small = [
        (Case("linear elastic", integration, rule, order, p.ratios[order - 1], kind), p.divisions)  # type: ignore[arg-type]
        for kind in p.kinds
        for order in p.orders
        for integration, rule in integrations
        if not (order == 2 and integration == "snni")  # corners of boxes leave what supports cover
    ]
    finite = [
        (Case("neo-Hookean", integration, rule, 1, p.ratios[0], kind), p.finite_divisions)  # type: ignore[arg-type]
        for kind in p.kinds
        for integration, rule in integrations[:3]
    ]
    return small + finite


def compute(p: Parameters) -> Tables:
    """Errors over the spacing, and pairwise orders."""
    rows: list[dict[str, Any]] = []
    orders: list[dict[str, Any]] = []
    for case, divisions in _cases(p):
        found = [errors(case, n, p.seed) for n in divisions]
        rows += found
        for error in ERRORS:
            values = [row[error] for row in found]
            seen = observed([row["h"] for row in found], values) if all(map(isfinite, values)) else Observed(())
            orders.append(
                {
                    **{
                        name: found[0][name]
                        for name in ("law", "integration", "rule", "order", "support_ratio", "kind")
                    },
                    "error": error,
                    "pairwise": " ".join(f"{value:.2f}" for value in seen.pairwise),
                    "settled": seen.settled,
                    "last": round(seen.last, 2) if seen.settled else float("nan"),
                }
            )
    what = [
        ("law", "", "the material"),
        ("integration", "", "scni, dni or snni"),
        ("rule", "", "edge rule of SCNI and of the boundary"),
        ("order", "1", "order of the basis"),
        ("support_ratio", "1", "support over spacing"),
        ("kind", "", "how nodes are spread"),
    ]
    why = "linear systems with nearly singular modes of two spacings: rounding times their condition"
    return {
        "errors": table(
            rows,
            [
                *what,
                ("h", "length", "spacing, the side of the square is 1"),
                ("count", "1", "number of nodes"),
                ("displacement", "length", "L2 error at the nodes"),
                ("smoothed", "length", f"the same with the error smoothed {SMOOTHINGS} times by the shape functions"),
                ("gradient", "1", "L2 error of F at the nodes; inf: no equilibrium was found"),
            ],
            "Errors against manufactured solutions.",
            Numeric(1e-4, 1e-10, why),
        ),
        "orders": table(
            orders,
            [
                *what,
                ("error", "", "which of the errors"),
                ("pairwise", "1", "observed order of each pair of spacings, coarse to fine"),
                (
                    "settled",
                    "",
                    f"whether the last two differ by {SPREAD} at most: the rule by which an order is accepted",
                ),
                ("last", "1", "the accepted order; empty where there is none"),
            ],
            "Observed orders, pair by pair.",
            Numeric(0, 0.011, "orders are printed to two decimals"),
        ),
    }


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Errors over h for order 1, uniform and jittered nodes."""
    frame = tables["errors"].frame
    frame = frame[(frame["law"] == "linear elastic") & (frame["order"] == 1)]
    figure = new_figure(9.0, 3.9)
    panels = figure.subplots(1, len(p.kinds), sharey=True, squeeze=False)[0]
    cases = [("scni", "trapezoid"), ("scni", p.fine_rule), ("dni", p.fine_rule), ("snni", p.fine_rule)]
    for axes, kind in zip(panels, p.kinds, strict=True):
        for n, (integration, rule) in enumerate(cases):
            part = frame[(frame["kind"] == kind) & (frame["integration"] == integration) & (frame["rule"] == rule)]
            label = f"{integration.upper()}, {rule}" if integration == "scni" else integration.upper()
            axes.loglog(part["h"], part["displacement"], marker="osD^"[n], markersize=4, label=label, **LINES[n])
            if integration == "scni":
                axes.loglog(part["h"], part["smoothed"], marker="osD^"[n], markersize=4, markerfacecolor="#FFFFFF", alpha=0.8, **{**LINES[n], "linewidth": 0.8})  # fmt: skip
        h = part["h"].to_numpy()
        axes.loglog(h, 0.02 * h**2, color="#999999", linewidth=0.8)
        axes.annotate("h²", (h[-1], 0.02 * h[-1] ** 2), fontsize=8, color="#555555")
        axes.set(title=f"{kind} nodes", xlabel="spacing h  (side of the square = 1)")
        axes.set_xticks(h, [f"1/{n}" for n in p.divisions])
        axes.set_xticks([], minor=True)
    panels[0].set_ylabel("L2 error of the displacement  (length)")
    panels[-1].legend(fontsize=8, title="open, thin: smoothed")
    orders = tables["orders"].frame
    caption = (
        f"Linear elasticity, order 1, cubic kernel, support {p.ratios[0]:g} h, displacements given in the sense of Nitsche on three sides, tractions on "
        "the fourth. All parameters are ours."
    )
    said = []
    for kind in p.kinds:
        scni = [f"{_said(orders, kind=kind, integration='scni', rule=rule, error='smoothed')} with {rule}" for rule in ("trapezoid", p.fine_rule)]  # fmt: skip
        dni = _said(orders, kind=kind, integration="dni", rule=p.fine_rule, error="displacement")
        said.append(f"on {kind} nodes, SCNI: {', '.join(scni)}; DNI: {dni}")
    alternative = f"Smoothed displacements under SCNI, and those under DNI: {'; '.join(said)}."
    return {"manufactured": Drawing(figure, caption, alternative)}


def _chosen(frame: Any, **chosen: Any) -> Any:
    chosen = {"law": "linear elastic", "order": 1, **chosen}
    for name, value in chosen.items():
        frame = frame[frame[name] == value]
    return frame.iloc[0]


def _order(frame: Any, **chosen: Any) -> float:
    """The accepted order, not a number where there is none."""
    return float(_chosen(frame, **chosen)["last"])


def _said(frame: Any, **chosen: Any) -> str:
    row = _chosen(frame, **chosen)
    if not row["pairwise"]:
        return "no equilibrium is found"
    return (
        f"the order is {row['last']:.2f}"
        if row["settled"]
        else f"no order settles ({row['pairwise'].replace(' ', ', ')})"
    )


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Which combinations converge, and how fast."""
    frame = tables["orders"].frame
    tried = f"square, {', '.join(p.kinds)} nodes, h = 1/{p.divisions[0]} to 1/{p.divisions[-1]}; an order is accepted where its last two pairwise values differ by {SPREAD} at most"
    uneven = p.kinds[-1]

    def scni(rule: str, **more: Any) -> dict[str, Any]:
        return {"integration": "scni", "rule": rule, "kind": uneven, "error": "smoothed", **more}

    coarse, fine = _order(frame, **scni("trapezoid")), _order(frame, **scni(p.fine_rule))
    finite = _order(frame, **scni(p.fine_rule, law="neo-Hookean"))
    raw = {kind: _said(frame, **scni(p.fine_rule, error="displacement", kind=kind)) for kind in p.kinds}
    other = {
        i: _said(frame, integration=i, rule=p.fine_rule, kind=uneven, error="displacement") for i in ("dni", "snni")
    }
    fails = {i: _order(frame, integration=i, rule=p.fine_rule, kind=uneven, error="displacement") for i in other}
    return [
        Statement(
            "smooth_part",
            (),
            f"SCNI with the rule {p.fine_rule} on its edges: the smooth part of the displacement converges with order {fine:.2f} in linear elasticity and {finite:.2f} in a neo-Hookean body, on {uneven} nodes.",
            fine >= EXPECTED - SPREAD and finite >= EXPECTED - SPREAD,
            tried,
            "sampled",
            fine - (EXPECTED - SPREAD),
            "order above what the rule accepts as 2",
        ),
        Statement(
            "edge_rule",
            (),
            f"The edge rule does not matter for the patch test and matters for the order: with the trapezoid {_said(frame, **scni('trapezoid'))} on {uneven} nodes, with {p.fine_rule} {_said(frame, **scni(p.fine_rule))}.",
            not coarse >= EXPECTED - SPREAD and fine >= EXPECTED - SPREAD,
            tried,
            "sampled",
        ),
        Statement(
            "two_spacings",
            (),
            f"Without smoothing the error, waves of two spacings that SCNI hardly resists are seen: {'; '.join(f'{kind} nodes: {text}' for kind, text in raw.items())}.",
            not _order(frame, **scni(p.fine_rule, error="displacement")) >= fine,
            tried,
            "sampled",
        ),
        Statement(
            "constraint",
            ("C17",),
            f"Without the integration constraint there is no convergence on {uneven} nodes: DNI: {other['dni']}; SNNI: {other['snni']}.",
            not any(value >= 1 - SPREAD for value in fails.values()),
            tried,
            "sampled",
        ),
    ]


STUDY = Study(
    "Manufactured solutions",
    Parameters(),
    Parameters(divisions=(4, 8, 16), finite_divisions=(4, 8), kinds=("jittered",), orders=(1,)),
    compute,
    judge,
    draw,
)
