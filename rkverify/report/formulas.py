"""The equations as MathML, and what is to be said of their scan and of what they leave open."""

import re
import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

from latex2mathml.converter import convert
from markupsafe import Markup


def data(name: str) -> dict[str, Any]:
    """A TOML file of this package."""
    return tomllib.loads(files("rkverify.report").joinpath(name).read_text(encoding="utf-8"))


NAMED = re.compile(r"<msup><mi>(?:sin|cos)</mi>.*?</msup>|(?<!<msup>)<mi>(?:sin|cos)</mi>")


def _mathml(latex: str) -> Markup:
    """The formula, with the thin space after the name of a function that browsers leave out."""
    return Markup(NAMED.sub(r'\g<0><mspace width="0.17em"/>', convert(latex, display="block")))


@cache
def formulas() -> dict[int, Markup]:
    """Equation number -> MathML."""
    return {int(number): _mathml(latex) for number, latex in data("formulas.toml").items()}


@cache
def notes(kind: str) -> dict[int, str]:
    """Equation number -> what its scan prints ('scan'), or which choice it leaves open ('reading')."""
    return {int(number): text for number, text in data("notes.toml")[kind].items()}
