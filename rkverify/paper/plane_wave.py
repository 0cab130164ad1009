"""The plane wave (62) with either sign of omega t, on a unit amplitude."""

from rkverify.paper.numbered import equation


@equation(62)
def phase_sign(reading: str) -> int:
    """u~_I = g e^{i(k I h + s omega t)}: s = 1 for the reading 'plus', -1 for 'minus' of the scan's '='   (62)."""
    return {"plus": 1, "minus": -1}[reading]
