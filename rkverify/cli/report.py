"""rkverify report"""

from argparse import Namespace

from rkverify.paths import checkout
from rkverify.report.site import build


def report(options: Namespace) -> int:
    """Build the pages."""
    place = checkout().quick() if options.quick else checkout()
    front = build(place)
    print(f"open {place.shown(front)}")
    return 0
