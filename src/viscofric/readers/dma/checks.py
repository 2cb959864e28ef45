"""Checks of values as printed, and of isotherms: usable points, tan δ and |E*|, plausible units, drift, outliers."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viscofric.arrays import Array, Indices, Mask
from viscofric.data import Isotherm
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.names import COMPLIANCES, MODULI
from viscofric.readers.dma.readings import AS_AMPLITUDES, Points, Sorted, at
from viscofric.readers.table import Table
from viscofric.units import CELSIUS_ZERO, COLDEST_PLAUSIBLE, shown_celsius, shown_number

#: A thousand times diamond.
LARGEST_MODULUS = 1e15  # Pa


def usable(points: Points, source: str) -> tuple[Indices, list[Note]]:
    """Return the usable points, and a note on each kind of those left out."""
    if not len(points):
        raise DataFileError(source, "contains no point of a frequency sweep.", code="no-points")
    notes: list[Note] = []
    keep = np.full(len(points), True)
    for name, plural, column in (
        ("temperature", "temperatures", points.temperature),
        ("frequency", "frequencies", points.angular_frequency),
        ("storage modulus", "storage moduli", points.storage_modulus),
        ("loss modulus", "loss moduli", points.loss_modulus),
    ):
        missing = keep & ~np.isfinite(column)
        _leave_out(points, source, missing, notes, (f"its {name} is missing", f"their {plural} are missing"), None)
        keep &= ~missing
    cold = np.flatnonzero(keep & (points.temperature <= 0.0))
    if cold.size:
        problem = (
            f"{points.places[cold[0]]} has a temperature of {shown_number(float(points.temperature[cold[0]]), '.4g')} "
            "K; "
        )
        raise DataFileError(source, problem + "it must be above absolute zero.", code="not-positive")
    moduli = np.fmax(points.storage_modulus, points.loss_modulus)
    stiff = np.flatnonzero(keep & (moduli > LARGEST_MODULUS))
    if stiff.size:
        problem = f"{points.places[stiff[0]]} has a modulus of {moduli[stiff[0]]:.4g} Pa; no material is as stiff, "
        raise DataFileError(source, problem + "so the number or its unit is wrong.", code="implausible-modulus")
    for name, plural, values, unit in (
        ("frequency", "frequencies", points.angular_frequency / (2 * math.pi), "Hz"),
        ("storage modulus", "storage moduli", points.storage_modulus, "Pa"),
        ("loss modulus", "loss moduli", points.loss_modulus, "Pa"),
    ):
        bad = keep & (values <= 0.0)
        why = (f"its {name} is not above zero", f"their {plural} are not above zero")
        _leave_out(points, source, bad, notes, why, (values, unit), most=name != "loss modulus")
        keep &= ~bad
    if not keep.any():
        raise DataFileError(source, "no row has a loss modulus above zero.", code="points-unusable")
    return np.flatnonzero(keep), notes


def _leave_out(
    points: Points,
    source: str,
    bad: Mask,
    notes: list[Note],
    why: tuple[str, str],
    values: tuple[Array, str] | None,
    *,
    most: bool = True,
) -> None:
    """Add a note, or raise where most points would be left out."""
    rows = np.flatnonzero(bad)
    if not rows.size:
        return
    named = points.named(rows.tolist())
    if most and 2 * len(rows) > len(points):
        raise DataFileError(
            source, f"{len(rows)} of {len(points)} points cannot be used: {why[1]} ({named}).", code="points-unusable"
        )
    first = int(rows[0])
    if len(rows) > 1:
        notes.append(Note("points-left-out", f"{len(rows)} points left out: {why[1]} ({named}{_span(points, rows)})."))
    elif values is None:
        notes.append(Note("points-left-out", f"{_capital(named)} left out: {why[0]}."))
    else:
        hertz = points.angular_frequency[first] / (2 * math.pi)
        where = f"{shown_celsius(points.temperature[first])} °C, {hertz:.4g} Hz"
        said = f"{_capital(named)} left out: {why[0]} ({shown_number(values[0][first], '.4g')} {values[1]} at {where})."
        notes.append(Note("points-left-out", said))


def _span(points: Points, rows: Indices) -> str:
    kelvin = points.temperature[rows]
    kelvin = kelvin[np.isfinite(kelvin)]
    if not kelvin.size:
        return ""
    low, high = (shown_celsius(float(value)) for value in (kelvin.min(), kelvin.max()))
    return f"; at {low} °C" if low == high else f"; {low} to {high} °C"


def _capital(text: str) -> str:
    """Begin a sentence, but leave the names of files as they are."""
    return text[0].upper() + text[1:] if text.startswith(("line ", "row ", "point ", "sheet ")) else text


#: Relative agreement of numbers printed with about two digits,
PRINTED = 0.05
#: and a small tan δ within the last of its two decimals.
LAST_DECIMAL = 0.01


def insist_on_agreement(
    path: str, storage: Array, loss: Array, tangent: Array | None = None, absolute: Array | None = None
) -> None:
    """Raise `DataFileError` if most of the printed tan δ or |E*| do not follow from E' and E''."""
    # Single points may differ: noise about zero, numbers of few digits. Moduli have one unit, NaN if missing.
    used = (storage > 0.0) & (loss > 0.0)
    for printed, name, formula, slack, follows in (
        (tangent, "tan δ", "loss over storage modulus", LAST_DECIMAL, loss[used] / storage[used]),
        (absolute, "|E*|", "√(E'² + E''²)", 0.0, np.hypot(storage[used], loss[used])),
    ):
        if printed is None:
            continue
        values = printed[used]
        known = values > 0.0
        wrong = np.abs(values[known] - follows[known]) > PRINTED * follows[known] + slack
        if 2 * np.count_nonzero(wrong) > wrong.size:
            first = int(np.argmax(wrong))
            problem = f"the {name} of {np.count_nonzero(wrong)} of {wrong.size} points is not {formula}, first "
            problem += (
                f"{shown_number(float(values[known][first]), '.4g')} instead of "
                f"{shown_number(float(follows[known][first]), '.4g')}; are columns swapped, or "
            )
            raise DataFileError(path, problem + "is a unit wrong?", code="columns-contradict")


