"""rkverify new-study"""

import keyword
import re
from argparse import Namespace
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from rkverify.cli import new_study_texts as texts
from rkverify.errors import BadInput, UnknownName
from rkverify.ledger.editing import shown_on, with_study
from rkverify.ledger.entries import FILES, entry
from rkverify.paths import Checkout, checkout
from rkverify.report.sections import pages_of, plans
from rkverify.report.site import menu
from rkverify.workflow.files import write_atomically

LAST_ROW = "| the pages | `make report` |"
"""The row of the README's table of results before which a study's row is put."""


def new_study(options: Namespace) -> int:
    """Write a study, its test and what lists it: all of it, or nothing."""
    place = checkout()
    about = list(dict.fromkeys(entry(id).id for id in options.about))
    new, changed = _planned(place, options.name, about, options.page)
    _write(new, changed)
    for path in new:
        print(f"wrote {place.shown(path)}")
    for path in changed:
        print(f"changed {place.shown(path)}")
    print(f"next: rkverify run {options.name}; pytest {place.shown(list(new)[1])}")
    if about:
        print(f"{', '.join(about)}: not decidable until a statement of the study says what it finds about them")
    else:
        print(
            "to decide an entry: name it in a statement's `about` and add the study to its list in rkverify/ledger/*.toml"
        )
    return 0


def _planned(place: Checkout, name: str, about: Sequence[str], page: str) -> tuple[dict[Path, str], dict[Path, str]]:
    """The files to write, and those to change, each with its text; raises BadInput where one cannot be."""
    _refuse_name(name)
    new = {
        place.studies / f"{name}.py": texts.study_text(name, _by_layer(about)),
        place.root / "tests" / "studies" / f"test_{name}.py": texts.text_of_test(name),
    }
    for path in (*new, place.results / name):
        if path.exists():
            raise BadInput(f"{place.shown(path)} exists: choose another name, or remove it first")
    changed = {}
    known = plans()
    if page not in known:
        raise UnknownName("page", page, list(known))
    if not pages_of(name, known):
        path = place.root / "rkverify" / "report" / "pages" / f"{page}.toml"
        changed[path] = shown_on(path.read_text(encoding="utf-8"), name)
    for file in FILES:
        path = place.root / "rkverify" / "ledger" / file
        before = text = path.read_text(encoding="utf-8")
        for id in about:
            if f'\nid = "{id}"\n' in text:
                text = with_study(text, id, name)
        if text != before:
            changed[path] = text
    readme = place.root / "README.md"
    if readme.is_file() and LAST_ROW in (text := readme.read_text(encoding="utf-8")):
        row = texts.ROW.format(title=texts.title(name), name=name)
        changed[readme] = text.replace(LAST_ROW, row + LAST_ROW, 1)
    return new, changed


def _refuse_name(name: str) -> None:
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or keyword.iskeyword(name):
        raise BadInput(f"{name!r} cannot name a study: use small letters, digits and underscores, a letter first")
    if name in (*menu(), "api", "notebooks"):
        raise BadInput(f"{name!r} is the name of a page of the report: choose another")


def _by_layer(about: Sequence[str]) -> Mapping[str, Sequence[str]]:
    """Layer -> entries: the first layer of those that are statements on stability, '' for the others."""
    found: dict[str, list[str]] = {}
    for id in about:
        found.setdefault(next(iter(entry(id).layers), ""), []).append(id)
    return found


def _write(new: Mapping[Path, str], changed: Mapping[Path, str]) -> None:
    """Write everything; where one file cannot be written, put back what was there."""
    before = {path: path.read_text(encoding="utf-8") for path in changed}
    done: list[Path] = []
    try:
        for path, text in {**new, **changed}.items():
            write_atomically(path, text)
            done.append(path)
    except BaseException:
        for path in reversed(done):
            if path in before:
                write_atomically(path, before[path])
            else:
                path.unlink()
        for path in new:
            with suppress(OSError):  # a folder that was there before is not empty, or was not ours to make
                if path.parent.name == "studies" and not any(path.parent.iterdir()):
                    path.parent.rmdir()
        raise
