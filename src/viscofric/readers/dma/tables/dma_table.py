"""Points of frequency sweeps from a table with units: columns, SI units, tan δ, strain amplitude, step."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viscofric.arrays import Array, Integers
from viscofric.errors import DataFileError
from viscofric.notes import Note, Remedy, setting
from viscofric.readers.dma import names
from viscofric.readers.dma.checks import HELD_FREQUENCY, PRINTED, WIDE, doubts, insist_on_agreement
from viscofric.readers.dma.names import (
    COMPLIANCES,
    DMA,
    MODULI,
    Said,
    deformation_of,
    joined_tables,
    known_temperatures,
    said_by_columns,
    temperature_in_name,
)
from viscofric.readers.dma.readings import AS_MASTER_CURVE, Readings, of_one_file
from viscofric.readers.header_rows import is_number
from viscofric.readers.headings import Column
from viscofric.readers.source import PRINTED_FREQUENCY, Source, Test, converted, fraction_of, to_rad_per_second
from viscofric.readers.table import MISSING, Table, or_name_it
from viscofric.readers.tables import find_tables, holds_table
from viscofric.showing import several

#: Of text tables: commas, semicolons, tabs or blanks between columns.
NAME = "delimited text"
#: Labels and values that name a sample holder.
Tools = Sequence[tuple[str, str]]

_OF_OSCILLATION = re.compile(r"complex|oscillat|amplitude|dynamic|\bdyn\b", re.IGNORECASE)
_DOUBLE = re.compile(r"\bdouble\s+(strain|amplitude)|\bDSA\b|\bp-?p\b|\bpeak[ -]to[ -]peak\b", re.IGNORECASE)
#: A strain amplitude above 200 % is that of no analyser; a number above it is in per cent.
_LARGEST_FRACTION = 2.0
#: Half of the tan δ of a rubber are never above this; numbers without a unit that are may be in per cent.
_LARGEST_TANGENT = 3.0
#: What a test sweeps, in the names of quantities.
_SWEPT: dict[Test, str] = {"frequency": "frequency", "temperature": "temperature", "amplitude": "strain amplitude"}
#: Segment and number of a point, as HAAKE RheoWin prints them.
_SEGMENT = re.compile(r"\d{1,6}\|\d{1,6}")
_HINT = ", or give it by " + setting("material.modulus_unit", "Unit of the moduli", "'MPa'")


def recognises(source: Source) -> bool:
    """Return whether a line of the text names columns of a DMA table."""
    return holds_table(source, names.DMA)


def read(source: Source) -> Readings:
    """Return the points of a text table."""
    return read_points(find_tables(source, names.DMA)[""], source, NAME, source.stem)


def find_columns(table: Table, temperature: float | None = None, *, master_curve: bool = False) -> dict[str, int]:
    """Return the places of the columns by quantity; a temperature of all rows may be given, K."""
    # Reduced frequencies have priority over measured ones in a master curve; `is_reduced` distinguishes the two.
    stated = MODULI if any(map(table.has, MODULI)) else COMPLIANCES
    wanted = ("temperature", *stated, "tan delta")
    found = {what: table.place(what) for what in wanted}
    found["frequency"] = _frequency_place(table, master_curve=master_curve)
    if found["temperature"] is None:
        found["temperature"] = table.place("isotherm" if master_curve else "set temperature")
    places = {what: place for what, place in found.items() if place is not None}
    tangent = places.get("tan delta")
    if tangent is not None and not _is_ratio(table.columns[tangent].unit):  # a tangent has no unit
        del places["tan delta"]
    if "tan delta" not in places and not {*stated[:2]} <= places.keys():
        angle = table.place("phase angle")
        places |= {} if angle is None else {"phase angle": angle}
    missing = [] if "frequency" in places else ["frequency"]
    if not places.keys() & {*stated}:
        missing += MODULI[:2]
    elif not places.keys() & {"tan delta", "phase angle"}:
        missing += [one for one in stated[:2] if one not in places]
    if missing and "temperature" not in places and temperature is None and not master_curve:
        missing.append("temperature")
    if missing:
        raise table.lacking(missing)
    return places


def with_one_abscissa(table: Table, test: Test, notes: list[str]) -> Table:
    """Return the table with digitised curves at the abscissas of the first: ``f, E', f, E''`` or ``f1, E', f2, …``."""
    named = [one.quantity or DMA.quantity(one.unnumbered) for one in table.columns]
    swept = [n for n, what in enumerate(named) if _SWEPT[test] in what]
    columns, of = table.columns, (*MODULI, *COMPLIANCES, "tan delta", "phase angle")
    curves = [n for n, one in enumerate(columns) if one.quantity in of]
    if not swept or len({named[n] for n in curves}) < len(curves):  # of several sweeps
        return table
    first = next((n for n in swept if columns[n].quantity), swept[0])
    lead = replace(columns[first], quantity=named[first])
    alike = [n for n, one in enumerate(columns) if n != first and one.is_like(lead)]
    columns = tuple(replace(one, base=lead.base) if n in alike else one for n, one in enumerate(columns))
    columns = (*columns[:first], lead, *columns[first + 1 :])
    table, leads = replace(table, columns=columns), bool(curves) and first < curves[0]
    within = [n for n in range(curves[0], curves[-1]) if n not in curves] if leads else []
    own = {curve: n for n in alike if n in within for curve in curves if curve > n}
    needed = [n for n in curves if named[n] in of[:-2]]  # others come from one instrument with these
    if len(needed) > 1:
        within = [n for n in within if n in alike or needed[0] < n < needed[-1]]
    for n in {*within, *(() if leads and lead.given else alike)} - {*own.values()}:
        if _differs(table, n, first, test, like=n in alike):
            raise table.of_others(n, first, _SWEPT[test])
    kept = tuple(replace(one, name="", quantity="") if n in own.values() else one for n, one in enumerate(columns))
    others = {curve: n for curve, n in own.items() if _differs(table, n, first, test, like=True)}
    table = replace(table, columns=kept)
    return _interpolated(table, first, curves[0], others, test, notes) if others else table


def _differs(table: Table, place: int, first: int, test: Test, *, like: bool) -> bool:
    """Return whether a column holds other abscissas than the first one, by its heading or its unit."""
    if like:
        return not np.array_equal(table.numbers_or_missing(place), table.numbers_or_missing(first), equal_nan=True)
    one, other = (table.columns[n] for n in (place, first))
    units = [_in_si(column, test) for column in (one, other)]
    if (one.quantity and not other.given) or "reduced" in DMA.column(one.heading).quantity or None in units:
        return False
    pairs = zip((place, first), filter(None, units), strict=True)
    x, at = (factor * table.numbers_or_missing(n) + zero for n, (factor, zero) in pairs)
    return bool(np.any(np.abs(x - at) > (WIDE if test == "temperature" else PRINTED_FREQUENCY * np.abs(at))))


def _in_si(column: Column, test: Test) -> tuple[float, float] | None:
    """Return the factor and the offset of abscissas to rad/s or K, None for the unit of anything else."""
    if test == "frequency":
        factor = to_rad_per_second(column.unit, angular="angular" in DMA.column(column.heading).quantity)
        return None if factor is None else (factor, 0.0)
    zero, one = (converted(number, column.unit, "K") for number in "01")
    return None if test == "amplitude" or zero is None or one is None else (one - zero, zero)


def _interpolated(table: Table, first: int, before: int, others: dict[int, int], test: Test, notes: list[str]) -> Table:
    """Return the table with curves, each with the place of its own abscissas, at those of the first."""
    columns, headings = table.columns, [repr(table.columns[place].heading) for place in (before, *others)]
    apart = [n for n, one in enumerate(columns) if n != first and any(what in one.quantity for what in _SWEPT.values())]
    varied = any(len({row[n] for row in table.rows}) > 1 for n in apart)
    at, missing, found = table.numbers_or_missing(first), 0, {}
    for curve, place in others.items():
        x, y = (table.numbers_or_missing(n) for n in (place, curve))
        printed = np.count_nonzero(np.isfinite(x) & np.isfinite(y))
        with np.errstate(all="ignore"):
            x, to, y = (one if test == "temperature" and one is not y else np.log(one) for one in (x, at, y))
        known = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
        steps = np.diff(x[known])
        if varied or known.size < 2 or len({*np.sign(steps)}) > 1:
            problem = f"{columns[first].heading!r} is not the same for {' and '.join(headings)}; give all in the same "
            raise table.refused("ambiguous-columns", f"{problem}rows.")
        order = known if steps[0] > 0.0 else known[::-1]
        found[curve] = np.exp(np.interp(to, x[order], y[order], np.nan, np.nan))
        missing += int(printed) - known.size
    within = np.flatnonzero(np.isfinite([at, *found.values()]).all(axis=0))
    out = np.count_nonzero(np.isfinite(at)) - len(within)
    said = f"{' and '.join(headings[1:])} {'were' if len(others) > 1 else 'was'} interpolated to the "
    said += f"{_SWEPT[test]} of {headings[0]}"
    said += f"; left out beyond: {out}" if out else ""
    said += f"; its points that are not above zero were left out: {missing}" if missing else ""
    notes.append(Note("curves-interpolated", f"{said}.", values={"not_positive": missing}))
    rows = [
        tuple(repr(float(found[n][row])) if n in found else cell for n, cell in enumerate(table.rows[row]))
        for row in within
    ]
    read = [Column("", "", "") if n in others.values() else one for n, one in enumerate(columns)]
    plain = tuple(replace(one, base=0.0) if n in found else one for n, one in enumerate(read))
    block = None if table.block is None else table.block[within]
    return replace(table, rows=tuple(rows), columns=plain, lines=table.lines[within], block=block)


def _frequency_place(table: Table, *, master_curve: bool) -> int | None:
    measured, reduced = ["angular frequency", "frequency"], ["reduced angular frequency", "reduced frequency"]
    order = reduced + measured if master_curve else measured + reduced
    given = [what for what in order if any(column.given and column.quantity == what for column in table.columns)]
    for what in given or order:
        place = table.place(what)
        if place is not None:
            return place
    return None


def is_reduced(table: Table, places: dict[str, int]) -> bool:
    """Return whether the frequencies are reduced ones, those of a master curve."""
    return "reduced" in table.columns[places["frequency"]].quantity


def angular_frequency(table: Table, places: dict[str, int], notes: list[str]) -> Array:
    """Return rad/s, NaN where a cell is missing; adds a note where the unit follows from the name only."""
    place = places["frequency"]
    if not table.columns[place].unit and _is_angular(table, place):
        shown = table.columns[place].heading
        said = f"The column {shown!r} has no unit; it was read in rad/s, as its name implies."
        notes.append(Note("frequency-without-unit", said))
        return table.numbers_or_missing(place)
    return _in_rad_per_second(table, place)


def _is_angular(table: Table, place: int) -> bool:
    return "angular" in table.columns[place].quantity


def _in_rad_per_second(table: Table, place: int) -> Array:
    """Return rad/s, or raise `DataFileError` for a unit that is neither hertz nor rad/s."""
    column = table.columns[place]
    named_angular = _is_angular(table, place)
    factor = to_rad_per_second(column.unit, angular=named_angular)
    if factor is not None:
        return factor * table.numbers_or_missing(place)
    if not column.unit:  # one that is named angular is read in rad/s by `angular_frequency`
        in_hertz, in_radians = (f"{column.heading} ({unit})" for unit in ("Hz", "rad/s"))
        problem = f"column {column.heading!r} has no unit; write it as {in_hertz!r} or {in_radians!r}"
        raise table.refused("no-unit", problem, or_name_it(table.vocabulary.key, "frequency", in_hertz))
    right = "'rad/s'" if named_angular else "'Hz' or 'rad/s'"
    raise table.refused("wrong-unit", f"column {column.heading!r} has the unit {column.unit!r}; it must be {right}.")


def insist_on_one_frequency(table: Table, places: dict[str, int], angular: Array) -> None:
    """Raise `DataFileError` where a second column of frequency contradicts the first."""
    used, other = places["frequency"], table.place("frequency")
    if other is None or other == used or is_reduced(table, places) or table.columns[used].given:
        return
    apart = np.abs(_in_rad_per_second(table, other) - angular) > PRINTED_FREQUENCY * np.abs(angular)
    if np.any(apart):
        row = int(np.argmax(apart))
        both = (f"{_cell(table, row, place)} in column {table.columns[place].heading!r}" for place in (other, used))
        problem = f"{' and '.join(both)} contradict each other (ω = 2πf); correct or leave out one of them."
        raise DataFileError(table.path, problem, int(table.lines[row]), code="columns-contradict")


def moduli(table: Table, places: dict[str, int], source: Source, notes: list[str]) -> tuple[Array, Array]:
    """Return storage and loss modulus, Pa, as printed or from tan δ, with notes on what was computed."""
    # With E'' = E' tan δ and |E*|² = E'² + E''², one modulus and tan δ, or the angle δ, give the others exactly;
    # redundant columns must agree, else `DataFileError` is raised.
    if not places.keys() & {*MODULI}:
        return _of_compliances(table, places, notes)
    values = {what: _modulus(table, places[what], source, notes) for what in MODULI if what in places}
    if "storage modulus" in values and "loss modulus" in values:
        storage, loss = values["storage modulus"], values["loss modulus"]
        tangent = _printed_tangent(table, places, storage, loss)
        insist_on_agreement(table.path, storage, loss, tangent, values.get("complex modulus"))
        return storage, loss
    tangent = _tangent(table, places, notes)
    if "storage modulus" in values:
        notes.append(Note("loss-computed", "The loss moduli were computed as storage modulus times tan δ."))
        return values["storage modulus"], values["storage modulus"] * tangent
    if "loss modulus" in values:
        notes.append(Note("storage-computed", "The storage moduli were computed as loss modulus over tan δ."))
        tangent = np.where(tangent == 0.0, np.nan, tangent)
        return values["loss modulus"] / tangent, values["loss modulus"]
    said = "Storage and loss moduli were computed from the absolute value of the complex modulus and tan δ."
    notes.append(Note("moduli-computed", said))
    storage = values["complex modulus"] / np.hypot(1.0, tangent)
    return storage, storage * tangent


@np.errstate(over="ignore", invalid="ignore")
def _of_compliances(table: Table, places: dict[str, int], notes: list[str]) -> tuple[Array, Array]:
    """Return storage and loss modulus, Pa, of the compliance J' − iJ'' = 1/(G' + iG''), or of one part and tan δ."""
    found = [_compliance(table, places[what]) if what in places else None for what in COMPLIANCES]
    storage, loss = found
    tangent = loss / storage if storage is not None and loss is not None else _tangent(table, places, notes)
    tangent = np.where(tangent == 0.0, np.nan, tangent)
    if storage is not None and loss is not None:
        insist_on_agreement(table.path, storage, loss, _printed_tangent(table, places, storage, loss))
    if storage is None:
        assert loss is not None
        storage = loss / tangent
    notes.append(Note("moduli-computed", "Storage and loss moduli were computed from the compliances."))
    modulus = 1.0 / (storage * (1.0 + tangent**2))
    return modulus, modulus * tangent


def _compliance(table: Table, place: int) -> Array:
    values = table.values(place, "1/Pa", or_missing=True)
    return np.where(values == 0.0, np.nan, values)


def _tangent(table: Table, places: dict[str, int], notes: list[str]) -> Array:
    """Return tan δ as printed, or from the angle δ; large numbers without a unit have a note, or are refused."""
    if "tan delta" in places:
        column, tangent = table.columns[places["tan delta"]], _fraction(table, places["tan delta"])
        if not column.name or column.unit or (half := float(np.nanmedian(tangent))) <= 1.0:
            return tangent
        if half > _LARGEST_TANGENT:
            problem = f"half of the values in column {column.heading!r} are above {half:.3g}, as in per "
            right = f"cent; write it as '{column.name} (%)', or as '{column.name} (-)' if they are tan δ itself."
            raise table.refused("no-unit", problem + right)
        said = f"Read as tan δ itself, no angle and not in per cent: {column.heading!r}, half of it above {half:.3g}."
        notes.append(Note("tangent-without-unit", said, values={"median": half}))
        return tangent
    place = places["phase angle"]
    angle = table.values(place, "rad", or_missing=True)
    beyond = (angle < 0.0) | (angle >= 0.5 * math.pi)
    if 2 * np.count_nonzero(beyond) > len(angle):
        table.insist(~beyond, place, "an angle from 0 to below 90°", "out-of-range")
    return np.tan(np.where(beyond, np.nan, angle))


def _printed_tangent(table: Table, places: dict[str, int], storage: Array, loss: Array) -> Array | None:
    """Return tan δ next to both moduli, None if its column holds no numbers: it is not needed."""
    try:
        tangent = _fraction(table, places["tan delta"]) if "tan delta" in places else None
    except DataFileError:
        return None
    if tangent is None or table.columns[places["tan delta"]].unit:
        return tangent
    with np.errstate(divide="ignore", invalid="ignore"):
        in_percent = 0.01 * tangent * storage / loss  # 1 where the unit is only missing
    return 0.01 * tangent if abs(np.nanmedian(in_percent) - 1.0) < PRINTED else tangent


def _is_ratio(unit: str) -> bool:
    return unit.lower() in MISSING or fraction_of(unit) is not None


def _fraction(table: Table, place: int) -> Array:
    """Return numbers without a unit, or in per cent."""
    return (fraction_of(table.columns[place].unit) or 1.0) * table.numbers_or_missing(place)


def lacks_unit(table: Table, places: dict[str, int], source: Source) -> bool:
    """Return whether a modulus has no unit but the one that the user gave."""
    return bool(source.modulus_unit) and any(not table.columns[places[m]].unit for m in MODULI if m in places)


def _modulus(table: Table, place: int, source: Source, notes: list[str]) -> Array:
    """Return a column in Pa, by its own unit or by the one that the user gave."""
    if source.modulus_unit and not table.columns[place].unit:
        said = f"The moduli have no unit in the file; they were read in {source.modulus_unit}, as requested."
        note = Note("modulus-unit-given", said)
        if note not in notes:
            notes.append(note)
    values = table.values(place, "Pa", _HINT, or_missing=True, assumed=source.modulus_unit)
    table.insist(~np.isinf(values), place, "a finite number of pascal", "not-a-number")
    return values


def deformation(tables: Sequence[Table], tools: Tools | None = None) -> Said:
    """Return tension or shear and the words that state it; moduli of both kinds are a `DataFileError`."""
    # `tools` are label and value of the sample holder, if it is not named above the tables.
    named = (*MODULI, *COMPLIANCES)
    moduli = [column for what in named for table in tables for column in table.columns if column.quantity == what]
    if {"tension", "shear"} <= {deformation_of(column.name) for column in moduli}:
        problem = "one modulus is tensile (E) by its heading, the other shear (G); correct the wrong heading."
        raise DataFileError(tables[0].path, problem, code="deformation-contradicts")
    tools = [tool for table in tables for tool in names.tools_in(table.above)] if tools is None else tools
    return said_by_columns([column.heading for column in moduli], [table.filled for table in tables], tools)


#: Words of more kinds in a column are remarks.
_MOST_KINDS = 20
#: Frequency range of the sweeps of any instrument; master curves exceed it.
WIDEST_SWEEP = 7.0  # decades


def read_points(
    table: Table,
    source: Source,
    format: str,  # noqa: A002
    name: str,
    where: str = "line",
    *,
    exported: bool = False,
    tools: Tools | None = None,
) -> Readings:
    """Return the points of one table."""
    # `name` is that of the file or sheet, which may contain the temperature; numbers of rows count lines, or what
    # `where` says. `exported`: by an instrument, which writes no frequency of zero or less; a strain without a unit may
    # be in per cent and is not read; a file may hold many such tables, so that moduli are judged when all points are
    # joined (`checks.usable`). `tools` as for `deformation`.
    notes: list[str] = []
    table = table if exported else with_one_abscissa(table, source.test, notes)
    places = find_columns(table, source.temperature)
    if is_reduced(table, places):
        problem = f"column {table.columns[places['frequency']].heading!r} holds reduced frequencies: a master curve"
        raise DataFileError(table.path, problem, code="master-curve", remedy=AS_MASTER_CURVE)
    notes += [*table.heading_notes, *joined_tables(table)]
    if table.empty_rows:
        rows = "1 row holds" if table.empty_rows == 1 else f"{table.empty_rows} rows hold"
        notes.append(Note("empty-rows", f"{rows} neither frequency nor modulus; skipped."))
    frequency = angular_frequency(table, places, notes)
    insist_on_one_frequency(table, places, frequency)
    if exported:
        table.insist(~(frequency <= 0.0), places["frequency"], "above zero")
    storage, loss = moduli(table, places, source, notes)
    temperature = _temperature(table, places, source, name, frequency, notes)
    if not exported:
        with np.errstate(divide="ignore", invalid="ignore"):
            at = np.column_stack([np.round(temperature), np.round(np.log(frequency) / HELD_FREQUENCY)])
        names.insist_on_one_specimen(table, at, "temperature and frequency")
        _insist_on_most(table, places, "frequency", frequency)
        _insist_on_most(table, places, "storage modulus", storage)
    kind, said_by = deformation([table], tools)
    amplitude = _strain_amplitude(table, notes, "" if exported else "1")
    if not exported:
        _note_unread(table, notes)
    return Readings(
        source=source.path,
        format=format,
        places=tuple(f"{where} {number}" for number in table.lines.tolist()),
        temperature=temperature,
        angular_frequency=frequency,
        storage_modulus=storage,
        loss_modulus=loss,
        deformation=kind,
        said_by=said_by,
        strain_amplitude=amplitude,
        step=_step(table),
        lacks_unit=lacks_unit(table, places, source),
        notes=(*notes, *doubts(table, places, temperature, storage)),
    )


def read_export(
    tables: Sequence[Table],
    source: Source,
    format: str,  # noqa: A002
    what: str,
    where: str = "line",
    tools: Tools | None = None,
) -> Readings:
    """Return the points of the tables, called `what` in an error, of one file of an instrument, without their steps."""
    # All tables decide together between tension and shear: a torque in one of them states nothing of the others.
    parts = [read_points(table, source, format, "", where, exported=True, tools=tools) for table in tables]
    kind, said_by = deformation(tables, tools)
    return replace(of_one_file(parts, what), deformation=kind, said_by=said_by)


def _temperature(
    table: Table, places: dict[str, int], source: Source, name: str, angular: Array, notes: list[str]
) -> Array:
    """Return K, at last from the file's name, with a note."""
    known = known_temperatures(table, places.get("temperature"), source, notes)
    if known is not None:
        return known
    others = [one.heading for one in table.columns if not one.quantity and converted("1", one.unit, "K") is not None]
    if others:
        problem = f"no column is called temperature; unless it is {' or '.join(map(repr, others))}, give "
        remedy = setting("material.temperature", "Temperature of the sweep", "'25 degC'") + "; if it is, rename it"
        remedy += or_name_it(table.vocabulary.key, "temperature", others[0])
        raise table.refused("missing-columns", problem, remedy, ["temperature"])
    found, named = temperature_in_name(name), "file's" if name == source.stem else "sheet's"
    swept = angular[angular > 0.0]
    decades = math.log10(np.max(swept) / np.min(swept)) if swept.size else 0.0
    if found is None or decades > WIDEST_SWEEP:
        raise _no_temperature(table, decades, name)
    notes.append(Note("temperature-from-name", f"No column holds a temperature; it was taken from the {named} name."))
    return np.full(len(angular), found)


