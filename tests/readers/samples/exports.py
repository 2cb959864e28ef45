"""Exports of rheometers and DMAs that the general tables read: Malvern, HAAKE, RheoPlus, Netzsch Proteus, workbooks.

The layouts were learned from public repositories; the numbers are of the synthetic rubber.
"""

from __future__ import annotations

import math
from pathlib import Path

from readers.samples.rubber import FREQUENCIES, TEMPERATURES, moduli
from readers.samples.workbook import write as write_workbook


def sheared() -> list[tuple[float, float, float, float]]:
    """Return °C, Hz and both shear moduli, Pa, temperature by temperature."""
    return [(T, f, *(one / 3 for one in moduli(T, f))) for T in TEMPERATURES for f in FREQUENCIES]


def german(number: float) -> str:
    """Return a number with a decimal comma, six digits."""
    return f"{number:.6g}".replace(".", ",")


def malvern(folder: Path) -> Path:
    """Write rSpace's table: a steady action, an amplitude table, and a frequency table for each temperature."""
    names = (
        "Action Name;Time (sequence)(s);Shear stress(Pa);Shear rate(s-¹);Shear strain(%);Complex shear strain(%);"
        "Frequency(Hz);Shear modulus (elastic component)(Pa);Shear modulus (viscous component)(Pa);"
        "Shear modulus (complex component)(Pa);Temperature(°C);Gap(mm)"
    )
    rows = ["Pre shear;112,3;30,54;47,57;4,75275E+003;;;;;;20,93;1,0000"] * 5
    first = min(TEMPERATURES)
    storage, loss = (one / 3 for one in moduli(first, 1.0))
    for strain in (0.01, 0.1, 1.0, 10.0):
        drop = 1.1 / (1.0 + strain)
        cells = (strain, 1.0, drop * storage, drop * loss, drop * math.hypot(storage, loss), first)
        rows.append("Amplitude table;200;;;;" + ";".join(map(german, cells)) + ";1,0000")
    for T, f, storage, loss in sheared():
        cells = (0.1, f, storage, loss, math.hypot(storage, loss), T)
        rows.append(f"Frequency table {T:g};300;;;;" + ";".join(map(german, cells)) + ";1,0000")
    path = folder / "rspace.csv"
    path.write_text("\n".join([names, *rows, ""]), encoding="utf-8")
    return path


def haake(folder: Path) -> Path:
    """Write RheoWin's text: lines about the test, names after an empty one, segment and point, decimal commas."""
    lines = [
        "C:\\data\\synthetic.rwd",
        "Company / Operator: none / none",
        "Date / Time / Version: 11.04.2018 / 09:33:02 / HAAKE RheoWin 4.30.0021",
        "Substance / Sample no: synthetic / 1",
        "",
        ";t / s;t_seg / s;f / Hz;omega / rad/s;G' / Pa;G'' / Pa;|G*| / Pa;T / °C;",
    ]
    for n, (T, f, storage, loss) in enumerate(sheared()):
        cells = (65.0 + n, 5.0 + n, f, 2 * math.pi * f, storage, loss, math.hypot(storage, loss), T)
        segment, point = 1 + n // len(FREQUENCIES), 1 + n % len(FREQUENCIES)
        lines.append(f"{segment}|{point};" + ";".join(map(german, cells)) + ";")
    lines += [f"9|{n};294,7;33,16; ; ; ; ; ; ;" for n in range(1, 30)]  # a segment that is no oscillation
    path = folder / "rheowin.txt"
    path.write_bytes("\r\n".join([*lines, ""]).encode("cp1252"))
    return path


def rheoplus(folder: Path) -> Path:
    """Write intervals below each other, each with its own lines and header, UTF-16 that ends with half a character."""
    lines = ["Data Series Information", "", "Name:\tsynthetic 1", f"Number of Intervals:\t{len(TEMPERATURES)}"]
    lines += ["Application:\tRHEOPLUS/32 V3.40", "Meas. Geometry:\tPP25", ""]
    header = "Meas. Pts.\tAngular Frequency\tStorage Modulus\tLoss Modulus\tDamping Factor\tTemperature\tStatus"
    for interval, T in enumerate(TEMPERATURES, start=1):
        lines += [f"Interval:\t{interval}", f"Number of Data Points:\t{len(FREQUENCIES)}", "", header]
        lines.append("\t[1/s]\t[Pa]\t[Pa]\t[1]\t[°C]\t[]")
        for point, f in enumerate(FREQUENCIES, start=1):
            storage, loss = (one / 3 for one in moduli(T, f))
            cells = (2 * math.pi * f, storage, loss, loss / storage, T)
            lines.append(f"{point}\t" + "\t".join(f"{one:.6g}" for one in cells) + "\tDy_")
        lines.append("")
    path = folder / "rheoplus.txt"
    path.write_bytes("\r\n".join(lines).encode("utf-16") + b"\n")
    return path


