"""The stored notebooks, their solutions, and a browser for their pages."""

import importlib.util
import shutil
from collections.abc import Callable, Iterator
from types import ModuleType

import pytest
from playwright.sync_api import Browser, sync_playwright

from rkverify.paths import checkout


@pytest.fixture(scope="session")
def solutions() -> Callable[[str], ModuleType]:
    """solutions(NAME): the module notebooks/solutions/NAME.py."""

    def load(name: str) -> ModuleType:
        path = checkout().root / "notebooks" / "solutions" / f"{name}.py"
        spec = importlib.util.spec_from_file_location(f"solutions_{name}", path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return load


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Debian's Chromium; without one the test fails and says what to install."""
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    assert path, "no Chromium found: apt-get install chromium, or leave these tests out with -m 'not browser'"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, chromium_sandbox=False)
        yield browser
        browser.close()