def _no_temperature(table: Table, decades: float, name: str) -> DataFileError:
    if decades > WIDEST_SWEEP:
        return DataFileError(
            table.path,
            f"no column for temperature, and {decades:.0f} decades of frequency: this looks like a master curve",
            code="master-curve",
            remedy=AS_MASTER_CURVE,
        )
    if table.block is not None:
        number = int(table.block.max())
        problem = (
            f"no temperature of its {number} tables below each other; write it with its unit into the line above each, "
            "such as 'T = 25 °C', or into a column."
        )
        return DataFileError(table.path, problem, code="no-temperature")
    problem = f"no column for temperature{names.unclear_in_name(name)}, this table has {table.headings()}; for a sweep "
    return DataFileError(
        table.path,
        f"{problem}at one temperature give ",
        code="no-temperature",
        remedy=setting("material.temperature", "Temperature of the sweep", "'25 degC'")
        + Remedy(
            ", and a master curve is read by read_master_curve.",
            ", and a master curve is read by viscofric material fit --master-curve.",
            run_file=", and a master curve is named as master_curve.",
            page=".",
        ),
    )


def _cell(table: Table, row: int, place: int) -> str:
    return table.rows[row][place].strip()


def _insist_on_most(table: Table, places: dict[str, int], what: str, values: Array) -> None:
    """Refuse a column of which most is missing or not above zero; single points are left out later, with a note."""
    place = places.get(what)
    good = values > 0.0
    if place is None or 2 * np.count_nonzero(good) >= len(values):
        return
    table.numbers(place)  # raises for the first cell that is empty or not a number
    table.insist(good, place, "above zero")


