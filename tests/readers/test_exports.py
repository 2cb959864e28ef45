"""Exports of rheometers and DMAs that the general tables read, each with what its layout adds to a plain table."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.samples import exports
from readers.samples.reptate import sweep
from readers.samples.rubber import FREQUENCIES, TEMPERATURES, moduli
from readers.written import write
from viscofric import read_dma
from viscofric.readers.dma.master_curves import read_master_curve


def assert_is_the_rubber(sweeps, factor=1 / 3):
    assert sweeps.temperatures - 273.15 == pytest.approx(TEMPERATURES)
    for temperature, isotherm in zip(TEMPERATURES, sweeps.isotherms, strict=True):
        assert isotherm.angular_frequency == pytest.approx(2 * np.pi * np.array(FREQUENCIES), rel=1e-5)
        storage, loss = np.transpose([moduli(temperature, f) for f in FREQUENCIES])
        assert isotherm.storage_modulus == pytest.approx(factor * storage, rel=1e-5)
        assert isotherm.loss_modulus == pytest.approx(factor * loss, rel=1e-5)


@pytest.mark.parametrize("name", sorted(exports.SAMPLES))
def test_the_synthetic_rubber_comes_back(tmp_path, name):
    sweeps = read_dma(exports.SAMPLES[name](tmp_path))
    assert_is_the_rubber(sweeps, 1.0 if name == "Netzsch Proteus" else 1 / 3)
    assert sweeps.deformation == ("tension" if name == "Netzsch Proteus" else "shear")


def test_actions_of_rspace_that_are_no_frequency_sweep_are_reported(tmp_path):
    sweeps = read_dma(exports.malvern(tmp_path))
    assert noted(sweeps.notes, "empty-rows", "5 rows")
    assert noted(sweeps.notes, "other-amplitudes", "about 0.1 %")
    assert sweeps.isotherms[0].strain_amplitude == pytest.approx(np.full(len(FREQUENCIES), 1e-3))


def test_rheowin_without_a_temperature_asks_for_it(tmp_path):
    path = exports.haake(tmp_path)
    lines = path.read_bytes().decode("cp1252").splitlines()
    kept = [line for line in lines if not line[:1].isdigit() or line.startswith("1|")]
    cold = tmp_path / "cold.txt"
    without = [";".join(line.split(";")[:8]) if ";" in line else line for line in kept]  # no column of temperature
    cold.write_bytes("\n".join(without).encode("cp1252"))
    with refused("no-temperature"):
        read_dma(cold)
    sweeps = read_dma(cold, temperature=f"{TEMPERATURES[0]} degC")
    assert len(sweeps.isotherms[0]) == len(FREQUENCIES)


def test_an_amplitude_sweep_beside_frequency_sweeps_is_skipped(tmp_path):
    sweeps = read_dma(exports.trios_workbook(tmp_path))
    assert noted(sweeps.notes, "no-frequency-sweep", "'Amplitude sweep - 1'")
    assert noted(sweeps.notes, "deformation", "parallel plate")
    one = read_dma(exports.trios_workbook(tmp_path), sheet="Frequency sweep - 2")
    assert one.temperatures - 273.15 == pytest.approx([TEMPERATURES[1]])


@pytest.mark.parametrize(
    ("head", "stated"),
    [
        (["T=30;chem=PE;Mw=300;"], True),
        (["C1=8.7;T=30;isof=true;Mw=2.4;PDI=1.09;"], True),
        (["Source=A B;Mw=0;T=30;"], True),
        (["Ma=20.1; Mb=82.0000;q=7.7;armPI=1.005;", "#", "#"], False),
        (["Mw=59.0;T=30;chem=PI;", "#", "# Frequency\tG' \tG\" of a star\t\t"], True),
    ],
)
def test_every_head_of_a_master_curve_of_reptate(tmp_path, head, stated):
    rows = ["0.1 3\t0.2 30.0 0", " 1.0E+0001\t4\t0.5\t29.9\t0"]
    curve = read_master_curve(write(tmp_path, *head, *rows, encoding="latin-1"), "30 degC")
    assert curve.angular_frequency == pytest.approx([0.1, 10.0])
    assert curve.storage_modulus == pytest.approx([9.0, 12.0])  # E = 3G
    if stated:
        with refused("other-reference"):
            read_master_curve(write(tmp_path, *head, *rows, encoding="latin-1"), "40 degC")


def test_columns_of_reptate_in_any_order(tmp_path):
    text = sweep(tmp_path).read_text(encoding="latin-1").splitlines()
    order = [3, 2, 0, 4, 1]
    names, units = (text[line].split("\t") for line in (1, 2))
    rows = [[row.split()[place] for place in order] for row in text[3:]]
    lines = ["\t".join(cells[place] for place in order) for cells in (names, units)]
    path = write(tmp_path, text[0], *lines, *("\t".join(row) for row in rows), name="b.osc", encoding="latin-1")
    known, found = read_dma(tmp_path / "sweep.osc"), read_dma(path)
    for name in ("angular_frequency", "storage_modulus", "loss_modulus", "strain_amplitude"):
        assert np.array_equal(getattr(known.isotherms[0], name), getattr(found.isotherms[0], name))
