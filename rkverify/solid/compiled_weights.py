"""Compiled: offsets of points from their nodes, the kernel with g = phi'/z and s = (phi'' - g)/z^2, and phi's derivatives in y."""

from collections.abc import Callable
from functools import cache

import numpy as np

from rkverify.solid.bases import axis_pairs
from rkverify.solid.compiling import compiled
from rkverify.solid.kernel_values import Array


def _kernel(
    z: Array, derivatives: int, ends: Array, coefficients: Array, powers: Array, near: float, g_near: Array, zs_near: Array,
    f: Array, g: Array, s: Array, left: Array, power: Array,
) -> None:  # fmt: skip
    """phi(z), g = phi'/z and s = (phi'' - g)/z^2 into f, g, s; left and power are room to work in."""
    for e in range(len(z)):
        f[e] = 0.0
        g[e] = 0.0
        s[e] = 0.0
    for t in range(len(ends)):
        b, p = ends[t], powers[t]
        for e in range(len(z)):
            inside = z[e].real < b
            left[e] = b - z[e] if inside else 0.0
            power[e] = coefficients[t] if inside else 0.0
        for k in range(p):
            if derivatives >= 2 and k == p - 2:
                for e in range(len(z)):
                    s[e] += p * (p - 1) * power[e]
            if derivatives >= 1 and k == p - 1:
                for e in range(len(z)):
                    g[e] -= p * power[e]
            for e in range(len(z)):
                power[e] *= left[e]
        for e in range(len(z)):
            f[e] += power[e]
    for e in range(len(z)):
        over = z[e] if z[e].real >= near and z[e].real > 0.0 else 1.0 + 0.0 * z[e]
        g[e] /= over
        s[e] = (s[e] - g[e]) / (over * over)
    if derivatives >= 1:
        for e in range(len(z)):
            if z[e].real < near or z[e].real == 0.0:
                y = z[e]
                total = 0.0 * y
                for k in range(len(g_near)):
                    total = total * y + g_near[len(g_near) - 1 - k]
                g[e] = total
                total = 0.0 * y
                for k in range(len(zs_near)):
                    total = total * y + zs_near[len(zs_near) - 1 - k]
                s[e] = total / y if y != 0.0 else 0.0 * y


kernel_stage = compiled(_kernel)


@cache
def offset_stage(d: int, tensor: bool) -> Callable[..., None]:
    """Offsets y of a block's entries over a = max a_J of their row (`scale`), z = |y|/a_J, one or d of them, and (a/a_J)^2.

    placed (N, d + 1): the nodes' positions and supports.
    """

    def offsets(
        starts: Array, nodes: Array, points: Array, placed: Array, first: int, last: int,
        scale: Array, ratios: Array, y: Array, z: Array,
    ) -> None:  # fmt: skip
        origin = starts[first]
        for p in range(first, last):
            a = 0.0
            for e in range(starts[p], starts[p + 1]):
                a = max(a, placed[nodes[e], d].real)
            scale[p - first] = a
            per_a = 1.0 / a if a > 0.0 else 0.0
            for e in range(starts[p], starts[p + 1]):
                J, i = nodes[e], e - origin
                support = placed[J, d].real
                ratios[i] = (a / support) * (a / support)
                if tensor:
                    for k in range(d):
                        offset = points[p, k] - placed[J, k]
                        y[k, i] = offset * per_a
                        z[k, i] = (-offset if offset.real < 0 else offset) / support
                else:
                    offset = points[p, 0] - placed[J, 0]
                    y[0, i] = offset * per_a
                    square, nonzero = offset * offset, offset.real != 0
                    for k in range(1, d):
                        offset = points[p, k] - placed[J, k]
                        y[k, i] = offset * per_a
                        square += offset * offset
                        nonzero |= offset.real != 0
                    z[0, i] = np.sqrt(square) / support if nonzero else 0.0

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
