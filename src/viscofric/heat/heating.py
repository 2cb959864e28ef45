"""How friction heats a contact: thermal properties of both bodies, Coulomb heat, and earlier passes on a track."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from viscofric.arguments import insist_on
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.heat.means import disc_mean, face_resistance
from viscofric.heat.track import track_temperature
from viscofric.showing import Rows, Shown
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantity, number, positive, to_si


@dataclass(frozen=True, kw_only=True)
class Heating(Shown):
    """How friction heats a contact.

    Parameters
    ----------
    rubber, counterface : ThermalProperties
        Of the viscoelastic body, and of the indenter or rough surface; both are half-spaces for the heat.
    coulomb : float
        Coulomb friction coefficient, whose heat both bodies share.
    slip : float, str or pint.Quantity, optional
        Sliding velocity between the two surfaces, m/s: the speed of the contact over the rubber less that over the
        counterface, so that it is below zero where the counterface is the faster one.  The speed of the contact if not
        given: an indenter that slides without rotation.
    track_radius : float, str or pint.Quantity, optional
        Of the circle on which the contact meets the rubber again and again, m; needed with `passes`.
    passes : int
        Earlier passes on that circle, whose heat is still in the rubber; `math.inf` for the final state.
    average : {"contact", "loss"}
        Which mean rise of temperature the rubber responds to: that of the rubber weighted with the loss that is
        released there, which is the one that changes friction to first order, or that of the face of the contact.  They
        differ where the heat of a passing contact reaches a thin skin only, at Péclet numbers va/(2κ) well above one.
        The shear stress of an interface responds to the temperature of the face.
    branch : {"cold", "hot"}
        Where a contact has a cold and a hot state: the one that a rising speed reaches from slow sliding, or the one
        that a falling speed reaches from fast sliding.
    nominal_radius : float, str or pint.Quantity, optional
        Of rough contacts: radius of the nominal contact, a disc that moves over the rubber with the contact, m.  Its
        mean heat warms both bodies; without it, the rise is that above the mean of the surface.

    Raises
    ------
    InputError
        If a value cannot be used.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.ThermalProperties("0.3 W/m/K", "1200 kg/m**3", "1500 J/kg/K", "rubber")
    >>> steel = vf.ThermalProperties("46 W/m/K", "7810 kg/m**3", "475 J/kg/K", "steel")
    >>> heating = vf.Heating(rubber=rubber, counterface=steel, coulomb=0.45, slip="0.1 m/s")
    """

    rubber: ThermalProperties
    counterface: ThermalProperties
    coulomb: float = 0.0
    slip: Quantity | None = None
    track_radius: Quantity | None = None
    passes: float = 0
    average: Literal["contact", "loss"] = "loss"
    branch: Literal["cold", "hot"] = "cold"
    nominal_radius: Quantity | None = None

    def __post_init__(self) -> None:
        for name in ("rubber", "counterface"):
            insist_on(getattr(self, name), name, ThermalProperties)
        check_choice(self.average, "average", "contact", "loss")
        check_choice(self.branch, "branch", "cold", "hot")
        coulomb = number(self.coulomb, "coulomb")
        given: Any = self.passes
        endless = isinstance(given, float) and given == math.inf
        passes = math.inf if endless else number(given, "passes")
        if coulomb < 0.0:
            raise wrong_argument("coulomb", coulomb, "must not be below zero.", "out-of-range")
        if not (passes >= 0.0 and (endless or passes == math.floor(passes))):
            raise wrong_argument("passes", passes, "must be a whole number or inf, not below zero.", "out-of-range")
        if self.slip is not None:
            object.__setattr__(self, "slip", to_si(self.slip, "m/s", "slip"))
        if self.nominal_radius is not None:
            object.__setattr__(self, "nominal_radius", positive(self.nominal_radius, "m", "nominal_radius"))
        if self.track_radius is not None:
            object.__setattr__(self, "track_radius", positive(self.track_radius, "m", "track_radius"))
        elif passes > 0.0:
            raise InputError("passes: need the track_radius.", code="give-one")

    def _shown(self) -> Rows:
        return (
            ("rubber", self.rubber.name),
            ("counterface", self.counterface.name),
            ("Coulomb friction", self.coulomb),
            ("slip", self.slip, "m/s"),
            ("radius of the track", self.track_radius, "m"),
            ("earlier passes", self.passes),
            ("average", self.average),
            ("branch", self.branch),
            ("nominal radius", self.nominal_radius, "m"),
        )

    def sliding(self, speed: float) -> float:
        """Return the sliding velocity, m/s, of a contact that moves at a speed, m/s."""
        return abs(speed) if self.slip is None else abs(float(self.slip))

    def over_counterface(self, speed: float) -> float:
        """Return the velocity over the counterface, m/s, of a contact that moves at one over the rubber, m/s."""
        return 0.0 if self.slip is None else speed - math.copysign(1.0, speed) * float(self.slip)

    def coulomb_heat(self, load: float, speed: float) -> float:
        """Return the heat of constant Coulomb friction, W (W/m, W/m²), of a load, N (N/m, Pa), at a speed, m/s."""
        return self.coulomb * load * self.sliding(speed)

    def rise(self, balance: HeatBalance) -> float:
        """Return the rise that the rubber responds to, K."""
        return balance.face_rise if self.average == "contact" else balance.loss_weighted_rise

    def track_resistance(self, radius: float, speed: float) -> float:
        """Return the rise by earlier passes per heat that the rubber takes up, K/W; the contact's radius in m."""
        if self.passes == 0 or self.track_radius is None:
            return 0.0
        rise = track_temperature(
            1.0, self.rubber, radius=radius, track_radius=self.track_radius, speed=speed, passes=[self.passes]
        )
        return float(rise[0])

    def face_resistances(self, speed: float, size: float, line: bool) -> tuple[float, float]:
        """Return the mean rises of the rubber's and the counterface's face per heat, in closed form.

        Of a disc of a radius `size`, m, or a strip of that half-width, at a speed over the rubber, m/s.
        """
        other = abs(self.over_counterface(speed))
        return face_resistance(self.rubber, speed, size, line), face_resistance(self.counterface, other, size, line)

    def nominal(self, speed: float) -> NominalResistances:
        """Return the rises of the nominal contact of a rough surface that moves at a speed, m/s."""
        if self.nominal_radius is None:
            return NominalResistances(0.0, 0.0, 0.0)
        radius, speed = float(self.nominal_radius), abs(speed)
        area = math.pi * radius**2
        rubber, other = (
            disc_mean(velocity * radius / (2.0 * body.diffusivity), hertz=False) * radius / float(body.conductivity)
            for body, velocity in ((self.rubber, speed), (self.counterface, abs(self.over_counterface(speed))))
        )
        return NominalResistances(rubber, other, area * self.track_resistance(radius, speed))


