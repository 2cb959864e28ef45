"""Notes on doubtful isotherms: drifting temperature, outliers, strain amplitudes, curves unlike those of rubber."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viscofric.arrays import Array, Indices
from viscofric.data import Isotherm
from viscofric.errors import DataFileError
from viscofric.notes import Note
from viscofric.readers.dma.readings import AS_AMPLITUDES, Points, Sorted, at
from viscofric.units import shown_celsius

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
#: Even in the glass transition no rubber has a tan δ as large.
LARGEST_LOSS = 10.0
#: A storage modulus never falls with frequency; the loss modulus does beyond its peak, by more than noise or drift.
FALLS = 0.9


def notes_on(points: Points, sweeps: Sequence[Sorted]) -> list[Note]:
    """Return a sentence on each sort of doubt; nothing is left out or changed."""
    return [
        *_on_temperature(points, sweeps),
        *_on_outliers(points, sweeps),
        *on_amplitudes(sweeps),
        *_on_sense(sweeps),
    ]


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
