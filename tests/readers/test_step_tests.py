"""Creep and relaxation tests in files: columns, units, temperatures, and what is left out of a test."""

from __future__ import annotations

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.errors import DataFileError
from viscofric.readers.steps.read import start_of

TIME = np.logspace(0.0, 3.0, 13)


def written(path, header, columns, delimiter="\t"):
    rows = [delimiter.join(header)] + [delimiter.join(f"{one:.9g}" for one in row) for row in np.transpose(columns)]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def codes(tests):
    return [getattr(note, "code", "") for note in tests.notes]


@pytest.mark.parametrize("delimiter", ["\t", ";", ","])
def test_a_table_of_several_temperatures_is_read(tmp_path, delimiter):
    columns = [np.repeat([25.0, 60.0], 13), np.tile(TIME, 2) / 60.0, np.tile(0.1 * TIME**0.2, 2)]
    path = written(tmp_path / "creep.csv", ("T (°C)", "time (min)", "J(t) (1/MPa)"), columns, delimiter)
    tests = vf.read_step_tests(path, deformation="shear")
    assert tests.kind == "creep"
    np.testing.assert_allclose(tests.temperatures, [298.15, 333.15])
    np.testing.assert_allclose(tests.tests[0].time, TIME, rtol=1e-6)
    np.testing.assert_allclose(tests.tests[1].response, 1e-7 * TIME**0.2, rtol=1e-6)
    assert tests.notes == ()


@pytest.mark.parametrize(
    ("heading", "response", "given"),
    [
        ("G(t) (MPa)", 10.0 * TIME**-0.2, "tension"),
        ("E(t) (MPa)", 10.0 * TIME**-0.2, "shear"),
        ("D(t) (1/MPa)", 0.1 * TIME**0.2, "shear"),
    ],
)
def test_a_deformation_that_contradicts_the_heading_is_refused(tmp_path, heading, response, given):
    path = written(tmp_path / "foam_25C.txt", ("t (s)", heading), [TIME, response])
    assert vf.read_step_tests(path).deformation != given
    with refused("deformation-contradicts", DataFileError):
        vf.read_step_tests(path, deformation=given)
    other = "bending" if given == "shear" else "shear"
    assert vf.read_step_tests(path, deformation=other).deformation == other


def test_a_creep_strain_lacks_its_stress_which_may_be_one_value(tmp_path):
    path = written(tmp_path / "creep_25C.csv", ("t (s)", "strain (%)"), [TIME, TIME**0.2])
    with refused("missing-columns", DataFileError) as caught:
        vf.read_step_tests(path, kind="creep", deformation="tension")
    assert caught.value.note.values["missing"] == ["stress", "creep compliance"]
    tests = vf.read_step_tests(path, kind="creep", deformation="tension", columns={"stress": "= 0.1 MPa"})
    np.testing.assert_allclose(tests.tests[0].response, 1e-7 * TIME**0.2, rtol=1e-6)  # 1/Pa


def test_a_melt_that_flows_does_not_look_like_a_wrong_unit(tmp_path):
    path = written(tmp_path / "melt.csv", ("T (degC)", "t (s)", "J (1/Pa)"), [0.0 * TIME + 180.0, TIME, 0.01 * TIME])
    assert 1.0 / (0.01 * TIME.max()) < 1.0  # Pa
    assert "implausible-modulus" not in codes(vf.read_step_tests(path, deformation="tension"))


@pytest.mark.parametrize(
    ("header", "scale", "code"),
    [
        ("T (°C),t (s),J (1/MPa)", 1.0, None),
        ("T (K),t (s),J (1/MPa)", 1.0, "implausible-temperature"),  # 25 K
        ("T (°C),t (s),J (1/Pa)", 20.0, "implausible-modulus"),  # half a pascal
        ("T (°C),t (s),E (Pa)", -1.0, "implausible-modulus"),  # a tenth of one
    ],
)
def test_what_looks_like_a_wrong_unit_is_noted(tmp_path, header, scale, code):
    response = [0.1, 0.12, 0.15, 0.19] if scale > 0.0 else [0.19, 0.15, 0.12, 0.1]
    rows = [f"25,{time},{abs(scale) * one}" for time, one in zip((1, 10, 100, 1000), response, strict=True)]
    path = tmp_path / "steps.csv"
    path.write_text("\n".join([header, *rows]), encoding="utf-8")
    found = {one for one in codes(vf.read_step_tests(path, deformation="tension")) if "implausible" in one}
    assert found == ({code} if code else set())


