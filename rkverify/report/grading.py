"""The grades of evidence on a page: what each means, how many entries have it, and every sign and stability claim with its own."""

from typing import Any

from rkverify.ledger.grades import GRADES, MEANINGS, best, on_signs
from rkverify.report.cards import Card
from rkverify.report.content import PARTS, Site


def meanings(site: Site) -> list[dict[str, Any]]:
    """Every grade, the strongest first, with its meaning and the number of entries of each kind whose best it is."""
    found = {name: best(state) for name, state in site.states.items()}
    return [
        {
            "grade": grade,
            "means": MEANINGS[grade],
            "counts": [sum(g == grade for name, g in found.items() if name.startswith(letter)) for letter in PARTS],
        }
        for grade in GRADES
    ]


def sign_claims(site: Site, cards: dict[str, Card]) -> list[Card]:
    """The cards of all entries that state a sign or a stability, in the paper's order."""
    return [cards[entry.id] for letter in PARTS for entry, _ in site.entries(letter) if on_signs(entry)]
