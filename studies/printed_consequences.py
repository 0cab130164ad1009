"""The printed relations against their own printed consequences, by machine algebra."""

from collections.abc import Sequence
from dataclasses import dataclass

from rkverify.certify import consequences
from rkverify.workflow.compare import Exact
from rkverify.workflow.study import Statement, Study, Tables, table


@dataclass(frozen=True)
class Parameters:
    """Nothing to choose: every value is a symbol."""


def compute(p: Parameters) -> Tables:
    """The residual of every step."""
    return {
        "steps": table(
            [{"step": s.name, "follows": s.follows, "residual": str(s.residual)} for s in consequences.steps()],
            [
                ("step", "", "from which relation to which, under which sign of omega t in (62)"),
                ("follows", "", "whether the residual is identically zero"),
                ("residual", "1/time^2", "what is left, E = e^{i kh}"),
            ],
            "Steps between printed relations with every value a free symbol.",
            Exact(),
        )
    }


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Which steps follow, and what the printed discriminants say by themselves."""
    frame = tables["steps"].frame.set_index("step")

    def follows(*names: str) -> bool:
        return bool(frame.loc[list(names), "follows"].all())

    anything = "all values of all symbols"
    scni, dni = consequences.scni_discriminant(), consequences.dni_discriminant()
    squares = consequences.scni_as_squares() == 0
    gain = {name: consequences.convective_gain(D) == 0 for name, D in (("SCNI", scni), ("DNI", dni))}
    even = consequences.is_even_in(scni, consequences.Q)
    at_pi, still = (consequences.as_printed(consequences.dni_at_pi(at_rest)) for at_rest in (False, True))
    at_pi_as_expected = consequences.dni_vanishes_with_the_stress_term()

    def proved(
        name: str, about: tuple[str, ...], says: str, holds: bool, reading: str = "", routes: tuple[str, ...] = ()
    ) -> Statement:
        layer = "" if routes else "printed"
        return Statement(name, about, says, holds, anything, "proved", layer=layer, reading=reading, routes=routes)

    return [
        proved(
            "76", ("E76", "C38"), "(76) is (75) with the plane wave e^{i(kx + omega t)}.", follows("(75) -> (76), plus")
        ),
        proved(
            "82", ("E82", "C48"), "(82) is (81) with the plane wave e^{i(kx + omega t)}.", follows("(81) -> (82), plus")
        ),
        proved(
            "62",
            ("E62",),
            "Of the two signs that the scan of (62) leaves open only the plus sign leads from (75) to (76) and from (81) to (82).",
            follows("(75) -> (76), plus", "(81) -> (82), plus")
            and not follows("(75) -> (76), minus")
            and not follows("(81) -> (82), minus"),
            routes=("(75) -> (76)", "(81) -> (82)"),
        ),
        proved(
            "77_to_79",
            ("E77", "E78", "E79"),
            "(77)-(79) restate (76): same polynomial, and D under the root.",
            follows("(76) = (77) with (78)", "(79) is the discriminant of (77)"),
            routes=("(76) expanded", "roots put in"),
        ),
        proved(
            "83_to_85",
            ("E83", "E84", "E85"),
            "(83)-(85) restate (82): same polynomial, and D under the root.",
            follows("(82) = (83) with (84)", "(85) is the discriminant of (83)"),
            routes=("(82) expanded", "roots put in"),
        ),
        proved(
            "86_87",
            ("E86", "E87", "C54"),
            "(86) and (87) are (76) and (82) without every term that carries Q.",
            follows("(76) without its Q terms -> (86)", "(82) without its Q terms -> (87)"),
        ),
        proved(
            "real_roots",
            ("C39",),
            "B and C of (77) are real, so that D > 0 is the condition for two different real roots omega, whose waves keep their amplitude.",
            follows("(79) is the discriminant of (77)", "(85) is the discriminant of (83)"),
            "D > 0",
        ),
        proved(
            "double_root",
            ("C39",),
            "Where D = 0 both roots are the same, and t e^{i omega t} is a solution beside e^{i omega t}: omega is real, and the wave grows without bound.",
            not consequences.double_root_drifts(),
            "D = 0",
        ),
        proved(
            "non_negative",
            ("C40", "C42"),
            "D of (79) is a sum of squares with non-negative weights where C^sigma + sigma >= 0.",
            squares,
        ),
        proved("sign_of_Q", ("C43",), "D of (79) does not change when Q changes its sign.", even),
        proved(
            "gain_scni",
            ("C4", "C56"),
            "With the convective term D of (79) is larger by B^2 + (4 Q C(h) phi'(h)/R)^2 (1 - cos kh), never smaller.",
            gain["SCNI"],
        ),
        proved(
            "gain_dni",
            ("C58",),
            "With the convective term D of (85) is larger by the same squares, never smaller.",
            gain["DNI"],
        ),
        proved(
            "no_tensile_instability",
            ("C59",),
            "(86) is (C^sigma + sigma) times squares: stress alone, with C^sigma + sigma >= 0, gives no negative omega^2.",
            squares and follows("(76) without its Q terms -> (86)"),
        ),
        proved(
            "tensile_instability",
            ("C60",),
            f"At kh = pi four times (87) is {still}: negative exactly when sigma Psi,xx(h) > 0.",
            at_pi_as_expected,
        ),
        proved(
            "sign_of_stress_term",
            ("C49",),
            f"Without Q, D at kh = pi is {still}, and sigma Psi,xx(h) <= 0 with C^sigma + sigma >= 0 makes D >= 0 at every kh: its sign decides.",
            at_pi_as_expected,
            "Q = 0",
        ),
        proved(
            "sign_of_stress_term_Q",
            ("C49",),
            f"With Q, D at kh = pi is {at_pi}: a positive sigma Psi,xx(h) turns it only beyond 2 rho (Q C(h) phi'(h)/R)^2.",
            consequences.stress_sign_alone_decides(),
            "Q not 0",
        ),
    ]


STUDY = Study("Printed relations and their printed consequences", Parameters(), Parameters(), compute, judge)
