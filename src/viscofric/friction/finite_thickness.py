"""Effect of the rubber's finite thickness on friction, estimated without solving a layer, and the half-space check.

Waves of pressure longer than the layer's thickness displace its surface Θ(qH) times as much as a half-space's (see
`viscofric.contact.bodies`).  The difference of the displacements under the half-space's own pressure is a smooth
hollow as wide as the layer is thick; across a small contact it is a level, a slope and a curvature ::

    Δδ = ∫ d²q/(2π)² 2(1−ν²)/q (1 − Θ(qH)) Re S(q·v) p̂ p̂₀/F
    Δμ = ∫ d²q/(2π)² 2(1−ν²)/q (1 − Θ(qH)) (−Im S(q·v)) (q·v)/v |p̂|²/F²
    Δκ = ∫ d²q/(2π)² 2(1−ν²)/q (1 − Θ(qH)) Re S(q·v) |p̂|²/F q²/2

(in plane strain dq/(2π) and q² in their places).  The level is subtracted from the indentation.  The slope follows from
the dissipation of those waves: a paraboloid on a slope makes the same contact beside its axis, with friction smaller by
Δμ.  The curvature adds to the indenter's 1/R, on which friction depends by the load rule
(`viscofric.friction.shifting.load_rule`): d ln μ = (2 + s)/3 R Δκ for a ball and (1 + s)/2 R Δκ for a cylinder, with
s = d ln μ/d ln v; it mostly raises friction.  p̂ is the transform of Hertz's pressure on the contact's radius and p̂₀
that of a flat punch, the weight of a displacement in the indentation; for long waves both are nearly F.

For short memory, vτ ≪ a, slope and curvature are both proportional to (a/H)³ (line contacts: a²/H²) and nearly cancel.
Where the memory is as long as the thickness, and in broad spectra, whose slow modes dissipate in long waves, the slope
alone matters, and decreases with the thickness as slowly as the loss of waves as long as the thickness.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.bodies import Layer
from viscofric.friction.assumption_check import AssumptionCheck, ContactSize, modes_by_temperature, verdict
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, Remedy
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import Quantity, plain, positive

#: Thinnest layer that is estimated, in contact radii: a contact on a thinner one is unlike that on a half-space.
THINNEST = 1.0
# Thickest layer in the search, in contact radii, and steps of its bisection.
_THICKEST, _BISECTIONS = 1e9, 40
# Waves, in natural logarithms of q times a length: from a negligible contribution of long waves to those too short for
# the layer (1 − Θ = e⁻⁵⁰) or the contact; in plane strain they are as long as the longest memory, and longer.
_LONG, _LONGER, _SHORTEST_OF_LAYER, _SHORTEST_OF_CONTACT = -12.0, -6.0, 3.2, 7.0
_STEP = 0.05
# Memory lengths in those of a wave that count as endless: their fourth powers do not overflow.
_ENDLESS = 1e60
# Friction of the half-space is limited to within this factor of Hertz's estimate.
_LIKELY = 3.0


class ThicknessEffect(NamedTuple):
    """Relative changes from the half-space to a layer, negative where the layer has less."""

    friction: float
    indentation: float  # NaN for a line contact: on a half-space its indentation has no reference level


@dataclass(frozen=True, eq=False)
class ContactOnLayers:
    """A contact that was solved or estimated on a half-space, to be put on layers.

    Compared with layers solved to 2e-3, bonded and sliding, ν from 0 to 0.5, one mode (E∞/E0 from 2 to 1000, vτ/a from
    0.05 to 300), power-law spectra and the synthetic fluoroelastomer, the change of friction is accurate to 7 % of
    itself or to 0.0012 of friction under a ball on two contact radii and more (15 % or 0.006 on one), and to 30 % or
    0.0023 under a cylinder on two half-widths and more; that of the indentation is up to 25 % of itself too small and
    5 % too large.  Under ellipsoids of 1 : 3 and cones, on four contact radii and more, that of friction is accurate to
    45 % or to 0.006.  Of two numbers the larger counts.
    """

    spectrum: RetardationSpectrum  # of the material at its temperature
    poisson_ratio: float
    radius: float  # a, m, of the contact, or half its width
    curvature: float  # 1/R, 1/m, of the equivalent paraboloid
    speed: float  # m/s, above zero
    load: float  # N, above zero; of a line contact N/m
    line: bool = False
    friction: float | None = None  # on the half-space; Hertz's estimate if None, and between half and twice that

    @cached_property
    def _half_space(self) -> float:
        """Friction on the half-space: the known one, within likely limits of Hertz's estimate."""
        hertz = self._friction(self._seen, _STEP * self._seen.q)
        friction = hertz if self.friction is None or not np.isfinite(self.friction) else self.friction
        return float(np.clip(friction, hertz / _LIKELY, hertz * _LIKELY))

    @cached_property
    def _sunk(self) -> float:
        """Indentation: 3/2 of a paraboloid's displacement averaged with a punch's pressure (Hertz)."""
        return 1.5 * self._level(self._seen, _STEP * self._seen.q)

    @cached_property
    def _slope(self) -> float:
        """Return d ln μ/d ln v: by the loss at a given radius, and by the radius, ln a = p ln S̄(v/a)."""
        seen, dimension = self._seen, 1 if self.line else 2
        stored = _STEP * seen.q * seen.pressure**2
        lost = stored * seen.q ** (dimension - 1)
        steep = float(lost @ seen.steeper) / max(float(lost @ seen.loss), np.finfo(float).tiny)
        stiffer = float(stored @ seen.softer) / float(stored @ seen.storage) / (1.0 + dimension)
        return steep - (dimension + steep) * stiffer / (1.0 + stiffer)

    @cached_property
    def _seen(self) -> _Waves:
        """The waves of the half-space's pressure."""
        return self._waves(self.radius, _SHORTEST_OF_CONTACT)

    def on(self, layer: Layer) -> ThicknessEffect:
        """Return the effect of a layer; one thinner than the contact's radius counts as that thick."""
        thickness = max(float(layer.thickness), THINNEST * self.radius)
        seen = self._waves(thickness, _SHORTEST_OF_LAYER)
        taken = _STEP * seen.q * (1.0 - Layer(thickness, layer.bonded).yielding(seen.q, self.poisson_ratio))
        indentation = np.nan if self.line else -self._level(seen, taken) / self._sunk
        if self._half_space == 0.0:
            return ThicknessEffect(0.0, indentation)
        less = self._friction(seen, taken) / self._half_space
        bent = self._bend(seen, taken) / self.curvature
        more = bent * ((1.0 + self._slope) / 2.0 if self.line else (2.0 + self._slope) / 3.0)
        return ThicknessEffect(more - less, indentation)

    def thickness_for(self, change: float) -> float:
        """Return the least thickness, m, that changes friction by at most `change` (relative); one radius or more."""

        def enough(radii: float) -> bool:
            return abs(self.on(Layer(radii * self.radius)).friction) <= change

        low, high = THINNEST, _THICKEST
        if enough(low):
            return low * self.radius
        for _ in range(_BISECTIONS):
            middle = float(np.sqrt(low * high))
            low, high = (low, middle) if enough(middle) else (middle, high)
        return high * self.radius

    def _friction(self, seen: _Waves, measure: Array) -> float:
        around = 1.0 if self.line else seen.q
        return self._per_wave * float(measure @ (around * seen.loss * seen.pressure**2))

    def _level(self, seen: _Waves, measure: Array) -> float:
        return self._per_wave * float(measure @ (seen.storage * seen.pressure * seen.punch))

    def _bend(self, seen: _Waves, measure: Array) -> float:
        squared = seen.q if self.line else 0.5 * seen.q**2
        return self._per_wave * float(measure @ (squared * seen.storage * seen.pressure**2))

    @property
    def _per_wave(self) -> float:
        """The load's 2(1−ν²)/(2π) on a surface, its 4(1−ν²)/(2π) in plane strain, where q < 0 counts too."""
        return self.load * (1.0 - self.poisson_ratio**2) * (2.0 if self.line else 1.0) / np.pi

    def _waves(self, length: float, shortest: float) -> _Waves:
        memory = self.speed * float(self.spectrum.tau.max(initial=0.0)) / length
        longest = min(_LONG, _LONGER - np.log(max(memory, 1.0))) if self.line else _LONG
        q = np.exp(np.arange(longest, shortest, _STEP)) / length
        C = self.spectrum.C
        k = np.minimum(np.multiply.outer(self.speed * self.spectrum.tau, q), _ENDLESS)
        glassy, t = 1.0 / self.spectrum.E_inf, q * self.radius
        if self.line:
            from scipy.special import j1

            squared = 1.0 + k**2
            loss, storage = C @ (k / squared), glassy + C @ (1.0 / squared)
            steeper, softer = C @ (k * (1.0 - k**2) / squared**2), C @ (-2.0 * (k / squared) ** 2)
            return _Waves(q, storage, loss, softer, steeper, 2.0 * j1(t) / t, np.cos(t))
        # means over the waves' directions φ of 1/(1 + k²cos²φ) and k cos²φ/(1 + k²cos²φ)
        root = np.sqrt(1.0 + k**2)
        loss, storage = C @ (k / (root * (1.0 + root))), glassy + C @ (1.0 / root)
        steeper, softer = C @ (k / root**3) - loss, C @ (-(k**2) / root**3)
        near = 1.0 - t**2 / 10.0
        far = 3.0 * (np.sin(t) - t * np.cos(t)) / t**3
        return _Waves(q, storage, loss, softer, steeper, np.where(t < 1e-2, near, far), np.sinc(t / np.pi))


