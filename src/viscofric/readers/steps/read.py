"""Creep and relaxation tests at several temperatures, from tables of text, workbooks and TRIOS exports.

The first points of a test show the instrument: after a step of stress no linear material has a compliance that falls,
or that grows faster than time (J(t) is concave: J. D. Ferry, Viscoelastic Properties of Polymers, 1980, ch. 3); after a
step of strain none has a modulus that rises.  What breaks this at the beginning by more than noise is the inertia of
the drive, which oscillates with the sample's stiffness (creep ringing: C. Baravian, D. Quemada, Rheol. Acta 37 (1998)
223, doi:10.1007/s003970050110), or a stress or strain that still rises.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

import numpy as np

from viscofric.arrays import Array, scatter
from viscofric.data import DEFORMATIONS, Deformation
from viscofric.errors import DataFileError, check_choice, wrong_argument
from viscofric.files import on_synthetic
from viscofric.nominal import parted
from viscofric.notes import Note
from viscofric.readers.dma.checks import doubts
from viscofric.readers.dma.instruments import trios_text
from viscofric.readers.dma.instruments.ta_steps import StepText
from viscofric.readers.dma.names import (
    MODULI,
    decided,
    insist_on_one_specimen,
    joined_tables,
    said_by_columns,
    tools_in,
)
from viscofric.readers.dma.tables import reptate
from viscofric.readers.source import Source, insist_on_content, sources_of
from viscofric.readers.steps.columns import (
    HELD,
    STEPS,
    held_of,
    kind_in_name,
    kind_of,
    response_of,
    temperature_of,
    time_of,
)
from viscofric.readers.table import Table, make_table
from viscofric.readers.tables import find_tables
from viscofric.step_tests import StepKind, StepTest, StepTests
from viscofric.units import Quantity, shown_celsius

#: Measured temperatures closer than this belong to one test; stated ones are equal up to rounding.
ONE_TEST, EQUAL = 1.0, 1e-6  # K
#: Decades that points may lie off the median to be judged by their size.
LIKE_THE_OTHERS = 3.0
#: Fewest points of a test.
LEAST_POINTS = 4


@dataclass(frozen=True, eq=False)
class _Part:
    """One table of a file as columns, NaN where a cell is missing: temperature (K), time (s), response, and so on."""

    source: str
    format: str
    kind: StepKind
    temperature: Array
    time: Array
    response: Array
    held: Array  # stress or strain over its level in the test
    deformation: Deformation | None
    notes: tuple[str, ...]
    lacks_unit: bool
    said_by: str = ""  # such as "the heading G(t) (MPa)"


def read_step_tests(
    *paths: str | PathLike[str] | Sequence[str | PathLike[str]],
    kind: StepKind | None = None,
    deformation: Deformation | None = None,
    temperature: Quantity | Sequence[Quantity | None] | None = None,
    response_unit: str | None = None,
    columns: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> StepTests:
    r"""Read creep tests, or relaxation tests, at several temperatures.

    Text tables (commas, semicolons, tabs or blanks between columns) and sheets of Excel workbooks with columns for time
    and creep compliance or relaxation modulus (or stress and strain, of which one is constant), each with its unit; and
    text exports of TA Instruments TRIOS with creep or relaxation steps.

    Parameters
    ----------
    *paths : str or path, or a list of them
        One or many files of one material, of one kind of test.
    kind : {"creep", "relaxation"}, optional
        If columns and names of steps do not state it.
    deformation : {"tension", "compression", "bending", "shear"}, optional
        If headings (``G(t)``), sample holder or a torque do not state it.
    temperature : float, str or quantity, or a list with one (or None) per file, optional
        For files without temperatures, K if a plain number.  The default is the temperature in the file's name
        (``creep_25C.csv``), with a note.
    response_unit : str, optional
        For files without the unit of the compliance or modulus, such as ``"1/MPa"`` or ``"MPa"``.
    columns : mapping, optional
        Headings of columns whose names are not understood, as for `read_dma`: ``{"time": "#1 (min)"}``.  Quantities are
        temperature, time, creep_compliance, relaxation_modulus, stress, strain and step.
    sheet : str, optional
        Name of the only sheet of a workbook to read.

    Returns
    -------
    StepTests
        In SI units, all recorded points.  Left out, with notes: points that are not above zero, the beginning of a test
        that shows ringing of the instrument's inertia or the rise of the step, recovery after creep.

    Raises
    ------
    DataFileError
        If a file cannot be read, a column or unit is missing or wrong, a cell is no number, no temperature is known,
        creep and relaxation are mixed, or tension or shear is not stated or contradicts `deformation`.
    InputError
        If no file is given, or an argument is wrong.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> import viscofric as vf
    >>> rows = ["T (degC)\tt (s)\tJ (1/MPa)", "25\t1\t0.10", "25\t10\t0.12", "25\t100\t0.15", "25\t1000\t0.19"]
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder) / "creep.txt"
    ...     _ = path.write_text("\n".join(rows))
    ...     creep = vf.read_step_tests(path, deformation="tension")
    >>> creep.kind, creep.tests[0].response  # 1/Pa
    ('creep', array([1.0e-07, 1.2e-07, 1.5e-07, 1.9e-07]))
    """
    if kind is not None:
        check_choice(kind, "kind", "creep", "relaxation")
    if deformation is not None:
        check_choice(deformation, "deformation", *DEFORMATIONS)
    sources = sources_of(paths, "read_step_tests", STEPS, temperature, response_unit, columns, sheet)
    parts = [part for source in sources for part in _parts(source, kind)]
    kinds = {part.kind for part in parts}
    if len(kinds) > 1:
        raise DataFileError(
            parts[-1].source, "creep and relaxation tests are mixed; read each kind by itself.", code="kinds-mixed"
        )
    if response_unit is not None and not any(part.lacks_unit for part in parts):
        raise wrong_argument(
            "response_unit", response_unit, "the files state their units; leave it out.", "unit-not-needed"
        )
    stated = _stated(parts, deformation)
    notes: list[str] = [*on_synthetic(one.path for one in sources)]
    notes += dict.fromkeys(note for part in parts for note in part.notes)
    tests = _tests(parts, notes)
    if not tests:
        raise DataFileError(sources[0].path, f"no test has {LEAST_POINTS} usable points or more.", code="no-points")
    named = ", ".join(Path(one.path).name for one in sources)
    return StepTests(tuple(tests), parts[0].kind, stated, named, tuple(notes), parts[0].format)


def _stated(parts: Sequence[_Part], given: Deformation | None) -> Deformation:
    """Return the kind of deformation that files or user state."""
    stating = [part for part in parts if part.deformation is not None] or [parts[0]]
    kinds = {decided(part.source, (part.deformation, part.said_by), given) for part in stating}
    if len(kinds) > 1:
        raise DataFileError(
            parts[-1].source, "the files state several kinds of deformation.", code="deformation-contradicts"
        )
    return kinds.pop()


def _parts(source: Source, kind: StepKind | None) -> list[_Part]:
    """Return the tests of one file, table by table."""
    insist_on_content(source)
    if trios_text.recognises(source) and not source.columns:
        return _trios_parts(source, kind)
    source = reptate.with_units(source)
    tables = find_tables(source, STEPS)
    form = "Excel workbook" if any(tables) else "delimited text"
    return [_part(table, source, name or source.stem, kind, form) for name, table in tables.items()]


def step_kind(source: Source) -> StepKind | None:
    """Return whether a file holds creep or relaxation tests, None for other tests."""
    if trios_text.recognises(source) and not source.columns:
        return _trios_parts(source, None)[0].kind
    for name, table in find_tables(reptate.with_units(source), STEPS).items():
        if not STEPS.missing(column.quantity for column in table.columns):
            return kind_of(table, name or source.stem)
    return None


def _trios_parts(source: Source, kind: StepKind | None) -> list[_Part]:
    found = trios_text.tables_of(source)
    parts, recovered = [], 0
    for step in found.tables:
        table = _table_of_step(source.path, step)
        if table is None:
            continue
        if kind_in_name(step.name) == "recovery":
            recovered += 1
            continue
        part = _part(replace(table, above=tuple(found.tools)), source, step.name, kind, found.format)
        parts.append(replace(part, notes=(*found.notes, *part.notes)))
    if not parts:
        names = ", ".join(repr(step.name) for step in found.tables) or "none"
        raise DataFileError(source.path, f"holds no creep or relaxation step; its steps are {names}.", code="no-points")
    if recovered:
        said = f"{recovered} recovery steps were left out; only creep and relaxation are read."
        parts[0] = replace(parts[0], notes=(*parts[0].notes, Note("recovery-left-out", said)))
    return parts


def _table_of_step(path: str, step: StepText) -> Table | None:
    """Return one step of a programme as a table, None if it is no creep or relaxation test."""
    names = ["" if name.strip().endswith("(step)") else name for name in step.names]
    units = [*step.units, *[""] * len(names)]
    columns = tuple(
        replace(column, unit=unit.strip()) if column.quantity else column
        for column, unit in zip(STEPS.columns(names), units, strict=False)
    )
    held = {column.quantity for column in columns}
    response = {"creep compliance", "relaxation modulus"} & held or {"stress", "strain"} <= held
    named = kind_in_name(step.name)
    if not {"time", "step time"} & held or not response or not step.rows or not named:
        return None
    rows = [(line, [*cells, *[""] * len(names)][: len(names)]) for line, cells in step.rows]
    return make_table(path, columns, rows, vocabulary=STEPS)


def _part(table: Table, source: Source, name: str, kind: StepKind | None, form: str) -> _Part:
    """Return the columns of one table in SI units."""
    notes: list[str] = [*table.heading_notes, *joined_tables(table)]
    time = time_of(table, notes)
    known = kind or kind_of(table, name)
    response, heading, lacks_unit = response_of(table, source, known, notes)
    plain = heading.replace("(t)", "").strip()
    symbol = plain.rpartition(" ")[2]  # of "relaxation modulus G(t)"
    deformation, said_by = said_by_columns([plain, symbol], [table.filled], tools_in(table.above))
    kelvin = temperature_of(table, source, name, notes)
    # The first points, of an instrument that rings, may have any size; the modulus of a melt falls without limit.
    with np.errstate(divide="ignore", invalid="ignore"):
        modulus = 1.0 / response if known == "creep" else response
        above = modulus[(modulus > 0.0) & np.isfinite(modulus)]
        usual = np.median(above) if above.size else np.nan
        near = np.abs(np.log10(modulus / usual)) < LIKE_THE_OTHERS
        modulus = np.where(modulus == modulus[near].max(initial=0.0), modulus, np.nan)
    headings = [column.heading for column in table.columns]
    places = {"temperature": table.place("temperature"), MODULI[0]: headings.index(heading)}
    notes += doubts(table, {one: place for one, place in places.items() if place is not None}, kelvin, modulus)
    insist_on_one_specimen(table, np.round(kelvin)[:, None], "temperature")
    held = _over_level(held_of(table, known), time, kelvin)
    return _Part(source.path, form, known, kelvin, time, response, held, deformation, tuple(notes), lacks_unit, said_by)


def _tests(parts: Sequence[_Part], notes: list[str]) -> list[StepTest]:
    """Sort the points into tests by temperature, and leave out what is not of the material."""
    columns = [(part.temperature, part.time, part.response, part.held) for part in parts]
    kelvin, time, response, held = map(np.concatenate, zip(*columns, strict=True))
    usable = np.isfinite(kelvin) & (time > 0.0) & (response > 0.0) & np.isfinite(time) & np.isfinite(response)
    if not np.all(usable):
        said = (
            f"{np.count_nonzero(~usable)} of {len(usable)} points were left out: a value is missing or not above zero."
        )
        notes.append(Note("points-left-out", said))
    kelvin, time, response, held = kelvin[usable], time[usable], response[usable], held[usable]
    tests = []
    for rows in parted(kelvin, EQUAL if _are_stated(kelvin, time) else ONE_TEST):
        temperature = float(np.mean(kelvin[rows]))
        if np.ptp(kelvin[rows]) > 2.0 * ONE_TEST:
            where = f"in the test at {shown_celsius(temperature)} °C"
            said = f"The temperature ranges over {np.ptp(kelvin[rows]):.1f} K {where}."
            notes.append(Note("temperature-range", said))
        times, number, count = np.unique(time[rows], return_inverse=True, return_counts=True)
        mean = np.exp(np.bincount(number, weights=np.log(response[rows])) / count)
        if np.any(count > 1):
            said = (
                f"Points at equal times were averaged at {shown_celsius(temperature)} °C ({np.sum(count > 1)} times)."
            )
            notes.append(Note("repeats-averaged", said))
        begin, end = held_over(time[rows], held[rows])
        last = int(np.searchsorted(times, end))
        if last < len(times):
            said = f"At {shown_celsius(temperature)} °C {len(times) - last} points from {end:.3g} s on were left out: "
            what = "stress" if parts[0].kind == "creep" else "strain"
            notes.append(Note("recovery-left-out", f"{said}the {what} is no longer held."))
        first = _first(temperature, times[:last], mean[:last], parts[0].kind, begin, notes)
        if last - first < LEAST_POINTS:
            said = f"The test at {shown_celsius(temperature)} °C has too few usable points; times count from its step."
            notes.append(Note("left-out", said))
            continue
        tests.append(StepTest(temperature, times[first:last], mean[first:last]))
    return tests


def _are_stated(kelvin: Array, time: Array) -> bool:
    """Return whether temperatures stay the same until time begins again: those of a programme, not measured ones."""
    return bool(np.all((np.abs(np.diff(kelvin)) < EQUAL) | (np.diff(time) < 0.0)))


def _first(kelvin: float, time: Array, response: Array, kind: StepKind, begin: float, notes: list[str]) -> int:
    """Return the first point that is of the material, held from `begin` (s) on; notes say what was left out."""
    start = start_of(time, response, kind)
    if (risen := int(np.searchsorted(time, AFTER_RISE * begin))) > start.first:
        start = replace(start, first=risen, reason="rise")
    where = f"{shown_celsius(kelvin)} °C"
    if start.first:
        why = {
            "ringing": "the instrument's inertia rings",
            "rise": f"the {'stress' if kind == 'creep' else 'strain'} is not yet constant",
        }[start.reason]
        until = time[min(start.first, len(time) - 1)]
        said = f"At {where} the first {start.first} points, to {until:.3g} s, were left out: {why} there."
        notes.append(Note(f"{start.reason}-left-out", said))
    if start.broken_at is not None:
        how = "the compliance falls" if kind == "creep" else "the modulus rises"
        said = f"At {where} {how} from {start.broken_at:.3g} s on, as no linear material does; the points were kept."
        notes.append(Note("not-of-a-material", said))
    return start.first


#: A response breaks a rule by more than this, which single readings differ by …
LEAST = 0.01  # decades
#: … and by so many times the scatter of its points.
SIGMAS = 8.0
#: Ringing is left out to so many times the last time at which it shows; by then it has fallen to a part of `LEAST`.
AFTER_RINGING = 1.5
#: A rise, to so many times its duration: a ramp of that duration is then off by a twentieth of the slope at most.
AFTER_RISE = 10.0
#: Ringing begins in this part of the test, in log time, and breaks the rule again within this factor of time.
BEGINNING = 0.5
AGAIN = 2.0


@dataclass(frozen=True)
class Start:
    """Where the response of the material begins: the first usable point, why, and when a rule is broken after it."""

    first: int = 0
    reason: str = ""  # "ringing", "rise" or ""
    broken_at: float | None = None  # s


def start_of(time: Array, response: Array, kind: StepKind) -> Start:
    """Return where the response of the material begins; `time` (n,) ascends, in s."""
    log_time, log = np.log10(time), np.log10(response)
    threshold = max(LEAST, SIGMAS * scatter(log) if len(log) >= 5 else 0.0)
    # A step that still rises: what should fall from the first point on, E(t) or J(t)/t, rises to a maximum.
    falling = log if kind == "relaxation" else log - log_time
    peak = int(np.argmax(falling))
    risen = time[peak] if falling[peak] - falling[0] > threshold else 0.0
    turns = _turned(time, -log if kind == "relaxation" else log)
    broken = np.flatnonzero((turns > threshold) & (time > AGAIN * risen))
    ringing = 0.0
    for place in broken if kind == "creep" else []:
        begins = log_time[place] < log_time[0] + BEGINNING * (log_time[-1] - log_time[0])
        if not (begins if ringing == 0.0 else time[place] <= AGAIN * ringing):
            break
        ringing = time[place]
    after = broken[time[broken] > ringing]
    late = float(time[after[0]]) if len(after) else None
    if not max(ringing, risen):
        return Start(broken_at=late)
    reach = AFTER_RINGING * ringing if ringing else AFTER_RISE * risen
    return Start(int(np.searchsorted(time, reach)), "ringing" if ringing else "rise", late)


def _over_level(held: Array, time: Array, kelvin: Array) -> Array:
    """Return stress or strain over that which each test holds; a test ends where time or temperature begin anew."""
    ends = np.flatnonzero((np.diff(time) < 0.0) | (np.abs(np.diff(kelvin)) > ONE_TEST)) + 1
    found = []
    for one in np.split(np.abs(held), ends):
        known = one[one > 0.0]
        level = np.median(known[known > 0.5 * np.quantile(known, 0.9)]) if known.size else np.nan
        found.append(np.nan_to_num(one / level, nan=1.0))
    return np.concatenate(found)


def held_over(time: Array, held: Array) -> tuple[float, float]:
    """Return when stress or strain, over its level, becomes constant (s; 0: it always is) and is released (or inf)."""
    off = np.abs(held - 1.0)
    begin = float(np.min(time[off <= max(HELD, SIGMAS * float(np.median(off)))], initial=np.inf))
    released = time[(held < 0.5) & (time > begin)]
    return begin if begin > time.min() else 0.0, float(np.min(released, initial=np.inf))


def _turned(time: Array, log: Array) -> Array:
    """Return how far values lie below the largest one since `AGAIN` times less time."""
    since = np.searchsorted(time, time / AGAIN)
    return np.array([log[first : place + 1].max() - log[place] for place, first in enumerate(since)])
