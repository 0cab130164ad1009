"""The options of `rkverify bloch`. Nothing is imported here that a help text does not need."""

from argparse import ArgumentParser

from rkverify.cli import options


def bloch(parser: ArgumentParser) -> None:
    """Add the options of `rkverify bloch`."""
    parser.add_argument("--lattice", required=True, metavar="NAME", help="square or hexagonal, nearest neighbours at 1")
    parser.add_argument("--integration", required=True, metavar="NAME", help="dni, scni or snni")
    parser.add_argument("--support-ratio", required=True, metavar="R", help="support radius over the spacing 1")
    parser.add_argument("--stress", required=True, metavar="SXX,SYY,SXY", help="uniform Cauchy stress")
    parser.add_argument(
        "--k", nargs="+", required=True, metavar="KX,KY", help="wave vectors, radians per length; one or several"
    )
    parser.add_argument("--moduli", default="1,1", metavar="LAMBDA,MU", help="Lame's moduli (default 1,1)")
    parser.add_argument(
        "--part",
        default="total",
        metavar="NAME",
        help="total (default); geometric: gradients and measures change, the stress is held; material: the other way round",
    )
    readings = parser.add_argument_group("readings of what the paper leaves open")
    readings.add_argument(
        "--stress-law", default="truesdell", metavar="NAME", help="truesdell or jaumann (default truesdell)"
    )
    readings.add_argument(
        "--cell-measure",
        default="edges",
        metavar="NAME",
        help="a_L of dni and snni: edges (area of the Voronoi cell, default), material (a' = a tr L) or fixed; scni has "
        "a_L b^L as one integral, and none of them matters",
    )
    readings.add_argument(
        "--edge-rule",
        metavar="RULE",
        help="trapezoid (default of scni), midpoint (default of snni) or gauss:N",
    )
    options.kernel_and_order(parser)
    parser.add_argument(
        "--window",
        default="radial",
        metavar="NAME",
        help="kernel of the distance (radial), or a product over the axes (tensor) (default radial)",
    )
    options.output(parser)
