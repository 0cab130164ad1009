"""Figures of `stability_in_the_plane`."""

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from rkverify.workflow.study import Drawing
from rkverify.workflow.style import LINES, new_figure

if TYPE_CHECKING:
    import pandas as pd

SETTING = "λ = μ = 1, ρ = 1, spacing 1, cubic kernel, linear basis, Truesdell rate, cell measures from the moving cells (all ours)"
PI_TICKS = ([-np.pi, 0, np.pi], ["−π", "0", "π"])


def draw_growth(growth: "pd.DataFrame", states: Sequence[str], stress: float, waves: int) -> Drawing:
    """Largest growth over the support ratio, lattices in rows and stresses in columns."""
    lattices, methods = list(dict.fromkeys(growth["lattice"])), list(dict.fromkeys(growth["method"]))
    figure = new_figure(10.0, 2.9 * len(lattices) + 0.6)
    panels = figure.subplots(len(lattices), len(states), sharex=True, sharey=True, squeeze=False)
    for row, name in zip(panels, lattices, strict=True):
        for axes, state in zip(row, states, strict=True):
            for style, marker, method in zip(LINES, "os^D", methods, strict=False):
                part = growth[(growth["lattice"] == name) & (growth["state"] == state) & (growth["method"] == method)]
                x = [float(Fraction(R)) for R in part["support_ratio"]]
                axes.plot(x, part["growth"], marker=marker, markersize=3, label=method, **style)
            axes.set_yscale("symlog", linthresh=0.1, linscale=0.6)
            axes.set_ylim(-0.01, 6)
            axes.set_yticks([0, 0.1, 0.3, 1, 3], ["0", "0.1", "0.3", "1", "3"])
            axes.set_title(f"{name}, {state}", fontsize=9)
        row[0].set_ylabel("largest growth  (1/time)")
    for axes in panels[-1]:
        axes.set_xlabel("support ratio R  (1)")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(methods))
    words = []
    for method in methods:
        part = growth[(growth["method"] == method) & (growth["state"] != "no stress")]
        words.append(f"{method} grows in {int((part['growth'] > 0).sum())} of {len(part)} settings under stress")
    caption = (
        f"Largest growth over the waves that fit into {waves} by {waves} nodes, over the support ratio, under a stress of {stress:g} in size; linear below 0.1, "
        f"logarithmic above. {SETTING}."
    )
    return Drawing(
        figure,
        caption,
        f"{'; '.join(words)}. {_driven(growth, states)}",
    )


def _driven(growth: "pd.DataFrame", states: Sequence[str]) -> str:
    """In how many settings each stress drives a growth."""
    parts = [growth[growth["state"] == state] for state in states]
    words = [
        f"{state} {int((part['growth'] > 0).sum())} of {len(part)}" for state, part in zip(states, parts, strict=True)
    ]
    return f"By stress, all methods together: {', '.join(words)}."


def _longest(zone: "pd.DataFrame") -> str:
    """The longest of the drawn waves that grow."""
    grows = zone[zone["growth"] > 0]
    size = np.hypot(grows["kx"], grows["ky"])
    every = np.hypot(zone["kx"], zone["ky"])
    shortest = f"the longest wave that grows has |k| = {size.min():.2g}" if len(grows) else "no wave grows"
    return f"Of waves from |k| = {every[every > 0].min():.2g} on {shortest}"


