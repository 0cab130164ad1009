"""Compiled: the moment matrix (6) with its factors, shape functions (4) and their derivatives, (40) and the material rate.

Everything is a polynomial times a kernel. With C = b.H, M b = H(0), and c_k, e_kl constant at a point,

    Psi_,k  = c_k.H phi + C phi_,k
    Psi_,kl = e_kl.H phi + c_k.H phi_,l + c_l.H phi_,k + C phi_,kl

where the full derivative follows from the derivatives of sum_J H(x - x_J) Psi_J = H(0) alone,

    M c_k  = -H_,k(0) - sum_J H C phi_,k
    M e_kl = H_,kl(0) - sum_J H (c_k.H phi_,l + c_l.H phi_,k + C phi_,kl);

diffuse leaves out all that has a derivative of phi, frozen-b has c_k.H = b.H_,k, frozen c_k = 0.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from numba import njit

from rkverify.solid.bases import axis_pairs, basis_tables
from rkverify.solid.compiling import OPTIONS, carray, compiled, stack_memory
from rkverify.solid.kernel_values import Array

FULL, DIFFUSE, FROZEN_B, FROZEN = range(4)
FINE, FEW, SINGULAR = range(3)


def _solve(factors: Array, p: int, m: int, x: Array, o: int) -> None:
    """x[o:o + m] becomes M^-1 x by the factors L D L^T of row p: 1/D on the diagonal of the packed lower triangle."""
    for i in range(m):
        for k in range(i):
            x[o + i] -= factors[p, i * (i + 1) // 2 + k] * x[o + k]
    for i in range(m):
        x[o + i] *= factors[p, i * (i + 1) // 2 + i]
    for j in range(m):
        i = m - 1 - j
        for k in range(i + 1, m):
            x[o + i] -= factors[p, k * (k + 1) // 2 + i] * x[o + k]


_solved = njit(_solve, inline="always", **OPTIONS)


@cache
def moment_stage(d: int, n: int) -> Callable[..., tuple[int, int, int, float]]:
    """M(x) of (6) with y in units of the scale, packed, or its factors L D L^T with b = M^-1 H(0).

    Returns (row, fault, count or pivot, what is left of it) of the first row without an inverse; fault 0 where there is none.
    """
    table = basis_tables(d, n)
    m, sums, parents, axes, products = table.size, table.sums, table.parents, table.axes, table.products
    packed = m * (m + 1) // 2

    def moments(
        starts: Array, first: int, last: int, y: Array, weights: Array, factorise: bool, factors: Array, b: Array
    ) -> tuple[int, int, int, float]:
        total = carray(stack_memory(y, sums), sums)
        term = carray(stack_memory(y, sums), sums)
        M = carray(stack_memory(y, packed), packed)
        v = carray(stack_memory(y, m), m)
        first_row, origin = np.uintp(first), np.uintp(starts[first])
        for p in range(first_row, np.uintp(last)):
            row, covering = p - first_row, 0
            begin, end = np.uintp(starts[p]) - origin, np.uintp(starts[p + np.uintp(1)]) - origin
            for c in range(sums):
                total[c] = 0.0
            for e in range(begin, end):
                term[0] = weights[0, e]
                total[0] += term[0]
                covering += term[0].real > 0
                for c in range(1, sums):
                    term[c] = term[parents[c]] * y[axes[c], e]
                    total[c] += term[c]
            if covering < m:
                return int(np.intp(p)), FEW, covering, 0.0
            for i in range(m):
                for j in range(i + 1):
                    M[i * (i + 1) // 2 + j] = total[products[i, j]]
            if not factorise:
                for c in range(packed):
                    factors[row, c] = M[c]
                continue
            parts = 1.0
            for j in range(m):
                jj = j * (j + 1) // 2
                pivot = M[jj + j]
                for k in range(j):
                    pivot -= M[jj + k] * M[jj + k] * term[k]
                if not pivot.real > 0.0:
                    kept = pivot.real / M[jj + j].real if M[jj + j].real > 0.0 else 0.0
                    return int(np.intp(p)), SINGULAR, j, kept
                parts *= pivot.real / M[jj + j].real
                term[j] = pivot
                M[jj + j] = 1.0 / pivot
                for i in range(j + 1, m):
                    ii = i * (i + 1) // 2
                    entry = M[ii + j]
                    for k in range(j):
                        entry -= M[ii + k] * M[jj + k] * term[k]
                    M[ii + j] = entry / pivot
            # Pivot j is v^T M v with row v of L^-1. Each M_ij is off by (N + m) epsilon (M_ii M_jj)^(1/2) or less, and so the
            # pivot by m (N + m) epsilon sum_i v_i^2 M_ii or less. Scaled to a unit diagonal M has the determinant `parts`, and
            # no eigenvalue below parts/e: where that is above m (N + m) epsilon, all pivots are above what they are off by.
            rounding = m * (np.intp(end - begin) + m) * 2.220446049250313e-16
            if not parts > 2.72 * rounding:
                for j in range(m):
                    v[j] = 1.0
                    uncertain = total[products[j, j]].real
                    for back in range(j):
                        i = j - 1 - back
                        v[i] = 0.0
                        for k in range(i + 1, j + 1):
                            v[i] -= v[k] * M[k * (k + 1) // 2 + i]
                        uncertain += v[i].real * v[i].real * total[products[i, i]].real
                    if not term[j].real > rounding * uncertain:
                        return int(np.intp(p)), SINGULAR, j, term[j].real / total[products[j, j]].real
            for c in range(packed):
                factors[row, c] = M[c]
            for i in range(m):
                b[row, i] = 1.0 if i == 0 else 0.0
            for i in range(m):
                total[i] = 1.0 if i == 0 else 0.0
            _solved(factors, row, m, total, 0)
            for i in range(m):
                b[row, i] = total[i]
        return -1, FINE, 0, 0.0

    return compiled(moments)


@cache
def derivative_stage(d: int, n: int) -> Callable[..., None]:
    """Psi and, for derivatives of 1 and 2, Psi_,k and Psi_,kl of a block's entries in a reading."""
    table = basis_tables(d, n)
    m, parents, axes, lowered, powers, picks = (
        table.size, table.parents, table.axes, table.lowered, table.powers, table.picks,
    )  # fmt: skip
    pairs = np.array(axis_pairs(d))
    dd = len(pairs)
    dm, ddm = d * m, dd * m

    def derivatives_of(
        starts: Array, first: int, last: int, scale: Array, y: Array, weights: Array, factors: Array, b_of: Array,
        derivatives: int, reading: int, values: Array, gradients: Array, seconds: Array,
    ) -> None:  # fmt: skip
        H, b = carray(stack_memory(y, m), m), carray(stack_memory(y, m), m)
        c, cH = carray(stack_memory(y, dm), dm), carray(stack_memory(y, d), d)
        e2 = carray(stack_memory(y, ddm), ddm)
        first_row, origin, solves = np.uintp(first), np.uintp(starts[first]), reading in (FULL, DIFFUSE)
        H[0] = 1.0
        for p in range(first_row, np.uintp(last)):
            row, begin, end = p - first_row, np.uintp(starts[p]) - origin, np.uintp(starts[p + np.uintp(1)]) - origin
            for i in range(m):
                b[i] = b_of[row, i]
            if derivatives >= 1:
                for k in range(d):
                    for i in range(m):
                        c[k * m + i] = picks[1 + k, i] if solves else 0.0
                    if reading == FROZEN_B:
                        for i in range(m):
                            c[k * m + lowered[k, i]] += powers[k, i] * b[i]
                if reading == FULL:
                    for e in range(begin, end):
                        C = b[0]
                        for i in range(1, m):
                            H[i] = H[parents[i]] * y[axes[i], e]
                            C += b[i] * H[i]
                        for k in range(d):
                            known = C * weights[1 + k, e]
                            for i in range(m):
                                c[k * m + i] -= H[i] * known
                if solves:
                    for k in range(d):
                        _solved(factors, row, m, c, k * m)
            if derivatives >= 2:
                for kl in range(dd):
                    k, l = pairs[kl, 0], pairs[kl, 1]
                    for i in range(m):
                        e2[kl * m + i] = picks[1 + d + kl, i] if solves else 0.0
                    if reading == FROZEN_B:
                        for i in range(m):
                            e2[kl * m + lowered[k, i]] += powers[k, i] * c[l * m + i]
                if reading == FULL:
                    for e in range(begin, end):
                        C = b[0]
                        for k in range(d):
                            cH[k] = c[k * m]
                        for i in range(1, m):
                            H[i] = H[parents[i]] * y[axes[i], e]
                            C += b[i] * H[i]
                            for k in range(d):
                                cH[k] += c[k * m + i] * H[i]
                        for kl in range(dd):
                            k, l = pairs[kl, 0], pairs[kl, 1]
                            known = cH[k] * weights[1 + l, e] + cH[l] * weights[1 + k, e] + C * weights[1 + d + kl, e]
                            for i in range(m):
                                e2[kl * m + i] -= H[i] * known
                if solves:
                    for kl in range(dd):
                        _solved(factors, row, m, e2, kl * m)
            per_length = 1.0 / scale[row]
            for e in range(begin, end):
                C = b[0]
                for i in range(1, m):
                    H[i] = H[parents[i]] * y[axes[i], e]
                    C += b[i] * H[i]
                phi = weights[0, e]
                values[origin + e] = C * phi
                if derivatives >= 1:
                    for k in range(d):
                        cH[k] = c[k * m]
                        for i in range(1, m):
                            cH[k] += c[k * m + i] * H[i]
                        slope = cH[k] * phi
                        if reading != DIFFUSE:
                            slope += C * weights[1 + k, e]
                        gradients[origin + e, k] = slope * per_length
                if derivatives >= 2:
                    for kl in range(dd):
                        k, l = pairs[kl, 0], pairs[kl, 1]
                        eH = e2[kl * m]
                        for i in range(1, m):
                            eH += e2[kl * m + i] * H[i]
                        second = eH * phi
                        if reading != DIFFUSE:
                            second += cH[k] * weights[1 + l, e] + cH[l] * weights[1 + k, e] + C * weights[1 + d + kl, e]
                        seconds[origin + e, kl] = second * (per_length * per_length)

    return compiled(derivatives_of)


