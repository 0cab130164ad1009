"""The numbers of a case in double precision, from nothing but its published inputs: as a user's code would compute them.

Everything goes through `solid/` (and, for waves, the complex steps of `stability/`), so that the reference values, which come
from the transcription and from definitions, judge it.
"""

from collections.abc import Mapping
from itertools import combinations_with_replacement
from math import pi
from typing import Any

import numpy as np

from rkverify.arithmetic.native import rational
from rkverify.certify.reference.case import Inputs
from rkverify.kernels import kernel
from rkverify.readings import Readings
from rkverify.solid.cells import OUTSIDE, Cells
from rkverify.solid.cloud import Cloud, cloud
from rkverify.solid.given_cells import polygon_cells
from rkverify.solid.gradients import GradientOperator, dni, scni
from rkverify.solid.kernel_values import Array, kernel_values
from rkverify.solid.materials.moduli import Moduli
from rkverify.solid.materials.saint_venant_kirchhoff import SaintVenantKirchhoff
from rkverify.solid.mechanics.body import body
from rkverify.solid.neighbours import neighbours
from rkverify.solid.rates import psi_star, true_rate
from rkverify.solid.shape import shape
from rkverify.stability import jacobian_solid
from rkverify.stability.bloch.lattices import lattice
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.symbol import modes, stiffness
from rkverify.stability.lattice_state import Base

AXES = "xyz"
Numbers = dict[str, float]


def doubles(given: Inputs, wanted: Mapping[str, Any]) -> Numbers:
    """quantity -> value for those wanted that `solid/` has; which family a case is of follows from its inputs."""
    if "z" in given:
        found = _kernel(given)
    elif "wave_vectors" in given:
        found = _bloch(given)
    elif "kh" in given:
        found = _wave(given) if "layer" in given else {}
    elif "velocity" in given:
        found = _rates(given)
    elif "cell" in given:
        found = _gradients(given)
    elif "cells" in given:
        found = _plate(given)
    elif "points" in given:
        found = _shape(given)
    else:
        found = _bar(given)
    return {name: value for name, value in found.items() if name in wanted}


def floats(numbers: Any) -> Any:
    """Rationals in nested lists as doubles."""
    return float(rational(numbers)) if isinstance(numbers, str) else [floats(n) for n in numbers]


def _cloud(given: Inputs) -> Cloud:
    return cloud(floats(given["nodes"]), np.array(floats(given["supports"])), given["kernel"], given["order"], given["window"])  # fmt: skip


def _named(name: str, matrix: Array) -> Numbers:
    return {f"{name}[{p}][{I}]": float(value) for p, row in enumerate(matrix) for I, value in enumerate(row)}


def _kernel(given: Inputs) -> Numbers:
    phi = kernel(given["kernel"]).phi
    highest = min(2, min(t.power for t in phi.terms))
    z = np.array(floats(given["z"]))
    values = kernel_values(kernel(given["kernel"]), z, 1.0, highest)
    return {f"{name}[{k}]": float(value) for name, row in zip(("phi", "dphi", "d2phi"), values, strict=False) for k, value in enumerate(row)}  # fmt: skip


def _shape(given: Inputs) -> Numbers:
    nodes, reading = _cloud(given), given["reading"]
    x, d = np.array(floats(given["points"])), _cloud(given).dimension
    highest = min(2, kernel(given["kernel"]).continuity, nodes.order if reading == "diffuse" else 2)
    there = shape(nodes, x, highest, reading)
    found = _named("psi", there.matrix().toarray())
    for j in range(d) if highest else ():
        found |= _named(f"dpsi_d{AXES[j]}", there.gradient_matrix(j).toarray())
        if len(x) == 1:
            found |= {f"b_{AXES[j]}[{I}]": float(b) for I, b in enumerate(there.gradient_matrix(j).toarray()[0])}
    for j, k in combinations_with_replacement(range(d), 2) if highest > 1 else ():
        found |= _named(f"d2psi_d{AXES[j]}d{AXES[k]}", there.second_matrix(j, k).toarray())
    return found


def _rates(given: Inputs) -> Numbers:
    nodes, x = _cloud(given), np.array(floats(given["points"]))
    near = neighbours(nodes, x).nodes
    moving = np.array([floats(given["velocity"])]), np.array(floats(given["node_velocities"]))
    found: Numbers = {}
    for name, rate in (("psi_star", psi_star), ("true_rate", true_rate)):
        found |= {f"{name}[0][{I}]": float(r) for I, r in zip(near, rate(nodes, x, *moving), strict=True)}
    return found


def _gradients(given: Inputs) -> Numbers:
    nodes, corners = _cloud(given), np.array(floats(given["cell"]))
    cell = polygon_cells([[corners]]) if nodes.dimension == 2 else _box(corners)
    operator = scni(nodes, cell, given["rule"])
    found = {"measure": float(operator.measures[0])}
    for i, part in enumerate(operator.parts):
        found |= {f"b_{AXES[i]}[{I}]": float(b) for I, b in enumerate(part.toarray()[0])}
    return found


def _box(ends: Array) -> Cells:
    """One interval or box as a cell."""
    sides, d = ends[1] - ends[0], ends.shape[1]
    if d == 1:
        whole = np.array([[0, OUTSIDE], [0, OUTSIDE]])
        return Cells(ends, np.array([0, 1, 2]), np.array([0, 1]), whole, np.array([[-1.0], [1.0]]), sides)
    places = np.array([[ends[(c >> i) & 1][i] for i in range(3)] for c in range(8)])
    faces, areas = [], np.zeros((6, 3))
    for f in range(6):
        i, high = f // 2, f % 2
        j, k = 1 << (i + 1) % 3, 1 << (i + 2) % 3
        ring = [0, j, j + k, k] if high else [0, k, j + k, j]
        faces += [corner + (high << i) for corner in ring]
        areas[f, i] = (1 if high else -1) * sides.prod() / sides[i]
    return Cells(places, np.arange(0, 25, 4), np.array(faces), np.array([[0, OUTSIDE]] * 6), areas, np.array([sides.prod()]))  # fmt: skip


