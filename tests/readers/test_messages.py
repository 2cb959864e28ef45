"""What readers say: the content of a file, and the sentence of the error or of a note."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import viscofric as vf
from readers.samples import pcs
from viscofric import read_dma, read_mtm
from viscofric.errors import DataFileError
from viscofric.readers.dma.master_curves import read_master_curve

DMA = "temperature (degC),frequency (Hz),storage modulus (MPa),loss modulus (MPa)"
SWEEP = [f"{T},{f},{5 + f},0.5" for T in (20, 40) for f in (1, 2, 5)]
MTM = "disc speed (mm/s),ball speed (mm/s),traction force (N),load (N),temperature (degC)"


def curves_at_20_celsius(path: Path) -> object:
    return vf.read_friction_curves(path, columns={"temperature": "= 20 degC"})


ERRORS: list[tuple[Callable[[Path], object], list[str], str]] = [
    (read_dma, [""], "the file is empty; it must hold a header and rows of numbers."),
    (
        read_dma,
        [DMA, "20,1,five,0.5"],
        "'five' in column 'storage modulus (MPa)' is not a finite number; correct it, or leave out the row.",
    ),
    (read_dma, [DMA, "20,1,0,0.5"], "0 in column 'storage modulus (MPa)' must be above zero."),
    (
        read_dma,
        [DMA, "20,0,1,5,3,0,5"],
        (
            "the row has 7 cells where the header names 4 columns. If decimals have commas, separate columns by "
            "semicolons or tabs."
        ),
    ),
    (read_dma, [DMA, "20,1,5"], "the row has 3 cells where the header names 4 columns."),
    (
        read_dma,
        [DMA.replace("(MPa)", "(mm)"), *SWEEP],
        "column 'storage modulus (mm)' has the unit 'mm'; it must be one like 'MPa'.",
    ),
    (
        read_dma,
        ["T (degC),f,E' (MPa),E'' (MPa)", *SWEEP],
        "column 'f' has no unit; write it as 'f (Hz)' or 'f (rad/s)', or name it: columns={'frequency': 'f (Hz)'}.",
    ),
    (
        read_dma,
        [DMA, *SWEEP],
        (
            "does not state whether it was measured in tension or in shear, a factor of 3 in the modulus; set "
            "deformation = 'tension' or 'shear'."
        ),
    ),
    (
        lambda path: read_dma(path, deformation="tension"),
        [DMA, *(f"{20 + 0.5 * n},{1 + n % 3},5,0.5" for n in range(40))],
        (
            "the temperatures run continuously from 20.0 to 39.5 °C, without a gap of 1 K; isothermal sweeps are "
            "needed, not a temperature ramp; use read_ramps for it."
        ),
    ),
    (
        lambda path: read_dma(path, deformation="tension"),
        [DMA, *(f"{T},10,5,0.5" for T in range(0, 100, 10))],
        (
            "each of the 10 temperatures has one frequency; frequency sweeps are needed, not a temperature sweep; use "
            "read_ramps for it."
        ),
    ),
    (
        read_dma,
        ["reduced frequency (Hz),E' (MPa),E'' (MPa)", "1,5,0.5"],
        (
            "column 'reduced frequency (Hz)' holds reduced frequencies: a master curve; use read_master_curve with its "
            "reference temperature."
        ),
    ),
    (
        lambda path: read_master_curve(path, "25 degC"),
        ["# reference temperature 30 degC", "reduced frequency (Hz),E' (MPa),E'' (MPa)", "1,5,0.5"],
        "states the reference temperature 30 °C, not 25 °C.",
    ),
    (
        read_mtm,
        [MTM.replace("ball speed", "slip"), "20,1,0.5,25,30"],
        (
            "no column for ball speed; a table of traction runs has e.g. 'temperature (degC)', 'disc speed (mm/s)', "
            "'ball speed (mm/s)', 'load (N)', 'traction force (N)', this one has 'disc speed (mm/s)', 'slip (mm/s)', "
            "'traction force (N)', 'load (N)', 'temperature (degC)'; a pin or ball at rest has the speed 0; name them, "
            "e.g. columns={'ball_speed': 'heading'}."
        ),
    ),
    (read_mtm, [MTM, "20,1,0.5,0,30"], "0 in column 'load (N)' must be above zero."),
    (
        curves_at_20_celsius,
        ["speed (mm/s),COF 5,COF 10", "1,0.1,0.2"],
        (
            "the numbers of the headings 'COF 5' and 'COF 10' have no unit; write 'COF 5 N', or name repetitions in a "
            "column."
        ),
    ),
    (
        curves_at_20_celsius,
        ["speed (mm/s),COF 5 N 10 N", "1,0.1"],
        "heading 'COF 5 N 10 N' states two values of load, 10 N and 5 N; keep the one that holds.",
    ),
    (
        vf.read_friction_curves,
        ["Load: 5 N,", "speed (mm/s),COF-20 °C", "1,0.1"],
        "the dash in heading 'COF-20 °C' may be a minus sign; write the temperature in brackets.",
    ),
    (
        curves_at_20_celsius,
        ["Friction force,,", "speed (mm/s),5 N,10 N", "1,0.1,0.2"],
        (
            "heading '5 N' and those beside it name no quantity, and above them is 'Friction force'; write the "
            "quantity into each heading, such as 'COF 5 N' for coefficients of friction."
        ),
    ),
    (
        curves_at_20_celsius,
        ["speed (mm/s),5 N,10 N", "1,0.1,3"],
        (
            "column '5 N' and those beside it name no quantity, and one is above 2, as forces may be; if they are "
            "coefficients, write 'COF 5 N'."
        ),
    ),
    (
        vf.read_friction_curves,
        ["speed (rpm),T (°C),load (N),COF", "60,20,5,0.1"],
        (
            "column 'speed (rpm)' holds revolutions, whose speed depends on the radius; write it as 'speed (mm/s)', "
            "2π · radius · revolutions/60, or add a column 'track radius (mm)'."
        ),
    ),
    (
        vf.read_friction_curves,
        ["speed (mm/s);T (°C);load (N);COF", "1,234.5;20;5;0,1"],
        (
            "'1,234.5' has a point, but other numbers of the file have a comma, so that decimals and thousands cannot "
            "be distinguished; write all decimals in one way."
        ),
    ),
    (
        vf.read_topography,
        ["1,2,3,4", "5,6,7,8"],
        "does not state the spacing of its points; give spacing = '5 um', for instance.",
    ),
    (
        lambda path: vf.read_topography(path, unit="um", spacing="1 um"),
        ["0,1,2,3,4,5", "3,1,4,1,5,9", "2,6,5,3,5,8"],
        (
            "has a first row that rises evenly, as numbers or positions of its lines do; delete it, or leave the "
            "corner empty if the first row and column are both positions."
        ),
    ),
    (
        lambda path: vf.read_topography(path, unit="um"),
        ["x (um),z (um)", "1,2", "2,3"],
        "its headings state their units; leave unit = 'um' out.",
    ),
]


@pytest.mark.parametrize(("read", "lines", "sentence"), ERRORS)
def test_errors_are_one_sentence(
    tmp_path: Path, read: Callable[[Path], object], lines: list[str], sentence: str
) -> None:
    path = tmp_path / "data.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(DataFileError) as caught:
        read(path)
    assert caught.value.problem == sentence


def test_notes_on_sweeps(tmp_path: Path) -> None:
    path = tmp_path / "sweeps.csv"
    header = DMA.replace("storage modulus", "E'").replace("loss modulus", "E''")
    path.write_text("\n".join([header, *SWEEP[::-1], "20,9,6,-0.1", "40,1,6,0.5"]), encoding="utf-8")
    assert list(read_dma(path).notes) == [
        "Read as delimited text.",
        "The file's header states that the moduli were measured in tension (the heading \"E' (MPa)\").",
        "Line 8 left out: its loss modulus is not above zero (−1e+05 Pa at 20.0 °C, 9 Hz).",
        "The rows at 20.0 and 40.0 °C were sorted by frequency.",
        "1 repeated frequency at 40.0 °C was averaged.",
        "The isotherms were sorted by temperature.",
    ]


def test_notes_on_traction_runs(tmp_path: Path) -> None:
    path = tmp_path / "runs.csv"
    path.write_text(f"{MTM},remark\n20,18,0.5,25,30,ok\n20,22,-0.5,25,30,ok\n", encoding="utf-8")
    assert list(read_mtm(path).notes) == [
        "Not read: the column 'remark'.",
        (
            "There is no replicate column; passes at equal speeds, load and temperature are numbered in their order, "
            "and rows in succession are one pass. Give a replicate column if they are repetitions."
        ),
    ]


def test_notes_on_conditions_in_headings(tmp_path: Path) -> None:
    path = tmp_path / "wide.csv"
    path.write_text("Temperature: 20 °C\nspeed (mm/s);5 kg;10 kg\n1;0.1;0.2\n", encoding="utf-8")
    assert list(vf.read_friction_curves(path).notes[:4]) == [
        "Column '5 kg' and those beside it name no quantity; they were read as viscoelastic friction.",
        "For all rows, as lines above the table state: 'Temperature: 20 °C'.",
        "Masses in 'loads of headings' were read as their weights at 9.80665 m/s²: 1 kg is 1 kgf.",
        "No column holds a load; loads were taken from the headings.",
    ]


def test_notes_on_an_export_of_a_tribometer(tmp_path: Path) -> None:
    runs = read_mtm(pcs.TRACTION_SAMPLES["MTM"](tmp_path))
    assert list(runs.notes[:2]) == [
        (
            "A text export of PCS Instruments' MTM or ETM; profile 'synthetic profile'; lubricant 'none'; test started "
            "'23/03/2018 10:00:00'."
        ),
        "1 of 5 steps contain no traction readings and are skipped: 1 MAPPER.",
    ]
    assert runs.notes[6] == "Temperatures are those of the lube RTD."
    assert str(runs.steps[1]) == (
        "step 3 (TRACTION, 'slip reversed'): 6 readings at 25 N, 40.0 °C, 46.67 mm/s, slip 20 %"
    )
    assert runs.select([0, -1]).notes[-1] == "2 of 24 readings are selected."
    lines = [line.replace("\t42.0\t40.0\t", "\t120.0\t13.0\t") for line in pcs.mtm()]
    assert read_mtm(pcs.write(tmp_path, lines)).notes[6] == (
        "Temperatures are those of the lube RTD, 13.0 °C on average, but the pot RTD reads 120.0 °C; "
        "thermometer='pot' takes that one."
    )
