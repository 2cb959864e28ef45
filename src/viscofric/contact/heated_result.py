"""Numbers of contacts that their own friction heats, and notes and errors on them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from viscofric.errors import InputError
from viscofric.heat.heating import HeatBalance, Heating, ThermalResistances
from viscofric.heat.result import ContactHeating
from viscofric.notes import Note, Remedy
from viscofric.units import shown_celsius

#: What gives friction at the temperature where the loss is released.
AT_THE_LOSS = Remedy(
    "Heating(average='loss')", "--heating-average loss", "average = 'loss' under [heating]", field="heating.average"
)
#: Laws that end at some temperature, as codes and sentences call them.
SHIFT, INTERFACE = "shift", "interface"
_NAMES = {SHIFT: "α(T) of the rubber", INTERFACE: "the law of the interface"}
#: Below it, over the contact radius, the heat of a passing contact is in a skin.
THIN = 0.5
#: Rises per heat are accurate to this; a part of the loss that is left out is noted where it may change the rise by
#: more, and friction by more than this.
_ACCURATE, _FELT = 0.2, 1e-2
#: Errors of the rise by Coulomb heat and by the loss, of the face and where the loss is released, as parts of them; and
#: beyond a Péclet number of 1/skin² of 10 (see the theory page on heat).
_ERRORS = {"contact": (0.03, 0.2), "loss": (0.2, 0.1)}
_FAST_ERRORS, _FAST = {"contact": (0.03, 0.4), "loss": (0.36, 0.1)}, 10.0**-0.5


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
    """A contact solved at a rise of temperature, K, what is kept of its solution, and the rise that it produces, K.

    `felt` is the relative change of its friction per kelvin of the rise that it produces.
    """

    rise: float
    friction: float
    solution: Any
    heat: Heat
    produced: float
    felt: float = 0.0

    @property
    def friction_left(self) -> float:
        """Error of the friction coefficient due to the difference of both rises."""
        return self.felt * abs(self.produced - self.rise) * abs(self.friction)


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


def ends(law: str, kelvin: float) -> Note:
    """Return the note of a law that ends at a temperature before a hotter state can be excluded."""
    said = f"Thermal states were looked for up to {shown_celsius(kelvin)} °C only, where {_NAMES[law]} ends."
    return Note("states-beyond", said, values={"temperature": kelvin})


def described(
    heating: Heating, speed: float, found: list[Warmed], isothermal: float
) -> tuple[ContactHeating, tuple[Note, ...]]:
    """Return the heat of the first of one or two states of a contact, with the numbers of the other, and notes."""
    rise, _, _, heat, produced, _ = found[0]
    balance, alone = heat.balance, HeatBalance.of(heat.resistances, heat.coulomb, 0.0)
    by_coulomb = heating.rise(alone)
    skin = math.sqrt(2.0 * heating.rubber.diffusivity / (abs(speed) * heat.size))
    parts = (_ERRORS if skin > _FAST else _FAST_ERRORS)[heating.average]
    error = parts[0] * abs(by_coulomb) + parts[1] * abs(produced - by_coulomb) + abs(produced - rise)
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
        skin=skin,
        isothermal_friction=isothermal,
        temperature_rise_error=error,
        other_rise=found[1].rise if len(found) > 1 else None,
        other_friction=found[1].friction if len(found) > 1 else None,
    )
    notes = [] if len(found) == 1 else [_two_states(result, found[1].heat.balance.face_rise)]
    if heating.average == "contact" and result.skin < THIN and rise > 0.0:
        notes.append(thin_skin(result.skin, result.face_rise, result.loss_weighted_rise))
    notes += _loss_beyond(result, found[0].friction, heating.average)
    if (part := found[0].felt * error) > _FELT:
        said = (
            f"The rise of temperature is {rise:.3g} ± {error:.2g} K, whose error changes friction by up to "
            f"{100.0 * part:.2g} %; the error stated for friction does not include it."
        )
        notes.append(Note("rise-uncertain", said, values={"severity": part, "rise_error": error}))
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


def thin_skin(skin: float, face: float, below: float, most: str = "") -> Note:
    """Return the note that only a skin, over the contact radius, is as warm as the face; `most`: "up to "."""
    said = (
        f"While the contact passes, heat spreads {skin:.2g} contact radii deep: its face is {most}{face:.2g} K warmer, "
        f"but the rubber where the loss is released {below:.2g} K"
    )
    values = {"skin": skin, "face_rise": face, "loss_weighted_rise": below}
    return Note("thin-skin", said, remedy="; for friction at the latter, give " + AT_THE_LOSS + ".", values=values)


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
