"""Links from pages to sources, data and tests of the checkout, which need no network."""

import os
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from rkverify.paths import Checkout
from rkverify.workflow.files import read


@dataclass(frozen=True)
class Link:
    """Where a link leads, its name, and the line in the file where what it names begins (0 for the file itself)."""

    href: str
    name: str
    line: int = 0


def relative(place: Checkout, *parts: str) -> str:
    """A link from a page to a place in the checkout."""
    return os.path.relpath(place.root.joinpath(*parts), place.pages).replace(os.sep, "/")


def slug(name: str) -> str:
    """The name as an id that a link may carry.

    >>> slug("linear in the coefficients")
    'linear-in-the-coefficients'
    """
    return re.sub(r"[^A-Za-z0-9_-]", "-", name)


@cache
def _lines(path: Path) -> tuple[str, ...]:
    return tuple((read(path) or "").splitlines())


def _line_of(path: Path, name: str) -> int:
    """The line on which a function or class of that name is defined, 0 where there is none."""
    start = re.compile(rf"\s*(async def|def|class) {re.escape(name)}\b")
    return next((number for number, line in enumerate(_lines(path), start=1) if start.match(line)), 0)


def module_link(place: Checkout, path: str) -> Link:
    """A link to the source of a module, or of the module that a function or method stands in."""
    module, inside = path, ""
    while module:
        stem = place.root.joinpath(*module.split("."))
        for file in (stem.with_suffix(".py"), stem / "__init__.py"):
            if file.is_file():
                shown = file.relative_to(place.root).as_posix()
                name = inside or shown
                return Link(relative(place, shown), name, _line_of(file, inside.rpartition(".")[2]) if inside else 0)
        module, _, last = module.rpartition(".")
        inside = f"{last}.{inside}" if inside else last
    raise FileNotFoundError(f"no module holds {path}")


def test_link(place: Checkout, test: str) -> Link:
    """A link to a test given as file::name."""
    file, _, name = test.partition("::")
    return Link(relative(place, file), name, _line_of(place.root / file, name))
