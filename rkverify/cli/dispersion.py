"""rkverify dispersion"""

from argparse import Namespace
from math import pi

from rkverify.arithmetic.native import Float
from rkverify.cli.tables import write_table
from rkverify.errors import BadInput
from rkverify.stability.dispersion import Setting
from rkverify.stability.dispersion import dispersion as roots


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
        convective=not options.no_convective,
        half_point=options.half_point,
        derivative=options.derivative,
        kernel=options.kernel,
        order=options.order,
        layer=options.layer,
    )
    if options.samples < 1:
        raise BadInput(f"--samples {options.samples}: ask for at least one")
    kh = options.kh or [pi * j / options.samples for j in range(1, options.samples + 1)]
    branches = roots(setting, kh, Float())
    columns = ["kh", "root", "omega_re", "omega_im", "omega2_re", "omega2_im", "growth"]
    with_D = any(branch.D is not None for branch in branches)
    rows = [
        [b.kh, b.root, b.omega.re, b.omega.im, *b.omega.squared, b.omega.growth, *([b.D] if with_D else [])]
        for b in branches
    ]
    # 0.0 and -0.0 are the same frequency.
    clean = [[value + 0.0 if isinstance(value, float) else value for value in row] for row in rows]
    write_table([*columns, "D"] if with_D else columns, clean, options.json, options.out)
    return 0
