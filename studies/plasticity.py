"""Path dependence: a Lagrangian body of J2 plasticity under cycles, against the material point, a closed form, and the elastic tangent."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from rkverify.certify.mechanics import cyclic, holed_plate
from rkverify.certify.mechanics.patch import MODULI
from rkverify.certify.mechanics.specimens import square
from rkverify.certify.order import observed
from rkverify.solid.materials.neo_hookean import NeoHookean
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Drawing, Statement, Study, Tables, rounding, table
from rkverify.workflow.style import LINES, new_figure

if TYPE_CHECKING:
    import pandas as pd

PASSED = 1e-11
"""Of mu or 1: rounding of some tens of load steps, each times the condition of the stiffness with flow, some 1e4."""
SOLVED = Numeric(1e-6, 10 * PASSED, "equilibria to rounding times their condition, over some tens of load steps")
QUADRATIC = 1.6
"""The order that Newton's method has to show: 2, less what the steps before the last are short of it."""


@dataclass(frozen=True)
class Parameters:
    """Square: divisions, seed; amplitude and steps of a cycle; stretches and step counts; plate: divisions, elongation, its steps."""

    divisions: int = 5
    seed: int = 20074
    amplitude: float = 0.2
    steps: int = 32
    unloading: int = 6
    stretches: tuple[float, ...] = (1.4, 0.8)
    counts: tuple[int, ...] = (5, 10, 20)
    plate: int = 16
    elongation: float = 0.05
    pulls: int = 10
    newton: int = 12


