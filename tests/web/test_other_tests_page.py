"""Creep tests, temperature ramps and amplitude sweeps dropped on the page: recognised, asked about, shown, used."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import viscofric as vf
from web import other_tests as samples

if TYPE_CHECKING:
    from pathlib import Path

    from web.browser_tab import Tab

_DROP = "#step-sweeps .panel:not([hidden]) input[type=file]"


def dropped(tab: Tab, *paths: Path) -> None:
    tab.step("sweeps")
    tab.page.check("input[name=material-source][value=dma]")
    tab.page.locator(_DROP).first.set_input_files(list(paths))


def drawn(tab: Tab, figure: str, curves: int) -> None:
    tab.until(f"document.querySelector('#figure-{figure} .plot')?.data?.length >= {curves}")


def friction_is_predicted(tab: Tab) -> None:
    tab.step("contact")
    tab.until("page.jobs.result('rubber')?.shift?.reference > 0")
    assert tab.value("page.jobs.result('rubber').spectrum.modes !== null")


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_creep_tests_are_recognised_and_asked_about(tab: Tab, tmp_path: Path) -> None:
    dropped(tab, samples.creep(tmp_path))
    kind = tab.page.locator("#step-sweeps").get_by_label("Measured in")
    kind.wait_for()
    kind.select_option(label="tension: E′, E″")
    drawn(tab, "step-tests", 3)
    assert tab.value("page.state.state.get('material')") == {
        "creep": "creep.csv",
        "reference_temperature": "20 degC",
        "deformation": "tension",
    }
    tab.screenshot("creep-data")
    tab.step("shift")
    drawn(tab, "shifted-steps", 4)
    assert tab.text("#step-shift .verdict") == "Superposition holds"
    tab.screenshot("creep-shift")
    tab.step("spectrum")
    tab.until("page.jobs.result('rubber')?.band?.draws > 0", 60.0)
    assert "misfit of the step tests" in tab.text("#step-spectrum .key-numbers")
    tab.screenshot("creep-spectrum")
    found = tab.value("page.jobs.result('rubber').shift.factors")
    assert found["temperature"] == pytest.approx([273.15, 283.15, 293.15])
    planted = vf.synthetic_fluoroelastomer().shift
    # the step tests' own standard errors, 0.1 decades at most
    expected = planted.log10(np.array(found["temperature"])) - planted.log10(293.15)
    assert found["log10_shift_factor"] == pytest.approx(expected.tolist(), abs=0.1)


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_sweeps_and_creep_dropped_together_make_one_material(tab: Tab, tmp_path: Path) -> None:
    dropped(tab, samples.sweeps(tmp_path), samples.creep(tmp_path))
    kind = tab.page.locator("#step-sweeps").get_by_label("Measured in")
    kind.wait_for()
    kind.select_option(label="tension: E′, E″")
    drawn(tab, "isotherms-storage-modulus", 4)
    drawn(tab, "step-tests", 3)
    material = tab.value("page.state.state.get('material')")
    assert (material["dma"], material["creep"]) == ("sweeps.csv", "creep.csv")
    tab.step("shift")
    drawn(tab, "shifted-isotherms", 4)
    drawn(tab, "shifted-steps", 4)
    tab.screenshot("joint-shift")


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_a_ramp_at_one_frequency_asks_for_a_law(tab: Tab, tmp_path: Path) -> None:
    dropped(tab, samples.ramp(tmp_path, 1.0))
    drawn(tab, "isotherms-storage-modulus", 1)
    law = tab.page.locator("#step-sweeps").get_by_label("Assumed shift law")
    law.wait_for()
    law.fill("universal")
    law.press("Tab")
    tab.until("page.jobs.result('rubber')?.shift?.used === 'assumed'")
    assert tab.value("page.state.state.get('material')")["ramps"] == "ramp.csv"
    tab.screenshot("ramp-data")
    tab.step("shift")
    drawn(tab, "shift-factors", 1)
    tab.screenshot("ramp-shift")
    friction_is_predicted(tab)


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_an_amplitude_sweep_scales_the_material_of_the_contact(tab: Tab, tmp_path: Path) -> None:
    dropped(tab, samples.amplitudes(tmp_path))
    drawn(tab, "amplitude-sweep", 4)
    assert "Kraus" in tab.text("#step-sweeps")
    tab.page.get_by_role("button", name="Use the strain of the contact").click()
    tab.until("page.state.state.get('material.strain') > 0", 60.0)
    material = tab.value("page.state.state.get('material')")
    assert material["catalogue"] == "synthetic fluoroelastomer"
    assert material["amplitude_sweep"] == "payne.csv"
    assert 0.005 < material["strain"] < 0.1  # 0.2 a/R of 10 N on a ball of 9.525 mm
    assert "instead of" in tab.text("#step-sweeps")
    tab.until("page.jobs.result('rubber')?.name.includes('scaled')")
    tab.screenshot("amplitude")


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_two_specimens_in_one_set_are_a_question(tab: Tab, tmp_path: Path) -> None:
    first = samples.sweeps(tmp_path)
    second, head = tmp_path / "second.csv", first.read_text().splitlines()
    cells = [line.split(",") for line in head[1:]]
    stiffer = [[*row[:-2], *(f"{1.3 * float(modulus):.9g}" for modulus in row[-2:])] for row in cells]
    second.write_text("\n".join([head[0], *map(",".join, stiffer), ""]))
    dropped(tab, first, second)
    question = tab.page.get_by_role("group", name="Which files are of the specimen?")
    question.wait_for()
    assert "26\N{NO-BREAK SPACE}%" in question.inner_text()  # 0.3 of the mean, 1.15
    tab.screenshot("two-specimens")
    assert tab.findings() == []
    files = "page.state.state.get('material.dma')"
    question.get_by_role("button", name="Average all").click()
    question.wait_for(state="detached")
    assert tab.value(files) == ["second.csv", "sweeps.csv"]
    tab.page.get_by_role("button", name="Undo").click()
    question.wait_for()
    question.get_by_label("second.csv").uncheck()
    question.get_by_label("sweeps.csv").check()
    question.get_by_role("button", name="Use the ticked files").click()
    question.wait_for(state="detached")
    assert tab.value(files) == "sweeps.csv"
    drawn(tab, "isotherms-storage-modulus", 4)
    tab.page.get_by_role("button", name="Undo").click()
    question.wait_for()
    assert tab.value(files) == ["second.csv", "sweeps.csv"]
