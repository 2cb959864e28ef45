"""Traction tests in the layout of genuine PCS Instruments MTM and ETM exports; forces are synthetic.

They follow O + F_N [μ_c sgn(u_disc − u_ball) + μ_v sgn(u_disc)] with the numbers below.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

#: None of these files is one of a dynamic mechanical analyser.
SAMPLES: dict = {}

OFFSET, COULOMB, VISCOELASTIC, LOAD = 0.25, 0.04, 0.015, 25.0
SPEEDS = (20.0, 40.0, 80.0)  # mm/s
SLIP = 0.2  # sliding over rolling speed

_LEFT = ("Step Time (s)", "Pot RTD Temp (degC)", "Lube RTD Temp (degC)", "Ball Load (N)", "Pin Load (N)", "Wear (um)")
_SPEEDS = tuple(f"{body} Speed {place}" for body in ("Ball", "Disc") for place in (1, 2, 3, 4))
_MEANS = ("Disc Frequency (Hz)", "Rolling Speed (mm/s)", "Sliding Speed (mm/s)", "SRR (%)")
_FORCES = ("TF1 (N)", "TF2 (N)", "TF3 (N)", "TF4 (N)", "Traction Force (N)", "Traction Coeff (-)")
_RIGHT = ("Rolling Force (N)", "Rolling Coeff (-)", "Traction Trace (-)")
#: What an ETM does not print.
_MTM_ONLY = frozenset({"Pin Load (N)", "ECR (%)", "Disc Frequency (Hz)"})


def columns(x: str = "Step Time (s)", machine: str = "MTM") -> list[str]:
    """Return the headings of a table: what is plotted, blanks, then everything in its own place."""
    names = [x, "Traction Coeff (-)", *[""] * 6, *_LEFT, "ECR (%)", "", *_SPEEDS, *_MEANS, "", *_FORCES, *_RIGHT]
    return [name for name in names if machine == "MTM" or name not in _MTM_ONLY]


def force(disc: float, ball: float, load: float = LOAD) -> float:
    """Return what the force cell reads, N."""
    return float(OFFSET + load * (COULOMB * np.sign(disc - ball) + VISCOELASTIC * np.sign(disc)))


def row(
    headings: Sequence[str],
    time: float,
    speed: float,
    signals: int,
    *,
    temperature: float = 40.0,
    pin: bool = False,
    slip: float = SLIP,
) -> list[str]:
    """Return the cells of one row: `signals` is 0 for Traction Force only, 2 or 4."""
    fast, slow = speed * (1 + slip / 2), speed * (1 - slip / 2)
    pairs = [(fast, slow), (slow, fast), (fast, slow), (slow, fast)][: max(signals, 1)]  # disc, ball
    senses = [1, 1, -1, -1]
    cells = {"Step Time (s)": f"{time:g}", "Pot RTD Temp (degC)": f"{temperature + 2:.1f}", "Wear (um)": "-33"}
    cells["Lube RTD Temp (degC)"] = f"{temperature:.1f}"
    cells["Pin Load (N)" if pin else "Ball Load (N)"] = f"{LOAD:.3f}"
    for place, (disc, ball) in enumerate(pairs, start=1):
        cells[f"Disc Speed {place}"] = f"{disc:.2f}"
        if not pin:
            cells[f"Ball Speed {place}"] = f"{ball:.2f}"
    forces = [force(sense * disc, sense * ball) for sense, (disc, ball) in zip(senses, pairs, strict=False)]
    traction = (forces[0] - forces[1]) / 2 if signals else forces[0]
    for place, value in enumerate(forces if signals else [], start=1):
        cells[f"TF{place} (N)"] = f"{value:.4f}"
    cells["Rolling Speed (mm/s)"], cells["Sliding Speed (mm/s)"] = f"{speed:.2f}", f"{slip * speed:.2f}"
    cells["SRR (%)"] = f"{100 * slip:.3f}"
    cells["Traction Force (N)"], cells["Traction Coeff (-)"] = f"{traction:.4f}", f"{abs(traction) / LOAD:.4f}"
    return [cells.get(name, "") for name in headings]


def step(number: int, kind: str, lines: Sequence[str], clock: str, description: str = "made up") -> list[str]:
    """Return the lines of one step."""
    return [
        f"Step {number} started at 23/03/2018 {clock}",
        f"Step type\t{kind}\tStep description\t{description}",
        f"Zero traction force (N)\t{OFFSET:.4f}\t(measured at the start of this step)",
        *lines,
        "",
    ]


def table(signals: int, x: str = "Step Time (s)", machine: str = "MTM", **more: float) -> list[str]:
    """Return track radius, headings and one row for each speed."""
    headings = columns(x, machine)
    rows = [row(headings, 10.0 * place, speed, signals, **more) for place, speed in enumerate(SPEEDS, start=1)]
    return ["Disc track radius used for this step (mm)\t21.232", *("\t".join(cells) for cells in [headings, *rows])]


def mtm() -> list[str]:
    """Return an MTM's test: a picture, a timed step, slip reversed, both directions, a pin."""
    return [
        "MTM311 Test Data File",
        "Profile description:\tsynthetic profile",
        "Lubricant name:\tnone",
        "Comments:",
        "",
        "Number of steps in profile:\t5",
        "Number of steps completed:\t5",
        "Test started at 23/03/2018 10:00:00",
        "",
        *step(1, "MAPPER", ["Camera window load = 24.9 N", "Selector centre = (502,468)"], "10:00:05"),
        *step(2, "BOD_TIMED", table(0), "10:01:00", "timed"),
        *step(3, "TRACTION", table(2, "SRR (%)"), "10:02:00", "slip reversed"),
        *step(4, "BIDIRECTIONAL", table(4), "10:03:00", "both directions"),
        *step(5, "POD_TIMED", table(0, pin=True), "10:04:00", "a pin"),
        "All steps completed, test completed normally at 23/03/2018 10:05:00",
    ]