class _Waves(NamedTuple):
    """Waves of pressure, all (n,): Re S and −Im S of the rubber under them, their slopes by ln v, p̂/F and p̂₀/F."""

    q: Array
    storage: Array
    loss: Array
    softer: Array
    steeper: Array
    pressure: Array
    punch: Array


#: A layer thinner than this many contact radii is never taken as a half-space.
THICK = 4.0
# Smaller changes are given as at most this.
_SMALLEST = 1e-3


def check_half_space(
    material: Material, curves: FrictionCurves, sizes: Sequence[ContactSize], thickness: Quantity | None, passes: float
) -> AssumptionCheck:
    """Check the half-space at all points of friction curves, of contacts of given sizes; return the worst case."""
    # `thickness` is that of the rubber, m; if not given, the sentence names the one needed. Rubber is taken as a
    # half-space if the relative change of friction is at most `passes`.
    # By both bounds: the upper one, at E0, is often the same everywhere.
    widest = max(sizes, key=lambda size: size.largest * size.smallest)
    given = None if thickness is None else positive(thickness, "m", "thickness")
    layer = Layer(THICK * widest.smallest if given is None else given)
    modes_at = modes_by_temperature(material)
    contacts = [
        ContactOnLayers(
            modes_at(size.where.temperature),
            material.poisson_ratio,
            # far away a long ellipse acts as a circle no larger than this
            min(size.smallest, size.relaxed),
            size.curvature,
            size.where.speed,
            size.where.load,
            size.where.load_unit == "N/m",
            abs(friction),
        )
        for friction, size in zip(curves.viscoelastic.tolist(), sizes, strict=True)
    ]
    effects = [one.on(layer) for one in contacts]
    place = max(range(len(effects)), key=lambda row: abs(effects[row].friction))
    worst, effect, where = contacts[place], effects[place], sizes[place].where
    enough = worst.thickness_for(passes)
    limit = min(1.0 / THICK, widest.largest / enough)
    there = "" if str(where) == str(widest.where) else f" ({where})"
    several = "half widths" if worst.line else "contact radii"
    radii, percent = f"{THICK:.0f} {several} ({1e3 * THICK * widest.largest:.2g} mm)", f"{100.0 * passes:.0f} %"
    # lengths in m, changes from the half-space to a bonded layer as parts of the values there
    values: dict[str, float | None] = {
        **widest.values,
        "radii": THICK,
        "least_thickness": THICK * widest.largest,
        "thickness_for_friction": enough,
        "thickness": given,
    }
    if given is None:
        said = Note(
            "thickness-not-given",
            f"{widest}. The half-space assumption needs a thickness of at least {radii}, and about {_mm(enough)} "
            f"for friction on a bonded layer to agree within {percent}{there}; no thickness was given.",
            values=values,
        )
        return AssumptionCheck.of("half-space", None, said, None, limit)
    holds = verdict(widest.smallest / given, widest.largest / given, 1.0 / THICK)
    if given >= THINNEST * worst.radius:
        values["friction"] = effect.friction
        values["indentation"] = None if worst.line else effect.indentation
    compared = {True: f", although at least {radii},", None: "", False: f", less than {radii},"}[holds]
    rubber, felt = f"{_mm(given)} of rubber", f"{_effect(effect, given, worst)}{there}"
    if abs(effect.friction) <= passes and holds is not False:
        said = {
            True: Note(
                "half-space",
                f"{widest}. {rubber}, at least {radii}, can be taken as a half-space: {felt}.",
                values=values,
            ),
            None: Note(
                "radius-not-known",
                f"{widest}. Whether {rubber} can be taken as a half-space depends on its size: solve the contact "
                f"and give contact_radius. With the estimate, {felt}.",
                values=values,
            ),
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
            values=values,
        )
        holds = False
    return AssumptionCheck.of("half-space", holds, said, widest.largest / given, limit)


def _effect(effect: ThicknessEffect, thickness: float, worst: ContactOnLayers) -> str:
    """Return the change on a bonded layer in words."""
    if thickness < THINNEST * worst.radius:
        size = "half the contact's width" if worst.line else "the contact radius"
        return f"it is thinner than {size}, and such a layer behaves quite differently from a half-space"
    friction = f"friction on a bonded layer of {_mm(thickness)} is {_change(effect.friction, 'lower', 'higher')}"
    if worst.line:
        return f"{friction} than on the half-space; the indentation of a line contact cannot be compared with it"
    return f"{friction} than on the half-space, the indentation {_change(effect.indentation, 'smaller', 'larger')}"


def _change(change: float, less: str, more: str) -> str:
    if abs(change) < _SMALLEST:
        return f"{100.0 * _SMALLEST:g} % {less} at most" if change < 0.0 else f"{100.0 * _SMALLEST:g} % {more} at most"
    return f"about {plain(100.0 * abs(change), 2)} % {less if change < 0.0 else more}"


def _mm(length: float) -> str:
    return f"{1e3 * length:.3g} mm"