def _note_unread(table: Table, notes: list[str]) -> None:
    """Add notes on unread columns that may tell sweeps apart: words of several kinds, and numbered names of a sweep."""
    for place, column in enumerate(table.columns):
        kinds = {row[place].strip() for row in table.rows}
        words = sorted(word for word in kinds if word.lower() not in MISSING and not is_number(word))
        if not column.quantity and 1 < len(words) == len(kinds) <= min(_MOST_KINDS, len(table.rows) // 2):
            shown = several([*map(repr, words)], 3)
            text = f"Column {column.heading!r} holds {shown}, and is not read; are all rows of one specimen?"
            notes.append(Note("unused-columns", text))
    others = (column for column in table.columns if not column.quantity)
    alike = [repr(one.heading) for one in others if DMA.quantity(one.unnumbered) or _begins_as_modulus(one.name)]
    if alike:
        text = f"Not read, though named like columns that are: {', '.join(alike)}; give each sweep a table of its own."
        notes.append(Note("unused-columns", text))


def _begins_as_modulus(name: str) -> bool:
    """Return whether the first words of a name are those of a modulus: ``E' corrected``."""
    words = name.split(" ")
    return any(DMA.quantity(" ".join(words[:count])) in MODULI for count in range(1, len(words)))


def _strain_amplitude(table: Table, notes: list[str], without_unit: str) -> Array | None:
    """Return fractions, None without exactly one column of them with a known unit, or one that it has without any."""
    found = [p for p, column in enumerate(table.columns) if column.quantity == "strain amplitude"]
    named = [p for p in found if _OF_OSCILLATION.search(table.columns[p].name)]
    if len(found) > 1 and len(named) == 1:  # others are of a steady deformation
        found = named
    if len(found) > 1:
        several = " and ".join(repr(table.columns[place].heading) for place in found)
        said = f"The strain amplitudes were not read: {several} may hold them."
        notes.append(Note("strain-amplitude-not-read", said))
    if len(found) != 1:
        return None
    column = table.columns[found[0]]
    if _DOUBLE.search(column.heading):
        problem = f"column {column.heading!r} holds double amplitudes (peak to peak); write half of them in a column."
        raise table.refused("double-amplitude", problem)
    unit = column.unit.strip() or without_unit
    factor = fraction_of(unit) if unit else None
    if factor is None:
        said = f"The strain amplitudes were not read: column {column.heading!r} has no unit such as '%'."
        notes.append(Note("strain-amplitude-not-read", said))
        return None
    try:
        values = factor * table.numbers_or_missing(found[0])
    except DataFileError:  # words in a column that is not needed
        return None
    if not column.unit.strip():
        if np.nanmax(values, initial=0.0) > _LARGEST_FRACTION:
            said = (
                f"The strain amplitudes were not read: column {column.heading!r} has no unit; too large for fractions."
            )
            notes.append(Note("strain-amplitude-not-read", said))
            return None
        said = f"Column {column.heading!r} has no unit; it was read as a fraction (0.01 is 1 %)."
        notes.append(Note("strain-without-unit", said))
    return np.where(values >= 0.0, values, np.nan)


def _step(table: Table) -> Integers | None:
    """Return the numbers of steps, None without exactly one column for them."""
    # Steps are whole numbers, names, or segment and point (``2|11``); without any, tables below each other are steps.
    for place in range(len(table.columns)):
        if all(_SEGMENT.fullmatch(row[place].strip()) for row in table.rows):
            return np.array([int(row[place].partition("|")[0]) for row in table.rows], dtype=np.int64)
    found = [p for p, column in enumerate(table.columns) if column.quantity == "step"]
    if len(found) != 1:
        return table.block
    cells = [row[found[0]].strip() for row in table.rows]
    if not any(map(is_number, cells)):
        names_of_steps = {name: number for number, name in enumerate(dict.fromkeys(cells), start=1)}
        return np.array([names_of_steps[cell] for cell in cells], dtype=np.int64)
    try:
        numbers = table.numbers(found[0])
    except DataFileError:
        return None
    if np.any(numbers != np.round(numbers)) or np.any(np.abs(numbers) > 1e9):
        return None
    return numbers.astype(np.int64)
