"""How figures look: colours that keep apart in grey print and for colour-blind readers, and SVG that is reproducible."""

import re
from collections import Counter
from io import StringIO
from math import pi
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, FigureBase

# Okabe and Ito's palette, ordered from dark to light, each with a dash of its own.
LINES: tuple[dict[str, Any], ...] = (
    {"color": "#000000", "linestyle": "-"},
    {"color": "#0072B2", "linestyle": (0, (5, 1.5))},
    {"color": "#D55E00", "linestyle": (0, (1, 1))},
    {"color": "#009E73", "linestyle": (0, (5, 1.5, 1, 1.5))},
    {"color": "#CC79A7", "linestyle": (0, (3, 1, 1, 1, 1, 1))},
    {"color": "#E69F00", "linestyle": (0, (8, 2))},
)
HASHED = re.compile(r"(?<=[\"#])(?:(?P<kind>[a-z])[0-9a-f]{10}|DejaVu[\w-]+)(?=[\")])")
"""A name that Matplotlib gives to a clip path, a marker or a letter, where it is defined or referred to."""
PLACES = re.compile(r' (d|x|y|width|height)="([^"]*)"')
MOVED = re.compile(r"(?<=translate\()[^)]*")
LETTER = re.compile(r'(<use [^>]*?) transform="translate\((\S+) 0\)"/>')
GROUP = re.compile(r'<g id="(?!axes)[\w.]+"')
"""A group with a name that nothing refers to; those of the axes stay, for whoever edits a drawing."""
STYLE = re.compile(r' style="([^"]*)"')
FRACTION = re.compile(r"-?\d+\.\d+")

POSITIVE, NEGATIVE = "#DDE8F0", "#E8A06A"

SETTINGS: dict[Any, Any] = {
    "figure.constrained_layout.use": True,
    "figure.dpi": 100,
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.grid": True,
    "grid.color": "#D8D8D8",
    "grid.linewidth": 0.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "lines.linewidth": 1.5,
    "path.simplify": False,  # which points a curve can do without is a matter of rounding
    "legend.frameon": False,
    "legend.handlelength": 2.8,
    "hatch.linewidth": 0.6,
    "svg.hashsalt": "rkverify",
    "svg.fonttype": "path",
}


def new_figure(width: float, height: float) -> "Figure":
    """An empty figure of the given size in inches, in the house's style, without a screen."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    matplotlib.rcParams.update(SETTINGS)
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def kh_axis(axes: "Axes", label: str = "wave number times spacing  kh  (rad)") -> None:
    """Label a horizontal axis that runs over kh from 0 to pi."""
    axes.set_xlim(0, pi)
    axes.set_xticks([0, pi / 4, pi / 2, 3 * pi / 4, pi], ["0", "π/4", "π/2", "3π/4", "π"])
    axes.set_xlabel(label)


def sign_map(axes: "Axes", x: Any, y: Any, values: Any) -> None:
    """Show where values(y, x) is positive (light, plain) and negative (dark, hatched), with the border drawn."""
    import numpy as np

    field = np.asarray(values, dtype=float)
    low, high = min(float(field.min()), -1e-300), max(float(field.max()), 1e-300)
    axes.contourf(x, y, field, levels=[low * 2, 0, high * 2], colors=[NEGATIVE, POSITIVE], hatches=["////", None])
    if field.min() < 0 < field.max():
        axes.contour(x, y, field, levels=[0], colors=["#000000"], linewidths=[1.5])
    axes.grid(False)


def sign_key(figure: "FigureBase", positive: str, negative: str, line: str) -> None:
    """A legend for `sign_map`, and for a dotted line in it, below the figure."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    figure.legend(
        handles=[
            Patch(facecolor=POSITIVE, edgecolor="#000000", label=positive),
            Patch(facecolor=NEGATIVE, edgecolor="#000000", hatch="////", label=negative),
            Line2D([], [], color="#000000", linestyle=":", label=line),
        ],
        loc="outside lower center",
        ncols=3,
    )


def _numbered_names(text: str) -> str:
    """The drawing with its clip paths, markers and letters named in order: their own names are long, and hashes of unrounded coordinates."""
    names: dict[str, str] = {}
    counts: dict[str, int] = {}

    def number(found: re.Match[str]) -> str:
        if found[0] not in names:
            kind = found["kind"] or "g"
            names[found[0]] = f"{kind}{counts.setdefault(kind, 0)}"
            counts[kind] += 1
        return names[found[0]]

    return HASHED.sub(number, text)


def _hundredth(found: re.Match[str]) -> str:
    text = f"{float(found[0]):.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _rounded_places(text: str) -> str:
    """The drawing with coordinates to a hundredth of a point, a fiftieth of its thinnest line, and letters placed by x alone."""

    def places(found: re.Match[str]) -> str:
        points = FRACTION.sub(_hundredth, found[2])
        return f' {found[1]}="{re.sub(r"(?<=[A-Za-z]) ", "", points).strip()}"'

    text = MOVED.sub(lambda m: FRACTION.sub(_hundredth, m[0]), PLACES.sub(places, GROUP.sub("<g", text)))
    return LETTER.sub(r'\1 x="\2"/>', text)


def _styles_once(text: str) -> str:
    """The drawing with a class for each style that is there more than twice."""
    counts = Counter(STYLE.findall(text))
    names = {style: f"s{n}" for n, style in enumerate(style for style, count in counts.items() if count > 2)}
    text = STYLE.sub(lambda m: f' class="{names[m[1]]}"' if m[1] in names else m[0], text)
    rules = "".join(f"\n.{name}{{{style}}}" for style, name in names.items())
    return text.replace("</style>", f"{rules}</style>", 1)


def svg(figure: "Figure", title: str, alternative: str) -> str:
    """The figure as SVG text, the same for the same data, with its title and its alternative text inside."""
    stream = StringIO()
    figure.savefig(stream, format="svg", metadata=dict.fromkeys(("Date", "Creator", "Format", "Type")))
    text = _styles_once(_rounded_places(_numbered_names(stream.getvalue())))
    start = text.index("<svg")
    end = text.index(">", start)
    words = f'\n <title id="t">{escape(title)}</title>\n <desc id="d">{escape(alternative)}</desc>'
    lines = (text[:end] + ' role="img" aria-labelledby="t d">' + words + text[end + 1 :]).splitlines()
    return "\n".join(filter(None, (line.strip() for line in lines))) + "\n"