#: Range of sweeps of rubber in kelvin.
LIKE_KELVIN = (200.0, 500.0)
#: From the thinnest gel to ten times diamond.
PLAUSIBLE_MODULUS = (1.0, 1e13)  # Pa


def doubts(table: Table, places: dict[str, int], temperature: Array, storage_modulus: Array) -> list[str]:
    """Return notes on values, K and Pa, that suggest a wrong unit in a heading; nothing is changed."""
    notes = _of_temperature(table, places["temperature"], temperature) if "temperature" in places else []
    solid = (storage_modulus >= PLAUSIBLE_MODULUS[0]) & (storage_modulus <= PLAUSIBLE_MODULUS[1])
    # values not above zero are noise of the instrument, reported elsewhere
    outside = ~solid & (storage_modulus > 0.0)
    if np.any(outside):
        row = int(np.argmax(outside))
        place = next(places[m] for m in (*MODULI, *COMPLIANCES) if m in places)
        notes.append(
            Note(
                "implausible-modulus",
                f"No solid has a modulus of {storage_modulus[row]:.3g} Pa (line {table.lines[row]}); "
                f"the unit in column {table.columns[place].heading!r} is probably wrong.",
            )
        )
    return notes


def _of_temperature(table: Table, place: int, temperature: Array) -> list[str]:
    known = np.isfinite(temperature)
    if not known.any():
        return []
    printed, heading = table.numbers_or_missing(place)[known], table.columns[place].heading
    low, high = float(printed.min()), float(printed.max())
    span = f"The temperatures in column {heading!r} run from {low:g} to {high:g}"
    in_celsius = np.allclose(temperature[known] - printed, CELSIUS_ZERO, rtol=0.0, atol=1e-6)
    in_kelvin = np.allclose(temperature[known], printed, rtol=1e-9, atol=0.0)
    if in_celsius and low >= LIKE_KELVIN[0] and high <= LIKE_KELVIN[1]:
        return [
            Note(
                "implausible-temperature",
                f"{span} and look like kelvin; they were read in °C, the unit of the heading.",
            )
        ]
    if in_kelvin and high < COLDEST_PLAUSIBLE:
        return [
            Note(
                "implausible-temperature",
                f"{span} and look like °C; they were read in kelvin, the unit of the heading.",
            )
        ]
    return []


