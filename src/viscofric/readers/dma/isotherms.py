"""Isotherms from the points of files: grouped, sorted and averaged, with notes on what is doubtful."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from viscofric.arrays import Array, Indices
from viscofric.data import DEFORMATIONS, Deformation, Isotherm, IsothermalSweeps
from viscofric.errors import DataFileError, InputError, check_choice, short_notes
from viscofric.files import on_synthetic
from viscofric.nominal import parted
from viscofric.notes import Note, note_of
from viscofric.readers.dma.checks import notes_on, of_one_amplitude, usable
from viscofric.readers.dma.readings import AS_RAMPS, Points, Readings, Sorted, at, joined
from viscofric.showing import several
from viscofric.units import Quantities, kelvin_hint, shown_celsius, to_si_array

#: Measured temperatures of one isotherm scatter by some tenths of a kelvin, programmes step by several.
ISOTHERM_GAP = 1.0  # K
#: Temperatures of sweeps that differ by no more are one; programmes step by 1 K at the least.
SAME_TEMPERATURE = 0.7  # K
#: A step of the programme whose temperature ranges no further than this is one isotherm, settling included.
ONE_STEP = 2.0  # K
#: A wider group without gaps is not one temperature but a ramp.
WIDEST_ISOTHERM = 5.0  # K
#: Largest change from point to point at a held temperature; a heated sample changes by more.  Which value separates
#: the two depends on how often points were recorded.
HELD = (0.3, 0.15, 0.08, 0.04, 0.02)  # K
#: Least number of successive frequencies at a held temperature.
SHORTEST_HOLD = 3
#: Held temperatures differ by this factor more than they vary; those of a noisy ramp do not.
APART = 3.0
#: Density of points at a held temperature over that elsewhere, within so many kelvin on either side.
CROWDED, NEAR = 2.0, 0.25  # 1, K
#: Each isotherm of a programme has at least this share of the frequencies of all.
SWEPT = 0.8
#: Least number of temperatures, with one frequency each, of a temperature sweep.
TEMPERATURE_SWEEP = 5


def isotherm_groups(points: Points, keep: Indices, source: str) -> tuple[list[Indices], list[Note]]:
    """Return the points of each isotherm, in the order of reading, and notes on points outside all of them."""
    # Points of one file and step are separated at gaps in temperature. Without a gap over more than `WIDEST_ISOTHERM`,
    # the sample was heated between its isotherms during recording: points at a held temperature are kept. Groups of
    # equal temperature, of one file or several, are one isotherm; groups of hardly any frequency, next to isotherms
    # with several, are left out.
    groups: list[Indices] = []
    moving: list[int] = []
    for block in _blocks(points, keep):
        for group in [part for wide in _by_gaps(points, block) for part in _by_repeats(points, wide)]:
            if np.ptp(points.temperature[group]) <= WIDEST_ISOTHERM:
                groups.append(group)
                continue
            held = _holds(points, group, source)
            groups += held
            moving += sorted(set(group.tolist()) - {index for one in held for index in one.tolist()})
    notes = []
    if moving:
        what = "1 point left out: its" if len(moving) == 1 else f"{len(moving)} points left out: their"
        said = f"{what} temperature was changing between two isotherms ({points.named(sorted(moving))})."
        notes.append(Note("temperature-moving", said))
    merged = _merged(points, groups)
    kept = _insist_on_several(points, merged, source)
    _insist_on_one_temperature(points, kept, source)
    notes += _on_small_groups(points, merged, kept)
    return kept, notes


def _blocks(points: Points, keep: Indices) -> list[Indices]:
    """Separate the points by file and, if known, by step."""
    keys = np.stack([points.file[keep], np.where(points.has_step[keep], points.step[keep], 0)], axis=1)
    _, which = np.unique(keys, axis=0, return_inverse=True)
    return [keep[rows] for rows in parted(np.ravel(which), 0)]


def _by_gaps(points: Points, block: Indices) -> list[Indices]:
    """Separate points at gaps between neighbours in temperature."""
    kelvin = points.temperature[block]
    if points.has_step[block[0]] and np.ptp(kelvin) <= ONE_STEP:
        return [block]
    return [np.sort(block[part]) for part in parted(kelvin, ISOTHERM_GAP)]


def _by_repeats(points: Points, group: Indices) -> list[Indices]:
    """Separate points at the widest gaps in temperature if each part has all frequencies: programmes step by 1 K."""
    # Repeated sweeps at one temperature have no such gaps and stay together.
    kelvin = points.temperature[group]
    found = parted(kelvin, SAME_TEMPERATURE)
    parts = [np.sort(group[part]) for part in found]
    gaps = [kelvin[warmer[0]] - kelvin[colder[-1]] for colder, warmer in pairwise(found)]
    wander = max(float(np.ptp(kelvin[part])) for part in found)
    if gaps and min(gaps) > APART * wander and _are_sweeps(points, parts):
        return parts
    return [group]


def _insist_on_one_temperature(points: Points, groups: list[Indices], source: str) -> None:
    """Refuse isotherms with most frequencies measured at temperatures too different to be averaged."""
    for group in groups:
        kelvin = points.temperature[group]
        same = parted(np.round(np.log(points.angular_frequency[group]), 2), 0.0)
        spans = np.array([np.ptp(kelvin[rows]) for rows in same])
        if 2 * np.count_nonzero(spans > ISOTHERM_GAP) > spans.size:
            low, high = (shown_celsius(float(f(kelvin))) for f in (np.min, np.max))
            problem = (
                f"each frequency was measured several times between {low} and {high} °C, so that the temperatures "
            )
            raise DataFileError(
                source,
                problem + "cannot be grouped into isotherms; add a column of steps.",
                code="no-isotherms",
            )


def _holds(points: Points, group: Indices, source: str) -> list[Indices]:
    """Return the runs of a heated sample's points at a held temperature."""
    for step in HELD:
        held = _stretches(points, group, step)
        if len(held) < 2 or not _lie_apart(points, held):
            continue
        if _are_sweeps(points, held) and _are_crowded(points, group, held):
            return held
    kelvin = points.temperature[group]
    low, high = float(kelvin.min()), float(kelvin.max())
    problem = (
        f"the temperatures run continuously from {shown_celsius(low)} to {shown_celsius(high)} °C, without a gap of "
        f"{ISOTHERM_GAP:g} K; isothermal sweeps are needed, not a temperature ramp"
    )
    raise DataFileError(source, problem, code="temperature-ramp", remedy=AS_RAMPS)


