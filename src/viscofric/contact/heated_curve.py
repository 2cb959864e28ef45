"""States of all contacts of a friction curve that their own friction heats.

The isothermal curve is solved first.  A contact that is ΔT warmer lies on the same curve at the speed α(T) v:
interpolation gives the rise that it produces at every ΔT, and with it all states of all speeds.  Each is then solved,
mostly once, since its temperature is nearly known.  Resistances are found from the fields of the contacts at a few
speeds, the knots, which are solved before the others; of these numbers are enough, which may be interpolated.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from functools import cache, cached_property, partial
from typing import Any, NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.heated import LOOSE, States, ThermalContact, enough, sought
from viscofric.contact.heated_knots import Between, Knot, knots_of
from viscofric.contact.heated_result import Heat, Warmed, beyond
from viscofric.heat.branches import HeatCurve, State, outermost, settling
from viscofric.heat.heating import ThermalResistances
from viscofric.heat.result import OF_CONTACT
from viscofric.notes import Note
from viscofric.processes import Workers, call_all

#: Rises per decade of α at which states are looked for, and speeds per decade below the slowest one.
_FINE, _BELOW = 40.0, 2.5
_PLACES = np.linspace(0.0, 1.0, 1 + int(_FINE * 10)) ** 2
#: States are looked for up to this rise, K, at first; then up to this many times more.
_FIRST, _FARTHER, _MOST = 30.0, 1.6, 1000.0
#: Decades of α within which a contact keeps its resistances: rises change by less than their residual.
_ALIKE = 0.01
#: Of the knots, each so many-th has resistances without heating: they only tell near which rise its states are.
_COLD_KNOTS = 2


def solve_states(
    curves: Sequence[Sequence[ThermalContact]],
    accuracy: float,
    workers: Workers,
    report: Callable[[int], None],
    shared: Callable[[Sequence[tuple[float, float]]], Sequence[Any]] | None = None,
) -> list[States]:
    """Return the states of contacts in the order of all curves, which each differ in speed only.

    `report` gets the number of solved contacts, of twice as many as there are.  `shared` may give the numbers of
    contacts at speeds and temperatures, which differ in nothing else.
    """
    every = [_Curve(one, accuracy) for one in curves]
    count = sum(map(len, curves))
    for at_knots in (True, False):
        rows = [(one, row) for one in every for row in one.rows(one.cold_knots, at_knots)]
        solver = _Solver(accuracy, workers, shared, partial(_add, report, sum(len(one.cold) for one in every), count))
        solved = solver.solve([one.isothermal(row) for one, row in rows])
        for (curve, row), one in zip(rows, solved, strict=True):
            curve.cold[row] = one
    for at_knots in (True, False):
        starts = [start for one in every for start in one.starts(at_knots)]
        before = count + sum(len(one.settled) for one in every)
        solver = _Solver(accuracy, workers, shared, partial(_add, report, before, 2 * count))
        for start, one in zip(starts, solver.settle(starts), strict=True):
            start.of.settled.setdefault(start.row, []).append(one)
    return [states for one in every for states in one.chosen()]


def _add(report: Callable[[int], None], before: int, most: int, done: int) -> None:
    report(min(before + done, most))


class _Call(NamedTuple):
    """A contact to be solved at a rise of temperature; other arguments as of `ThermalContact.at`."""

    contact: ThermalContact
    rise: float = 0.0
    relative: ThermalResistances | None = None
    hot: bool = False


class _Start(NamedTuple):
    """A state of a contact of a curve, near which it is to be found."""

    of: _Curve
    row: int
    curve: HeatCurve
    state: State
    near: Knot | None

    def settling(self, accuracy: float) -> Generator[_Call, Warmed, float]:
        """Yield the contact at rises until the one that it produces agrees, and take what it has produced.

        Return how its friction feels an error of the rise, as in `Warmed`.

        It keeps its resistances where α has hardly changed since they were found.
        """
        contact = self.of.contacts[self.row]
        relative = None if self.near is None else self.near.relative
        steps = settling(self.state, lambda rise: self.curve.tolerance(rise, accuracy), self.curve.limits)
        rise, found = next(steps), None
        while True:
            shift = contact.log10_shift(contact.kelvin + rise)
            kept = found[1] if found is not None and abs(shift - found[0]) <= _ALIKE else relative
            one = yield _Call(contact, rise, kept, self.state.hot)
            if kept is None:
                found = shift, contact.relative(one.heat)
            try:
                rise = steps.send(one.produced)
            except StopIteration as end:
                return self.curve.felt(end.value[0])


class _Solver(NamedTuple):
    """Solves many contacts; see `solve_states`."""

    accuracy: float
    workers: Workers
    shared: Callable[[Sequence[tuple[float, float]]], Sequence[Any]] | None
    report: Callable[[int], None]

    def solve(self, calls: Sequence[_Call], before: int = 0) -> list[Warmed]:
        """Return the solved contacts; numbers of those with known resistances are interpolated if they can be.

        So many have been found before, which the report includes.
        """
        found: dict[int, Warmed] = {}
        known = [row for row, one in enumerate(calls) if self.shared is not None and one.relative is not None]
        if known:
            assert self.shared is not None
            places = [(one.contact.speed, one.contact.kelvin + one.rise) for one in (calls[row] for row in known)]
            for row, numbers in zip(known, self.shared(places), strict=True):
                one = calls[row]
                found[row] = one.contact.warmed(numbers, one.rise, one.relative, hot=one.hot)
            self.report(before + len(found))
        alone = [row for row in range(len(calls)) if row not in found]
        solved = call_all(
            _at,
            [{**calls[row]._asdict(), "accuracy": self.accuracy} for row in alone],
            workers=self.workers,
            progress=lambda done: self.report(before + len(known) + done),
        )
        found |= dict(zip(alone, solved, strict=True))
        return [found[row] for row in range(len(calls))]

    def settle(self, starts: Sequence[_Start]) -> list[Warmed]:
        """Return the contacts at the rises that they produce, solved together, in waves."""
        found: dict[int, Warmed] = {}
        searches = {row: start.settling(self.accuracy) for row, start in enumerate(starts)}
        calls = {row: next(one) for row, one in searches.items()}
        while calls:
            more: dict[int, _Call] = {}
            for row, one in zip(calls, self.solve(list(calls.values()), len(starts) - len(calls)), strict=True):
                found[row] = one
                try:
                    more[row] = searches[row].send(one)
                except StopIteration as end:
                    found[row] = one._replace(felt=end.value)
            calls = more
        return [found[row] for row in range(len(starts))]


def heat_columns(states: Sequence[States]) -> dict[str, Array]:
    """Return the columns of `SolvedHeatColumns`, (n,) each, of contacts."""
    values: dict[str, list[float]] = {name: [getattr(one.heating, name) for one in states] for name in OF_CONTACT} | {
        "isothermal_friction": [abs(one.isothermal.friction) for one in states],
        "cold_friction": [abs(one.cold.friction) for one in states],
        "cold_rise": [one.cold.rise for one in states],
        "hot_friction": [abs(one.hot.friction) for one in states],
        "hot_rise": [one.hot.rise for one in states],
    }
    return {name: np.array(column) for name, column in values.items()}


def _at(contact: ThermalContact, **given: Any) -> Warmed:
    return contact.at(**given)


class _Curve:
    """The isothermal curve of one temperature, and what contacts at any rise produce."""

    def __init__(self, contacts: Sequence[ThermalContact], accuracy: float) -> None:
        self.contacts, self.contact = contacts, contacts[0]
        self.wanted, self.accuracy = accuracy, max(LOOSE, accuracy)
        self.knots = knots_of(contacts)
        self.cold_knots = sorted({*self.knots[::_COLD_KNOTS], *self.knots[-1:]})
        self.cold: dict[int, Warmed] = {}
        self.settled: dict[int, list[Warmed]] = {}  # the coldest and the hottest state, if there are two

    def rows(self, knots: Sequence[int], at_knots: bool) -> list[int]:
        """Return the rows of contacts at knots, or those of all others."""
        return list(knots) if at_knots else sorted({*range(len(self.contacts))} - {*knots})

    def _speeds(self, rows: Sequence[int]) -> list[float]:
        return [abs(self.contacts[row].speed) for row in rows]

    def isothermal(self, row: int) -> _Call:
        """Return a contact without heating, to be solved; those at knots come first."""
        near = None if row in self.cold_knots else self._cold_between(abs(self.contacts[row].speed))
        return _Call(self.contacts[row], relative=None if near is None else near.relative)

    @cached_property
    def _cold_between(self) -> Between:
        knots = [Knot.of(self.contacts[row], self.cold[row].heat) for row in self.cold_knots]
        return Between(self._speeds(self.cold_knots), knots)

    def starts(self, at_knots: bool) -> list[_Start]:
        """Return where the states of contacts are searched for; those at knots come first."""
        if at_knots:
            columns = [(abs(self.contacts[row].speed), one) for row, one in sorted(self.cold.items())]
            self.friction = {speed: abs(one.friction) for speed, one in columns}
            self.area = {speed: one.heat.area for speed, one in columns}
            self.found = [self.states(one, self.cold[row]) for row, one in enumerate(self.contacts)]
        found = []
        for row in self.rows(self.knots, at_knots):
            curve, states, _ = self.found[row]
            for branch, state in enumerate(states):
                between = None if at_knots else self._branch(len(states), branch)
                near = None if between is None else between(abs(self.contacts[row].speed))
                rise = state.rise if near is None else min(state.rise * math.exp(near.rise), curve.limits[1])
                found.append(_Start(self, row, curve, state._replace(rise=rise), near))
        return found

    def chosen(self) -> list[States]:
        """Return the states of all contacts."""
        return [
            States.of(one, self.cold[row], self.settled[row], self.found[row][2])
            for row, one in enumerate(self.contacts)
        ]

    @cache  # noqa: B019 (a curve lives as long as its solve)
    def _branch(self, count: int, branch: int) -> Between:
        """Return the settled knots of a branch, of those with so many states."""
        knots: list[Knot | None] = []
        for row in self.knots:
            states, settled = self.found[row][1], self.settled[row]
            if len(states) != count:
                knots.append(None)
                continue
            expected, one = states[branch].rise, settled[branch]
            off = math.log(one.produced / expected) if min(one.produced, expected) > 0.0 else 0.0
            drop = float(self.log10_drop(np.asarray(one.rise)))
            knots.append(Knot.of(self.contacts[row], one.heat, drop, off))
        return Between(self._speeds(self.knots), knots)

    def log10_drop(self, rise: Array) -> Array:
        """Return by how many decades the curve is passed at rises of temperature."""
        shift, kelvin = self.contact.material.shift, self.contact.kelvin
        assert shift is not None
        return np.asarray(shift.log10(kelvin + rise)) - float(shift.log10(kelvin))

    def states(self, contact: ThermalContact, cold: Warmed) -> tuple[HeatCurve, list[State], tuple[Note, ...]]:
        """Return the curve of one contact over its rise, its outermost states, and where a law ends the search."""
        last = _FIRST
        while True:
            reached, ended = contact.reach(0.0, last)
            rise = _PLACES * reached
            curve, hottest = self._produced(contact, cold, rise)
            states = outermost(curve, hottest)
            if ended or enough(reached, curve.produced.tolist()) or last > _MOST:
                break
            last *= _FARTHER
        if not states:
            raise beyond(ended, contact.kelvin + reached)
        return curve, states, sought(curve, ended, contact.kelvin)

    def _produced(self, contact: ThermalContact, cold: Warmed, rise: Array) -> tuple[HeatCurve, HeatCurve]:
        """Return what one contact produces at its rises, with its interface in the coldest and the hottest state."""
        from scipy.interpolate import PchipInterpolator

        speed, heat = abs(contact.speed), cold.heat
        reduced = np.log(speed) + np.log(10.0) * self.log10_drop(rise)
        self._extend(float(np.exp(reduced.min())))
        speeds = np.array(sorted(self.friction))
        log_friction = log_area = np.zeros(len(rise))
        if len(speeds) > 1:
            log_friction, log_area = (
                PchipInterpolator(np.log(speeds), np.log([max(column[one], 1e-300) for one in speeds]))(reduced)
                for column in (self.friction, self.area)
            )
        log_friction = log_friction - log_friction[0]
        larger = np.exp(log_area - log_area[0])
        columns: Any = heat.coulomb * np.ones(len(rise)), heat.loss * np.exp(log_friction), heat.area * larger
        every = Heat(contact.scaled(heat, larger), columns[0], columns[1], columns[2], heat.size)
        log_friction = log_friction + np.log(max(abs(cold.friction), 1e-300))

        def curve(hot: bool) -> HeatCurve:
            balance = contact.with_interface(every, rise, hot=hot).balance
            return HeatCurve(rise, np.asarray(contact.heating.rise(balance)), log_friction)

        only = curve(False)
        return only, only if contact.interface is None or contact.heating.average == "contact" else curve(True)

    def _extend(self, lowest: float) -> None:
        """Solve contacts at lower speeds, so that the curve begins at the lowest reduced speed wanted."""
        slowest = min(self.friction)
        while slowest > lowest:
            slowest *= 10.0 ** (-1.0 / _BELOW)
            slower = replace(self.contact, speed=slowest).isothermal(slowest, self.contact.kelvin, self.accuracy)
            self.friction[slowest] = abs(slower.friction_coefficient)
            self.area[slowest] = self.contact.area(slower)
