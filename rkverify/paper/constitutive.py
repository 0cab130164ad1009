"""Stress from deformation at one point: hyperelastic laws with their energies, hypoelastic and plastic rate equations, (24).

Stresses P are nominal, as (7) and (24) have them: P_ki with the material axis first, so that dW = dF_ik P_ki. Matrices are
lists of rows; d = 2 is plane strain, d = 1 uniaxial strain.
"""

from collections.abc import Callable
from dataclasses import dataclass

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.paper.chain_rule import determinant, inverse
from rkverify.paper.moment import Matrix
from rkverify.paper.numbered import equation


@dataclass(frozen=True)
class Moduli:
    """Lame's lambda and the shear modulus mu."""

    lame: Scalar
    shear: Scalar


def transpose(A: Matrix) -> Matrix:
    """A^T."""
    return [list(column) for column in zip(*A, strict=True)]


def product(A: Matrix, B: Matrix) -> Matrix:
    """A B."""
    return [[sum((a * b for a, b in zip(row[1:], column[1:], strict=True)), row[0] * column[0]) for column in transpose(B)] for row in A]  # fmt: skip


def identity(d: int, K: Arithmetic) -> Matrix:
    """delta_ij."""
    return [[K.number(int(i == j)) for j in range(d)] for i in range(d)]


def combined(a: Scalar, A: Matrix, b: Scalar, B: Matrix) -> Matrix:
    """a A + b B."""
    return [[a * p + b * q for p, q in zip(one, other, strict=True)] for one, other in zip(A, B, strict=True)]


def trace(A: Matrix) -> Scalar:
    """A_ii."""
    return sum((A[i][i] for i in range(1, len(A))), A[0][0])


def contraction(A: Matrix, B: Matrix) -> Scalar:
    """A_ij B_ij."""
    terms = [a * b for one, other in zip(A, B, strict=True) for a, b in zip(one, other, strict=True)]
    return sum(terms[1:], terms[0])


def green_strain(F: Matrix, K: Arithmetic) -> Matrix:
    """E_ij = (F_ki F_kj - delta_ij)/2, of which (55) is the component in one dimension."""
    half = K.ratio(1, 2)
    return combined(half, product(transpose(F), F), -half, identity(len(F), K))


def isotropic(strain: Matrix, C: Moduli, K: Arithmetic) -> Matrix:
    """C_ijkl strain_kl = lambda strain_kk delta_ij + 2 mu strain_ij, for symmetric strain."""
    return combined(C.lame * trace(strain), identity(len(strain), K), 2 * C.shear, strain)


def saint_venant_kirchhoff_energy(F: Matrix, C: Moduli, K: Arithmetic) -> Scalar:
    """W = lambda E_kk^2/2 + mu E_ij E_ij."""
    E = green_strain(F, K)
    return C.lame * trace(E) * trace(E) / 2 + C.shear * contraction(E, E)


def saint_venant_kirchhoff(F: Matrix, C: Moduli, K: Arithmetic) -> Matrix:
    """P_ki = S_kj F_ij with S = C : E, of which (53), (54) are the components in one dimension."""
    return product(isotropic(green_strain(F, K), C, K), transpose(F))


def neo_hookean_energy(F: Matrix, C: Moduli, log: Callable[[Scalar], Scalar]) -> Scalar:
    """W = mu (F_ij F_ij - d)/2 - mu ln J + lambda (J^2 - 1 - 2 ln J)/4, with a logarithm of this arithmetic."""
    J = determinant(F)
    return C.shear * (contraction(F, F) - len(F)) / 2 - C.shear * log(J) + C.lame * (J * J - 1 - 2 * log(J)) / 4


def neo_hookean(F: Matrix, C: Moduli, K: Arithmetic) -> Matrix:
    """P_ki = mu (F_ik - F^-1_ki) + lambda (J^2 - 1) F^-1_ki/2."""
    J = determinant(F)
    return combined(C.shear, transpose(F), C.lame * (J * J - 1) / 2 - C.shear, inverse(F, K))


