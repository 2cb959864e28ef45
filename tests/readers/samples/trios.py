"""Synthetic TRIOS exports of a frequency sweep at several temperatures: for LIMS, short text, CSV and JSON."""

from __future__ import annotations

import json
import math
from itertools import groupby
from pathlib import Path

from .rubber import points

#: Name, unit, and the number from temperature (°C), frequency (Hz), storage and loss modulus (Pa).
COLUMNS = {
    "Run time": ("s", lambda T, f, a, b: 600.0 + T),
    "Temperature": ("°C", lambda T, f, a, b: T),
    "Angular frequency": ("rad/s", lambda T, f, a, b: 2 * math.pi * f),
    "Oscillation torque": ("µN.m", lambda T, f, a, b: 3e-3 * a),
    "Oscillation strain": ("%", lambda T, f, a, b: 0.1 + 0.01 * f),
    "Status bits": ("", lambda T, f, a, b: "0xB6453"),
    "Date and time": ("", lambda T, f, a, b: "6/26/2023 1:43:31 PM"),
    "Frequency": ("Hz", lambda T, f, a, b: f),
    "Tan(delta)": ("", lambda T, f, a, b: b / a),
    "Storage modulus": ("Pa", lambda T, f, a, b: a),
    "Loss modulus": ("Pa", lambda T, f, a, b: b),
    "Step time": ("s", lambda T, f, a, b: 20.0 + f),
}
#: Of the modulus in Pa.
UNITS = {"Pa": 1.0, "MPa": 1e6, "kPa": 1e3, "dyne/cm²": 0.1}


def printed(value: object) -> str:
    """Return a number with the digits that TRIOS prints, text as it is."""
    return f"{value:.15G}" if isinstance(value, float) else str(value)


def sweeps(of=points) -> list[tuple[float, list[tuple]]]:
    """Return temperature and points of each step."""
    return [(T, list(rows)) for T, rows in groupby(of(), key=lambda point: point[0])]


def cell(name: str, point: tuple, unit: str = "") -> object:
    """Return a value in the unit wanted."""
    stated, value = COLUMNS[name]
    number = value(*point)
    return number / UNITS[unit] if stated == "Pa" and unit else number


def unit_of(name: str, unit: str) -> str:
    """Return the unit as printed."""
    return unit if COLUMNS[name][0] == "Pa" and unit else COLUMNS[name][0]


def lims_lines(names=tuple(COLUMNS), unit="Pa", geometry="25.0mm parallel plate", others=True, of=points) -> list[str]:
    """Return the lines of an export for LIMS, after a step of another technique if `others`."""
    lines = [
        "[Version]",
        "TA Instruments LIMS export format version\t0",
        "[Header]",
        "Instrument name\t4010-0000",
        "[Sample]",
        "Name\tsynthetic rubber in tension",  # what a user writes says nothing of the tool
        "[Geometry]",
        "[Geometry: Standard]",
        f"Name\t{geometry}",
        "[Parameters: Temperature Control Information]",
        "Temperature option\tFCO/LN2-Air",
    ]
    if others:
        lines += ["[Step]", "Step name\tCreep - 1", "Number of points\t1"]
        lines += ["Variables\tTemperature\tStrain\tStress", "Units\t°C\t%\tPa", "Data point\t20.0\t1.5\t900.0"]
    for temperature, rows in sweeps(of):
        lines += ["[Step]", f"Step name\tFrequency sweep ({temperature:.1f} °C)", f"Number of points\t{len(rows)}"]
        lines += ["\t".join(["Variables", *names]), "\t".join(["Units", *(unit_of(name, unit) for name in names)])]
        lines += ["\t".join(["Data point", *(printed(cell(name, row, unit)) for name in names)]) for row in rows]
    return lines


