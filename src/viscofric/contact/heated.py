"""The states of a contact in which its friction and its temperature agree."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.contact.coupling import ShearedContact, coupling_notes, sheared_compliance
from viscofric.contact.fields.dissipation import Modes
from viscofric.contact.heated_result import INTERFACE, SHIFT, Heat, Warmed, beyond, described, ends
from viscofric.errors import InputError
from viscofric.heat.branches import LEFT, HeatCurve, State, outermost, settled
from viscofric.heat.heating import Heating, ThermalResistances
from viscofric.heat.interface import END, SlidingInterface, last_known
from viscofric.heat.result import ContactHeating
from viscofric.notes import Note
from viscofric.threads import one_blas_thread

if TYPE_CHECKING:
    from viscofric.rheology.interface.law import InterfaceLaw
    from viscofric.rheology.material import Material

#: Of the contacts among which states are looked for.
LOOSE = 2e-2
#: Between two of them α falls by this much, log10, or the temperature rises by this many K.
_DECADES, _KELVIN = 0.4, 10.0
#: States are looked for up to this rise, K, and up to this multiple of the largest rise that a contact produced.
_LEAST, _BEYOND = 30.0, 2.0


def insist_on_heatable(
    heating: object, material: Material, speed: float, temperature: object, layer: object, coulomb: float
) -> Heating:
    """Return the heating of a contact; InputError unless its friction can heat it: see `ThermalContact`."""
    insist_on(heating, "heating", Heating)
    assert isinstance(heating, Heating)
    if not material.has_shift_factors or temperature is None:
        raise InputError("heating: needs a material with shift factors, and a temperature.", code="no-shift")
    if speed == 0.0 or math.isinf(speed):
        raise InputError(f"heating: an elastic limit, speed = {speed:g}, has no heat.", code="elastic-limit")
    if layer is not None or coulomb != 0.0:
        raise InputError(
            "heating: not with coulomb, nor with a layer: heat and loss are those of a half-space.",
            code="not-with-heating",
        )
    return heating


@dataclass(frozen=True)
class ThermalContact:
    """One contact at any rise of temperature; of its kinds there are free and periodic ones."""

    #: Of curves, decades of speed between contacts whose resistances are found from their fields.
    knots_apart: ClassVar[float] = 0.25
    #: Whether heats are per nominal area, of which the contact is a part.
    of_nominal_area: ClassVar[bool] = False

    material: Material  # with α(T)
    heating: Heating
    kelvin: float  # without heating
    speed: float
    isothermal: Callable[[float, float, float], Any]  # solution at a speed, a temperature, K, and to an accuracy
    interface: InterfaceLaw | None = None  # whose heat takes the place of a constant Coulomb friction
    line: bool = False

    def heat(self, solution: Any, kelvin: float, relative: ThermalResistances | None = None) -> Heat:
        """Return the heats of a contact solved at a temperature; its resistances `relative` to `closed`, if known."""
        raise NotImplementedError

    def closed(self, area: float, size: float) -> tuple[float, float]:
        """Return the rise of the rubber's face and of the counterface's per heat, in closed form; as in `Heat`.

        Resistances over them change smoothly with speed.
        """
        raise NotImplementedError

    def area(self, solution: Any) -> float:
        """Return the area of a solved contact."""
        raise NotImplementedError

    def relative(self, heat: Heat) -> ThermalResistances:
        """Return the resistances of a contact over those in closed form, with which `heat` finds those of another."""
        (rubber, other), one = self.closed(heat.area, heat.size), heat.resistances
        # Infinite below a strip that does not slide over the counterface.
        over = one.counterface / other if math.isfinite(other) else 1.0
        parts: Any = (*(part / rubber for part in one[:4]), 0.0, over, one.beyond)
        return ThermalResistances(*parts)

    def scaled(self, heat: Heat, larger: Array) -> ThermalResistances:
        """Return resistances of contacts (n,) whose area is larger by factors, from those of one solved."""
        raise NotImplementedError

    def kept(self, solution: Any) -> Any:
        """Return what is kept of a solution."""
        return solution

    def log10_shift(self, kelvin: float) -> float:
        """Return log10 α at a temperature; raise InputError where it is not known."""
        assert self.material.shift is not None
        return float(self.material.shift.log10(kelvin))

    def modes(self, kelvin: float) -> Modes:
        """Return the material's modes at a temperature."""
        from viscofric.contact.fields.dissipation import Modes

        spectrum = self.material.modes_at(kelvin)
        return Modes(np.asarray(spectrum.C), np.asarray(spectrum.tau))

    @cached_property
    def face(self) -> SlidingInterface | None:
        """The interface where it slides."""
        slip = self.heating.sliding(self.speed)
        return None if self.interface is None or slip == 0.0 else SlidingInterface(self.interface, slip, self.kelvin)

    def with_interface(self, heat: Heat, rise: Any, *, hot: bool) -> Heat:
        """Return the heat of contacts at rises of temperature, (n,) or one, with that of the interface.

        The interface is as warm as the face: with the mean over the face, the rise itself, else the one that follows.
        """
        if self.interface is None:
            return heat
        if self.face is None:
            return heat._replace(coulomb=0.0 * heat.coulomb)
        if self.heating.average == "contact":
            found = self.face.heat(heat.area, np.asarray(rise))
        else:
            found = self.face.settled_heat(heat.area, heat.resistances, np.atleast_1d(heat.loss), hot=hot)
        coulomb: Any = found if np.ndim(rise) else float(found.item())
        return heat._replace(coulomb=coulomb)

    @one_blas_thread
    def at(
        self, rise: float, accuracy: float, relative: ThermalResistances | None = None, *, hot: bool = False
    ) -> Warmed:
        """Solve the contact at a rise of temperature; `relative` as in `heat`, `hot` as in `State`."""
        return self.warmed(self.isothermal(self.speed, self.kelvin + rise, accuracy), rise, relative, hot=hot)

    def warmed(
        self, solution: Any, rise: float, relative: ThermalResistances | None = None, *, hot: bool = False
    ) -> Warmed:
        """Return the contact solved at a rise of temperature with its heat; other arguments as of `at`."""
        heat = self.with_interface(self.heat(solution, self.kelvin + rise, relative), rise, hot=hot)
        friction = solution.friction_coefficient
        return Warmed(rise, friction, self.kept(solution), heat, self.heating.rise(heat.balance))

    def sheared(self, one: Warmed) -> ShearedContact:
        """Return a solved contact with the shear of its Coulomb friction, which it was solved without."""
        slip, heat, ratio = self.heating.sliding(self.speed), one.heat, self.material.poisson_ratio
        modes = self.material.modes_at(self.kelvin + one.rise)
        return ShearedContact(
            stress=heat.coulomb / (slip * heat.area) if slip > 0.0 else 0.0,
            friction=one.friction,
            compliance=sheared_compliance(modes, ratio, None, heat.size, self.speed, line=self.line),
            line=self.line,
            filled=heat.area if self.of_nominal_area else 0.0,
        )

    def hottest(self, one: Warmed) -> Warmed:
        """Return the same solved contact with its interface in the hottest state."""
        heat = self.with_interface(one.heat, one.rise, hot=True)
        return one._replace(heat=heat, produced=self.heating.rise(heat.balance))

    def ended_by(self, rise: float) -> str:
        """Return the name of the law that is not known at a rise of temperature; empty if all are."""
        try:
            self.log10_shift(self.kelvin + rise)
        except InputError:
            return SHIFT
        return INTERFACE if self.face is not None and not self.face.is_known(rise) else ""

    def reach(self, rise: float, wanted: float) -> tuple[float, str]:
        """Return the largest rise up to a wanted one at which all laws are known, and which one ends there.

        They are known at `rise`.
        """
        ended = self.ended_by(wanted)
        if not ended:
            return wanted, ""
        last = last_known(lambda one: not self.ended_by(one), rise, wanted)
        return last, self.ended_by(last + 2.0 * END) or ended

    def next_rise(self, rise: float) -> tuple[float, str]:
        """Return a rise at which α is noticeably smaller, or the largest one at which all laws are known.

        And the law that ends there, if one does.
        """
        near, ended = self.reach(rise, rise + 1.0)
        if ended:
            return near, ended
        slope = self.log10_shift(self.kelvin + rise) - self.log10_shift(self.kelvin + near)
        return self.reach(near, rise + min(_KELVIN, _DECADES / max(slope, 1e-6)))


