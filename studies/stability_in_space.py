"""Plane waves on the stressed simple cubic lattice: growth of DNI, SCNI and SNNI along three directions and over the zone, beside the chain."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from rkverify.stability.bloch import surveys_in_space as surveys
from rkverify.stability.bloch.surveys import Method
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

if TYPE_CHECKING:
    import pandas as pd

SCNI = Method("scni")
SETTING = "λ = μ = 1, ρ = 1, spacing 1, cubic kernel, radial window, linear basis, Truesdell rate, cell measures from the moving cells (all ours)"


@dataclass(frozen=True)
class Parameters:
    """Methods, support ratios, size of the stress in units of mu = lambda, waves per direction; the bound is at one ratio."""

    methods: tuple[Method, ...] = (Method("dni"), Method("dni", "diffuse"), Method("snni"), SCNI)
    support_ratios: tuple[str, ...] = (*(f"{n / 10:.1f}" for n in range(12, 25)), "2.6", "2.8", "3.0")
    stress: float = 0.3
    waves: int = 8
    ratio: str = "1.7"
    shares: tuple[float, ...] = (0.9, 0.99, 1.01, 1.1)

    @property
    def on_chain(self) -> list[Method]:
        """Those that the chain has: boxes of SNNI would be its cells."""
        return [method for method in self.methods if method.integration != "snni"]


GROWS = Numeric(1e-6, 1e-6, "eigenvalues in double precision; a double root moves by the square root of rounding")
METHOD = ("method", "", "integration with its derivative")
RATIO = ("support_ratio", "1", "support radius over spacing")
STATE = ("state", "", "stress, of the size that the caption names")


def compute(p: Parameters) -> Tables:
    """Growth in space, the chain beside it, and the compression that SCNI bears."""
    size = f"stress {p.stress:g}, lambda = mu = 1"
    return {
        "growth": table(
            surveys.growth_rows(p.methods, p.support_ratios, p.stress, p.waves),
            [
                METHOD,
                RATIO,
                STATE,
                *((name, "1/time", f"largest growth of waves along {name}") for name in surveys.DIRECTIONS),
                ("zone", "1/time", "largest growth over all waves"),
                *((name, "rad/length", "wave vector of that growth, 0 for none") for name in ("kx", "ky", "kz")),
            ],
            f"Largest growth over the waves that fit into {p.waves} by {p.waves} by {p.waves} nodes, and over {p.waves} along each direction; {size}, Truesdell, measures from edges.",
            GROWS,
        ),
        "chain": table(
            surveys.chain_rows(p.on_chain, p.support_ratios, p.stress, p.waves),
            [
                METHOD,
                RATIO,
                STATE,
                ("chain", "1/time", "largest growth on the chain, modulus lambda + 2 mu"),
                *(
                    (name, "1", f"largest |omega^2 - chain's| over lambda + 2 mu of longitudinal waves along x, {name} window")
                    for name in ("tensor", "radial")
                ),
            ],
            f"The chain beside space; {size}.",
            GROWS,
        ),
        "bound": table(
            surveys.bound_rows(p.ratio, p.waves, p.shares),
            [("share", "1", "compression over mu"), ("growth", "1/time", "largest growth")],
            f"SCNI under large compression along x, R = {p.ratio}, Truesdell.",
            GROWS,
        ),
    }  # fmt: skip


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Largest growth over the support ratio: the zone and three directions, and the chain."""
    growth, chain = tables["growth"].frame, tables["chain"].frame
    states = ("tension", "compression")
    figure = new_figure(10.0, 5.4)
    panels = figure.subplots(len(states), len(p.methods), sharex=True, sharey=True, squeeze=False)
    curves = ["zone", *surveys.DIRECTIONS]
    for row, state in zip(panels, states, strict=True):
        for axes, method in zip(row, p.methods, strict=True):
            part = _of(growth, method.name, state)
            x = [float(Fraction(R)) for R in part["support_ratio"]]
            for style, marker, name in zip(LINES, "os^D", curves, strict=False):
                words = "all waves" if name == "zone" else f"along {name}"
                axes.plot(x, part[name], marker=marker, markersize=3, label=words, **style)
            line = _of(chain, method.name, state)["chain"]
            if len(line):
                axes.plot(x, line, marker="x", markersize=4, label="chain", **LINES[4])
            axes.set_yscale("symlog", linthresh=0.1, linscale=0.6)
            axes.set_ylim(-0.01, 6)
            axes.set_yticks([0, 0.1, 0.3, 1, 3], ["0", "0.1", "0.3", "1", "3"])
            axes.set_title(f"{method.name}, {state}", fontsize=9)
        row[0].set_ylabel("largest growth  (1/time)")
    for axes in panels[-1]:
        axes.set_xlabel("support ratio R  (1)")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(curves) + 1)
    words = "; ".join(
        f"{method.name}, {state}: in space {_count(_of(growth, method.name, state)['zone'])}"
        + (f", on the chain {_count(_of(chain, method.name, state)['chain'])}" if method in p.on_chain else "")
        for method in p.methods
        for state in states
    )
    caption = (
        f"Largest growth on the simple cubic lattice over the support ratio under a stress of {p.stress:g} along x, of waves that fit into {p.waves} nodes along "
        f"each axis and of {p.waves} along an edge, a face's and the cube's diagonal; the chain has the modulus λ + 2μ; linear below 0.1, logarithmic above. {SETTING}."
    )
    first = ", ".join(
        f"{_count(growth[(growth['method'] == method.name) & growth['state'].isin(states)]['zone'])} with {method.name}"
        for method in p.methods
    )
    alternative = f"Over support ratios and both signs of stress a wave in space grows in {first}. At these support ratios: {words}."
    return {"growth": Drawing(figure, caption, alternative)}