def test_one_file_for_each_temperature(tmp_path):
    """Temperatures from names or arguments; E(t) states tension."""
    for celsius in (20, 40):
        written(tmp_path / f"relax_{celsius}C.txt", ("t (s)", "E(t) (MPa)"), [TIME, 10.0 * TIME**-0.1])
    tests = vf.read_step_tests(sorted(tmp_path.glob("*.txt"), reverse=True)[:1], temperature="40 degC")
    assert tests.temperatures == pytest.approx([313.15])
    written(tmp_path / "relax_60C.txt", ("t (s)", "E(t) (MPa)"), [TIME, 9.0 * TIME**-0.1])
    named = vf.read_step_tests(tmp_path / "relax_20C.txt", tmp_path / "relax_60C.txt")
    assert (named.kind, named.deformation) == ("relaxation", "tension")
    np.testing.assert_allclose(named.temperatures, [293.15, 333.15])
    assert codes(named) == ["temperature-from-name"]


def test_logarithms_of_time_and_response(tmp_path):
    columns = [np.log10(TIME), np.log10(0.1 * TIME**0.2)]
    for headings, noted in ((("log t (s)", "log J (1/MPa)"), True), (("log10(t/s)", "lg(J(t)/MPa⁻¹)"), False)):
        creep = vf.read_step_tests(written(tmp_path / "creep_25C.csv", headings, columns), deformation="shear")
        np.testing.assert_allclose(creep.tests[0].time, TIME, rtol=1e-5)  # printed digits
        np.testing.assert_allclose(creep.tests[0].response, 1e-7 * TIME**0.2, rtol=1e-5)
        assert ("decadic-logarithms" in codes(creep)) == noted


def test_stress_and_strain_give_the_response(tmp_path):
    strain = 0.5 * TIME**0.2
    path = written(
        tmp_path / "a_25C.csv", ("time (s)", "shear stress (kPa)", "strain (%)"), [TIME, 0 * TIME + 2, strain]
    )
    creep = vf.read_step_tests(path)
    assert (creep.kind, creep.deformation) == ("creep", "shear")
    np.testing.assert_allclose(creep.tests[0].response, 0.01 * strain / 2e3, rtol=1e-6)
    assert "response-computed" in codes(creep)
    path = written(tmp_path / "b_25C.csv", ("time (s)", "stress (kPa)", "strain (%)"), [TIME, 2 / strain, 0 * TIME + 1])
    relaxation = vf.read_step_tests(path, deformation="tension")
    assert relaxation.kind == "relaxation"
    np.testing.assert_allclose(relaxation.tests[0].response, 2e3 / strain / 0.01, rtol=1e-6)


def test_a_strain_without_a_unit_is_refused(tmp_path):
    """It may be in per cent: a hundred times the compliance."""
    columns = [TIME, 0.1 * TIME**0.2, np.full(13, 10.0)]
    for heading, fraction in (("strain (%)", 0.01), ("strain (-)", 1.0)):
        path = written(tmp_path / "creep_25C.txt", ("t (s)", heading, "stress (kPa)"), columns)
        creep = vf.read_step_tests(path, deformation="tension").tests[0]
        np.testing.assert_allclose(creep.response, fraction * 1e-5 * TIME**0.2, rtol=1e-6)
    path = written(tmp_path / "creep_25C.txt", ("t (s)", "strain", "stress (kPa)"), columns)
    with refused("wrong-unit", DataFileError, naming="'strain'"):
        vf.read_step_tests(path, deformation="tension")


def test_units_and_temperatures_of_tables_below_each_other(tmp_path):
    """Names such as J(t) hold no unit; the line above each table has its temperature."""
    lines = []
    for celsius in (25, 40):
        lines += [
            f"Test at {celsius} °C",
            "t;Relaxation modulus G(t)",
            "s;MPa",
            *(f"{t:.6g};{1 / t:.6g}" for t in TIME),
        ]
    (tmp_path / "all.csv").write_text("\n".join(lines), encoding="utf-8")
    tests = vf.read_step_tests(tmp_path / "all.csv")
    assert (tests.kind, tests.deformation) == ("relaxation", "shear")
    np.testing.assert_allclose(tests.temperatures, [298.15, 313.15])
    np.testing.assert_allclose(tests.tests[1].response, 1e6 / TIME, rtol=1e-5)
    assert codes(tests) == ["temperature-from-title"]


