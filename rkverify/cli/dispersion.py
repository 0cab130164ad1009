"""rkverify dispersion"""

from argparse import Namespace
from typing import Any

from rkverify.arithmetic.base import Arithmetic, Scalar
from rkverify.arithmetic.named import arithmetic
from rkverify.cli.tables import write_table
from rkverify.errors import BadInput
from rkverify.stability.layers import Branch, Setting
from rkverify.stability.layers import dispersion as roots

COLUMNS = ["kh", "root", "omega_re", "omega_im", "omega2_re", "omega2_im", "growth"]


def dispersion(options: Namespace) -> int:
    """Print the roots of the dispersion relation."""
    setting = Setting(
        formulation=options.formulation,
        integration=options.integration,
        support_ratio=options.support_ratio,
        stress_ratio=options.stress_ratio,
        stretch=options.stretch,
        velocity_gradient=options.velocity_gradient,
        spacing=options.spacing,
        frame_velocity=options.frame_velocity,
        convective=not options.no_convective,
        half_point=options.half_point,
        derivative=options.derivative,
        stress_law=options.stress_law,
        node_motion=options.node_motion,
        cell_edges=options.cell_edges,
        cell_measure=options.cell_measure,
        support_radius=options.support_radius,
        mass=options.mass,
        kernel=options.kernel,
        order=options.order,
        layer=options.layer,
    )
    if options.samples < 1:
        raise BadInput(f"--samples {options.samples}: ask for at least one")
    K = arithmetic(options.arithmetic)
    kh = options.kh or [K.pi() * j / options.samples for j in range(1, options.samples + 1)]
    branches = roots(setting, kh, K)
    columns = list(COLUMNS)
    if any(branch.D is not None for branch in branches):
        columns.append("D")
    if any(branch.uncertainty is not None for branch in branches):
        columns.append("growth_uncertainty")
    rows = [[_printed(K, _row(branch)[column]) for column in columns] for branch in branches]
    write_table(columns, rows, options.json, options.out)
    return 0


def _row(branch: Branch) -> dict[str, Any]:
    omega = branch.omega
    values = [branch.kh, branch.root, omega.re, omega.im, *omega.squared, omega.growth]
    return {**dict(zip(COLUMNS, values, strict=True)), "D": branch.D, "growth_uncertainty": branch.uncertainty}


def _printed(K: Arithmetic, value: Scalar) -> Any:
    if isinstance(value, float):
        return value + 0.0  # 0.0 and -0.0 are the same frequency
    return value if isinstance(value, int) else K.text(value)