class States(NamedTuple):
    """A contact without heating, its coldest and its hottest state, and that of the branch wanted."""

    contact: ThermalContact
    isothermal: Warmed
    cold: Warmed
    hot: Warmed
    wanted: Warmed
    heating: ContactHeating  # of the state wanted
    notes: tuple[Note, ...]

    @classmethod
    def of(cls, contact: ThermalContact, isothermal: Warmed, settled: list[Warmed], said: tuple[Note, ...]) -> States:
        """Return the one or two states of a contact, with further notes; errors as of `_within_law`."""
        found, left_out = _within_law(contact, settled)
        order = found if contact.heating.branch == "cold" else found[::-1]
        heating, notes = described(contact.heating, contact.speed, order, isothermal.friction)
        every = tuple(dict.fromkeys((*notes, *left_out, *said)))
        return cls(contact, isothermal, found[0], found[-1], order[0], heating, every)


def enough(rise: float, produced: list[float]) -> bool:
    """Whether no state is to be expected beyond a rise, K, from what contacts up to it produce."""
    return rise >= max(_LEAST, _BEYOND * max(produced))


def solve_heated(contact: ThermalContact, accuracy: float) -> Any:
    """Return the contact in the state of the branch wanted.

    Raises InputError if α is not known up to the temperature of the contact, ConvergenceError if the solves do not
    settle.
    """
    isothermal = contact.at(0.0, accuracy)
    scanned = [isothermal]
    ended = ""
    while not ended and not enough(scanned[-1].rise, [one.produced for one in scanned]):
        rise, ended = contact.next_rise(scanned[-1].rise)
        if rise > scanned[-1].rise:
            scanned.append(contact.at(rise, max(LOOSE, accuracy)))
    curve = _curve_of(scanned)
    states = outermost(curve, _curve_of([contact.hottest(one) for one in scanned]))
    if not states:
        raise beyond(ended, contact.kelvin + scanned[-1].rise)
    settled = [_settled(contact, curve, one, accuracy) for one in states]
    found = States.of(contact, isothermal, settled, sought(curve, ended, contact.kelvin))
    solution = found.wanted.solution
    error = solution.diagnostics.friction_error + found.wanted.friction_left
    return replace(
        solution,
        temperature=contact.kelvin,
        heating=found.heating,
        warnings=(*solution.warnings, *found.notes, *coupling_notes([contact.sheared(found.wanted)])),
        diagnostics=replace(solution.diagnostics, friction_error=error),
    )