#: A temperature that ranges further within one isotherm shifts its ends against each other visibly.
WIDE = 1.0  # K
#: So does one that moves steadily by this from the first point to the last, with this share of its variance.
DRIFT, STEADY = 0.5, 0.8  # K, 1
#: A point is an outlier where it is off its neighbours by so many standard deviations of all points,
SIGMAS = 8.0
#: and by at least this, which smooth curves do not show between neighbours of a sweep.
LEAST_OUTLIER = 0.04  # decades
#: Logarithms (to base 10) of moduli of rubbers in Pa lie within this; no solid is as soft.
LIKE_LOGARITHMS = (3.0, 12.0)  # Pa
#: Even in the glass transition no rubber has a tan δ as large, and no polymer one as small.
LARGEST_LOSS, SMALLEST_LOSS = 10.0, 3e-4
#: A storage modulus never falls with frequency; the loss modulus does beyond its peak, by more than noise or drift.
FALLS = 0.9


#: Sweeps cross a glass transition where E' changes by this factor and tan δ is below this at both of its ends.
TRANSITION, LITTLE_LOSS = 100.0, 0.3
#: The glass is then as stiff as this: from a foam of a twentieth of the density of its polymer, whose modulus is the
#: square of that part, to a carbon composite.  Glasses of 0.5 to 4 GPa with a unit that is wrong by a thousand are not.
GLASSY_MODULUS = (4e6, 5e11)  # Pa


def notes_on(points: Points, sweeps: Sequence[Sorted]) -> list[Note]:
    """Return a sentence on each sort of doubt; nothing is left out or changed."""
    return [
        *_on_glass(sweeps),
        *_on_temperature(points, sweeps),
        *_on_outliers(points, sweeps),
        *on_amplitudes(sweeps),
        *_on_sense(sweeps),
    ]


