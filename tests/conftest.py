"""A browser for pages; profiles of the property tests: dev (quick), ci (always the same), fuzz (many, climbing), faults (few, not shrunk).

RKVERIFY_HYPOTHESIS=ci, fuzz or faults chooses one; dev is the default.
"""

import os
import shutil
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, Phase, settings

if TYPE_CHECKING:
    from playwright.sync_api import Browser

FLAGS = ["--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"]

slow_is_fine = (HealthCheck.too_slow, HealthCheck.filter_too_much)
settings.register_profile("dev", max_examples=25, deadline=None, suppress_health_check=slow_is_fine, database=None)
settings.register_profile(
    "ci", max_examples=60, deadline=None, suppress_health_check=slow_is_fine, database=None, derandomize=True
)
settings.register_profile(
    "faults",
    max_examples=25,
    deadline=None,
    suppress_health_check=slow_is_fine,
    database=None,
    derandomize=True,
    phases=(Phase.explicit, Phase.generate),
)
settings.register_profile(
    "fuzz",
    max_examples=2000,
    deadline=None,
    suppress_health_check=slow_is_fine,
    phases=(Phase.explicit, Phase.reuse, Phase.generate, Phase.target, Phase.shrink),
)
settings.load_profile(os.environ.get("RKVERIFY_HYPOTHESIS", "dev"))


@pytest.fixture(scope="session")
def browser() -> "Iterator[Browser]":
    """Debian's Chromium, one for all tests of a process: Playwright allows no second; without one the test says what to install."""
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    assert path, "no Chromium found: apt-get install chromium, or leave these tests out with -m 'not browser'"
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS, chromium_sandbox=False)
        yield browser
        browser.close()
