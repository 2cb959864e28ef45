"""Synthetic Universal Analysis files of a Q800: text in any encoding, and binary; written from the layout alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .rubber import points

#: Signals of a Q800 in the order that its software prints them by default.
SIGNALS = (
    "Time (min)",
    "Temperature (°C)",
    "Storage Modulus (MPa)",
    "Loss Modulus (MPa)",
    "Stiffness (N/m)",
    "Tan Delta",
    "Frequency (Hz)",
    "Drive Force (N)",
    "Amplitude (µm)",
    "Strain (%)",
    "Static Force (N)",
    "Position (mm)",
)
STRAIN = 0.0523  # %
CLAMP = "Clamp: Tension: Film"


def columns(of=points) -> dict[str, list[float]]:
    """Return what the instrument would have measured, by signal."""
    rows = of()
    n = len(rows)
    temperature, frequency, storage, loss = (list(column) for column in zip(*rows, strict=True))
    return {
        "Time (min)": [0.5 + 0.7 * k for k in range(n)],
        "Temperature (°C)": temperature,
        "Storage Modulus (MPa)": [value / 1e6 for value in storage],
        "Loss Modulus (MPa)": [value / 1e6 for value in loss],
        "Stiffness (N/m)": [value / 3e3 for value in storage],
        "Tan Delta": [b / a for a, b in zip(storage, loss, strict=True)],
        "Frequency (Hz)": frequency,
        "Drive Force (N)": [0.11] * n,
        "Amplitude (µm)": [5.0] * n,
        "Strain (%)": [STRAIN] * n,
        "Static Force (N)": [0.01] * n,
        "Position (mm)": [12.4] * n,
    }


def header(signals, clamp=CLAMP, separator="\t", method="Temp Step / Freq Sweep") -> list[str]:
    """Return the lines of tag and value before the data."""
    lines = [
        ("Version", "2.0"),
        ("Language", "English"),
        ("Mode", "DMA Multi-Frequency - Strain"),
        ("Run", "1"),
        ("Instrument", "DMA Q800 V21.1 Build 51"),
        ("Module", "DMA Multi-Frequency - Strain"),
        ("Operator", ""),
        ("ProcName", "Temp Step / Freq Sweep"),
        ("Sample", "synthetic rubber, sheared at the calender"),  # what a user writes says nothing of the clamp
        ("Size", "12.4000 x 5.2100 x 1.0300 mm"),
        ("Method", method),
        ("Xcomment", "Gas1: Air"),
        ("Xcomment", clamp),
        ("Nsig", str(len(signals))),
        *((f"Sig{k}", name) for k, name in enumerate(signals, start=1)),
        ("Date", "2026-03-09"),
        ("Time", "10:48:37"),
        ("OrgMethod", "1: Equilibrate at -10.00 °C"),
        ("OrgMethod", "2: Isothermal for 5.00 min"),
        ("OrgMethod", "3: Frequency sweep"),
    ]
    return ["CLOSED", *(f"{tag}{separator}{value}" for tag, value in lines)]


def text_lines(signals=SIGNALS, events=(0, 5), comma=False, of=points, **reported) -> list[str]:
    """Return the lines of a text export, with rows of events before the points of the numbers given."""
    values = columns(of)
    lines = [*header(signals, **reported), "StartOfData"]
    for k in range(len(values["Time (min)"])):
        if k in events:
            lines.append("\t".join(["-1.0000000", *["0.0000000"] * (len(signals) - 1)]))
        lines.append("\t".join(f"{values[name][k]:.9G}" for name in signals))
    return [line.replace(".", ",") if comma and line[:1] in "-0123456789" else line for line in lines]


def write_text(folder: Path, encoding="utf-16", name="q800.txt", **how) -> Path:
    """Write a text export; "utf-16" begins with its mark."""
    path = folder / name
    path.write_bytes("\r\n".join([*text_lines(**how), ""]).encode(encoding))
    return path


def binary(signals=SIGNALS, closed=True, footer=b"\x07\x00footer", of=points, **reported) -> bytes:
    """Return a binary file: header in UTF-16, marker, records, a record with negative time, and some bytes more."""
    values = columns(of)
    records = np.array([values[name] for name in signals], dtype="<f4").T
    head = "\r\n".join(header(signals, separator=" ", **reported)).encode("utf-16-le")
    end = np.full(len(signals), -1.0, dtype="<f4").tobytes() + footer if closed else b""
    return b"\xff\xfe" + head + b"\r\0\n\0\f\0" + b"\x01" + records.tobytes() + end


def write_binary(folder: Path, name="q800.001", **how) -> Path:
    """Write a binary file."""
    path = folder / name
    path.write_bytes(binary(**how))
    return path


SAMPLES = {
    "Universal Analysis text, UTF-16": write_text,
    "Universal Analysis text, Latin-1, decimal commas": lambda folder: write_text(folder, "latin-1", comma=True),
    "Q800 binary": write_binary,
}
