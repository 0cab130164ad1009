"""rkverify bloch"""

from argparse import Namespace
from typing import Any

import numpy as np

from rkverify.arithmetic.native import finite, rational
from rkverify.cli.tables import write_table
from rkverify.errors import BadInput
from rkverify.solid.materials.moduli import Moduli
from rkverify.stability.bloch.lattices import lattice
from rkverify.stability.bloch.linearised import linearised
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import Scheme
from rkverify.stability.bloch.symbol import known_part, modes

COLUMNS = ["mode", "omega2_re", "omega2_im", "growth"]


def bloch(options: Namespace) -> int:
    """Print the modes of plane waves on a uniformly stressed lattice."""
    nodes = lattice(options.lattice)
    part = known_part(options.part)
    scheme = Scheme(
        integration=options.integration,
        support=_number("--support-ratio", options.support_ratio),
        edge_rule=options.edge_rule,
        derivative=options.derivative,
        cell_measure=options.cell_measure,
        kernel=options.kernel,
        order=options.order,
        window=options.window,
    )
    xx, yy, xy = _numbers("--stress", options.stress, "SXX,SYY,SXY")
    lame, shear = _numbers("--moduli", options.moduli, "LAMBDA,MU")
    loading = Loading((xx, yy, xy), Moduli(lame, shear), options.stress_law)
    k = np.array([_numbers("--k", text, "KX,KY") for text in options.k])
    found = modes(linearised(nodes, scheme), loading, k, part)
    rows: list[list[Any]] = []
    for place, squares, growths in zip(k.tolist(), found.omega_squared, found.growth, strict=True):
        for mode, (square, growth) in enumerate(zip(squares, growths, strict=True)):
            row = [mode, float(square.real) + 0.0, float(square.imag) + 0.0, float(growth)]
            rows.append([*place, *row] if len(k) > 1 else row)
    write_table(["kx", "ky", *COLUMNS] if len(k) > 1 else COLUMNS, rows, options.json, options.out)
    return 0


def _number(option: str, text: str) -> float:
    try:
        return finite(rational(text.strip()))
    except BadInput as error:
        raise BadInput(f"{option} {text}: {error}") from None


def _numbers(option: str, text: str, wanted: str) -> list[float]:
    parts = text.split(",")
    if len(parts) != len(wanted.split(",")):
        raise BadInput(f"{option} {text}: {len(parts)} numbers; write {wanted}")
    return [_number(option, part) for part in parts]
