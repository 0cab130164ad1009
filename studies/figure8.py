"""Figure 8: D of (85) for semi-Lagrangian DNI with C^sigma + sigma < 0, as printed."""

from collections.abc import Mapping, Sequence

from rkverify.stability.side_by_side import Case
from rkverify.workflow.study import Drawing, Statement, Study, Tables
from studies import _discriminants as shared
from studies._discriminants import Parameters

PARAMETERS = Parameters(
    readings=shared.DNI,
    stresses=("-11/10", "-3/2", "-2"),
    tried_stresses=("-101/100", "-11/10", "-3/2", "-2", "-5"),
    cases=(Case("dni", "3/2"), Case("dni", "7/4"), Case("dni", "3/2", "diffuse")),
    waves=(1, 2, 4, 7),
)


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Curves and sign maps."""
    caption = (
        "Figure 8 from (85) as printed: h = 1/20 and C^sigma + sigma < 0 as the paper states; R = 3/2 as in Figures 5 and 6 (ours here). Psi,xx is not defined in the paper: four readings. "
        f"{shared.open_parameters(p)}"
    )
    found = shared.verdicts(p, tables)
    alternative = (
        f"D over kh is positive for every wave number in {sum(v.all_positive for v in found)} of {sum(v.settings for v in found)} settings with C + sigma < 0. "
        f"{shared.negative_in_maps(p, tables)}."
    )
    printed = shared.draw(p, tables, "figure8", caption, alternative)
    return {**printed, **shared.draw_layers(p, tables, 8)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """D is positive throughout although the continuum is unstable: the print says stable."""
    return [
        Statement(
            f"figure_{v.key}",
            ("F8", "C52"),
            f"{v.name}: D > 0 at every sample in {v.all_positive} of {v.settings} settings with C^sigma + sigma < 0.",
            v.all_positive == v.settings,
            shared.tried(p),
            "enclosed",
            v.least,
            "least D rho h^2 / C^sigma over all samples",
            layer="printed",
            reading=v.name,
        )
        for v in shared.verdicts(p, tables)
    ]


STUDY = Study(
    "Figure 8: D for semi-Lagrangian DNI, C^sigma + sigma < 0",
    PARAMETERS,
    shared.quick(PARAMETERS),
    shared.compute,
    judge,
    draw,
)
