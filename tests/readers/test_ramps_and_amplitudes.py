"""Temperature ramps and amplitude sweeps in files: recognised, read, refused with what to do instead."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import viscofric as vf
from refusals import refused
from viscofric.notes import codes
from viscofric.readers.dma.ramps import legs

HEADER = "temperature (degC),frequency (Hz),E' (MPa),E'' (MPa)\n"


def rows(kelvin, hertz=(1.0,)):
    for T in kelvin:
        for f in hertz:
            yield f"{T:.2f},{f},{10 ** (2 - 0.02 * T):.5g},{10 ** (1 - 0.02 * T):.5g}"


def written(folder: Path, lines, header=HEADER) -> Path:
    path = folder / "test.csv"
    path.write_text(header + "\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_ramp_at_one_frequency_is_read(tmp_path):
    found = vf.read_ramps(written(tmp_path, rows(np.arange(-20.0, 61.0, 0.7))), heating_rate="3 K/min")
    assert len(found) == 1
    assert len(found.ramps[0]) == 116
    assert found.ramps[0].angular_frequency == pytest.approx(2.0 * np.pi)
    assert found.heating_rate == pytest.approx(0.05)
    assert found.deformation == "tension"


def test_a_thermometer_of_the_furnace_between_phase_and_moduli_is_no_abscissa(tmp_path):
    header = "T (°C),f (Hz),phase (°),T furnace (°C),E' (MPa),E'' (MPa)\n"
    lines = [f"{T},1,{math.degrees(math.atan(0.1)):.6f},{T + 5},{10 - 0.1 * T},{1 - 0.01 * T}" for T in range(0, 40, 2)]
    ramp = vf.read_ramps(written(tmp_path, lines, header)).ramps[0]
    assert ramp.temperature[0] == pytest.approx(273.15)
    assert ramp.loss_modulus[0] == pytest.approx(1e6)


def test_ramps_at_several_frequencies_are_read_in_any_order(tmp_path):
    kelvin = np.arange(-20.0, 61.0, 2.0)
    mixed = list(rows(kelvin, (1.0, 10.0)))
    blocks = [*rows(kelvin, (10.0,)), *rows(kelvin, (1.0,))]
    one = vf.read_ramps(written(tmp_path, mixed))
    other = vf.read_ramps(written(tmp_path, blocks))
    for found in (one, other):
        assert found.angular_frequencies == pytest.approx([2.0 * np.pi, 20.0 * np.pi])
        assert [len(ramp) for ramp in found.ramps] == [41, 41]


@pytest.mark.parametrize("heading", ["{} {} Hz (MPa)", "{} ({} Hz) [MPa]", "{}_{}Hz_MPa", "{} f={} Hz / MPa"])
def test_headings_give_the_frequencies_of_ramps_beside_each_other(tmp_path, heading):
    names = [heading.format(modulus, hertz) for hertz in (1, "0.5") for modulus in ("E'", "E''")]
    lines = [f"{T},{3 - T / 100},0.3,{2 - T / 100},0.2" for T in range(-40, 61, 5)]
    found = vf.read_ramps(written(tmp_path, lines, ",".join(["T (°C)", *names]) + "\n"))
    assert found.angular_frequencies == pytest.approx([np.pi, 2.0 * np.pi])
    assert found.ramps[0].storage_modulus[0] == pytest.approx(2.4e6)
    assert found.ramps[1].loss_modulus == pytest.approx(0.3e6)
    assert "frequency-from-title" in codes(found.notes)
    above = ",1 Hz,,0.5 Hz,\nT (°C),E' (MPa),E'' (MPa),E' (MPa),E'' (MPa)\n"
    assert vf.read_ramps(written(tmp_path, lines, above)).angular_frequencies == pytest.approx([np.pi, 2.0 * np.pi])


def test_heating_and_cooling_are_told_apart(tmp_path):
    up = np.arange(-20.0, 61.0, 1.0)
    path = written(tmp_path, rows([*up, *up[::-1] - 0.3]))
    heating, cooling = vf.read_ramps(path), vf.read_ramps(path, direction="cooling")
    assert "direction" in codes(heating.notes)
    assert heating.ramps[0].temperature[0] == pytest.approx(253.15)
    assert cooling.ramps[0].temperature[0] == pytest.approx(252.85)
    with refused("no-such-direction", vf.DataFileError):
        vf.read_ramps(written(tmp_path, rows(up)), direction="cooling")


def test_read_dma_names_the_reader_of_ramps(tmp_path):
    path = written(tmp_path, rows(np.arange(-20.0, 61.0, 0.7)))
    with refused("temperature-ramp", vf.DataFileError) as caught:
        vf.read_dma(path)
    assert "read_ramps" in str(caught.value)
    assert "viscofric material ramp" in caught.value.words("shell")
    stepped = written(tmp_path, rows(np.arange(-20.0, 61.0, 5.0)))
    with refused("temperature-sweep", vf.DataFileError) as caught:
        vf.read_dma(stepped)
    assert "read_ramps" in str(caught.value)
    assert len(vf.read_ramps(stepped).ramps[0]) == 17


def test_sweeps_at_one_temperature_are_no_ramp(tmp_path):
    path = written(tmp_path, rows([25.0], np.geomspace(0.1, 10.0, 20)))
    with refused("no-ramp", vf.DataFileError) as caught:
        vf.read_ramps(path)
    assert "read_dma" in str(caught.value)


PAYNE = "temperature (degC),frequency (Hz),strain amplitude (%),G' (MPa),G'' (MPa)\n"


def amplitudes(strain, hertz=10.0):
    return [f"60,{hertz},{100 * one:.6g},{5 / (1 + one / 0.02):.6g},0.5" for one in strain]


def test_an_amplitude_sweep_is_read_on_its_way_up(tmp_path):
    up = np.geomspace(1e-3, 0.3, 15)
    found = vf.read_amplitude_sweep(written(tmp_path, amplitudes([*up, *up[::-1][1:]]), PAYNE))
    np.testing.assert_allclose(found.strain_amplitude, up, rtol=1e-5)
    assert (found.temperature, found.deformation) == (pytest.approx(333.15), "shear")
    assert "points-left-out" in codes(found.notes)


@pytest.mark.parametrize(
    "heading", ["double strain amplitude (%)", "DSA (%)", "strain p-p (%)", "peak to peak strain (%)"]
)
def test_double_amplitudes_are_refused(tmp_path, heading):
    path = written(tmp_path, (f"60,10,4,.4,{0.1 * 2**n}" for n in range(8)), HEADER.rstrip() + f",{heading}\n")
    with refused("double-amplitude", naming=(heading,)):
        vf.read_amplitude_sweep(path, columns={"strain_amplitude": heading})


@pytest.mark.parametrize(("largest", "read"), [(0.5, True), (50.0, False)])
def test_amplitudes_without_unit_are_fractions_where_they_can_be(tmp_path, largest, read):
    amplitudes = np.geomspace(1e-3, 1.0, 8) * largest
    path = written(tmp_path, (f"60,10,4,.4,{one}" for one in amplitudes), HEADER.rstrip() + ",strain\n")
    if read:
        assert vf.read_amplitude_sweep(path).strain_amplitude == pytest.approx(amplitudes)
    else:
        with refused("missing-columns"):
            vf.read_amplitude_sweep(path)


def test_a_table_without_amplitudes_says_so(tmp_path):
    rows = [f"60,10,{0.1 * 2**n},{5 - 0.3 * n},0.5" for n in range(10)]
    path = tmp_path / "payne.csv"
    path.write_text("\n".join(["T (degC),f (Hz),probe strain (%),G' (MPa),G'' (MPa)", *rows]), encoding="utf-8")
    with pytest.raises(vf.DataFileError, check=lambda error: error.code == "missing-columns"):
        vf.read_amplitude_sweep(path)
    named = vf.read_amplitude_sweep(path, columns={"strain_amplitude": "probe strain (%)"})
    assert named.strain_amplitude[-1] == pytest.approx(0.512)


def test_read_dma_names_the_reader_of_amplitude_sweeps(tmp_path):
    path = written(tmp_path, amplitudes(np.geomspace(1e-3, 0.3, 15)), PAYNE)
    with refused("amplitude-sweep", vf.DataFileError) as caught:
        vf.read_dma(path)
    assert "read_amplitude_sweep" in str(caught.value)
    with refused("no-amplitude-sweep", vf.DataFileError):
        vf.read_amplitude_sweep(written(tmp_path, amplitudes([0.01] * 10), PAYNE))


def test_a_genuine_amplitude_sweep_is_found_among_other_techniques(real_data):
    found = vf.read_amplitude_sweep(real_data / "instruments" / "trios" / "multi_technique_LIMS.txt")
    assert found.deformation == "shear"
    assert found.strain_amplitude[[0, -1]] == pytest.approx([9.9e-5, 1.175], rel=0.01)
    fit = vf.rheology.fit_kraus(found)
    assert 0.02 < fit.linear_ranges[0].strain < 0.1
    assert "kraus-misfit" in codes(fit.notes)  # a gel, not a filled rubber


def test_legs_end_where_values_turn_by_more_than_scatter():
    course = np.array([0.0, 1.0, 0.9, 2.0, 3.0, 2.0, 1.0, 1.1, 0.0])
    assert [(part.start, part.stop) for part in legs(course, 0.5)] == [(0, 5), (5, 9)]
    assert legs(np.arange(5.0), 0.5) == [slice(0, 5)]