def test_headings_give_the_temperatures_of_relaxations_beside_each_other(tmp_path):
    headings = ("t (s)", "E(t) 25 °C (MPa)", "E(t) -10 °C (MPa)")
    tests = vf.read_step_tests(written(tmp_path / "all.csv", headings, [TIME, 1 / TIME, 3 / TIME]))
    np.testing.assert_allclose(tests.temperatures, [263.15, 298.15])
    np.testing.assert_allclose(tests.tests[0].response, 3e6 / TIME, rtol=1e-5)
    assert codes(tests) == ["temperature-from-title"]


def test_each_of_the_tests_beside_each_other_may_have_its_own_times(tmp_path):
    headings = ("t (s)", "J 25 °C (1/MPa)", "t (s)", "J 40 °C (1/MPa)")
    path = written(tmp_path / "all.csv", headings, [TIME, TIME**0.2, 2 * TIME, 3 * TIME**0.2])
    tests = vf.read_step_tests(path, deformation="shear")
    np.testing.assert_allclose(tests.temperatures, [298.15, 313.15])
    for one, factor, level in zip(tests.tests, (1, 2), (1e-6, 3e-6), strict=True):
        np.testing.assert_allclose(one.time, factor * TIME, rtol=1e-5)
        np.testing.assert_allclose(one.response, level * TIME**0.2, rtol=1e-5)


def test_digitised_curves_beside_each_other_share_the_headings_that_the_user_names(tmp_path):
    """Programs that digitise plots write columns X and Y for each curve, under its name."""
    path = tmp_path / "plot.csv"
    path.write_text(
        "97 °C,,105.5 °C,\nX,Y,X,Y\n1,2e-10,1.5,3e-9\n10,4e-10,15,6e-9\n"
        "100,7e-10,150,8e-9\n1000,9e-10,1500,9e-9\n10000,1e-9,,\n",
        encoding="utf-8",
    )
    tests = vf.read_step_tests(path, columns={"time": "X (s)", "creep_compliance": "Y (1/Pa)"}, deformation="shear")
    np.testing.assert_allclose(tests.temperatures, [370.15, 378.65])
    np.testing.assert_allclose(tests.tests[0].time, [1.0, 10.0, 100.0, 1e3, 1e4])
    np.testing.assert_allclose(tests.tests[1].response, [3e-9, 6e-9, 8e-9, 9e-9])
    with refused("no-temperature"):  # of the first curve alone
        vf.read_step_tests(path, columns={"time": "#1 (s)", "creep_compliance": "#2 (1/Pa)"})


def test_the_first_of_equal_headings_counts_where_nothing_tells_the_curves_apart(tmp_path):
    path = tmp_path / "plot.csv"
    path.write_text(
        "X,Y,X,Y\n1,2e-10,1.5,3e-9\n10,4e-10,15,6e-9\n100,7e-10,150,8e-9\n1000,9e-10,1500,9e-9\n", encoding="utf-8"
    )
    named = {"time": "X (s)", "creep_compliance": "Y (1/Pa)"}
    tests = vf.read_step_tests(path, columns=named, deformation="shear", temperature="25 degC")
    np.testing.assert_allclose(tests.tests[0].response, [2e-10, 4e-10, 7e-10, 9e-10])


def test_units_may_be_given(tmp_path):
    path = written(tmp_path / "a.csv", ("Time", "Creep Compliance"), [TIME, 1e-7 * TIME**0.2])
    given = {"temperature": "25 degC", "deformation": "shear"}
    creep = vf.read_step_tests(path, response_unit="1/Pa", **given)
    assert codes(creep) == ["time-without-unit", "temperature-given"]
    np.testing.assert_allclose(creep.tests[0].response[0], 1e-7)
    named = vf.read_step_tests(path, columns={"time": "#1 (h)", "creep_compliance": "#2 (1/Pa)"}, **given)
    np.testing.assert_allclose(named.tests[0].time, 3600.0 * TIME, rtol=1e-6)
    # the unit that is proposed follows from the values: the wrong one would be off by a million
    for level, unit in ((1e-7, "1/Pa"), (0.1, "1/MPa"), (5e-6, "1/Pa")):
        other = written(tmp_path / "b.csv", ("Time", "Creep Compliance"), [TIME, level * TIME**0.2])
        with refused("no-unit", DataFileError, naming=f"response_unit='{unit}'"):
            vf.read_step_tests(other, **given)
    with refused("no-temperature", DataFileError):
        vf.read_step_tests(path, response_unit="1/Pa", deformation="shear")
    with refused("no-deformation", DataFileError):
        vf.read_step_tests(path, response_unit="1/Pa", temperature="25 degC")
    with refused("wrong-unit", DataFileError):
        vf.read_step_tests(path, columns={"time": "#1 (kg)", "creep_compliance": "#2 (1/Pa)"}, **given)


