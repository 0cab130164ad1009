"""Tables of what nonlinear runs, zero-energy modes, uneven nodes and cells that meet four in a point show."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from rkverify.solid.kernel_values import Array
from rkverify.stability.bloch import degenerate
from rkverify.stability.bloch.clouds import growth, held_cloud, uneven_square
from rkverify.stability.bloch.lattices import jittered, lattice
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.measured import measure, measure_fastest
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.surveys import NONE, Method, Row, loading
from rkverify.stability.bloch.symbol import modes
from rkverify.stability.bloch.zero_energy import strains, zero_modes
from rkverify.stability.bloch.zones import commensurate, worst


@dataclass(frozen=True)
class Case:
    """A wave that fits waves[0], waves[1] times into a box of 4 by 4 periods, for a nonlinear run."""

    lattice: str
    method: Method
    support_ratio: str
    state: str
    waves: tuple[int, int]


BOX = 4


def measured_rows(cases: Sequence[Case], size: float) -> list[Row]:
    """Growth in nonlinear runs beside the growth of K(k)."""
    found = []
    for case in cases:
        nodes, scheme, load = lattice(case.lattice), case.method.scheme(case.support_ratio), loading(case.state, size)
        k = np.array(case.waves) / BOX @ nodes.reciprocal
        predicted = float(modes(linearised(nodes, scheme), load, k[None]).growth.max())
        seen = measure(nodes, scheme, load, BOX, case.waves)
        found.append(
            {
                "lattice": case.lattice,
                "method": case.method.name,
                "support_ratio": case.support_ratio,
                "state": case.state,
                "kx": float(k[0]),
                "ky": float(k[1]),
                "predicted": predicted,
                "measured": seen.growth,
                "uncertainty": seen.uncertainty,
            }
        )
    return found


def zero_rows(methods: Sequence[Method], ratios: Sequence[str], count: int, jitter: float, seed: int) -> list[Row]:
    """Zero-energy modes among waves that fit into count by count nodes, on lattices and on a jittered period of a third of it."""
    sets = [("square", lattice("square"), count), ("hexagonal", lattice("hexagonal"), count)]
    period = count // 3
    sets.append(("jittered", jittered(lattice("square"), period, jitter, seed), count // period))
    found = []
    for name, nodes, fits in sets:
        for method in methods:
            for R in ratios:
                seen = zero_modes(linearised(nodes, method.scheme(R)), nodes, fits)
                found.append(
                    {
                        "nodes": name,
                        "method": method.name,
                        "support_ratio": R,
                        "modes": 2 * fits**2 * len(nodes) - 2,
                        "without_strain": seen.count,
                        "least": seen.least,
                        "largest": seen.largest,
                    }
                )
    return found


def strain_map(methods: Sequence[Method], R: str, points: int) -> list[Row]:
    """The least strain of a wave of unit amplitude over a quarter of the square lattice's Brillouin zone."""
    q = np.linspace(0, np.pi, points)
    k = np.stack(np.meshgrid(q, q, indexing="ij"), axis=-1).reshape(-1, 2)
    found = []
    for method in methods:
        values = np.linalg.svd(strains(linearised(lattice("square"), method.scheme(R)), k), compute_uv=False).min(
            axis=1
        )
        for (x, y), value in zip(k.tolist(), values.tolist(), strict=True):
            found.append({"method": method.name, "kx": x, "ky": y, "strain": value if value > 1e-12 else 0.0})
    return found


def drawn_rows(count: int, share: float) -> list[Row]:
    """Nodes of a square lattice displaced by zero-energy modes, for a drawing."""
    places = np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="ij"), axis=-1).reshape(-1, 2)
    waves = {"(π, 0) along x": ((1, 0), (1, 0)), "(π, 0) along y": ((1, 0), (0, 1)), "(π, π) along x": ((1, 1), (1, 0))}
    found = []
    for name, (k, direction) in waves.items():
        moved = share * np.outer(np.cos(np.pi * places @ np.array(k)), direction)
        for (x, y), (u, v) in zip(places.tolist(), moved.tolist(), strict=True):
            found.append({"mode": name, "x": float(x), "y": float(y), "ux": u, "uy": v})
    return found


def cloud_rows(
    methods: Sequence[Method],
    R: str,
    states: Sequence[str],
    jitters: Sequence[str],
    size: float,
    count: int,
    seeds: int,
) -> list[Row]:
    """Largest growth of finite sets of nodes with a held rim beside that of the lattice, least and largest over the seeds."""
    found = []
    square = lattice("square")
    for method in methods:
        of = linearised(square, method.scheme(R))
        of_lattice = {s: worst(of, loading(s, size), commensurate(square, 12)).growth for s in states}
        for jitter in jitters:
            j = float(Fraction(jitter))
            clouds = [held_cloud(*uneven_square(count, j, seed), method.scheme(R)) for seed in range(seeds if j else 1)]
            for state in states:
                grown = [growth(cloud, loading(state, size)) for cloud in clouds]
                grown = [g if g > NONE else 0.0 for g in grown]
                found.append(
                    {
                        "method": method.name,
                        "state": state,
                        "jitter": jitter,
                        "nodes": len(clouds[0].free),
                        "lattice": of_lattice[state] if of_lattice[state] > NONE else 0.0,
                        "least": min(grown),
                        "largest": max(grown),
                    }
                )
    return found


def uneven_rows(
    cases: Sequence[tuple[Method, str, str]], R: str, count: int, jitter: float, size: float, time: float
) -> list[Row]:
    """The fastest mode of a jittered period of count by count nodes (method, state, law), and its growth in a nonlinear run."""
    found = []
    nodes = jittered(lattice("square"), count, jitter, 1)
    for method, state, law in cases:
        load = Loading(loading(state, size).stress, law=law)  # type: ignore[arg-type]
        predicted, seen = measure_fastest(nodes, method.scheme(R), load, time)
        found.append(
            {
                "method": method.name,
                "state": state,
                "law": law,
                "predicted": predicted if predicted > NONE else 0.0,
                "measured": seen.growth,
                "uncertainty": seen.uncertainty,
            }
        )
    return found


def degenerate_rows(rules: Sequence[str], R: str, step: float) -> list[Row]:
    """Derivatives where four cells meet: by either triangulation, by either side, and of the areas."""
    found = []
    for rule in rules:
        scheme = Scheme("scni", float(Fraction(R)), rule)
        patch, cells = degenerate.patch_of(lattice("square"), scheme)
        either = [degenerate.by_complex_step(scheme, patch, cells, 0, tilt) for tilt in (step, -step)]
        sides = [degenerate.by_difference(scheme, patch, cells, 0, h) for h in (step, -step)]
        closed = degenerate.area_slopes(patch, cells)[:, 0]
        found.append(
            {
                "rule": rule,
                "single": _largest([either[0].integrals]),
                "triangulations": _largest([either[0].integrals - either[1].integrals]),
                "sides": _largest([sides[0].integrals - sides[1].integrals]),
                "sum_by_steps": _largest([m.resultant for m in either]),
                "sum_by_quotients": _largest([m.resultant for m in sides]),
                "areas_by_steps": _largest([m.areas - closed for m in either]),
                "areas_by_quotients": _largest([m.areas - closed for m in sides]),
            }
        )
    return found


def _largest(parts: list[Array]) -> float:
    return max(float(abs(part).max()) for part in parts)