@cache
def rate_stage(d: int, n: int) -> Callable[..., None]:
    """C times the material rate of phi (40), or the material rate of Psi, where x - x_J changes at the rate v - v_J."""
    table = basis_tables(d, n)
    m, parents, axes, lowered, powers = table.size, table.parents, table.axes, table.lowered, table.powers

    def rates_of(
        nodes: Array, starts: Array, first: int, last: int, scale: Array, y: Array, weights: Array, factors: Array,
        b_of: Array, velocities: Array, node_velocities: Array, true: bool, rates: Array,
    ) -> None:  # fmt: skip
        H, b, r = carray(stack_memory(y, m), m), carray(stack_memory(y, m), m), carray(stack_memory(y, m), m)
        dH, w = carray(stack_memory(y, m), m), carray(stack_memory(y, d), d)
        origin = starts[first]
        H[0] = 1.0
        for p in range(first, last):
            row = p - first
            for i in range(m):
                b[i] = b_of[row, i]
                r[i] = 0.0
            for turn in range(2 if true else 1):
                for e in range(starts[p] - origin, starts[p + 1] - origin):
                    J = nodes[origin + e]
                    C, slope, phi = b[0], 0.0 * y[0, e], weights[0, e]
                    for i in range(1, m):
                        H[i] = H[parents[i]] * y[axes[i], e]
                        C += b[i] * H[i]
                    for k in range(d):
                        w[k] = (velocities[p, k] - node_velocities[J, k]) / scale[row]
                        slope += weights[1 + k, e] * w[k]
                    if not true:
                        rates[origin + e] = C * slope
                        continue
                    dC = 0.0 * C
                    for i in range(m):
                        dH[i] = 0.0
                        for k in range(d):
                            dH[i] += w[k] * powers[k, i] * H[lowered[k, i]]
                        dC += b[i] * dH[i]
                    if turn == 0:
                        for i in range(m):
                            r[i] -= dH[i] * (C * phi) + H[i] * (dC * phi + C * slope)
                    else:
                        for i in range(m):
                            dC += r[i] * H[i]
                        rates[origin + e] = dC * phi + C * slope
                if true and turn == 0:
                    _solved(factors, row, m, r, 0)

    return compiled(rates_of)
