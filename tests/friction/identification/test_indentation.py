"""Materials planted into indentation tests come back, from any growing contact; what cannot be used is left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from viscofric.errors import DataFileError, InputError
from viscofric.files import SYNTHETIC
from viscofric.friction.identification.indentation.contact import Trial
from viscofric.friction.identification.indentation.growing import Growing, growing
from viscofric.friction.identification.indentation.rows import Reduced, usable_rows
from viscofric.notes import codes

KELVIN = 303.15
BALL = vf.Ball("10 mm")
KAPPA, PLANE_STRAIN = 4.0 / 3.0 * np.sqrt(0.01), 0.75
TIME = np.geomspace(0.01, 100.0, 40)
NOISE = 0.005


def bell() -> vf.Material:
    """Return a material with a wide, bell-shaped spectrum."""
    tau = np.geomspace(1e-6, 1e6, 49)
    shape = np.exp(-0.5 * (np.log10(tau) / 1.5) ** 2)
    C = 4e-7 * shape / shape.sum()
    return vf.Material(vf.RetardationSpectrum(2e6, 1e7, C, tau), vf.WLF(C1=10.0, C2="120 K", reference=KELVIN))


RUBBER = bell()


def creep(
    kelvin: float = KELVIN, noise: float = NOISE, seed: int = 0, extra: float = 0.0
) -> vf.friction.IndentationRecord:
    J = RUBBER.at(kelvin).creep_compliance(TIME)
    depth = ((PLANE_STRAIN * J + extra) * 2.0 / KAPPA) ** (2.0 / 3.0)
    depth *= 1.0 + noise * np.random.default_rng(seed).standard_normal(len(TIME))
    return vf.friction.IndentationRecord(TIME, np.full(len(TIME), 2.0), depth, kelvin, control="load", start=0.0)


def relaxation(noise: float = NOISE) -> vf.friction.IndentationRecord:
    load = KAPPA / PLANE_STRAIN * RUBBER.at(KELVIN).relaxation_modulus(TIME) * 1e-6
    load *= 1.0 + noise * np.random.default_rng(5).standard_normal(len(TIME))
    return vf.friction.IndentationRecord(TIME, load, np.full(len(TIME), 1e-4), KELVIN, control="indentation", start=0.0)


def contact_of(record: vf.friction.IndentationRecord) -> Growing:
    reduced = Reduced(BALL, float(record.indentation.max()))
    return growing(usable_rows(record, reduced, len(record)), reduced)


def planted(kelvin: float, rubber: vf.Material = RUBBER) -> Trial:
    spectrum = rubber.at(kelvin)
    x = np.log(np.append(1.0 / spectrum.E_inf, spectrum.C))
    return Trial(x, np.array(spectrum.tau), 0.0, PLANE_STRAIN, 0.0)


def forward(record: vf.friction.IndentationRecord) -> tuple[np.ndarray, np.ndarray]:
    """Return measured responses, and those of the planted material by the functional of the identification."""
    contact, trial = contact_of(record), planted(record.temperature)
    return contact.response, np.exp(contact.answer(trial).log_value)


@pytest.mark.parametrize("record", [creep(noise=0.0), relaxation(noise=0.0)], ids=["creep", "relaxation"])
def test_steps_are_those_of_the_closed_form(record: vf.friction.IndentationRecord) -> None:
    # Cubics over twentieths of a decade, and the contour with 14 nodes.
    measured, computed = forward(record)
    assert computed == pytest.approx(measured, rel=2e-5)


@pytest.mark.parametrize("control", ["load", "indentation"])
def test_ramps_and_holds_agree_with_the_solver_over_time(control: str) -> None:
    time = np.append(np.linspace(0.0, 1.0, 11)[1:], 1.0 + np.geomspace(0.03, 10.0, 12))
    most = 2.0 if control == "load" else 2e-4
    values = np.minimum(time, 1.0) * most
    history = vf.motion.History([0.0, 1.0, 11.0], **{control: [0.0, most, most]}, temperature=KELVIN)
    run = vf.motion.solve_transient(RUBBER, BALL, history, times=time, accuracy=1e-3)
    rows = {"load": run.load, "indentation": run.indentation, control: values}
    rows = {name: np.append(0.0, column) for name, column in rows.items()}
    record = vf.friction.IndentationRecord(np.append(0.0, time), **rows, temperature=KELVIN, control=control)
    measured, computed = forward(record)
    assert computed == pytest.approx(measured, rel=3e-3)  # of X: 1.5 times the accuracy of the depth


def test_derivatives_are_those_of_differences() -> None:
    for record in (creep(noise=0.0), relaxation(noise=0.0)):
        contact, tau = contact_of(record), np.geomspace(1e-3, 1e3, 7)
        check_derivatives(contact.answer, Trial(np.log(np.full(8, 3e-8)), tau, 0.3, PLANE_STRAIN, 1e-9), 1e-6)


def check_derivatives(answer, trial: Trial, allowed: float) -> None:
    """Compare derivatives with differences, good to the square of the step and to the error of values over it."""
    step, found = 1e-4, answer(trial)
    for place, unit in enumerate(np.eye(len(trial.compliances))):
        up, down = (answer(trial._replace(compliances=trial.compliances + way * unit)) for way in (step, -step))
        difference = (up.log_value - down.log_value) / (2.0 * step)
        assert found.change[:, place] == pytest.approx(difference, abs=allowed)
    up, down = (answer(trial._replace(log_alpha=trial.log_alpha + way)) for way in (step, -step))
    assert found.by_alpha == pytest.approx((up.log_value - down.log_value) / (2.0 * step), abs=allowed)


def test_planted_modulus_comes_back_from_creep_and_relaxation_within_its_band() -> None:
    found = vf.identify_from_indentation([creep(), relaxation()], BALL, samples=40, modes=20)
    low, high = found.frequency_range
    omega = np.geomspace(low, high, 7)
    planted, band = RUBBER.complex_modulus(omega, KELVIN), found.samples.modulus_band(omega)
    # 0.5 % of 80 rows: the modulus is known to some 0.3 %, E'' to a tenth of it at the ends of the band.
    assert np.abs(found.material.complex_modulus(omega) / planted - 1.0).max() < 0.02
    inside = (band.lower.real < planted.real) & (planted.real < band.upper.real)
    assert inside.sum() >= 5  # of seven; the benchmark counts them over many seeds
    assert found.identified.low < 0.02 < 10.0 < found.identified.high
    assert 0.7 < found.records[0].error[0] / (1.5 * NOISE) < 1.4  # a standard deviation of 40 rows is known to 11 %
    assert codes(found.notes) == set()
    data = found.to_dataset(omega)
    assert np.all(data["storage_modulus_lower"] < data["storage_modulus_upper"])
    assert found.records[1].to_dataset()["response"].attrs["units"] == "N"


def test_factors_of_several_temperatures_are_found() -> None:
    records = [creep(kelvin, seed=place) for place, kelvin in enumerate((293.15, 303.15, 318.15))]
    found = vf.identify_from_indentation(records, BALL, samples=20, modes=16)
    factors = found.shift_factors
    assert isinstance(factors, vf.ShiftFactors)
    assert found.shift_found
    assert factors.reference == pytest.approx(303.15)
    wrong = factors.log10_values - RUBBER.shift.log10(factors.temperatures)
    assert np.all(np.abs(wrong) <= 4.0 * factors.standard_errors + 1e-9)
    assert factors.standard_errors.max() < 0.05


def test_known_factors_and_an_elastic_indenter() -> None:
    stiff = 1e8
    record = creep(318.15, extra=(1.0 - 0.3**2) / stiff)
    found = vf.identify_from_indentation(record, BALL, shift=RUBBER.shift, indenter_modulus=stiff, samples=20, modes=16)
    assert not found.material.synthetic
    alpha = float(RUBBER.shift(318.15))
    ratio = found.material.complex_modulus(alpha) / RUBBER.complex_modulus(alpha, KELVIN)
    assert abs(ratio - 1.0) < 0.02
    assert not found.shift_found


def test_a_material_found_by_synthetic_shift_factors_is_synthetic(tmp_path: Path) -> None:
    path = tmp_path / "alpha.csv"
    path.write_text("# synthetic\ntemperature (K),log10 aT\n303.15,0.0\n333.15,-1.0\n")
    factors = vf.read_shift_factors(path)
    found = vf.identify_from_indentation(relaxation(), BALL, shift=factors, reference=KELVIN, samples=20, modes=16)
    assert found.material.synthetic
    assert SYNTHETIC in codes(found.notes)


def test_given_errors_that_are_too_small_are_enlarged() -> None:
    exact = creep(noise=0.02)
    record = vf.friction.IndentationRecord(
        TIME, exact.load, exact.indentation, KELVIN, control="load", start=0.0, error=1e-3 * exact.indentation
    )
    found = vf.identify_from_indentation(record, BALL, samples=20, modes=16)
    assert 14.0 < found.error_scale < 28.0  # 20, known to 11 %
    assert codes(found.notes) == {"errors-enlarged"}


def test_a_given_error_of_one_point_is_not_enlarged_by_chance() -> None:
    """The modulus is off by 1.5 standard errors, as one in seven is; rows without errors do not show that it is."""
    modulus = float(abs(RUBBER.complex_modulus(1.0, KELVIN)))
    anchor = vf.friction.ModulusAnchor(modulus * 1.0075, 1.0, KELVIN, error=0.005)
    found = vf.identify_from_indentation([creep(noise=0.002), anchor], BALL, samples=20, modes=10)
    assert found.error_scale == 1.0


def test_a_given_error_that_all_rows_share_is_noted() -> None:
    """A load cell that is wrong by 2 % scatters no row: its error belongs in load_error."""
    exact = creep(noise=0.004)
    record = vf.friction.IndentationRecord(
        TIME, exact.load, 1.02 * exact.indentation, KELVIN, control="load", start=0.0, error=0.02 * exact.indentation
    )
    found = vf.identify_from_indentation(record, BALL, samples=20, modes=16)
    assert "errors-not-scatter" in codes(found.notes)


def test_dense_records_are_averaged() -> None:
    time = np.linspace(0.02, 40.0, 2000)
    J = RUBBER.at(KELVIN).creep_compliance(time)
    random = np.random.default_rng(2)
    depth = (PLANE_STRAIN * J * 2.0 / KAPPA) ** (2.0 / 3.0) * (1.0 + 0.01 * random.standard_normal(2000))
    load = 2.0 * (1.0 + 1e-4 * random.standard_normal(2000))
    record = vf.friction.IndentationRecord(time, load, depth, KELVIN, control="load", start=0.0, error=0.01 * depth)
    contact = contact_of(record)
    assert len(contact) < 20 * 3.4
    assert contact.count.sum() == 2000
    assert contact.error == pytest.approx(0.015 / np.sqrt(contact.count), rel=0.05)


def test_the_approach_to_the_surface_is_left_out() -> None:
    random = np.random.default_rng(4)
    before = np.linspace(-0.5, -0.01, 50)
    time = np.append(before, np.linspace(0.0, 40.0, 1001)[1:])
    J = RUBBER.at(KELVIN).creep_compliance(time[50:])
    load, depth = (
        np.repeat([0.0, 2.0], [50, 1000]),
        np.append(np.zeros(50), (PLANE_STRAIN * J * 2.0 / KAPPA) ** (2 / 3)),
    )
    load, depth = load + 2e-3 * random.standard_normal(1050), depth + 1e-6 * random.standard_normal(1050)
    record = vf.friction.IndentationRecord(time, load, depth, KELVIN, control="load")
    contact = contact_of(record)
    assert (contact.count.sum(), contact.unclear) == (1000, 0)
    # The step was put on between two rows, within 10 ms: 5 ms of 40, or 0.2 % of J after a second.
    value = np.exp(contact.answer(planted(KELVIN)).log_value)
    late = contact.along > 1.5
    assert value[late] == pytest.approx(contact.response[late], rel=0.02)  # 1 µm of 150 is 1 % of X


def test_responses_of_no_more_than_scatter_are_refused() -> None:
    depth = 1e-6 * np.random.default_rng(1).standard_normal(40)
    record = vf.friction.IndentationRecord(TIME, np.full(40, 2.0), depth, KELVIN, control="load", start=0.0, error=1e-5)
    with pytest.raises(InputError) as caught:
        vf.identify_from_indentation(record, BALL)
    assert caught.value.code == "no-clear-response"


@pytest.mark.parametrize(
    ("change", "code"),
    [
        ({"time": [0.0, 2.0, 1.0, 3.0, 4.0]}, "time-goes-back"),
        ({"load": [1.0, 1.0]}, "wrong-length"),
        ({"error": 0.0}, "not-positive"),
        ({"start": 1.0}, "out-of-range"),
        ({"control": "depth"}, "wrong-choice"),
        ({"time": [0.0, 1.0], "load": [1.0, 1.0], "indentation": [1.0, 1.0]}, "too-few-points"),
    ],
)
def test_records_that_cannot_be(change: dict, code: str) -> None:
    given = {"time": np.arange(5.0), "load": np.ones(5), "indentation": np.full(5, 1e-4), "temperature": KELVIN}
    with pytest.raises(InputError) as caught:
        vf.friction.IndentationRecord(**(given | {"control": "load"} | change))
    assert caught.value.code == code


def test_indenters_without_a_disc_of_contact_are_refused() -> None:
    with pytest.raises(InputError) as caught:
        vf.identify_from_indentation(creep(), vf.Cylinder("10 mm"))
    assert caught.value.code == "no-revolution"


def test_tables_of_indentation_tests(tmp_path) -> None:
    path = tmp_path / "test.csv"
    rows = "".join(f"{n},{2},{100 + n},{23 + 0.01 * n}\n" for n in range(6))
    path.write_text("time (s),load (N),depth (um),temperature (degC)\n" + rows, encoding="utf-8")
    record = vf.friction.read_indentation(path, control="load", error="0.1 um")
    assert record.indentation == pytest.approx(1e-6 * (100.0 + np.arange(6)))
    assert record.temperature == pytest.approx(296.175)
    assert record.error == pytest.approx(np.full(6, 1e-7))
    with pytest.raises(InputError) as twice:
        vf.friction.read_indentation(path, control="load", temperature="23 degC")
    assert twice.value.code == "give-one"
    warming = "".join(f"{n},{2},{100 + n},{23 + 10 * n}\n" for n in range(6))
    path.write_text("time (s),load (N),depth (um),temperature (degC)\n" + warming, encoding="utf-8")
    with pytest.raises(DataFileError) as several:
        vf.friction.read_indentation(path, control="load")
    assert several.value.code == "several-temperatures"
    path.write_text("time (s),load (N)\n0,1\n1,1\n", encoding="utf-8")
    with pytest.raises(DataFileError) as missing:
        vf.friction.read_indentation(path, control="load", temperature="23 degC")
    assert missing.value.code == "missing-columns"
