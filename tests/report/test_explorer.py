"""The explorer in a real browser: its numbers are those of `rkverify dispersion`, and it draws while a slider moves.

It computes by other code in another language; that all settings agree to rounding is what makes its pictures evidence.
"""

import random
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

from rkverify.paths import checkout
from rkverify.readings import DERIVATIVES, HALF_POINTS
from rkverify.report import explorer
from rkverify.stability.layers import Setting, dispersion

pytestmark = pytest.mark.browser

Opened = Callable[..., AbstractContextManager[Page]]
"""What `conftest.opened` gives."""
AGREEMENT = 1e-7
"""Of the largest frequency: six digits, less what the double eigenvalues of a matrix lose to rounding."""


def settings(count: int, seed: int) -> list[dict[str, Any]]:
    """Random settings of every kind that the explorer offers."""
    rng = random.Random(seed)
    found = []
    for _ in range(count):
        semi = rng.random() < 0.8
        layer = rng.choice(("printed", "as-defined", "consistent"))
        integration = rng.choice(("scni", "dni")) if semi or layer != "printed" else "scni"
        found.append(
            {
                "formulation": "semi-lagrangian" if semi else "lagrangian",
                "integration": integration,
                "layer": layer,
                "R": round(rng.uniform(1.05, 4), 3),
                "s": round(rng.uniform(-2, 2), 3),
                "Q": round(rng.uniform(-1, 1), 3) if semi and rng.random() < 0.7 else 0,
                "kernel": rng.choice(list(explorer.kernels())),
                "derivative": rng.choice(DERIVATIVES),
                "half_point": rng.choice(HALF_POINTS),
                "stress_law": rng.choice(("truesdell", "cauchy-rate")),
                "convective": not semi or rng.random() < 0.8,
            }
        )
    return found


def of_the_library(raw: dict[str, Any]) -> Setting:
    """The same setting for `rkverify dispersion`, readings only where they count."""
    semi, printed = raw["formulation"] != "lagrangian", raw["layer"] == "printed"
    more = {"stress_law": raw["stress_law"]} if semi and not printed else {}
    more |= {"half_point": raw["half_point"]} if semi and printed else {}
    return Setting(
        raw["formulation"],
        raw["integration"],
        raw["R"],
        raw["s"],
        velocity_gradient=raw["Q"],
        convective=raw["convective"],
        derivative=raw["derivative"],
        kernel=raw["kernel"],
        layer=raw["layer"],
        **more,
    )


def distance(ours: list[complex], theirs: list[complex]) -> float:
    """How far the two sets of roots are apart, over the largest root."""
    gaps = [min(abs(a - b) for b in theirs) for a in ours] + [min(abs(a - b) for b in ours) for a in theirs]
    return max(gaps) / max(map(abs, theirs))


def test_the_roots_are_those_of_the_library(opened: Opened, pages: Path) -> None:
    waves = [0.3, 1.7, 2.9]
    with opened() as page:
        page.goto((pages / "explorer.html").as_uri())
        asked = settings(100, seed=7)
        answers = page.evaluate("([all, kh]) => all.map(set => rkverify.dispersion(set, kh))", [asked, waves])
        for raw, answer in zip(asked, answers, strict=True):
            expected = dispersion(of_the_library(raw), waves)
            for kh, roots in zip(waves, answer, strict=True):
                theirs = [complex(b.omega.re, b.omega.im) for b in expected if b.kh == kh]
                assert distance([complex(*root) for root in roots], theirs) < AGREEMENT, (raw, kh)
        # The twin: another stress gives other roots, so that the comparison can fail.
        other = page.evaluate(
            "([set, kh]) => rkverify.dispersion(set, kh)", [{**asked[0], "s": asked[0]["s"] + 0.01}, waves]
        )
        assert distance([complex(*r) for r in other[0]], [complex(*r) for r in answers[0][0]]) > 1e-4


def test_a_slider_redraws_curve_and_map_in_time(opened: Opened, pages: Path) -> None:
    """50 ms at 200 waves: the best of several, since other processes share the machine."""
    with opened() as page:
        page.goto((pages / "explorer.html").as_uri())
        assert page.locator("#curve path").count() == 4
        before = page.locator("#curve").inner_html(), page.locator("#map").inner_html()
        move = """([name, value]) => {
            const slide = document.querySelector(`[name=${name}-slide]`);
            slide.value = value;
            slide.dispatchEvent(new Event("input", { bubbles: true }));
            return rkverify.took;
        }"""
        took = {
            name: [page.evaluate(move, [name, value + n / 20]) for n in range(8)]
            for name, value in (("R", 1.5), ("Q", 0.1), ("s", -1.5))
        }
        assert {name: min(times) < 50 for name, times in took.items()} == {"R": True, "Q": True, "s": True}, took
        after = page.locator("#curve").inner_html(), page.locator("#map").inner_html()
        assert before[0] != after[0]
        assert before[1] != after[1]
        assert "the fastest growth is" in page.locator("#explorer-says").inner_text()


@pytest.mark.parametrize(
    ("choice", "shown"),
    [
        ({}, "(76)"),
        ({"integration": "dni"}, "(82)"),
        ({"convective": "no"}, "(86)"),
        ({"integration": "dni", "convective": "no"}, "(87)"),
        ({"formulation": "lagrangian"}, "(63)"),
        ({"formulation": "lagrangian", "integration": "dni"}, "no relation"),
    ],
)
def test_the_printed_relation_stands_beside(opened: Opened, pages: Path, choice: dict[str, str], shown: str) -> None:
    with opened() as page:
        page.goto((pages / "explorer.html").as_uri())
        for name, value in choice.items():
            page.locator(f"select[name={name}]").select_option(value)
        assert page.get_by_text(shown).filter(visible=True).count() == 1


def test_a_wave_that_was_measured_is_shown_beside_its_curve(opened: Opened, pages: Path) -> None:
    """The layer simulated: every measured wave can be chosen, its ring lies on the curve of the linearised equations."""
    waves = explorer.measured(checkout())
    assert len(waves) > 30
    with opened() as page:
        page.goto((pages / "explorer.html").as_uri())
        assert page.locator("#curve circle").count() == 1  # the page opens at a setting that was measured
        assert page.locator("select[name=measured] option").count() == len(waves) + 1
        for place in (0, len(waves) // 2, len(waves) - 1):
            wave = waves[place]
            page.locator("select[name=measured]").select_option(str(place))
            assert page.locator("#curve circle").count() == 1
            assert f"{wave['quantity']} {wave['value']:.4g}" in page.locator("#explorer-says").inner_text()
            assert "--layer simulated" in page.locator("#simulated").inner_text()
            set_ = {name: wave[name] for name in ("formulation", "integration", "derivative", "kernel", "R", "s")}
            roots = page.evaluate(
                "([set, kh]) => rkverify.dispersion(set, kh)",
                [{**set_, "layer": "as-defined", "Q": 0, "stress_law": "truesdell", "convective": True}, [wave["kh"]]],
            )[0]
            computed = max(-im if wave["quantity"] == "growth" else abs(re) for re, im in roots)
            # The study's own measure of agreement: one part in a thousand.
            assert wave["value"] == pytest.approx(computed, rel=1e-3)
        same = [
            w for w in waves if all(w[n] == wave[n] for n in ("formulation", "integration", "derivative", "kernel"))
        ]
        assert page.locator("#map circle").count() == len(same)
        page.locator("[name=s]").fill("0.123")
        assert page.locator("#curve circle").count() == 0