def linear_energy(F: Matrix, C: Moduli, K: Arithmetic) -> Scalar:
    """W = lambda eps_kk^2/2 + mu eps_ij eps_ij with eps_ij = (F_ij + F_ji)/2 - delta_ij."""
    eps = small_strain(F, K)
    return C.lame * trace(eps) * trace(eps) / 2 + C.shear * contraction(eps, eps)


def small_strain(F: Matrix, K: Arithmetic) -> Matrix:
    """eps_ij = (F_ij + F_ji)/2 - delta_ij."""
    return combined(K.number(1), symmetric(F, K), K.number(-1), identity(len(F), K))


def linear(F: Matrix, C: Moduli, K: Arithmetic) -> Matrix:
    """P = sigma = C : eps."""
    return isotropic(small_strain(F, K), C, K)


def symmetric(L: Matrix, K: Arithmetic) -> Matrix:
    """(L_ij + L_ji)/2."""
    half = K.ratio(1, 2)
    return combined(half, L, half, transpose(L))


def jaumann_rate(sigma: Matrix, L: Matrix, C: Moduli, K: Arithmetic) -> Matrix:
    """sigma' = C : D + W sigma - sigma W with D_ij = (L_ij + L_ji)/2, W_ij = (L_ij - L_ji)/2."""
    half, one = K.ratio(1, 2), K.number(1)
    W = combined(half, L, -half, transpose(L))
    turning = combined(one, product(W, sigma), -one, product(sigma, W))
    return combined(one, isotropic(symmetric(L, K), C, K), one, turning)


def truesdell_rate(sigma: Matrix, L: Matrix, C: Moduli, K: Arithmetic) -> Matrix:
    """sigma'_ij = C_ijkl D_kl + L_ik sigma_kj + sigma_ik L_jk - L_kk sigma_ij; in one dimension (C + sigma) L."""
    one = K.number(1)
    carried = combined(one, product(L, sigma), one, product(sigma, transpose(L)))
    return combined(one, combined(one, isotropic(symmetric(L, K), C, K), one, carried), -trace(L), sigma)


def plastic_rate(sigma: Matrix, D: Matrix, C: Moduli, hardening: Scalar, K: Arithmetic) -> Matrix:
    """sigma' = C : (D - D^p) of J2 plasticity where it flows: D^p = 3/2 s/q alpha', alpha' = 3 mu (s : D)/(q (3 mu + H)).

    sigma and D in three dimensions; from f = q - sigma_y - H alpha = 0 and f' = 0 with q^2 = 3/2 s : s.
    """
    one = K.number(1)
    s = combined(one, sigma, -trace(sigma) / 3, identity(3, K))
    q_squared = 3 * contraction(s, s) / 2
    flow = 9 * C.shear * contraction(s, D) / (2 * (3 * C.shear + hardening) * q_squared)
    return isotropic(combined(one, D, -flow, s), C, K)


@equation(24)
def nominal_stress(F: Matrix, sigma: Matrix, K: Arithmetic) -> Matrix:
    """P_ki = F^-1_kj sigma_ij J   (24); a stress."""
    J = determinant(F)
    return [[J * p for p in row] for row in product(inverse(F, K), transpose(sigma))]


@equation(24)
def nominal_work(grad_delta_u: Matrix, P: Matrix) -> Scalar:
    """d(delta u_i)/dX_k P_ki   (24), left, with grad_delta_u[i][k]; per undeformed volume."""
    return contraction(grad_delta_u, transpose(P))


@equation(24)
def cauchy_work(grad_delta_u: Matrix, F: Matrix, sigma: Matrix, K: Arithmetic) -> Scalar:
    """d(delta u_i)/dX_k F^-1_kj sigma_ij J   (24), right; per undeformed volume."""
    return determinant(F) * contraction(product(grad_delta_u, inverse(F, K)), sigma)
