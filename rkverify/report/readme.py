"""The block of the README that says what stands and what falls, from computed states."""

from rkverify.ledger.states import FAILS, OPEN, READING, State, counts

BEGIN, END = "<!-- states: begin -->", "<!-- states: end -->"


def summary(found: dict[str, State]) -> str:
    """Counts by state, and the names of the entries that fail or hold only under a reading, as Markdown."""
    rows = "\n".join(f"| {name} | {count} |" for name, count in counts(found).items())

    def names(word: str) -> str:
        return ", ".join(name for name, s in found.items() if s.name == word) or "none"

    printed = [name for name, s in found.items() if s.name == OPEN and s.evidence]
    return (
        f"{BEGIN}\n| state | entries |\n|---|---|\n{rows}\n\n"
        f"Fails: {names(FAILS)}. Holds only under a reading: {names(READING)}. Decided for the printed formula and still open "
        f"for the method: {', '.join(printed) or 'none'}.\n{END}"
    )
