"""Sentences of `stability_in_the_plane`."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from rkverify.workflow.study import Statement, rounding

if TYPE_CHECKING:
    import pandas as pd

Frames = Mapping[str, "pd.DataFrame"]


def chain_statements(frames: Frames, span: str) -> list[Statement]:
    """Whether each method's verdict on the chain is that in the plane, in the layer of the linearised equations."""
    chain, bound, growth = frames["chain"], frames["bound"], frames["growth"]
    found = []
    for method, part in chain.groupby("method", sort=False):
        planes = [c for c in part.columns if c in ("square", "hexagonal")]
        same = sum(int(((part[c] > 0) == (part["chain"] > 0)).sum()) for c in planes)
        total = len(planes) * len(part)
        grows = "; ".join(
            f"{state}: {int((one['chain'] > 0).sum())} of {len(one)} support ratios on the chain, "
            + ", ".join(f"{int((one[c] > 0).sum())} on the {c} lattice" for c in planes)
            for state, one in part.groupby("state", sort=False)
        )
        along = float(part["along_axis"].max())
        tail = ""
        if method == "SCNI":
            least, most = bound[bound["growth"] == 0]["share"].max(), bound[bound["growth"] > 0]["share"].min()
            whole = growth[growth["method"] == "SCNI"]
            tail = (
                f" Under all {whole['state'].nunique() - 1} stresses and none {int((whole['growth'] > 0).sum())} of {len(whole)} settings grow. Where compression reaches mu a "
                f"shear wave does: none at {least:g} mu, one at {most:g} mu; on the chain that bound is lambda + 2 mu."
            )
        found.append(
            Statement(
                f"chain_{method}".replace(" ", "_").lower(),
                ("C74",),
                f"{method}: the plane has the chain's verdict in {same} of {total} settings. Growth under {grows}. A longitudinal wave along an axis, tensor "
                f"window, has the chain's omega^2 to {rounding(along)}.{tail}",
                same == total,
                span,
                "sampled",
                same / total,
                "share of settings with the chain's verdict",
                "as-defined",
                _reading(str(method)),
            )
        )
    return found


def _reading(method: str) -> str:
    return method.replace("DNI ", "DNI, derivative ")


def simulated_statements(frames: Frames, span: str) -> list[Statement]:
    """Whether nonlinear runs grow as K(k) says, and whether that is the chain's verdict."""
    measured, chain = frames["measured"], frames["chain"]
    found = []
    for method, part in measured.groupby("method", sort=False):
        grows, still = part[part["predicted"] > 0], part[part["predicted"] == 0]
        off = float((grows["measured"] / grows["predicted"] - 1).abs().max()) if len(grows) else 0.0
        largest = float(still["measured"].abs().max()) if len(still) else 0.0
        words = []
        if len(grows):
            states = ", ".join(dict.fromkeys(grows["state"]))
            words.append(f"measured growth is that of K(k) to {rounding(off)} in {len(grows)} settings ({states})")
        if len(still):
            words.append(f"none above {rounding(largest)} 1/time is measured in {len(still)} where none is predicted")
        beside = part.merge(chain, on=["method", "support_ratio", "state"])
        other = beside[(beside["predicted"] > 0) & (beside["chain"] == 0)]
        if len(beside):
            words.append(
                f"{len(other)} of {len(beside)} runs under tension or compression grow where no wave of the chain does"
            )
        agrees = off <= 1e-2 and largest <= 1e-4
        on_chain = method != "SNNI"
        found.append(
            Statement(
                f"simulated_{method}".replace(" ", "_").lower(),
                ("C74",) if on_chain else ("C13",),
                f"{method}: {'; '.join(words)}.",
                agrees and (other.empty if on_chain else len(grows) > 0),
                span,
                "sampled",
                layer="simulated",
                reading=_reading(str(method)) if on_chain else "that there are two kinds",
            )
        )
    return found


