"""The public functions: what each says in its first paragraph, its example, where it stands; with examples that are run."""

import doctest
import importlib
import inspect
import re
from dataclasses import dataclass
from io import StringIO
from typing import Any

from rkverify.errors import BadInput
from rkverify.paths import Checkout
from rkverify.report.formulas import data
from rkverify.report.links import Link, module_link
from rkverify.solid.kernel_values import Array

PARSER = doctest.DocTestParser()
ARRAY = str(Array)


@dataclass(frozen=True)
class Public:
    """A function or class that others may use: its name, how it is called, what it is, an example if it has one."""

    name: str
    module: str
    signature: str
    line: str
    example: str
    link: Link


@dataclass(frozen=True)
class Part:
    """Functions that belong together, with an example of their use."""

    title: str
    text: str
    example: str
    public: list[Public]


def lead() -> str:
    """What is said before all."""
    words: str = data("api.toml")["lead"]
    return words


def parts(place: Checkout) -> list[Part]:
    """The public functions part by part; the examples of the parts are run, one after the other as a reader would.

    Raises BadInput for a name that is not there or has no docstring, and for an example that prints something else.
    """
    names: dict[str, Any] = {}
    found = []
    for raw in data("api.toml")["part"]:
        _run(raw["title"], raw["example"], names)
        found.append(Part(raw["title"], raw["text"], raw["example"].strip(), [public(place, n) for n in raw["names"]]))
    return found


def _run(title: str, example: str, names: dict[str, Any]) -> None:
    test = PARSER.get_doctest(example, names, title, "api.toml", 0)
    told = StringIO()
    runner = doctest.DocTestRunner(verbose=False)
    if runner.run(test, out=told.write, clear_globs=False).failed:
        raise BadInput(
            f"the example of {title!r} does not print what it shows: {' '.join(told.getvalue().split())[-300:]}"
        )
    names.update(test.globs)


def public(place: Checkout, path: str) -> Public:
    """The public function or class of that dotted name."""
    module, _, name = path.rpartition(".")
    try:
        thing = getattr(importlib.import_module(module), name)
    except (ImportError, AttributeError):
        raise BadInput(f"api.toml names {path}, which does not exist: name what does") from None
    words = inspect.getdoc(thing)
    if not words or thing.__module__ != module:
        raise BadInput(f"api.toml names {path}, which has no docstring there: document it, or name where it stands")
    examples = [f">>> {_continued(e.source)}\n{e.want}" for e in PARSER.get_examples(words)]
    return Public(
        name,
        module,
        _signature(thing),
        " ".join(words.partition("\n\n")[0].split()),
        "".join(examples).rstrip(),
        module_link(place, path),
    )


def _continued(source: str) -> str:
    return source.rstrip("\n").replace("\n", "\n... ")


def _signature(thing: Any) -> str:
    """How it is called, annotations without the modules that they come from."""
    text = str(inspect.signature(thing)).replace(" -> None", "").replace(ARRAY, "Array")
    text = re.sub(r"<function .*? at 0x\w+>", "…", text)  # a default that is a function shows where it is in memory
    short = re.sub(r"(?:[a-z_]+\.)+(?=[A-Za-z])", "", text)
    return f"{thing.__name__}{short}"
