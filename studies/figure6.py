"""Figure 6: D of (79) for semi-Lagrangian SCNI with C^sigma + sigma < 0, as printed."""

from collections.abc import Mapping, Sequence

from rkverify.stability.side_by_side import Case
from rkverify.workflow.study import Drawing, Statement, Study, Tables
from studies import _discriminants as shared
from studies._discriminants import Parameters

PARAMETERS = Parameters(
    readings=shared.SCNI,
    stresses=("-11/10", "-3/2", "-2"),
    tried_stresses=("-101/100", "-11/10", "-3/2", "-2", "-5"),
    cases=(Case("scni", "3/2"), Case("scni", "7/4")),
    waves=(1, 2, 4, 5),
)


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Curves and sign maps."""
    caption = (
        "Figure 6 from (79) as printed: R = 3/2, 0 <= Q <= 2 and C^sigma + sigma < 0 as the paper states; C(h/2) at the cell's edge (thick) and with the moment matrix at the node (thin). "
        f"{shared.open_parameters(p)}"
    )
    alternative = (
        f"D over kh: {shared.negative_in_curves(p, tables, p.spacings[0])}. "
        f"In the same way {shared.negative_in_curves(p, tables, p.spacings[-1])}. {shared.negative_in_maps(p, tables)}."
    )
    printed = shared.draw(p, tables, "figure6", caption, alternative)
    return {**printed, **shared.draw_layers(p, tables, 6)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """A range with D < 0 exists where Q h is small against the wave speed, and not where it is large."""
    return [
        Statement(
            f"figure_{v.key}",
            ("F6", "C45"),
            f"C(h/2) {v.name}: D < 0 at some wave number in {v.with_negative} of {v.settings} settings with C^sigma + sigma < 0; in the others Q makes every frequency real.",
            v.with_negative == v.settings,
            shared.tried(p),
            "enclosed",
            float(v.with_negative - v.settings),
            "settings with a negative D less all settings",
            layer="printed",
            reading=v.name,
        )
        for v in shared.verdicts(p, tables)
    ]


STUDY = Study(
    "Figure 6: D for semi-Lagrangian SCNI, C^sigma + sigma < 0",
    PARAMETERS,
    shared.quick(PARAMETERS),
    shared.compute,
    judge,
    draw,
)
