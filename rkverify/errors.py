"""Errors of our own: each message is one line that names the place, the value and what to change."""


class RkverifyError(Exception):
    """Base of every error that a user can cause; the command line prints its message and exits with 2."""


class BadInput(RkverifyError):
    """A value, a table or a file that cannot be used as it is."""


class UnknownName(BadInput):
    """A name that is not in the list it should come from."""

    def __init__(self, kind: str, name: str, known: "list[str] | tuple[str, ...]") -> None:
        super().__init__(f"unknown {kind} {name!r}: choose one of {', '.join(sorted(known))}")


class CoincidentNodes(BadInput):
    """Two nodes at one place."""


class TooFewNodes(RkverifyError):
    """Fewer nodes under the kernels at a point than the basis has functions."""


class SingularMomentMatrix(RkverifyError):
    """The moment matrix (6) at a point has no inverse, or none that its arithmetic can resolve."""


class NotDifferentiable(RkverifyError):
    """A derivative is asked for at a place where the kernel does not have it."""


class NotRepresentable(RkverifyError):
    """An arithmetic has no number for the result, for instance a rational square root of 2."""


class Undecided(RkverifyError):
    """A decision that an enclosure is too wide to make."""


class NotConverged(RkverifyError):
    """An iteration that did not reach the accuracy that rounding allows."""


class NeedsCheckout(RkverifyError):
    """A command that works on `studies/` was run without a checkout of the project."""


class OutOfTolerance(RkverifyError):
    """A recomputed result differs from the committed one by more than its tolerance."""
