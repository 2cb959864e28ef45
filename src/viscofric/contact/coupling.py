"""Change of friction by the shear of Coulomb friction, for contacts that are solved without it.

A shear τ = μ_c p moves the surface in the normal direction by −i X q·n/|q| times what the same wave of pressure moves
a half-space by (`viscofric.contact.bodies`).  Under a given pressure, the slope of this displacement changes friction
by ::

    Δμ = 2(1−ν²) Σ_q (q·n/|q|)² X Re S(−q·v) τ̂ p̂* / σ̄  ≈  2c (1−ν²) |<X S(q v)>| <p²>/<p>² (1 − A <p>²/<p²>) τ̄

with the means τ̄ and <p> over the contact, <X S> over the waves of the pressure, c = 1 of line contacts and 1/2 of
others, and A the contact area over the nominal one, since a uniform shear has no slope.  The change also moves the
pressure, out of phase with the shear where there is loss: therefore the modulus of the mean rather than its real part.
<p²>/<p>² is 1.1 for Hertz's pressures and 1.2 to 1.4 for rough surfaces.  The change has the other sign where the slip
is reversed.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.fft

from viscofric.contact.bodies import Layer, half_space_coupling
from viscofric.contact.periodic.surface import PeriodicSurface, hermitian_factor, wave_number
from viscofric.notes import Note, Remedy

if TYPE_CHECKING:
    from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Largest acceptable change, over viscoelastic friction.
LARGEST = 0.05
#: <p²>/<p>² of contacts.
_SQUARE = 1.25
#: Contact area of solved contacts over that of Persson's theory.
_SOLVED = 1.25
#: Wave numbers times the contact's radius, over the whole spectrum of the pressure.
_WAVES = np.exp(np.arange(-5.0, 5.0, 0.05))
#: What to do about the change, as the end of a sentence.
REMEDY = (
    "; solve contacts with it ("
    + Remedy("coulomb=, without heating", "--coulomb", "viscofric solve --coulomb", "viscofric solve --coulomb")
    + "), or take the mean of friction over both directions of slip."
)
#: The same of contacts that were solved with another shear.
OTHER_REMEDY = (
    "; give the latter over the pressure as " + Remedy("coulomb=", "--coulomb", "--coulomb", "--coulomb") + "."
)


@dataclass(frozen=True)
class ShearedContact:
    """A contact solved without shear, and the shear of its Coulomb friction."""

    stress: float  # mean shear stress of the contact, Pa
    friction: float  # viscoelastic friction coefficient
    compliance: float  # (1 − ν²)|<X S(q v)>|, 1/Pa
    line: bool = False  # whether it is a line contact
    filled: float = 0.0  # contact area over the nominal one, zero for indenters
    where: str = ""  # its conditions in words
    solved: float = 0.0  # mean shear stress that it was solved with, Pa

    @property
    def left_out(self) -> float:
        """Shear stress that it was solved without, or with too much, Pa."""
        return abs(abs(self.stress) - self.solved)

    @property
    def change(self) -> float:
        """Estimated change of the friction coefficient, of either sign."""
        both = (2.0 if self.line else 1.0) * self.compliance * self.left_out
        return both * max(_SQUARE - self.filled, 0.0)

    @property
    def share(self) -> float:
        """The change over viscoelastic friction."""
        return self.change / max(abs(self.friction), 1e-12)

    @property
    def said(self) -> str:
        """The change in words."""
        at = f"; {self.where}" if self.where else ""
        percent = f"{100.0 * self.share:.2g}" if self.share < 0.1 else f"{100.0 * self.share:.0f}"
        if self.solved:
            return (
                f"Contacts were solved with a shear stress of {1e-6 * self.solved:.2g} MPa, but their Coulomb friction "
                f"is one of {1e-6 * abs(self.stress):.2g} MPa; the difference changes the friction coefficient by "
                f"about {self.change:.2g} ({percent} % of viscoelastic friction{at})"
            )
        return (
            f"Coulomb friction, a shear stress of {1e-6 * abs(self.stress):.2g} MPa, also displaces the surface in the "
            f"normal direction, which changes the friction coefficient by about {self.change:.2g} "
            f"({percent} % of viscoelastic friction{at}), with the opposite sign where the slip is "
            "reversed. Contacts were solved without this effect"
        )

    @property
    def values(self) -> dict[str, float]:
        """Numbers of the sentence by name, SI."""
        return {"stress": abs(self.stress), "solved": self.solved, "change": self.change, "share": self.share}


def coupling_notes(contacts: Iterable[ShearedContact]) -> tuple[Note, ...]:
    """Return a note on the contact whose friction changes most, relative to it; none if it hardly changes."""
    sheared = [one for one in contacts if one.left_out > 0.0]
    worst = max(sheared, key=lambda one: one.share, default=None)
    if worst is None or worst.share <= LARGEST:
        return ()
    if worst.solved:
        return (Note("other-shear", worst.said, remedy=OTHER_REMEDY, values=worst.values),)
    return (Note("tangential-coupling", worst.said, remedy=REMEDY, values=worst.values),)


def sheared_compliance(
    spectrum: RetardationSpectrum,
    poisson_ratio: float,
    layer: Layer | None,
    radius: float,
    speed: float,
    *,
    line: bool = False,
) -> float:
    """Return (1 − ν²)|<X S(q v)>|, 1/Pa, of Hertz's pressure on a contact of a radius or half-width, m, at a speed."""
    coupling: Any = half_space_coupling(poisson_ratio)
    if coupling == 0.0 and layer is None:
        return 0.0
    waves = _WAVES / radius
    if layer is not None:
        coupling = layer.coupling(waves, poisson_ratio)
    if line:
        from scipy.special import j1

        weight = np.square(j1(_WAVES)) / _WAVES  # |p̂|² dq, in equal steps of ln q
    else:
        weight = np.square(np.sin(_WAVES) / _WAVES - np.cos(_WAVES)) / np.square(_WAVES)  # q |p̂|² dq
    compliance = weight @ (coupling * spectrum.compliance(abs(speed) * waves)) / weight.sum()
    return (1.0 - poisson_ratio**2) * abs(complex(compliance))


