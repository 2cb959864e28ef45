"""Contacts of a study that their own friction heats: the curve of one temperature, and the map of one contact."""

from __future__ import annotations

from typing import Any

import numpy as np

from viscofric.contact.fields.dissipation import Modes
from viscofric.contact.heating import face_temperature
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.steady import solve_steady
from viscofric.errors import ViscofricError
from viscofric.friction.cases.record import Column, HistoryRecord
from viscofric.friction.cases.surfaces import TOLERANCE, surface_of, unit_vector
from viscofric.friction.prediction import predict_friction
from viscofric.heat.heating import Heating
from viscofric.heat.result import COLUMNS as HEAT_COLUMNS
from viscofric.notes import note_of
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.quality import BEYOND
from viscofric.roughness.ensemble import predict_rough_friction
from viscofric.roughness.rough_friction import HeatedRoughFriction

#: Column of the results -> that of heated friction curves, unit, and meaning.
COLUMNS = {
    "friction_coefficient": ("viscoelastic", "1", "viscoelastic friction coefficient with heating"),
    "friction_error": ("viscoelastic_error", "1", "numerical error estimate of the friction coefficient"),
    **{name: (name, *meaning) for name, meaning in HEAT_COLUMNS.items()},
    "mean_pressure": ("mean_pressure", "Pa", "load over contact area"),
    "interface_friction": ("coulomb", "1", "friction coefficient of the interface with heating"),
    "interface_error": ("coulomb_error", "1", "standard error of the friction coefficient of the interface"),
}
#: Notes of the curves that are kept; others the study has anyway: of isothermal contacts, or counted over all cases.
_KEPT = (
    *(BEYOND, "interface-extrapolated", "interface-pressure", "loss-beyond", "mean-heat-left-out", "rise-uncertain"),
    "states-beyond",
)


def solve_heated(
    material: Material, *, speeds: tuple[float, ...], temperature: float, **settings: Any
) -> HistoryRecord:
    """Solve contacts of one temperature and load at all speeds, each at the temperature to which it heats itself.

    Speeds at which there is no solution are left out, with a warning; if there is none at any, the error of the first
    is raised.  `settings` are further arguments of `predict_friction`, SI, or with a `surface`, the description of one,
    and its `direction` (rad), those of `predict_rough_friction`.
    """

    def solve(chosen: list[float]) -> Any:
        common = {"speeds": chosen, "temperatures": temperature, **settings}
        if "surface" not in common:
            return predict_friction(material, common.pop("indenter"), **common)
        common |= {"direction": unit_vector(common["direction"]), "tolerance": TOLERANCE}
        found = predict_rough_friction(material, surface_of(common.pop("surface")), **common)
        assert isinstance(found, HeatedRoughFriction)
        return _RoughCurve(found)

    wrong: dict[float, ViscofricError] = {}
    try:
        curves: list[Any] = [solve(list(speeds))]
    except ViscofricError:
        curves = []
        for speed in speeds:
            try:
                curves.append(solve([speed]))
            except ViscofricError as error:
                wrong[speed] = error
        if not curves:
            raise wrong[speeds[0]] from None
    reasons = dict.fromkeys(error.code for error in wrong.values())
    alike = [{speed: error for speed, error in wrong.items() if error.code == code} for code in reasons]
    said = [some[min(some)].note.at(" and ".join(f"{speed:g} m/s" for speed in some)) for some in alike]
    notes = [note_of(note) for one in curves for note in one.notes]
    # Of indenters a check, with an interface a note of the isothermal contacts has it.
    has_shear = "surface" in settings and settings.get("interface") is None
    kept = (*_KEPT, "tangential-coupling") if has_shear else _KEPT
    said += [note for note in notes if note.code in kept]
    return HistoryRecord({}, tuple(dict.fromkeys(said)), columns=_columns(curves))


class _RoughCurve:
    """Heated friction on one surface at one temperature, with the columns of heated friction curves, (n,) each."""

    def __init__(self, found: HeatedRoughFriction) -> None:
        self.speed, self.notes = found.speed, found.notes
        area = found.corrected_area_fraction[0, :, 0]
        given = {
            "viscoelastic": found.friction_coefficient,
            "viscoelastic_error": found.friction_error,
            "coulomb": found.interface_friction,
            "coulomb_error": found.interface_error,
            **{name: getattr(found, name) for name in HEAT_COLUMNS},
        }
        columns = {name: None if one is None else one[0, :, 0] for name, one in given.items()}
        vars(self).update(columns, mean_pressure=found.pressure / area)


def _columns(curves: list[Any]) -> dict[str, Column]:
    def joined(name: str) -> list[float]:
        return [value for one in curves for value in getattr(one, name).tolist()]

    found = {"speed": Column(joined("speed"), "m/s", "speed")}
    for name, (theirs, unit, words) in COLUMNS.items():
        if getattr(curves[0], theirs) is not None:
            found[name] = Column(joined(theirs), unit, words)
    return found


def solve_temperature_map(
    material: Material,
    *,
    indenter: Indenter,
    speed: float,
    temperature: float,
    rise: float,
    face_rise: float,
    heating: Heating,
    interface: InterfaceLaw | None = None,
    **settings: Any,
) -> HistoryRecord:
    """Return the rise of temperature of the rubber's face in and around a contact that is so much warmer, K.

    Its rubber by `rise`, its faces, and with them the interface, on average by `face_rise`.
    `x` and `y` are those of each cell, and `contact` the part of it in the contact.  See `solve_heated`.
    """
    solution = solve_steady(material, indenter, speed=speed, temperature=temperature + rise, **settings)
    spectrum = material.modes_at(temperature + rise)
    modes = Modes(np.asarray(spectrum.C), np.asarray(spectrum.tau))
    coulomb, slip = heating.coulomb_heat(solution.load, speed), heating.sliding(speed)
    if interface is not None:
        coulomb = float(interface(slip, temperature + face_rise)) * solution.contact_area * slip if slip > 0.0 else 0.0
    found = face_temperature(solution, modes, material.poisson_ratio, heating, coulomb)
    x, y = np.meshgrid(found.x, found.y, indexing="ij")
    columns = {
        "x": Column(x.ravel().tolist(), "m", "position along the motion, from the axis"),
        "y": Column(y.ravel().tolist(), "m", "position across the motion"),
        "rise": Column(found.rise.ravel().tolist(), "K", "rise of temperature of the rubber's face"),
        "contact": Column(found.contact.ravel().tolist(), "1", "share of the cell that lies in the contact"),
    }
    return HistoryRecord({}, (), columns=columns)
