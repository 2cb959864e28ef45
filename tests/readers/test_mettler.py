"""Mettler text: fixed width, one temperature or several in a file, tension and shear, noise and all."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.samples.mettler import SAMPLES, block, line
from readers.samples.rubber import points
from viscofric import read_dma
from viscofric.readers.dma.instruments import mettler
from viscofric.readers.source import Source


def written(lines):
    return Source("sample.txt", "\n".join(lines).encode("iso-8859-1"))


@pytest.mark.parametrize(("name", "deformation"), [("mettler tension", "tension"), ("mettler shear", "shear")])
def test_planted_moduli_come_back(tmp_path, name, deformation):
    path = SAMPLES[name](tmp_path)
    readings = mettler.read(Source(str(path), path.read_bytes()))
    planted = np.array(points())
    # The sample is 0.3 K from its programme, and prints six digits.
    assert np.allclose(readings.temperature - 273.15, planted[:, 0] + 0.3, rtol=0.0, atol=1e-4)
    assert np.allclose(readings.angular_frequency, 2 * np.pi * planted[:, 1], rtol=1e-5)
    assert np.allclose(readings.storage_modulus, planted[:, 2], rtol=1e-5)
    assert np.allclose(readings.loss_modulus, planted[:, 3], rtol=1e-5)
    assert readings.deformation == deformation
    assert readings.places[0] == "line 3"


def test_each_block_is_a_step(tmp_path):
    path = SAMPLES["mettler tension"](tmp_path)
    readings = mettler.read(Source(str(path), path.read_bytes()))
    assert readings.step.tolist() == [0] * 5 + [1] * 5 + [2] * 5


def test_index_that_begins_anew_is_a_step():
    lines = block(10.0)
    assert mettler.read(written(lines + block(30.0)[2:])).step.tolist() == [0] * 5 + [1] * 5


def test_displacement_is_no_strain():
    readings = mettler.read(written(block(10.0)))
    assert readings.strain_amplitude is None
    assert noted(readings.notes, "strain-unknown")


def test_units_are_those_of_the_second_line():
    lines = block(10.0)
    lines[1] = lines[1].replace("[MPa]", "[kPa]")
    ratio = mettler.read(written(block(10.0))).storage_modulus / mettler.read(written(lines)).storage_modulus
    assert np.allclose(ratio, 1000.0, rtol=1e-12)


def test_blank_cell_keeps_the_columns_in_place():
    lines = block(10.0)
    cells = lines[3].split()
    cells[4] = ""
    lines[3] = line(cells)
    assert np.array_equal(mettler.read(written(lines)).loss_modulus, mettler.read(written(block(10.0))).loss_modulus)


def test_primes_of_any_sort_are_known():
    plain, typographic = written(block(10.0)), written(block(10.0, mark="''"))
    assert mettler.recognises(typographic)
    assert np.array_equal(mettler.read(plain).loss_modulus, mettler.read(typographic).loss_modulus)


def test_negative_moduli_are_handed_on():
    lines = block(10.0)
    cells = lines[3].split()
    cells[9] = "-" + cells[9]
    lines[3] = line(cells)
    assert mettler.read(written(lines)).loss_modulus[1] < 0


@pytest.mark.parametrize(
    ("place", "cell", "refusal"),
    [
        (1, "-3.0e+02", ("not-positive", 4, "'Ts'")),
        (3, "0.0", ("not-positive", 4, "'f'")),
        (8, "1.2.3", ("not-a-number", 4, "'1.2.3'", '"E\'"')),
        (8, "1e305", ("not-a-number", 4, "1e305")),
        (0, "1" * 5000, ("not-a-number", 4)),
    ],
)
def test_damaged_cell_is_reported(place, cell, refusal):
    lines = block(10.0)
    cells = lines[3].split()
    cells[place] = cell
    lines[3] = " " + " ".join(cells)
    with refused(*refusal):
        mettler.read(written(lines))


def test_missing_number_leaves_its_point_incomplete():
    lines = block(10.0)
    cells = lines[3].split()
    cells[8] = "nan"
    lines[3] = " " + " ".join(cells)
    assert mettler.read(written(lines)).complete.tolist() == [True, False, True, True, True]


def changed(lines, place, *cells):
    """Return a block with other cells in a column of its first points."""
    rows = [one.split() for one in lines]
    for row, cell in zip(rows[2:], cells, strict=False):
        row[place] = cell
    return [" " + " ".join(row) for row in rows]


@pytest.mark.parametrize("cell", ["nan", "-1.5"])
def test_block_with_few_usable_points_does_not_refuse_the_others(tmp_path, cell):
    path = tmp_path / "sweeps.txt"
    lines = [*block(-10.0), *changed(block(10.0), 8, *[cell] * 3), *block(30.0)]
    path.write_text("\n".join(lines), encoding="iso-8859-1")
    sweeps = read_dma(path)
    assert sum(len(one.storage_modulus) for one in sweeps.isotherms) == 12
    assert noted(sweeps.notes, "points-left-out", "3 points")


def test_decimal_comma_of_one_block_is_that_of_the_file():
    numbers = ("1.500", "2.500", "3.500", "4.500", "5.500")
    bare, others = (
        [line(one.split()[:2] + one.split()[3:5] + one.split()[8:10]) for one in block(celsius)]
        for celsius in (10.0, 30.0)
    )
    rows = [one.split() for one in bare]
    for row, number in zip(rows[2:], numbers, strict=True):
        row[1:] = [number, number, "1.000", number, "1.250"]
    doubtful = [" ".join(row) for row in rows]
    commas = [one.replace(".", ",") for one in doubtful]
    with refused("ambiguous-decimals"):
        mettler.read(written(commas))
    clear = [one.replace(".", ",") for one in others]
    found = mettler.read(written(commas + clear)).storage_modulus
    assert found[:5].tolist() == [1.5e6, 2.5e6, 3.5e6, 4.5e6, 5.5e6]
    assert np.array_equal(found[5:], mettler.read(written(block(30.0))).storage_modulus)


def test_row_cut_short_is_reported():
    lines = block(10.0)
    lines[-1] = lines[-1][:100]
    with refused("row-length", 7, "7 cells", "12 columns"):
        mettler.read(written(lines))


def test_mixed_deformations_are_refused():
    with refused("several-tables", 8):
        mettler.read(written(block(10.0) + block(30.0, "G")))


def test_header_alone_is_refused():
    with refused("no-points"):
        mettler.read(written(block(10.0)[:2]))


@pytest.mark.parametrize(
    ("folder", "files", "rows", "deformation", "negative"),
    [("glassy_network", 22, 60, "tension", 0), ("soft_noisy", 14, 24, "shear", None)],
)
def test_genuine_files_are_read(real_data, folder, files, rows, deformation, negative):
    paths = sorted((real_data / "instruments" / "mettler" / folder).glob("*.txt"))
    readings = [mettler.read(Source(str(path), path.read_bytes())) for path in paths]
    assert len(readings) == files
    assert all(len(one) == rows and one.deformation == deformation for one in readings)
    below = sum(int(np.sum((one.storage_modulus <= 0) | (one.loss_modulus <= 0))) for one in readings)
    assert below == 0 if negative == 0 else below > 10  # a soft sample at the limit of the force cell


def test_genuine_numbers_are_those_printed(real_data):
    path = real_data / "instruments" / "mettler" / "glassy_network" / "T0.txt"
    readings = mettler.read(Source(str(path), path.read_bytes()))
    first = [values[0] for values in (readings.temperature, readings.storage_modulus, readings.loss_modulus)]
    assert first == pytest.approx([273.15 - 0.591320, 2939.11e6, 54.5177e6], rel=1e-12)
    assert readings.angular_frequency[0] == pytest.approx(2 * np.pi * 0.0999999, rel=1e-6)