@dataclass(frozen=True)
class SurfaceCoupling:
    """What the shear of contacts on a rough surface depends on."""

    slope: float  # rms slope of the surface
    coupling: float  # |<X>| over the mean of Θ, over its waves, weighted with their slopes
    profile: bool = False  # whether it is the same everywhere across the motion

    @classmethod
    def of(cls, surface: PeriodicSurface, poisson_ratio: float, layer: Layer | None) -> SurfaceCoupling:
        """Return that of a surface on a half-space or layer."""
        waves = np.square(np.abs(scipy.fft.rfft2(surface.z, norm="forward"))) * hermitian_factor(surface.shape[1])
        magnitude = np.hypot(*wave_number(surface.shape, surface.spacing)).ravel()[1:]
        slopes = np.square(magnitude) * waves.ravel()[1:]
        coupling = half_space_coupling(poisson_ratio)
        if layer is not None:
            over = slopes @ layer.yielding(magnitude, poisson_ratio)
            coupling = abs(float(slopes @ layer.coupling(magnitude, poisson_ratio) / over))
        return cls(math.sqrt(float(slopes.sum())), coupling, surface.shape[1] == 1)

    def contact(
        self, coulomb: float, friction: float, area: float, pressure: float, where: str = "", solved: float = 0.0
    ) -> ShearedContact:
        """Return a contact of a Coulomb friction, with its area over the nominal one and its nominal pressure, Pa.

        It was solved with the Coulomb friction `solved`.

        (1 − ν²)|S| times the mean of Θ is that with which Persson's theory, erf(√2 (1−ν²)|S| σ0/h'), has the area,
        but for a factor.
        """
        from scipy.special import erfinv

        compliance = self.slope * float(erfinv(area / _SOLVED)) / (math.sqrt(2.0) * pressure)
        stress, known = (abs(one) * pressure / area for one in (coulomb, solved))
        return ShearedContact(stress, friction, compliance * self.coupling, self.profile, area, where, known)