def _of(frame: "pd.DataFrame", method: str, state: str) -> "pd.DataFrame":
    return frame[(frame["method"] == method) & (frame["state"] == state)]


def _count(growth: "pd.Series") -> str:
    return f"{int((growth > 0).sum())} of {len(growth)}"


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Which verdicts of the chain carry over to three dimensions."""
    growth, chain, bound = (tables[name].frame for name in ("growth", "chain", "bound"))
    span = (
        f"three dimensions: simple cubic lattice, R = {p.support_ratios[0]} to {p.support_ratios[-1]}, stress {p.stress:g} mu along an axis, cubic kernel, radial "
        f"window, linear basis, waves that fit into {p.waves} nodes along each axis"
    )
    found = []
    for method in p.on_chain:
        both = chain[chain["method"] == method.name].merge(growth, on=["method", "support_ratio", "state"])
        same = int(((both["zone"] > 0) == (both["chain"] > 0)).sum())
        grows = "; ".join(
            f"{state}: {_count(part['chain'])} support ratios on the chain, "
            + ", ".join(f"{int((part[name] > 0).sum())} along {name}" for name in surveys.DIRECTIONS)
            + f", {int((part['zone'] > 0).sum())} over all waves"
            for state, part in both.groupby("state", sort=False)
        )
        tensor, radial = float(both["tensor"].max()), both["radial"]
        tail = ""
        if method == SCNI:
            least, most = bound[bound["growth"] == 0]["share"].max(), bound[bound["growth"] > 0]["share"].min()
            whole = growth[growth["method"] == method.name]
            tail = (
                f" Under all {whole['state'].nunique() - 1} stresses and none {int((whole['zone'] > 0).sum())} of {len(whole)} settings grow. Where compression reaches mu a "
                f"shear wave does: none at {least:g} mu, one at {most:g} mu; on the chain that bound is lambda + 2 mu."
            )
        found.append(
            Statement(
                f"chain_{method.name}".replace(" ", "_").lower(),
                ("C74",),
                f"{method.name}: three dimensions have the chain's verdict in {same} of {len(both)} settings. Growth under {grows}. A longitudinal wave along an axis has the chain's "
                f"omega^2 to {rounding(tensor)} with the tensor window; with the radial one it has another in {int((radial > 1e-9).sum())} of {len(radial)} settings, off by up to {radial.max():.2g} (lambda + 2 mu)/(rho h^2).{tail}",
                same == len(both) and tensor < 1e-11,
                span,
                "sampled",
                same / len(both),
                "share of settings with the chain's verdict",
                "as-defined",
                f"three dimensions, {method.name.replace('DNI ', 'DNI, derivative ')}",
            )
        )
    return found


STUDY = Study(
    "Stability in space",
    Parameters(),
    Parameters(support_ratios=("1.4", "1.8"), waves=4),
    compute,
    judge,
    draw,
)