def kinds_statements(frames: Frames, span: str) -> list[Statement]:
    """Zero-energy modes and stress-driven growth, apart."""
    zero, growth = frames["zero_modes"], frames["growth"]
    lattices, jittered = zero[zero["nodes"] != "jittered"], zero[zero["nodes"] == "jittered"]

    def counted(method: str, nodes: str) -> str:
        these = sorted({int(n) for n in zero[(zero["method"] == method) & (zero["nodes"] == nodes)]["without_strain"]})
        return " or ".join(map(str, these))

    words = "; ".join(
        f"{method}: {counted(str(method), 'square')} square, {counted(str(method), 'hexagonal')} hexagonal"
        for method in dict.fromkeys(zero["method"])
    )
    least = "; ".join(
        f"{method} {float((part['least'] / part['largest']).min()):.2g}"
        for method, part in jittered.groupby("method", sort=False)
    )
    scni = lattices[lattices["method"].str.startswith("SCNI")]
    only_dni = bool((scni["without_strain"] == 0).all())
    free = growth[growth["state"] == "no stress"]
    growth = growth[growth["state"] != "no stress"]
    grows = growth[growth["growth"] > 0]
    methods = ", ".join(dict.fromkeys(grows["method"]))
    stiff = int((grows["strain"] > 0).sum())
    quiet = growth[growth["method"].str.startswith("SCNI")]
    apart = (
        bool((free["growth"] == 0).all() and (quiet["growth"] == 0).all())
        and len(grows) > 0
        and bool((scni["without_strain"] > 0).any())
    )
    return [
        Statement(
            "two_kinds",
            ("C13",),
            f"There are two kinds, and neither is the other: without stress {int((free['growth'] > 0).sum())} of {len(free)} settings grow, and modes without strain exist; under stress {len(grows)} settings of "
            f"{methods} grow, {stiff} of them in waves that have a strain; SCNI has modes without strain and grows in {int((quiet['growth'] > 0).sum())} of {len(quiet)} settings.",
            apart,
            span,
            "sampled",
            reading="that there are two kinds",
        ),
        Statement(
            "rank",
            ("C13",),
            f"Modes without strain on lattices, translations left out: {words}. Every nodal integration has those whose wave changes sign or not from any node to any other; "
            f"the trapezoid rule of SCNI adds all of the square zone's edge. Jittered periods have {int(jittered['without_strain'].sum())}; least over largest strain: {least}.",
            only_dni,
            f"waves that fit into {int((lattices['modes'].iloc[0] / 2 + 1) ** 0.5)} by as many nodes, R = {', '.join(dict.fromkeys(map(str, zero['support_ratio'])))}",
            "sampled",
            float(scni["without_strain"].min()),
            "modes without strain of SCNI on lattices",
            reading="that rank instability comes from DNI and not from SCNI",
        ),
    ]


def cloud_statements(frames: Frames, ratio: str, side: int, seeds: int) -> list[Statement]:
    """Whether finite irregular sets have the lattice's verdict."""
    clouds, uneven = frames["clouds"], frames["uneven"]
    found = []
    for method, part in clouds.groupby("method", sort=False):
        grows = part["lattice"] > 0
        changed = part[(grows & (part["least"] == 0)) | (~grows & (part["largest"] > 0))]
        where = "".join(
            f"; {row['state']}, jitter {row['jitter']}: up to {row['largest']:.2g} where the lattice has {row['lattice']:.2g}"
            for _, row in changed.iterrows()
        )
        runs = uneven[uneven["method"] == method]
        seen = "".join(
            f" In a nonlinear run of a jittered period ({row['state']}, {row['law']}) {row['measured']:.2g} is measured and {row['predicted']:.2g} predicted."
            if row["predicted"] > 0
            else f" In one with {row['law'].capitalize()}'s rate none is ({row['state']}, below {rounding(abs(row['measured']))})."
            for _, row in runs.iterrows()
        )
        found.append(
            Statement(
                f"clouds_{method}".replace(" ", "_").lower(),
                ("C75",),
                f"Two dimensions, {method}: {len(part) - len(changed)} of {len(part)} settings of finite sets have the verdict of the infinite lattice{where}. "
                f"Growth is at most {part['largest'].max():.2g} 1/time in the sets and {part['lattice'].max():.2g} on the lattice.{seen}",
                changed.empty,
                f"two dimensions; {side} by {side} nodes with a held rim, off a square lattice by up to {', '.join(dict.fromkeys(clouds['jitter']))}, {seeds} seeds; R = {ratio}; {', '.join(dict.fromkeys(clouds['state']))}",
                "sampled",
                reading=f"two dimensions, {_reading(str(method))}",
            )
        )
    return found


def degenerate_statements(degenerate: "pd.DataFrame", ratio: str) -> list[Statement]:
    """How derivatives are taken where four cells meet in a point."""
    sums = float(degenerate["sum_by_steps"].max())
    areas = float(degenerate["areas_by_steps"].max())
    first, last = degenerate.iloc[0], degenerate.iloc[-1]
    return [
        Statement(
            "four_cells",
            ("C74",),
            f"On the square lattice single a_L b_I^L have two one-sided derivatives, apart by {first['triangulations']:.2g} with the {first['rule']} rule and "
            f"{last['triangulations']:.1g} with {last['rule']}; their sum over the cells, which is what a uniform stress feels, has the derivative zero to {rounding(sums)} in either "
            f"triangulation and on either side; areas have one derivative, the closed form's, to {rounding(areas)}.",
            sums < 1e-13 and areas < 1e-13,
            f"square lattice, R = {ratio}, rules {', '.join(degenerate['rule'])}",
            "sampled",
            layer="as-defined",
            reading="SCNI",
        )
    ]
