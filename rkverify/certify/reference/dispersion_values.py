"""Reference values of dispersion: (63), the printed coefficients of (76)-(85), and the symbols of the linearised equations.

The layers are never merged: `printed` is the formula in print, `as-defined` the linearisation with N of (43), `consistent`
the same with the true rate. Symbols are the matrices from the amplitudes of x, v, stress to those of their rates.
"""

from dataclasses import dataclass
from fractions import Fraction

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.certify.reference.by_definition import number
from rkverify.certify.reference.case import Inputs, Subject, Values, texts
from rkverify.certify.reference.waves_by_definition import DisturbedChain, omega_squared_63, printed
from rkverify.paper import printed_semi_lagrangian as semi
from rkverify.paper.notation import lattice_values
from rkverify.paper.printed_lagrangian import b_hat, omega_squared
from rkverify.readings import Derivative, HalfPoint, Integration, Readings
from rkverify.stability.jacobian_paper import linearise
from rkverify.stability.lattice_state import Base
from rkverify.stability.printed import PrintedQuadratic
from rkverify.stability.symbol import transform

WAVES = tuple(map(Fraction, ("1/2", "3/2", "3")))
KINDS = ("x", "v", "stress")
COMMON = {"kernel": "cubic", "order": 1, "spacing": "1", "modulus": "1", "density": "1"}


@dataclass(frozen=True)
class Lagrangian:
    """omega^2 of (63) with c = 1 at several kh."""

    support_ratio: str

    def subject(self) -> Subject:
        """The case with its two routes."""
        inputs = {**COMMON, "support_ratio": self.support_ratio, "kh": texts(WAVES)}
        name = f"(63), R = {self.support_ratio}"
        return Subject(name, (61, 63, 64), "printed", inputs, {"omega2": "1/time^2"}, self.literal, self.defined)

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        b = b_hat(1, self.support_ratio, K)
        return {f"omega2[{k}]": omega_squared(b, K.number(1), K.number(kh), K) for k, kh in enumerate(WAVES)}

    def defined(self) -> Values:
        """By definition."""
        R = number(Fraction(self.support_ratio))
        return {f"omega2[{k}]": omega_squared_63(R, number(kh)) for k, kh in enumerate(WAVES)}


@dataclass(frozen=True)
class Wave:
    """SCNI or DNI, R, sigma/C^sigma, Q, readings."""

    integration: Integration
    support_ratio: str
    stress_ratio: str
    velocity_gradient: str
    half_point: HalfPoint = "edge"
    derivative: Derivative = "full"

    def inputs(self) -> Inputs:
        """As JSON data."""
        state = {"support_ratio": self.support_ratio, "stress_ratio": self.stress_ratio}
        return {**COMMON, **state, "velocity_gradient": self.velocity_gradient, "integration": self.integration}

    def title(self, layer: str) -> str:
        """The name of the case."""
        state = f"R = {self.support_ratio}, sigma/C = {self.stress_ratio}, Q = {self.velocity_gradient}"
        reading = self.half_point if self.integration == "scni" else self.derivative
        return f"{layer}, {self.integration} ({reading}), {state}"


