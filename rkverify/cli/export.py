"""rkverify export"""

from argparse import Namespace
from pathlib import Path

from rkverify.errors import BadInput
from rkverify.paths import Checkout, checkout
from rkverify.report import crate, latex


def export(options: Namespace) -> int:
    """Write results for a paper, or the metadata of the report."""
    return _latex(checkout(), options) if options.latex else _crate(checkout(), options)


def _latex(place: Checkout, options: Namespace) -> int:
    if options.rows < 1:
        raise BadInput(f"--rows {options.rows}: ask for at least one")
    if options.out is None:
        raise BadInput("--latex writes many files: say where with --out DIR")
    folder = Path(options.out)
    written, left_out = latex.export(place, options.names, folder, options.rows)
    print(f"wrote {len(written)} files; {folder / latex.EXAMPLE} uses all of them")
    if left_out:
        print(f"left out for more than {options.rows} rows: {', '.join(left_out)}")
    return 0


def _crate(place: Checkout, options: Namespace) -> int:
    if options.names:
        raise BadInput(f"--ro-crate describes the whole report: leave {' '.join(options.names)} out")
    path = crate.write(place, Path(options.out) if options.out else None)
    print(f"wrote {place.shown(path)}")
    return 0
