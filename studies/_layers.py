"""What the second drawings of Figures 4 to 8 have in common: layers side by side, with measured points."""

from collections.abc import Mapping, Sequence
from typing import Any

from rkverify.stability.side_by_side import ANALYTIC, BOUNDS, SEVERAL, Row
from rkverify.workflow.compare import Numeric
from rkverify.workflow.study import Table, Tables, table
from rkverify.workflow.style import LINES, kh_axis, new_figure


def layer_table(rows: Sequence[Row], caption: str) -> Table:
    """The table `layers` of Figures 4 to 8."""
    columns = [
        ("case", "", "integration, derivative, R"),
        ("layer", "", "printed, as-defined, consistent or simulated"),
        ("Q", "1/time", "velocity gradient, c = 1"),
        ("kh", "rad", "wave number times spacing"),
        ("frequency", "1", "largest |Re omega| h/c of the roots"),
        ("growth", "1", "largest -Im omega h/c of the roots"),
        ("uncertain_below", "1", "bound on the uncertainty of a measured growth h/c, 0 where nothing is measured"),
    ]
    why = "double precision: a double root moves by the square root of rounding, a measured one by its uncertainty"
    return table(rows, columns, caption, Numeric(0, BOUNDS[0], why), across="kh")


def draw_layers(tables: Tables, spacing: float, gradients: Sequence[str]) -> Any:
    """For every case a row of frequencies and a row of growths, one column for each layer."""
    frame = tables["layers"].frame
    cases = list(dict.fromkeys(frame["case"]))
    figure = new_figure(10, 0.6 + 3.3 * len(cases))
    blocks = figure.subfigures(len(cases), 1, squeeze=False)[:, 0]
    for block, case in zip(blocks, cases, strict=True):
        block.suptitle(case, fontsize=10, fontweight="bold")
        part = frame[frame["case"] == case]
        axes = block.subplots(2, len(ANALYTIC), sharex=True, sharey="row")
        for column, layer in enumerate(ANALYTIC):
            for line, quantity in enumerate(("frequency", "growth")):
                _panel(axes[line, column], part, layer, quantity, gradients)
            axes[0, column].set_title(layer, fontsize=9)
            _nothing_below(axes[1, column], spacing, gradients)
        axes[0, 0].set_ylabel("|Re ω| h/c  (1)")
        axes[1, 0].set_ylabel("growth h/c  (1)")
        for row in axes:
            top = max(0.15, 1.08 * max(line.get_ydata().max() for a in row for line in a.lines))
            row[0].set_ylim(-0.03 * top, top)
    handles, labels = blocks[0].axes[0].get_legend_handles_labels()
    band, words = blocks[0].axes[len(ANALYTIC)].get_legend_handles_labels()
    keep = [j for j, word in enumerate(words) if word not in labels]
    figure.legend(
        [*handles, *(band[j] for j in keep)],
        [*labels, *(words[j] for j in keep)],
        loc="outside lower center",
        ncols=3,
    )
    return figure


def _panel(axes: Any, part: Any, layer: str, quantity: str, gradients: Sequence[str]) -> None:
    curves = part[part["layer"] == layer]
    for style, Q in zip(LINES, gradients, strict=False):
        line = curves[curves["Q"] == Q]
        axes.plot(line["kh"], line[quantity], label=f"Q = {Q}", **style)
    circles(axes, part[part["layer"] == "simulated"], quantity, "measured, Q = 0")
    kh_axis(axes, "kh  (rad)" if quantity == "growth" else "")


def circles(axes: Any, points: Any, quantity: str, label: str | None) -> None:
    """Measured points."""
    axes.plot(
        points["kh"],
        points[quantity],
        linestyle="",
        marker="o",
        markersize=5,
        markerfacecolor="#FFFFFF",
        markeredgecolor="#000000",
        label=label,
    )


def _nothing_below(axes: Any, spacing: float, gradients: Sequence[str]) -> None:
    largest = max(abs(float(Q)) for Q in gradients) * spacing
    axes.axhspan(largest, SEVERAL * largest, color="#EDEDED", linewidth=0, label=f"growth ≤ {SEVERAL}|Q|: left open")
    axes.axhspan(0, largest, color="#CDCDCD", linewidth=0, label="growth ≤ |Q|: decides nothing")


def largest(tables: Tables, case: str, layer: str, Q: str, quantity: str) -> float:
    """The largest frequency or growth of a curve."""
    return float(_curve(tables, case, layer, Q)[quantity].max())


def _curve(tables: Tables, case: str, layer: str, Q: str) -> Any:
    frame = tables["layers"].frame
    return frame[(frame["case"] == case) & (frame["layer"] == layer) & (frame["Q"] == Q)]


def gap(tables: Tables, case: str, layer: str, other: str, Q: str) -> float:
    """The largest difference in frequency or growth between two layers at the kh that both have."""
    one, two = (_curve(tables, case, name, Q).set_index("kh") for name in (layer, other))
    both = one.index.intersection(two.index)
    values = ["frequency", "growth"]
    return float((one.loc[both, values] - two.loc[both, values]).abs().to_numpy().max())


def within(value: float) -> str:
    """A difference, or the bound that the table is compared with where it is below."""
    return f"{value:.3g}" if value > BOUNDS[0] else f"less than {BOUNDS[0]:g}"


def at_rest_sentences(tables: Tables) -> str:
    """What differs between the layers at Q = 0, case by case."""
    said = []
    for case in dict.fromkeys(tables["layers"].frame["case"]):
        print_grows, method_grows, seen = (
            largest(tables, case, layer, "0", "growth") for layer in ("printed", "as-defined", "simulated")
        )
        said.append(
            f"{case}: the print {_grows(print_grows)}, the method {_grows(method_grows)}, at the measured points the computation {_grows(seen)}; measured points and method differ by "
            f"{within(gap(tables, case, 'as-defined', 'simulated', '0'))}, print and method by {within(gap(tables, case, 'printed', 'as-defined', '0'))}"
        )
    cases = list(dict.fromkeys(tables["layers"].frame["case"]))
    apart, measured, printed = (
        within(max(gap(tables, case, "as-defined", layer, "0") for case in cases))
        for layer in ("consistent", "simulated", "printed")
    )
    return (
        f"Without a velocity gradient the method is off what was measured by {measured} of c/h, the print off the method by {printed}. "
        f"Case by case, in units of c/h, as-defined and consistent differing by {apart}: {'; '.join(said)}."
    )


def _grows(growth: float) -> str:
    return f"grows at up to {growth:.3g}" if growth > 0 else "does not grow"


def growth_sentences(tables: Tables, gradients: Mapping[str, float]) -> str:
    """The largest growth with a velocity gradient, beside |Q|; gradients: Q -> |Q| h/c."""
    said = []
    for case in dict.fromkeys(tables["layers"].frame["case"]):
        for layer in ANALYTIC:
            values = [f"{largest(tables, case, layer, Q, 'growth'):.3g}" for Q, size in gradients.items() if size > 0]
            said.append(f"{case}, {layer}: {' and '.join(values)}")
    moving = [Q for Q, size in gradients.items() if size > 0]
    return f"Largest growth at Q = {' and '.join(moving)}, beside |Q| h/c = {max(gradients.values()):.3g}: {'; '.join(said)}."
