"""What Figures 5 to 8 have in common: D over kh as curves, D's sign as maps, and a census over what is left open."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from rkverify.certify.curves import Reading, census, discriminants
from rkverify.stability.side_by_side import SEVERAL, Case, semi_lagrangian_rows
from rkverify.workflow.compare import Certified
from rkverify.workflow.study import Drawing, Table, Tables, table
from rkverify.workflow.style import LINES, kh_axis, new_figure, sign_key, sign_map
from studies import _layers as side_by_side

SCNI = (Reading("scni", half_point="edge"), Reading("scni", half_point="literal"))
DNI = tuple(Reading("dni", derivative=d) for d in ("full", "diffuse", "frozen-b", "frozen"))

COLUMNS = [
    ("reading", "", "of C(h/2) for SCNI, of the derivative for DNI"),
    ("spacing", "length", "h"),
    ("stress_ratio", "1", "sigma / C^sigma"),
    ("Q", "1/time", "velocity gradient"),
    ("kh", "rad", "wave number times spacing"),
    ("D", "1", "D rho h^2 / C^sigma, rho = C^sigma = 1"),
]
CENSUS = [
    ("reading", "", "of C(h/2) for SCNI, of the derivative for DNI"),
    ("support_ratio", "1", "R = a/h"),
    ("spacing", "length", "h"),
    ("stress_ratio", "1", "sigma / C^sigma"),
    ("Q", "1/time", "velocity gradient"),
    ("negative", "samples", "samples with D < 0 for certain"),
    ("positive", "samples", "samples with D > 0 for certain"),
    ("neither", "samples", "samples whose enclosure contains 0"),
    ("least", "1", "least D rho h^2 / C^sigma"),
    ("largest", "1", "largest D rho h^2 / C^sigma"),
]


@dataclass(frozen=True)
class Parameters:
    """What a figure shows and over which range its statement is tried.

    Strings are exact: 1/20 is one twentieth. `spacings`: the first is the paper's for Figures 7 and 8, and that of the
    layers side by side. `waves`: n of the measured points kh = pi n/8.
    """

    readings: tuple[Reading, ...]
    stresses: tuple[str, ...]
    tried_stresses: tuple[str, ...]
    support_ratio: str = "3/2"
    spacings: tuple[str, ...] = ("1/20", "1")
    gradients: tuple[str, ...] = ("0", "1/2", "1", "3/2", "2")
    map_stresses: tuple[str, ...] = tuple(f"{n}/8" for n in range(-16, 17))
    map_gradients: tuple[str, ...] = tuple(f"{n}/16" for n in range(33))
    tried_support_ratios: tuple[str, ...] = ("11/10", "13/10", "3/2", "17/10", "19/10")
    samples: int = 96
    map_samples: int = 48
    tried_samples: int = 40
    cases: tuple[Case, ...] = ()
    layer_gradients: tuple[str, ...] = ("-2", "0", "2")
    layer_samples: int = 96
    waves: tuple[int, ...] = (2, 4, 6, 7)


def quick(p: Parameters) -> Parameters:
    """The same with few samples."""
    return replace(
        p,
        gradients=p.gradients[::2],
        map_gradients=p.map_gradients[::8],
        map_stresses=p.map_stresses[::4],
        tried_stresses=p.tried_stresses[:2],
        tried_support_ratios=p.tried_support_ratios[1:4],
        samples=12,
        map_samples=8,
        tried_samples=8,
        layer_samples=16,
        cases=p.cases[:1],
        waves=p.waves[1:2],
    )


def compute(p: Parameters) -> Tables:
    """Curves at the stated R, two maps, and the census."""
    wide, R = p.spacings[-1:], p.support_ratio
    tables: dict[str, Table] = {
        "curves": table(
            discriminants(p.readings, R, p.spacings, p.stresses, p.gradients, p.samples),
            COLUMNS,
            "D along kh; every digit is certain.",
            Certified(),
            across="kh",
        ),
        "map_Q": table(
            discriminants(p.readings[:1], R, wide, (_middle(p),), p.map_gradients, p.map_samples),
            COLUMNS,
            "D over kh and Q.",
            Certified(),
            across="kh",
        ),
        "map_stress": table(
            discriminants(p.readings, R, wide, p.map_stresses, ("0",), p.map_samples),
            COLUMNS,
            "D over kh and sigma / C^sigma without a velocity gradient.",
            Certified(),
            across="kh",
        ),
        "census": table(
            census(p.readings, p.tried_support_ratios, p.spacings, p.tried_stresses, p.gradients, p.tried_samples),
            CENSUS,
            "Signs of D over the whole range that was tried.",
            Certified(),
        ),
        "layers": side_by_side.layer_table(
            semi_lagrangian_rows(p.cases, _middle(p), p.layer_gradients, p.spacings[0], p.layer_samples, p.waves),
            f"Frequency and growth in every layer; sigma/C = {_middle(p)}, h = {p.spacings[0]}.",
        ),
    }
    return tables


def _number(text: str) -> float:
    return float(Fraction(text))


def draw(p: Parameters, tables: Tables, name: str, caption: str, alternative: str) -> Mapping[str, Drawing]:
    """Curves for both spacings above; below the sign over (kh, Q) and over (kh, sigma/C) for every reading."""
    figure = new_figure(10, 7.4)
    above, below = figure.subfigures(2, 1, height_ratios=[1, 1], squeeze=False)[:, 0]
    for axes, h in zip(above.subplots(1, len(p.spacings)), p.spacings, strict=True):
        _curves(axes, p, tables, h)
    panels = [("map_Q", p.readings[0].label, "Q", "velocity gradient  Q  (1/time)")]
    panels += [("map_stress", reading.label, "stress_ratio", "stress  σ/C  (1)") for reading in p.readings]
    for axes, (key, reading, column, label) in zip(below.subplots(1, len(panels)), panels, strict=True):
        frame = tables[key].frame.astype({"kh": float, "D": float})
        # At kh = 0 D is zero, and at kh = pi it is for SCNI without Q: no side of the border to show.
        inside = (frame["kh"] > 0) & (frame["kh"] < frame["kh"].max())
        part = frame[(frame["reading"] == reading) & inside]
        square = part.assign(vertical=part[column].map(_number)).pivot(index="vertical", columns="kh", values="D")
        sign_map(axes, square.columns.to_numpy(), square.index.to_numpy(), square.to_numpy())
        kh_axis(axes, "kh  (rad)")
        axes.set_ylabel(label)
        if key == "map_stress":
            axes.axhline(-1, color="#FFFFFF", linewidth=2.5)
            axes.axhline(-1, color="#000000", linewidth=1.2, linestyle=":")
        fixed = f"σ/C = {_number(_middle(p)):g}" if key == "map_Q" else "Q = 0"
        axes.set_title(f"{reading}; h = {p.spacings[-1]}, {fixed}", fontsize=8)
    sign_key(below, "D > 0: both frequencies real", "D < 0: one grows", "C + σ = 0")
    return {name: Drawing(figure, caption, alternative)}


def draw_layers(p: Parameters, tables: Tables, number: int) -> Mapping[str, Drawing]:
    """The layers side by side at the stress of the curves."""
    h = _number(p.spacings[0])
    bands = {Q: abs(_number(Q)) * h for Q in p.layer_gradients}
    below = tables["layers"].frame["uncertain_below"].max()
    caption = (
        f"Figure {number}, layers side by side: the printed relation, the equations linearised as the paper defines them (N with Psi*), and with the true material rate (consistent); "
        f"circles: rates measured in nonlinear computations at Q = 0 and kh = pi n/8, n = {', '.join(map(str, p.waves))}, with an uncertainty below {below:g}; "
        "with Q != 0 the base itself changes while a wave grows, so that no constant rate can be measured and the curves are those of frozen coefficients. "
        f"Dark grey: growth up to the largest |Q|, which decides nothing, because the frozen equations have a stress mode of their own that grows at such a rate; "
        f"light grey: up to {SEVERAL}|Q|, left open, because the base changes as fast as such a wave grows. "
        f"Ours: sigma/C = {_middle(p)}, Q = {', '.join(p.layer_gradients)}, h = {p.spacings[0]}{' (the paper names it for Figures 7 and 8)' if number > 6 else ''}, of which only Q h counts; "
        "R as titled; rho = C^sigma = 1, cubic B-spline (12), linear basis; C(h/2) at the cell's edge; Truesdell rate, cell edges half-way between nodes, "
        "cell measure from the edges, nodes move with their own coefficients."
    )
    alternative = f"{side_by_side.at_rest_sentences(tables)} {side_by_side.growth_sentences(tables, bands)}"
    figure = side_by_side.draw_layers(tables, h, p.layer_gradients)
    return {f"figure{number}_layers": Drawing(figure, caption, alternative)}


def _middle(p: Parameters) -> str:
    return p.stresses[len(p.stresses) // 2]


def _curves(axes: Any, p: Parameters, tables: Tables, h: str) -> None:
    curves = tables["curves"].frame.astype({"kh": float, "D": float})
    for reading, thickness in zip(p.readings[:2], (1.7, 0.7), strict=False):
        for style, Q in zip(LINES, p.gradients, strict=False):
            part = curves[
                (curves["reading"] == reading.label)
                & (curves["spacing"] == h)
                & (curves["stress_ratio"] == _middle(p))
                & (curves["Q"] == Q)
            ]
            label = f"Q = {_number(Q):g}" if thickness > 1 else None
            axes.plot(part["kh"], part["D"], label=label, **{**style, "linewidth": thickness})
    axes.axhline(0, color="#606060", linewidth=0.8)
    kh_axis(axes)
    axes.set_ylabel("D ρh²/C  (1)")
    thick, thin = p.readings[0].label, p.readings[1].label
    axes.set_title(f"h = {h}, σ/C = {_number(_middle(p)):g}; thick: {thick}, thin: {thin}", fontsize=9)
    # On white: the line D = 0 may run below the words.
    axes.legend(fontsize=8, ncols=2, frameon=True, framealpha=1, edgecolor="none", borderpad=0.2)


def negative_in_curves(p: Parameters, tables: Tables, h: str) -> str:
    """How many of the drawn curves at this h fall below zero between kh = 0 and pi, from which kh on, and with which Q none does."""
    frame = tables["curves"].frame.astype({"kh": float, "D": float})
    drawn = frame["reading"].isin([r.label for r in p.readings[:2]]) & (frame["stress_ratio"] == _middle(p))
    inside = (frame["kh"] > 0) & (frame["kh"] < frame["kh"].max())
    part = frame[drawn & inside & (frame["spacing"] == h)]
    below = part[part["D"] < 0]
    lifted = [Q for Q in p.gradients if not (below["Q"] == Q).any()]
    curves, count = (len(rows.groupby(["reading", "Q"])) for rows in (below, part))
    share = f", at {len(below) / len(part):.0%} of their wave numbers from kh = {below['kh'].min():.2g} to {below['kh'].max():.2g}" if len(below) else ""  # fmt: skip
    none = f"with Q = {', '.join(lifted)} none does" if below.size and lifted else ""
    return f"{curves} of {count} curves at h = {h} fall below zero{share}{', ' if none else ''}{none}"


def at_pi(p: Parameters, tables: Tables) -> str:
    """The least and the largest drawn D at kh = pi for the first and the last Q."""
    frame = tables["curves"].frame.astype({"kh": float, "D": float})
    last = frame[(frame["kh"] == frame["kh"].max()) & (frame["stress_ratio"] == _middle(p))]
    parts = ((Q, last[last["Q"] == Q]["D"]) for Q in (p.gradients[0], p.gradients[-1]))
    return " and ".join(f"{part.min():.2g} to {part.max():.2g} with Q = {Q}" for Q, part in parts)


def negative_in_maps(p: Parameters, tables: Tables) -> str:
    """The share of points with D < 0 in the map over Q at its ends, and in the maps over stress on either side of 0 and -1."""
    over_Q, over_stress = (
        frame[(frame["kh"] > 0) & (frame["kh"] < frame["kh"].max())]
        for frame in (tables[name].frame.astype({"kh": float, "D": float}) for name in ("map_Q", "map_stress"))
    )
    Q, stress = over_Q["Q"].map(_number), over_stress["stress_ratio"].map(_number)
    ends = [f"{(over_Q[end == Q]['D'] < 0).mean():.0%} at Q = {end:g}" for end in (Q.min(), Q.max())]
    sides = {"C + sigma < 0": stress < -1, "compression with C + sigma > 0": (stress > -1) & (stress < 0), "tension": stress > 0}  # fmt: skip
    shares = [f"{(over_stress[side]['D'] < 0).mean():.0%} in {name}" for name, side in sides.items() if side.any()]
    return f"Share of the wave numbers with D < 0 in the map over Q: {' and '.join(ends)}; in the maps over stress: {', '.join(shares)}"


def tried(p: Parameters) -> str:
    """The range over which a statement was tried, in words."""
    signs = f"sigma/C in {{{', '.join(p.tried_stresses)}}}"
    return (
        f"R in {{{', '.join(p.tried_support_ratios)}}}, h in {{{', '.join(p.spacings)}}}, {signs}, Q in {{{', '.join(p.gradients)}}}, "
        f"kh = pi n/{p.tried_samples}; rho = C^sigma = 1, cubic kernel, linear basis"
    )


def open_parameters(p: Parameters) -> str:
    """What the paper leaves open, for a caption."""
    return (
        f"Ours: h = {' and '.join(p.spacings)}, sigma/C = {', '.join(p.stresses)} in the curves, Q = {', '.join(p.gradients)}, "
        "rho = C^sigma = 1, cubic B-spline (12), linear basis. "
        f"The statement was tried over {tried(p)}."
    )


@dataclass(frozen=True)
class Verdict:
    """Signs of D over one reading and spacing: settings tried, those with some D < 0, those with no D <= 0."""

    reading: str
    spacing: str
    settings: int
    with_negative: int
    all_positive: int
    least: float
    largest_of_least: float

    @property
    def name(self) -> str:
        """The reading in words."""
        return f"{self.reading}, h = {self.spacing}"

    @property
    def key(self) -> str:
        """The reading as part of a name."""
        return f"{self.reading}_h_{self.spacing.replace('/', '_')}"


def verdicts(p: Parameters, tables: Tables) -> list[Verdict]:
    """The census summed up for every reading and spacing."""
    frame = tables["census"].frame
    found = []
    for reading in p.readings:
        for h in p.spacings:
            part = frame[(frame["reading"] == reading.label) & (frame["spacing"] == h)]
            least = part["least"].astype(float)
            found.append(
                Verdict(
                    reading.label,
                    h,
                    len(part),
                    int((part["negative"] > 0).sum()),
                    int((part["positive"] == p.tried_samples).sum()),
                    float(least.min()),
                    float(least.max()),
                )
            )
    return found
