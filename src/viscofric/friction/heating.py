"""Friction curves of contacts that their own friction heats.

The isothermal curve is solved first.  A contact that is ΔT warmer lies on the same curve at the speed α(T) v:
interpolation gives the rise that it produces at every ΔT, and with it all states of all speeds.  Each is then solved,
mostly once, since its temperature is nearly known.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from viscofric.contact.heated import LOOSE, HeatCurve, ThermalContact, Warmed, beyond_shift, enough, finished, settle
from viscofric.contact.heating import heats
from viscofric.contact.settings import ContactSettings
from viscofric.contact.steady import thermal_contact
from viscofric.data import read_only
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.solved_columns import columns_of
from viscofric.heat.heating import HeatBalance, Heating, ThermalResistances
from viscofric.heat.means import disc_mean, strip_mean
from viscofric.processes import call_all

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray

    from viscofric.arrays import Array
    from viscofric.contact.solution import ContactSolution
    from viscofric.heat.branches import State
    from viscofric.processes import Workers
    from viscofric.rheology.interface.law import InterfaceLaw
    from viscofric.rheology.material import Material
    from viscofric.thermal import ThermalProperties


#: Rises per decade of α at which states are looked for, and speeds per decade below the slowest one.
_FINE, _BELOW = 40.0, 2.5
#: States are looked for up to this rise, K, at first; then up to this many times more.
_FIRST, _FARTHER, _MOST = 30.0, 1.6, 1000.0

_HEAT_COLUMNS = {
    "isothermal": ("1", "viscoelastic friction coefficient without heating"),
    "temperature_rise": ("K", "mean rise of temperature that the rubber responds to"),
    "coulomb_rise": ("K", "rise of temperature due to Coulomb friction"),
    "loss_rise": ("K", "rise of temperature due to the viscoelastic loss"),
    "track_rise": ("K", "rise of temperature by earlier passes"),
    "face_rise": ("K", "mean rise of temperature of the face"),
    "loss_weighted_rise": ("K", "mean rise of temperature where the loss is released"),
    "cold_viscoelastic": ("1", "viscoelastic friction coefficient as the speed rises"),
    "cold_rise": ("K", "rise of temperature as the speed rises"),
    "hot_viscoelastic": ("1", "viscoelastic friction coefficient as the speed falls"),
    "hot_rise": ("K", "rise of temperature as the speed falls"),
}


@dataclass(frozen=True, eq=False)
class HeatedFrictionCurves(FrictionCurves):
    """Friction curves of contacts that their own friction heats; `temperature` is that of the body.

    Parameters and attributes of `FrictionCurves`, and:

    Attributes
    ----------
    isothermal : (n,) array
        Viscoelastic friction coefficient without heating.
    temperature_rise, coulomb_rise, loss_rise, track_rise : (n,) array
        Rise of temperature that the rubber responds to, its parts due to Coulomb friction and to the loss, and the part
        left by earlier passes, K.
    face_rise, loss_weighted_rise : (n,) array
        Both mean rises, over the face and where the loss is released, K; see `Heating`.
    cold_viscoelastic, cold_rise, hot_viscoelastic, hot_rise : (n,) array
        Friction and rise of the coldest and of the hottest stable state, equal where there is one only.  A speed that
        rises slowly follows the cold states, one that falls slowly the hot ones: the difference is the hysteresis.

    Raises
    ------
    InputError
        If a column is missing, or for the reasons of `FrictionCurves`.
    """

    isothermal: Array | None = None
    temperature_rise: Array | None = None
    coulomb_rise: Array | None = None
    loss_rise: Array | None = None
    track_rise: Array | None = None
    face_rise: Array | None = None
    loss_weighted_rise: Array | None = None
    cold_viscoelastic: Array | None = None
    cold_rise: Array | None = None
    hot_viscoelastic: Array | None = None
    hot_rise: Array | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in _HEAT_COLUMNS:
            if getattr(self, name) is None:
                raise InputError(f"{name} of heated friction curves is missing.", code="wrong-length")
            column = read_only(getattr(self, name), f"{name} of heated friction curves")
            if column.shape != self.speed.shape or not np.all(np.isfinite(column)):
                raise InputError(
                    f"{name} of heated friction curves must hold one number per speed.", code="wrong-length"
                )
            object.__setattr__(self, name, column)

    def to_dataset(self) -> xarray.Dataset:
        """Return the curves as `FrictionCurves` do, with the columns of the heat."""
        return (
            super()
            .to_dataset()
            .assign(
                {
                    name: ("point", getattr(self, name), {"units": unit, "long_name": words})
                    for name, (unit, words) in _HEAT_COLUMNS.items()
                }
            )
        )


def predict_heated(
    contacts: list[dict[str, Any]],
    heating: Heating,
    workers: int | Workers,
    report: Callable[[int], None],
    interface: InterfaceLaw | None = None,
) -> HeatedFrictionCurves:
    """Return the friction of contacts, arguments of `solve_steady` each, of one material, indenter and load.

    The heat of an `interface` takes the place of a constant Coulomb friction.
    """
    contacts = [{**one, "heating": heating, "interface": interface} for one in contacts]
    cold = call_all(_isothermal, contacts, workers=workers, progress=report)
    starts: list[tuple[int, HeatCurve, State]] = []
    for kelvin in sorted({one["temperature"] for one in contacts}):
        rows = [row for row, one in enumerate(contacts) if one["temperature"] == kelvin]
        curve = _Curve(contacts[rows[0]], [cold[row] for row in rows])
        for row in rows:
            found, states = curve.states(cold[row])
            starts += [(row, found, one) for one in dict.fromkeys((states[0], states[-1]))]
    calls = [{**contacts[row], "curve": found, "state": one} for row, found, one in starts]
    solved = call_all(
        _settled, calls, workers=workers, progress=lambda done: report(len(contacts) + min(done, len(contacts)))
    )
    states_of: dict[int, list[Warmed]] = {}
    for (row, _, _), one in zip(starts, solved, strict=True):
        states_of.setdefault(row, []).append(one)
    return _collected([states_of[row] for row in range(len(contacts))], cold, heating, interface)


def _thermal(call: dict[str, Any]) -> tuple[ThermalContact, float]:
    given = dict(call)
    names = ("material", "indenter", "heating", "speed", "temperature")
    material, indenter, heating, speed, temperature = (given.pop(name) for name in names)
    load, accuracy, interface = (given.pop(name) for name in ("load", "accuracy", "interface"))
    settings = ContactSettings(accuracy=accuracy, **given)
    contact = thermal_contact(material, indenter, heating, speed, temperature, settings, load=load, indentation=None)
    return replace(contact, interface=interface), accuracy


def _isothermal(**call: Any) -> Warmed:
    contact, accuracy = _thermal(call)
    return contact.at(0.0, accuracy)


def _settled(curve: HeatCurve, state: State, **call: Any) -> Warmed:
    contact, accuracy = _thermal(call)
    return settle(contact, curve, state, accuracy)


class _Curve:
    """The isothermal curve of one temperature, and what contacts at any rise produce."""

    def __init__(self, call: dict[str, Any], solved: list[Warmed]) -> None:
        self.call = call
        self.heating: Heating = call["heating"]
        self.interface: InterfaceLaw | None = call["interface"]
        self.material: Material = call["material"]
        self.kelvin = float(call["temperature"])
        self.solved = {abs(one.solution.speed): one.solution for one in solved}

    def log10_drop(self, rise: Array) -> Array:
        """Return by how many decades the curve is passed at rises of temperature."""
        shift = self.material.shift
        assert shift is not None
        return np.asarray(shift.log10(self.kelvin + rise)) - float(shift.log10(self.kelvin))

    def states(self, cold: Warmed) -> tuple[HeatCurve, list[State]]:
        """Return the curve of one contact over its rise, and its stable states."""
        last = _FIRST
        while True:
            rise, ended = self._rises(last)
            curve = self._produced(cold, rise)
            states = curve.states()
            if ended or enough(float(rise[-1]), curve.produced.tolist()) or last > _MOST:
                break
            last *= _FARTHER
        if not states:
            raise beyond_shift(self.kelvin + float(rise[-1]))
        return curve, states

    def _rises(self, last: float) -> tuple[Array, bool]:
        """Return rises up to a last one, or up to the last at which α is known, and whether it ended before."""
        rise = np.linspace(0.0, 1.0, 1 + int(_FINE * 10)) ** 2 * last
        try:
            self.log10_drop(rise)
        except InputError:
            low, high = 0.0, last
            for _ in range(40):
                middle = 0.5 * (low + high)
                try:
                    self.log10_drop(np.array([middle]))
                    low = middle
                except InputError:
                    high = middle
            return rise * (low / last), True
        return rise, False

    def _produced(self, cold: Warmed, rise: Array) -> HeatCurve:
        from scipy.interpolate import PchipInterpolator

        speed = abs(cold.solution.speed)
        reduced = np.log(speed) + np.log(10.0) * self.log10_drop(rise)
        self._extend(float(np.exp(reduced.min())))
        speeds = np.array(sorted(self.solved))
        contacts = [self.solved[one] for one in speeds]
        if len(speeds) == 1:
            log_friction, log_area = (np.zeros(len(rise)) for _ in range(2))
        else:
            friction = [max(abs(one.friction_coefficient), 1e-300) for one in contacts]
            area = [one.contact_area for one in contacts]
            log_friction, log_area = (
                PchipInterpolator(np.log(speeds), np.log(column))(reduced) for column in (friction, area)
            )
        log_friction = log_friction - log_friction[0] + np.log(max(abs(cold.solution.friction_coefficient), 1e-300))
        found, loss = heats(cold.solution, self.heating, self.interface)
        coulomb: Any = np.full(len(rise), found)
        if self.interface is not None and found > 0.0:
            stress = np.asarray(self.interface(self.heating.sliding(speed), self.kelvin + rise))
            coulomb *= stress / stress[0] * np.exp(log_area - log_area[0])
        resistances = self._scaled(cold, np.exp(log_area - log_area[0]))
        balance = HeatBalance.of(resistances, coulomb, loss * np.exp(log_friction - log_friction[0]))
        return HeatCurve(rise, np.asarray(self.heating.rise(balance)), log_friction)

    def _scaled(self, cold: Warmed, larger: Array) -> ThermalResistances:
        """Return those of larger contacts (n,), over the area of one solved: as those of discs or strips."""
        line, speed = cold.solution.geometry == "line", abs(cold.solution.speed)
        size = 0.5 * cold.solution.contact_area if line else np.sqrt(cold.solution.contact_area / np.pi)
        mean = strip_mean if line else disc_mean

        def factor(body: ThermalProperties, velocity: float) -> Array:
            """Return the power of the area that the resistance follows, as a factor."""
            peclet = np.maximum(velocity * size / (2.0 * body.diffusivity) * np.array([1.0, 1.1]), 1e-9)
            first, second = (mean(float(one), hertz=True) for one in peclet)
            # Per heat, the rise of a disc falls as its mean in units of q̄ a over a, that of a strip as the mean alone.
            power = np.log(second / first) / np.log(1.1) - (0.0 if line else 1.0)
            return np.asarray(larger ** (power if line else 0.5 * power))

        one, rubber = cold.resistances, factor(self.heating.rubber, speed)
        other = factor(self.heating.counterface, abs(speed - self.heating.sliding(speed)))
        parts: Any = (*(rubber * part for part in one[:4]), one.track, one.counterface * other)
        return ThermalResistances(*parts)

    def _extend(self, lowest: float) -> None:
        """Solve contacts at lower speeds, so that the curve begins at the lowest reduced speed wanted."""
        slowest = min(self.solved)
        while slowest > lowest:
            slowest *= 10.0 ** (-1.0 / _BELOW)
            call = {
                **self.call,
                "speed": slowest,
                "accuracy": max(LOOSE, self.call["accuracy"]),
            }
            contact, accuracy = _thermal(call)
            self.solved[slowest] = contact.solve(self.kelvin, accuracy)


class _Ends(NamedTuple):
    """The coldest and the hottest state of a contact, and that of the branch wanted."""

    cold: Warmed
    hot: Warmed
    wanted: ContactSolution


def _collected(
    states: list[list[Warmed]], cold: list[Warmed], heating: Heating, interface: InterfaceLaw | None
) -> HeatedFrictionCurves:
    ends = []
    for found, isothermal in zip(states, cold, strict=True):
        order = found if heating.branch == "cold" else found[::-1]
        solution = finished(order, isothermal.solution.friction_coefficient, heating, interface)
        ends.append(_Ends(found[0], found[-1], solution))

    def friction(one: Warmed) -> float:
        return abs(one.solution.friction_coefficient)

    heat = [one.wanted.heating for one in ends]
    columns: dict[str, Any] = {
        name: np.array([getattr(one, name) for one in heat]) for name in _HEAT_COLUMNS if hasattr(heat[0], name)
    }
    return HeatedFrictionCurves(
        **columns_of(one.wanted for one in ends),
        source="predicted",
        isothermal=np.array([friction(one) for one in cold]),
        cold_viscoelastic=np.array([friction(one.cold) for one in ends]),
        cold_rise=np.array([one.cold.rise for one in ends]),
        hot_viscoelastic=np.array([friction(one.hot) for one in ends]),
        hot_rise=np.array([one.hot.rise for one in ends]),
        **columns,
    )
