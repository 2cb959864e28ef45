"""Checks against published numbers: they hold, they fail where something is wrong, and their page has all of them."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from viscofric.contact import steady
from viscofric.motion import solve as motion
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification import CHECKS, select
from viscofric.verification.published import PUBLISHED, cards, closed_forms, persson

DOCS = Path(__file__).parents[2] / "docs"
NAMES = [check.name for check in PUBLISHED]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_published_numbers_are_met(name: str) -> None:
    (check,) = select(PUBLISHED, [name])
    outcome = check.run()
    assert outcome.passed, (outcome.trouble, outcome.worst)


def test_every_number_has_its_origin() -> None:
    assert len(set(NAMES)) == len(NAMES)
    assert not set(NAMES) & {check.name for check in CHECKS}
    for check in PUBLISHED:
        assert check.title, check.name
        assert check.source, check.name
        assert check.obtained.endswith("."), check.name
        assert check.reason.endswith("."), check.name
        assert not check.unstated or check.unstated.endswith("."), check.name


# Each check fails if the solver, the theory or the card is wrong in its own way.


def on_another_solid(patch: pytest.MonkeyPatch, glassy: float, lossy: float) -> None:
    """Let contacts be solved on a solid whose glassy compliance and whose modes are multiplied by these factors."""
    original = steady.solve_steady

    def solve(material: Material, *arguments: Any, **settings: Any) -> Any:
        old = material.modes_at()
        C, glass = lossy * old.C, glassy / old.E_inf
        spectrum = RetardationSpectrum(1.0 / (glass + C.sum()), 1.0 / glass, C, old.tau)
        return original(Material(spectrum, poisson_ratio=material.poisson_ratio), *arguments, **settings)

    patch.setattr(steady, "solve_steady", solve)


def softer(patch: pytest.MonkeyPatch) -> None:
    on_another_solid(patch, 1.02, 1.02)


def lossier(patch: pytest.MonkeyPatch) -> None:
    on_another_solid(patch, 1.0, 1.05)


def slower(patch: pytest.MonkeyPatch) -> None:
    """Let contacts move at 80 % of their speed."""
    original = steady.solve_steady

    def solve(*arguments: Any, speed: float, **settings: Any) -> Any:
        return original(*arguments, speed=0.8 * speed, **settings)

    patch.setattr(steady, "solve_steady", solve)


def quicker(patch: pytest.MonkeyPatch) -> None:
    """Let contacts over time relax 2 % faster."""
    original = motion.solve_transient

    def solve(material: Material, *arguments: Any, **settings: Any) -> Any:
        old = material.modes_at()
        spectrum = RetardationSpectrum(old.E0, old.E_inf, old.C, 0.98 * old.tau)
        return original(Material(spectrum, poisson_ratio=material.poisson_ratio), *arguments, **settings)

    patch.setattr(motion, "solve_transient", solve)


def another_share(patch: pytest.MonkeyPatch) -> None:
    original = persson.persson_theory
    patch.setattr(
        persson, "persson_theory", lambda *arguments, **settings: original(*arguments, **settings | {"gamma": 0.6})
    )


def heat_that_stays(patch: pytest.MonkeyPatch) -> None:
    """Let the rubber conduct a tenth less heat away."""
    conducting = replace(persson._RUBBER, conductivity=0.9 * float(persson._RUBBER.conductivity))
    original = persson.persson_theory

    def theory(*arguments: Any, **settings: Any) -> Any:
        warm = {"thermal": conducting} if settings.get("thermal") is persson._RUBBER else {}
        return original(*arguments, **settings | warm)

    patch.setattr(persson, "persson_theory", theory)


def stiffer_card(patch: pytest.MonkeyPatch) -> None:
    numbers = cards.card_numbers

    def wrong() -> Any:
        modulus, *rest = numbers()
        return 1.001 * modulus, *rest

    patch.setattr(cards, "card_numbers", wrong)


SEEN_BY: dict[str, Callable[[pytest.MonkeyPatch], None]] = {
    "carbone-putignano": slower,
    "wang-knothe": softer,
    "felupe-layer": softer,
    "conveyor-belt": slower,
    "slow-ball": slower,
    "power-law-cylinder": slower,
    "greenwood-tabor": lossier,
    "ting-unloading": quicker,
    "persson-theory": another_share,
    "persson-flash": heat_that_stays,
    "frontistr-card": stiffer_card,
    "simcoon-relaxation": stiffer_card,
}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_a_wrong_result_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    SEEN_BY[name](monkeypatch)
    (check,) = select(PUBLISHED, [name])
    assert any(not one.passed for one in check.compare())  # stops at the first


def test_a_power_law_solid_has_its_modulus() -> None:
    material = closed_forms.power_law_material(0.3)
    for omega in (1e-3, 1.0, 1e3):
        assert complex(material.complex_modulus(omega)) == pytest.approx(1e6 * (1j * omega) ** 0.3, rel=2e-4)


@pytest.fixture
def pages(extension: Callable[[str], ModuleType]) -> ModuleType:
    return extension("verification_pages")


@pytest.mark.slow
def test_the_page_holds_every_comparison_and_origin(pages: ModuleType) -> None:
    outcomes = [check.run() for check in select(PUBLISHED, ["frontistr-card", "persson-theory"])]
    rows = pages.published_numbers(outcomes).splitlines()[2:]
    assert len(rows) == sum(len(outcome.comparisons) for outcome in outcomes)
    text = pages.origins(outcomes)
    for outcome in outcomes:
        for part in (
            pages.linked(outcome.check.source),
            outcome.check.obtained,
            outcome.check.unstated,
            outcome.check.reason,
        ):
            assert part in text
    assert "[doi:10.1063/1.1388626](https://doi.org/10.1063/1.1388626), with" in text
    page = (DOCS / "published.md").read_text(encoding="utf-8")
    included = set(re.findall(r"_generated/published/(\w+)\.(?:md|svg)", page))
    assert included == {"numbers", "origins", "deviations"}