def draw_zone(zone: "pd.DataFrame", states: Sequence[str], ratio: str, stress: float) -> Drawing:
    """Growth over half the Brillouin zone, methods in rows and stresses in columns."""
    from matplotlib import colormaps
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import BoundaryNorm

    methods = list(dict.fromkeys(zone["method"]))
    figure = new_figure(10.0, 2.0 * len(methods) + 0.5)
    panels = figure.subplots(len(methods), len(states), sharex=True, sharey=True, squeeze=False)
    levels = np.array([1e-3, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0])
    colours = colormaps["cividis_r"].with_extremes(under="#FFFFFF")
    steps = BoundaryNorm(levels, colours.N, extend="both")
    half = float(np.diff(np.unique(zone["ky"])).min()) / 2
    corners = half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    shown: Any = None
    for row, method in zip(panels, methods, strict=True):
        for axes, state in zip(row, states, strict=True):
            part = zone[(zone["method"] == method) & (zone["state"] == state)]
            grows = part[part["growth"] >= levels[0]]
            centres = grows[["kx", "ky"]].to_numpy()
            shown = PolyCollection(centres[:, None] + corners, array=grows["growth"], norm=steps, cmap=colours)
            axes.add_collection(shown)
            axes.set(xlim=(-np.pi - half, np.pi + half), ylim=(-half, np.pi + half))
            axes.set_title(f"{method}, {state}: up to {part['growth'].max():.2g}", fontsize=9)
            axes.set_aspect("equal")
            axes.set_xticks(*PI_TICKS)
            axes.set_yticks([0, np.pi], ["0", "π"])
            axes.grid(False)
        row[0].set_ylabel("ky  (rad)")
    for axes in panels[-1]:
        axes.set_xlabel("kx  (rad)")
    figure.colorbar(shown, ax=panels, label="growth  (1/time)", shrink=0.8)
    caption = (
        f"Growth over half the Brillouin zone of the square lattice, R = {ratio}, stress {stress:g}; waves k and −k grow alike; white: "
        f"growth below {levels[0]:g}. {SETTING}."
    )
    top = zone.loc[zone["growth"].idxmax()]
    peaks = "; ".join(
        f"{method}, {state}: {part['growth'].max():.2g} at ({part.loc[part['growth'].idxmax(), 'kx']:.2f}, {part.loc[part['growth'].idxmax(), 'ky']:.2f})"
        for (method, state), part in zone.groupby(["method", "state"], sort=False)
        if part["growth"].max() > 0
    )
    return Drawing(
        figure,
        caption,
        f"The largest growth of all methods and stresses is {top['growth']:.2g}, with {top['method']} in {top['state']} at ({top['kx']:.2f}, {top['ky']:.2f}). "
        f"Where growth is largest in the zone: {peaks or 'nowhere'}. {_longest(zone)}.",
    )


