"""The states of a contact in which its friction and its temperature agree."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from viscofric.contact.heating import heats, thermal_resistances
from viscofric.errors import InputError
from viscofric.heat.branches import State, settled, stable_states
from viscofric.heat.heating import HeatBalance
from viscofric.heat.result import ContactHeating
from viscofric.notes import Note, Remedy
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.contact.fields.dissipation import Modes
    from viscofric.contact.solution import ContactSolution
    from viscofric.heat.heating import Heating, ThermalResistances
    from viscofric.rheology.interface.law import InterfaceLaw


#: What gives friction at the temperature where the loss is released.
AT_THE_LOSS = Remedy(
    "Heating(average='loss')", "--heating-average loss", "average = 'loss' under [heating]", field="heating.average"
)
#: Of the contacts among which states are looked for.
LOOSE = 2e-2
#: Between two of them α falls by this much, log10, or the temperature rises by this many K.
_DECADES, _KELVIN = 0.4, 10.0
#: States are looked for up to this rise, K, and up to this multiple of the largest rise that a contact produced.
_LEAST, _BEYOND = 30.0, 2.0
#: Share of the rise that may be left; its effect on friction may be half of the accuracy.
_LEFT = 0.01
#: Below it, over the contact radius, the heat of a passing contact is in a skin.
THIN = 0.5


class Warmed(NamedTuple):
    """A contact solved at a rise of temperature, K, and the rise that it produces, K."""

    rise: float
    solution: ContactSolution
    resistances: ThermalResistances
    produced: float


@dataclass(frozen=True)
class ThermalContact:
    """One contact at any rise of temperature."""

    heating: Heating
    kelvin: float  # without heating
    poisson_ratio: float
    log10_shift: Callable[[float], float]  # at a temperature, K; InputError where it is not known
    modes: Callable[[float], Modes]
    solve: Callable[[float, float], ContactSolution]  # at a temperature, K, to an accuracy
    interface: InterfaceLaw | None = None  # whose heat takes the place of a constant Coulomb friction

    def at(self, rise: float, accuracy: float) -> Warmed:
        """Solve the contact at a rise of temperature."""
        kelvin = self.kelvin + rise
        solution = self.solve(kelvin, accuracy)
        resistances = thermal_resistances(solution, self.modes(kelvin), self.poisson_ratio, self.heating)
        balance = HeatBalance.of(resistances, *heats(solution, self.heating, self.interface))
        return Warmed(rise, solution, resistances, self.heating.rise(balance))

    def next_rise(self, rise: float) -> float:
        """Return a rise at which α is noticeably smaller; raise InputError where α ends before."""
        kelvin = self.kelvin + rise
        slope = self.log10_shift(kelvin) - self.log10_shift(kelvin + 1.0)
        step = min(_KELVIN, _DECADES / max(slope, 1e-6))
        self.log10_shift(kelvin + step)
        return rise + step


def enough(rise: float, produced: list[float]) -> bool:
    """Whether no state is to be expected beyond a rise, K, from what contacts up to it produce."""
    return rise >= max(_LEAST, _BEYOND * max(produced))


def solve_heated(contact: ThermalContact, accuracy: float) -> ContactSolution:
    """Return the contact in the state of the branch wanted.

    Raises InputError if α is not known up to the temperature of the contact, ConvergenceError if the solves do not
    settle.
    """
    isothermal = contact.at(0.0, accuracy)
    scanned = [isothermal]
    ended: InputError | None = None
    while not enough(scanned[-1].rise, [one.produced for one in scanned]):
        try:
            rise = contact.next_rise(scanned[-1].rise)
        except InputError as error:
            ended = error
            break
        scanned.append(contact.at(rise, max(LOOSE, accuracy)))
    curve = HeatCurve.of(scanned)
    states = curve.states()
    if not states:
        raise beyond_shift(contact.kelvin + scanned[-1].rise) from ended
    found = [settle(contact, curve, one, accuracy) for one in dict.fromkeys((states[0], states[-1]))]
    order = found if contact.heating.branch == "cold" else found[::-1]
    return finished(order, isothermal.solution.friction_coefficient, contact.heating)


def beyond_shift(kelvin: float) -> InputError:
    """Return the error of a contact that is hotter than α is known."""
    return InputError(
        f"The contact heats beyond {shown_celsius(kelvin)} °C, up to which α(T) is known; reduce the heat, or give a "
        "shift law that is valid at higher temperatures.",
        code="beyond-shift",
        values={"temperature": kelvin},
    )


class HeatCurve(NamedTuple):
    """Rises (n,) from zero on, those that contacts at them produce, K, and the logarithms of their friction."""

    rise: Array
    produced: Array
    log_friction: Array

    @classmethod
    def of(cls, scanned: list[Warmed]) -> HeatCurve:
        """Return smooth curves through contacts."""
        from scipy.interpolate import PchipInterpolator

        rise = np.array([one.rise for one in scanned])
        columns = (
            np.array([one.produced for one in scanned]),
            np.array([math.log(max(abs(one.solution.friction_coefficient), 1e-300)) for one in scanned]),
        )
        if len(rise) == 1:
            return cls(rise, *columns)
        fine = np.linspace(0.0, 1.0, 2001) ** 2 * rise[-1]
        return cls(fine, *(np.asarray(PchipInterpolator(rise, column)(fine)) for column in columns))

    def states(self) -> list[State]:
        """Return the stable states, ascending."""
        if not np.any(self.produced > 0.0):
            return [State(0.0, 0.0)]
        return stable_states(self.rise, self.produced)

    def tolerance(self, rise: float, accuracy: float) -> float:
        """Return the residual, K, that neither friction nor the rise itself feels."""
        row = int(np.clip(np.searchsorted(self.rise, rise), 1, len(self.rise) - 1)) if len(self.rise) > 1 else 0
        per_kelvin = 0.0
        if row:
            change = self.log_friction[row] - self.log_friction[row - 1]
            per_kelvin = abs(change / (self.rise[row] - self.rise[row - 1]))
        return min(_LEFT * rise + 1e-9, 0.5 * accuracy / max(per_kelvin, 1e-300))


def settle(contact: ThermalContact, curve: HeatCurve, state: State, accuracy: float) -> Warmed:
    """Return the contact solved at a state of its curve."""
    last: list[Warmed] = []

    def produced(rise: float) -> float:
        last[:] = [contact.at(rise, accuracy)]
        return last[0].produced

    settled(state, produced, lambda rise: curve.tolerance(rise, accuracy))
    return last[0]


def finished(
    found: list[Warmed], isothermal: float, heating: Heating, interface: InterfaceLaw | None = None
) -> ContactSolution:
    """Return the first of one or two states of a contact, with its heat, notes, and the numbers of the other."""
    rise, solution, resistances, produced = found[0]
    coulomb, loss = heats(solution, heating, interface)
    balance, alone = (HeatBalance.of(resistances, coulomb, one) for one in (loss, 0.0))
    by_coulomb = heating.rise(alone)
    half = 0.5 * (solution.front + solution.rear)
    result = ContactHeating(
        temperature_rise=rise,
        coulomb_rise=by_coulomb,
        loss_rise=produced - by_coulomb,
        track_rise=balance.track_rise,
        face_rise=balance.face_rise,
        loss_weighted_rise=balance.loss_weighted_rise,
        residual=produced - rise,
        coulomb_heat=coulomb,
        loss_heat=loss,
        rubber_heat=balance.rubber_heat,
        counterface_heat=balance.counterface_heat,
        skin=math.sqrt(2.0 * heating.rubber.diffusivity / (abs(solution.speed) * half)),
        isothermal_friction=isothermal,
        other_rise=found[1].rise if len(found) > 1 else None,
        other_friction=found[1].solution.friction_coefficient if len(found) > 1 else None,
    )
    notes = [] if len(found) == 1 else [_two_states(result)]
    if heating.average == "contact" and result.skin < THIN and rise > 0.0:
        notes.append(_thin_skin(result))
    kelvin = solution.temperature
    assert kelvin is not None
    warnings = (*solution.warnings, *notes)
    return replace(solution, temperature=kelvin - rise, heating=result, warnings=warnings)


def _two_states(result: ContactHeating) -> Note:
    assert result.other_rise is not None
    assert result.other_friction is not None
    cold, hot = sorted((result.temperature_rise, result.other_rise))
    return Note(
        "two-thermal-states",
        f"The contact has two stable states, {cold:.3g} K and {hot:.3g} K warmer than the body; which one it is in "
        "depends on the speeds before.",
        values={"cold": cold, "hot": hot, "other_friction": result.other_friction},
    )


def _thin_skin(result: ContactHeating) -> Note:
    return Note(
        "thin-skin",
        f"While the contact passes, heat spreads {result.skin:.2g} contact radii deep: its face is "
        f"{result.face_rise:.2g} K warmer, but the rubber where the loss is released "
        f"{result.loss_weighted_rise:.2g} K",
        remedy="; for friction at the latter, give " + AT_THE_LOSS + ".",
        values={
            "skin": result.skin,
            "face_rise": result.face_rise,
            "loss_weighted_rise": result.loss_weighted_rise,
        },
    )
