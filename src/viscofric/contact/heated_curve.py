"""States of all contacts of a friction curve that their own friction heats.

The isothermal curve is solved first.  A contact that is ΔT warmer lies on the same curve at the speed α(T) v:
interpolation gives the rise that it produces at every ΔT, and with it all states of all speeds.  Each is then solved,
mostly once, since its temperature is nearly known.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.contact.heated import LOOSE, HeatCurve, beyond, described, enough, settle, sought
from viscofric.heat.heating import HeatBalance
from viscofric.heat.result import OF_CONTACT
from viscofric.processes import call_all

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from viscofric.arrays import Array
    from viscofric.contact.heated import ThermalContact, Warmed
    from viscofric.heat.branches import State
    from viscofric.heat.result import ContactHeating
    from viscofric.notes import Note
    from viscofric.processes import Workers


#: Rises per decade of α at which states are looked for, and speeds per decade below the slowest one.
_FINE, _BELOW = 40.0, 2.5
_PLACES = np.linspace(0.0, 1.0, 1 + int(_FINE * 10)) ** 2
#: States are looked for up to this rise, K, at first; then up to this many times more.
_FIRST, _FARTHER, _MOST = 30.0, 1.6, 1000.0


class States(NamedTuple):
    """A contact without heating, its coldest and its hottest state, and that of the branch wanted."""

    contact: ThermalContact
    isothermal: Warmed
    cold: Warmed
    hot: Warmed
    wanted: Warmed
    heating: ContactHeating  # of the state wanted
    notes: tuple[Note, ...]


def solve_states(
    curves: Sequence[Sequence[ThermalContact]],
    accuracy: float,
    workers: int | Workers,
    report: Callable[[int], None],
) -> list[States]:
    """Return the states of contacts in the order of all curves, which each differ in speed only.

    `report` gets the number of solved contacts, of twice as many as there are.
    """
    contacts = [one for curve in curves for one in curve]
    calls: list[dict[str, Any]] = [{"contact": one, "accuracy": accuracy} for one in contacts]
    cold = call_all(_isothermal, calls, workers=workers, progress=report)
    starts: list[tuple[int, HeatCurve, State]] = []
    said: dict[int, tuple[Note, ...]] = {}
    first = 0
    for each in curves:
        rows = range(first, first + len(each))
        curve = _Curve(each[0], [cold[row] for row in rows], [one.speed for one in each], accuracy)
        for row in rows:
            found, states, said[row] = curve.states(contacts[row], cold[row])
            starts += [(row, found, one) for one in dict.fromkeys((states[0], states[-1]))]
        first += len(each)
    solved = call_all(
        settle,
        [{**calls[row], "curve": found, "state": one} for row, found, one in starts],
        workers=workers,
        progress=lambda done: report(len(contacts) + min(done, len(contacts))),
    )
    states_of: dict[int, list[Warmed]] = {}
    for (row, _, _), one in zip(starts, solved, strict=True):
        states_of.setdefault(row, []).append(one)
    return [_chosen(contact, cold[row], states_of[row], said[row]) for row, contact in enumerate(contacts)]


def heat_columns(states: Sequence[States]) -> dict[str, Array]:
    """Return the columns of `SolvedHeatColumns`, (n,) each, of contacts."""
    values: dict[str, list[float]] = {name: [getattr(one.heating, name) for one in states] for name in OF_CONTACT} | {
        "isothermal": [abs(one.isothermal.friction) for one in states],
        "cold_viscoelastic": [abs(one.cold.friction) for one in states],
        "cold_rise": [one.cold.rise for one in states],
        "hot_viscoelastic": [abs(one.hot.friction) for one in states],
        "hot_rise": [one.hot.rise for one in states],
    }
    return {name: np.array(column) for name, column in values.items()}


def _isothermal(contact: ThermalContact, accuracy: float) -> Warmed:
    return contact.at(0.0, accuracy)


def _chosen(contact: ThermalContact, isothermal: Warmed, found: list[Warmed], said: tuple[Note, ...]) -> States:
    order = found if contact.heating.branch == "cold" else found[::-1]
    heating, notes = described(contact, order, isothermal.friction)
    return States(contact, isothermal, found[0], found[-1], order[0], heating, (*notes, *said))


class _Curve:
    """The isothermal curve of one temperature, and what contacts at any rise produce."""

    def __init__(self, contact: ThermalContact, solved: list[Warmed], speeds: list[float], accuracy: float) -> None:
        self.contact, self.accuracy = contact, max(LOOSE, accuracy)
        self.friction = {abs(speed): abs(one.friction) for speed, one in zip(speeds, solved, strict=True)}
        self.area = {abs(speed): one.heat.area for speed, one in zip(speeds, solved, strict=True)}

    def log10_drop(self, rise: Array) -> Array:
        """Return by how many decades the curve is passed at rises of temperature."""
        shift, kelvin = self.contact.material.shift, self.contact.kelvin
        assert shift is not None
        return np.asarray(shift.log10(kelvin + rise)) - float(shift.log10(kelvin))

    def states(self, contact: ThermalContact, cold: Warmed) -> tuple[HeatCurve, list[State], tuple[Note, ...]]:
        """Return the curve of one contact over its rise, its stable states, and where a law ends the search."""
        last = _FIRST
        while True:
            reached, ended = contact.reach(0.0, last)
            rise = _PLACES * reached
            curve = self._produced(contact, cold, rise)
            states = curve.states()
            if ended or enough(reached, curve.produced.tolist()) or last > _MOST:
                break
            last *= _FARTHER
        if not states:
            raise beyond(ended, contact.kelvin + reached)
        return curve, states, sought(curve, ended, contact.kelvin)

    def _produced(self, contact: ThermalContact, cold: Warmed, rise: Array) -> HeatCurve:
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
        coulomb: Any = np.full(len(rise), heat.coulomb)
        interface = contact.interface
        if interface is not None and heat.coulomb > 0.0:
            stress = np.asarray(interface(contact.heating.sliding(speed), contact.kelvin + rise))
            coulomb *= stress / stress[0] * larger
        balance = HeatBalance.of(contact.scaled(heat, larger), coulomb, heat.loss * np.exp(log_friction))
        log_friction = log_friction + np.log(max(abs(cold.friction), 1e-300))
        return HeatCurve(rise, np.asarray(contact.heating.rise(balance)), log_friction)

    def _extend(self, lowest: float) -> None:
        """Solve contacts at lower speeds, so that the curve begins at the lowest reduced speed wanted."""
        slowest = min(self.friction)
        while slowest > lowest:
            slowest *= 10.0 ** (-1.0 / _BELOW)
            slower = replace(self.contact, speed=slowest).isothermal(slowest, self.contact.kelvin, self.accuracy)
            self.friction[slowest] = abs(slower.friction_coefficient)
            self.area[slowest] = self.contact.area(slower)
