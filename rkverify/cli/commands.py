"""What commands there are: names, options, examples. What they do stands in modules that are imported on use."""

import importlib
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import dataclass

Action = Callable[[Namespace], int]


@dataclass(frozen=True)
class Command:
    """One command of the command line."""

    name: str
    purpose: str
    description: str
    example: str
    add_options: Callable[[ArgumentParser], None]
    action: Action


def _later(module: str, function: str) -> Action:
    def act(options: Namespace) -> int:
        status: int = getattr(importlib.import_module(f"rkverify.cli.{module}"), function)(options)
        return status

    return act


def _output(parser: ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="JSON instead of CSV")
    parser.add_argument("--out", metavar="FILE", help="write to FILE instead of standard output")


def _kernel_and_order(parser: ArgumentParser) -> None:
    parser.add_argument("--order", type=int, default=1, metavar="N", help="order of the basis: 0, 1 or 2 (default 1)")
    parser.add_argument(
        "--kernel",
        default="cubic",
        metavar="NAME",
        help="tent, cubic (12), quartic, quintic, wendland-c2 or wendland-c4 (default cubic)",
    )
    parser.add_argument(
        "--derivative",
        default="full",
        metavar="READING",
        help="reading of the derivative: full, diffuse, frozen-b or frozen (default full)",
    )


def _shape(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--nodes", required=True, metavar="CSV", help="nodes, header x; a column a gives each its own support"
    )
    parser.add_argument("--points", required=True, metavar="CSV", help="points, header x")
    parser.add_argument("--support", metavar="A", help="support radius, in the nodes' unit of length")
    _kernel_and_order(parser)
    parser.add_argument(
        "--arithmetic", default="float", metavar="NAME", help="float, mp:DIGITS or exact (default float)"
    )
    _output(parser)


def _dispersion(parser: ArgumentParser) -> None:
    parser.add_argument("--formulation", required=True, metavar="NAME", help="lagrangian or semi-lagrangian")
    parser.add_argument("--integration", required=True, metavar="NAME", help="scni or dni")
    parser.add_argument(
        "--layer",
        default="printed",
        metavar="NAME",
        help="printed: the formula in print (default); as-defined: the linearisation of the equations as the paper defines "
        "them; consistent: the same with the true material rate; simulated: measured in a nonlinear computation",
    )
    parser.add_argument("--no-convective", action="store_true", help="without the convective term, (86), (87)")
    parser.add_argument("--support-ratio", required=True, metavar="R", help="support radius over spacing")
    parser.add_argument("--stress-ratio", default="0", metavar="S", help="sigma/C^sigma, or S/C^SE (default 0)")
    parser.add_argument("--stretch", default="1", metavar="F", help="deformation gradient, Lagrangian only (default 1)")
    parser.add_argument("--velocity-gradient", default="0", metavar="Q", help="Q, semi-Lagrangian only (default 0)")
    parser.add_argument("--spacing", default="1", metavar="H", help="nodal spacing (default 1)")
    parser.add_argument(
        "--half-point", default="edge", metavar="READING", help="C(h/2): literal or edge (default edge)"
    )
    parser.add_argument(
        "--frame-velocity", default="0", metavar="V", help="velocity of the node (default 0; not printed)"
    )
    readings = parser.add_argument_group("readings of what the paper leaves open (layers other than printed)")
    readings.add_argument(
        "--stress-law",
        default="truesdell",
        metavar="NAME",
        help="truesdell, cauchy-rate or literal (69) (default truesdell)",
    )
    readings.add_argument(
        "--node-motion", default="coefficient", metavar="NAME", help="nodes move with their coefficient or the field"
    )
    readings.add_argument(
        "--cell-edges", default="voronoi", metavar="NAME", help="voronoi, material or fixed (default voronoi)"
    )
    readings.add_argument(
        "--cell-measure", default="edges", metavar="NAME", help="edges, material or fixed (default edges)"
    )
    readings.add_argument(
        "--support-radius", default="fixed", metavar="NAME", help="fixed, or spacing: R times it (default fixed)"
    )
    readings.add_argument("--mass", default="lumped", metavar="NAME", help="lumped or consistent (default lumped)")
    _kernel_and_order(parser)
    parser.add_argument("--arithmetic", default="float", metavar="NAME", help="float or mp:DIGITS (default float)")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--kh", nargs="+", metavar="VALUE", help="wave numbers times spacing, in radians")
    where.add_argument("--samples", type=int, default=32, metavar="N", help="kh = pi/N, 2 pi/N, …, pi (default 32)")
    _output(parser)