def _plate(given: Inputs) -> Numbers:
    nodes = _cloud(given)
    cells = polygon_cells([[np.array(floats(cell))] for cell in given["cells"]])
    smoothed = given["integration"] == "scni"
    operator: GradientOperator = scni(nodes, cells, "trapezoid") if smoothed else dni(nodes, cells.measures)
    law = SaintVenantKirchhoff(Moduli(float(rational(given["lame"])), float(rational(given["shear"]))))
    rho = float(rational(given["density"]))
    plate = body(nodes, operator, law, rho)
    F = plate.deformation(np.array(floats(given["displacements"])))
    P = law.stress(F)
    s = np.array(floats(given["stresses"]))
    sigma = s[:, [0, 2, 2, 1]].reshape(-1, 2, 2)
    found = {f"measure[{L}]": float(a) for L, a in enumerate(operator.measures)}
    found |= _named("internal_force", plate.internal_force(P)) | _named("cauchy_force", plate.internal_force(sigma))
    found |= _inertia(nodes, rho * operator.measures, np.array(floats(given["velocities"])))
    at = shape(nodes, np.array(floats(given["traction_points"]))).matrix().toarray()
    pulled = at.T @ (np.array(floats(given["tractions"])) * np.array(floats(given["traction_weights"]))[:, None])
    return found | _named("external_force", plate.body_force(np.array(floats(given["body_forces"]))) + pulled)


def _inertia(nodes: Cloud, masses: Array, v: Array) -> Numbers:
    """Masses and N from the masses of the cells (N,)."""
    Psi = shape(nodes, nodes.positions).matrix().toarray()
    found = _named("mass", Psi.T @ (masses[:, None] * Psi))
    found |= {f"lumped_mass[{I}]": float(m) for I, m in enumerate(Psi.T @ masses)}
    near = neighbours(nodes, nodes.positions)
    rows = np.repeat(np.arange(len(near.starts) - 1), np.diff(near.starts))
    for name, rate in (("convective", psi_star), ("convective_true", true_rate)):
        rates = np.zeros((len(v), len(v)))
        rates[rows, near.nodes] = rate(nodes, nodes.positions, v, v)
        found |= _named(name, Psi.T @ (masses[:, None] * rates))
    return found


def _bar(given: Inputs) -> Numbers:
    nodes, edges = _cloud(given), np.array(floats(given["edges"]))
    lengths = np.diff(edges)
    if given["integration"] == "scni":
        ends = shape(nodes, edges[:, None]).matrix().toarray()
        B = np.diff(ends, axis=0) / lengths[:, None]
    else:
        B = dni(nodes, lengths).parts[0].toarray()
    held = {
        name: float(rational(given[name])) for name in ("modulus", "prestress", "stretch", "body_force", "end_force")
    }
    F = B @ np.array(floats(given["positions"]))
    S = held["prestress"] + held["modulus"] * (F**2 - held["stretch"] ** 2) / 2
    found = {f"internal_force[{I}]": float(f) for I, f in enumerate(B.T @ (S * F * lengths))}
    Psi = shape(nodes, nodes.positions).matrix().toarray()
    pulled = Psi.T @ (lengths * held["body_force"]) + Psi[-1] * held["end_force"]
    found |= {f"external_force[{I}]": float(f) for I, f in enumerate(pulled)}
    return found | _inertia(nodes, float(rational(given["density"])) * lengths, np.array(floats(given["velocities"])))


def _wave(given: Inputs) -> Numbers:
    rate = "true" if given["layer"] == "consistent" else "psi-star"
    readings = Readings(given["integration"], "true" if rate == "true" else "psi-star", given["derivative"])
    base = Base(given["support_ratio"], readings, given["stress_ratio"], given["velocity_gradient"])
    kh, kinds = float(rational(given["kh"])), ("x", "v", "stress")
    assert 0 < kh <= pi
    stencil, found = jacobian_solid.stencil(base), {}
    for i, row in enumerate(kinds):
        for j, column in enumerate(kinds):
            part = sum(c * np.exp(1j * n * kh) for n, c in stencil[row, column].items())
            found[f"symbol_re[{i}][{j}]"], found[f"symbol_im[{i}][{j}]"] = float(part.real), float(part.imag)
    return found


def _bloch(given: Inputs) -> Numbers:
    direct = given["integration"] == "dni"
    scheme = Scheme(
        given["integration"], float(rational(given["support"])), None if direct else given["rule"], given["derivative"],
        given["cell_measure"], given["kernel"], given["order"], given["window"],
    )  # fmt: skip
    xx, yy, xy = floats(given["stress"])
    moduli = Moduli(float(rational(given["lame"])), float(rational(given["shear"])))
    plane, loading = linearised(lattice(given["lattice"]), scheme), Loading((xx, yy, xy), moduli, given["law"])
    k = np.array(floats(given["wave_vectors"]))
    K, omega2 = stiffness(plane, loading, k)[:, 0, :, 0, :].real, modes(plane, loading, k).omega_squared.real
    found = {f"stiffness[{w}][{i}][{j}]": float(K[w, i, j]) for w in range(len(k)) for i in range(2) for j in range(2)}
    return found | {f"omega2[{w}][{n}]": float(value) for w, row in enumerate(omega2) for n, value in enumerate(row)}
