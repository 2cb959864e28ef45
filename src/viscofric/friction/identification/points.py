"""Friction for an identification, at one load, with standard errors moderated by neighbours."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array, Integers, Mask
from viscofric.contact.indenters.height_map import HeightMap, Profile
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError
from viscofric.friction.curve_checks import (
    PARABOLA,
    Decades,
    error_freedom,
    scatter_about_parabolas,
    standard_errors,
)
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.measurement.assumed_coulomb import COULOMB_ASSUMED
from viscofric.friction.shifting.load_rule import LoadRule
from viscofric.nominal import SAME_LOAD
from viscofric.notes import Note, Remedy, note_of
from viscofric.units import Quantity, positive, shown_celsius, shown_number, shown_speed

#: Fewer points do not determine a spectrum's shape.
FEWEST_POINTS = 6
#: Part of modelled friction that is left by errors in common, below which ln μ is continued.
LEAST_LEFT = 1e-3


@dataclass(frozen=True, eq=False)
class Points:
    """n measured friction coefficients, those of other loads transferred to one."""

    log_speed: Array  # (n,), ln of the speed at which the rubber is deformed, of a similar contact under `load`; m/s
    log_load: Array  # (n,), ln of the load over `load`, zero where similarity accounts for it
    log_scale: Array  # (n,), ln of a scale of μ of that contact: of its magnitude, or of its error where that is larger
    friction: Array  # (n,), μ over the scale
    logarithmic: Mask  # (n,), whether ln μ is fitted: points far above zero; else μ itself, which then may be below
    error: Array  # (n,), standard error of μ over the scale
    temperatures: Array  # (t,), different ones, ascending, K
    number: Integers  # (n,), index of each point's temperature
    load: float  # N or N/m
    forces: Array  # (n,), measured loads, N or N/m
    raised: Array  # (n,), ln of the measured friction over that of the contact under `load`
    rows: Integers  # (n,), rows of the curves that the points come from
    shared: Array  # (n, k), errors that points have in common, k independent ones of one standard error
    absolute: Mask  # (k,), whether each is an error of μ over the scale, as of a subtracted friction, or else of ln μ
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.log_speed)

    def at_one_load(self, curves: FrictionCurves) -> FrictionCurves:
        """Return the friction under `load` with the errors used, as curves."""
        scale = np.exp(self.log_scale)
        return replace(
            curves.select(self.rows),
            speed=np.exp(self.log_speed),
            load=np.full(len(self), self.load),
            viscoelastic=self.friction * scale,
            viscoelastic_error=self.error * scale,
            viscoelastic_scatter=np.zeros(len(self)),
            replicates=np.ones(len(self), dtype=np.int64),
            viscoelastic_freedom=np.full(len(self), np.inf),
        )

    def with_shared(self, errors: Array, absolute: Mask) -> Points:
        """Return the points with more errors in common (n, k)."""
        shared = np.hstack([self.shared, errors])
        return replace(self, shared=shared, absolute=np.concatenate([self.absolute, absolute]))

    def missed(self, log_friction: Array, common: Array) -> tuple[Array, Array, Array]:
        """Return modelled minus measured friction over the scale, or of ln μ (n,), and its derivatives.

        `common` (k,) are the errors that points have in common. The derivatives are by the modelled ln μ (n,), and by
        these errors (n, k).
        """
        factors, amounts = (np.where(kind, self.shared, 0.0) for kind in (~self.absolute, self.absolute))
        friction = np.exp(log_friction + factors @ common - self.log_scale)
        measured = friction + amounts @ common
        # While a fit is sought an error may exceed the friction: the logarithm then goes on as its tangent.
        least = np.maximum(measured, LEAST_LEFT * friction)
        away = np.where(self.logarithmic, np.log(least) + measured / least - 1.0, measured - self.friction)
        unit = np.where(self.logarithmic, least, 1.0)
        by_value = friction / unit + np.where(self.logarithmic, 1.0 - measured / least, 0.0)
        return away, by_value, by_value[:, None] * factors + amounts / unit[:, None]

    def chosen(self, keep: Mask) -> Points:
        """Return some of the points, by a mask (n,)."""
        columns = ("log_speed", "log_load", "log_scale", "friction", "logarithmic", "error", "number", "forces")
        return replace(self, **{name: getattr(self, name)[keep] for name in (*columns, "raised", "rows", "shared")})


def usable_points(
    curves: FrictionCurves, indenter: Indenter, load: Quantity | None, least_error: float, *, assumed: bool = True
) -> Points:
    """Return the usable points of friction curves."""
    # `load` is that of all points; without it, each has its own. `least_error` is the smallest relative error of a
    # point: that of the solved contacts. With `assumed`, the error of a Coulomb friction that was assumed is one that
    # points share.
    unit = indenter.geometry.load_unit
    if load is None and len(curves) and curves.load_unit != unit:
        raise InputError(
            f"load of the friction curves is in {curves.load_unit}, but a {indenter.noun} takes a load in {unit}; "
            "give the indenter that was measured with, or the load.",
            code="load-unit",
        )
    notes: list[str] = []
    shared = _errors_assumed(curves) if assumed else np.zeros((len(curves), 0))
    if len(curves) and not np.any(np.isfinite(curves.viscoelastic_error)):
        error = scatter_about_parabolas(curves)
        if error is None:
            raise InputError(
                "friction curves have no standard errors that are known, and too few points at each temperature to "
                "find the scatter from: give viscoelastic_error (in a table, a column 'viscoelastic friction standard "
                "error').",
                code="no-errors",
            )
        curves = replace(curves, viscoelastic_error=error * np.abs(curves.viscoelastic))
        found = Note(
            "errors-from-scatter",
            f"The friction curves have no standard errors; {100.0 * error:.2g} % is assumed, the scatter of the points "
            "of each temperature about a parabola.",
            values={"relative_error": error},
        )
        notes.append(found)
    else:
        curves = _without(curves, shared)
    notes.extend(error_freedom(curves)[1])
    rows = np.flatnonzero(np.isfinite(curves.viscoelastic_error))
    if len(rows) < len(curves):
        notes.append(
            Note(
                "points-without-error",
                f"{len(curves) - len(rows)} of {len(curves)} points have no standard error that is known and were left "
                "out.",
                values={"points": len(curves) - len(rows), "of": len(curves)},
            )
        )
    if len(rows) < FEWEST_POINTS:
        raise InputError(
            f"friction curves hold {len(rows)} usable points: too few to identify a material; give {FEWEST_POINTS} or "
            "more, better ten per decade of reduced speed.",
            code="too-few-points",
        )
    friction = curves.viscoelastic[rows]
    own = curves.viscoelastic_error[rows]
    size = np.maximum(np.abs(friction), own)
    if not np.all(np.maximum(friction, own) > 0.0):
        worst = rows[int(np.argmin(np.maximum(friction, own)))]
        raise InputError(
            f"viscoelastic friction is {shown_number(float(curves.viscoelastic[worst]), '.3g')} at "
            f"{shown_speed(float(curves.speed[worst]))} and "
            f"{shown_celsius(float(curves.temperature[worst]))} °C, with a standard error of zero: no rubber has it; "
            "give the standard error, or check the signs of the measurement.",
            code="friction-not-positive",
        )
    forces = curves.load[rows] if load is None else np.full(len(rows), positive(load, unit, "load"))
    middle = float(np.exp(np.mean(np.log(forces))))
    relative = np.log(forces / middle)
    alike = not isinstance(indenter, HeightMap | Profile)
    if not alike and np.ptp(relative) > np.log1p(SAME_LOAD):
        raise InputError(
            f"load of the friction curves runs from {forces.min():.3g} to {forces.max():.3g} {unit}, but contacts of "
            f"a {indenter.noun} at different loads are not similar; choose one",
            code="several-loads",
            remedy=Remedy(" with curves.at_load()", "", page="") + ".",
        )
    rule = LoadRule.of(indenter) if alike else LoadRule(0.0, 0.0)
    temperatures, number = np.unique(curves.temperature[rows], return_inverse=True)
    usable = Points(
        log_speed=np.log(curves.speed[rows]) - rule.size * relative,
        log_load=np.zeros(len(rows)) if alike else relative,
        log_scale=np.log(size) - rule.strain * relative,
        friction=friction / size,
        logarithmic=~Decades.of(friction, own).near(friction, own),
        error=np.hypot(standard_errors(curves.select(rows)) / size, least_error),
        temperatures=temperatures,
        number=number.astype(np.int64),
        load=middle,
        forces=forces,
        raised=rule.strain * relative,
        rows=rows,
        shared=np.zeros((len(rows), 0)),
        absolute=np.zeros(0, dtype=bool),
        notes=tuple(notes),
    )
    return usable.with_shared(shared[rows] / size[:, None], np.full(shared.shape[1], True))


def _errors_assumed(curves: FrictionCurves) -> Array:
    """Return errors of viscoelastic friction by assumed Coulomb friction, (n, k), one column for each assumption."""
    if curves.coulomb is None or curves.coulomb_error is None:
        return np.zeros((len(curves), 0))
    senses: dict[tuple[float, float], set[float]] = {}
    for note in map(note_of, curves.notes):
        if note.code == COULOMB_ASSUMED and note.values.get("error") and "senses" in note.values:
            senses.setdefault((note.values["coulomb"], note.values["error"]), set()).update(note.values["senses"])
    found: list[Array] = []
    for (value, error), some in sorted(senses.items()):
        if len(some) == 1:  # otherwise points have the error with either sign
            there = np.isclose(curves.coulomb, value, rtol=1e-6) & np.isclose(curves.coulomb_error, error, rtol=1e-6)
            found.append(np.where(there & (curves.viscoelastic_error > (1.0 - 1e-6) * error), error, 0.0))
    return np.array(found).reshape(-1, len(curves)).T


def _without(curves: FrictionCurves, shared: Array) -> FrictionCurves:
    """Return the curves without errors (n, k) that points share, and with the degrees of freedom of what is left."""
    total = curves.viscoelastic_error
    own = np.sqrt(np.maximum(total**2 - np.sum(shared**2, axis=1), 0.0))
    if curves.viscoelastic_freedom is None:
        return replace(curves, viscoelastic_error=own)
    # Welch and Satterthwaite's formula backwards, where the shared part has infinite degrees of freedom.
    part = np.divide(own, total, out=np.ones(len(own)), where=np.isfinite(total) & (total > 0.0))
    return replace(curves, viscoelastic_error=own, viscoelastic_freedom=curves.viscoelastic_freedom * part**4)


class SharedErrors(NamedTuple):
    """Relative standard errors of friction that points have in common, and that of temperature, K."""

    level: float = 0.0
    common: float = 0.0
    drift: float = 0.0
    coulomb_level: float = 0.0
    temperature: float = 0.0

    def given_to(self, points: Points, curves: FrictionCurves, per_kelvin: Array | None) -> Points:
        """Return points of these curves with the errors, each independent one a column of `Points.shared`.

        `per_kelvin` (t,) is d ln α/dT at the temperatures of the points, None where it is not known.
        """
        measured = curves.select(points.rows)
        found = []
        if self.common > 0.0:
            found.append(np.full(len(points), self.common))
        if self.drift > 0.0:
            decades = np.log10(measured.speed)
            found.append(self.drift * (decades - 0.5 * (decades.min() + decades.max())))
        if self.level > 0.0:
            found += [np.where(points.number == one, self.level, 0.0) for one in np.unique(points.number)]
        if self.temperature > 0.0:
            if per_kelvin is None:
                raise InputError(
                    f"temperature_error = {self.temperature:g} K: friction at one temperature does not tell how α "
                    "changes with it; give the shift factors, or leave it out.",
                    code="no-shift-factors",
                )
            # Another temperature moves the curve along ln v, so that friction changes by its slope.
            slope = self.temperature * per_kelvin[points.number] * _slopes(points)
            found += [np.where(points.number == one, slope, 0.0) for one in np.unique(points.number)]
        absolute = [False] * len(found)
        if self.coulomb_level > 0.0:
            if measured.coulomb is None:
                raise InputError(
                    f"coulomb_level_error = {self.coulomb_level:g}: the friction curves have no Coulomb friction; "
                    "leave it out.",
                    code="no-coulomb",
                )
            size = np.maximum(np.abs(measured.viscoelastic), measured.viscoelastic_error)
            found.append(self.coulomb_level * measured.coulomb / size)
            absolute.append(True)
        return points.with_shared(np.array(found).reshape(-1, len(points)).T, np.array(absolute, dtype=bool))


def _slopes(points: Points) -> Array:
    """Return d ln μ/d ln v of the points (n,), from the parabola through those of their temperature."""
    found = np.zeros(len(points))
    for one in np.unique(points.number):
        rows = points.number == one
        speed = points.log_speed[rows] - points.log_speed[rows].mean()
        order = min(PARABOLA, np.unique(speed).size) - 1
        found[rows] = np.polyval(np.polyder(np.polyfit(speed, points.log_scale[rows], order)), speed)
    return found
