"""Every input of the page with another value for it, and what its figures show at any time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from web.contact_studies import ROUGH

if TYPE_CHECKING:
    from web.browser_tab import Tab

STATE = "page.state.state"
#: A study of sweeps with a measurement, so that every step has figures; small enough to be there at once.
STUDY: dict[str, Any] = {
    "title": "A ball on a synthetic rubber",
    "data_origin": "synthetic",
    "material": {"dma": "dma.csv", "reference_temperature": "30 degC", "deformation": "tension"},
    "indenter": {"shape": "ball", "radius": "9.525 mm"},
    "conditions": {"load": "25 N", "speed": ["10 mm/s", "100 mm/s"], "temperature": ["30 degC", "60 degC"]},
    "solver": {"accuracy": 0.1, "cases": "each", "master_curve_points": 2},
    "uncertainty": {"draws": 0},
    "outputs": {"fields": "none"},
    "measurement": {"mtm": "mtm.csv"},
}
#: Another value of each field of the page.
INPUTS: dict[str, Any] = {
    "title": "another title",
    "material.name": "mine",
    "material.reference_temperature": "60 degC",
    "material.poisson_ratio": 0.49,
    "material.deformation": "compression",
    "material.leave_out_temperatures": ["60 degC"],
    "material.shift": "wlf",
    "material.vertical_shift": "free",
    "material.spectrum": "regularised",
    "material.tau_ratio": 5,
    "material.shift_by": "storage",
    "material.fixed_shift_factors": {"60 degC": 0.02},
    "uncertainty.draws": 20,
    "solver.master_curve_points": 3,
    "conditions.thickness": "8 mm",
    "indenter.radius": "5 mm",
    "indenter.modulus": "1 GPa",
    "conditions.load": "10 N",
    "conditions.speed": ["10 mm/s", "200 mm/s"],
    "conditions.temperature": ["30 degC", "90 degC"],
    "solver.accuracy": 0.05,
    "outputs.fields": "few",
    "interface": {"law": "constant", "stress": "0.1 MPa"},
    "heating.counterface": "steel",
    "measurement.zero": "0.05 N",
    "measurement.zero_error": "0.01 N",
    "measurement.coulomb": 0.05,
    "measurement.coulomb_error": 0.01,
    "measurement.except_steps": [1],
    "measurement.outliers": "leave out",
    "measurement.speed_tolerance": 0.1,
    "measurement.temperature_tolerance": "2 delta_degC",
}
#: Fields, and keys without one, of other files, shapes or histories than those of STUDY, or of a run of the whole study
#: alone: with it, they are wrong or mean nothing to the page.
OTHERS: dict[str, Any] = {
    "material.modulus_unit": "MPa",
    "material.temperature": "30 degC",
    "material.assumed_shift": "universal",
    "material.sheet": "1",
    "material.modes": 5,
    "material.strain": 0.01,
    "material.measured_at": 0.001,
    "indenter.radius_x": "5 mm",
    "indenter.radius_y": "5 mm",
    "indenter.angle": "10 deg",
    "surface.modulus": "1 GPa",
    "surface.poisson_ratio": 0.4,
    "indenter.poisson_ratio": 0.4,
    "layer.thickness": "4 mm",
    "layer.base": "sliding",
    "conditions.pressure": "0.3 MPa",
    "conditions.direction": "30 deg",
    **{f"surface.{key}": value for key, value in ROUGH["surface"].items()},
    "surface.hurst": 0.7,
    "surface.file": "heights.txt",
    "surface.unit": "um",
    "measurement.sheet": "1",
    "interface.law": "best",
    "interface.stress": "0.2 MPa",
    "interface.peak": "0.2 MPa",
    "interface.exponent": 0.2,
    "interface.width": 3,
    "interface.activation_volume": "30 nm**3",
    "interface.speed": "2 mm/s",
    "interface.slip": "3 mm/s",
    "heating.rubber": "unfilled rubber",
    "heating.coulomb": 0.1,
    "heating.nominal_radius": "10 mm",
    "heating.slip": "1 mm/s",
    "heating.average": "loss",
    "heating.branch": "hot",
    "heating.track_radius": "20 mm",
    "heating.passes": 10,
    "heating": {"counterface": "PTFE"},
    "layer": {"thickness": "3 mm"},
    "indenter.shape": "cone",
    "surface.prepare": ["fill"],
    "history.load_time": "1 s",
    "history.dwell": "1 s",
    "history.slide": "1 mm",
    "history.strokes": 2,
    "history.file": "history.csv",
    "history.points": 50,
    "history.before": "at rest",
    "history.columns": {"load": "F"},
    "history.cycle": True,
    "history.sheet": "1",
    "impact.mass": "4 g",
    "impact.speed": "1 m/s",
    "impact.gravity": "9.81 m/s^2",
    "interface.activation_energy": "50 kJ/mol",
    "interface.reference": "40 degC",
    "interface.area_error": 0.1,
    "interface.level_error": 0.1,
    "material.amplitude_sweep": "payne.csv",
    "material.catalogue": "synthetic fluoroelastomer",
    "material.columns": {"temperature": "T"},
    "material.creep": "creep.csv",
    "material.dma": ["dma.csv", "more.csv"],
    "material.file": "rubber.json",
    "material.master_curve": "master.csv",
    "material.ramps": "ramp.csv",
    "material.relaxation": "relaxation.csv",
    "material.shift_factors": "factors.csv",
    "material.shift_factor_columns": {"temperature": "T"},
    "material.shift_factor_sheet": "1",
    "material.shift_weights": [1.0, 0.2],
    "measurement.columns": {"load": "F"},
    "measurement.curves": "curves.csv",
    "measurement.mtm": ["mtm.csv", "more.csv"],
    "surface.angle": "30 deg",
    "surface.aspect": 2.0,
    "surface.channel": "height",
    "surface.exact": False,
    "surface.lines": "y",
    "surface.longest": "1 mm",
    "surface.missing": -9999.0,
    "surface.period": "1 mm",
    "surface.rms_height": "1 um",
    "solver.cases": "curves",
    "sweep.together": [["conditions.speed", "conditions.temperature"]],
    "uncertainty.members": 8,
    "uncertainty.seed": 2,
    "outputs.formats": ["csv"],
    "data_origin": "measured",
    "author": "the laboratory",
    "sample": "batch 7",
    "comment": "aged for a week",
    "citation": "a paper",
    "licence": "CC BY 4.0",
    **{f"cluster.{key}": "x" for key in ("account", "extra", "jobs", "memory", "prologue", "queue", "walltime")},
    "cluster.cores": 2,
}
STEPS = ("sweeps", "shift", "spectrum", "contact", "motion", "measurement")
#: Of each figure, number, table and note on the page, seen or not: its name, its key, and whether it is grey.
SHOWN = """[...document.querySelectorAll('[data-inputs]')].map((one) =>
  [one.id || one.className, one.dataset.inputs, one.closest('.stale') !== null])"""
#: Of each figure that is seen: whether it is grey, the inputs that it is of, and what is drawn.
SEEN = """Object.fromEntries([...document.querySelectorAll('.step:not([hidden]) .figure')]
  .filter((one) => one.offsetParent)
  .map((one) => [one.id, {
    stale: Boolean(one.closest('.stale')),
    inputs: one.dataset.inputs,
    words: one.querySelector('figcaption').textContent,
    drawn: (one.querySelector('.plot').data ?? []).map((trace) =>
      [trace.name, ...['x', 'y', 'z'].map((axis) => JSON.stringify(Array.from(trace[axis] ?? [])))])}]))"""
#: The page computes and draws nothing more; a figure learns in the next frame that it is seen.
AT_REST = """await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  [...document.querySelectorAll('.progress')].every((one) => one.hidden || one.classList.contains('done'))
  && !page.jobs.busy() && page.figures.areDrawn()"""


#: Figures that follow a slider: while the next one is on its way, the one before is not grey.
FOLLOWING = ("pressure-map", "pressure-profile", "surface-profile", "modulus", "loss-tangent")


def wrong_figures(tab: Tab) -> list[Any]:
    """Return what is of other inputs than those of now and not grey, and what is grey for nothing."""
    return tab.value(
        f"""(({{ keys, following }}) => {SHOWN}.filter(([, key, grey]) => grey === keys.includes(key)
          && !(page.jobs.busy() && !grey && following.includes(key))))({{
            keys: Object.values(page.jobs.keys()),
            following: given[0].map((one) => document.getElementById(`figure-${{one}}`)?.dataset.inputs) }})""",
        FOLLOWING,
    )


def at_rest(tab: Tab, seconds: float = 60.0) -> dict[str, Any]:
    """Wait until the page computes and draws nothing more; return the figures that are seen."""
    before: dict[str, Any] = {}
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        tab.page.wait_for_timeout(20)
        rests = tab.value(AT_REST)  # asked first: what is seen comes after
        now = tab.value(SEEN)
        if rests and now == before:
            return now
        before = now
    raise AssertionError(f"the page did not come to rest: {before}")


def example(tab: Tab, study: dict[str, Any]) -> None:
    """Have a study with the example's files on the page."""
    tab.value("await (await import('/static/js/api.js')).useExample()")
    tab.value(f"{STATE}.replace(given[0])", study)
