"""Coulomb friction of friction curves that changes viscoelastic friction, see `viscofric.contact.coupling`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.coupling import LARGEST, REMEDY, ShearedContact, coupling_notes, sheared_compliance
from viscofric.friction.assumption_check import AssumptionCheck, Place, modes_by_temperature, modes_of, verdict
from viscofric.notes import Note

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.arrays import Array
    from viscofric.contact.bodies import Layer
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.material import Material
    from viscofric.rheology.spectra.retardation import RetardationSpectrum


def shear_notes(
    curves: FrictionCurves,
    coulomb: Array,
    bodies: Sequence[tuple[Material, Layer | None]],
    rise: Array | None = None,
) -> tuple[Note, ...]:
    """Return a note where Coulomb friction (n,) changes predicted friction, solved without it, by too much.

    `bodies` are the material and the layer of each point, `rise` (n,) its temperature above that of the body, K.
    """
    assert curves.mean_pressure is not None
    kelvin = curves.temperature if rise is None else curves.temperature + rise
    area = curves.load / curves.mean_pressure
    radius = 0.5 * area if curves.load_unit == "N/m" else np.sqrt(area / math.pi)
    rows = np.flatnonzero(coulomb != 0.0).tolist()
    modes = (modes_of(bodies[row][0], float(kelvin[row])) for row in rows)
    return coupling_notes(
        _sheared(curves, row, float(coulomb[row]), *bodies[row], float(radius[row]), found)
        for row, found in zip(rows, modes, strict=True)
    )


def check_coupling(
    curves: FrictionCurves,
    material: Material,
    layer: Layer | None,
    radii: Sequence[tuple[float, float]],
) -> AssumptionCheck | None:
    """Check the coupling at the worst point of friction curves of known Coulomb friction; None if none is known.

    `radii` are the smallest and the largest possible radius of each contact, m.
    """
    if curves.coulomb is None or not np.any(np.isfinite(curves.coulomb)):
        return None
    worst: list[ShearedContact] = []
    modes_at = modes_by_temperature(material)
    for row in np.flatnonzero(np.isfinite(curves.coulomb)).tolist():
        modes, coulomb = modes_at(float(curves.temperature[row])), float(curves.coulomb[row])
        both = (_sheared(curves, row, coulomb, material, layer, one, modes) for one in radii[row])
        found = sorted(both, key=lambda one: one.share)
        if not worst or found[1].share > worst[1].share:
            worst, place = found, Place.of(curves, row)
    low, high = worst[0].share, worst[1].share
    holds = verdict(low, high, LARGEST)
    percent = f"{100 * LARGEST:.0f} %"
    rest = {
        True: f", which is negligible up to {percent}.",
        None: f", which is negligible up to {percent}. Here this depends on the contact size: solve the contact and "
        "give contact_radius.",
        False: f", which is doubtful above {percent}",
    }[holds]
    remedy = None if holds is not False else REMEDY + " Less slip or Coulomb friction (PTFE, lubricant) reduces it."
    values = {"lowest": low, "highest": high, **worst[1].values, **place.values}
    least = "" if low >= 0.98 * high else f" (a change of {100 * low:.2g} % for the other bound of the contact size)"
    said = Note("tangential-coupling", worst[1].said + least + rest, remedy=remedy, values=values)
    return AssumptionCheck.of("uncoupled", holds, said, high, LARGEST)


def _sheared(
    curves: FrictionCurves,
    row: int,
    coulomb: float,
    material: Material,
    layer: Layer | None,
    radius: float,
    modes: RetardationSpectrum,
) -> ShearedContact:
    """Return the contact of a point of curves, of a radius or half-width, m, with the material's modes there."""
    line, ratio = curves.load_unit == "N/m", material.poisson_ratio
    area = 2.0 * radius if line else math.pi * radius**2
    return ShearedContact(
        stress=abs(coulomb) * float(curves.load[row]) / area,
        friction=float(curves.viscoelastic[row]),
        compliance=sheared_compliance(modes, ratio, layer, radius, float(curves.speed[row]), line=line),
        line=line,
        where=str(Place.of(curves, row)),
    )
