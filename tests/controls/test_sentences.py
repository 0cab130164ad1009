"""With one sign of a transcription wrong, the report's verdicts and sentences on that line are others, and nothing else on any page is.

Sentences that stay as they are were typed, and sentences that change elsewhere were not about what they name. In a copy of the
checkout with the committed results, the studies that the line belongs to are run in their quick form and the report is built, before
and after the change; all other studies keep what they have, since nothing that they depend on has changed.
"""

import json
import re
import shutil
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from bs4 import BeautifulSoup, Tag

from rkverify.ledger.states import states
from rkverify.paths import checkout
from rkverify.workflow.discovery import study_names
from rkverify.workflow.identity import Sources

ROOT = Path(__file__).resolve().parents[2]
# module, right, wrong, entries whose state must be another one
CASES = {
    "(7), the sign of the internal force": (
        "rkverify.paper.weak_forms", "_inertia(inside, K) + internal - _loads", "_inertia(inside, K) - internal - _loads", {"E7"},
    ),
    "(62), the sign of omega t": ("rkverify.paper.plane_wave", '"plus": 1,', '"plus": -1,', {"E62"}),
}  # fmt: skip
LEAVES = [
    "p", "li", "tr", "dt", "dd", "h1", "h2", "h3", "caption", "summary", "title", "text", "nav > a", "option",
]  # fmt: skip
"""What is compared one by one: an element of these that has none of them inside."""
COUNTING = ("counts", "filter", "words")
"""Parts on all entries: how many are in which state, and which states there are."""
FOOTER = re.compile(r"<footer>.*?</footer>", re.DOTALL)
"""Time and circumstances."""


@dataclass(frozen=True)
class Report:
    """The pages of a copy, without their feet, the states of all entries, and the statements of the studies that were run."""

    pages: dict[str, str]
    states: dict[str, str]
    statements: dict[tuple[str, str], dict[str, object]]

    def about(self, keys: set[tuple[str, str]]) -> set[str]:
        """The entries that statements are about."""
        return {id for key in keys for id in self.statements.get(key, {"about": []})["about"]}


def report(copy, studies: list[str]) -> Report:
    """Run these studies in the copy in their quick form and build the pages."""
    copy.call("run", "--quick", *studies)
    copy.call("report", "--quick")
    folder = copy.root / ".rkverify" / "quick"
    pages = {path.stem: FOOTER.sub("", path.read_text(encoding="utf-8")) for path in folder.glob("*.html")}
    statements = {
        (name, said["name"]): said
        for name in studies
        for said in json.loads((folder / "results" / name / "statements.json").read_text(encoding="utf-8"))
    }
    found = {id: f"{state.name} | {state.detail}" for id, state in states(folder / "results").items()}
    return Report(pages, found, statements)


def leaves(page: Tag) -> Iterator[tuple[str, str, Tag]]:
    """The smallest parts of a page: the id of the card that each stands in, its words, itself."""
    chosen = ", ".join(LEAVES)
    for part in page.select(chosen):
        if part.select_one(chosen) is None:
            card = part.find_parent(class_="card")
            yield (card.get("id") if card else "", " ".join(part.get_text(" ").split()), part)


def rest(name: str, before: str, after: str, studies: list[str], concerned: set[str]) -> list[Counter[str]]:
    """The words of both versions of a page without the parts that differ, each of which must be about what was changed.

    Such a part stands in the card of an entry that is concerned or on the page of a study that was run, links to one of
    these, or counts entries. The order of what is left may change: where something fails it comes first.
    """
    soups = [BeautifulSoup(text, "html.parser") for text in (before, after)]
    found = [list(leaves(soup)) for soup in soups]
    counts = [Counter((card, words) for card, words, _ in parts) for parts in found]
    more = [counts[0] - counts[1], counts[1] - counts[0]]
    for parts, differing in zip(found, more, strict=True):
        for card, words, part in parts:
            if differing[card, words]:
                differing[card, words] -= 1
                known = card in concerned or name in studies or linked(part, studies, concerned)
                counting = part.find_parent("svg") or part.find_parent(class_=COUNTING)
                assert known or counting, f"{name}, {card}: {words[:300]}"
                part.decompose()
    return [Counter(soup.get_text(" ").split()) for soup in soups]


