"""The four drawings of the stability maps, with their alternative texts."""

from fractions import Fraction
from math import isfinite, pi
from typing import Any

from rkverify.stability.side_by_side import ANALYTIC, SEVERAL
from rkverify.workflow.study import Tables
from rkverify.workflow.style import LINES, NEGATIVE, POSITIVE, new_figure, sign_map

SEMI = ("SCNI", "DNI full", "DNI diffuse")
OPEN, NOTHING = "#C8C8C8", "#F4F4F4"
EDGE: dict[str, Any] = {"color": "#000000", "linewidth": 1.6, "linestyle": (0, (4, 2))}


def _ratios(part: Any) -> Any:
    return part["support_ratio"].map(lambda text: float(Fraction(text)))


def _key(figure: Any, *extra: Any, undecided: bool = False) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles: list[Any] = [
        Patch(facecolor=POSITIVE, edgecolor="#000000", label="stable"),
        Patch(facecolor=NEGATIVE, edgecolor="#000000", hatch="////", label="unstable"),
    ]
    if undecided:
        handles[1].set_label(f"unstable (frozen: growth > {SEVERAL}|Q|)")
        handles += [
            Patch(facecolor=OPEN, edgecolor="#000000", label=f"|Q| < growth ≤ {SEVERAL}|Q|: left open"),
            Patch(facecolor=NOTHING, edgecolor="#000000", hatch="..", label="growth ≤ |Q|: decides nothing"),
        ]
    handles.append(Line2D([], [], label="printed boundary", **EDGE))
    figure.legend(handles=[*handles, *extra], loc="outside lower center", ncols=3)


def _zero_line() -> Any:
    from matplotlib.lines import Line2D

    return Line2D([], [], color="#000000", linestyle=":", linewidth=1.2, label="C + σ = 0")


def rest(tables: Tables) -> Any:
    """(R, s) at Q = 0: printed above, linearised below with the printed boundary over it."""
    frame = tables["rest"].frame
    figure = new_figure(10, 6.2)
    for row, prefix in zip(figure.subplots(2, 3, sharex=True, sharey=True), ("printed ", ""), strict=True):
        for axes, name in zip(row, SEMI, strict=True):
            part = frame[frame["formulation"] == prefix + name]
            R, low, high = _ratios(part), part["stable_from"].clip(-2, 2), part["stable_to"].clip(-2, 2)
            axes.fill_between(R, -2, 2, step="mid", facecolor=NEGATIVE, hatch="////", edgecolor="#000000", linewidth=0)
            axes.fill_between(R, low, high, step="mid", facecolor=POSITIVE, edgecolor=POSITIVE, linewidth=0.8)
            printed = frame[frame["formulation"] == "printed " + name]
            for end in ("stable_from", "stable_to"):
                finite = printed[printed[end].map(isfinite)]
                axes.plot(_ratios(finite), finite[end], **EDGE)
            axes.set_title(f"{name}, {'printed' if prefix else 'as-defined = consistent'}", fontsize=9)
            axes.set(xlim=(1, 3.5), ylim=(-2, 2))
            axes.grid(False)
        row[0].set_ylabel("stress  σ/C  (1)")
    for axes in figure.axes[3:]:
        axes.set_xlabel("support ratio  R = a/h  (1)")
    _key(figure)
    return figure


def rest_alternative(tables: Tables) -> str:
    """What the maps at rest show."""
    frame = tables["rest"].frame
    said, first = [], []
    for name in (*(f"printed {n}" for n in SEMI), *SEMI):
        part = frame[frame["formulation"] == name]
        tension = part[part["stable_to"] < 1e-3]["support_ratio"]
        compression = part[part["stable_from"] > -1e-3]["support_ratio"]
        below = part[part["stable_from"] < -1.001]["support_ratio"]
        said.append(
            f"{name}: unstable in any tension at {len(tension)} of {len(part)} support ratios, in any compression at {len(compression)}, "
            f"stable somewhere with C + sigma < 0 at {len(below)}"
        )
    full = frame[frame["formulation"] == "DNI full"]
    sides = full[full["stable_from"] > -1e-3]
    both = full[(full["stable_from"] < -1e-3) & (full["stable_to"] > 1e-3)]
    if len(sides):
        first.append(
            f"With the full derivative any compression is unstable at {len(sides)} of {len(full)} R, from {_ratios(sides).min():.4g} to {_ratios(sides).max():.4g}"
        )
    if len(both):
        where = ", ".join(f"{R:g}" for R in _ratios(both))
        first.append(f"neither small tension nor small compression is at R = {where}")
    return f"{'; '.join(first)}{'. ' if first else ''}{'; '.join(said)}."