def sought(curve: HeatCurve, ended: str, kelvin: float) -> tuple[Note, ...]:
    """Return a note if a law ends before a hotter state of a contact can be excluded; its temperature without heat."""
    last = float(curve.rise[-1])
    if not ended or last >= _BEYOND * float(curve.produced.max()):
        return ()
    return (ends(ended, kelvin + last),)


def _curve_of(scanned: list[Warmed]) -> HeatCurve:
    columns = (np.array([getattr(one, name) for one in scanned]) for name in ("rise", "produced", "friction"))
    return HeatCurve.of(*columns)


def _settled(contact: ThermalContact, curve: HeatCurve, state: State, accuracy: float) -> Warmed:
    """Return the contact solved at a state of its curve."""
    last: list[Warmed] = []

    def produced(rise: float) -> float:
        last[:] = [contact.at(rise, accuracy, hot=state.hot)]
        return last[0].produced

    rise, _ = settled(state, produced, lambda rise: curve.tolerance(rise, accuracy), curve.limits)
    return last[0]._replace(felt=curve.felt(rise))


def _within_law(contact: ThermalContact, found: list[Warmed]) -> tuple[list[Warmed], tuple[Note, ...]]:
    """Return those of one or two states whose face is no warmer than the law of the interface is known to.

    And a note where the other state is left out; raise InputError if it is the one wanted.
    """
    face, end, known = contact.face, math.inf, found
    if face is not None:
        known = [one for one in found if one.heat.balance.face_rise * (1.0 - LEFT) <= face.known]
        end = contact.kelvin + face.known
    if not known or (len(known) < len(found) and contact.heating.branch == "hot"):
        raise beyond(INTERFACE, end)
    return known, () if len(known) == len(found) else (ends(INTERFACE, end),)