def _stretches(points: Points, group: Indices, step: float) -> list[Indices]:
    """Return runs of points with smaller steps between neighbours, those at one temperature joined."""
    runs = np.split(group, np.flatnonzero(np.abs(np.diff(points.temperature[group])) > step) + 1)
    held: list[Indices] = []
    for run in runs:
        if len(_printed_frequencies(points, run)) < SHORTEST_HOLD:
            continue
        if held and abs(_mean(points, run) - _mean(points, held[-1])) <= ISOTHERM_GAP:
            held[-1] = np.concatenate([held[-1], run])
        else:
            held.append(run)
    return held


def _lie_apart(points: Points, held: list[Indices]) -> bool:
    """Return whether temperatures differ much more than each varies while it is held."""
    wander = [float(np.ptp(points.temperature[run])) for run in held]
    between = [abs(_mean(points, run) - _mean(points, after)) for run, after in pairwise(held)]
    return max(wander) <= ONE_STEP and all(
        distance > APART * max(pair) for distance, pair in zip(between, pairwise(wander), strict=True)
    )


def _are_crowded(points: Points, group: Indices, held: list[Indices]) -> bool:
    """Return whether points accumulate at the held temperatures; along a ramp their density is uniform."""
    kelvin = points.temperature[group]
    near = [int(np.sum(np.abs(kelvin - _mean(points, run)) <= NEAR)) for run in held]
    rest = max(len(group) - sum(len(run) for run in held), 0)
    per_window = rest * 2.0 * NEAR / float(np.ptp(kelvin))
    return min(near) >= CROWDED * per_window


def _are_sweeps(points: Points, held: list[Indices]) -> bool:
    """Return whether nearly the same frequencies, three or more, were swept at each temperature."""
    swept = [_printed_frequencies(points, run) for run in held]
    programme = len(np.unique(np.concatenate(swept)))
    return all(len(one) >= max(SHORTEST_HOLD, SWEPT * programme) for one in swept)


def _mean(points: Points, rows: Indices) -> float:
    return float(np.mean(points.temperature[rows]))


def _merged(points: Points, groups: list[Indices]) -> list[Indices]:
    """Join groups of equal mean temperature, ascending."""
    means = [_mean(points, group) for group in groups]
    alike: list[list[Indices]] = []
    first = -np.inf
    for number in np.argsort(means, kind="stable"):
        if means[number] - first <= SAME_TEMPERATURE:
            alike[-1].append(groups[number])
        else:
            first = means[number]
            alike.append([groups[number]])
    return [np.sort(np.concatenate(some)) for some in alike]


def _printed_frequencies(points: Points, group: Indices) -> Array:
    """Return the frequencies of a group once each (logarithms, rounded to what is printed)."""
    return np.unique(np.round(np.log(points.angular_frequency[group]), 2))