def short_rows(names=tuple(COLUMNS), unit="MPa", of=points) -> list[list[str]]:
    """Return the rows of a short export, one step for each temperature after a step of another technique."""
    rows = [
        ["Filename", "synthetic"],
        ["Instrument name", "DHR-3"],
        ["Operator", "nobody"],
        ["rundate", "6/26/2023"],
        ["Sample name", "synthetic rubber"],
        ["Geometry name", "Torsion rectangle"],
        ["proceduresegments", "Creep#Frequency sweep#Frequency sweep#Frequency sweep"],
        ["[File Parameters]"],
        ["Name", "two lines, one cell:\nthe second" if unit == "csv" else "one line"],
        ["[step]"],
        ["Creep - 1"],
        ["Temperature", "Strain"],
        ["°C", "%", "s"],
        ["20.0", "1.5"],
    ]
    unit = "MPa" if unit == "csv" else unit
    for number, (_, points_of_step) in enumerate(sweeps(of), start=2):
        rows += [["[step]"], [f"Frequency sweep - {number}"], list(names), [unit_of(name, unit) for name in names]]
        for k, point in enumerate(points_of_step):
            cells = [printed(cell(name, point, unit)) for name in names]
            rows.append(cells if k % 2 else cells[:-1])  # the step time, which not every row has
    return rows


def write_lims(folder: Path, encoding="utf-8-sig", name="lims.txt", **how) -> Path:
    """Write an export for LIMS."""
    path = folder / name
    path.write_bytes("\r\n".join([*lims_lines(**how), ""]).encode(encoding))
    return path


def write_short(folder: Path, encoding="utf-8", name="short.txt", comma=False, **how) -> Path:
    """Write a short text export."""
    path = folder / name
    rows = ["\t".join(row) for row in short_rows(**how)]
    rows = [row.replace(".", ",") if comma and row[:1] in "-0123456789" else row for row in rows]
    path.write_bytes("\r\n".join([*rows, ""]).encode(encoding))
    return path


def write_csv(folder: Path, name="trios.csv", delimiter=",", comma=False, **how) -> Path:
    """Write a CSV export; cells that hold the delimiter or an end of line are quoted."""

    def shown(text: str) -> str:
        text = text.replace(".", ",") if comma and text[:1] in "-0123456789" else text
        return f'"{text}"' if delimiter in text or "\n" in text else text

    path = folder / name
    rows = [delimiter.join(shown(text) for text in row) for row in short_rows(unit="csv", **how)]
    path.write_bytes("\r\n".join([*rows, ""]).encode("utf-8-sig"))
    return path


def document(
    section="Processed", unit="MPa", geometry="25.0mm parallel plate", names=tuple(COLUMNS), of=points
) -> dict:
    """Return a JSON export: every part that the vendor's schema requires, and rows by key of their column."""
    keys = {name: f"{name}_{unit_of(name, unit)}" if unit_of(name, unit) else name for name in names}
    headers = {
        key: {
            "DisplayName": name,
            "ValueType": "String" if name in ("Status bits", "Date and time") else "Number",
            **({"Unit": {"Name": unit_of(name, unit)}} if unit_of(name, unit) else {}),
        }
        for name, key in keys.items()
    }
    headers["Results Step Id"] = {"DisplayName": "Results Step Id", "ValueType": "Uuid"}
    steps, rows = [], []
    for number, (_, points_of_step) in enumerate(sweeps(of), start=1):
        one = f"a8b61200-ae3f-40a9-831e-8{number:011d}"
        steps.append({"Id": one, "Name": f"Frequency sweep - {number}"})
        rows += [{**{keys[n]: cell(n, p, unit) for n in names}, "Results Step Id": one} for p in points_of_step]
    classes = {"Processed": "Latest", "Original": "Unmodified"}
    reported = {"Id": classes.get(section, "Unmodified"), "Description": "Data may include user edits"}
    return {
        "Schema": {"Url": "https://software.tainstruments.com/schemas/TRIOSJSONExportSchema"},
        "Operators": [{"Name": "nobody"}],
        "Sample": {"Name": "synthetic rubber", "Notes": ""},
        "Procedure": {
            "Name": "Frequency sweeps",
            "Steps": [],
            "Configuration": {"InstrumentConfigurations": [{"Type": "AresG2", "Geometry": {"Name": geometry}}]},
        },
        "Analyses": [],
        "Results": {
            section: {"Classification": reported, "ResultsSteps": steps, "ColumnHeaders": headers, "Rows": rows},
        },
    }


def write_json(folder: Path, name="trios.json", **how) -> Path:
    """Write a JSON export."""
    path = folder / name
    path.write_text(json.dumps(document(**how), indent=2), encoding="utf-8")
    return path


SAMPLES = {
    "TRIOS export for LIMS": write_lims,
    "TRIOS short text": write_short,
    "TRIOS CSV": write_csv,
    "TRIOS JSON": write_json,
}
