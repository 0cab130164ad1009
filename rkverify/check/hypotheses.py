"""What somebody's shape functions might be instead of what is claimed: small changes of the claim, tried one after another.

Each hypothesis is data: the group of choices it belongs to, the words for it, what to do about it, and the change. More can
be added to the lists. Groups of changes are tried alone and in pairs, the fewest changes first, so that the simplest
explanation is given.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product

import numpy as np

from rkverify.check.claim import OWNERS, Claim, Owner
from rkverify.check.entries import Entries
from rkverify.check.other_kernels import OTHER_KERNELS
from rkverify.check.sums import column_axis
from rkverify.kernels import KERNELS, Kernel
from rkverify.kernels import kernel as kernel_named
from rkverify.readings import DERIVATIVES, WINDOWS, Derivative, Window


@dataclass(frozen=True)
class Hypothesis:
    """One change of a claim. group: of which at most one is made at a time; says: as the end of 'your numbers have …'."""

    group: str
    says: str
    advice: str
    change: Callable[[Claim], Claim]


def _weights(kernel: Kernel) -> Hypothesis:
    return Hypothesis(
        "kernel", f"the weights {kernel.name}, z = distance / support", "take a kernel that --kernel offers, or check with these weights in mind",
        lambda claim: replace(claim, cloud=replace(claim.cloud, kernel=kernel)),
    )  # fmt: skip


def _kernel(name: str) -> Hypothesis:
    return Hypothesis(
        "kernel", f"the kernel {name}", f"give --kernel {name} if it is meant",
        lambda claim: replace(claim, cloud=replace(claim.cloud, kernel=kernel_named(name))),
    )  # fmt: skip


def _order(order: int) -> Hypothesis:
    return Hypothesis(
        "order", f"a basis of order {order}", f"give --order {order} if it is meant, else add the missing functions to the basis",
        lambda claim: replace(claim, cloud=replace(claim.cloud, order=order)),
    )  # fmt: skip


_OWNED = {
    "source": "supports owned by the nodes (source)",
    "target": "supports owned by the point (target)",
    "mean": "supports that are the mean of the node's and the point's",
}


def _owner(owner: Owner) -> Hypothesis:
    return Hypothesis(
        "owner", _OWNED[owner],
        "take the support of node J, not that of the point, in phi_a(x - x_J): only then is Psi_J a smooth function of x with one support",
        lambda claim: replace(claim, owner=owner),
    )  # fmt: skip


def _window(window: Window) -> Hypothesis:
    return Hypothesis(
        "window", f"{window} windows", f"give --window {window} if it is meant",
        lambda claim: replace(claim, cloud=replace(claim.cloud, window=window)),
    )  # fmt: skip


def _scaled(claim: Claim, factor: float) -> Claim:
    own = None if claim.point_supports is None else claim.point_supports * factor
    return replace(claim, cloud=replace(claim.cloud, supports=claim.cloud.supports * factor), point_supports=own)


def _support(factor: float, words: str) -> Hypothesis:
    return Hypothesis(
        "support", f"{words} the support radius that was given",
        "say which length the kernel's argument is divided by: here z = distance / support radius and the kernel ends at z = 1",
        lambda claim: _scaled(claim, factor),
    )  # fmt: skip


_NORMALISED = Hypothesis(
    "scaling", "kernels divided by a^d",
    "leave the kernel as a function of z alone: its factor is no matter where supports are alike, and is one where they differ",
    lambda claim: replace(claim, normalised=True),
)  # fmt: skip

HYPOTHESES: tuple[Hypothesis, ...] = (
    *(_owner(owner) for owner in OWNERS),
    *(_kernel(name) for name in KERNELS),
    *(_weights(kernel) for kernel in OTHER_KERNELS),
    *(_order(order) for order in (0, 1, 2)),
    *(_window(window) for window in WINDOWS),
    _NORMALISED,
    _support(0.5, "half"),
    _support(2.0, "twice"),
    _support(1 / 3, "a third of"),
    _support(3.0, "three times"),
)


def _reading(name: Derivative) -> Hypothesis:
    return Hypothesis(
        "derivative", f"{name} derivatives",
        f"give --derivative {name} if it is meant; the full derivative is also of M^-1(x) and of H(x - x_J)",
        lambda claim: replace(claim, derivative=name),
    )  # fmt: skip


DERIVATIVE_HYPOTHESES: tuple[Hypothesis, ...] = tuple(_reading(name) for name in DERIVATIVES)


def variants(
    claim: Claim, hypotheses: Sequence[Hypothesis], most: int
) -> Iterator[tuple[tuple[Hypothesis, ...], Claim]]:
    """Claims with up to `most` changes from different groups, fewest first; a change that changes nothing is left out."""
    groups: dict[str, list[Hypothesis]] = {}
    for hypothesis in hypotheses:
        if not _same(hypothesis.change(claim), claim):
            groups.setdefault(hypothesis.group, []).append(hypothesis)
    for count in range(most + 1):
        for chosen in combinations(groups, count):
            for changes in product(*(groups[group] for group in chosen)):
                changed = claim
                for hypothesis in changes:
                    changed = hypothesis.change(changed)
                yield changes, changed


def _same(one: Claim, other: Claim) -> bool:
    if one.owner != other.owner:
        own = other.point_supports
        # supports all alike belong to nobody
        return own is None or bool(np.ptp([*other.cloud.supports, *own]) == 0)
    if one.normalised != other.normalised:
        supports = (
            other.cloud.supports if other.point_supports is None else [*other.cloud.supports, *other.point_supports]
        )
        return bool(np.ptp(supports) == 0)
    a, b = one.cloud, other.cloud
    alike = (a.kernel.name, a.order, a.window, one.derivative) == (b.kernel.name, b.order, b.window, other.derivative)
    one_dimensional = a.dimension == 1 and a.window != b.window  # there the two windows are one
    return (alike or one_dimensional) and bool((a.supports == b.supports).all())


@dataclass(frozen=True)
class Slip:
    """A slip that leaves the values as they are: what is done to right gradients to get the wrong ones."""

    says: str
    advice: str
    act: Callable[[Entries, np.ndarray], Entries]


def _negated(entries: Entries, lengths: np.ndarray) -> Entries:
    return replace(entries, numbers=np.where(_slopes(entries), -entries.numbers, entries.numbers))


def _times_length(entries: Entries, lengths: np.ndarray) -> Entries:
    scaled = entries.numbers * lengths[entries.rows, None]
    return replace(entries, numbers=np.where(_slopes(entries), scaled, entries.numbers))


def _reversed_axes(entries: Entries, lengths: np.ndarray) -> Entries:
    slopes = [c for c, name in enumerate(entries.columns) if column_axis(name) is not None]
    order = list(range(len(entries.columns)))
    for c, other in zip(slopes, slopes[::-1], strict=True):
        order[c] = other
    return replace(entries, numbers=entries.numbers[:, order])


def _slopes(entries: Entries) -> np.ndarray:
    return np.array([column_axis(name) is not None for name in entries.columns])


SLIPS: tuple[Slip, ...] = (
    Slip("the opposite sign", "differentiate with respect to x, not to x_J", _negated),
    Slip("derivatives by z = distance / support instead of by x", "divide by the support radius", _times_length),
    Slip("their axes in the opposite order", "exchange the columns", _reversed_axes),
)