def test_what_contradicts_is_refused(tmp_path):
    creep = written(tmp_path / "a_25C.csv", ("t (s)", "J (1/MPa)"), [TIME, 0.1 * TIME**0.2])
    relaxation = written(tmp_path / "b_25C.csv", ("t (s)", "G(t) (MPa)"), [TIME, 10.0 * TIME**-0.2])
    with refused("kinds-mixed", DataFileError):
        vf.read_step_tests(creep, relaxation, deformation="shear")
    with refused("unit-not-needed"):
        vf.read_step_tests(creep, deformation="shear", response_unit="1/MPa")
    with refused("given-twice", DataFileError):
        vf.read_step_tests(creep, creep, deformation="shear")
    both = written(tmp_path / "c_25C.csv", ("t (s)", "J (1/MPa)", "G (MPa)"), [TIME, 0.1 * TIME**0.2, 5.0 * TIME**-0.2])
    with refused("no-kind", DataFileError):
        vf.read_step_tests(both, deformation="shear")
    assert vf.read_step_tests(both, deformation="shear", kind="relaxation").kind == "relaxation"
    short = written(tmp_path / "d_25C.csv", ("t (s)", "J (1/MPa)"), [TIME[:3], 0.1 * TIME[:3]])
    with refused("no-points", DataFileError):
        vf.read_step_tests(short, deformation="shear")
    (tmp_path / "e.csv").write_text("a,b\n1,2\n")
    with refused("missing-columns", DataFileError, naming="creep compliance"):
        vf.read_step_tests(tmp_path / "e.csv", deformation="shear")


def test_points_that_are_none_are_left_out(tmp_path):
    time, response = np.append(0.0, TIME), np.append(0.0, 0.1 * TIME**0.2)
    path = written(
        tmp_path / "a_25C.csv", ("t (s)", "J (1/MPa)"), [np.append(time, TIME[-1]), np.append(response, 0.4)]
    )
    creep = vf.read_step_tests(path, deformation="shear")
    assert len(creep.tests[0]) == 13
    assert creep.tests[0].response[-1] == pytest.approx(1e-6 * np.sqrt(response[-1] * 0.4))
    assert codes(creep) == ["temperature-from-name", "points-left-out", "repeats-averaged"]


def rubber():
    return vf.synthetic_fluoroelastomer().at("20 degC")


def test_ringing_of_the_instrument_is_left_out():
    time = np.logspace(-3.0, 3.0, 400)
    true = rubber().creep_compliance(time)
    ringing = true * (1.0 - np.exp(-time / 0.03) * np.cos(2.0 * np.pi * time / 0.02))
    start = start_of(time, ringing, "creep")
    assert start.reason == "ringing"
    kept = slice(start.first, None)
    assert 0.05 < time[start.first] < 0.5
    np.testing.assert_allclose(ringing[kept], true[kept], rtol=0.03)
    assert start.broken_at is None


@pytest.mark.parametrize("kind", ["creep", "relaxation"])
def test_the_rise_of_a_step_is_left_out(kind):
    time = np.logspace(-3.0, 3.0, 400)
    true = rubber().creep_compliance(time) if kind == "creep" else rubber().relaxation_modulus(time)
    start = start_of(time, true * -np.expm1(-time / 0.01), kind)
    assert start.reason == "rise"
    assert 0.02 < time[start.first] < 1.0


@pytest.mark.parametrize("rise", [0.5, 4.0])
def test_a_creep_strain_over_a_stress_that_still_rises_is_left_out(tmp_path, rise):
    # J = t^0.2 under a stress that rises at a constant rate: the strain is a Boltzmann integral.
    time = np.logspace(-1.0, 3.0, 41)
    stress = np.minimum(time / rise, 1.0)
    strain = (time**1.2 - np.maximum(time - rise, 0.0) ** 1.2) / (1.2 * rise)
    path = written(tmp_path / "creep_25C.txt", ("t (s)", "stress (MPa)", "strain (-)"), [time, stress, strain])
    tests = vf.read_step_tests(path, kind="creep", deformation="tension")
    assert "rise-left-out" in codes(tests)
    kept = tests.tests[0].time
    # J falls behind by n/2 of the rise over the time, with n = 0.2: 1 % at ten times the rise.
    np.testing.assert_allclose(1e6 * tests.tests[0].response, kept**0.2, rtol=0.012)
    assert kept[0] < 20.0 * rise


