"""The uniform chain a second time: printed coefficients from (75) and (81), symbols from a nonlinear chain that is disturbed.

Modulus, density and spacing are 1. The disturbed chain is written from its definitions, with the nodes' own sums; a wave of
amplitude t in one kind of variable gives one column of the symbol by a quotient of differences.
"""

from dataclasses import dataclass
from functools import partial
from typing import Any

import flint

from rkverify.certify.reference.by_definition import Defined, phi, slope, vanishes

KINDS = ("x", "v", "stress")


def lattice(R: Any, reach: int) -> Defined:
    """Nodes -n, …, n with support R; node I has index I + n."""
    nodes = [[flint.arb(I)] for I in range(-reach, reach + 1)]
    return Defined(nodes, [R] * len(nodes), "cubic", 1, "radial")


def omega_squared_63(R: Any, theta: Any) -> Any:
    """c^-2 omega^2 of (63) as |sum_n b_n e^{i n theta}|^2, with the cells' gradients of one shape function."""
    reach = int(float(R)) + 3
    D = lattice(R, 2 * reach)
    half = flint.fmpq(1, 2)
    b = [D.shape([flint.arb(n) + half])[2 * reach] - D.shape([flint.arb(n) - half])[2 * reach] for n in range(-reach, reach + 1)]  # fmt: skip
    turned = [(value, (n - reach) * theta) for n, value in enumerate(b)]
    re = sum((value * angle.cos() for value, angle in turned), flint.arb(0))
    im = sum((value * angle.sin() for value, angle in turned), flint.arb(0))
    return re * re + im * im  # python-flint's power of an enclosure that contains 0 has no bounds


def printed(integration: str, R: Any, s: Any, Q: Any, theta: Any, half_point: str, derivative: str) -> dict[str, Any]:
    """B, the constant and D: the plane wave e^{i(kx + omega t)} put into (75) or (81), times -1."""
    D = lattice(R, 6)
    zero, one, half = [flint.arb(0)], [flint.arb(1)], [flint.arb(1) / 2]
    at_zero = D.shape(zero)
    C_h = at_zero[5] / phi("cubic", 1 / R)
    slope_h = slope(lambda t: [phi("cubic", 1 / R + t)])[0]
    if half_point == "edge":
        C_half = D.shape(half)[6] / phi("cubic", 1 / (2 * R))
    else:
        lam = D.multipliers(zero, zero)
        C_half = lam[0] - lam[1] / 2
    c, c2, sn, s2 = theta.cos(), (2 * theta).cos(), theta.sin(), (2 * theta).sin()
    half_gradient = C_half * phi("cubic", 1 / (2 * R))
    convective = Q * C_h * slope_h / R
    B = -2 * convective * (at_zero[6] * sn + at_zero[5] * s2)
    constant = 2 * convective * convective * (2 * c - 2)
    if integration == "scni":
        constant -= (1 + s) * half_gradient * half_gradient * (2 - 2 * c2)
    else:
        Psi_x = D.gradient(one, 0, derivative)[6]
        if derivative == "diffuse":
            # (81) varies B_I(x_K) with x_K: the slope of the diffuse derivative.
            Psi_xx = slope(lambda t: D.gradient([flint.arb(1) + t], 0, derivative))[6]
        else:
            Psi_xx = D.second(one, (0, 0), derivative)[6]
        constant += (1 + s) * Psi_x * Psi_x * (2 * c2 - 2) - s * Psi_xx * (2 * c - 2)
    return {"B": B, "constant": constant, "D": B * B - 4 * constant}


@dataclass(frozen=True)
class DisturbedChain:
    """R, sigma/C^sigma, Q, integration, reading of the derivative, and whether N takes the true rate (or Psi*)."""

    R: Any
    s: Any
    Q: Any
    integration: str
    derivative: str
    true: bool

    def symbol(self, theta: Any) -> dict[str, Any]:
        """symbol[row][column] and its imaginary part, by waves cos and sin in each kind of variable."""
        found: dict[str, Any] = {}
        for j, kind in enumerate(KINDS):
            even = slope(partial(self.rates, kind, theta, False))
            odd = slope(partial(self.rates, kind, theta, True))
            for i in range(3):
                found[f"symbol_re[{i}][{j}]"], found[f"symbol_im[{i}][{j}]"] = even[i], odd[i]
        return found

    def rates(self, disturbed: str, theta: Any, odd: bool, t: Any) -> list[Any]:
        """x', v' and stress' of node 0, with t cos(J theta), or t sin(J theta), added to one kind of variable."""
        cells = int(float(self.R) + 0.5) + 1
        reach = cells + int(float(self.R)) + 2
        J = range(-reach, reach + 1)
        waves = [t * ((n * theta).sin() if odd else (n * theta).cos()) for n in J]

        def part(kind: str, base: list[Any]) -> list[Any]:
            return [p + w if kind == disturbed else p for p, w in zip(base, waves, strict=True)]

        x = part("x", [flint.arb(n) for n in J])
        v = part("v", [self.Q * n for n in J])
        stress = part("stress", [self.s for _ in J])
        D = Defined([[p] for p in x], [self.R] * len(x), "cubic", 1, "radial")
        own, force, mass = reach, flint.arb(0), flint.arb(0)
        for K in range(reach - cells, reach + cells + 1):
            left, right = (x[K - 1] + x[K]) / 2, (x[K] + x[K + 1]) / 2
            b = self._gradient(D, x[K], left, right)
            if own == K:
                L = sum((p * w for p, w in zip(b, v, strict=True)), flint.arb(0))
            Psi = D.shape([x[K]])[own]
            force += b[own] * stress[K] * (right - left)
            mass += Psi
            if not vanishes(Psi) and not vanishes(self.Q):
                rate = D.rate([x[K]], [v[K]], [[w] for w in v], self.true)
                force += Psi * sum((p * w for p, w in zip(rate, v, strict=True)), flint.arb(0))
        return [v[own], -force / mass, (1 + stress[own]) * L]

    def _gradient(self, D: Defined, x: Any, left: Any, right: Any) -> list[Any]:
        if self.integration == "dni":
            return D.gradient([x], 0, self.derivative)
        return [(p - q) / (right - left) for p, q in zip(D.shape([right]), D.shape([left]), strict=True)]
