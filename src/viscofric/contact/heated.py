"""The states of a contact in which its friction and its temperature agree."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from viscofric.contact.bodies import half_space_coupling
from viscofric.contact.coupling import ShearedContact, coupling_notes
from viscofric.errors import InputError
from viscofric.heat.branches import LEFT, HeatCurve, outermost, settled
from viscofric.heat.heating import HeatBalance, Heating, ThermalResistances
from viscofric.heat.interface import END, SlidingInterface, last_known
from viscofric.heat.result import ContactHeating
from viscofric.notes import Note, Remedy
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.contact.fields.dissipation import Modes
    from viscofric.heat.branches import State
    from viscofric.rheology.interface.law import InterfaceLaw
    from viscofric.rheology.material import Material


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
#: Laws that end at some temperature, as codes and sentences call them.
SHIFT, INTERFACE = "shift", "interface"
_NAMES = {SHIFT: "α(T) of the rubber", INTERFACE: "the law of the interface"}
#: Below it, over the contact radius, the heat of a passing contact is in a skin.
THIN = 0.5
#: Rises per heat are accurate to this; a part of the loss that is left out is noted where it may change the rise by
#: more, and friction by more than this.
_ACCURATE, _FELT = 0.2, 1e-2


class Heat(NamedTuple):
    """Heats of a solved contact and rises per heat; what they are per, its area, and half its length along the motion.

    Heats are in W, of a line contact in W/m, of a rough surface in W/m² of its nominal area, of which `area` is a part.
    """

    resistances: ThermalResistances
    coulomb: float
    loss: float
    area: float
    size: float

    @property
    def balance(self) -> HeatBalance:
        """The state in which both faces are equally warm."""
        return HeatBalance.of(self.resistances, self.coulomb, self.loss)


class Warmed(NamedTuple):
    """A contact solved at a rise of temperature, K, what is kept of its solution, and the rise that it produces, K."""

    rise: float
    friction: float
    solution: Any
    heat: Heat
    produced: float


@dataclass(frozen=True)
class ThermalContact:
    """One contact at any rise of temperature; of its kinds there are free and periodic ones."""

    #: Of curves, decades of speed between contacts whose resistances are found from their fields.
    knots_apart: ClassVar[float] = 0.2
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

    def at(
        self, rise: float, accuracy: float, relative: ThermalResistances | None = None, *, hot: bool = False
    ) -> Warmed:
        """Solve the contact at a rise of temperature; `relative` as in `heat`, `hot` as in `State`."""
        kelvin = self.kelvin + rise
        solution = self.isothermal(self.speed, kelvin, accuracy)
        heat = self.with_interface(self.heat(solution, kelvin, relative), rise, hot=hot)
        friction = solution.friction_coefficient
        return Warmed(rise, friction, self.kept(solution), heat, self.heating.rise(heat.balance))

    def sheared(self, one: Warmed) -> ShearedContact:
        """Return a solved contact with the shear of its Coulomb friction, which it was solved without."""
        slip, heat, ratio = self.heating.sliding(self.speed), one.heat, self.material.poisson_ratio
        modulus = self.material.modes_at(self.kelvin + one.rise).complex_modulus(abs(self.speed) / heat.size)
        return ShearedContact(
            stress=heat.coulomb / (slip * heat.area) if slip > 0.0 else 0.0,
            friction=one.friction,
            compliance=(1.0 - ratio**2) / abs(complex(modulus)),
            coupling=half_space_coupling(ratio),
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
    found, left_out = within_law(contact, [settle(contact, curve, one, accuracy) for one in states])
    order = found if contact.heating.branch == "cold" else found[::-1]
    heating, notes = described(contact, order, isothermal.friction)
    shear = coupling_notes([contact.sheared(order[0])])
    said = dict.fromkeys((*notes, *shear, *left_out, *sought(curve, ended, contact.kelvin)))
    return finished(contact, order[0].solution, heating, tuple(said))


def finished(contact: ThermalContact, solution: Any, heating: ContactHeating, notes: tuple[Note, ...]) -> Any:
    """Return a solution at the temperature of the body, with its heat and more notes."""
    return replace(solution, temperature=contact.kelvin, heating=heating, warnings=(*solution.warnings, *notes))


def beyond(law: str, kelvin: float) -> InputError:
    """Return the error of a contact that is hotter than a law is known, or than states are looked for."""
    said = f"The contact heats beyond {shown_celsius(kelvin)} °C"
    values = {"temperature": kelvin}
    if not law:
        return InputError(f"{said}, up to which a state is looked for; reduce the heat.", code="too-hot", values=values)
    return InputError(
        f"{said}, up to which {_NAMES[law]} is known; reduce the heat, or give one that is valid at higher "
        "temperatures.",
        code=f"beyond-{law}",
        values=values,
    )


def sought(curve: HeatCurve, ended: str, kelvin: float) -> tuple[Note, ...]:
    """Return a note if a law ends before a hotter state of a contact can be excluded; its temperature without heat."""
    last = float(curve.rise[-1])
    if not ended or last >= _BEYOND * float(curve.produced.max()):
        return ()
    return (_ends(ended, kelvin + last),)


def _ends(law: str, kelvin: float) -> Note:
    said = f"Thermal states were looked for up to {shown_celsius(kelvin)} °C only, where {_NAMES[law]} ends."
    return Note("states-beyond", said, values={"temperature": kelvin})


def _curve_of(scanned: list[Warmed]) -> HeatCurve:
    columns = (np.array([getattr(one, name) for one in scanned]) for name in ("rise", "produced", "friction"))
    return HeatCurve.of(*columns)


def settle(
    contact: ThermalContact,
    curve: HeatCurve,
    state: State,
    accuracy: float,
    relative: ThermalResistances | None = None,
) -> Warmed:
    """Return the contact solved at a state of its curve; `relative` as in `ThermalContact.heat`."""
    last: list[Warmed] = []

    def produced(rise: float) -> float:
        last[:] = [contact.at(rise, accuracy, relative, hot=state.hot)]
        return last[0].produced

    settled(state, produced, lambda rise: curve.tolerance(rise, accuracy), curve.limits)
    return last[0]


def within_law(contact: ThermalContact, found: list[Warmed]) -> tuple[list[Warmed], tuple[Note, ...]]:
    """Return those of one or two states whose face is no warmer than the law of the interface is known to.

    And a note where the other state is left out; raise InputError if it is the one wanted.
    """
    face, end, known = contact.face, math.inf, found
    if face is not None:
        known = [one for one in found if one.heat.balance.face_rise * (1.0 - LEFT) <= face.known]
        end = contact.kelvin + face.known
    if not known or (len(known) < len(found) and contact.heating.branch == "hot"):
        raise beyond(INTERFACE, end)
    return known, () if len(known) == len(found) else (_ends(INTERFACE, end),)


def described(
    contact: ThermalContact, found: list[Warmed], isothermal: float
) -> tuple[ContactHeating, tuple[Note, ...]]:
    """Return the heat of the first of one or two states of a contact, with the numbers of the other, and notes."""
    heating, (rise, _, _, heat, produced) = contact.heating, found[0]
    balance, alone = heat.balance, HeatBalance.of(heat.resistances, heat.coulomb, 0.0)
    by_coulomb = heating.rise(alone)
    result = ContactHeating(
        temperature_rise=rise,
        coulomb_rise=by_coulomb,
        loss_rise=produced - by_coulomb,
        track_rise=balance.track_rise,
        face_rise=balance.face_rise,
        loss_weighted_rise=balance.loss_weighted_rise,
        residual=produced - rise,
        coulomb_heat=heat.coulomb,
        loss_heat=heat.loss,
        loss_beyond=heat.resistances.beyond * heat.loss,
        rubber_heat=balance.rubber_heat,
        counterface_heat=balance.counterface_heat,
        skin=math.sqrt(2.0 * heating.rubber.diffusivity / (abs(contact.speed) * heat.size)),
        isothermal_friction=isothermal,
        other_rise=found[1].rise if len(found) > 1 else None,
        other_friction=found[1].friction if len(found) > 1 else None,
    )
    notes = [] if len(found) == 1 else [_two_states(result, found[1].heat.balance.face_rise)]
    if heating.average == "contact" and result.skin < THIN and rise > 0.0:
        notes.append(_thin_skin(result))
    notes += _loss_beyond(result, found[0].friction, heating.average)
    return result, tuple(notes)


def _two_states(result: ContactHeating, other_face: float) -> Note:
    assert result.other_rise is not None
    assert result.other_friction is not None
    cold, hot = sorted((result.temperature_rise, result.other_rise))
    cold_face, hot_face = sorted((result.face_rise, other_face))
    return Note(
        "two-thermal-states",
        f"The contact has two stable states: the rubber {cold:.3g} K or {hot:.3g} K warmer than the body, its face "
        f"{cold_face:.3g} K or {hot_face:.3g} K; which one it is in depends on the speeds before.",
        values={"cold": cold, "hot": hot, "cold_face": cold_face, "hot_face": hot_face}
        | {"other_friction": result.other_friction},
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


def _loss_beyond(result: ContactHeating, friction: float, average: str) -> tuple[Note, ...]:
    """Return a note where the loss that is released too far away to warm the contact may matter."""
    rise, share = result.temperature_rise, result.loss_beyond / max(result.loss_heat, 1e-300)
    if share == 0.0 or rise <= 0.0:
        return ()
    if average == "loss":  # the rubber beyond counts as cold
        bound, where = rise * (1.0 - share), "is that of the rest, where it is released; over all of it, it is down to"
    else:
        bound, where = rise + result.loss_rise * share / (1.0 - share), "is without it; with it, it is up to"
    part = abs(bound - rise) / rise
    if part <= _ACCURATE or part * abs(friction / result.isothermal_friction - 1.0) <= _FELT:
        return ()
    said = (
        f"{100 * share:.0f} % of the viscoelastic loss is released too far away to warm the contact: the mean rise of "
        f"temperature, {rise:.3g} K, {where} {bound:.3g} K."
    )
    return (Note("loss-beyond", said, values={"share": share, "rise": rise, "bound": bound}),)
