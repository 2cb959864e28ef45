"""The whole path through the page with files of real instruments, from the upload to a run file that repeats it."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import viscofric as vf
from web.browser_tab import tab as opened_tab

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser

    from web.browser_tab import Tab
    from web.served_page import Server

pytestmark = pytest.mark.apart  # a browser, a study, and the study again
_SECONDS = 90.0  # at most for each thing that is computed, on a machine that does other work too
_ACCURACY = 0.02  # asked of both, relative


def choose(tab: Tab, label: str, option: str) -> None:
    tab.page.locator("section.step:not([hidden])").get_by_label(label, exact=True).select_option(label=option)


def fill(tab: Tab, label: str, text: str) -> None:
    field = tab.page.locator("section.step:not([hidden])").get_by_role("textbox", name=label, exact=True)
    field.fill(text)
    field.press("Tab")


def sound(tab: Tab, name: str) -> None:
    """Look at a step: a picture of it, nothing serious for axe, nothing wider than the window."""
    tab.page.wait_for_timeout(300)  # figures are drawn one after the other
    tab.screenshot(f"path-{name}")
    assert tab.findings() == []
    assert tab.value("document.documentElement.scrollWidth - innerWidth") <= 0


def test_from_a_dma_file_to_a_run_file_that_repeats_it(
    browser: Browser, server: Server, real_data: Path, tmp_path: Path
) -> None:
    with opened_tab(browser, server, "#export") as tab:
        tab.value("page.state.state.set('solver.accuracy', given[0])", _ACCURACY)
        rubber_of(tab, real_data / "dma" / "vinyl_nitrile_foam.csv")
        curve = friction_of(tab)
        measurement_of(tab, real_data / "mtm" / "demo-mtm-output.txt")
        packed = exported(tab, tmp_path)
    repeated = run_again(packed, tmp_path / "elsewhere")
    assert repeated.shape == (2, 3)
    # both know friction to the requested accuracy, so that they differ by twice that at most
    reported = np.reshape(curve["friction"], (2, 3))
    assert reported == pytest.approx(repeated, rel=2 * _ACCURACY)


def rubber_of(tab: Tab, path: Path) -> None:
    """Drop a file, answer what it leaves open, and look at what becomes of it."""
    tab.step("sweeps")
    tab.page.check("input[name=material-source][value=dma]")
    tab.page.set_input_files("#step-sweeps .panel:not([hidden]) input[type=file]", path)
    tab.until("page.jobs.result('sweeps')?.isotherms.length === 19", _SECONDS)
    # the first study's third temperature lies beyond these sweeps
    assert tab.value("page.state.state.get('conditions.temperature')") == ["30 degC", "60 degC"]
    assert tab.value("page.state.state.get('title')") == "Friction of vinyl_nitrile_foam"
    tab.step("shift")
    tab.page.get_by_role("button", name="Go to Data").click()
    choose(tab, "Measured in", "shear: G′, G″")
    sound(tab, "1-data")
    tab.step("shift")
    tab.until("page.jobs.result('rubber')?.band !== undefined", _SECONDS)
    assert tab.text("#step-shift .verdict").startswith("Superposition")
    sound(tab, "2-shift")
    tab.step("spectrum")
    tab.until("document.querySelector('#figure-modulus .plot').data?.length > 3", _SECONDS)
    sound(tab, "3-spectrum")


def friction_of(tab: Tab) -> dict[str, Any]:
    """Have the friction of a steel cylinder on a layer of it at two temperatures; return what the page was told."""
    tab.value("page.state.state.set('conditions.speed', ['10 mm/s', '100 mm/s', '1 m/s'])")
    tab.step("contact")
    tab.page.select_option("#contact-shape", "cylinder")
    fill(tab, "Load per length", "0.5")
    tab.page.get_by_label("Layer on a rigid base").check()
    fill(tab, "Thickness", "3")
    tab.until("page.state.state.get('layer.thickness') === '3 mm'")
    done = "page.jobs.result('curve')?.friction.length === 6 && page.jobs.result('curve')?.kind === 'line'"
    tab.until(f"{done} && document.querySelector('#step-contact .progress').className.includes('done')", _SECONDS)
    tab.until("document.querySelector('.live-status').textContent === 'converged'", _SECONDS)
    sound(tab, "4-contact")
    found: dict[str, Any] = tab.value("page.jobs.result('curve')")
    return found


def measurement_of(tab: Tab, path: Path) -> None:
    """Drop a test, learn what hinders its separation, and give it up again: it was no test of a rubber."""
    tab.step("measurement")
    tab.page.set_input_files("#step-measurement input[type=file]", path)
    tab.page.locator("#step-measurement .notes.error").get_by_text("by “Steps to leave out”: 2").wait_for(
        timeout=1e3 * _SECONDS
    )
    sound(tab, "5-measurement")
    tab.page.get_by_role("button", name="Remove the measurement").click()


def exported(tab: Tab, folder: Path) -> Path:
    """Run the study on the page with two processes, and take run file and data along."""
    tab.step("export")
    tab.page.wait_for_selector("pre .heading")
    tab.page.get_by_label("Processes").fill("2")
    tab.page.get_by_role("button", name="Run the whole study").click()
    tab.page.locator("#step-export .downloads a").first.wait_for(timeout=1e3 * _SECONDS)
    assert "all solved" in tab.text("#step-export .key-numbers")
    sound(tab, "6-export")
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save project").click()
    packed = folder / "study.zip"
    download.value.save_as(packed)
    return packed


def run_again(packed: Path, folder: Path) -> Any:
    """Unpack and run it as its last line says; return friction over temperature and speed."""
    with zipfile.ZipFile(packed) as archive:
        archive.extractall(folder)
    command = [sys.executable, "-m", "viscofric", "run", "study.toml"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    found = vf.open_results(folder / "study.results").dataset["friction_coefficient"]
    return found.transpose("temperature", "speed").values
