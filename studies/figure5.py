"""Figure 5: D of (79) for semi-Lagrangian SCNI with C^sigma + sigma > 0, as printed."""

from collections.abc import Mapping, Sequence

from rkverify.certify.curves import convective_gain
from rkverify.stability.side_by_side import Case
from rkverify.workflow.study import Drawing, Statement, Study, Tables
from studies import _discriminants as shared
from studies._discriminants import Parameters

SLIGHTLY = 0.05

PARAMETERS = Parameters(
    readings=shared.SCNI,
    stresses=("-1/2", "1/2", "2"),
    tried_stresses=("-9/10", "-1/2", "0", "1/2", "5"),
    cases=(Case("scni", "3/2"), Case("scni", "7/4")),
)


def draw(p: Parameters, tables: Tables) -> Mapping[str, Drawing]:
    """Curves and sign maps."""
    caption = (
        "Figure 5 from (79) as printed: R = 3/2, 0 <= Q <= 2 and C^sigma + sigma > 0 as the paper states; C(h/2) at the cell's edge (thick) and with the moment matrix at the node (thin). "
        f"{shared.open_parameters(p)}"
    )
    found = shared.verdicts(p, tables)
    alternative = (
        f"D over kh has a negative sample in {sum(v.with_negative for v in found)} of {sum(v.settings for v in found)} settings. "
        f"{shared.negative_in_maps(p, tables)}. At kh = pi the drawn D is {shared.at_pi(p, tables)}."
    )
    printed = shared.draw(p, tables, "figure5", caption, alternative)
    return {**printed, **shared.draw_layers(p, tables, 5)}


def judge(p: Parameters, tables: Tables) -> Sequence[Statement]:
    """D is nowhere negative; it is zero, not positive, at kh = pi where Q = 0."""
    signs = [
        Statement(
            f"figure_{v.key}",
            ("F5", "C44"),
            f"C(h/2) {v.name}: D < 0 in {v.with_negative} of {v.settings} settings; D > 0 at every sample in {v.all_positive} of them, the others have D = 0 at kh = pi, where Q = 0.",
            v.with_negative == 0,
            shared.tried(p),
            "enclosed",
            v.least,
            "least D rho h^2 / C^sigma over all samples",
            layer="printed",
            reading=v.name,
        )
        for v in shared.verdicts(p, tables)
    ]
    largest_Q = p.gradients[-1]
    gains = {h: convective_gain(p.support_ratio, h, p.stresses[1], largest_Q, p.samples) for h in p.spacings}
    slight = [
        Statement(
            f"gain_h_{h.replace('/', '_')}",
            ("C57", "C69"),
            f"h = {h}: a velocity gradient Q = {largest_Q} raises D by at most {gain:.3g} of its peak without it; 'slightly' is taken as below {SLIGHTLY:g}.",
            gain < SLIGHTLY,
            f"R = {p.support_ratio}, sigma/C = {p.stresses[1]}, kh = pi n/{p.samples}; rho = C^sigma = 1",
            "sampled",
            SLIGHTLY - gain,
            "share of the peak below the rule's bound",
            layer="printed",
            reading=f"h = {h}",
        )
        for h, gain in gains.items()
    ]
    return signs + slight


STUDY = Study(
    "Figure 5: D for semi-Lagrangian SCNI, C^sigma + sigma > 0",
    PARAMETERS,
    shared.quick(PARAMETERS),
    shared.compute,
    judge,
    draw,
)
