"""Every public object shows itself in a few lines and as a table of a notebook, and every result draws itself."""

import copy
import functools
import inspect
import pickle
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, fields, is_dataclass, replace

import numpy as np
import pytest

import viscofric as vf
from test_arguments import CALLS, SLOW, N, call, curves, good_call, road, runs, shifted, sweeps
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
    """Return an object of every public class, by its name: of good calls, parts of those, and more; all SYNTHETIC."""
    found = {}

    def add(*objects):
        found.update({type(one).__name__: one for one in objects})

    for name in CALLS:
        # Of methods nothing is needed; the good call of identify_material goes no further than its arguments; the
        # assumptions are checked below.
        if "." not in name and name not in SLOW | {"identify_material", "check_assumptions"}:
            add(call(*good_call(name)))
    rubber = vf.synthetic_fluoroelastomer()
    solid = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    ball, cylinder = vf.Ball("10 mm"), vf.Cylinder("10 mm")
    heating = vf.Heating(rubber=found["ThermalProperties"], counterface=found["ThermalProperties"], coulomb=0.3)
    # --- rheology
    fit, ramped, crept = found["Superposition"], found["RampSuperposition"], creep_tests(rubber)
    add(rubber, rubber.spectrum, rubber.spectrum.to_relaxation(), vf.catalogue()[0])
    add(fit.quality, vf.fit_retardation_spectrum(fit).fit, found["PayneFit"].linear_ranges[0], ramped.check)
    kelvin = np.arange(223.15, 374.0, 10.0)
    law = vf.WLFArrhenius(12.0, 50.0, "-10 degC", "30 degC")
    add(vf.ShiftFactors(kelvin, law.log10(kelvin), 303.15).compare_laws())
    steps = vf.superpose(crept, "30 degC")
    add(crept, steps, steps.check, vf.superpose([sweeps(), creep_tests(shifted())], 300.0))
    # --- contact
    contact = {"speed": "1 m/s", "accuracy": 0.1}
    add(vf.solve_steady(solid, ball, load="1 N", derivatives=True, **contact).derivatives)
    solution = vf.solve_steady(rubber, ball, load="1 N", temperature="60 degC", heating=heating, **contact)
    add(solution, solution.diagnostics, solution.heating)
    # --- motion
    add(found["TransientSolution"].errors, found["ImpactSolution"].contacts[0])
    rises = {name: np.linspace(0.0, 1.0, 5) for name in inspect.signature(vf.heat.TransientHeating).parameters}
    add(vf.heat.TransientHeating(**rises))
    # --- roughness
    add(found["PeriodicSolution"].diagnostics)
    sliding = {"speeds": ["0.1 m/s", "1 m/s"], "pressure": "5 kPa", "heating": heating, "temperatures": "30 degC"}
    add(vf.predict_rough_friction(rubber, [road()], **sliding))
    add(vf.persson_theory(rubber, vf.roughness.power_spectrum(road()), **sliding))
    # --- friction
    add(curves(), runs().steps[0], vf.check_assumptions(rubber, cylinder, curves())[0])
    case = {"speeds": [0.02, 0.06, 0.2], "temperatures": 333.15, "load": 2500.0, "accuracy": 1e-2}
    add(vf.predict_friction(rubber, cylinder, **case, heating=heating))
    pressed = found["MaterialFromIndentation"]
    names = inspect.signature(vf.friction.Identified).parameters
    shared = {name: getattr(pressed, name) for name in names}
    own = {"level_range": (1.0, 1.0), "family": (), "residuals": np.zeros(N), "iterations": 3}
    own |= {"half_space_thickness": 1e-3}
    add(pressed.records[0], vf.friction.Identified(**shared))
    add(vf.friction.IdentifiedMaterial(**shared, **own, friction=curves()))
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


def creep_tests(rubber):
    """Return creep of a rubber at three temperatures, which overlaps."""
    time = np.geomspace(0.1, 1e3, 20)
    return vf.readers.StepTests(
        tuple(
            vf.readers.StepTest(kelvin, time, rubber.spectrum.creep_compliance(time / rubber.shift(kelvin)))
            for kelvin in (290.0, 300.0, 310.0)
        ),
        "creep",
    )


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
        # measures all texts, as drawing does: alone, or where something beside the axes could leave them no room
        if len(axes.figure.axes) == 1 and axes.get_legend() is None:
            axes.figure.get_tightbbox(axes.figure.canvas.get_renderer())
        else:
            axes.figure.get_layout_engine().execute(axes.figure)
    finally:
        pyplot.close("all")


def test_a_result_is_drawn_on_given_axes(objects):
    from matplotlib.figure import Figure

    given = Figure().subplots()
    assert objects["RetardationSpectrum"].plot(given) is given
    assert given.has_data()


@pytest.mark.parametrize("name", sorted(CLASSES.keys() - {"CatalogueEntry", "Study", "StudyResults"}))
def test_an_object_is_the_same_after_pickling(objects, name):
    again = pickle.loads(pickle.dumps(objects[name]))
    assert repr(again) == repr(objects[name])
    assert again == objects[name]
    if type(again).__hash__ is Shown.__hash__:
        assert hash(again) == hash(objects[name])


@pytest.mark.parametrize("name", sorted(CLASSES.keys() - {"CatalogueEntry", "Study", "StudyResults"}))
def test_numbers_of_an_object_stay_as_they_are(objects, name):
    """Also those of a copy, and of a result that another process computed; a hash depends on them."""
    for one in (objects[name], copy.deepcopy(objects[name]), pickle.loads(pickle.dumps(objects[name]))):
        arrays = {field.name: getattr(one, field.name) for field in fields(one)} if is_dataclass(one) else {}
        assert [at for at, value in arrays.items() if isinstance(value, np.ndarray) and value.flags.writeable] == []


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
