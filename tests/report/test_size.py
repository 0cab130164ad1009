"""The site is small enough to be sent, kept and opened anywhere: pages, results and notebooks are below 15 MB together.

Sizes creep: a table with one row for each point of each curve, or drawings with digits that nobody sees, cost megabytes unnoticed.
"""

from pathlib import Path

from rkverify.paths import checkout
from rkverify.report.notebook_pages import output
from rkverify.report.show import study_figure

LIMIT = 15e6
"""Bytes."""


def sizes(*folders: Path) -> dict[str, int]:
    """The files below folders -> their size in bytes, the largest first."""
    found = [path for folder in folders for path in folder.rglob("*") if path.is_file()]
    return {str(path): path.stat().st_size for path in sorted(found, key=lambda path: -path.stat().st_size)}


def test_the_site_is_below_its_limit(pages: Path) -> None:
    """Pages as they are built now, the committed results, and the notebooks where they have been executed."""
    place = checkout()
    found = sizes(pages, place.results, place.pages / "notebooks")
    largest = ", ".join(f"{Path(path).name} {size / 1e6:.2f}" for path, size in list(found.items())[:8])
    total = sum(found.values())
    assert total < LIMIT, f"{total / 1e6:.1f} MB; the largest: {largest}"


def test_all_files_count(tmp_path: Path) -> None:
    (tmp_path / "one" / "two").mkdir(parents=True)
    (tmp_path / "one" / "two" / "long.csv").write_bytes(b"x" * 9)
    (tmp_path / "short.svg").write_bytes(b"x" * 4)
    assert list(sizes(tmp_path).values()) == [9, 4]


def test_a_notebook_s_page_shows_a_study_s_drawing_without_holding_it() -> None:
    shown = study_figure("figure4", "figure4.svg")
    page = str(output({"output_type": "display_data", "data": {"text/html": shown.html}}, "../results"))
    assert '<img src="../results/figure4/figure4.svg" alt="' in page
    assert "base64" not in page
    assert "base64" in shown.html  # the notebook itself can be opened anywhere
