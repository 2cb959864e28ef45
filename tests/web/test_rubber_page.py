"""Data, shift and spectrum in a real browser: files dropped, an isotherm dragged, E(ω) at another temperature."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING

import pytest

import viscofric as vf

if TYPE_CHECKING:
    from pathlib import Path

    from web.browser_tab import Tab


_DROP = "#step-sweeps .panel:not([hidden]) input[type=file]"


def drawn(opened: Tab, figure: str, curves: int) -> None:
    """Wait until a figure shows so many curves."""
    opened.until(f"document.querySelector('#figure-{figure} .plot')?.data?.length >= {curves}")


def example(opened: Tab) -> None:
    """Choose the synthetic example's sweeps."""
    opened.step("sweeps")
    opened.page.check("input[name=material-source][value=dma]")
    opened.page.get_by_role("button", name="Use the synthetic example").click()
    drawn(opened, "isotherms-storage-modulus", 24)


def rubber_is_made(opened: Tab) -> None:
    opened.until("page.jobs.result('rubber')?.band !== undefined")


def point_of(opened: Tab, figure: str, curve: str) -> tuple[float, float, float]:
    """Return where the middle point of a curve is on the screen, and how many pixels a decade is."""
    opened.page.locator(f"#figure-{figure} .plot").scroll_into_view_if_needed()
    x, y, decade = opened.value(
        """(() => { const plot = document.querySelector(`#figure-${given[0]} .plot`);
        const trace = plot.data.find((one) => one.name === given[1]); const at = Math.floor(trace.x.length / 2);
        const { xaxis, yaxis } = plot._fullLayout; const box = plot.getBoundingClientRect();
        return [box.left + xaxis._offset + xaxis.d2p(trace.x[at]), box.top + yaxis._offset + yaxis.d2p(trace.y[at]),
                xaxis._length / (xaxis.range[1] - xaxis.range[0])]; })()""",
        figure,
        curve,
    )
    return x, y, decade


def held(opened: Tab) -> dict[str, float]:
    found: dict[str, float] = opened.value("page.state.state.get('material.fixed_shift_factors') ?? {}")
    return found


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_from_the_example_to_its_spectrum(tab: Tab) -> None:
    example(tab)
    assert "24" in tab.text("#step-sweeps .key-numbers")
    assert "measured in tension" in tab.text("#step-sweeps .notes.note")
    assert tab.value("page.state.state.get('material')") == {"dma": "dma.csv", "reference_temperature": "30 degC"}
    tab.screenshot("rubber-data")

    tab.step("shift")
    drawn(tab, "shifted-isotherms", 24)
    assert tab.text("#step-shift .verdict") == "Superposition holds"
    assert tab.page.locator("#step-shift .notes.warning li").count() == 0
    x, y, decade = point_of(tab, "shifted-isotherms", "60\N{NO-BREAK SPACE}°C")
    tab.page.mouse.move(x, y)
    tab.page.mouse.down()
    tab.page.mouse.move(x + decade, y, steps=5)
    assert "Shifted by 1.00 decades" in tab.text("#dragged-misfit")
    assert held(tab) == {}
    tab.page.mouse.up()
    fit = vf.superpose(vf.read_dma(files("viscofric") / "example" / "dma.csv"), "30 degC")
    # a pixel is a fiftieth of a decade
    assert held(tab) == {"60 degC": pytest.approx(fit.shift_factors.log10("60 degC") + 1.0, abs=0.03)}
    tab.until("page.jobs.result('rubber')?.shift.origin === 'held'", 60.0)
    tab.until("document.querySelector('#dragged-misfit').textContent.startsWith('Fixed manually')")
    tab.screenshot("rubber-shift")
    tab.page.get_by_role("button", name="Undo all corrections").click()
    tab.until("page.jobs.result('rubber')?.shift.origin === 'found'")

    tab.step("spectrum")
    rubber_is_made(tab)
    drawn(tab, "modulus", 8)
    tab.page.fill("#modulus-temperature", "333.15")
    tab.until("document.querySelector('#figure-modulus .figure-title').textContent.includes('60\N{NO-BREAK SPACE}°C')")
    assert "sweep measured at 60\N{NO-BREAK SPACE}°C" in tab.text("#figure-modulus figcaption")
    tab.screenshot("rubber-spectrum")


