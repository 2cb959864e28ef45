"""DMA files of TA Instruments' Universal Analysis (Q800 and its kin): text exports and the binary files themselves.

Both begin with the same header: ``CLOSED``, the version, lines of tag and value, ``Nsig`` and the list of signals
``Sig1`` … with their units, which alone identifies the columns.  In the text export ``StartOfData`` and
tab-separated rows follow, of which those with a negative time mark events.  The binary file holds its header as
UTF-16, then little-endian float32 records of one number per signal, up to the first record with a negative time.

No genuine DMA file of either was available: the readers were written from descriptions of the layout and tested on
files written from them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viscofric.arrays import Array
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.instruments.ta_steps import StepText, readings_of, steps_of
from viscofric.readers.dma.names import TIME
from viscofric.readers.dma.readings import Readings
from viscofric.readers.source import Source

#: Number of a line or a record, and its cells.
Row = tuple[int, list[str]]

NAME = "TA Instruments Universal Analysis (Q800) text or binary"

_UTF16 = b"\xff\xfe"
#: Ends the header of a binary file: end of line and form feed in UTF-16; one more byte follows.
_END_OF_HEADER = b"\r\0\n\0\f\0"
_FIRST_LINES = re.compile(r"\s*CLOSED\s*[\r\n]+\s*Version\b", re.IGNORECASE)
#: Tags in which the instrument, not the user, may name the clamp.
_CLAMP_TAGS = re.compile(r"mode|module|xcomment|.*(clamp|geometry|fixture).*", re.IGNORECASE)


def recognises(source: Source) -> bool:
    """Return whether the file begins with ``CLOSED`` and ``Version``."""
    start = source.data[:200]
    wide = start.startswith((_UTF16, b"\xfe\xff"))
    text = start.decode("utf-16" if wide else "utf-8-sig", "replace")
    return bool(_FIRST_LINES.match(text.replace("\0", "")))


def read(source: Source) -> Readings:
    """Return all points that oscillate."""
    end = _end_of_header(source.data)
    notes: list[str] = []
    if end < 0:
        kind = "TA Instruments Universal Analysis text"
        header, rows = _split(source.path, source.text or "")
        names, units = _signals(source.path, header)
        rows, where = _measured(source.path, len(names), rows, notes), "line"
    else:
        kind = "TA Instruments Q800 binary"
        start = len(_UTF16) if source.data.startswith(_UTF16) else 0
        header = [_tag(line) for line in source.data[start:end].decode("utf-16-le", "replace").splitlines()]
        names, units = _signals(source.path, header)
        rows, where = _records(len(names), source.data[end + len(_END_OF_HEADER) + 1 :], notes), "record"
    step = steps_of(source.path, [StepText(_title(header), names, units, rows)], where)[0]
    step = replace(step, named_by_instrument=False)
    if not step.has_moduli:
        instrument = next((value for tag, value in header if tag.lower() == "instrument"), "the instrument")
        problem = f"contains no storage modulus, loss modulus and frequency; {instrument} wrote {', '.join(names)}."
        raise DataFileError(source.path, problem, code="missing-columns")
    tools = [(tag, value) for tag, value in header if _CLAMP_TAGS.fullmatch(tag)]
    # The file does not separate the steps of its programme.
    return replace(readings_of(source, kind, [step], tools, notes), step=None)


def _end_of_header(data: bytes) -> int:
    """Return where the header of a binary file ends, or -1; the marker begins at a whole UTF-16 character."""
    if b"\0" not in data[:20]:
        return -1
    place = data.find(_END_OF_HEADER)
    while place >= 0 and place % 2:
        place = data.find(_END_OF_HEADER, place + 1)
    return place


def _tag(line: str) -> tuple[str, str]:
    """Part a line of the header into tag and value; exports part them by a tab, binary files by a blank."""
    tag, _, value = line.strip().replace("\t", " ", 1).partition(" ")
    return tag, value.strip()


def _split(path: str, text: str) -> tuple[list[tuple[str, str]], list[Row]]:
    """Part a text export into the tags of its header and the cells of its rows with their lines."""
    lines = re.split(r"\r\n|\r|\n", text)
    start = next((place for place, line in enumerate(lines) if line.strip().lower() == "startofdata"), None)
    if start is None:
        raise DataFileError(path, "has no line 'StartOfData'; the file ends within its header.", code="cut-short")
    body = [(number, line) for number, line in enumerate(lines[start + 1 :], start + 2) if line.strip()]
    rows = [(number, line.rstrip(" ").split("\t") if "\t" in line else line.split()) for number, line in body]
    return [_tag(line) for line in lines[:start]], rows


def _title(header: Sequence[tuple[str, str]]) -> str:
    """Name the one programme of the file by its method."""
    found = dict(reversed(header))
    return next((found[tag] for tag in ("Method", "ProcName", "Mode") if found.get(tag)), "(without a method)")


def _signals(path: str, header: Sequence[tuple[str, str]]) -> tuple[list[str], list[str]]:
    """Return names and units of the signals in the order of the columns."""
    stated = next((value for tag, value in header if tag.lower() == "nsig"), "")
    if not re.fullmatch(r"[0-9]{1,3}", stated) or int(stated) == 0:
        shown = f"'Nsig {stated[:20]}'" if stated else "no line 'Nsig'"
        problem = f"the header has {shown}; it must give the number of signals, such as 'Nsig 17'."
        raise DataFileError(path, problem, code="damaged-header")
    found = {tag.lower(): value for tag, value in header if re.fullmatch(r"sig\d+", tag, re.IGNORECASE)}
    missing = [f"Sig{k}" for k in range(1, int(stated) + 1) if f"sig{k}" not in found]
    if missing:
        raise DataFileError(
            path, f"the header states {int(stated)} signals but has no line {missing[0]!r}.", code="damaged-header"
        )
    parts = [_name_and_unit(found[f"sig{k}"]) for k in range(1, int(stated) + 1)]
    if parts[0][0].lower() not in TIME:
        problem = f"the first signal is {parts[0][0]!r}; it must be the time, whose sign marks events."
        raise DataFileError(path, problem, code="damaged-header")
    return [name for name, _ in parts], [unit for _, unit in parts]


def _name_and_unit(signal: str) -> tuple[str, str]:
    name, bracket, unit = signal.rpartition("(")
    return (name.strip(), unit.strip(") ")) if bracket and signal.endswith(")") else (signal, "")


def _measured(path: str, count: int, rows: list[Row], notes: list[str]) -> list[Row]:
    """Return the rows of a text export that are points, of so many signals."""
    measured = [row for row in rows if not row[1][0].strip().startswith(("-", "−"))]
    events = len(rows) - len(measured)
    if events:
        marks = (
            "1 row with a negative time marks an event"
            if events == 1
            else f"{events} rows with a negative time mark events"
        )
        notes.append(Note("events", f"{marks}; no point was read there."))
    if measured and rows[-1] is measured[-1] and len(rows[-1][1]) < count:
        line, _ = measured.pop()
        said = f"The last row (line {line}) is torn and was left out; the file may have been cut short."
        notes.append(Note("cut-short", said))
    for line, cells in measured:
        if len(cells) < count:
            problem = f"the row has {len(cells)} cells where the header names {count} signals."
            raise DataFileError(path, problem, line, code="row-length")
    return measured


def _records(signals: int, data: bytes, notes: list[str]) -> list[Row]:
    """Return the records of a binary file up to the end of the data, as an export would print them."""
    size = 4 * signals
    count = len(data) // size
    with np.errstate(invalid="ignore"):  # what is no number is sorted out below
        records = np.frombuffer(data[: count * size], dtype="<f4").reshape(count, signals).astype(float)
    negative = np.flatnonzero(records[:, 0] < 0)
    if negative.size:
        _note_records_behind(records, int(negative[0]), notes)
        records = records[: negative[0]]
    elif len(data) % size:
        said = f"Record {count + 1} is torn and was left out; the file may have been cut short."
        notes.append(Note("cut-short", said))
    else:
        said = "No record with a negative time closes the data; the file may have been cut short."
        notes.append(Note("cut-short", said))
    return [(number, list(map(repr, record))) for number, record in enumerate(records.tolist(), start=1)]


def _note_records_behind(records: Array, end: int, notes: list[str]) -> None:
    """Add a note if the records behind the end of the data look like data."""
    time = records[:, 0]
    last = time[end - 1] if end else 0.0
    behind = time[end + 1 :]
    like_data = int(np.sum(np.isfinite(behind) & (behind >= last) & (behind < last + 1e6)))
    if like_data:
        notes.append(
            Note(
                "records-behind-end",
                f"Record {end + 1} has a negative time and ends the data; {like_data} later records look like data "
                "and were not read.",
                values={"end": int(end) + 1, "records": int(like_data)},
            )
        )