def _on_glass(sweeps: Sequence[Sorted]) -> list[Note]:
    storage, loss = (
        np.concatenate([getattr(one.isotherm, f"{part}_modulus") for one in sweeps]) for part in ("storage", "loss")
    )
    order, tenth = np.argsort(storage), max(storage.size // 10, 1)
    ends = order[:tenth], order[-tenth:]
    soft, stiff = (float(np.median(storage[rows])) for rows in ends)
    elastic = all(np.median(loss[rows] / storage[rows]) < LITTLE_LOSS for rows in ends)
    if not elastic or stiff < TRANSITION * soft or GLASSY_MODULUS[0] <= stiff <= GLASSY_MODULUS[1]:
        return []
    said = f"E' rises from {soft:.3g} to {stiff:.3g} Pa, as through a glass transition, but a glass has some 10⁹ Pa"
    said += ", unless it is a light foam; check the unit of the moduli."
    return [Note("implausible-modulus", said, values={"soft": soft, "stiff": stiff})]


def _on_temperature(points: Points, sweeps: Sequence[Sorted]) -> list[Note]:
    wide, drifting, furthest, fastest = [], [], 0.0, 0.0
    for one in sweeps:
        # each of several files has its own course of temperature
        spans = [
            points.temperature[one.rows[points.file[one.rows] == file]] for file in np.unique(points.file[one.rows])
        ]
        span, drift = max(float(np.ptp(kelvin)) for kelvin in spans), max(_drift(kelvin) for kelvin in spans)
        if span > WIDE:
            wide.append(one.isotherm.temperature)
            furthest = max(furthest, span)
        elif drift > DRIFT:
            drifting.append(one.isotherm.temperature)
            fastest = max(fastest, drift)
    notes = []
    if wide:
        said = f"The temperature ranges over up to {furthest:.1f} K within the {_isotherm(wide)} {at(wide)}."
        notes.append(Note("temperature-range", said))
    if drifting:
        said = f"drifts steadily, by up to {fastest:.1f} K, within the {_isotherm(drifting)} {at(drifting)}"
        notes.append(Note("temperature-drifts", f"The temperature {said}."))
    return notes


def _isotherm(some: Sequence[float]) -> str:
    return "isotherm" if len(some) == 1 else "isotherms"


def _drift(kelvin: Array) -> float:
    """Return how far a temperature moves steadily over a row of points, K; 0 if it only scatters."""
    if len(kelvin) < 5 or np.ptp(kelvin) == 0.0:
        return 0.0
    place = np.linspace(-0.5, 0.5, len(kelvin))
    about = kelvin - kelvin.mean()
    slope = float(place @ about / (place @ place))
    return abs(slope) if slope**2 * (place @ place) > STEADY * (about @ about) else 0.0


def _on_outliers(points: Points, sweeps: Sequence[Sorted]) -> list[Note]:
    notes = []
    for name in ("storage", "loss"):
        found = outliers([one.isotherm for one in sweeps], name)
        if not found:
            continue
        rows = sorted(int(index) for number, place in found for index in sweeps[number].origins[place])
        number, place = found[0]
        isotherm = sweeps[number].isotherm
        hertz = isotherm.angular_frequency[place] / (2 * math.pi)
        where = f"{shown_celsius(isotherm.temperature)} °C, {hertz:.4g} Hz"
        if len(found) == 1:
            said = f"The {name} modulus at {where} ({points.named(rows)}) is far from its neighbours; it was kept."
        else:
            said = f"{len(found)} {name} moduli are far from their neighbours, the first at {where}; they were kept "
            said += f"({points.named(rows)})."
        notes.append(Note("outlying-modulus", said))
    return notes


def outliers(isotherms: Sequence[Isotherm], name: str) -> list[tuple[int, int]]:
    """Return isotherm and place of points far from the smooth curve of their neighbours in log modulus."""
    # Each point is compared with the parabola through its nearest neighbours, two on either side, in log frequency and
    # log modulus, relative to the scatter of all points of all isotherms (median absolute deviation). The worst point
    # is removed and its neighbours are judged again, so that it does not affect them.
    curves = [
        (np.log10(one.angular_frequency), np.log10(getattr(one, f"{name}_modulus")), np.arange(len(one)))
        for one in isotherms
    ]
    residuals = [_residuals(x, y) for x, y, _ in curves]
    every = np.concatenate([r for r in residuals if r.size] or [np.zeros(0)])
    if every.size < 8:
        return []
    limit = max(SIGMAS * 1.4826 * float(np.median(np.abs(every))), LEAST_OUTLIER)
    found = []
    for number, (x, y, places) in enumerate(curves):
        allowed = max(1, len(x) // 8)
        r = residuals[number]
        while r.size and np.max(np.abs(r)) > limit and allowed > 0:
            worst = int(np.argmax(np.abs(r)))
            found.append((number, int(places[worst])))
            x, y, places = (np.delete(column, worst) for column in (x, y, places))
            r, allowed = _residuals(x, y), allowed - 1
    return sorted(found)


def _residuals(x: Array, y: Array) -> Array:
    """Return each point's distance from the parabola through four neighbours, over its standard deviation."""
    # The ends of a sweep are zero: a parabola is uncertain beyond the last neighbour.
    n = len(x)
    if n < 7:
        return np.zeros(0)
    here = np.arange(1, n - 1)
    first = np.clip(here - 2, 0, n - 5)
    five = first[:, None] + np.arange(5)
    others = five[five != here[:, None]].reshape(-1, 4)
    distance = x[others] - x[here, None]
    distance /= np.max(np.abs(distance), axis=1, keepdims=True)
    # the coefficient of the first power is the parabola's value at the point itself
    powers = np.stack([np.ones_like(distance), distance, distance**2], axis=-1)
    gram = np.swapaxes(powers, 1, 2) @ powers
    weights = (powers @ np.linalg.pinv(gram, rcond=1e-12, hermitian=True)[:, :, :1])[:, :, 0]
    r = np.zeros(n)
    r[1:-1] = (y[here] - np.sum(weights * y[others], axis=1)) / np.sqrt(1.0 + np.sum(weights**2, axis=1))
    return r


def _falls(storage: Array, loss: Array) -> bool:
    """Whether a storage modulus falls over its isotherm while the loss modulus rises."""
    return bool(storage[-1] < FALLS * storage[0] and loss[-1] > loss[0])


def _on_sense(sweeps: Sequence[Sorted]) -> list[Note]:
    """Return notes on what rubber never does: softening on cooling, or dissipating far more than it stores."""
    notes = []
    storage = np.concatenate([one.isotherm.storage_modulus for one in sweeps])
    loss = np.concatenate([one.isotherm.loss_modulus for one in sweeps])
    if storage.min() > LIKE_LOGARITHMS[0] and storage.max() < LIKE_LOGARITHMS[1]:
        span = f"{storage.min():.3g} to {storage.max():.3g}"
        said = f"All storage moduli lie between {span} Pa and look like logarithms; they were read as moduli."
        notes.append(Note("logarithms", said))
    lossy = float(np.median(loss / storage))
    if lossy < SMALLEST_LOSS:
        said = f"Half of all tan δ are below {lossy:.3g}, as of no polymer; are the units of both moduli right?"
        notes.append(Note("implausible-loss", said))
    falls = any(_falls(one.isotherm.storage_modulus, one.isotherm.loss_modulus) for one in sweeps)
    if lossy > (1.0 if falls else LARGEST_LOSS):
        why = "and a storage modulus falls with frequency" if falls else "as of a liquid"
        said = f"Half of all tan δ are above {lossy:.3g}, {why}; are the columns of the moduli swapped?"
        notes.append(Note("columns-swapped", said))
    level = [float(np.median(np.log(one.isotherm.storage_modulus))) for one in sweeps]
    if len(sweeps) > 2 and np.all(np.diff(level) > 0.0):
        notes.append(
            Note(
                "stiffer-when-warmer", "Every isotherm is stiffer than the next colder one; are the temperatures right?"
            )
        )
    return notes


#: Strain amplitudes of isotherms that differ by more than this factor get a note.
AMPLITUDES_DIFFER = 1.2
#: A frequency that is held scatters by less than this as it is measured; no sweep has as many points,
HELD_FREQUENCY = 0.05
#: and so many of them with amplitudes that differ by more than this factor are those of an amplitude sweep.
AMPLITUDE_SWEEP, SWEPT_AMPLITUDE = 3, 2.0


def of_one_amplitude(points: Points, rows: Indices, source: str) -> tuple[Indices, list[Note]]:
    """Return the rows of one isotherm of one strain amplitude, and a note on those at others that are left out."""
    # Points at frequencies that were measured at several amplitudes are those of repeated sweeps, or of an amplitude
    # sweep before the frequency sweep: the amplitude that covers most frequencies, of several the smallest, is kept.
    known = rows[points.strain_amplitude[rows] > 0.0]
    held, swept = _swept(points, known)
    if len(swept) < AMPLITUDE_SWEEP:
        return rows, []
    amplitude, kelvin = points.strain_amplitude[swept], float(np.mean(points.temperature[rows]))
    span = f"{100 * amplitude.min():.3g} to {100 * amplitude.max():.3g} %"
    levels = np.unique(points.strain_amplitude[known])
    near = np.abs(np.log(points.strain_amplitude[known] / levels[:, None])) < np.log(AMPLITUDES_DIFFER)
    covered = np.array([len(np.unique(held[one])) for one in near])
    best = int(np.argmax(covered))
    if covered[best] < AMPLITUDE_SWEEP or covered[best] <= np.median(np.unique(held, return_counts=True)[1]):
        problem = (
            f"{at([kelvin])} the strain amplitude runs from {span} at one frequency ({points.named(swept)}); frequency "
        )
        raise DataFileError(
            source,
            problem + "sweeps at one amplitude are needed, not an amplitude sweep",
            code="amplitude-sweep",
            remedy=AS_AMPLITUDES,
        )
    beside = np.isin(known, swept) & ~near[best]
    out = known[beside]
    said = (
        f"The strain amplitude runs from {span} {at([kelvin])}; points at about {100 * levels[best]:.3g} % are used, "
    )
    left = f"{len(out)} at other amplitudes are left out ({points.named(out.tolist())})."
    values = {"used": float(levels[best]), "points": len(out), "temperature": float(kelvin)}
    return np.setdiff1d(rows, out, assume_unique=True), [Note("other-amplitudes", said + left, values=values)]


def _swept(points: Points, rows: Indices) -> tuple[Array, list[int]]:
    """Return the numbers of the frequencies of points, and the points whose frequency has several amplitudes."""
    held = np.round(np.log(points.angular_frequency[rows]) / HELD_FREQUENCY)
    swept: list[int] = []
    for one in np.unique(held):
        same = rows[held == one]
        amplitude = points.strain_amplitude[same]
        if amplitude.max() > SWEPT_AMPLITUDE * amplitude.min():
            swept += same.tolist()
    return held, swept


def on_amplitudes(sweeps: Sequence[Sorted]) -> list[Note]:
    """Return notes on differing strain amplitudes: the modulus of a filled rubber falls with amplitude."""
    # A. R. Payne, J. Appl. Polym. Sci. 6 (1962) 57, doi:10.1002/app.1962.070061906.
    known = []
    for one in sweeps:
        amplitude = one.isotherm.strain_amplitude
        if amplitude is not None and np.any(amplitude > 0.0):
            known.append((amplitude[amplitude > 0.0], one.isotherm.temperature))
    if not known:
        return []
    falls = (
        "the modulus of a filled rubber falls with amplitude (Payne effect), which superposition would take for one of "
    )
    notes = []
    (least, at_least), (most, at_most) = (f((float(np.median(one)), T) for one, T in known) for f in (min, max))
    if most > AMPLITUDES_DIFFER * least:
        said = f"The strain amplitudes of the isotherms differ, from {100 * least:.3g} % {at([at_least])} to "
        values = {"least": least, "least_at": at_least, "most": most, "most_at": at_most}
        said = f"{said}{100 * most:.3g} % {at([at_most])}; {falls}temperature."
        notes.append(Note("amplitudes-differ", said, values=values))
    within = [(one, T) for one, T in known if one.max() > AMPLITUDES_DIFFER * one.min()]
    if within:
        widest, where = max(within, key=lambda each: float(each[0].max() / each[0].min()))
        isotherms = "an isotherm" if len(within) == 1 else f"{len(within)} isotherms"
        said = f"The strain amplitude varies within {isotherms}"
        span = f"{100 * widest.min():.3g} to {100 * widest.max():.3g} % {at([where])}"
        notes.append(Note("amplitudes-differ", f"{said}, at most from {span}; {falls}frequency."))
    return notes
