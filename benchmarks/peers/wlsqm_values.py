"""wlsqm's weighted least-squares fits: sensitivity of the fitted value and first derivatives to the data at the nodes.

Run as `python wlsqm_values.py FOLDER` in the peers' environment.
"""

import sys
from pathlib import Path

import numpy as np
import wlsqm
from tables import Provenance, columns, read, within, write_values

RADII = {1: 2.2, 2: 3.1}
FITS = {1: wlsqm.fit_1D, 2: wlsqm.fit_2D, 3: wlsqm.fit_3D}
WEIGHTS = {"uniform": wlsqm.WEIGHT_UNIFORM, "centre": wlsqm.WEIGHT_CENTER}


def sensitivities(
    nodes: np.ndarray, points: np.ndarray, radius: float, order: int, weighting: int
) -> list[list[float]]:
    """Rows point, node, value, gradient; the data are the nodes nearer than the radius, nothing is known at the point."""
    d = nodes.shape[1]
    rows = []
    for point, place in enumerate(points):
        found = within(nodes, place, radius)
        count = wlsqm.number_of_dofs(d, order)
        sens, fitted = np.zeros((len(found), count)), np.zeros(count)
        known = np.ascontiguousarray(nodes[found] if d > 1 else nodes[found, 0])
        FITS[d](
            xk=known,
            fk=np.zeros(len(found)),
            xi=np.ascontiguousarray(place) if d > 1 else float(place[0]),
            fi=fitted,
            sens=sens,
            do_sens=1,
            order=order,
            knowns=0,
            weighting_method=weighting,
        )
        rows += [[point, node, *sens[k, : 1 + d]] for k, node in enumerate(found)]
    return rows


def main(into: Path) -> None:
    """All tables."""
    told = Provenance(into, "wlsqm", wlsqm.__version__)
    for name in ("line", "plane", "box"):
        nodes, points = read(f"nodes_{name}")[0], read(f"points_{name}")[0]
        for order, radius in RADII.items():
            for kind, weighting in WEIGHTS.items():
                if name == "box" and order == 2 and kind == "uniform":
                    continue  # 1500 rows that show nothing new
                table = f"wlsqm_{name}_order{order}_{kind}"
                write_values(
                    into, table, columns(nodes.shape[1]), sensitivities(nodes, points, radius, order, weighting)
                )
                told.add(table, f"fit, weights {kind}", f"nodes_{name}", f"points_{name}", radius, order)
    told.write()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
