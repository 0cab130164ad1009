"""omega(kh) of a formulation in one layer: now the printed relations (63), (76), (82), (86), (87)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import Float
from rkverify.errors import BadInput, UnknownName
from rkverify.paper import printed_lagrangian
from rkverify.paper.notation import lattice_values
from rkverify.readings import DERIVATIVES, HALF_POINTS, INTEGRATIONS, Derivative, HalfPoint, Integration
from rkverify.stability.printed import PrintedQuadratic
from rkverify.stability.roots import Root, quadratic_roots

Formulation = Literal["lagrangian", "semi-lagrangian"]
Layer = Literal["printed"]
FORMULATIONS: tuple[Formulation, ...] = get_args(Formulation)
LAYERS: tuple[Layer, ...] = get_args(Layer)


@dataclass(frozen=True)
class Setting:
    """What a dispersion relation depends on, rho = 1 and modulus = 1.

    support_ratio R and stress_ratio (sigma/C^sigma, or S/C^SE) are dimensionless; stretch is F; velocity_gradient
    is Q in 1/time; spacing is h. Numbers may be strings such as "3/2", which are exact.
    """

    formulation: Formulation
    integration: Integration
    support_ratio: Scalar
    stress_ratio: Scalar = 0
    stretch: Scalar = 1
    velocity_gradient: Scalar = 0
    spacing: Scalar = 1
    convective: bool = True
    half_point: HalfPoint = "edge"
    derivative: Derivative = "full"
    kernel: str = "cubic"
    order: int = 1
    layer: Layer = "printed"

    def __post_init__(self) -> None:
        """Raises UnknownName for an unknown option."""
        for kind, value, known in (
            ("formulation", self.formulation, FORMULATIONS),
            ("integration", self.integration, INTEGRATIONS),
            ("layer", self.layer, LAYERS),
            ("half-point reading", self.half_point, HALF_POINTS),
            ("derivative", self.derivative, DERIVATIVES),
        ):
            if value not in known:
                raise UnknownName(kind, value, known)


@dataclass(frozen=True)
class Branch:
    """One root at one kh, with D where the paper defines it."""

    kh: Scalar
    root: int
    omega: Root
    D: Scalar | None


def dispersion(setting: Setting, kh: Sequence[Scalar], K: Arithmetic | None = None) -> list[Branch]:
    """The roots omega of the setting's relation at every kh (dimensionless), two for each.

    Raises BadInput where the paper prints no such relation; TooFewNodes where R is too small for the order.

    >>> branches = dispersion(Setting("semi-lagrangian", "scni", "3/2"), [1.0])
    >>> round(branches[0].omega.re, 6)
    0.841471
    """
    K = K or Float()
    if setting.formulation == "lagrangian":
        return _lagrangian(setting, kh, K)
    return _semi_lagrangian(setting, kh, K)


def _lagrangian(setting: Setting, kh: Sequence[Scalar], K: Arithmetic) -> list[Branch]:
    if setting.integration == "dni":
        raise BadInput("the paper prints no Lagrangian relation with DNI: choose --integration scni")
    if K.sign(K.number(setting.velocity_gradient)) != 0:
        raise BadInput("(63) has no velocity gradient: leave --velocity-gradient out for the Lagrangian form")
    b = printed_lagrangian.b_hat(setting.spacing, setting.support_ratio, K, setting.kernel, setting.order)
    c_squared = printed_lagrangian.tangent(K.number(1), K.number(setting.stretch), K.number(setting.stress_ratio))
    branches = []
    for value in kh:
        theta = K.number(value)
        squared = printed_lagrangian.omega_squared(b, c_squared, theta, K)
        for index, root in enumerate(quadratic_roots(K.zero(), 4 * squared, K)):
            branches.append(Branch(theta, index, root, None))
    return branches


def _semi_lagrangian(setting: Setting, kh: Sequence[Scalar], K: Arithmetic) -> list[Branch]:
    if K.sign(K.number(setting.stretch) - 1) != 0:
        raise BadInput("the semi-Lagrangian relations have no stretch F: leave --stretch out")
    values = lattice_values(
        setting.spacing,
        setting.support_ratio,
        K,
        setting.half_point,
        setting.derivative,
        setting.kernel,
        setting.order,
    )
    relation = PrintedQuadratic(values, setting.integration, K, setting.convective)
    state = relation.state(setting.stress_ratio, setting.velocity_gradient)
    branches = []
    for value in kh:
        theta = K.number(value)
        D = relation.discriminant(state, theta)
        for index, root in enumerate(quadratic_roots(relation.linear(state, theta), D, K)):
            branches.append(Branch(theta, index, root, D if setting.convective else None))
    return branches