class NominalResistances(NamedTuple):
    """Mean rise of a nominal contact per heat of its area, K m²/W.

    Of the rubber and of the counterface by the present heat, and of the rubber by heat in earlier passes.
    """

    rubber: float
    counterface: float
    track: float


class ThermalResistances(NamedTuple):
    """Rise of a contact per heat, K/W, K m/W of a line contact, or K m²/W of a rough surface.

    Of the rubber's face, on average, by heat on it and by the loss below; of the rubber where the loss is released, on
    average with it, by both; of all of the rubber by its heat in earlier passes; of the counterface's face, infinite
    where it takes no heat.  `beyond` is the share of the loss that is released too far away to warm the contact.
    """

    surface: float
    loss: float
    surface_below: float
    loss_below: float
    track: float
    counterface: float
    beyond: float = 0.0


class HeatBalance(NamedTuple):
    """Heat and rises of temperature of a contact whose faces are equally warm; K, and W, or W/m of a line contact."""

    face_rise: float
    loss_weighted_rise: float  # of the rubber where the loss is released
    track_rise: float  # the part of either that earlier passes left
    coulomb_heat: float
    loss_heat: float
    counterface_heat: float

    @property
    def rubber_heat(self) -> float:
        """Heat that stays in the rubber, W or W/m."""
        return self.coulomb_heat + self.loss_heat - self.counterface_heat

    @classmethod
    def of(cls, resistance: ThermalResistances, coulomb: float, loss: float) -> HeatBalance:
        """Return the state in which both faces are equally warm on average."""
        # The rubber's face rises by Rs (Qc − Q) + Rl Qv + Rt (Qc − Q + Qv), the counterface's by R Q: linear in Q.
        one, other = resistance, resistance.counterface
        share = 1.0 / (1.0 + (one.surface + one.track) / other)
        face = share * ((one.surface + one.track) * coulomb + (one.loss + one.track) * loss)
        taken = face / other
        track = one.track * (coulomb + loss - taken)
        below = one.surface_below * (coulomb - taken) + one.loss_below * loss + track
        return cls(face, below, track, coulomb, loss, taken)