@pytest.mark.slow  # a browser, and axe on three steps
@pytest.mark.exhaustive
def test_steps_are_for_keyboards_and_screen_readers(tab: Tab) -> None:
    example(tab)
    assert tab.findings() == []
    tab.step("shift")
    drawn(tab, "shifted-isotherms", 24)
    rubber_is_made(tab)
    assert tab.findings() == []
    tab.page.select_option("#dragged-isotherm", label="100\N{NO-BREAK SPACE}°C")
    before = float(tab.page.input_value("#dragged-to"))
    tab.page.focus("#dragged-by")
    for _ in range(5):
        tab.page.keyboard.press("ArrowRight")
    tab.until("page.state.state.get('material.fixed_shift_factors') !== undefined")
    assert held(tab) == {"100 degC": pytest.approx(before + 0.1, abs=0.002)}
    tab.until("page.jobs.result('rubber')?.shift.origin === 'held'", 60.0)
    tab.page.fill("#dragged-to", "-2.5")
    tab.page.keyboard.press("Tab")
    tab.until("page.state.state.get('material.fixed_shift_factors')?.['100 degC'] === -2.5")
    tab.page.keyboard.press("Control+z")
    tab.until("page.state.state.get('material.fixed_shift_factors')?.['100 degC'] !== -2.5")
    # what is held is about the reference
    tab.page.locator("#step-shift").get_by_label("Reference temperature").fill("50 °C")
    tab.page.keyboard.press("Tab")
    tab.until("page.state.state.get('material.fixed_shift_factors') === undefined")
    tab.until("page.jobs.result('rubber')?.shift.reference === 323.15")
    tab.step("spectrum")
    rubber_is_made(tab)
    drawn(tab, "modulus", 8)
    assert tab.findings() == []


@pytest.mark.slow  # a browser
def test_what_a_file_leaves_open_is_asked(tab: Tab, tmp_path: Path) -> None:
    rows = [f"{T},{f},{2e6 * f**0.2 * 10 ** (-0.01 * T)},{3e5}" for T in (20, 30, 40) for f in (0.1, 0.3, 1, 3, 10)]
    bare = tmp_path / "bare.csv"
    bare.write_text("\n".join(["T (degC),f (Hz),storage modulus,loss modulus", *rows, ""]))
    tab.step("sweeps")
    tab.page.check("input[name=material-source][value=dma]")
    tab.page.set_input_files(_DROP, bare)
    unit = tab.page.get_by_label("Unit of the moduli")
    unit.wait_for()
    assert tab.page.get_by_label("Column of the frequency").count() == 0
    tab.until("document.querySelector('#step-sweeps').textContent.includes('or give it by “Unit of the moduli”')")
    unit.fill("Pa")
    unit.press("Tab")
    drawn(tab, "isotherms-storage-modulus", 3)
    kind = tab.page.locator("#step-sweeps").get_by_label("Measured in")
    kind.wait_for()
    kind.select_option(label="shear: G′, G″")
    tab.until("document.querySelector('#step-sweeps .key-numbers').textContent.includes('shear')")
    assert tab.value("page.state.state.get('material')") == {
        "dma": "bare.csv",
        "reference_temperature": "30 degC",
        "modulus_unit": "Pa",
        "deformation": "shear",
    }
    assert tab.value("page.state.state.get('data_origin') ?? null") is None


