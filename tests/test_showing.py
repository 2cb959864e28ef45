"""Every public object shows itself in a few lines and as a table of a notebook, and every result draws itself."""

import functools
import inspect
import pickle
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace

import numpy as np
import pytest

import viscofric as vf
from test_docstrings import PUBLIC
from viscofric.showing import Items, Plotted, Shown, shown_as_html, shown_as_text, shown_value

#: Longer than 600 characters would be more than a glance.
LONGEST = 600
MOST_LINES = 12
CLASSES = {
    name: found
    for name, found in PUBLIC.items()
    if inspect.isclass(found) and not issubclass(found, Exception) and not inspect.isabstract(found)
}
#: Results that are single numbers, or parts of others: there is nothing to draw.
NOTHING_TO_DRAW = {
    "AssumptionCheck", "ContactHeating", "ContactStatistics", "Diagnostics", "GlassTransition", "ImpactContact",
    "LinearRange", "OverlapQuality", "PeriodicDiagnostics", "RampCheck", "ResultsComparison",
    "SpectrumFit", "StepCheck", "StepTest", "TractionStep", "TransientErrors", "TransientHeating",
}  # fmt: skip
INPUTS = {
    "Backend", "CatalogueEntry", "Card", "Citations", "ContactAnchor", "Heating", "History", "Layer", "ModulusAnchor",
    "MovingHeatSource", "PeriodicSurface", "Study", "ThermalProperties",
}  # fmt: skip
INDENTERS = {"Ball", "Cone", "Cylinder", "Ellipsoid", "FlatPunch", "HeightMap", "Profile"}
#: Laws of shear stress are drawn over the stress that they were fitted to, by `plot_shear_stress`.
LAWS = {"ConstantShearStress", "EyringShearStress", "GaussianShearStress", "PowerShearStress"}


