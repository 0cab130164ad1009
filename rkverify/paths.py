"""Where things are: the checkout with its studies, what it commits under reports/, and what it keeps to itself."""

from dataclasses import dataclass
from pathlib import Path

from rkverify.errors import NeedsCheckout

QUICK = "quick"


@dataclass(frozen=True)
class Checkout:
    """The folders of a checkout. `results` and `pages` may point elsewhere, for a quick run or a comparison."""

    root: Path
    results: Path
    pages: Path
    state: Path

    @property
    def studies(self) -> Path:
        """One file per study."""
        return self.root / "studies"

    @property
    def lock(self) -> Path:
        """The pinned environment."""
        return self.root / "requirements.lock"

    @property
    def manifest(self) -> Path:
        """The list of every artefact with its hash."""
        return self.results.parent / "manifest.json"

    @property
    def runs(self) -> Path:
        """What this machine has run: one record per study, never committed."""
        return self.state / "runs"

    def quick(self) -> "Checkout":
        """The same checkout, with a quick run's results and pages under .rkverify/quick."""
        place = self.state / QUICK
        return Checkout(self.root, place / "results", place, place / "state")

    def shown(self, path: Path) -> str:
        """The path as a person in the checkout would write it."""
        return path.relative_to(self.root).as_posix() if path.is_relative_to(self.root) else str(path)


def checkout() -> Checkout:
    """The checkout that this package runs from: its sources are the ones whose hashes go into identities.

    Raises NeedsCheckout for an installed wheel.
    """
    root = Path(__file__).resolve().parents[1]
    if not (root / "studies" / "__init__.py").is_file():
        raise NeedsCheckout(
            "this command works on the studies, which a wheel does not have: run `python -m rkverify` in a checkout (git clone)"
        )
    return Checkout(root, root / "reports" / "results", root / "reports", root / ".rkverify")