def waves(tables: Tables, stresses: tuple[str, ...]) -> Any:
    """(R, kh) at Q = 0 for both derivatives and signs of stress."""
    frame = tables["rest_waves"].frame
    figure = new_figure(10, 6)
    panels = [(name, stress) for name in SEMI[1:] for stress in stresses]
    rows = figure.subplots(2, len(panels), sharex=True, sharey=True)
    for row, prefix in zip(rows, ("printed ", ""), strict=True):
        for axes, (name, stress) in zip(row, panels, strict=True):
            x, y, field = _square(frame, prefix + name, stress)
            sign_map(axes, x, y, field)
            if not prefix:
                x, y, field = _square(frame, "printed " + name, stress)
                if field.min() < 0 < field.max():
                    axes.contour(x, y, field, levels=[0], colors=["#000000"], linewidths=[1.6], linestyles=["--"])
            axes.set_title(f"{name}, σ/C = {stress}\n{'printed' if prefix else 'as-defined = consistent'}", fontsize=9)
            axes.set(xlim=(1, 3.5), ylim=(0, pi))
            axes.set_yticks([0, pi / 4, pi / 2, 3 * pi / 4, pi], ["0", "π/4", "π/2", "3π/4", "π"])
        row[0].set_ylabel("kh  (rad)")
    for axes in rows[1]:
        axes.set_xlabel("R  (1)")
    _key(figure)
    return figure


def _square(frame: Any, name: str, stress: str) -> tuple[Any, Any, Any]:
    part = frame[(frame["formulation"] == name) & (frame["stress_ratio"] == stress)]
    square = part.assign(R=_ratios(part)).pivot(index="kh", columns="R", values="omega_squared")
    return square.columns.to_numpy(), square.index.to_numpy(), square.to_numpy()


def waves_alternative(tables: Tables, stresses: tuple[str, ...]) -> str:
    """The share of unstable points in every panel."""
    frame = tables["rest_waves"].frame
    said = []
    for prefix in ("printed ", ""):
        for name in SEMI[1:]:
            for stress in stresses:
                part = frame[(frame["formulation"] == prefix + name) & (frame["stress_ratio"] == stress)]
                said.append(f"{prefix}{name} at sigma/C = {stress}: {(part['omega_squared'] < 0).mean():.3g}")
    return (
        f"Share of the points (R, kh) with omega^2 < 0, for R < 2 in print and up to 3.5 linearised: {'; '.join(said)}."
    )


def moving(tables: Tables) -> Any:
    """(Q h, s) for every case, one row for each layer."""
    frame = tables["moving"].frame
    cases = list(dict.fromkeys(frame["case"]))
    figure = new_figure(10, 8)
    rows = figure.subplots(len(ANALYTIC), len(cases), sharex=True, sharey=True, squeeze=False)
    for row, layer in zip(rows, ANALYTIC, strict=True):
        for axes, case in zip(row, cases, strict=True):
            x, y, printed = _square_of(frame, case, "printed", "discriminant")
            axes.axhline(-1, color="#FFFFFF", linewidth=2.2, zorder=2)
            axes.axhline(-1, color="#000000", linewidth=1.2, linestyle=":", zorder=2.1)
            if layer == "printed":
                sign_map(axes, x, y, printed)
            else:
                _, _, growth = _square_of(frame, case, layer, "growth")
                colors, hatches = [NOTHING, OPEN, NEGATIVE], ["..", None, "////"]
                axes.contourf(x, y, growth / abs(x), levels=[-1.0, *BORDERS, 1e9], colors=colors, hatches=hatches)
                axes.contour(x, y, growth / abs(x), levels=BORDERS, colors=["#000000"], linewidths=[0.8])
                dashes = {"colors": ["#000000"], "linewidths": [1.6], "linestyles": ["--"], "zorder": 3}
                axes.contour(x, y, printed, levels=[0], **dashes)
            axes.set_title(f"{case}\n{layer}", fontsize=8.5)
            axes.grid(False)
        row[0].set_ylabel("stress  σ/C  (1)")
    for axes in rows[-1]:
        axes.set_xlabel("Q h/c  (1)")
    _key(figure, _zero_line(), undecided=True)
    return figure