def test_points_after_the_stress_is_released_are_left_out(tmp_path):
    time = np.concatenate([TIME, 1000.0 + TIME])
    strain = np.concatenate([TIME**0.2, (1000.0 + TIME) ** 0.2 - TIME**0.2])
    stress = np.repeat([1.0, 0.01], 13)  # hardly zero
    path = written(tmp_path / "creep_25C.txt", ("t (s)", "stress (MPa)", "strain (-)"), [time, stress, strain])
    tests = vf.read_step_tests(path, kind="creep", deformation="tension")
    assert "recovery-left-out" in codes(tests)
    np.testing.assert_allclose(tests.tests[0].response, 1e-6 * TIME**0.2, rtol=1e-6)


def test_tests_at_stated_temperatures_are_each_one_test(tmp_path):
    kelvin, time = np.repeat([22.1, 23.0, 23.9], 13), np.tile(TIME, 3)
    response = np.repeat([0.1, 0.12, 0.15], 13) * time**0.2
    path = written(tmp_path / "creep.txt", ("T (°C)", "t (s)", "J (1/MPa)"), [kelvin, time, response])
    tests = vf.read_step_tests(path, deformation="tension")
    np.testing.assert_allclose(tests.temperatures, 273.15 + np.array([22.1, 23.0, 23.9]))
    assert tests.notes == ()
    # Measured ones that vary during a test are of one temperature.
    kelvin = 23.0 + 0.1 * np.cos(np.arange(39.0))
    path = written(tmp_path / "again.txt", ("T (°C)", "t (s)", "J (1/MPa)"), [kelvin, time, response])
    assert len(vf.read_step_tests(path, deformation="tension").tests) == 1


@pytest.mark.parametrize("noise", [0.0, 0.005, 0.03])
def test_noise_is_no_ringing(noise):
    random = np.random.default_rng(1)
    for count in range(40):
        time = np.sort(10.0 ** random.uniform(-1.0, 3.5, 60)) if count % 2 else np.arange(1.0, 400.0)
        kind = "creep" if count % 4 < 2 else "relaxation"
        true = rubber().creep_compliance(time) if kind == "creep" else rubber().relaxation_modulus(time)
        start = start_of(time, true * (1.0 + noise * random.standard_normal(time.size)), kind)
        assert (start.first, start.broken_at) == (0, None)


def test_a_compliance_that_falls_later_is_kept_with_a_note(tmp_path):
    slipping = 0.1 * TIME**0.2 * np.where(TIME > 300.0, 0.8, 1.0)
    path = written(tmp_path / "a_25C.csv", ("t (s)", "J (1/MPa)"), [TIME, slipping])
    creep = vf.read_step_tests(path, deformation="shear")
    assert "not-of-a-material" in codes(creep)
    assert len(creep.tests[0]) == 13


def test_a_creep_export_of_trios_rings(real_data):
    creep = vf.read_step_tests(real_data / "instruments" / "trios" / "creep_experiment.txt")
    assert (creep.kind, creep.deformation) == ("creep", "shear")
    assert creep.temperatures == pytest.approx([318.15], abs=0.05)
    assert codes(creep) == ["points-left-out", "ringing-left-out"]
    first = creep.tests[0]
    assert 0.5 < first.time[0] < 2.0  # s; it rings with 30 Hz at first
    assert first.response[0] == pytest.approx(1.48e-4, rel=0.02)  # 1/Pa
    assert np.all(np.diff(np.log(first.response)) > -0.01)


def test_specimens_of_one_temperature_are_not_one_test(tmp_path):
    rows = [f"25;{time};{0.1 * time**0.2}" for time in (1.0, 10.0, 100.0, 1000.0)]
    heading = "T (°C);t (s);J(t) (1/MPa)"
    below = ["Sample A", heading, *rows, "Sample B", heading, *rows]
    beside = [f"sample;{heading}", *(f"{one};{row}" for one in "AB" for row in rows)]
    for lines in (below, beside):
        path = tmp_path / "creep.csv"
        path.write_text("\n".join(lines), encoding="utf-8")
        with refused("several-specimens", DataFileError):
            vf.read_step_tests(path, deformation="shear")


def test_rows_whose_temperatures_have_units_are_no_titles(tmp_path):
    path = tmp_path / "creep.csv"
    path.write_text("T;t (s);J(t) (1/MPa)\n" + "".join(f"25 °C;{time};0.1\n" for time in (1, 10)), encoding="utf-8")
    with refused("no-unit", DataFileError):
        vf.read_step_tests(path, deformation="shear")
