"""Binary files of PCS Instruments' MTM (.mtmd) and ETM (.etmd), as a public parser documents them.

The file is turned into the text export that the instrument's software would write, so that both are read alike.
The layout is that of A. MacLaren's ``mtmd2json`` (github.com/AlexanderMacL); no genuine file was at hand.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, replace
from datetime import datetime, timedelta

from viscofric.errors import DataFileError
from viscofric.readers.mtm import pcs_text
from viscofric.readers.mtm.readings import Thermometer, TractionReadings
from viscofric.readers.source import Source

NAME = "a binary file of PCS Instruments' MTM or ETM"

_MAGIC = {b"\x02\x00\x00\x00": "MTM", b"\x01\x00\x00\x00": "ETM"}
#: Kinds of steps by the version of the step and their code.
_STEPS = {
    2: {0: "Traction", 1: "Stribeck", 2: "Timed", 8: "Mapper"},
    3: {0: "Traction", 1: "Stribeck", 2: "Timed", 3: "Mapper"},
}
#: Bytes of a mapper step that are no part of its text export.
_SKIPPED = {"MTM": 13, "ETM": 15}
_LONGEST_TEXT, _MOST_STEPS, _MOST_POINTS = 10_000, 10_000, 1_000_000
#: Dates count tenths of a microsecond from year 1; the two highest bits are the kind of clock.
_TICKS, _KIND = 10_000_000, (1 << 62) - 1
_PAIRED = ("Ball Speed 1", "Ball Speed 2", "Disc Speed 1", "Disc Speed 2")
_SLIP = ("Rolling Speed (mm/s)", "Sliding Speed (mm/s)", "SRR (%)")
_FORCE = ("Traction Force (N)", "Traction Coeff (-)")


class _TornError(Exception):
    """The file ends too early, or holds what the layout does not allow."""


@dataclass
class _Bytes:
    """A place in the content of a file, moved on by each value that is taken."""

    data: bytes
    place: int = 0

    def take(self, form: str) -> tuple[float, ...]:
        """Return values of a `struct` format, little-endian."""
        size = struct.calcsize(f"<{form}")
        if self.place + size > len(self.data):
            raise _TornError
        found = struct.unpack_from(f"<{form}", self.data, self.place)
        self.place += size
        return found

    def whole(self, form: str = "I") -> int:
        """Return one whole number."""
        return int(self.take(form)[0])

    def text(self) -> str:
        """Return a text with its length before it, seven bits a byte."""
        length = shift = 0
        while True:
            byte = self.whole("B")
            length |= (byte & 127) << shift
            shift += 7
            if not byte & 128:
                break
            if shift > 28:
                raise _TornError
        if length > _LONGEST_TEXT:
            raise _TornError
        return " ".join(self.raw(length).decode("utf-8", errors="replace").split())

    def raw(self, length: int) -> bytes:
        """Return so many bytes."""
        if self.place + length > len(self.data):
            raise _TornError
        self.place += length
        return self.data[self.place - length : self.place]

    def moment(self) -> str:
        """Return a date and time as the text export prints it, empty if there is none."""
        ticks = self.whole("Q") & _KIND
        try:
            return f"{datetime(1, 1, 1) + timedelta(seconds=ticks // _TICKS):%d/%m/%Y %H:%M:%S}"
        except (OverflowError, ValueError):
            raise _TornError from None


def recognises(source: Source) -> bool:
    """Return whether the file begins as such a file does."""
    instrument = _MAGIC.get(source.data[:4])
    if instrument is None:
        return False
    try:
        _header(_Bytes(source.data, 4), instrument)
    except _TornError:
        return False
    return True


def read(source: Source, thermometer: Thermometer) -> TractionReadings:
    """Return the readings as `pcs_text.read` does, or raise `DataFileError` with how to export the test."""
    instrument = _MAGIC[source.data[:4]]
    found = _Bytes(source.data, 4)
    try:
        lines, steps = _header(found, instrument)
        for number in range(1, steps + 1):
            lines += _step(found, instrument, number)
    except _TornError:
        problem = (
            f"is a binary file of an {instrument}, of which byte {found.place} and those after it cannot be read; "
            "save the test as text in the instrument's software, and read that file."
        )
        raise DataFileError(source.path, problem, code="damaged") from None
    return pcs_text.read(replace(source, data="\n".join(lines).encode()), thermometer)


def _header(found: _Bytes, instrument: str) -> tuple[list[str], int]:
    """Return the lines above the steps and the number of completed steps."""
    texts = [found.text() for _ in range(5)]
    planned = found.whole()
    started, status, _ = found.moment(), found.text(), found.moment()
    completed = found.whole()
    if max(planned, completed) > _MOST_STEPS:
        raise _TornError
    labels = ("Output file name:", "Profile file name:", "Profile description:", "Lubricant name:", "Comments:")
    lines = [f"{instrument} Test Data File", *(f"{label}\t{text}" for label, text in zip(labels, texts, strict=True))]
    return [*lines, f"Test started at {started}", f"Status:\t{status}"], completed


def _step(found: _Bytes, instrument: str, number: int) -> list[str]:
    """Return the lines of one step."""
    code, version = found.whole(), found.whole()
    kind = _STEPS.get(version, {}).get(code)
    if kind is None:
        raise _TornError
    name, started = found.text(), found.moment()
    found.take("Q")  # duration of a timed step
    zero, _ = found.take("dB")
    lines = ["", f"Step {number} started at {started}", f"Step type\t{kind}\tStep description\t{name}"]
    lines.append(f"Zero traction force (N)\t{zero!r}")
    if kind == "Mapper":
        _pass_over_picture(found, instrument)
        return lines
    found.take("5B")
    (radius,) = found.take("d")
    found.take("2B" if instrument == "ETM" else "0B")
    points = _expected(found, 1)
    if points > _MOST_POINTS:
        raise _TornError
    paired = kind in ("Traction", "Stribeck")
    first = ["Step Time (s)", "Lube RTD Temp (degC)", "Pot RTD Temp (degC)", "Ball Load (N)", "Wear (um)"]
    first += ["ECR (%)"] if instrument == "MTM" else []
    speeds, forces = (_PAIRED, ("TF1 (N)", "TF2 (N)")) if paired else (("Ball Speed 1", "Disc Speed 1"), ())
    names = [*first, *speeds, *_SLIP, *forces, *_FORCE]
    lines += [f"Disc track radius used for this step (mm)\t{radius!r}", "\t".join(names)]
    for _ in range(points):
        found.take("Q")  # the clock
        lines.append("\t".join(map(repr, found.take(f"{len(names)}d"))))
    return lines


def _expected(found: _Bytes, mark: int) -> int:
    """Return the number after a mark."""
    if found.whole() != mark:
        raise _TornError
    return found.whole()


def _pass_over_picture(found: _Bytes, instrument: str) -> None:
    found.raw(_SKIPPED[instrument])
    if found.whole() != 2:
        raise _TornError
    found.take("d")
    found.text()
    if found.whole("B") == 1:
        found.take("IIId")
