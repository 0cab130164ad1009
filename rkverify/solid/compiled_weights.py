"""Compiled: offsets of points from their nodes, the kernel with g = phi'/z and s = (phi'' - g)/z^2, and phi's derivatives in y."""

from collections.abc import Callable
from functools import cache

import numpy as np

from rkverify.solid.bases import axis_pairs
from rkverify.solid.compiling import carray, compiled, stack_memory
from rkverify.solid.kernel_data import Coefficients
from rkverify.solid.kernel_values import Array


def _kernel(
    z: Array, derivatives: int, ends: Coefficients, pieces: tuple[Coefficients, ...], near: float, g_near: Coefficients,
    zs_near: Coefficients, f: Array, g: Array, s: Array,
) -> None:  # fmt: skip
    """phi(z), g = phi'/z and s = (phi'' - g)/z^2 into f, g, s, the latter two where derivatives of 1 and 2 are asked for.

    The lengths of tuples are part of their types: the short loops unroll, and the long ones take several z at once. Each
    array has a loop of its own: processors are slow to skip a masked store to memory that nobody has touched yet.
    """
    for e in range(len(z)):
        y = z[e]
        value = 0.0 * y
        for t in range(len(ends)):
            left, phi = ends[t] - y, 0.0 * y
            for k in range(len(pieces[t])):
                phi = phi * left + pieces[t][k]
            value += phi if y.real < ends[t] else 0.0 * phi
        f[e] = value
    if derivatives >= 1:
        for e in range(len(z)):
            y = z[e]
            slope, series = 0.0 * y, 0.0 * y
            for t in range(len(ends)):
                left, phi, first = ends[t] - y, 0.0 * y, 0.0 * y
                for k in range(len(pieces[t])):
                    first = first * left + phi
                    phi = phi * left + pieces[t][k]
                slope -= first if y.real < ends[t] else 0.0 * first
            for k in range(len(g_near)):
                series = series * y + g_near[k]
            beside = y.real < near or y.real == 0.0
            over = 1.0 + 0.0 * y if beside else y
            g[e] = (series if beside else slope) / over
    if derivatives >= 2:
        for e in range(len(z)):
            y = z[e]
            curve, series = 0.0 * y, 0.0 * y
            for t in range(len(ends)):
                left, phi, first, second = ends[t] - y, 0.0 * y, 0.0 * y, 0.0 * y
                for k in range(len(pieces[t])):
                    second = second * left + first
                    first = first * left + phi
                    phi = phi * left + pieces[t][k]
                curve += 2.0 * second if y.real < ends[t] else 0.0 * second
            for k in range(len(zs_near)):
                series = series * y + zs_near[k]
            beside = y.real < near or y.real == 0.0
            over = (1.0 + 0.0 * y if y == 0.0 else y) if beside else y * y
            s[e] = ((0.0 * y if y == 0.0 else series) if beside else curve - g[e]) / over


kernel_stage = compiled(_kernel)


@cache
def offset_stage(d: int, tensor: bool) -> Callable[..., None]:
    """Offsets y of a block's entries over a = max a_J of their row (`scale`), z = |y|/a_J, one or d of them, and (a/a_J)^2.

    placed (N, d + 1): the nodes' positions and supports. common: the support of all nodes, 0 where they have their own.
    """

    def offsets(
        starts: Array, nodes: Array, points: Array, placed: Array, common: float, first: int, last: int,
        scale: Array, supports: Array, ratios: Array, y: Array, z: Array,
    ) -> None:  # fmt: skip
        x = carray(stack_memory(y, d), d)
        origin = np.uintp(starts[first])
        for p in range(first, last):
            begin, end = np.uintp(starts[p]), np.uintp(starts[p + 1])
            a = common
            if common == 0.0:
                for e in range(begin, end):
                    support = placed[np.uintp(nodes[e]), d].real
                    if support > a:
                        a = support
            scale[p - first] = a
            per_a = 1.0 / a if a > 0.0 else 0.0
            for k in range(d):
                x[k] = points[p, k]
            for e in range(begin, end):
                J, i = np.uintp(nodes[e]), e - origin
                support, square = placed[J, d].real, 0.0 * x[0]
                supports[i] = support
                ratios[i] = 1.0 if support == a else (a / support) * (a / support)
                for k in range(d):
                    offset = x[k] - placed[J, k]
                    y[k, i] = offset * per_a
                    square += offset * offset
                    if tensor:
                        z[k, i] = -offset if offset.real < 0 else offset
                if not tensor:
                    z[0, i] = square
        # division and root wait, so that several are done at once
        for k in range(len(z)):
            for entry in range(z.shape[1]):
                length = z[k, entry]
                if not tensor:
                    nonzero = y[0, entry].real != 0
                    for l in range(1, d):
                        nonzero |= y[l, entry].real != 0
                    length = np.sqrt(length) if nonzero else 0.0 * length
                z[k, entry] = length / supports[entry]

    return compiled(offsets)


@cache
def weight_stage(d: int, tensor: bool) -> Callable[..., None]:
    """phi, its gradient and its second derivatives with respect to the scaled offsets, rows of `weights`."""
    pairs = np.array(axis_pairs(d))

    def weights_of(derivatives: int, ratios: Array, y: Array, f: Array, g: Array, s: Array, weights: Array) -> None:
        for i in range(y.shape[1]):
            ratio = ratios[i]
            if not tensor:
                weights[0, i] = f[0, i]
                if derivatives >= 1:
                    for k in range(d):
                        weights[1 + k, i] = g[0, i] * ratio * y[k, i]
                if derivatives >= 2:
                    for kl in range(len(pairs)):
                        k, l = pairs[kl]
                        second = s[0, i] * ratio * y[k, i] * y[l, i]
                        weights[1 + d + kl, i] = ratio * (second + g[0, i] if k == l else second)
            else:
                value = f[0, i]
                for k in range(1, d):
                    value = value * f[k, i]
                weights[0, i] = value
                if derivatives >= 1:
                    for k in range(d):
                        slope = g[k, i] * ratio * y[k, i]
                        for other in range(d):
                            if other != k:
                                slope = slope * f[other, i]
                        weights[1 + k, i] = slope
                if derivatives >= 2:
                    for kl in range(len(pairs)):
                        k, l = pairs[kl]
                        if k == l:
                            second = ratio * (g[k, i] + s[k, i] * ratio * y[k, i] * y[k, i])
                        else:
                            second = g[k, i] * ratio * y[k, i] * g[l, i] * ratio * y[l, i]
                        for other in range(d):
                            if other != k and other != l:
                                second = second * f[other, i]
                        weights[1 + d + kl, i] = second

    return compiled(weights_of)