@dataclass(frozen=True)
class Printed:
    """B, the constant C or A, and D of (77)-(79), (83)-(85)."""

    wave: Wave

    def subject(self) -> Subject:
        """The case with its two routes."""
        w = self.wave
        inputs = {**w.inputs(), "half_point": w.half_point, "derivative": w.derivative, "kh": texts(WAVES)}
        numbers = (75, 76, 77, 78, 79) if w.integration == "scni" else (81, 82, 83, 84, 85)
        units = {"B": "1/time", "constant": "1/time^2", "D": "1/time^2"}
        reading = f"printed; {w.half_point if w.integration == 'scni' else w.derivative}"
        return Subject(w.title("printed"), numbers, reading, inputs, units, self.literal, self.defined)

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription."""
        w, found = self.wave, dict[str, Scalar]()
        values = lattice_values(1, w.support_ratio, K, w.half_point, w.derivative)
        relation = PrintedQuadratic(values, w.integration, K)
        state = relation.state(w.stress_ratio, w.velocity_gradient)
        constant = semi.scni_constant if w.integration == "scni" else semi.dni_constant
        for k, kh in enumerate(map(K.number, WAVES)):
            found[f"B[{k}]"] = relation.linear(state, kh)
            found[f"constant[{k}]"] = constant(values, state, kh, K)
            found[f"D[{k}]"] = relation.discriminant(state, kh)
        return found

    def defined(self) -> Values:
        """By definition."""
        w, found = self.wave, dict[str, Scalar]()
        R, s, Q = (number(Fraction(q)) for q in (w.support_ratio, w.stress_ratio, w.velocity_gradient))
        for k, kh in enumerate(map(number, WAVES)):
            for name, value in printed(w.integration, R, s, Q, kh, w.half_point, w.derivative).items():
                found[f"{name}[{k}]"] = value
        return found


@dataclass(frozen=True)
class Linearised:
    """The symbol at one kh, and omega^2 of it where nothing moves."""

    wave: Wave
    layer: str
    kh: Fraction = Fraction(3, 2)

    def subject(self) -> Subject:
        """The case with its two routes."""
        w = self.wave
        inputs = {**w.inputs(), "derivative": w.derivative, "layer": self.layer, "kh": texts(self.kh)}
        numbers = (65, 66, 67, 68, 70, 71, 72 if w.integration == "scni" else 80, 73)
        units = dict.fromkeys(("symbol_re", "symbol_im"), "rate of the row's variable per the column's")
        units["omega2"] = "1/time^2"
        reading = f"{self.layer}; {w.derivative}"
        return Subject(w.title(self.layer), numbers, reading, inputs, units, self.literal, self.defined)

    def base(self) -> Base:
        """The base state."""
        w = self.wave
        rate = "true" if self.layer == "consistent" else "psi-star"
        readings = Readings(w.integration, "true" if rate == "true" else "psi-star", w.derivative)
        return Base(w.support_ratio, readings, w.stress_ratio, w.velocity_gradient)

    def literal(self, K: Arithmetic) -> Values:
        """Through the transcription with duals."""
        stencil, found = linearise(self.base(), K).stencil, dict[str, Scalar]()
        for i, row in enumerate(KINDS):
            for j, column in enumerate(KINDS):
                part = transform(stencil[row, column], K.number(self.kh), K)
                found[f"symbol_re[{i}][{j}]"], found[f"symbol_im[{i}][{j}]"] = part.re, part.im
        return self._with_frequency(found)

    def defined(self) -> Values:
        """By differences of the chain."""
        w = self.wave
        R, s, Q = (number(Fraction(q)) for q in (w.support_ratio, w.stress_ratio, w.velocity_gradient))
        chain = DisturbedChain(R, s, Q, w.integration, w.derivative, self.layer == "consistent")
        return self._with_frequency(chain.symbol(number(self.kh)))

    def _with_frequency(self, found: dict[str, Scalar]) -> Values:
        """omega^2 = -(A_vx + A_vs A_sv), where the stress follows the displacement as its rate follows the velocity."""
        if Fraction(self.wave.velocity_gradient) == 0:
            followed = found["symbol_re[1][2]"] * found["symbol_re[2][1]"]
            turned = found["symbol_im[1][2]"] * found["symbol_im[2][1]"]
            found["omega2[0]"] = -(found["symbol_re[1][0]"] + followed - turned)
        return found


def subjects() -> list[Subject]:
    """All cases."""
    lagrangian = [Lagrangian(R) for R in ("3/2", "5/2", "7/2")]
    print_of = [
        Wave("scni", "3/2", "1/2", "1"), Wave("scni", "7/4", "-3/2", "1/4"), Wave("scni", "3/2", "1/2", "1", "literal"),
        Wave("dni", "3/2", "1/2", "1"), Wave("dni", "7/4", "-3/2", "1/4"), Wave("dni", "7/4", "1/2", "1", "edge", "diffuse"),
    ]  # fmt: skip
    rest = [Linearised(Wave(name, R, "1/4", "0"), "as-defined") for name in ("scni", "dni") for R in ("3/2", "5/2")]
    rest += [Linearised(Wave("dni", "7/4", "-1/4", "0", "edge", "diffuse"), "as-defined")]
    moving = [Linearised(Wave(name, "7/4", "1/4", "1/2"), layer) for name in ("scni", "dni") for layer in ("as-defined", "consistent")]  # fmt: skip
    linearised = [case.subject() for case in (*rest, *moving)]
    return [*(case.subject() for case in lagrangian), *(Printed(wave).subject() for wave in print_of), *linearised]
