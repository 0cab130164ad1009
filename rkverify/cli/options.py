"""The options of every command. Nothing is imported here that a help text does not need."""

from argparse import ArgumentParser, _MutuallyExclusiveGroup


def output(parser: ArgumentParser) -> None:
    """Add the form and the place of the result."""
    parser.add_argument("--json", action="store_true", help="JSON instead of CSV")
    parser.add_argument("--out", metavar="FILE", help="write to FILE instead of standard output")


def kernel_and_order(parser: ArgumentParser) -> None:
    """Add the order of the basis, the kernel and the reading of the derivative."""
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


def nodes_and_supports(parser: ArgumentParser) -> None:
    """Add the nodes with all that defines their shape functions."""
    parser.add_argument(
        "--nodes",
        required=True,
        metavar="CSV",
        help="nodes, header x or x,y or x,y,z; a column a gives each its own support",
    )
    parser.add_argument("--support", metavar="A", help="support radius, in the nodes' unit of length")
    kernel_and_order(parser)
    parser.add_argument(
        "--window",
        default="radial",
        metavar="NAME",
        help="kernel of the distance (radial), or a product over the axes (tensor) (default radial)",
    )


def domain(parser: ArgumentParser) -> _MutuallyExclusiveGroup:
    """Add the two ways to give a domain; returns their group, for a third one."""
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--domain", metavar="CSV", help="polygonal domain, header ring,x,y: ring 0 the outline, the others holes"
    )
    where.add_argument("--box", metavar="LOW,HIGH", help="an interval x0,x1, a box x0,y0,x1,y1 or x0,y0,z0,x1,y1,z1")
    return where


def shape(parser: ArgumentParser) -> None:
    """Add the options of `rkverify shape`."""
    nodes_and_supports(parser)
    parser.add_argument("--points", required=True, metavar="CSV", help="points, header as the nodes'")
    parser.add_argument(
        "--arithmetic", default="float", metavar="NAME", help="float, mp:DIGITS or exact (default float)"
    )
    output(parser)


def cells(parser: ArgumentParser) -> None:
    """Add the options of `rkverify cells`."""
    parser.add_argument("--nodes", required=True, metavar="CSV", help="nodes, header x or x,y or x,y,z")
    domain(parser)
    parser.add_argument("--measures", action="store_true", help="lengths, areas or volumes instead of vertices")
    output(parser)


def gradients(parser: ArgumentParser) -> None:
    """Add the options of `rkverify gradients`."""
    nodes_and_supports(parser)
    parser.add_argument("--integration", required=True, metavar="NAME", help="scni, dni or snni")
    parser.add_argument(
        "--edge-rule",
        metavar="RULE",
        help="trapezoid (default of scni), midpoint (default of snni) or gauss:N",
    )
    domain(parser).add_argument(
        "--cells", metavar="CSV", help="cells as they are, header node,ring,vertex,x,y; ring may be missing"
    )
    output(parser)


def check(parser: ArgumentParser) -> None:
    """Add the options of `rkverify check`."""
    parser.add_argument("subject", choices=("shape", "gradients"), metavar="WHAT", help="shape or gradients")
    nodes_and_supports(parser)
    parser.add_argument(
        "--values",
        required=True,
        metavar="CSV",
        help="the numbers, as `rkverify shape` and `rkverify gradients` print them; psi or the derivatives may be missing",
    )
    parser.add_argument(
        "--tolerance",
        default="0",
        metavar="T",
        help="allowed besides rounding and the digits printed, relative to the largest number of a column (default 0)",
    )
    parser.add_argument(
        "--points",
        metavar="CSV",
        help="shape: points, header as the nodes'; a column a tells the support at the point, to try whose supports are in use",
    )
    parser.add_argument("--integration", metavar="NAME", help="gradients: what is claimed, scni, dni or snni")
    parser.add_argument(
        "--edge-rule",
        metavar="RULE",
        help="gradients: what is claimed, trapezoid (default of scni), midpoint (default of snni) or gauss:N",
    )
    domain(parser).add_argument(
        "--cells", metavar="CSV", help="cells as they are, header node,ring,vertex,x,y; ring may be missing"
    )
    parser.add_argument("--json", action="store_true", help="JSON instead of text")
    parser.add_argument("--out", metavar="FILE", help="write to FILE instead of standard output")


def dispersion(parser: ArgumentParser) -> None:
    """Add the options of `rkverify dispersion`."""
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
    kernel_and_order(parser)
    parser.add_argument("--arithmetic", default="float", metavar="NAME", help="float or mp:DIGITS (default float)")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--kh", nargs="+", metavar="VALUE", help="wave numbers times spacing, in radians")
    where.add_argument("--samples", type=int, default=32, metavar="N", help="kh = pi/N, 2 pi/N, …, pi (default 32)")
    output(parser)


def names(parser: ArgumentParser) -> None:
    """Add the studies to act on."""
    parser.add_argument("names", nargs="*", metavar="STUDY", help="studies, all if none is named")


def jobs(parser: ArgumentParser) -> None:
    """Add the number of processes."""
    parser.add_argument("--jobs", type=int, default=None, metavar="N", help="processes (default: one for each core)")


def run(parser: ArgumentParser) -> None:
    """Add the options of `rkverify run`."""
    names(parser)
    jobs(parser)
    parser.add_argument("--quick", action="store_true", help="few samples, results under .rkverify/quick")
    parser.add_argument("--force", action="store_true", help="run also what is current")


def verify(parser: ArgumentParser) -> None:
    """Add the options of `rkverify verify`."""
    names(parser)
    jobs(parser)


def recheck(parser: ArgumentParser) -> None:
    """Add the options of `rkverify recheck`."""
    parser.add_argument("files", nargs="*", metavar="FILE", help="proof logs; those of the checkout if none is named")
    parser.add_argument("--quiet", action="store_true", help="the last line alone")


def reference(parser: ArgumentParser) -> None:
    """Add the options of `rkverify reference`."""
    parser.add_argument(
        "family", nargs="?", metavar="FAMILY", help="kernels, shape, rates, gradients, equations or dispersion"
    )
    output(parser)


def ledger(parser: ArgumentParser) -> None:
    """Add the options of `rkverify ledger`."""
    parser.add_argument("entry", nargs="?", metavar="ID", help="an equation E1-E87, figure F1-F8 or claim C1-C75")
    parser.add_argument("--quick", action="store_true", help="from the quick run's results")
    parser.add_argument("--json", action="store_true", help="JSON instead of text")


def report(parser: ArgumentParser) -> None:
    """Add the options of `rkverify report`."""
    parser.add_argument("--quick", action="store_true", help="from the quick run's results")
