"""Result of an identification from friction: the material, the uncertainty of each part of it, and its limits."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

from viscofric.datasets import dataset
from viscofric.friction.identification.identified import Identified
from viscofric.notes import codes
from viscofric.rheology.shifts.shift_factors import ShiftFactors
from viscofric.rheology.spectra.quality import FROM_FRICTION

if TYPE_CHECKING:
    import xarray

    from viscofric.arrays import Array
    from viscofric.friction.curves import FrictionCurves
    from viscofric.rheology.material import Material


#: Notes with which nothing counts as identified: the friction is not that of one rubber, or of no known rubber.
NOTHING_IDENTIFIED = frozenset({"not-one-rubber", "too-steep", "constant-friction"})


@dataclass(frozen=True, eq=False)
class LevelFit:
    """The best-fitting material of a given magnitude of the modulus."""

    factor: float  # |E| at the middle frequency over that of the identified material
    modulus: float  # that |E|, Pa
    material: Material = field(repr=False)
    chi2: float  # sum of the squared residuals of the friction, in standard errors
    rms: float  # root mean square of the relative residuals
    penalty: float  # rise of chi2, including the prior of the spectrum, over the best level; 3.84 is the 95 % limit


@dataclass(frozen=True, eq=False, kw_only=True)
class IdentifiedMaterial(Identified):
    """A material identified from its friction; the attributes of `Identified`, and these.

    `frequency_range` are the lowest and highest frequency v/a of the contacts; the spectrum may end, or rise to the
    glass transition, within a decade of them.  Friction cannot show that the smooth spectrum fails: one mode per decade
    ripples E'' by about 6 %, which contacts average out, and fits as well as a smooth one.

    Attributes
    ----------
    level_range : (float, float)
        95 % limits of |E| at the middle frequency from the samples, Pa.  Without an anchor they depend on the prior of
        the spectrum, and hold less often.
    family : tuple of LevelFit
        Without an anchor: materials with nearly the same friction; empty with one.
    friction : FrictionCurves
        Of the identified material at the measured points, with 95 % limits.
    residuals : (n,) array
        Measured minus fitted, over the standard error, in the order of `friction`.
    iterations : int
        Steps made, with contacts solved in each.
    """

    METHOD: ClassVar[str] = FROM_FRICTION

    level_range: tuple[float, float]
    family: tuple[LevelFit, ...]
    friction: FrictionCurves
    residuals: Array
    iterations: int

    def _attributes(self) -> dict[str, Any]:
        low, high = self.level_range
        return super()._attributes() | {"level_lower": low, "level_upper": high}

    def friction_dataset(self) -> xarray.Dataset:
        """Return `friction` as a labelled data set along ``point``, with the residuals as ``residual``."""
        label = {"units": "1", "long_name": "measured less fitted friction over the standard error"}
        return self.friction.points_dataset().assign(residual=("point", self.residuals, label))

    def shift_dataset(self) -> xarray.Dataset | None:
        """Return α(T) at the temperatures of the friction as a labelled data set; None for one temperature."""
        law = self.shift_factors
        if law is None:
            return None
        kelvin = getattr(law, "temperatures", self.friction.temperatures)
        log10, error = law.values_at(kelvin)
        return dataset(
            "temperature",
            {
                "log10_shift_factor": (log10, "1", "decadic logarithm of the shift factor"),
                "standard_error": (error, "1", "standard error of log10 of the shift factor"),
            },
            coordinates={"temperature": (kelvin, "K", "temperature")},
            attributes={"reference_temperature": law.reference, "found": int(self.shift_found)},
        )

    @property
    def known(self) -> tuple[str, ...]:
        """The identified parts of the modulus, one sentence each; they are stored with the material."""
        return (*self._level_words(), self._band_words())

    @property
    def sentences(self) -> tuple[str, ...]:
        """The result and its limits, one sentence each."""
        return (self._fit_words(), *self.known, *self._shift_words(), *self.notes)

    def _fit_words(self) -> str:
        return (
            f"The friction of {len(self.friction)} points is fitted to {100.0 * self.rms:.2g} % (root mean square); χ² "
            f"= {self.chi2:.3g} with {self.freedom:.3g} degrees of freedom."
        )

    def _level_words(self) -> tuple[str, ...]:
        low, high = self.level_range
        if self.anchored:
            return ()
        sentence = (
            "The level of the modulus is not identified: friction alone hardly determines it, and no anchor or prior "
            f"was given. |E| at {self.middle:.2g} rad/s, {low / 1e6:.3g} to {high / 1e6:.3g} MPa, follows from the "
            "prior of the spectrum and not from the friction, so that every modulus is known up to a factor; the "
            "family has materials with nearly the same friction."
        )
        return (sentence,)

    def _band_words(self) -> str:
        if codes(self.notes) & NOTHING_IDENTIFIED:
            return "Nothing of the modulus is identified: the friction may not come from the loss of a rubber."
        if self.identified.high <= self.identified.low:
            return super()._band_words()
        return (
            f"{super()._band_words()} All bands assume a smooth spectrum: one mode per decade makes E'' oscillate by "
            "about 6 %, which friction averages and no band has."
        )

    def _shift_words(self) -> tuple[str, ...]:
        if not self.shift_found or not isinstance(self.shift_factors, ShiftFactors):
            return ()
        largest = float(self.shift_factors.standard_errors.max())
        sentence = (
            f"α(T) was found from the friction at {len(self.shift_factors.temperatures)} temperatures, each factor to "
            f"{largest:.2g} decades or better."
        )
        return (sentence,)