def draw_modes(strain: "pd.DataFrame", drawn: "pd.DataFrame", zero: "pd.DataFrame", ratio: str) -> Drawing:
    """The least strain of waves, and three of the modes that have none."""
    methods, modes = list(dict.fromkeys(strain["method"])), list(dict.fromkeys(drawn["mode"]))
    figure = new_figure(10.0, 5.6)
    top, bottom = figure.subfigures(2, 1, height_ratios=[1, 1], squeeze=False)[:, 0]
    panels = top.subplots(1, len(methods), sharey=True, squeeze=False)[0]
    shown: Any = None
    for axes, method in zip(panels, methods, strict=True):
        square = strain[strain["method"] == method].pivot(index="ky", columns="kx", values="strain")
        shown = axes.contourf(
            square.columns, square.index, square, levels=np.linspace(0, 1.2, 13), cmap="Greys", extend="max"
        )
        none = strain[(strain["method"] == method) & (strain["strain"] == 0)]
        axes.plot(none["kx"], none["ky"], "o", color=LINES[2]["color"], markersize=5, clip_on=False, zorder=5)
        axes.set_title(method, fontsize=9)
        axes.set_aspect("equal")
        axes.set_xticks([0, np.pi], ["0", "π"])
        axes.set_yticks([0, np.pi], ["0", "π"])
        axes.set_xlabel("kx  (rad)")
        axes.grid(False)
    panels[0].set_ylabel("ky  (rad)")
    top.colorbar(shown, ax=panels, label="least strain  (1/length)", shrink=0.8)
    for axes, mode in zip(bottom.subplots(1, len(modes), sharey=True), modes, strict=True):
        part = drawn[drawn["mode"] == mode]
        axes.plot(part["x"], part["y"], "o", color="#FFFFFF", markeredgecolor="#808080", markersize=5)
        axes.quiver(part["x"], part["y"], part["ux"], part["uy"], angles="xy", scale_units="xy", scale=1, width=0.008)
        axes.plot(part["x"] + part["ux"], part["y"] + part["uy"], "o", color="#000000", markersize=4)
        axes.set_title(f"k = {mode}", fontsize=9)
        axes.set_aspect("equal")
        axes.set_xlabel("x  (length)")
        axes.grid(False)
    bottom.axes[0].set_ylabel("y  (length)")
    square_rows = zero[zero["nodes"] == "square"]
    counted = "; ".join(
        f"{m} {int(part['without_strain'].max())}" for m, part in square_rows.groupby("method", sort=False)
    )
    caption = (
        f"Above: the least strain that any cell sees of a wave of unit amplitude, square lattice, R = {ratio}, no stress; dots: waves without any, the origin being "
        "a translation. Below: three of these modes, nodes at rest (open) and displaced (full). Everything is ours."
    )
    edge = strain[(strain["kx"] == strain["kx"].max()) | (strain["ky"] == strain["ky"].max())]
    corners = edge[edge["kx"].isin((0, strain["kx"].max())) & edge["ky"].isin((0, strain["ky"].max()))]
    alternating = {m: bool((corners[corners["method"] == m]["strain"] == 0).all()) for m in methods}
    along = "; ".join(
        f"{m} {int((part['strain'] == 0).sum())} of {len(part)}" for m, part in edge.groupby("method", sort=False)
    )
    return Drawing(
        figure,
        caption,
        f"Waves that change sign from node to node have no strain in {sum(alternating.values())} of {len(methods)} nodal integrations. "
        f"Waves without strain along the edge of the square zone: {along}. Modes without strain, translations left out: {counted}.",
    )


def draw_clouds(clouds: "pd.DataFrame", states: Sequence[str], ratio: str, stress: float, seeds: int) -> Drawing:
    """Growth of finite sets over the jitter."""
    methods = list(dict.fromkeys(clouds["method"]))
    figure = new_figure(10.0, 3.6)
    panels = figure.subplots(1, len(states), sharey=True)
    for axes, state in zip(panels, states, strict=True):
        for style, marker, method in zip(LINES, "os^D", methods, strict=False):
            part = clouds[(clouds["state"] == state) & (clouds["method"] == method)]
            x = [float(Fraction(j)) for j in part["jitter"]]
            axes.plot(x, part["largest"], marker=marker, label=method, **style)
            axes.fill_between(x, part["least"], part["largest"], color=style["color"], alpha=0.15, linewidth=0)
            axes.plot(
                [-0.02],
                part["lattice"].iloc[:1],
                marker=marker,
                color=style["color"],
                fillstyle="none",
                linestyle="none",
            )
        axes.set_yscale("symlog", linthresh=1e-3, linscale=0.4)
        axes.set_ylim(-2e-4, 4)
        axes.set(xlabel="nodes off the lattice by up to …  (length)", title=state)
    panels[0].set_ylabel("largest growth  (1/time)")
    panels[-1].legend(fontsize=8, loc="center right")
    caption = (
        f"Largest growth of {int(clouds['nodes'].iloc[0])} free nodes inside a held rim, over how far nodes are off a square lattice, least to largest over {seeds} seeds; open "
        f"marks at the left: the infinite lattice. R = {ratio}, stress {stress:g}; linear below 0.001. {SETTING}."
    )
    words = "; ".join(
        f"{method} up to {part['largest'].max():.2g}, on the lattice {part['lattice'].max():.2g}"
        for method, part in clouds.groupby("method", sort=False)
    )
    return Drawing(
        figure,
        caption,
        f"Growth of finite sets beside that of the lattice: {words}.",
    )
