"""PySPH's corrected kernels: what its equations leave in WIJ and DWIJ, times the volume of the source particle.

CRKSPH: the linear reproducing kernel of Frontiere, Raskin, Owen (2017). GradientCorrection, MixedGradientCorrection:
Bonet and Lok (1999). All volumes are 1. Run as `python pysph_values.py FOLDER` in the peers' environment.
"""

import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
from compyle.api import declare
from pysph.base.kernels import CubicSpline, QuinticSpline, WendlandQuintic
from pysph.base.utils import get_particle_array
from pysph.sph.equation import Equation, Group
from pysph.sph.wc.crksph import CRKSPH, CRKSPHPreStep
from pysph.sph.wc.kernel_correction import (
    GradientCorrection,
    GradientCorrectionPreStep,
    MixedGradientCorrection,
    MixedKernelCorrectionPreStep,
)
from pysph.tools.sph_evaluator import SPHEvaluator
from tables import Provenance, columns, read, write_values

ALWAYS = 1e300
"""A tolerance below which every change by a correction lies: without it PySPH drops the larger ones, pair by pair."""
RADIUS = 2.2


class Keep(Equation):
    """Keep, for each pair, the corrected kernel and its gradient as they stand at the end of the loop; the method is translated to C as it stands."""

    def __init__(self, dest, sources, count, dim):
        self.count = count
        self.dim = dim
        super().__init__(dest, sources)

    def loop(self, d_idx, s_idx, d_psi, d_slopes, d_cwij, WIJ, DWIJ):
        i = declare("int")
        d_psi[d_idx * self.count + s_idx] = d_cwij[d_idx] * WIJ
        for i in range(self.dim):
            d_slopes[(d_idx * self.count + s_idx) * self.dim + i] = DWIJ[i]


def corrections(d: int, tolerance: float | None) -> dict[str, tuple]:
    """The equations of each correction: of the sums over neighbours, and of each pair."""
    say = {} if tolerance is None else {"tol": tolerance}
    return {
        "crksph": (CRKSPHPreStep("points", ["nodes"], dim=d), CRKSPH("points", ["nodes"], dim=d, **say)),
        "gradient": (
            GradientCorrectionPreStep("points", ["nodes"], dim=d),
            GradientCorrection("points", ["nodes"], dim=d, **say),
        ),
        "mixed": (
            MixedKernelCorrectionPreStep("points", ["nodes"], dim=d),
            MixedGradientCorrection("points", ["nodes"], dim=d, **say),
        ),
    }


def pairs(nodes, points, radii, kind, kernel, tolerance=ALWAYS):
    """Rows point, node, corrected kernel (1 where the correction has none), corrected gradient; radii are of the nodes and the points."""
    d, count = nodes.shape[1], len(nodes)

    def particles(name, places, own):
        axes = dict(zip("xyz", places.T.copy()))
        array = get_particle_array(
            name=name, **axes, h=np.broadcast_to(own, len(places)) / kernel.radius_scale, m=1.0, rho=1.0
        )
        array.add_property("V", data=1.0)
        return array

    source, target = particles("nodes", nodes, radii[0]), particles("points", points, radii[1])
    strides = {"ai": 1, "gradai": d, "bi": d, "gradbi": d * d, "cwij": 1, "m_mat": 9, "dw_gamma": 3}
    for name, stride in {**strides, "psi": count, "slopes": count * d}.items():
        target.add_property(name, stride=stride)
    sums, each = corrections(d, tolerance)[kind]
    equations = [Group([sums]), Group([each, Keep("points", ["nodes"], count, d)])]
    SPHEvaluator([source, target], equations, dim=d, kernel=kernel).evaluate()
    psi, slopes = target.psi.reshape(-1, count), target.slopes.reshape(-1, count, d)
    reached = [(p, n) for p in range(len(points)) for n in range(count) if psi[p, n] or slopes[p, n].any()]
    if kind == "crksph":
        return [[p, n, psi[p, n], *slopes[p, n]] for p, n in reached]
    return [[p, n, *slopes[p, n]] for p, n in reached]


def main(into: Path) -> None:
    """All tables."""
    told = Provenance(into, "PySPH", version("PySPH"))

    def table(name, quantity, of, at, kind, kernel, tolerance=ALWAYS):
        (nodes, own), (points, at_points) = read(of), read(at)
        radii = (RADIUS, RADIUS) if own is None else (own, at_points)
        rows = pairs(nodes, points, radii, kind, kernel, tolerance)
        write_values(into, name, columns(nodes.shape[1], kind == "crksph"), rows)
        told.add(name, quantity, of, at, RADIUS if own is None else "own", 1)

    for name, d in (("line", 1), ("plane", 2), ("box", 3)):
        of, at = f"nodes_{name}", f"points_{name}"
        table(f"pysph_{name}_crksph", "CRKSPH, CubicSpline, always corrected", of, at, "crksph", CubicSpline(dim=d))
        table(
            f"pysph_{name}_gradient",
            "GradientCorrection, CubicSpline, always corrected",
            of,
            at,
            "gradient",
            CubicSpline(dim=d),
        )
        table(
            f"pysph_{name}_mixed",
            "MixedGradientCorrection, CubicSpline, always corrected",
            of,
            at,
            "mixed",
            CubicSpline(dim=d),
        )
    of, at = "nodes_plane", "points_plane"
    table(
        "pysph_plane_crksph_quintic", "CRKSPH, QuinticSpline, always corrected", of, at, "crksph", QuinticSpline(dim=2)
    )
    table(
        "pysph_plane_crksph_wendland",
        "CRKSPH, WendlandQuintic, always corrected",
        of,
        at,
        "crksph",
        WendlandQuintic(dim=2),
    )
    table(
        "pysph_plane_crksph_default",
        "CRKSPH, CubicSpline, default tolerance 0.5",
        of,
        at,
        "crksph",
        CubicSpline(dim=2),
        None,
    )
    table(
        "pysph_own_crksph",
        "CRKSPH, CubicSpline, own supports",
        "nodes_own",
        "points_at_nodes",
        "crksph",
        CubicSpline(dim=2),
    )
    told.write()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
