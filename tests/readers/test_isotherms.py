"""Points become isotherms: told by measured temperature and step, with everything doubtful named."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest

from readers.refusal import noted, refused
from viscofric import read_dma
from viscofric.notes import codes
from viscofric.readers.dma.isotherms import traced_sweeps
from viscofric.readers.dma.readings import Readings

FREQUENCIES = np.geomspace(0.1, 10.0, 9)  # Hz


def isothermal_sweeps(readings):
    return traced_sweeps(readings).sweeps


def readings(celsius, hertz, storage=None, loss=None, **more):
    """Return readings of a smooth synthetic rubber at given temperatures and frequencies."""
    celsius, hertz = np.broadcast_arrays(np.asarray(celsius, float), np.asarray(hertz, float))
    smooth = 1e6 * hertz**0.2 * 10.0 ** (-0.01 * celsius)
    more.setdefault("deformation", "tension")
    return Readings(
        source=more.pop("source", "sweeps.txt"),
        format="a test",
        places=tuple(f"line {n + 3}" for n in range(len(celsius))),
        temperature=celsius + 273.15,
        angular_frequency=2 * math.pi * hertz,
        storage_modulus=smooth if storage is None else np.asarray(storage, float),
        loss_modulus=0.1 * smooth if loss is None else np.asarray(loss, float),
        **more,
    )


def programme(temperatures, scatter=0.05):
    """Return temperatures and frequencies of sweeps that follow each other."""
    wiggle = scatter * np.sin(np.arange(len(FREQUENCIES)))
    celsius = np.concatenate([T + wiggle for T in temperatures])
    return celsius, np.tile(FREQUENCIES, len(temperatures))


def notes_with(sweeps, code, *names):
    return noted(sweeps.notes, code, *names)


def test_points_recorded_while_heating_are_left_out_and_named():
    celsius, hertz = programme([20.0, 30.0, 40.0])
    heating = np.arange(20.9, 29.9, 0.9)  # no gap above 1 K from 20 to 30 °C
    celsius = np.insert(celsius, 9, heating)
    hertz = np.insert(hertz, 9, np.full(len(heating), 10.0))
    sweeps = isothermal_sweeps([readings(celsius, hertz)])
    # the means of the held temperatures; the wiggle's mean is below 0.01 K
    assert sweeps.temperatures - 273.15 == pytest.approx([20.0, 30.0, 40.0], abs=0.02)
    assert [len(one) for one in sweeps.isotherms] == [9, 9, 9]
    assert len(notes_with(sweeps, "temperature-moving")) == 1
    assert notes_with(sweeps, "temperature-moving", "10 points", "lines 12, 13, 14 and 7 more")


def test_every_reading_is_in_one_isotherm_or_left_out():
    celsius, hertz = programme([20.0, 30.0, 40.0])
    heating = np.arange(20.9, 29.9, 0.9)
    celsius = np.insert(celsius, 9, heating)
    hertz = np.insert(hertz, 9, np.full(len(heating), 10.0))
    storage = np.full(len(celsius), 1e6)
    storage[2] = -1.0
    traced = traced_sweeps([readings(celsius, hertz, storage=storage)])
    assert traced.left_out.tolist() == [2, *range(9, 19)]
    assert [one.rows.size for one in traced.isotherms] == [8, 9, 9]
    assert traced.points.places[2] == "line 5"


@pytest.mark.parametrize("step", [0.1, 0.2, 0.5])
def test_heating_that_was_recorded_finely_is_distinguished_from_holding(step):
    celsius, hertz = programme([20.0, 30.0, 40.0], scatter=0.02)
    heating = np.arange(20.0, 30.0, step) + step / 2
    celsius = np.concatenate([celsius[:9], heating, celsius[9:18], heating + 10.0, celsius[18:]])
    hertz = np.concatenate([hertz[:9], np.full(len(heating), 10.0), hertz[:9], np.full(len(heating), 10.0), hertz[:9]])
    sweeps = isothermal_sweeps([readings(celsius, hertz)])
    # a point or two of the heating beside a held temperature may count to it
    assert sweeps.temperatures - 273.15 == pytest.approx([20.0, 30.0, 40.0], abs=0.1)
    assert [len(one) for one in sweeps.isotherms] == [9, 9, 9]
    assert len(notes_with(sweeps, "temperature-moving")) == 1


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("noise", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("rate", [0.05, 0.2])
@pytest.mark.parametrize("count", [1, 3, 9])
def test_a_noisy_ramp_is_not_taken_for_isotherms(seed, noise, rate, count):
    celsius = np.arange(0.0, 30.0, rate)
    celsius += noise * np.random.default_rng(seed).standard_normal(len(celsius))
    with refused("temperature-ramp"):
        isothermal_sweeps([readings(celsius, np.resize(FREQUENCIES[:count], len(celsius)))])


def test_single_points_between_steps_are_left_out_and_named():
    celsius, hertz = programme([20.0, 30.0])
    sweeps = isothermal_sweeps([readings(np.insert(celsius, 9, [23.0, 26.0]), np.insert(hertz, 9, [1.0, 1.0]))])
    assert len(sweeps) == 2
    assert notes_with(sweeps, "points-left-out", "2 points", "lines 12 and 13")


@pytest.mark.parametrize("rate", [0.05, 0.2, 0.5, 0.95])
def test_a_continuous_ramp_is_refused_at_any_rate(rate):
    celsius = np.arange(0.0, 30.0, rate)
    with refused("temperature-ramp"):
        isothermal_sweeps([readings(celsius, np.resize(FREQUENCIES, len(celsius)))])


def test_a_temperature_sweep_at_one_frequency_is_refused():
    with refused("temperature-sweep", None, "10 temperatures"):
        isothermal_sweeps([readings(np.arange(0.0, 50.0, 5.0), np.ones(10))])


def test_steps_of_the_programme_hold_a_settling_temperature_together():
    settling = 1.8 * np.exp(-np.arange(9.0))  # jumps by more than 1 K between its first two points
    celsius = np.concatenate([20.0 + settling, 30.0 + settling])
    step = np.repeat([1, 2], 9)
    sweeps = isothermal_sweeps([readings(celsius, np.tile(FREQUENCIES, 2), step=step)])
    assert [len(one) for one in sweeps.isotherms] == [9, 9]
    assert notes_with(sweeps, "temperature-range", "1.8 K", "20.3 and 30.3 °C") != []


def test_isotherms_of_several_files_are_not_joined_by_their_drift():
    # 20 → 22.5 °C and 23 → 25.5 °C: within one file there would be no gap between them
    files = [readings(start + np.linspace(0.0, 2.5, 9), FREQUENCIES, source=f"{start}.txt") for start in (20.0, 23.0)]
    sweeps = isothermal_sweeps(files)
    assert sweeps.temperatures - 273.15 == pytest.approx([21.25, 24.25])
    assert notes_with(sweeps, "temperature-range", "2.5 K") != []


def test_one_temperature_in_two_files_is_one_isotherm():
    half = FREQUENCIES[::2], FREQUENCIES[1::2]
    sweeps = isothermal_sweeps([readings(20.0 + 0.1 * n, f, source=f"{n}.txt") for n, f in enumerate(half)])
    assert len(sweeps) == 1
    assert sweeps.isotherms[0].angular_frequency == pytest.approx(2 * math.pi * FREQUENCIES)


def test_a_steady_drift_is_reported_and_scatter_is_not():
    drifting = isothermal_sweeps([readings(20.0 + np.linspace(0.0, 0.8, 9), FREQUENCIES)])
    assert notes_with(drifting, "temperature-drifts", "0.8 K", "20.4 °C") != []
    scattering = isothermal_sweeps([readings(20.0 + 0.4 * np.cos(np.pi * np.arange(9)), FREQUENCIES)])
    assert not codes(scattering.notes) & {"temperature-range", "temperature-drifts"}


def test_an_outlier_is_named_and_kept_and_its_neighbours_are_not_blamed():
    celsius, hertz = programme([20.0, 30.0, 40.0])
    rng = np.random.default_rng(1)
    storage = 1e6 * hertz**0.2 * np.exp(0.01 * rng.standard_normal(27))
    storage[13] *= 1.4
    sweeps = isothermal_sweeps([readings(celsius, hertz, storage, 0.1 * 1e6 * hertz**0.2)])
    assert len(notes_with(sweeps, "outlying-modulus")) == 1
    assert notes_with(sweeps, "outlying-modulus", "storage modulus at 30.0 °C, 1 Hz (line 16)")
    assert len(sweeps.isotherms[1]) == 9


@pytest.mark.parametrize("seed", range(5))
def test_noise_alone_makes_no_outlier(seed):
    celsius, hertz = programme(np.arange(0.0, 100.0, 10.0))
    rng = np.random.default_rng(seed)
    # 3 % noise, more than instruments have; eight standard deviations occur in none of 90 points
    noisy = 1e6 * hertz**0.2 * np.exp(0.03 * rng.standard_normal((2, 90)))
    assert notes_with(isothermal_sweeps([readings(celsius, hertz, *noisy)]), "outlying-modulus") == []


def test_a_glass_transition_is_no_outlier():
    hertz = np.geomspace(0.1, 100.0, 10)
    z = (1j * hertz * 10.0 ** np.array([[-1.5], [0.0], [1.5]])) ** 0.6
    E = 1e6 + 1e9 * z / (1 + z)  # Cole-Cole, three decades in modulus
    celsius = np.repeat([0.0, 10.0, 20.0], 10)
    found = isothermal_sweeps([readings(celsius, np.tile(hertz, 3), E.real.ravel(), E.imag.ravel())])
    assert notes_with(found, "outlying-modulus") == []


def test_points_without_a_value_or_below_zero_are_left_out_and_grouped():
    celsius, hertz = programme([20.0, 30.0])
    storage, loss = 1e6 * hertz**0.2, 1e5 * hertz**0.2
    storage[[1, 2, 3]] = -1.0
    loss[5], loss[[10, 12]] = np.nan, -3.0
    sweeps = isothermal_sweeps([readings(celsius, hertz, storage, loss)])
    assert sum(map(len, sweeps.isotherms)) == 12
    assert notes_with(sweeps, "points-left-out", "Line 8", "missing") != []
    assert notes_with(sweeps, "points-left-out", "3 points", "storage moduli", "lines 4, 5 and 6;") != []
    assert notes_with(sweeps, "points-left-out", "2 points", "loss moduli", "lines 13 and 15;") != []


@pytest.mark.parametrize("column", ["storage", "loss"])
def test_if_most_is_missing_nothing_is_read(column):
    bad = np.full(9, np.nan)
    bad[:4] = 1e6
    with refused("points-unusable", None, "5", "9 points", "7"):
        isothermal_sweeps([readings(np.full(9, 20.0), FREQUENCIES, **{column: bad})])


def test_mostly_negative_storage_moduli_are_refused():
    bad = np.full(9, -1e6)
    bad[:4] = 1e6
    with refused("points-unusable", None, "5", "9 points"):
        isothermal_sweeps([readings(np.full(9, 20.0), FREQUENCIES, bad)])


def test_strain_amplitudes_that_differ_between_isotherms_are_reported():
    celsius, hertz = programme([20.0, 30.0, 40.0])
    same, differing = np.full(27, 1e-3), np.repeat([1e-3, 2e-3, 5e-3], 9)
    assert notes_with(isothermal_sweeps([readings(celsius, hertz, strain_amplitude=same)]), "amplitudes-differ") == []
    sweeps = isothermal_sweeps([readings(celsius, hertz, strain_amplitude=differing)])
    (differ, *_) = notes_with(sweeps, "amplitudes-differ")
    assert [differ.values[name] for name in ("least", "most")] == pytest.approx([1e-3, 5e-3])
    assert [differ.values[name] for name in ("least_at", "most_at")] == pytest.approx([293.15, 313.15], abs=0.05)
    assert sweeps.isotherms[2].strain_amplitude == pytest.approx(np.full(9, 5e-3))


def test_repeated_readings_that_disagree_are_reported():
    hertz = np.array([1.0, 2.0, 2.0, 3.0])
    near, far = np.array([1.0, 2.0, 2.02, 3.0]), np.array([1.0, 2.0, 2.4, 3.0])
    agreeing, differing = (isothermal_sweeps([readings(np.full(4, 20.0), hertz, 1e6 * E)]) for E in (near, far))
    assert notes_with(agreeing, "repeats-differ") == []
    # |E*| of 2.0 and 2.4 MPa with nearly equal loss: 18 % of their mean
    assert notes_with(differing, "repeats-differ", "18 %", "20.0 °C") != []


def test_files_that_contradict_each_other_are_refused():
    one = readings(np.full(9, 20.0), FREQUENCIES, source="a.txt", said_by="the heading E'")
    other = readings(np.full(9, 30.0), FREQUENCIES, source="b.txt", deformation="shear", said_by="the heading G'")
    with refused("deformation-contradicts", None, "b.txt", "a.txt"):
        isothermal_sweeps([one, other])
    silent = readings(np.full(9, 30.0), FREQUENCIES, source="c.txt", deformation=None)
    reported = isothermal_sweeps([one, silent])
    assert reported.deformation == "tension"
    assert notes_with(reported, "deformation-not-said", "c.txt", "tension") != []


def test_notes_that_files_share_stand_once():
    files = [readings(np.full(9, T), FREQUENCIES, source=f"{T:g}.txt", notes=("Odd.",)) for T in (10.0, 20.0, 30.0)]
    assert [note.where for note in isothermal_sweeps(files).notes if note.text == "Odd."] == ["All files"]


def test_nothing_at_all_is_refused():
    with refused("no-files"):
        isothermal_sweeps([])
    with refused("no-points"):
        isothermal_sweeps([readings([], [])])


def test_a_soft_noisy_sample_keeps_what_can_be_used(real_data):
    files = sorted((real_data / "instruments" / "mettler" / "soft_noisy").glob("*.txt"))
    sweeps = read_dma(files)
    assert sweeps.deformation == "shear"
    assert len(sweeps) == 14
    assert notes_with(sweeps, "points-left-out", "11 points", "storage moduli") != []
    assert notes_with(sweeps, "points-left-out", "23 points", "loss moduli") != []
    assert len(sweeps.notes) < 12


def test_strain_amplitudes_that_differ_by_a_third_are_reported():
    celsius, hertz = programme([20.0, 30.0])
    differing = np.repeat([1e-3, 1.3e-3], 9)
    sweeps = isothermal_sweeps([readings(celsius, hertz, strain_amplitude=differing)])
    assert notes_with(sweeps, "amplitudes-differ") != []


@pytest.mark.slow
def test_a_step_for_every_point_takes_no_time():
    count = 30_000
    hertz = np.geomspace(0.1, 10.0, count)
    begin = time.process_time()
    sweeps = isothermal_sweeps([readings(np.full(count, 20.0), hertz, step=np.arange(count))])
    assert [len(one) for one in sweeps.isotherms] == [count]
    assert time.process_time() - begin < 10.0  # some 2 s; work that grows as the square takes more than 10 s


def test_isotherms_are_left_out_on_request_and_named(tmp_path):
    rows = [f"{T + 0.1},{f},{3 + f / T},0.3" for T in (20, 30, 40) for f in (1, 2, 5)]
    path = tmp_path / "three.csv"
    path.write_text("\n".join(["T (degC),f (Hz),E' (MPa),E'' (MPa)", *rows]))
    kept = read_dma(path, leave_out_temperatures=["30 degC"])
    np.testing.assert_allclose(kept.temperatures, [293.25, 313.25])
    (note,) = (one for one in kept.notes if one.code == "temperatures-left-out")
    assert note.values["temperatures"] == pytest.approx([303.25])
    everything = read_dma(path)
    for whole in (everything, read_dma(path, leave_out_temperatures=[])):
        assert "temperatures-left-out" not in codes(whole.notes)
    for wrong, code in ((["35 degC"], "no-such-temperature"), ([20.0], "no-such-temperature")):
        with refused(code):
            read_dma(path, leave_out_temperatures=wrong)
    with refused("none-left"):
        read_dma(path, leave_out_temperatures=everything.temperatures)
