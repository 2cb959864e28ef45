"""Files are told by their content, never by their name, and several make one set of sweeps."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
import xarray as xr

from readers.refusal import noted, refused
from readers.samples import SAMPLES
from readers.samples.rubber import FREQUENCIES, TEMPERATURES, moduli
from viscofric import read_dma
from viscofric.readers.dma.read import FORMATS, format_of
from viscofric.readers.source import Source


@pytest.mark.parametrize("name", sorted(SAMPLES))
def test_one_format_alone_recognises_a_file_or_stands_before_the_others(tmp_path, name):
    path = SAMPLES[name](tmp_path)
    source = Source(str(path), path.read_bytes())
    claimed = [one for one in FORMATS if one.recognises(source)]
    assert format_of(source) is claimed[0]
    # an export may be a workbook or a delimited table too, but never the export of two instruments
    general = {"viscofric.readers.dma.tables.workbook", "viscofric.readers.dma.tables.dma_table"}
    assert len([one for one in claimed if one.__name__ not in general]) <= 1


@pytest.mark.parametrize("name", sorted(SAMPLES))
def test_the_name_of_a_file_does_not_matter(tmp_path, name):
    path = SAMPLES[name](tmp_path)
    plain = read_dma(path)
    renamed = read_dma(path.rename(tmp_path / "a.bin"))
    assert renamed.format == plain.format
    assert renamed.temperatures == pytest.approx(plain.temperatures)
    assert plain.format in plain.notes[0]


@pytest.mark.parametrize("name", [name for name in sorted(SAMPLES) if name.startswith(("delimited", "workbook"))])
def test_the_synthetic_rubber_comes_back(tmp_path, name):
    sweeps = read_dma(SAMPLES[name](tmp_path))
    assert sweeps.temperatures - 273.15 == pytest.approx(TEMPERATURES)
    factor = 1.0 if sweeps.deformation == "tension" else 1 / 3
    for temperature, isotherm in zip(TEMPERATURES, sweeps.isotherms, strict=True):
        assert isotherm.angular_frequency == pytest.approx(2 * np.pi * np.array(FREQUENCIES), rel=1e-6)
        storage, loss = np.transpose([moduli(temperature, f) for f in FREQUENCIES])
        # six digits are printed
        assert isotherm.storage_modulus == pytest.approx(factor * storage, rel=1e-5)
        assert isotherm.loss_modulus == pytest.approx(factor * loss, rel=1e-5)


def test_what_nobody_recognises_is_refused_with_all_that_is_known(tmp_path):
    (tmp_path / "letter.txt").write_text("Dear reader,\nno table here.\n", encoding="utf-8")
    with refused("unknown-format") as caught:
        read_dma(tmp_path / "letter.txt")
    assert all(one.NAME in str(caught.value) for one in FORMATS)
    (tmp_path / "empty.txt").write_bytes(b"\xef\xbb\xbf \r\n")
    with refused("empty"):
        read_dma(tmp_path / "empty.txt")
    (tmp_path / "picture.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(range(256)))
    with refused("unknown-format"):
        read_dma(tmp_path / "picture.png")


def test_files_of_several_formats_and_units_make_one_set_of_sweeps(tmp_path):
    header = "T (K),f (Hz),E' (Pa),E'' (Pa)"
    (tmp_path / "cold.csv").write_text(f"{header}\n243.15,1,5e8,5e7\n243.15,2,6e8,6e7\n", encoding="utf-8")
    plain = SAMPLES["delimited: plain"](tmp_path)
    sweeps = read_dma(plain, tmp_path / "cold.csv")
    assert sweeps.temperatures - 273.15 == pytest.approx([-30.0, *TEMPERATURES])
    assert sweeps.isotherms[0].storage_modulus == pytest.approx([5e8, 6e8])
    assert "plain.csv" in sweeps.source
    assert "cold.csv" in sweeps.source
    mixed = read_dma([SAMPLES["workbook: one sheet"](tmp_path), tmp_path / "cold.csv"])
    assert noted(mixed.notes[:1], "format", "one.xlsx", "Excel workbook", "cold.csv", "delimited text")
    shear = SAMPLES["delimited: shear in UTF-16"](tmp_path)
    with refused("deformation-contradicts", None, "plain.csv"):
        read_dma(plain, shear)


def test_files_given_twice_are_refused(tmp_path):
    plain = SAMPLES["delimited: plain"](tmp_path)
    with refused("given-twice"):
        read_dma(plain, tmp_path / ".." / tmp_path.name / plain.name)
    (tmp_path / "copy.csv").write_bytes(plain.read_bytes())
    with refused("given-twice", None, "copy.csv", "plain.csv"):
        read_dma(plain, tmp_path / "copy.csv")


def test_no_file_at_all_is_refused_with_advice():
    for nothing in ((), ([],)):
        with refused("no-files"):
            read_dma(*nothing)
    tables_in_memory = {"T": [20.0]}, xr.DataArray([[20.0]]), xr.Dataset({"T": 20.0})
    for no_name in (3, [3], *tables_in_memory):
        with refused("not-a-name"):
            read_dma(no_name)


@pytest.mark.slow
def test_readers_are_imported_without_slow_packages():
    script = "import sys, viscofric.readers; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert not loaded & {"pandas", "python_calamine", "pint", "xarray", "matplotlib", "scipy.optimize"}
