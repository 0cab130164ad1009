"""Pages built from the committed results into a folder of the test's own."""

from dataclasses import replace
from pathlib import Path

import pytest

from rkverify.paths import checkout
from rkverify.report.site import build


@pytest.fixture(scope="session")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the pages, its name with a space in it."""
    folder = tmp_path_factory.mktemp("the report") / "pages"
    build(replace(checkout(), pages=folder))
    return folder
