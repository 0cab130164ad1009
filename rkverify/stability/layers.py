"""omega(kh) of a formulation in one layer: printed, as-defined, consistent or simulated; never merged."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Literal, get_args

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.native import Float
from rkverify.errors import BadInput, UnknownName
from rkverify.paper import printed_lagrangian
from rkverify.paper.notation import lattice_values
from rkverify.readings import DERIVATIVES, HALF_POINTS, INTEGRATIONS, Convection, HalfPoint, Integration, Readings
from rkverify.stability import jacobian_paper, jacobian_solid, lagrangian, simulate
from rkverify.stability.lattice_state import Base
from rkverify.stability.printed import PrintedQuadratic
from rkverify.stability.roots import Root, quadratic_roots
from rkverify.stability.symbol import eigenvalue_roots, omega_squared_at_rest, transform

Formulation = Literal["lagrangian", "semi-lagrangian"]
Layer = Literal["printed", "as-defined", "consistent", "simulated"]
FORMULATIONS: tuple[Formulation, ...] = get_args(Formulation)
LAYERS: tuple[Layer, ...] = get_args(Layer)
SEMI_LAGRANGIAN_ONLY = ("stress_law", "node_motion", "cell_edges", "cell_measure", "support_radius")


@dataclass(frozen=True)
class Setting:
    """What a dispersion relation depends on, rho = 1 and modulus = 1.

    support_ratio R and stress_ratio (sigma/C^sigma, or S/C^SE) are dimensionless; stretch is F of the base x = F X; velocity_gradient
    is Q in 1/time; spacing is h; frame_velocity is that of the node at which the equation is written. Numbers may be
    strings such as "3/2", which are exact. layer: `printed` is the formula in print; `as-defined` the linearisation of
    the semi-discrete equations as the paper defines them; `consistent` the same with the true material rate of the shape
    functions; `simulated` what a nonlinear computation shows. The readings (`Readings`) count in the last three.
    (75)-(87) are printed for 1 < R < 2; for another R they are evaluated as they stand.
    """

    formulation: Formulation
    integration: Integration
    support_ratio: Scalar
    stress_ratio: Scalar = 0
    stretch: Scalar = 1
    velocity_gradient: Scalar = 0
    spacing: Scalar = 1
    frame_velocity: Scalar = 0
    convective: bool = True
    half_point: HalfPoint = "edge"
    derivative: Literal["full", "diffuse", "frozen-b", "frozen"] = "full"
    stress_law: Literal["truesdell", "cauchy-rate", "literal"] = "truesdell"
    node_motion: Literal["coefficient", "field"] = "coefficient"
    cell_edges: Literal["voronoi", "material", "fixed"] = "voronoi"
    cell_measure: Literal["edges", "material", "fixed"] = "edges"
    support_radius: Literal["fixed", "spacing"] = "fixed"
    mass: Literal["lumped", "consistent"] = "lumped"
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
        self.readings("none")

    def readings(self, convection: Convection) -> Readings:
        """The readings with the given convective term; raises UnknownName."""
        return Readings(
            self.integration,
            convection,
            self.derivative,
            self.stress_law,
            self.node_motion,
            self.cell_edges,
            self.cell_measure,
            self.support_radius,
            self.mass,
        )

    def base(self) -> Base:
        """The uniform base state of the semi-Lagrangian equations in this layer."""
        with_term: Convection = "true" if self.layer == "consistent" else "psi-star"
        return Base(
            self.support_ratio,
            self.readings(with_term if self.convective else "none"),
            self.stress_ratio,
            self.velocity_gradient,
            self.spacing,
            self.frame_velocity,
            self.kernel,
            self.order,
        )

    def bar(self) -> lagrangian.StretchedBar:
        """The stretched bar of the Lagrangian equations."""
        return lagrangian.StretchedBar(
            self.support_ratio,
            self.integration,
            self.stress_ratio,
            self.stretch,
            self.spacing,
            self.derivative,
            self.kernel,
            self.order,
            self.mass,
        )


@dataclass(frozen=True)
class Branch:
    """One root at one kh, with D where the paper defines it and the uncertainty of a measured growth (1/time)."""

    kh: Scalar
    root: int
    omega: Root
    D: Scalar | None = None
    uncertainty: float | None = None


def dispersion(setting: Setting, kh: Sequence[Scalar], K: Arithmetic | None = None) -> list[Branch]:
    """The roots omega at every kh (dimensionless) in the setting's layer.

    A simulation takes the nearest kh that fits on its chain, and says which. Raises BadInput where the paper prints no
    such relation or an option does not belong to the formulation; TooFewNodes where R is too small for the order.

    >>> branches = dispersion(Setting("semi-lagrangian", "scni", "3/2"), [1.0])
    >>> round(branches[0].omega.re, 6)
    0.841471
    """
    K = K or Float()
    _refuse_strangers(setting, K)
    solve = {
        ("lagrangian", "printed"): _lagrangian_printed,
        ("semi-lagrangian", "printed"): _semi_lagrangian_printed,
        ("lagrangian", "simulated"): _simulated,
        ("semi-lagrangian", "simulated"): _simulated,
    }.get((setting.formulation, setting.layer), _linearised)
    return solve(setting, kh, K)


def _refuse_strangers(setting: Setting, K: Arithmetic) -> None:
    def moves(value: Scalar) -> bool:
        return K.sign(K.number(value)) != 0

    if setting.formulation == "lagrangian":
        if moves(setting.velocity_gradient) or moves(setting.frame_velocity):
            raise BadInput(
                "the Lagrangian form knows no velocity of the base: leave --velocity-gradient and --frame-velocity out"
            )
        _refuse_choices(setting, SEMI_LAGRANGIAN_ONLY, "the Lagrangian form has")
        if setting.integration == "dni" and setting.layer == "printed":
            raise BadInput(
                "the paper prints no Lagrangian relation with DNI: choose --integration scni or --layer as-defined"
            )
    elif K.sign(K.number(setting.stretch) - 1) != 0:
        raise BadInput("the semi-Lagrangian relations have no stretch F: leave --stretch out")
    if setting.layer == "printed":
        if moves(setting.frame_velocity):
            raise BadInput("the printed relations know no frame: leave --frame-velocity out or choose another layer")
        _refuse_choices(setting, (*SEMI_LAGRANGIAN_ONLY, "mass"), "a printed relation has")
    else:
        _refuse_choices(setting, ("half_point",), "a linearisation or simulation has")


def _refuse_choices(setting: Setting, names: Sequence[str], what: str) -> None:
    for field in fields(setting):
        if field.name in names and getattr(setting, field.name) != field.default:
            option = field.name.replace("_", "-")
            raise BadInput(f"{what} no choice of the {option.replace('-', ' ')}: leave --{option} out")


def _branches(kh: Scalar, roots: Sequence[Root], D: Scalar | None = None) -> list[Branch]:
    return [Branch(kh, index, root, D) for index, root in enumerate(roots)]


def _lagrangian_printed(setting: Setting, kh: Sequence[Scalar], K: Arithmetic) -> list[Branch]:
    b = printed_lagrangian.b_hat(setting.spacing, setting.support_ratio, K, setting.kernel, setting.order)
    c_squared = printed_lagrangian.tangent(K.number(1), K.number(setting.stretch), K.number(setting.stress_ratio))
    return _undamped(kh, lambda theta: printed_lagrangian.omega_squared(b, c_squared, theta, K), K)


def _undamped(kh: Sequence[Scalar], omega_squared: Callable[[Scalar], Scalar], K: Arithmetic) -> list[Branch]:
    found = []
    for value in kh:
        theta = K.number(value)
        found += _branches(theta, quadratic_roots(K.zero(), 4 * omega_squared(theta), K))
    return found


def _semi_lagrangian_printed(setting: Setting, kh: Sequence[Scalar], K: Arithmetic) -> list[Branch]:
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
    found = []
    for value in kh:
        theta = K.number(value)
        D = relation.discriminant(state, theta)
        roots = quadratic_roots(relation.linear(state, theta), D, K)
        found += _branches(theta, roots, D if setting.convective else None)
    return found


def _linearised(setting: Setting, kh: Sequence[Scalar], K: Arithmetic) -> list[Branch]:
    if setting.formulation == "lagrangian":
        stencil, mass = lagrangian.stencil(setting.bar(), K), lagrangian.mass_stencil(setting.bar(), K)
        return _undamped(kh, lambda theta: -transform(stencil, theta, K).re / transform(mass, theta, K).re, K)
    base = setting.base()
    if isinstance(K, Float):
        found = []
        whole = jacobian_solid.stencil(base)
        for value in kh:
            theta = K.number(value)
            found += _branches(theta, eigenvalue_roots(base, whole, theta))
        return found
    if not base.is_at_rest(K):
        raise BadInput(
            "a base in motion has complex roots, which are computed in double precision: leave --arithmetic, or "
            "--velocity-gradient and --frame-velocity, out"
        )
    exact = jacobian_paper.linearise(base, K).stencil
    return _undamped(kh, lambda theta: omega_squared_at_rest(base, exact, theta, K), K)


def _simulated(setting: Setting, kh: Sequence[Scalar], K: Arithmetic) -> list[Branch]:
    if not isinstance(K, Float):
        raise BadInput("simulations run in double precision: leave --arithmetic out")
    found = []
    for value in kh:
        theta = K.number(value)
        if setting.formulation == "lagrangian":
            measured = simulate.measure_bar(setting.bar(), theta)
        else:
            measured = simulate.measure(replace(setting, layer="as-defined").base(), theta)
        found += [
            Branch(measured.kh, index, root, None, measured.uncertainty) for index, root in enumerate(measured.roots)
        ]
    return found