def compute(p: Parameters) -> Tables:
    """All bodies."""
    body, law = square("jittered", p.divisions, p.seed), cyclic.LAW
    cycles = [
        row for kind in ("tension", "shear") for row in cyclic.against_the_point(body, law, kind, p.amplitude, p.steps)
    ]
    elastic = NeoHookean(MODULI)
    back = cyclic.against_the_point(body, elastic, "tension", p.amplitude, p.steps)[-1]
    released = [
        cyclic.residual_strain(body, each, kind, p.amplitude, p.unloading)
        for kind in ("tension", "shear")
        for each in (law, elastic)
    ]  # fmt: skip
    plate = holed_plate.plate_with_hole(p.plate, law)
    up = [p.elongation * n / p.pulls for n in range(p.pulls + 1)]
    path = [*up[1:], *up[-2::-1], *(-e for e in up[1:]), *(-e for e in up[-2::-1])]
    led = holed_plate.pulled(plate, path)
    end = led[p.pulls - 1][1]
    residuals = holed_plate.tangents_compared(plate, led[p.pulls // 2 - 1][1], path[p.pulls // 2], p.newton)
    loop = [{"elongation": e, "force": force} for e, (force, _) in zip(path, led, strict=True)]
    last = {"elongation": path[-1], "largest_stress": float(abs(led[-1][1].body.state.P).max()) / MODULI.shear}
    return {
        "cycle": table(
            [
                _rounded(row, "stress_difference", "plastic_difference", "yield_function", "off_the_surface")
                for row in cycles
            ],
            [
                ("path", "", "tension: stretches 1 + e and 1 - e/2; shear: e"),
                ("strain", "1", "e"),
                ("stress", "1", "sigma_11 or sigma_12 of the material point over mu"),
                ("plastic_strain", "1", "alpha of the material point"),
                ("stress_difference", "1", f"largest difference in the body, over mu; 0 below {PASSED:g}"),
                ("plastic_difference", "1", "the same of alpha"),
                ("yield_function", "1", "largest f in the body over mu"),
                ("off_the_surface", "1", "largest |f| where plastic strain has grown, over mu"),
            ],
            "A homogeneous body of J2 plasticity along a cycle.",
            SOLVED,
        ),
        "released": table(
            [_rounded(row, "stays", "difference", "stress") for row in released],
            [
                ("path", "", "how it was loaded"),
                ("law", "", "J2 or NeoHookean"),
                ("loaded", "1", "largest component of the Green strain before"),
                ("stays", "1", f"the same after unloading; 0 below {PASSED:g}"),
                ("difference", "1", "largest difference of F in the body from the material point"),
                ("stress", "1", "largest stress left in the body over mu"),
            ],
            "Bodies let go.",
            SOLVED,
        ),
        "uniaxial": table(
            [cyclic.uniaxial(body, p.stretches, count) for count in p.counts],
            [
                ("steps", "1", "load steps from each stretch to the next"),
                ("stress", "1", "sigma_11 in closed form over mu"),
                ("stress_error", "1", "largest error in the body"),
                ("plastic_strain", "1", "alpha in closed form"),
                ("plastic_error", "1", "largest error in the body"),
            ],
            f"Uniaxial strain, stretched to {' and then '.join(f'{s:g}' for s in p.stretches)}.",
            SOLVED,
        ),
        "newton": table(
            residuals,
            [
                ("tangent", "", "consistent with the return, or that of the elastic law"),
                ("step", "1", "of Newton's method"),
                ("residual", "1", "largest residual force over the first one"),
            ],
            "One load step of the plate with a hole.",
            Numeric(1e-3, 1e-11, "residuals above rounding are repeatable; below they are draws"),
        ),
        "loop": table(
            loop,
            [
                ("elongation", "1", "of the plate over half its side"),
                ("force", "1", "on the top over mu times the width"),
            ],
            "Force of the plate with a hole along a cycle.",
            SOLVED,
        ),
        "ends": table(
            [
                {
                    "what": "neo-Hookean square after a cycle",
                    "stress": 0.0 if back["stress_difference"] <= PASSED else back["stress_difference"],
                },
                {"what": "plate with a hole after a cycle", "stress": last["largest_stress"]},
            ],
            [
                ("what", "", "body"),
                ("stress", "1", f"largest stress left at displacement 0, over mu; 0 below {PASSED:g}"),
            ],
            "What is left where the boundary is back in its place.",
            SOLVED,
        ),
        "plate": table(
            holed_plate.cell_corners(plate, end),
            [
                ("cell", "1", "number of the node"),
                ("x", "1", "a corner of its cell"),
                ("y", "1", "the same"),
                ("plastic_strain", "1", "alpha of the node at the largest elongation"),
            ],
            "Plastic strain of the plate with a hole.",
            SOLVED,
        ),
    }


def _rounded(row: cyclic.Row, *names: str) -> cyclic.Row:
    return {**row, **{name: row[name] if abs(row[name]) > PASSED else 0.0 for name in names}}


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Loops, the plate, Newton's residuals."""
    from matplotlib.collections import PolyCollection

    figure = new_figure(7.6, 2.9)
    loops, plate, newton = figure.subplots(1, 3, width_ratios=(1, 1.3, 1))
    cycle, residuals, cells = (tables[name].frame for name in ("cycle", "newton", "plate"))
    for n, (name, component) in enumerate((("tension", "σ₁₁"), ("shear", "σ₁₂"))):
        part = cycle[cycle["path"] == name]
        loops.plot([0, *part["strain"]], [0, *part["stress"]], **LINES[n], label=f"{name}, {component}")
    loops.set(xlabel="strain e  (1)", ylabel="stress / μ  (1)", title="homogeneous")
    loops.legend(fontsize=7, loc="upper left")
    groups = [group for _, group in cells.groupby("cell")]
    shown = PolyCollection(
        [group[["x", "y"]].to_numpy() for group in groups],
        array=np.array([group["plastic_strain"].iloc[0] for group in groups]),
        cmap="cividis_r", edgecolors="#FFFFFF", linewidths=0.3,
    )  # fmt: skip
    plate.add_collection(shown)
    plate.set(
        xlim=(-1.02, 1.02),
        ylim=(-1.02, 1.02),
        aspect="equal",
        xlabel="X₁ / half side  (1)",
        ylabel="X₂ / half side  (1)",
        title="plate with a hole",
    )
    plate.grid(False)
    figure.colorbar(shown, ax=plate, label="plastic strain α  (1)", shrink=0.75)
    for n, (_, part) in enumerate(residuals.groupby("tangent", sort=True)):
        newton.plot(part["step"], part["residual"].clip(lower=1e-16), **LINES[2 * n], marker="os"[n], ms=4)
    newton.set(
        yscale="log", ylim=(1e-16, 3), xlabel="Newton step  (1)", ylabel="residual / first  (1)", title="one load step"
    )
    # A legend would cover one of the two curves: each has its name beside it.
    for n, (name, place) in enumerate((("consistent\ntangent", (5.6, 1e-7)), ("elastic tangent", (4.2, 6e-3)))):
        newton.text(*place, name, fontsize=7, color=LINES[2 * n]["color"], va="center")
    caption = (
        f"J2 plasticity with Jaumann's rate, SCNI in the reference configuration, order 1, cubic kernel, supports {cyclic.SUPPORT_RATIO} spacings, yield "
        f"stress {cyclic.YIELD:g} and hardening {cyclic.HARDENING:g} (mu = {MODULI.shear:g}, lambda = {MODULI.lame:g}), plane strain. Left: one cycle of a square with jittered nodes. Middle: "
        f"top and bottom apart by {p.elongation:g}. All parameters are ours."
    )
    largest = float(cells["plastic_strain"].max())
    steps = int(residuals[residuals["tangent"] == "consistent"]["step"].max())
    left = float(residuals[residuals["tangent"] == "elastic"]["residual"].iloc[-1])
    ends = residuals[residuals["tangent"] == "consistent"]["residual"].iloc[-1]
    middle = cells.groupby("cell")[["x", "y", "plastic_strain"]].mean()
    off = np.hypot(middle["x"], middle["y"])
    half = off[middle["plastic_strain"] > largest / 2]
    alternative = (
        f"{_loops(cycle)}. Plastic strain reaches {largest:.2g} in the cell {off[middle['plastic_strain'].idxmax()]:.2g} half sides from the middle of the plate; the {len(half)} of {len(middle)} cells with more "
        f"than half of it are {half.min():.2g} to {half.max():.2g} half sides away. With the consistent tangent Newton's residual is {rounding(ends)} of the first or less after "
        f"{steps} steps; with the elastic one {left:.0e} of it is left after {int(residuals['step'].max())}."
    )
    return {"plasticity": Drawing(figure, caption, alternative)}


def _loops(cycle: "pd.DataFrame") -> str:
    """Stress where the path turns, the second turn beside the first, and what is left where the strain is back at zero."""
    words = []
    for path, part in cycle.groupby("path", sort=False):
        first, second = (part.loc[part["strain"].idxmax(), "stress"], part.loc[part["strain"].idxmin(), "stress"])
        grown = f"grows from {first:.2g} to {abs(second):.2g} μ" if abs(second) > abs(first) else f"does not grow ({first:.2g} and {abs(second):.2g} μ)"  # fmt: skip
        words.append(f"in {path} it {grown} and is {part['stress'].iloc[-1]:.2g} μ at the end")
    return f"Stress from the first turn of a cycle to the second: {', '.join(words)}"


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """C14: known states, memory, and Newton's method."""
    cycle, released, uniaxial, newton, ends = (
        tables[name].frame for name in ("cycle", "released", "uniaxial", "newton", "ends")
    )
    same = bool((cycle[["stress_difference", "plastic_difference"]] == 0).all().all())
    within = bool((cycle["yield_function"] <= 0).all() and (cycle["off_the_surface"] == 0).all())
    plastic, elastic = (released[released["law"] == name] for name in ("J2", "NeoHookean"))
    free = bool((released[["difference", "stress"]] == 0).all().all())
    order = observed([1 / n for n in uniaxial["steps"]], list(uniaxial["stress_error"]))
    left = ends.set_index("what")["stress"]
    square_at_rest, plate_at_rest = float(left.iloc[0]), float(left.iloc[1])
    consistent, other = (newton[newton["tangent"] == name]["residual"].tolist() for name in ("consistent", "elastic"))
    fastest = _order(consistent)
    tried = f"square with {(p.divisions + 1) ** 2} jittered nodes, {p.steps} steps, strains up to {p.amplitude:g}"
    return [
        Statement(
            "known_states",
            ("C14",),
            f"A body under SCNI that is led through a cycle of tension and compression, or of shear, has in every cell the stress and the plastic strain (up to {cycle['plastic_strain'].max():.2g}) of the "
            f"material point alone, to {PASSED:g}; no stress is outside the yield surface, and f = 0 where it flows. A stretch to {' and back to '.join(f'{s:g}' for s in p.stretches)} has the closed form "
            f"with an error that falls with order {order.last:.2f} in the step (rule: within 0.35 of 2), to {uniaxial['stress_error'].iloc[-1]:.1e} mu.",
            same and within and order.reaches(2.0),
            tried,
            "sampled",
            float(uniaxial["stress_error"].iloc[-1]),
            "error against the closed form over mu, with the most steps",
        ),
        Statement(
            "memory",
            ("C14",),
            f"Let go, the plastic body keeps a strain of {plastic['stays'].min():.3g} (of {plastic['loaded'].max():.3g}) and no stress, as the material point does; the neo-Hookean one keeps none, and no stress after a cycle "
            f"({square_at_rest:g}), while the plate with a hole is left with stresses of {plate_at_rest:.3g} mu.",
            free
            and bool((plastic["stays"] > 0.1 * p.amplitude).all())
            and bool((elastic["stays"] == 0).all())
            and square_at_rest == 0.0 < plate_at_rest,
            f"{tried}; plate with a hole, {p.plate} spacings a side, elongation {p.elongation:g}",
            "sampled",
            float(plastic["stays"].min()),
            "least strain that stays",
        ),
        Statement(
            "newton",
            ("C14",),
            f"With the tangent that is consistent with the return Newton's residuals fall with order {fastest:.2f} to rounding in {len(consistent) - 1} steps; with the elastic tangent the order is "
            f"{_order(other):.2f}, and {other[-1]:.1e} is left after {len(other) - 1}.",
            fastest >= QUADRATIC > _order(other) and other[-1] > 1e-6,
            f"plate with a hole, {p.plate} spacings a side, one load step amid plastic flow",
            "sampled",
            fastest - QUADRATIC,
            "order above what is asked for",
        ),
    ]


def _order(residuals: Sequence[float]) -> float:
    """log(r_(k+1)/r_k)/log(r_k/r_(k-1)) of the last three residuals above rounding."""
    above = [r for r in residuals if r > 1e-13]
    falls = [np.log(b / a) for a, b in pairwise(above)]
    return float(falls[-1] / falls[-2])


STUDY = Study(
    "Path dependence",
    Parameters(),
    Parameters(
        divisions=4,
        steps=8,
        unloading=3,
        amplitude=0.08,
        counts=(4, 8, 16),
        stretches=(1.2,),
        plate=8,
        elongation=0.02,
        pulls=4,
    ),
    compute,
    judge,
    draw,
)
