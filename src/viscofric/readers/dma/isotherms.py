"""Isotherms from the points of files: grouped, sorted and averaged, with notes on what is doubtful."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from viscofric.arrays import Indices
from viscofric.data import DEFORMATIONS, Deformation, Isotherm, IsothermalSweeps
from viscofric.errors import DataFileError, InputError, check_choice, short_notes
from viscofric.notes import Note, note_of
from viscofric.readers.dma.checks import usable
from viscofric.readers.dma.grouping import ISOTHERM_GAP, isotherm_groups
from viscofric.readers.dma.readings import Points, Readings, Sorted, at, joined, listed
from viscofric.readers.dma.sweep_checks import notes_on, of_one_amplitude

#: Frequencies closer than this (relative) are the same, printed or measured twice.
SAME_FREQUENCY = 1e-4
#: Repeated readings that differ by more than this get a note.
REPEATS_DIFFER = 0.02


@dataclass(frozen=True, eq=False)
class TracedSweeps:
    """Sweeps with all readings, those left out included.

    `points` are the readings of all files in one row, `isotherms` their assignment.  If `deformation_known` is false,
    neither files nor caller decide between tension and shear: the moduli count as tensile for a first look only.
    """

    sweeps: IsothermalSweeps
    readings: tuple[Readings, ...]
    points: Points
    isotherms: tuple[Sorted, ...]
    deformation_known: bool

    @property
    def left_out(self) -> Indices:
        """Rows of `points` that are in no isotherm; the notes of the sweeps give the reasons."""
        used = np.concatenate([one.rows for one in self.isotherms])
        return np.setdiff1d(np.arange(len(self.points)), used)


def traced_sweeps(readings: Sequence[Readings], deformation: Deformation | None = None) -> TracedSweeps:
    """Sort the points of one or several files of one specimen into isotherms, and keep their assignment."""
    # The notes of the sweeps report what was left out, averaged or reordered, and what is doubtful: drifting
    # temperatures, outliers, strain amplitudes that differ between isotherms.
    if not readings:
        raise InputError("at least one file of DMA sweeps is needed.", code="no-files")
    source, kind, opened = opening(readings, deformation)
    points = joined(readings)
    keep, on_left_out = usable(points, source)
    groups, on_groups = isotherm_groups(points, keep, source)
    single = [of_one_amplitude(points, rows, source) for rows in groups]
    sweeps = [_isotherm(points, rows) for rows, _ in single]
    notes: list[Note] = [
        *opened,
        *on_left_out,
        *on_groups,
        *(note for _, some in single for note in some),
        *_on_order(points, keep, sweeps, len(readings)),
        *notes_on(points, sweeps),
    ]
    formats = list(dict.fromkeys(one.format for one in readings))
    isotherms = tuple(one.isotherm for one in sweeps)
    known = deformation is not None or any(one.deformation is not None for one in readings)
    found = IsothermalSweeps(isotherms, kind, source, short_notes(notes), ", ".join(formats))
    return TracedSweeps(found, tuple(readings), points, tuple(sweeps), known)


def opening(readings: Sequence[Readings], deformation: Deformation | None) -> tuple[str, Deformation, list[Note]]:
    """Return the name of the files, the kind of deformation, and the notes on both and of the readers."""
    kind, on_deformation = _deformation(readings, deformation)
    return _source(readings), kind, [*_on_formats(readings), *on_deformation, *_own_notes(readings)]


def _source(readings: Sequence[Readings]) -> str:
    names = [one.source for one in readings]
    return ", ".join(names) if len(names) <= 3 else f"{names[0]} and {len(names) - 1} more files"


def _names(readings: Sequence[Readings]) -> str:
    names = [Path(one.source).name for one in readings]
    return listed(names[:3], len(names) - 3) if len(names) > 3 else listed(names)


def _on_formats(readings: Sequence[Readings]) -> list[Note]:
    formats = list(dict.fromkeys(one.format for one in readings))
    if len(formats) == 1:
        what = "Read" if len(readings) == 1 else f"All {len(readings)} files were read"
        return [Note("format", f"{what} as {formats[0]}.")]
    taken = [(name, [one for one in readings if one.format == name]) for name in formats]
    return [Note("format", "; ".join(f"{_names(some)} read as {name}" for name, some in taken) + ".")]


def _own_notes(readings: Sequence[Readings]) -> list[Note]:
    """Return the notes of the readers; a note that several files share appears once."""
    if len(readings) == 1:
        return list(map(note_of, readings[0].notes))
    shared: dict[Note, list[Readings]] = {}
    for one in readings:
        for note in map(note_of, one.notes):
            shared.setdefault(note, []).append(one)
    return [note.at("All files" if len(some) == len(readings) else _names(some)) for note, some in shared.items()]


def _deformation(readings: Sequence[Readings], given: Deformation | None) -> tuple[Deformation, list[Note]]:
    """Decide between shear and the deformations that give E: by the files, else by the caller."""
    if given is not None:
        check_choice(given, "deformation", *DEFORMATIONS)
    said = [one for one in readings if one.deformation is not None]
    if not said:
        if given is not None:
            note = f"The moduli were read as measured in {given}, as requested; the file does not state it."
            return given, [Note("deformation-given", note), *_assumed(given)]
        note = Note(
            "deformation-unknown",
            "The file does not state whether its moduli are tensile or shear; shown as tensile until this is known.",
        )
        return "tension", [note]
    # headings with E say no more than that it is not shear
    first = next((one for one in said if one.deformation != "tension"), said[0])
    kind = first.deformation or "tension"
    by = f" ({first.said_by})" if first.said_by else ""
    other = next((one for one in said if (one.deformation == "shear") != (kind == "shear")), None)
    if other is not None:
        other_by = f" ({other.said_by})" if other.said_by else ""
        problem = f"states {other.deformation}{other_by}, but {first.source} states {kind}{by}; read them separately."
        raise DataFileError(other.source, problem, code="deformation-contradicts")
    if given is not None and (given == "shear") != (kind == "shear"):
        raise DataFileError(
            first.source,
            f"the header states {kind}{by}, but deformation={given!r} was requested.",
            code="deformation-contradicts",
        )
    notes = [Note("deformation", f"The file's header states that the moduli were measured in {kind}{by}.")]
    if given not in (None, kind):
        kind = given
        notes = [Note("deformation-given", f"The file states moduli E{by}; measured in {kind}, as requested.")]
    notes += _assumed(kind)
    silent = [one for one in readings if one.deformation is None]
    if silent:
        text = f"{_names(silent)}: no statement whether the moduli are tensile or shear; read as {kind}."
        notes.append(Note("deformation-not-said", text))
    return kind, notes


def _assumed(kind: Deformation) -> list[Note]:
    """Return what is assumed of moduli that the instrument computed from forces in compression or bending."""
    if kind == "compression":
        said = (
            "Moduli in compression are used as the instrument reports them, as Young's moduli: the specimen is assumed "
            "to slide freely on its plates; a flat specimen that sticks to them appears stiffer than its material."
        )
        return [Note("compression-assumed", said)]
    if kind == "bending":
        said = (
            "Moduli in bending are used as the instrument reports them, as Young's moduli: its beam formula is assumed "
            "to correct for shear and, in cantilevers, for the clamps."
        )
        return [Note("bending-assumed", said)]
    return []


def _isotherm(points: Points, rows: Indices) -> Sorted:
    """Sort one isotherm by frequency and average repeats."""
    frequency = points.angular_frequency[rows]
    order = np.argsort(frequency, kind="stable")
    ordered = frequency[order]
    group = np.concatenate([[0], np.cumsum(np.diff(ordered) > SAME_FREQUENCY * ordered[1:])])
    count = np.bincount(group)
    columns = (points.angular_frequency, points.storage_modulus, points.loss_modulus)
    mean_frequency, storage, loss = (np.bincount(group, column[rows][order]) / count for column in columns)
    amplitude = points.strain_amplitude[rows][order]
    known = np.isfinite(amplitude)
    mean_amplitude = None
    if known.any():
        total = np.bincount(group, np.where(known, amplitude, 0.0))
        known_count = np.bincount(group, known)
        mean_amplitude = np.where(known_count > 0, total / np.maximum(known_count, 1), np.nan)
    isotherm = Isotherm(float(np.mean(points.temperature[rows])), mean_frequency, storage, loss, mean_amplitude)
    origins = tuple(np.split(rows[order], np.cumsum(count)[:-1]))
    return Sorted(isotherm, rows, origins)


def _on_order(points: Points, keep: Indices, sweeps: Sequence[Sorted], files: int) -> list[Note]:
    """Return notes on sorting and averaging."""
    notes = []
    unsorted = [one for one in sweeps if np.any(np.diff(points.angular_frequency[one.rows]) < 0)]
    averaged = [one for one in sweeps if len(one.rows) > len(one.origins)]
    if unsorted:
        there = [one.isotherm.temperature for one in unsorted]
        said = f"The rows {at(there)} were sorted by frequency."
        notes.append(Note("sorted", said, values={"temperatures": there}))
    if averaged:
        repeated = sum(len(one.rows) - len(one.origins) for one in averaged)
        what = "1 repeated frequency" if repeated == 1 else f"{repeated} repeated frequencies"
        were = "was" if repeated == 1 else "were"
        there = [one.isotherm.temperature for one in averaged]
        values = {"repeated": repeated, "temperatures": there}
        notes.append(Note("averaged", f"{what} {at(there)} {were} averaged.", values=values))
        again = [one.isotherm.temperature for one in averaged if all(len(rows) > 1 for rows in one.origins)]
        if again:
            said = f"All frequencies {at(again)} were measured more than once, as in repeated sweeps."
            notes.append(Note("measured-again", said))
        worst, kelvin = max(_disagreement(points, one) for one in averaged)
        if worst > REPEATS_DIFFER:
            said = f"Repeated readings differ by up to {100 * worst:.0f} % of their modulus {at([kelvin])}."
            notes.append(Note("repeats-differ", said))
    if files == 1 and np.any(np.diff(points.temperature[keep]) < -ISOTHERM_GAP):
        notes.append(Note("sorted", "The isotherms were sorted by temperature."))
    return notes


def _disagreement(points: Points, one: Sorted) -> tuple[float, float]:
    """Return the largest relative difference of repeated readings of |E*|, and the temperature, K."""
    size = np.hypot(points.storage_modulus, points.loss_modulus)
    worst = max(float(np.ptp(size[rows]) / np.mean(size[rows])) for rows in one.origins)
    return worst, one.isotherm.temperature
