"""Layer on a rigid base, with its response relative to a half-space; elastic indenter; direction of motion.

Plane strain of one wave.  Under the pressure p cos qx on the top z = H of an elastic layer, without shear, the
surface moves by u = 2(1−ν²)/(E q) Θ(qH) p cos qx.  A displacement (U(z) sin qx, W(z) cos qx) with the tractions
(T(z) sin qx, Σ(z) cos qx) is in equilibrium, and obeys Hooke's law, if ::

    U' = q W + 2(1+ν) T/E                       (shear)
    W' = −ν/(1−ν) q U + (1+ν)(1−2ν)/(1−ν) Σ/E   (compression)
    T' = q²E U/(1−ν²) + ν/(1−ν) q Σ             (balance along x)
    Σ' = −q T                                   (balance along z)

with solutions (a + b qz) e^{±qz}.  Let two of the four constants meet U = W = 0 at z = 0 (bonded) or W = T = 0
(sliding without friction), the others T = 0 and Σ = −p at z = H.  Then, with Q = qH, ::

    bonded    Θ = [(3−4ν) sinh 2Q − 2Q] / [(3−4ν) cosh 2Q + 2Q² + 5 − 12ν + 8ν²]
    sliding   Θ = (cosh 2Q − 1) / (sinh 2Q + 2Q)

[1]_ (Eq. A.30), [2]_, [3]_ (section 5.8 for thin ones).  Both go to 1 for Q → ∞.  For Q → 0, a sliding layer is a
Winkler foundation with u = (1−ν²) H p/E, and a bonded one with u = (1+ν)(1−2ν)/(1−ν) H p/E; a bonded incompressible
layer must flow sideways instead, and u = q²H³ p/E.  By the correspondence principle 1/E becomes S(ω).

The mean pressure (q = 0) compresses a layer without bound sideways, on either base, by (1+ν)(1−2ν)/(1−ν) H p/E.

A shear stress τ sin qx on the top instead (Σ = 0, T = τ) raises the surface by 2(1−ν²)/(E q) X(qH) τ cos qx, with ::

    bonded    X = [2κ(κ−1) (cosh 2Q − 1) − 8Q²] / {(κ+1) [2κ cosh 2Q + 1 + κ² + 4Q²]},      κ = 3−4ν
    sliding   X = [(1−2ν) sinh 2Q − 2Q] / {2(1−ν) [sinh 2Q + 2Q]}

X goes to (1−2ν)/(2(1−ν)) for Q → ∞; on thin layers it may be negative, and does not vanish with ν = ½ [4]_.  For Q → 0
it vanishes on a bonded layer, and is −ν/(2(1−ν)) on a sliding one: its base bears no shear, so that the layer passes on
a force to its distant ends, half of it to either side, and is as much thicker behind the contact, in tension or
compression, as it is thinner ahead.

References
----------
.. [1] G. Carbone, L. Mangialardi, J. Mech. Phys. Solids 56 (2008) 684, doi:10.1016/j.jmps.2007.05.009
.. [2] C. Putignano, G. Carbone, D. Dini, Int. J. Solids Struct. 69–70 (2015) 507,
   doi:10.1016/j.ijsolstr.2015.04.034
.. [3] K. L. Johnson, Contact Mechanics (1985), chapter 5.
.. [4] N. Menga, G. Carbone, D. Dini, J. Mech. Phys. Solids 148 (2021) 104273, doi:10.1016/j.jmps.2020.104273
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import flag, real
from viscofric.arrays import Array, ComplexArray
from viscofric.errors import InputError, brief, wrong_argument
from viscofric.notes import Note
from viscofric.showing import Rows, Shown
from viscofric.thermal import FILLED_RUBBER
from viscofric.units import Quantity, checked_poisson_ratio, in_si, number, plain, positive

if TYPE_CHECKING:  # what the command's help has no need of
    from viscofric.contact.free.grids import Extent
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.rheology.spectra.retardation import RetardationSpectrum

MOST_COULOMB = 10.0  # largest friction coefficient that is accepted
LARGE_COMPRESSION = 0.3  # indentation over thickness beyond which small strain is doubtful


@dataclass(frozen=True)
class Layer(Shown):
    """A viscoelastic layer on a rigid base.

    Parameters
    ----------
    thickness : float, str or pint.Quantity
        H, m.
    bonded : bool
        Whether it sticks to the base, or slides on it without friction.

    Raises
    ------
    InputError
        If the thickness is not a length above zero.

    Examples
    --------
    >>> import viscofric as vf
    >>> f"{vf.Layer('2 mm').yielding(1e5, 0.5):.3f}"  # waves much shorter than the layer see a half-space
    '1.000'
    """

    thickness: Quantity
    bonded: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "thickness", positive(self.thickness, "m", "thickness of the layer"))
        flag(self.bonded, "bonded")

    @classmethod
    def of(cls, layer: Layer | Quantity | None) -> Layer | None:
        """Return a layer as it is, or a bonded one of a thickness such as "2 mm"; None: a half-space."""
        if layer is None or isinstance(layer, Layer):
            return layer
        if isinstance(layer, (str, int, float)) or hasattr(layer, "magnitude"):
            return cls(layer)
        raise wrong_argument("layer", layer, "must be a Layer, or a thickness such as '2 mm'.", "wrong-type")

    def _shown(self) -> Rows:
        return (
            ("thickness", self.thickness, "m"),
            ("bonded", self.bonded),
        )

    def yielding(self, wave_number: ArrayLike, poisson_ratio: float) -> Array:
        """Return Θ(qH): displacement under a wave of pressure over that of the half-space.

        Parameters
        ----------
        wave_number : array
            q > 0, 1/m.
        poisson_ratio : float
            0 to 0.5.

        Returns
        -------
        array
            In the shape of `wave_number`, to rounding from qH = 1e-6 to 1e6 and beyond.
        """
        depth = in_si(wave_number, "1/m", "wave_number") * float(self.thickness)
        return _bonded(depth, checked_poisson_ratio(poisson_ratio)) if self.bonded else _sliding(depth)

    def coupling(self, wave_number: ArrayLike, poisson_ratio: float) -> Array:
        """Return X(qH): normal displacement under a wave of shear over that of the half-space under one of pressure.

        Parameters and shape as of `yielding`.
        """
        depth = in_si(wave_number, "1/m", "wave_number") * float(self.thickness)
        nu, decay = checked_poisson_ratio(poisson_ratio), np.exp(-2.0 * depth)
        if not self.bonded:
            sinh, linear = -0.5 * np.expm1(-4.0 * depth), 2.0 * depth * decay  # over exp(2Q)
            return np.asarray(((1.0 - 2.0 * nu) * sinh - linear) / (2.0 * (1.0 - nu) * (sinh + linear)))
        kappa = 3.0 - 4.0 * nu
        squared = np.square(depth * np.exp(-depth))
        above = kappa * (kappa - 1.0) * np.square(np.expm1(-2.0 * depth)) - 8.0 * squared
        below = kappa * (1.0 + decay**2) + (1.0 + kappa**2) * decay + 4.0 * squared
        return np.asarray(above / ((kappa + 1.0) * below))

    def long_coupling(self, poisson_ratio: float) -> float:
        """Return X of waves much longer than the layer is thick."""
        return 0.0 if self.bonded else -poisson_ratio / (2.0 * (1.0 - poisson_ratio))

    def mean_compression(self, poisson_ratio: float) -> float:
        """Return E u/p under a uniform pressure, m: (1+ν)(1−2ν)/(1−ν) H."""
        modulus_ratio = (1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio) / (1.0 - poisson_ratio)
        return modulus_ratio * float(self.thickness)

    def strain_warning(self, indentation: float) -> Note | None:
        """Return a note where an indentation (m) makes the assumption of small strain doubtful."""
        strain = indentation / float(self.thickness)
        if strain <= LARGE_COMPRESSION:
            return None
        return Note(
            "deep-in-layer",
            f"The indenter is pressed {strain:.2f} of the layer's thickness deep; above {LARGE_COMPRESSION} the "
            "assumption of small strain is doubtful.",
            values={"strain": strain, "limit": LARGE_COMPRESSION, "severity": strain},
        )


def _bonded(depth: Array, poisson_ratio: float) -> Array:
    # Multiplied above and below by 2 exp(−2Q), so that nothing overflows; (3−4ν) sinh 2Q − 2Q written as the sum of
    # (3−4ν)(sinh 2Q − 2Q) and 4(1−2ν)Q, neither of which is ever negative, so that nothing cancels.
    kappa = 3.0 - 4.0 * poisson_ratio
    decay = np.exp(-2.0 * depth)
    above = kappa * _scaled_excess_of_sinh(2.0 * depth) + 8.0 * (1.0 - 2.0 * poisson_ratio) * depth * decay
    constant = 5.0 - 12.0 * poisson_ratio + 8.0 * poisson_ratio**2
    # Q² e^{−2Q}, without 0 · ∞ for the deepest layers
    squared = np.square(depth * np.exp(-depth))
    below = kappa * (1.0 + decay**2) + 4.0 * squared + 2.0 * constant * decay
    return np.asarray(above / below)


def _sliding(depth: Array) -> Array:
    above = np.square(np.expm1(-2.0 * depth))
    below = -np.expm1(-4.0 * depth) + 4.0 * depth * np.exp(-2.0 * depth)
    return np.asarray(above / below)


def half_space_coupling(poisson_ratio: float) -> float:
    """Return X of a half-space, (1−2ν)/(2(1−ν)): K. L. Johnson, Contact Mechanics (1985), Eqs. 3.19 and 3.75."""
    return (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio))


def _scaled_excess_of_sinh(x: Array) -> Array:
    """2 e^{−x} (sinh x − x), by its series where the difference would cancel."""
    square = np.square(np.minimum(x, 1.0))
    series = np.ones_like(square)
    # sinh x − x = x³/6 (1 + x²/(4·5) (1 + x²/(6·7) (…))); the next factor is below 1e-16 for x ≤ 1
    for n in (16.0, 14.0, 12.0, 10.0, 8.0, 6.0, 4.0):
        series = 1.0 + square / (n * (n + 1.0)) * series
    near = square * np.minimum(x, 1.0) / 3.0 * series * np.exp(-np.minimum(x, 1.0))
    far = -np.expm1(-2.0 * x) - 2.0 * x * np.exp(-x)
    return np.where(x < 1.0, near, far)


def indenter_compliance(modulus: Quantity | None, poisson_ratio: float) -> float:
    """Return (1 − ν_i²)/E_i of an elastic indenter, 1/Pa, zero if rigid (`modulus` None).

    K. L. Johnson, Contact Mechanics (1985), Eq. 4.6.  Raises InputError if the modulus (Pa if a plain number) is not
    above zero, or the ratio not from −1 to 0.5.
    """
    if modulus is None:
        return 0.0
    ratio = checked_poisson_ratio(poisson_ratio, "indenter_poisson_ratio", above=-1.0)
    return (1.0 - ratio**2) / positive(modulus, "Pa", "indenter_modulus")


def checked_coulomb(coulomb: Quantity) -> float:
    """Return a signed coefficient of Coulomb friction; InputError if it is not finite or implausible."""
    if not abs(found := number(coulomb, "coulomb")) <= MOST_COULOMB:
        raise InputError(
            f"coulomb = {brief(coulomb)}: must be a friction coefficient from {-MOST_COULOMB:g} to {MOST_COULOMB:g}, "
            "negative where the indenter slips against its motion.",
            code="out-of-range",
            values={"argument": "coulomb"},
        )
    return found


def unit_direction(direction: Sequence[float]) -> tuple[float, float]:
    """Return a direction in the plane at length one; InputError if it is not two finite numbers, or both are zero."""
    try:
        x, y = real(direction).tolist()
        length = math.hypot(x, y)
    except (TypeError, ValueError):
        length = math.nan
    if not (math.isfinite(length) and length > 0.0):
        words = "must be two numbers, not both zero, such as (1.0, 0.0)."
        raise wrong_argument("direction", direction, words, "wrong-count")
    return x / length, y / length


#: Acceptable relative change of friction by inertia.
LITTLE_INERTIA = 0.05


_DENSITY = float(FILLED_RUBBER.density)


def shear_wave_speed(modulus: float, poisson_ratio: float, density: float = _DENSITY) -> float:
    """Return the speed of shear waves in a rubber of modulus |E(v/a)|, SI."""
    return math.sqrt(modulus / (2.0 * (1.0 + poisson_ratio) * density))


def inertia_note(
    speed: float, waves: float, density: float = _DENSITY, where: str = "", frequency: str = "v/a"
) -> Note:
    """Return the note on inertia, by the speed of a contact and that of shear waves in the rubber, SI.

    Its ``change`` is the square of their ratio, about the relative change of friction (K. L. Johnson, Contact
    Mechanics, section 11.3).
    """
    change = (speed / waves) ** 2
    at = f"; {where}" if where else ""
    said = (
        f"Shear waves in the rubber run at {plain(waves, 2)} m/s (at |E({frequency})|, with {density:.4g} kg/m³{at}). "
        f"Inertia, which is left out, changes friction by about {plain(100.0 * change, 2)} % there (good if ≤ "
        f"{100.0 * LITTLE_INERTIA:.0f} %){'.' if change <= LITTLE_INERTIA else '; at lower speeds it does not matter.'}"
    )
    values = {"wave_speed": waves, "change": change, "density": density, "severity": change}
    return Note("quasi-static", said, values=values)


def inertia_notes(
    speed: ArrayLike,
    frequency: ArrayLike,
    modes: RetardationSpectrum,
    poisson_ratio: float,
    where: Sequence[str] = ("",),
) -> tuple[Note, ...]:
    """Return a note if inertia changes the friction of one of several contacts by much, of their frequencies v/a."""
    speed, frequency = np.atleast_1d(np.abs(speed)), np.atleast_1d(np.abs(frequency))
    moving = np.flatnonzero((speed > 0.0) & np.isfinite(speed) & (frequency > 0.0))
    if not len(moving):
        return ()
    moduli = np.abs(modes.complex_modulus(frequency[moving]))
    worst = int(np.argmax(np.square(speed[moving]) / moduli))
    waves, place = shear_wave_speed(float(moduli[worst]), poisson_ratio), int(moving[worst])
    note = inertia_note(float(speed[place]), waves, where=where[place])
    return (note,) if float(note.values["change"]) > LITTLE_INERTIA else ()


def lag_of_waves(modulus: ComplexArray, poisson_ratio: float) -> ComplexArray:
    """Return b in u = (c − iωb) F, the displacement of a half-space at low frequencies, for its moduli E(ω), SI.

    The waves that it radiates take b ∫(dF/dt)² dt (G. F. Miller, H. Pursey, Proc. R. Soc. A 233 (1955) 55: Lamb's
    integral, here fitted to 1 %; of an elastic ball S. C. Hunter, J. Mech. Phys. Solids 5 (1957) 162).
    """
    d = 0.5 - poisson_ratio
    shear = modulus / (2.0 * (1.0 + poisson_ratio))
    return np.asarray((0.66 + d * (0.74 + 1.3 * d)) / (2.0 * math.pi) * math.sqrt(_DENSITY) * shear**-1.5)


def waves_notes(change: float, modulus: float, poisson_ratio: float, time: float, said: str) -> tuple[Note, ...]:
    """Return a note if the waves that a contact sends into a half-space in a time change what is said by much, SI."""
    if change <= LITTLE_INERTIA:
        return ()
    waves = shear_wave_speed(modulus, poisson_ratio)
    said = (
        f"Inertia of the rubber is left out. With {_DENSITY:.4g} kg/m³ shear waves run at {plain(waves, 2)} m/s, and "
        f"where it is thicker than {plain(500.0 * waves * time, 2)} mm, {said} (good if ≤ {100.0 * LITTLE_INERTIA:.0f} "
        "%); in slower motion it does not matter."
    )
    values = {"wave_speed": waves, "change": change, "density": _DENSITY, "severity": change}
    return (Note("quasi-static", said, values=values),)


def contact_notes(
    indenter: Indenter,
    contact: Extent,
    *,
    indentation: float,
    load: float,
    speed: float,
    modes: RetardationSpectrum,
    poisson_ratio: float,
    layer: Layer | None,
) -> tuple[Note, ...]:
    """Return what is doubtful about the assumptions of a steady contact, SI, with the modes at its temperature."""
    notes = indenter.warnings(contact, indentation, load, modes.E0, poisson_ratio)
    strained = None if layer is None else layer.strain_warning(indentation)
    notes += [] if strained is None else [strained]
    half = 0.5 * (contact.front + contact.rear)
    return (*notes, *inertia_notes(speed, speed / half if half > 0.0 else 0.0, modes, poisson_ratio))