BORDERS = [1.001, 1.001 * SEVERAL]
"""|Q| itself and SEVERAL |Q|, by a thousandth more: a growth of exactly |Q|, which is common, is not above |Q|."""


def _square_of(frame: Any, case: str, layer: str, quantity: str) -> tuple[Any, Any, Any]:
    part = frame[(frame["case"] == case) & (frame["layer"] == layer)]
    square = part.pivot(index="stress_ratio", columns="Q", values=quantity)
    return square.columns.to_numpy(), square.index.to_numpy(), square.to_numpy()


def moving_alternative(tables: Tables) -> str:
    """Shares of the classes for every layer and case, and what each layer says of stress that the continuum stands."""
    frame = tables["moving"].frame
    said = []
    for case in dict.fromkeys(frame["case"]):
        for layer in ANALYTIC:
            part = frame[(frame["case"] == case) & (frame["layer"] == layer)]
            least = 0.0 if layer == "printed" else SEVERAL
            unstable = part["growth"] > least * part["Q"].abs()
            sound = part["stress_ratio"] >= -1
            said.append(
                f"{case}, {layer}: {unstable[sound].mean():.2g} where C + sigma >= 0 and {unstable[~sound].mean():.2g} where C + sigma < 0"
            )
    return f"Share of the points (Q h, sigma/C) that are called unstable: {'; '.join(said)}."


DRAWN = ("Lagrangian SCNI", "Lagrangian DNI", "SCNI", "DNI full", "DNI diffuse", "printed SCNI", "printed DNI full")
STYLES: tuple[dict[str, Any], ...] = (*LINES, {"color": "#808080", "linestyle": "-"})


def steps(tables: Tables, stresses: tuple[str, ...]) -> Any:
    """dt c/h over R, one panel for each stress."""
    frame = tables["critical_step"].frame
    figure = new_figure(10, 4.6)
    for axes, stress in zip(figure.subplots(1, len(stresses), sharey=True), stresses, strict=True):
        for style, name in zip(STYLES, DRAWN, strict=True):
            part = frame[(frame["formulation"] == name) & (frame["stress_ratio"] == stress)]
            R, grows = _ratios(part), part["least_squared"] < 0
            axes.plot(R, part["critical_step"].where(~grows), label=name, **style)
            axes.plot(
                R,
                part["critical_step"].where(grows),
                **{**style, "linewidth": 0.6},
                marker="x",
                markersize=4,
                markevery=6,
            )
        axes.set(xlabel="support ratio  R = a/h  (1)", xlim=(1, 3.5), ylim=(1.4, 3.6))
        axes.set_title(f"σ/C = {stress}", fontsize=9)
    figure.axes[0].set_ylabel("critical time step  Δt c/h  (1)")
    figure.legend(*figure.axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def steps_alternative(tables: Tables, stresses: tuple[str, ...]) -> str:
    """The range of critical steps of every formulation."""
    frame = tables["critical_step"].frame
    said, without = [], []
    for stress in stresses:
        for name in DRAWN:
            part = frame[(frame["formulation"] == name) & (frame["stress_ratio"] == stress)]
            grows = part["least_squared"] < 0
            step = part["critical_step"][~grows]
            span = f"{step.min():.3g} to {step.max():.3g}" if len(step) else "no step is stable"
            unstable = f", every step grows at {int(grows.sum())} of {len(part)} R" if grows.any() and len(step) else ""
            said.append(f"{name} at sigma/C = {stress}: {span}{unstable}")
            if grows.any():
                without.append(f"{name} at sigma/C = {stress} ({int(grows.sum())} of {len(part)} R)")
    none = f", but not {', '.join(without)}" if without else ""
    return f"Every formulation has a stable time step at every support ratio{none}. Critical steps dt c/h: {'; '.join(said)}."
