"""Binary files of an MTM or ETM, from the layout that a public parser documents: no genuine file was at hand."""

from __future__ import annotations

import struct
from datetime import datetime
from pathlib import Path

#: Time, lube, pot, load, wear, (ECR,) ball 1 and 2, disc 1 and 2, rolling, sliding, SRR, TF1, TF2, force, coefficient.
PAIRS = [
    (1.0, 30.1, 30.5, 25.0, 0.0, 90.0, 110.0, 110.0, 90.0, 100.0, 20.0, 20.0, 1.5, -0.7, 1.1, 0.044),
    (2.0, 30.2, 30.5, 25.0, 0.0, 190.0, 210.0, 210.0, 190.0, 200.0, 20.0, 10.0, 1.4, -0.8, 1.1, 0.044),
]
TIMED = [(1.0, 30.1, 30.5, 25.0, 0.0, 90.0, 110.0, 100.0, 20.0, 20.0, 1.3, 0.052)]

#: Of tenths of a microsecond since year 1, as local time.
_LOCAL = 2 << 62
SAMPLES: dict = {}


def text(words: str) -> bytes:
    """Return a text with its length before it."""
    raw, length = words.encode(), b""
    left = len(raw)
    while left > 127:
        length += bytes([left & 127 | 128])
        left >>= 7
    return length + bytes([left]) + raw


def moment(when: datetime) -> bytes:
    """Return a date."""
    return struct.pack("<Q", _LOCAL | int((when - datetime(1, 1, 1)).total_seconds()) * 10_000_000)


def header(steps: int, *, etm: bool = False, comments: str = "synthetic") -> bytes:
    """Return what precedes the steps."""
    start = datetime(2018, 3, 23, 10, 2, 57)
    texts = b"".join(map(text, ("test.mtmd", "profile.mtmp", "two slips", "none", comments)))
    return (
        bytes([1 if etm else 2, 0, 0, 0])
        + texts
        + struct.pack("<I", steps)
        + moment(start)
        + text("All steps completed")
        + moment(start)
        + struct.pack("<I", steps)
    )


def step(code: int, name: str, points: list[tuple[float, ...]], *, etm: bool = False, zero: float = 0.25) -> bytes:
    """Return a step with its points: all columns as printed."""
    start = datetime(2018, 3, 23, 10, 11, 45)
    head = struct.pack("<II", code, 3 if etm else 2) + text(name) + moment(start) + struct.pack("<Q", 0)
    head += struct.pack("<dB", zero, 1) + bytes(5) + struct.pack("<d", 21.0) + (bytes(2) if etm else b"")
    rows = b"".join(moment(start) + struct.pack(f"<{len(row)}d", *row) for row in points)
    return head + struct.pack("<II", 1, len(points)) + rows


def mapper(*, etm: bool = False, zero: bool = True) -> bytes:
    """Return a mapper step, which holds a picture."""
    start = datetime(2018, 3, 23, 10, 5, 0)
    head = struct.pack("<II", 3 if etm else 8, 3 if etm else 2) + text("picture") + moment(start) + struct.pack("<Q", 0)
    head += struct.pack("<dB", -0.5, 1) + bytes(15 if etm else 13) + struct.pack("<Id", 2, 49.7) + text("a.png")
    return head + (b"\x01" + struct.pack("<IIId", 502, 468, 20, 137.0) if zero else b"\x00")


def with_ecr(rows: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    """Return rows with the contact resistance that an MTM records."""
    return [(*row[:5], 0.0, *row[5:]) for row in rows]


def write(folder: Path, *, etm: bool = False, comments: str = "synthetic") -> Path:
    """Write a test: pictures, a Stribeck step with the slip reversed, a timed step."""
    convert = list if etm else with_ecr
    steps = (
        mapper(etm=etm),
        step(1, "sweep", convert(PAIRS), etm=etm),
        mapper(etm=etm, zero=False),
        step(2, "held", convert(TIMED), etm=etm),
    )
    path = folder / ("a.etmd" if etm else "a.mtmd")
    path.write_bytes(header(len(steps), etm=etm, comments=comments) + b"".join(steps))
    return path


BINARY_SAMPLES = {"binary MTM": write, "binary ETM": lambda folder: write(folder, etm=True)}