def etm() -> list[str]:
    """Return an ETM's test, which begins with a step and no more."""
    return [
        *step(1, "Mapper", [], "10:00:05", "500"),
        *step(2, "Traction", table(2, "SRR (%)", "ETM"), "10:01:00", "20-00-20%"),
        *step(3, "Traction", table(2, "SRR (%)", "ETM", temperature=60.0), "10:02:00", "20-00-20%"),
    ]


def delimited() -> list[str]:
    """Return a table of one's own with every column that may be there."""
    names = ["step", "replicate", "temperature (degC)", "disc speed (mm/s)", "ball speed (mm/s)", "load (N)"]
    lines = [",".join([*names, "traction force (N)", "zero force (N)", "time (s)", "track radius (mm)"])]
    for place, speed in enumerate(SPEEDS):
        for disc, ball in ((1.1 * speed, 0.9 * speed), (0.9 * speed, 1.1 * speed)):
            lines.append(f"1,1,40,{disc:g},{ball:g},{LOAD:g},{force(disc, ball):g},{OFFSET:g},{5 + place},21.2")
    return lines


def write(folder: Path, lines: Sequence[str], name: str = "test.txt", end: str = "\r\n", start: bytes = b"") -> Path:
    """Write lines as a file; CRLF as the instrument does, unless told otherwise."""
    path = folder / name
    path.write_bytes(start + (end.join(lines) + end).encode())
    return path


#: Name of the sample -> function that writes it into a folder and returns its path.
TRACTION_SAMPLES: dict[str, Callable[[Path], Path]] = {
    "MTM": lambda folder: write(folder, mtm(), "mtm.txt"),
    "ETM": lambda folder: write(folder, etm(), "etm.txt", end="\n", start=b"\xef\xbb\xbf"),
    "decimal comma": lambda folder: write(folder, [line.replace(".", ",") for line in mtm()], "comma.txt"),
    "delimited": lambda folder: write(folder, delimited(), "runs.csv", end="\n"),
}