@functools.cache
def one_of_each(folder):
    """Return an object of every public class, by its name; all numbers are SYNTHETIC."""
    rubber = vf.synthetic_fluoroelastomer()
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    steel = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel")
    thermal = vf.ThermalProperties("0.3 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber")
    heating = vf.Heating(rubber=thermal, counterface=steel, coulomb=0.3)
    ball, cylinder = vf.Ball("10 mm"), vf.Cylinder("10 mm")
    found = {type(one).__name__: one for one in (rubber, heating, steel, ball, cylinder)}

    def add(*objects):
        found.update({type(one).__name__: one for one in objects})

    # --- rheology
    kelvins, hertz = np.arange(263.15, 334.0, 10.0), np.geomspace(0.1, 100.0, 13)
    omega = 2.0 * np.pi * hertz
    noise = np.random.default_rng(1).normal(0.0, 0.01, (len(kelvins), 2, 13))

    def isotherm(kelvin, scatter):
        modulus = rubber.complex_modulus(omega, kelvin)
        return vf.Isotherm(kelvin, omega, modulus.real * np.exp(scatter[0]), modulus.imag * np.exp(scatter[1]))

    sweeps = vf.IsothermalSweeps(tuple(map(isotherm, kelvins, noise)), source="synthetic.csv")
    fit = vf.superpose(sweeps, "30 degC", vertical="free")
    spectrum = vf.fit_retardation_spectrum(fit)
    add(sweeps, sweeps.isotherms[0], fit, fit.master_curve, fit.quality, fit.check, fit.shift_factors)
    add(spectrum, spectrum.fit, spectrum.to_relaxation(), vf.rheology.ModulusTable.from_master_curve(fit.master_curve))
    add(fit.vertical_shift, vf.rheology.DensityShift(303.15), fit.shift_factors.compare_laws())
    add(
        vf.sample_materials(fit, spectrum, samples=20), fit.shift_factors.law("wlf"), fit.shift_factors.law("arrhenius")
    )
    add(fit.shift_factors.law("wlf").to_vft(), fit.shift_factors.law("polynomial"))
    add(vf.WLFArrhenius(12.0, 50.0, "-10 degC", "30 degC"))
    warm = np.arange(253.0, 323.0, 2.0)
    ramps = [
        vf.readers.TemperatureRamp(
            one, warm, (m := rubber.spectrum.complex_modulus(one * rubber.shift(warm))).real, m.imag
        )
        for one in omega[[0, 6, 12]]
    ]
    ramped = vf.superpose_ramps(vf.readers.TemperatureRamps(tuple(ramps)), "30 degC")
    add(ramps[0], vf.rheology.glass_transition(ramps[1], "loss modulus"), ramped, ramped.ramps, ramped.check)
    times = np.geomspace(0.1, 1e3, 20)
    tests = tuple(
        vf.readers.StepTest(kelvin, times, rubber.spectrum.creep_compliance(times / rubber.shift(kelvin)))
        for kelvin in kelvins
    )
    steps = vf.readers.StepTests(tests, "creep")
    crept = vf.superpose(steps, "30 degC")
    add(steps, tests[0], crept, crept.master_curve, crept.check, vf.superpose([sweeps, steps], "30 degC"))
    strain = np.geomspace(1e-3, 0.5, 20)
    law = vf.rheology.KrausLaw(6e6, 1.5e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "shear")
    payne = law.complex_modulus(strain)
    swept = vf.readers.AmplitudeSweep(strain, payne.real, payne.imag, 62.8, 333.15, "shear")
    fitted = vf.rheology.fit_kraus(swept)
    add(law, swept, fitted, fitted.linear_ranges[0])
    add(vf.catalogue()[0], vf.rheology.Card(rubber, "native"), vf.citations(fit))
    # --- contact
    contact = {"speed": "1 m/s", "accuracy": 0.1}
    add(vf.solve_steady(solid, ball, load="1 N", derivatives=True, **contact).derivatives)
    solution = vf.solve_steady(rubber, ball, load="1 N", temperature="60 degC", heating=heating, **contact)
    add(solution, solution.diagnostics, solution.heating)
    add(vf.friction.solve_at_contact_strain(solid, law, cylinder, load="100 N/m", measured_at=1e-3, **contact))
    bumps = 1e-6 * np.cos(2.0 * np.pi * np.arange(32) / 32.0)
    add(
        vf.HeightMap(bumps[:, None] + bumps, "10 um"),
        vf.Profile(bumps, "10 um"),
        vf.Layer("2 mm"),
        vf.contact.Backend(),
    )
    add(vf.Cone("10 deg"), vf.Ellipsoid("10 mm", "30 mm"), vf.FlatPunch("1 mm"))
    add(vf.heat.MovingHeatSource("10 W", size="0.5 mm", speed="1 m/s", body=steel))
    # --- motion
    press = vf.motion.History(time=[0.0, 0.01], load="1 N")
    run = vf.motion.solve_transient(solid, ball, press, accuracy=1e-2)
    impact = vf.motion.solve_impact(solid, ball, mass="33 g", speed="1 m/s", accuracy=1e-2)
    add(press, run, run.errors, impact, impact.contacts[0])
    add(vf.motion.restitution_curve(solid, ball, mass="33 g", speeds=["0.5 m/s", "1 m/s"], accuracy=1e-2))
    phase = np.linspace(0.0, 2.0 * np.pi, 25)
    swing = vf.motion.History(time=phase / 100.0, indentation=1e-4 + 3e-6 * np.sin(phase))
    add(vf.motion.solve_cycle(solid, ball, swing, accuracy=1e-2))
    rises = {name: np.linspace(0.0, 1.0, 5) for name in inspect.signature(vf.heat.TransientHeating).parameters}
    add(vf.heat.TransientHeating(**rises))
    # --- roughness
    road = vf.self_affine(0.8, shape=(32, 32), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    track = vf.self_affine(0.8, shape=(64, 1), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    rough = vf.solve_periodic(solid, road.to_surface(), speed="0.1 m/s", pressure="5 kPa")
    add(
        road,
        road.to_surface(),
        rough,
        rough.diagnostics,
        vf.roughness.contact_statistics(rough),
        vf.roughness.friction_by_wavelength(rough),
    )
    add(vf.roughness.power_spectrum(road), vf.roughness.line_spectrum(track))
    sliding = {"speeds": ["0.1 m/s", "1 m/s"], "pressure": "5 kPa"}
    for extra in ({}, {"heating": heating, "temperatures": "30 degC"}):
        add(vf.predict_rough_friction(rubber if extra else solid, [road], **sliding, **extra))
        add(vf.persson_theory(rubber if extra else solid, vf.roughness.power_spectrum(road), **sliding, **extra))
    # --- friction
    case = {"speeds": [0.02, 0.06, 0.2], "temperatures": [313.15, 333.15, 353.15], "load": 2500.0, "accuracy": 1e-2}
    predicted = vf.predict_friction(rubber, cylinder, **case)
    add(predicted, vf.compare(predicted, predicted), vf.check_assumptions(rubber, cylinder, predicted)[0])
    add(vf.predict_friction(rubber, cylinder, **case | {"temperatures": 333.15}, heating=heating))
    master = vf.shift_friction(predicted, shift=rubber.shift, reference="60 degC")
    add(master, vf.friction.compare_shift_factors(fit.shift_factors, rubber.shift))
    signs = [(d, b) for v in (0.1, 0.2, 0.4) for d in (-v, v) for b in (0.5 * d, 1.5 * d)]
    disc, rolling = np.array(signs * 3).T
    celsius = np.repeat([30.0, 50.0, 70.0], len(signs))
    force = 0.3 + 25.0 * (0.05 * np.sign(disc - rolling) + 0.02 * np.sign(disc))
    runs = vf.readers.TractionRuns(
        disc, rolling, force, np.full(36, 25.0), celsius + 273.15, np.ones(36), source="synthetic.csv",
        step=np.arange(36) // 12, steps=(vf.readers.TractionStep(0, kind="traction"),),
    )  # fmt: skip
    measured = vf.separate(runs)
    add(runs, runs.steps[0])
    slow = {"speeds": measured.speeds, "temperatures": measured.temperatures, "load": 25.0, "accuracy": 0.1}
    add(vf.friction.shear_stress(measured, vf.predict_friction(rubber, ball, **slow)))
    add(vf.friction.ConstantShearStress("1 MPa"), vf.friction.EyringShearStress("1e-26 m**3", "1 mm/s"))
    add(vf.friction.GaussianShearStress("1 MPa", "1 m/s", 2.0), vf.friction.PowerShearStress("1 MPa", 0.1, "1 m/s"))
    add(
        vf.friction.ModulusAnchor("5 MPa", "1 Hz", "30 degC"),
        vf.friction.ContactAnchor("0.1 m/s", "30 degC", "25 N", half_width="3 mm"),
    )
    time = np.geomspace(1e-2, 1e2, 30)
    depth = (0.75 * 1.0 / np.sqrt(0.01) * 0.75 * rubber.spectrum.creep_compliance(time)) ** (2.0 / 3.0)
    record = vf.friction.IndentationRecord(time, np.full(30, 1.0), depth, "30 degC", control="load", start=0.0)
    pressed = vf.identify_from_indentation(record, ball, modes=8, samples=20)
    add(record, pressed, pressed.records[0])
    names = inspect.signature(vf.friction.Identified).parameters
    shared = {name: getattr(pressed, name) for name in names}
    own = {"level_range": (1.0, 1.0), "family": (), "residuals": np.zeros(9), "iterations": 3}
    add(vf.friction.Identified(**shared), vf.friction.IdentifiedMaterial(**shared, **own, friction=predicted))
    add(vf.friction.ReboundRecord(["1 m/s", "2 m/s"], "23 degC", mass="33 g", restitution=[0.62, 0.58], error=0.01))
    add(
        vf.friction.OscillationRecord(
            ["1 Hz", "10 Hz"], [1e4, 2e4], [1e3, 3e3], "23 degC", indentation="0.1 mm", amplitude="1 um", error=0.01
        )
    )
    # --- study
    study = (
        'title = "SYNTHETIC"\n[material]\ncatalogue = "synthetic fluoroelastomer"\n'
        '[indenter]\nshape = "cylinder"\nradius = "10 mm"\n[solver]\naccuracy = 0.1\n'
        '[conditions]\nload = "500 N/m"\nspeed = ["0.1 m/s", "1 m/s"]\ntemperature = ["60 degC", "90 degC"]\n'
    )
    (folder / "ball.toml").write_text(study)
    add(vf.load_study(folder / "ball.toml"), results := vf.run_study(folder / "ball.toml"))
    add(vf.compare_results(results, results))
    return found


@pytest.fixture(scope="module")
def objects(tmp_path_factory):
    return one_of_each(tmp_path_factory.mktemp("showing"))


def test_every_public_class_shows_itself_and_every_result_draws_itself(objects):
    assert objects.keys() >= CLASSES.keys(), f"add one to one_of_each: {CLASSES.keys() - objects.keys()}"
    silent = {name for name, found in CLASSES.items() if not hasattr(found, "_repr_html_")}
    assert silent == set()
    without_plot = {name for name, found in CLASSES.items() if not issubclass(found, Plotted)}
    assert without_plot == NOTHING_TO_DRAW | INPUTS | INDENTERS | LAWS


@pytest.mark.parametrize("name", sorted(CLASSES))
def test_an_object_is_shown_in_a_few_lines_and_in_a_table_with_the_same_numbers(objects, name):
    shown, table = repr(objects[name]), ET.fromstring(objects[name]._repr_html_())
    assert shown.startswith(name)
    assert len(shown) <= LONGEST
    assert shown.count("\n") < MOST_LINES
    assert not re.search(r"array\(|\bnan\b|\binf\b", shown, re.IGNORECASE)
    assert (table.tag, table.findtext("caption")) == ("table", name)
    rows = [(row.findtext("th"), row.findtext("td")) for row in table.iter("tr")]
    assert rows
    for label, text in rows:
        assert label in shown
        assert text in shown


@pytest.mark.parametrize("name", sorted(name for name, found in CLASSES.items() if issubclass(found, Plotted)))
def test_a_result_draws_itself(objects, name):
    from matplotlib import pyplot
    from matplotlib.axes import Axes

    try:
        axes = objects[name].plot()
        assert isinstance(axes, Axes)
        assert axes.has_data()
        assert axes.get_xlabel()
        axes.figure.canvas.draw()
        _, given = pyplot.subplots()
        assert objects[name].plot(given) is given
    finally:
        pyplot.close("all")


@pytest.mark.parametrize("name", sorted(CLASSES.keys() - {"CatalogueEntry", "Study", "StudyResults"}))
def test_an_object_is_the_same_after_pickling(objects, name):
    again = pickle.loads(pickle.dumps(objects[name]))
    assert repr(again) == repr(objects[name])
    assert again == objects[name]
    if type(again).__hash__ is Shown.__hash__:
        assert hash(again) == hash(objects[name])


def test_objects_with_other_numbers_are_others(objects):
    spectrum, curves = objects["RetardationSpectrum"], objects["FrictionCurves"]
    assert vf.Material(spectrum) == vf.Material(replace(spectrum)) != vf.Material(spectrum.shifted(2.0))
    assert vf.Material(spectrum) != spectrum
    assert curves[1:] != curves[:-1]
    assert len({curves, curves[:], curves[1:]}) == 2
    runs = objects["TractionRuns"]
    unknown = replace(runs, zero_force=np.full(len(runs), np.nan))
    assert unknown == replace(runs, zero_force=np.full(len(runs), np.nan)) != runs


@pytest.mark.parametrize("name", sorted(name for name, found in CLASSES.items() if issubclass(found, Items)))
def test_a_collection_has_items_a_length_and_indices(objects, name):
    found = objects[name]
    items = list(found)
    assert len(items) == len(found) > 1
    assert (found[0], found[-1], found[:2]) == (items[0], items[-1], type(found[:2])(items[:2]))
    with pytest.raises(IndexError):
        found[len(items)]


def test_items_of_tables_are_their_rows(objects):
    factors, spectrum = objects["ShiftFactors"], objects["RetardationSpectrum"]
    assert dict(factors) == dict(zip(factors.temperatures, factors.log10_values, strict=True))
    assert spectrum[2] == (spectrum.C[2], spectrum.tau[2])
    assert [one.temperature for one in objects["IsothermalSweeps"]] == objects["IsothermalSweeps"].temperatures.tolist()


@pytest.mark.parametrize("name", sorted(name for name, found in CLASSES.items() if issubclass(found, Plotted)))
def test_a_result_becomes_a_table(objects, name):
    arguments = (
        [[303.15, 313.15]] if isinstance(objects[name], (vf.rheology.ShiftLaw, vf.rheology.VerticalShift)) else []
    )
    arguments = [np.geomspace(1.0, 100.0, 5)] if isinstance(objects[name], vf.rheology.MaterialSamples) else arguments
    assert objects[name].to_dataframe(*arguments).size > 0


def test_numbers_are_shown_with_their_units_and_errors():
    shown = [
        shown_value(0.02, "m/s"),
        shown_value(303.15, "°C"),
        shown_value(0.123456, "", 0.0012),
        shown_value(2e-6, "m²"),
        shown_value(0.25, "%"),
        shown_value(float("nan"), "Pa"),
        shown_value(np.array([[1e6, np.nan], [2e6, 3e6]]), "Pa"),
        shown_value(np.full(3, 25.0), "N"),
        shown_value((1.0, 1e3), "Hz"),
        shown_value(()),
        shown_value("a" * 100),
        shown_value("3.14, " * 20),
    ]
    assert shown == [
        "20 mm/s",
        "30 °C",
        "0.1235 ± 0.0012",
        "2 mm²",
        "25 %",
        "unknown",
        "2 × 2 from 1 to 3 MPa, 1 unknown",
        "3 of 25 N",
        "1 Hz to 1 kHz",
        "none",
        "a" * 79 + "…",
        "3.14, " * 12 + "3.14 …",
    ]


def test_a_name_with_marks_of_html_stays_text():
    rows = [("name", "<b> & Co")]
    assert ET.fromstring(shown_as_html("Material", rows)).findtext("tbody/tr/td") == "<b> & Co"
    assert shown_as_text("Material", rows) == "Material(name: <b> & Co)"


def test_a_class_of_a_user_shows_its_fields():
    @dataclass(frozen=True)
    class Wiper(Shown):
        radius_of_tip: float

    assert repr(Wiper(0.5)) == "Wiper(radius of tip: 0.5)"
