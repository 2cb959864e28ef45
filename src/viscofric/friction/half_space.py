"""Whether rubber of finite thickness can be taken as a half-space, by the contact's size and the change of friction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from viscofric.contact.bodies import Layer
from viscofric.friction.assumption_check import AssumptionCheck, verdict
from viscofric.friction.finite_thickness import THINNEST, ContactOnLayers
from viscofric.notes import Note, Remedy
from viscofric.units import plain, positive

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.friction.assumption_check import ContactSize
    from viscofric.friction.curves import FrictionCurves
    from viscofric.friction.finite_thickness import ThicknessEffect
    from viscofric.rheology.material import Material
    from viscofric.units import Quantity

#: A layer thinner than this many contact radii is never taken as a half-space.
THICK = 4.0
# Smaller changes are given as at most this.
_SMALLEST = 1e-3


@dataclass(frozen=True)
class _OnLayers:
    """A contact of friction curves on layers, and its conditions in words."""

    contact: ContactOnLayers
    where: str

    @classmethod
    def of(cls, material: Material, curves: FrictionCurves, row: int, size: ContactSize) -> _OnLayers:
        contact = ContactOnLayers(
            material.modes_at(float(curves.temperature[row])),
            material.poisson_ratio,
            # far away a long ellipse acts as a circle no larger than this
            min(size.smallest, size.relaxed),
            size.curvature,
            float(curves.speed[row]),
            float(curves.load[row]),
            curves.load_unit == "N/m",
            abs(float(curves.viscoelastic[row])),
        )
        return cls(contact, size.where)


def check_half_space(
    material: Material,
    curves: FrictionCurves,
    sizes: Sequence[ContactSize],
    thickness: Quantity | None,
    passes: float,
) -> AssumptionCheck:
    """Check the half-space at all points of friction curves, of contacts of given sizes; return the worst case.

    `thickness` is that of the rubber, m; if not given, the sentence names the one needed.  Rubber is taken as a
    half-space if the relative change of friction is at most `passes`.
    """
    # By both bounds: the upper one, at E0, is often the same everywhere.
    widest = max(sizes, key=lambda size: size.largest * size.smallest)
    given = None if thickness is None else positive(thickness, "m", "thickness")
    layer = Layer(THICK * widest.smallest if given is None else given)
    contacts = (_OnLayers.of(material, curves, row, size) for row, size in enumerate(sizes))
    worst, effect = max(((one, one.contact.on(layer)) for one in contacts), key=lambda pair: abs(pair[1].friction))
    enough = worst.contact.thickness_for(passes)
    limit = min(1.0 / THICK, widest.largest / enough)
    there = "" if worst.where == widest.where else f" ({worst.where})"
    radii, percent = f"{THICK:.0f} contact radii ({1e3 * THICK * widest.largest:.2g} mm)", f"{100.0 * passes:.0f} %"
    if given is None:
        said = (
            f"{widest}. The half-space assumption needs a thickness of at least {radii}, and about {_mm(enough)} "
            f"for friction on a bonded layer to agree within {percent}{there}; no thickness was given."
        )
        return AssumptionCheck.of("half-space", None, said, None, limit)
    holds = verdict(widest.smallest / given, widest.largest / given, 1.0 / THICK)
    compared = {True: f", although at least {radii},", None: "", False: f", less than {radii},"}[holds]
    rubber, felt = f"{_mm(given)} of rubber", f"{_effect(effect, given, worst)}{there}"
    if abs(effect.friction) <= passes and holds is not False:
        said = {
            True: f"{widest}. {rubber}, at least {radii}, can be taken as a half-space: {felt}.",
            None: f"{widest}. Whether {rubber} can be taken as a half-space depends on the radius: solve the contact "
            f"and give contact_radius. With the estimate, {felt}.",
        }[holds]
    else:
        rubber += compared
        why = ":" if abs(effect.friction) > passes else ", although"
        called = Remedy("layer=Layer(…)", "--layer", "[layer]", "“Layer”", "layer")
        said = Note(
            "too-thin",
            f"{widest}. {rubber} cannot be taken as a half-space{why} {felt}. Solve the contact on a layer (",
            remedy=called
            + f") or use thicker rubber: at least {radii}, and about {_mm(enough)} for friction within {percent}.",
        )
        holds = False
    return AssumptionCheck.of("half-space", holds, said, widest.largest / given, limit)


def _effect(effect: ThicknessEffect, thickness: float, worst: _OnLayers) -> str:
    """Return the change on a bonded layer in words."""
    if thickness < THINNEST * worst.contact.radius:
        return "it is thinner than the contact radius, and such a layer behaves quite differently from a half-space"
    friction = f"friction on a bonded layer of {_mm(thickness)} is {_change(effect.friction, 'lower', 'higher')}"
    if worst.contact.line:
        return f"{friction} than on the half-space; the indentation of a line contact cannot be compared with it"
    return f"{friction} than on the half-space, the indentation {_change(effect.indentation, 'smaller', 'larger')}"


def _change(change: float, less: str, more: str) -> str:
    if abs(change) < _SMALLEST:
        return f"{100.0 * _SMALLEST:g} % {less} at most" if change < 0.0 else f"{100.0 * _SMALLEST:g} % {more} at most"
    return f"about {plain(100.0 * abs(change), 2)} % {less if change < 0.0 else more}"


def _mm(length: float) -> str:
    return f"{1e3 * length:.3g} mm"
