"""With one sign or one coefficient of a transcription wrong, the ledger says so: verdicts are computed, not written down.

Each case runs the study concerned in a copy of the checkout with one line changed, and compares the ledger with that of
an unchanged copy. A verdict that stays the same was not drawn from the line.
"""

import pytest

PAPER = "rkverify/paper"
SEMI = f"{PAPER}/printed_semi_lagrangian.py"
BAR = f"{PAPER}/printed_lagrangian.py"
CHAIN = f"{PAPER}/semi_lagrangian_equations.py"

# study, file, right, wrong, entries whose state must change
CASES = {
    "(12), a coefficient": (
        "kernels", "rkverify/kernels.py", "(Fraction(-16, 3), Fraction(1, 2), 3)", "(Fraction(16, 3), Fraction(1, 2), 3)",
        ["E12", "C16"],
    ),
    "(2), the basis with the sign of x_I - x": (
        "shape_functions", f"{PAPER}/shape.py",
        "return {I: inner(b, basis(A.offset(x, I), A.order, A.K)) * phi(A, x, I)",
        "return {I: inner(b, basis(tuple(-c for c in A.offset(x, I)), A.order, A.K)) * phi(A, x, I)",
        ["E2", "E3", "E4", "E9", "E28", "E29", "E30", "C15"],
    ),
    "(26), the support": (
        "material_rates", f"{PAPER}/approximation.py", "return self.K.norm(self.offset(x, node)) / self.supports[node]",
        "return self.K.norm(self.offset(x, node)) / self.supports[node] * self.K.ratio(9, 10)", ["E26", "E35", "E70"],
    ),
    "(35), the sign": (
        "material_rates", f"{PAPER}/kernel_rates.py", "return slope * dot(direction(A, x, node), minus(v, v_node))",
        "return -slope * dot(direction(A, x, node), minus(v, v_node))", ["E35", "E70", "C10"],
    ),
    "(40), the sign": (
        "material_rates", f"{PAPER}/material_rates.py", "I: correction(A, x, A.offset(x, I)) * semi_lagrangian",
        "I: -correction(A, x, A.offset(x, I)) * semi_lagrangian", ["E40", "E68"],
    ),
    "(39), with the rate that it leaves out": (
        "material_rates", f"{PAPER}/material_rates.py", "    star = psi_star(A, x, v, node_velocities)\n",
        "    star = true_rate(A, x, v, node_velocities)\n", ["E39", "C25"],
    ),
    "(52), plus for minus": (
        "gradients", f"{PAPER}/gradients.py", "(_at(right, I, A) - _at(left, I, A))", "(_at(right, I, A) + _at(left, I, A))",
        ["E52", "E64", "E72", "E80"],
    ),
    "(63), a coefficient": (
        "figure4", BAR, "    return c_squared * total\n", "    return 2 * c_squared * total\n", ["E63", "C31", "C34", "C67"],
    ),
    "(75), the sign of the term in the velocities": (
        "printed_consequences", SEMI, " + slope * (\n", " - slope * (\n", ["E62", "E76", "E82", "C38", "C48"],
    ),
    "(76), a sign in the term with omega": (
        "printed_consequences", SEMI, "+ s.Psi_h * K.sin(2 * kh))\n        - 2 * (q.modulus + q.sigma)",
        "- s.Psi_h * K.sin(2 * kh))\n        - 2 * (q.modulus + q.sigma)", ["E62", "E76", "E77", "C38"],
    ),
    "(78), the sign of B": (
        "printed_consequences", SEMI, "return -2 * q.Q * s.C_h", "return 2 * q.Q * s.C_h", ["E77", "E78", "E83", "E84"],
    ),
    "(79), the sign of the product": (
        "printed_consequences", SEMI, "return B**2 - 4 * constant", "return B**2 + 4 * constant",
        ["E79", "E85", "C39", "C40"],
    ),
    "(84), the sign of the stress term": (
        "printed_consequences", SEMI, "+ 2 * q.sigma / q.rho * s.Psi_xx_h) * (1 - K.cos(kh))",
        "- 2 * q.sigma / q.rho * s.Psi_xx_h) * (1 - K.cos(kh))", ["E83", "E84", "E85", "C49", "C60"],
    ),
    "(87), the sign of the stress term": (
        "printed_consequences", SEMI, "(1 - K.cos(2 * kh)) - 2 * q.sigma / q.rho", "(1 - K.cos(2 * kh)) + 2 * q.sigma / q.rho",
        ["E87", "C54"],
    ),
    "(78), the sign of the term in Q": (
        "figure5", SEMI, "return -4 * q.Q**2", "return 4 * q.Q**2", ["F5", "C44"],
    ),
    "(67), without the measure of the cell": (
        "two_routes", CHAIN, "b[node] * self.stress(K, state) * self.measure(K, state)", "b[node] * self.stress(K, state)",
        ["E65", "E66", "E67", "E69"],
    ),
    "(50), without the traction": (
        "two_routes", f"{PAPER}/lagrangian_equations.py", "at_boundary.get(node, self.K.zero()) * h0", "self.K.zero() * h0",
        ["E50"],
    ),
    "(66), Psi_I left out": (
        "convective_term", CHAIN, "self.masses[K] * Psi[node] * rate", "self.masses[K] * rate", ["E65"],
    ),
    "the sign of the internal force in the other route": (
        "stability_layers", "rkverify/solid/chain.py", "internal = B_measure.T @ stress", "internal = -(B_measure.T @ stress)",
        ["C42", "C45", "C59", "C71"],
    ),
}  # fmt: skip


STUDIES = sorted({study for study, *_ in CASES.values()})


@pytest.mark.parametrize("case", CASES)
def test_a_wrong_line_changes_the_verdict(case, copy, unpatched):
    study, file, right, wrong, concerned = CASES[case]
    root, before = unpatched(STUDIES)
    patched = copy(root)
    patched.patch(file, right, wrong)
    after = patched.states([study])
    assert set(concerned) <= before.keys()
    assert before.keys() == after.keys()
    assert [id for id in concerned if after[id] == before[id]] == [], "their verdicts did not notice"


def test_an_unchanged_copy_gives_the_same_states(copy, unpatched):
    """The other half of the comparison: nothing but the changed line makes the difference."""
    root, before = unpatched(STUDIES)
    assert copy(root).states(["kernels"]) == before
