"""The rubber that jobs of a page share: checked, made once, kept in memory and beside the uploads."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from refusals import refused
from viscofric.errors import StudyError
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.study import validated
from viscofric.web.jobs import rubbers
from viscofric.web.jobs.context import Context
from web.rubber_workspace import EXAMPLE, SWEEPS, workspace_with


@pytest.fixture
def workspace(tmp_path: Path) -> Context:
    return workspace_with(tmp_path, EXAMPLE)


@pytest.fixture(autouse=True)
def _empty_memory() -> None:
    rubbers._memory.clear()


def counted(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    calls: list[object] = []
    make = rubbers.make_rubber

    def make_and_count(table: Any, **options: Any) -> Any:
        calls.append(table)
        return make(table, **options)

    monkeypatch.setattr(rubbers, "make_rubber", make_and_count)
    return calls


def test_rubber_is_that_of_the_run_file(workspace: Context) -> None:
    made = rubbers.made_rubber({"material": {**SWEEPS, "shift": "wlf+arrhenius"}}, workspace)
    table = validated(MaterialTable, {**SWEEPS, "shift": "wlf+arrhenius"}).relative_to(EXAMPLE.parent)
    whole = rubbers.make_rubber(table)
    assert made.shift_used == "wlf+arrhenius"
    np.testing.assert_array_equal(made.material.modes_at().C, whole.material.modes_at().C)


def test_second_job_makes_no_second_rubber(workspace: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = counted(monkeypatch)
    first = rubbers.made_rubber({"material": SWEEPS}, workspace)
    assert rubbers.made_rubber({"material": dict(SWEEPS), "title": "other"}, workspace) is first
    assert len(calls) == 1


def test_another_child_finds_the_rubber_on_disk(workspace: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    first = rubbers.made_rubber({"material": SWEEPS}, workspace)
    rubbers._memory.clear()
    calls = counted(monkeypatch)
    again = rubbers.made_rubber({"material": SWEEPS}, workspace)
    assert not calls
    assert again.fit is not None
    assert first.fit is not None
    np.testing.assert_array_equal(again.material.modes_at().C, first.material.modes_at().C)
    assert again.fit.check.sentences == first.fit.check.sentences


def test_changed_file_or_table_makes_a_new_rubber(workspace: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = counted(monkeypatch)
    first = rubbers.made_rubber({"material": SWEEPS}, workspace)
    other = rubbers.made_rubber({"material": {**SWEEPS, "reference_temperature": "40 degC"}}, workspace)
    lines = (workspace.files / "dma.csv").read_text().splitlines(keepends=True)
    (workspace.files / "dma.csv").write_text("".join(lines[:-1]))
    shorter = rubbers.made_rubber({"material": SWEEPS}, workspace)
    assert len(calls) == 3
    assert other.material.reference == pytest.approx(313.15)
    assert first.sweeps is not None
    assert shorter.sweeps is not None
    points = [sum(len(sweep) for sweep in one.sweeps.isotherms) for one in (first, shorter)]
    assert points[1] == points[0] - 1


def test_draws_are_kept_and_are_those_asked_for(workspace: Context) -> None:
    study = {"material": SWEEPS, "uncertainty": {"draws": 20, "seed": 3}}
    bands = rubbers.friction_bands(study, workspace)
    assert bands.samples is not None
    assert len(bands.samples) == 20
    assert rubbers.friction_bands(study, workspace) is bands
    rubbers._memory.clear()
    again = rubbers.friction_bands(study, workspace)
    assert again.samples is not None
    np.testing.assert_array_equal(again.samples.C, bands.samples.C)


def test_rubber_to_solve_with_refuses_a_temperature_without_shift_factor(workspace: Context) -> None:
    study = {"material": SWEEPS, "uncertainty": {"draws": 0}}
    assert rubbers.study_rubber(study, workspace, [333.15]).material.reference == pytest.approx(303.15)
    with refused("outside-measured", naming="300.0 °C"):
        rubbers.study_rubber(study, workspace, [573.15])


@pytest.mark.parametrize(
    ("material", "refusal"),
    [
        ({}, ("contradiction", "material")),
        ({**SWEEPS, "deformation": "torsion"}, ("literal-error", "material.deformation", "'torsion'")),
        ({**SWEEPS, "dma": __file__}, ("file-not-here", "material.dma", "test_rubber_cache.py")),
        ({**SWEEPS, "dma": ["dma.csv", "b.csv"]}, ("file-not-here", "material.dma", "'b.csv'")),
        ({**SWEEPS, "fixed_shift_factors": {"cold": 1.0}}, ("no-number", "material.fixed_shift_factors", "'cold'")),
        ({"file": "rubber.json"}, ("file-not-here", "material.file", "'rubber.json'")),
    ],
)
def test_what_is_wrong_is_reported_with_its_field(
    workspace: Context, material: dict[str, Any], refusal: tuple[str, ...]
) -> None:
    with refused(refusal[0], StudyError, naming=refusal[1:]):
        rubbers.made_rubber({"material": material}, workspace)


def test_a_damaged_file_in_the_cache_is_made_anew(workspace: Context) -> None:
    first = rubbers.made_rubber({"material": SWEEPS}, workspace)
    (kept,) = workspace.cache.glob("rubber-*.pickle")
    kept.write_bytes(kept.read_bytes()[:1000])
    rubbers._memory.clear()
    again = rubbers.made_rubber({"material": SWEEPS}, workspace)
    np.testing.assert_array_equal(again.material.modes_at().C, first.material.modes_at().C)