def _names(parser: ArgumentParser) -> None:
    parser.add_argument("names", nargs="*", metavar="STUDY", help="studies, all if none is named")


def _jobs(parser: ArgumentParser) -> None:
    parser.add_argument("--jobs", type=int, default=None, metavar="N", help="processes (default: one for each core)")


def _run(parser: ArgumentParser) -> None:
    _names(parser)
    _jobs(parser)
    parser.add_argument("--quick", action="store_true", help="few samples, results under .rkverify/quick")
    parser.add_argument("--force", action="store_true", help="run also what is current")


def _verify(parser: ArgumentParser) -> None:
    _names(parser)
    _jobs(parser)


def _ledger(parser: ArgumentParser) -> None:
    parser.add_argument("entry", nargs="?", metavar="ID", help="an equation E1-E87, figure F1-F8 or claim C1-C75")
    parser.add_argument("--quick", action="store_true", help="from the quick run's results")
    parser.add_argument("--json", action="store_true", help="JSON instead of text")


def _report(parser: ArgumentParser) -> None:
    parser.add_argument("--quick", action="store_true", help="from the quick run's results")


COMMANDS = (
    Command(
        "shape",
        "shape functions and derivatives on your own nodes",
        "Psi_I and dPsi_I/dx of (4) at every point, one row for each node that reaches it: point,node,psi,dpsi_dx;\n"
        "ids are 0-based row numbers. Numbers in the CSV files may be decimals or p/q. One dimension.",
        "  rkverify shape --nodes nodes.csv --points points.csv --support 1.5 --order 1 --arithmetic exact",
        _shape,
        _later("shape", "shape"),
    ),
    Command(
        "dispersion",
        "frequencies and growth of a plane wave on the uniform lattice",
        "Roots omega of the dispersion relation for a plane wave e^{i(kx + omega t)}; growth = -Im(omega); rho = 1,\n"
        "modulus 1. Columns kh,root,omega_re,omega_im,omega2_re,omega2_im,growth, and D where the paper defines it;\n"
        "a simulation adds growth_uncertainty and takes the nearest kh that fits on its periodic chain.",
        "  rkverify dispersion --formulation semi-lagrangian --integration dni --layer printed \\\n"
        "      --support-ratio 1.5 --stress-ratio 0.5 --kh 0.5 1 3",
        _dispersion,
        _later("dispersion", "dispersion"),
    ),
    Command(
        "list",
        "the studies and whether they are up to date",
        "Every study, its title, whether its results are current, and how long its last run took. Needs a checkout.",
        "  rkverify list",
        lambda parser: None,
        _later("studies", "show"),
    ),
    Command(
        "run",
        "run the studies that are not up to date",
        "Compute tables, figures and statements of the studies whose sources, parameters or environment changed and\n"
        "write what changed under reports/results. Needs a checkout.",
        "  rkverify run figure5 figure6 --jobs 2",
        _run,
        _later("studies", "run"),
    ),
    Command(
        "verify",
        "recompute and compare with what is committed",
        "Recompute and compare with the committed results, writing nothing; status 1 and a list of what left its\n"
        "tolerance, and by how much, if anything did. Needs a checkout.",
        "  rkverify verify",
        _verify,
        _later("studies", "verify"),
    ),
    Command(
        "ledger",
        "the state of every equation, figure and claim",
        "States of all 170 entries computed from the studies' statements, or one entry with its evidence.\n"
        "Needs a checkout.",
        "  rkverify ledger C43",
        _ledger,
        _later("ledger", "ledger"),
    ),
    Command(
        "report",
        "build the pages from finished studies",
        "Write reports/index.html and the pages it links to. Needs a checkout.",
        "  rkverify report",
        _report,
        _later("report", "report"),
    ),
)
