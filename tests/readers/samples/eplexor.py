"""Netzsch Eplexor workbooks, as measured and as a master curve, in the layout of genuine ones but saved as .xlsx."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from readers.samples.rubber import FREQUENCIES, TEMPERATURES, points

#: log10 aT of the isotherms; 1.5 is a whole number of the programme's steps, as may happen by chance.
SHIFTS = dict(zip(TEMPERATURES, (1.5, 0.0, -1.26), strict=True))

HEADER = [
    ["Measurement type:", "Temp. Freq. Sweep"],
    [""],
    [
        "",
        "Static load (Strain)",
        "Dynamic load (Strain)",
        "Contact Force:",
        "Frequency range:",
        "",
        "Frequency increment:",
    ],
    ["Values:", 0.1, 0.05, 0.2, 0.09999999999990905, 10.0, 2.0],
]


def save(path: Path, tables: Mapping[str, Sequence[Sequence[Any]]]) -> Path:
    """Write sheets of cells into a workbook."""
    import xlsxwriter

    with xlsxwriter.Workbook(str(path)) as workbook:
        for name, rows in tables.items():
            sheet = workbook.add_worksheet(name)
            for place, row in enumerate(rows):
                sheet.write_row(place, 0, row)
    return path


def raw_tables(letter: str = "E") -> dict[str, list[list[Any]]]:
    """Return the sheets of a workbook as measured: 0.05 % strain, temperatures that scatter by 0.02 K."""
    names = ["Nr", "F stat.", "Strain dyn", "Time", "f", "T", f"{letter}'", f"{letter}''", f"|{letter}*|", "tan delta"]
    units = ["", "N", "%", "s", "Hz", "°C", "MPa", "MPa", "MPa", ""]
    rows: list[list[Any]] = [names, units]
    for number, (T, f, storage, loss) in enumerate(points(), start=1):
        measured = T + 0.02 * (-1) ** number
        modulus = abs(complex(storage, loss))
        time = 1000.0 * TEMPERATURES.index(T) + 50.0 * FREQUENCIES.index(f)
        rows.append([number, -1.5, 0.05, time, f, measured, storage / 1e6, loss / 1e6, modulus / 1e6, loss / storage])
    rows[3][1] = "---"
    return {"Exported Data": rows, "Data header": HEADER}


def master_tables(letter: str = "E") -> dict[str, list[list[Any]]]:
    """Return the sheets of the master curve that the software makes of the same sweeps."""
    names, units, *rows = raw_tables(letter)["Exported Data"]
    shifted = []
    for row, (T, *_) in zip(rows, points(), strict=True):
        still = TEMPERATURES[1]
        shifted.append([*row[:4], row[4] * 10.0 ** SHIFTS[T], still, *row[6:]])
    shifted.sort(key=lambda row: row[4])
    for number, row in enumerate(shifted, start=1):
        row[0] = number
    listed = [[T, shift, ""] for T, shift in sorted(SHIFTS.items(), reverse=True)]
    list_rows = [["Ref.Temp.", "10.0 °C", ""], ["WLF", "C1 : 8.00", "C2 : 100.00 K"], ["Temp.", "Shift", ""], *listed]
    return {"Shiftlist": list_rows, "Exported Data": [names, units, *shifted], "Data header": HEADER}


def _raw(folder: Path) -> Path:
    return save(folder / "eplexor_raw.xlsx", raw_tables())


def _master(folder: Path) -> Path:
    return save(folder / "eplexor_master.xlsx", master_tables())


SAMPLES: dict[str, Callable[[Path], Path]] = {"eplexor raw": _raw, "eplexor master": _master}