@pytest.mark.apart
def test_columns_that_are_not_understood_are_asked(tab: Tab, tmp_path: Path) -> None:
    rows = [f"{T},{f},{2e6 * f**0.2 * 10 ** (-0.01 * T)},{3e5}" for T in (20, 30, 40) for f in (0.1, 0.3, 1, 3, 10)]
    strange = tmp_path / "strange.csv"
    strange.write_text("\n".join(["T (degC),v1,E' (Pa),Beta", *rows, ""]))
    tab.step("sweeps")
    tab.page.check("input[name=material-source][value=dma]")
    tab.page.set_input_files(_DROP, strange)
    step = tab.page.locator("#step-sweeps")
    step.get_by_label("Column of the frequency").select_option(label="v1")
    step.get_by_label("Unit of the frequency").fill("Hz")
    step.get_by_label("Column of the loss modulus").select_option(label="Beta")
    step.get_by_label("Unit of the loss modulus").fill("Pa")
    tab.screenshot("rubber-columns")
    assert tab.findings() == []
    step.get_by_role("button", name="Read with these columns").click()
    drawn(tab, "isotherms-storage-modulus", 3)
    assert tab.value("page.state.state.get('material')") == {
        "dma": "strange.csv",
        "reference_temperature": "30 degC",
        "columns": {"frequency": "v1 (Hz)", "loss_modulus": "Beta (Pa)"},
    }
    assert "frequency: v1 (Hz)" in tab.text("#step-sweeps")
    step.get_by_role("button", name="Clear the column names").click()
    step.get_by_label("Column of the frequency").wait_for()


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_files_are_dropped_anywhere_and_removed(tab: Tab) -> None:
    rows = [f"{T},{f},{2e6 * f**0.2 * 10 ** (-0.01 * T)},{3e5}" for T in (20, 30, 40) for f in (0.1, 0.3, 1, 3, 10)]
    text = "\n".join(["T (degC),f (Hz),E' (Pa),E'' (Pa)", *rows, ""])
    tab.step("shift")
    drop = """(() => { const dataTransfer = new DataTransfer(); dataTransfer.items.add(new File([given[0]], given[1]));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true })); })()"""
    tab.value(drop, text, "Gummi (1).csv")
    drawn(tab, "isotherms-storage-modulus", 3)
    assert tab.value("page.state.state.step") == "sweeps"
    assert tab.value("page.state.state.get('material.dma')") == "Gummi (1).csv"
    tab.page.get_by_role("button", name="Remove Gummi (1).csv").click()
    tab.until("page.state.state.get('material.dma') === undefined")
    tab.until("!document.querySelector('#step-sweeps .figure[data-inputs]')")
    assert "Drop DMA sweeps above" in tab.text("#figure-isotherms-storage-modulus .plot-empty")


@pytest.mark.slow  # a browser
@pytest.mark.apart
def test_number_of_modes_is_slid_with_the_misfit_beside_it(tab: Tab) -> None:
    example(tab)
    tab.value(
        "page.state.state.change({ 'uncertainty.draws': 0, 'material.spectrum': 'sparse', 'material.modes': 20 })"
    )
    tab.step("spectrum")
    fit = "page.jobs.result('rubber')?.spectrum.fit"
    tab.until(f"{fit}?.method === 'sparse'", 60.0)
    few = tab.value(fit)
    slider = tab.page.locator("#step-spectrum").get_by_label("Largest number of modes: slider")
    slider.evaluate("(one) => { one.value = 100; one.dispatchEvent(new Event('input', { bubbles: true })); }")
    slider.dispatch_event("change")
    modes = tab.value("page.state.state.get('material.modes')")
    assert 1 < modes < 20
    tab.until(f"{fit} && {fit}.rms_storage !== given[0]".replace("given[0]", repr(few["rms_storage"])), 60.0)
    fewer = tab.value(fit)
    assert fewer["rms_storage"] > few["rms_storage"]  # fewer modes fit less well
    assert f"{fewer['rms_storage']:.3f}, {fewer['rms_loss']:.3f}" in tab.text(
        "#step-spectrum .form, #step-spectrum .panel"
    )