def proteus(folder: Path) -> Path:
    """Write Netzsch Proteus's text: remarks, the last of which names the columns."""
    lines = ["#EXPORTTYPE:DATA ALL", "#FORMAT:NETZSCH5", "#MTYPE:DMA", "#SEPARATOR:SEMICOLON"]
    lines.append("##Temp./°C;Time/min;f/Hz;E'/MPa;E''/MPa;tan d")
    for n, (T, f, storage, loss) in enumerate(sheared()):
        lines.append(f"{T:.5f};{n:.5f};{f:.5f};{3e-6 * storage:.6g};{3e-6 * loss:.6g};{loss / storage:.6g}")
    path = folder / "proteus.txt"
    path.write_bytes("\r\n".join([*lines, ""]).encode("latin-1"))
    return path


def trios_workbook(folder: Path) -> Path:
    """Write a workbook of TRIOS: details, an amplitude sweep, one sheet for each temperature, strain in two units."""
    details = [["Filename", "synthetic.tri"], ["Instrument name", "DHR"], ["Geometry name", "25mm parallel plate"]]
    names = ["Storage modulus", "Loss modulus", "Tan(delta)", "Angular frequency", "Step time", "Temperature"]
    names += ["Oscillation strain", "Oscillation strain"]
    units = ["Pa", "Pa", "", "rad/s", "s", "°C", "%", "1"]
    sheets = {"Details": details}
    first = min(TEMPERATURES)
    storage, loss = (one / 3 for one in moduli(first, 1.0))
    swept = [
        [storage / (1 + a), loss / (1 + a), loss / storage, 2 * math.pi, 1, first, a, a / 100] for a in (0.1, 1, 10)
    ]
    sheets["Amplitude sweep - 1"] = [["Amplitude sweep - 1"], names, units, *swept]
    for n, T in enumerate(TEMPERATURES, start=1):
        rows = []
        for f in FREQUENCIES:
            storage, loss = (one / 3 for one in moduli(T, f))
            rows.append([storage, loss, loss / storage, 2 * math.pi * f, 1 / f, T, 0.1, 0.001])
        sheets[f"Frequency sweep - {n}"] = [[f"Frequency sweep - {n}"], names, units, *rows]
    return write_workbook(folder / "trios.xlsx", sheets)


def rheocompass_workbook(folder: Path) -> Path:
    """Write RheoCompass's rows into a sheet, as a spreadsheet keeps them."""
    rows = [["Project:", "synthetic"], ["Test:", "sweeps"], ["Measuring system:", "PP25"], []]
    names = ["Interval data:", "Point No.", "Angular Frequency", "Storage Modulus", "Loss Modulus", "Temperature"]
    for interval, T in enumerate(TEMPERATURES, start=1):
        rows += [["Result:", f"sweep {interval}"], ["Interval and data points:", interval, len(FREQUENCIES)]]
        rows += [names, [], ["", "", "[rad/s]", "[Pa]", "[Pa]", "[°C]"]]
        for point, f in enumerate(FREQUENCIES, start=1):
            storage, loss = (one / 3 for one in moduli(T, f))
            rows.append(["", point, 2 * math.pi * f, storage, loss, T])
        rows.append([])
    return write_workbook(folder / "rheocompass.xlsx", {"Tabelle1": rows})


SAMPLES = {
    "Malvern rSpace": malvern,
    "HAAKE RheoWin": haake,
    "Anton Paar RheoPlus": rheoplus,
    "Netzsch Proteus": proteus,
    "workbook: TRIOS": trios_workbook,
    "workbook: RheoCompass": rheocompass_workbook,
}