def _insist_on_several(points: Points, groups: list[Indices], source: str) -> list[Indices]:
    """Leave out groups of one or two frequencies next to isotherms with several; refuse a temperature sweep."""
    counts = [len(_printed_frequencies(points, group)) for group in groups]
    if len(groups) >= TEMPERATURE_SWEEP and max(counts) == 1:
        problem = f"each of the {len(groups)} temperatures has one frequency; frequency sweeps are needed, not a "
        raise DataFileError(source, problem + "temperature sweep", code="temperature-sweep", remedy=AS_RAMPS)
    # one frequency next to three, two next to six
    needed = min(3, 1 + max(counts) // 3)
    return [group for group, count in zip(groups, counts, strict=True) if count >= needed]


def _on_small_groups(points: Points, groups: list[Indices], kept: list[Indices]) -> list[Note]:
    ids = {id(group) for group in kept}
    small = [group for group in groups if id(group) not in ids]
    if not small:
        return []
    rows = sorted(int(index) for group in small for index in group)
    low, high = (shown_celsius(float(f(points.temperature[rows]))) for f in (np.min, np.max))
    where = f"{low} °C" if low == high else f"between {low} and {high} °C"
    what = "1 point" if len(rows) == 1 else f"{len(rows)} points"
    alone = "it belongs" if len(rows) == 1 else "they belong"
    return [
        Note(
            "points-left-out",
            f"{what} left out: {alone} to no isotherm with several frequencies ({points.named(rows)}; {where}).",
        )
    ]


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


def traced_sweeps(
    readings: Sequence[Readings], deformation: Deformation | None = None, leave_out: Quantities | None = None
) -> TracedSweeps:
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
    on_request: list[Note] = []
    unwanted = to_si_array([] if leave_out is None else leave_out, "K", "leave_out_temperatures")
    if unwanted.size:
        sweeps, on_request = _without(sweeps, unwanted)
    notes: list[Note] = [
        *opened,
        *on_left_out,
        *on_groups,
        *on_request,
        *(note for _, some in single for note in some),
        *_on_order(points, keep, sweeps, len(readings)),
        *notes_on(points, sweeps),
    ]
    formats = list(dict.fromkeys(one.format for one in readings))
    isotherms = tuple(one.isotherm for one in sweeps)
    known = deformation is not None or any(one.deformation is not None for one in readings)
    found = IsothermalSweeps(isotherms, kind, source, short_notes(notes), ", ".join(formats))
    return TracedSweeps(found, tuple(readings), points, tuple(sweeps), known)


def _without(sweeps: list[Sorted], temperatures: Array) -> tuple[list[Sorted], list[Note]]:
    """Return the isotherms but for those at some temperatures, and the note on these."""
    kelvin = np.array([one.isotherm.temperature for one in sweeps])
    nearest = np.abs(kelvin[:, None] - temperatures).argmin(axis=0)
    argument = {"argument": "leave_out_temperatures"}
    for asked, there in zip(temperatures, kelvin[nearest], strict=True):
        if abs(asked - there) > ISOTHERM_GAP:
            raise InputError(
                f"leave_out_temperatures: no isotherm is at {shown_celsius(asked, 'z.4g')} °C; the nearest is at "
                f"{shown_celsius(there)} °C",
                code="no-such-temperature",
                field="material.leave_out_temperatures",
                remedy=kelvin_hint(asked),
                values=argument,
            )
    out = set(nearest.tolist())
    if len(out) == len(sweeps):
        raise InputError("leave_out_temperatures: no isotherm is left; name fewer.", code="none-left", values=argument)
    which = sorted(kelvin[place] for place in out)
    said = f"Left out as requested: isotherms at {several([f'{shown_celsius(one)} °C' for one in which])}."
    kept = [one for place, one in enumerate(sweeps) if place not in out]
    return kept, [Note("temperatures-left-out", said, values={"temperatures": which})]


def opening(readings: Sequence[Readings], deformation: Deformation | None) -> tuple[str, Deformation, list[Note]]:
    """Return the name of the files, the kind of deformation, and the notes on both and of the readers."""
    kind, on_deformation = _deformation(readings, deformation)
    synthetic = on_synthetic(one.source for one in readings)
    return _source(readings), kind, [*_on_formats(readings), *synthetic, *on_deformation, *_own_notes(readings)]


def _source(readings: Sequence[Readings]) -> str:
    """Return the path of one file; of several their names without folders, in which any mark may stand."""
    names = [one.source for one in readings] if len(readings) == 1 else [Path(one.source).name for one in readings]
    return ", ".join(names) if len(names) <= 3 else f"{names[0]} and {len(names) - 1} more files"


def _names(readings: Sequence[Readings]) -> str:
    names = [Path(one.source).name for one in readings]
    return several(names, 3)


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
        problem = f"the header states {kind}{by}, but {given} was requested."
        raise DataFileError(first.source, problem, code="deformation-contradicts")
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