def linked(part: Tag, studies: list[str], concerned: set[str]) -> bool:
    """Whether a part, or the finding of the front page that it stands in, links to an entry or a study that is concerned."""
    scope = part if part.name == "a" or part.find("a") else part.find_parent("article") or part
    links = [a["href"].partition("#") for a in [scope, *scope.find_all("a")] if a.get("href")]
    return any(place in concerned or page in {f"{study}.html" for study in studies} for page, _, place in links)


def depending_on(module: str) -> list[str]:
    """The studies whose results depend on the module: those whose identity its text is part of."""
    place = checkout()
    sources = Sources(place)
    return [name for name in study_names(place) if module in sources.closure(f"studies.{name}")]


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_a_sign_changes_the_sentences_that_speak_of_it_and_no_other(case: str, copy, tmp_path: Path) -> None:
    module, right, wrong, noticed = CASES[case]
    studies = depending_on(module)
    whole = tmp_path / "as it is"
    for folder in ("rkverify", "studies"):
        shutil.copytree(ROOT / folder, whole / folder)
    for file in ("pyproject.toml", "requirements.lock", "Makefile"):
        shutil.copy2(ROOT / file, whole / file)
    shutil.copytree(checkout().results, whole / ".rkverify" / "quick" / "results")
    made = copy(whole)
    before = report(made, studies)
    made.patch(f"{module.replace('.', '/')}.py", right, wrong)
    after = report(made, studies)

    said = {*before.statements, *after.statements}
    changed = {key for key in said if before.statements.get(key) != after.statements.get(key)}
    concerned = before.about(changed) | after.about(changed)
    turned = {id for id, state in before.states.items() if after.states[id] != state}
    assert noticed <= turned <= concerned
    assert concerned != set(before.states), "every entry is concerned: choose a line that fewer studies use"

    assert before.pages.keys() == after.pages.keys()
    for name, text in before.pages.items():
        if text != after.pages[name]:
            one, other = rest(name, text, after.pages[name], studies, concerned)
            assert one == other, name
    for id in concerned:  # and each of them does say something else
        page = {"E": "equations", "F": "figures", "C": "claims"}[id[0]]
        cards = [BeautifulSoup(r.pages[page], "html.parser").find(id=id).get_text() for r in (before, after)]
        assert cards[0] != cards[1], id


PAGE = """<main><p>A count: <b>3</b>.</p><article class="card" id="E1"><p>It holds by {one}.</p></article>
<article class="card" id="E2"><p>It fails by {two}.</p></article><li>Part of <a href="{href}">a study</a>: {three}.</li>{more}</main>"""


@pytest.mark.parametrize(
    ("right", "after"),
    [
        (True, {"one": "7"}),
        (True, {"three": "7"}),
        (False, {"two": "7"}),
        (False, {"href": "other.html", "three": "7"}),
        (False, {"more": "a word"}),
    ],
)
def test_a_sentence_elsewhere_would_be_seen(right: bool, after: dict[str, str]) -> None:
    """The control of the comparison: with E1 and a study concerned, only what speaks of them may change."""
    as_it_was = {"one": "2", "two": "2", "three": "2", "href": after.get("href", "study.html"), "more": ""}
    before, now = PAGE.format(**as_it_was), PAGE.format(**{**as_it_was, **after})
    if right or "more" in after:
        one, other = rest("claims", before, now, ["study"], {"E1"})
        assert (one == other) == right
    else:
        with pytest.raises(AssertionError, match="claims"):
            rest("claims", before, now, ["study"], {"E1"})
