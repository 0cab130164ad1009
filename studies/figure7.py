"""Figure 7: D of (85) for semi-Lagrangian DNI with C^sigma + sigma > 0 and sigma > 0, as printed."""

from collections.abc import Mapping, Sequence

from rkverify.stability.side_by_side import Case
from rkverify.workflow.study import Drawing, Statement, Study, Tables
from studies import _discriminants as shared
from studies._discriminants import Parameters

PARAMETERS = Parameters(
    readings=shared.DNI,
    stresses=("1/10", "1/2", "1"),
    tried_stresses=("1/100", "1/10", "1/2", "1", "5"),
    cases=(Case("dni", "3/2"), Case("dni", "7/4"), Case("dni", "3/2", "diffuse")),
    waves=(1, 2, 4, 7),
)


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Curves and sign maps."""
    caption = (
        "Figure 7 from (85) as printed: h = 1/20, C^sigma + sigma > 0 and sigma > 0 as the paper states; R = 3/2 as in Figures 5 and 6 (ours here). Psi,xx is not defined in the paper: four readings. "
        f"{shared.open_parameters(p)}"
    )
    alternative = (
        f"D over kh in tension: {shared.negative_in_curves(p, tables, p.spacings[0])}. "
        f"In the same way {shared.negative_in_curves(p, tables, p.spacings[-1])}. {shared.negative_in_maps(p, tables)}."
    )
    printed = shared.draw(p, tables, "figure7", caption, alternative)
    return {**printed, **shared.draw_layers(p, tables, 7)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """Tension gives D < 0 at some wavelengths where Q h is small, in every reading of the derivative."""
    return [
        Statement(
            f"figure_{v.key}",
            ("F7", "C50"),
            f"{v.name}: D < 0 at some wave number in {v.with_negative} of {v.settings} settings in tension; in the others Q makes every frequency real.",
            v.with_negative == v.settings,
            shared.tried(p),
            "enclosed",
            -v.largest_of_least,
            "minus the largest over the settings of the least D rho h^2 / C^sigma",
            layer="printed",
            reading=v.name,
        )
        for v in shared.verdicts(p, tables)
    ]


STUDY = Study(
    "Figure 7: D for semi-Lagrangian DNI, tension", PARAMETERS, shared.quick(PARAMETERS), shared.compute, judge, draw
)
