"""Power spectra of rough surfaces: how much each wavelength contributes to heights, slopes and curvatures."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import LARGEST, exactly_one
from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, wrong_argument
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantity, in_si, number, positive, to_si

#: Nodes of the quadrature in each segment.
NODES = 12


@dataclass(frozen=True, eq=False)
class Density(Plotted):
    """A density that is a power law between its points, and zero beyond them."""

    _unit: ClassVar[str]
    _name: ClassVar[str]
    wave_number: Array
    density: Array

    def __post_init__(self) -> None:
        q, density = _checked(self.wave_number, self.density, self._unit)
        object.__setattr__(self, "wave_number", q)
        object.__setattr__(self, "density", density)

    def _shown(self) -> Rows:
        return (
            ("wave number", self.wave_number, "rad/m"),
            ("density", self.density, self._unit.replace("**3", "³").replace("**4", "⁴")),
        )

    def __call__(self, wave_number: ArrayLike) -> Array:
        """Return C at any wave numbers (rad/m), in its own unit; zero beyond the points."""
        return density_at(self.wave_number, self.density, wave_number)

    def to_dataset(self) -> Dataset:
        """Return the density over wave numbers (rad/m)."""
        return dataset(
            "wave_number",
            {"density": (self.density, self._unit, self._name)},
            coordinates={"wave_number": (self.wave_number, "rad/m", "wave number")},
        )


@dataclass(frozen=True, eq=False)
class PowerSpectrum(Density):
    """Isotropic power spectrum C(q) of a rough surface: a power law between its points, nothing beyond them.

    The convention is Persson's: ⟨h²⟩ = ∫ d²q C(q) = 2π ∫ q C(q) dq, C in m⁴ [1]_.  Others put a factor 1/(2π)² before
    the integral; their density is 4π² times this one [2]_.

    Parameters
    ----------
    wave_number : (n,) array
        q = 2π/wavelength, rad/m, increasing.
    density : (n,) array
        C(q), m⁴, above zero.
    anisotropy : float
        Of a measured surface, how much its mean square slope depends on the direction: half the difference between the
        steepest direction and the one across, over their mean; 0 if isotropic, 1 for ridges.

    Raises
    ------
    InputError
        If these are not two rows of equal length, positive and finite, with increasing wave numbers, or the anisotropy
        is not between 0 and 1.

    References
    ----------
    .. [1] B. N. J. Persson, O. Albohr, U. Tartaglino, A. I. Volokitin, E. Tosatti, J. Phys.: Condens. Matter 17 (2005)
       R1, doi:10.1088/0953-8984/17/1/R01
    .. [2] T. D. B. Jacobs, T. Junge, L. Pastewka, Surf. Topogr.: Metrol. Prop. 5 (2017) 013001,
       doi:10.1088/2051-672X/aa51f8

    Examples
    --------
    >>> import viscofric as vf
    >>> road = vf.roughness.PowerSpectrum.self_affine(0.8, longest="3 mm", shortest="3 um", rms_height="0.3 mm")
    >>> round(road.rms_slope(), 2), round(road.rms_slope(shortest="30 um"), 2)
    (4.84, 2.9)
    """

    _unit: ClassVar[str] = "m**4"
    _name: ClassVar[str] = "power spectral density of the surface"
    anisotropy: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 0.0 <= number(self.anisotropy, "anisotropy") <= 1.0:
            raise wrong_argument("anisotropy", self.anisotropy, "must be a number from 0 to 1.", "out-of-range")

    def _shown(self) -> Rows:
        rms = ("rms height", self.rms_height(), "m"), ("rms slope", self.rms_slope())
        return *super()._shown(), *rms, ("anisotropy", self.anisotropy or None)

    @classmethod
    def self_affine(
        cls,
        hurst: float,
        *,
        longest: Quantity,
        shortest: Quantity,
        rolloff: Quantity | None = None,
        rms_height: Quantity | None = None,
        rms_slope: float | None = None,
    ) -> PowerSpectrum:
        """Return C ∝ q^(−2−2H), constant above the roll-off wavelength.

        Parameters
        ----------
        hurst : float
            Hurst exponent H, above 0, at most 1.
        longest, shortest : float, str or pint.Quantity
            Wavelengths between which there is roughness, m.
        rolloff : float, str or pint.Quantity, optional
            Wavelength above which the density is constant, m; the longest if left out.
        rms_height : float, str or pint.Quantity, optional
            m; either it or the slope is given.
        rms_slope : float, optional
            Of the gradient's length.

        Raises
        ------
        InputError
            If a value is out of range, or not just one of height and slope is given.
        """
        H, long, roll, short = self_affine_shape(hurst, longest, rolloff, shortest)
        lengths = [long, roll, short] if roll < long else [long, short]
        q = 2.0 * math.pi / np.array(lengths)
        shape = cls(q, np.maximum(q * roll / (2.0 * math.pi), 1.0) ** (-2.0 - 2.0 * H))
        return shape.scaled(rms_height=rms_height, rms_slope=rms_slope)

    @property
    def longest(self) -> float:
        """Longest wavelength, m."""
        return 2.0 * math.pi / float(self.wave_number[0])

    @property
    def shortest(self) -> float:
        """Shortest wavelength, m."""
        return 2.0 * math.pi / float(self.wave_number[-1])

    def moment(self, order: float) -> float:
        """Return ∫ d²q q^order C(q): ⟨h²⟩ for 0, ⟨|∇h|²⟩ for 2, ⟨(∇²h)²⟩ for 4.

        Parameters
        ----------
        order : float

        Returns
        -------
        float
            m^(2 − order).
        """
        power = to_si(order, "dimensionless", "order") + 1.0
        return 2.0 * math.pi * integral(self.wave_number, self.density, power)

    def limited(self, shortest: Quantity | None = None, longest: Quantity | None = None) -> PowerSpectrum:
        """Return the part between two wavelengths.

        Parameters
        ----------
        shortest, longest : float, str or pint.Quantity, optional
            m if plain numbers; no limit if left out.

        Raises
        ------
        InputError
            If nothing is left.
        """
        first = 0.0 if longest is None else 2.0 * math.pi / positive(longest, "m", "longest")
        last = math.inf if shortest is None else 2.0 * math.pi / positive(shortest, "m", "shortest")
        q, density = _cut_out(self.wave_number, self.density, first, last)
        return replace(self, wave_number=q, density=density)

    def rms_height(self, shortest: Quantity | None = None) -> float:
        """Return the rms height, m.

        Parameters
        ----------
        shortest : float, str or pint.Quantity, optional
            Shortest wavelength that is included, m if a plain number; all waves if left out.
        """
        return math.sqrt(self._until(shortest).moment(0.0))

    def rms_slope(self, shortest: Quantity | None = None) -> float:
        """Return the rms of the gradient's length.

        Parameters
        ----------
        shortest : float, str or pint.Quantity, optional
            Shortest wavelength that is included, m if a plain number; all waves if left out.
        """
        return math.sqrt(self._until(shortest).moment(2.0))

    def rms_curvature(self, shortest: Quantity | None = None) -> float:
        """Return the rms of the mean curvature ∇²h/2, 1/m.

        Parameters
        ----------
        shortest : float, str or pint.Quantity, optional
            Shortest wavelength that is included, m if a plain number; all waves if left out.
        """
        return 0.5 * math.sqrt(self._until(shortest).moment(4.0))

    def _until(self, shortest: Quantity | None) -> PowerSpectrum:
        return self if shortest is None else self.limited(shortest)

    def scaled(self, rms_height: Quantity | None = None, rms_slope: float | None = None) -> PowerSpectrum:
        """Return the same spectrum with heights scaled to an rms height or an rms slope.

        Parameters
        ----------
        rms_height : float, str or pint.Quantity, optional
            m if a plain number.
        rms_slope : float, optional
            In its place.

        Raises
        ------
        InputError
            If not just one of them is given, or it is not above zero.
        """
        wanted, order = wanted_rms(rms_height, rms_slope)
        return replace(self, density=self.density * (wanted**2 / self.moment(order)))


def self_affine_shape(
    hurst: float, longest: Quantity, rolloff: Quantity | None, shortest: Quantity
) -> tuple[float, float, float, float]:
    """Return Hurst exponent and wavelengths, m, from the longest on; `InputError` if one is out of range."""
    H = to_si(hurst, "dimensionless", "hurst")
    if not 0.0 < H <= 1.0:
        raise InputError(f"hurst = {H:g}: must lie above 0 and be 1 at most, such as 0.8.", code="out-of-range")
    long, short = positive(longest, "m", "longest"), positive(shortest, "m", "shortest")
    roll = long if rolloff is None else positive(rolloff, "m", "rolloff")
    if not short < roll <= long:
        raise InputError(
            f"shortest = {short:g} m, rolloff = {roll:g} m, longest = {long:g} m: must grow in this order.",
            code="wavelengths-out-of-order",
        )
    return H, long, roll, short


def wanted_rms(rms_height: Quantity | None, rms_slope: float | None) -> tuple[float, float]:
    """Return the requested rms and the order of its moment: 0 for heights (m), 2 for slopes."""
    exactly_one(rms_height=rms_height, rms_slope=rms_slope)
    if rms_height is not None:
        return positive(rms_height, "m", "rms_height"), 0.0
    return positive(rms_slope, "dimensionless", "rms_slope"), 2.0  # type: ignore[arg-type]


def _checked(q: ArrayLike, density: ArrayLike, unit: str) -> tuple[Array, Array]:
    """Return wave numbers and densities as read-only rows: positive, finite, increasing; two at least."""
    found = (
        np.atleast_1d(np.array(in_si(q, "1/m", "wave_number", infinite=True))),
        np.atleast_1d(np.array(in_si(density, unit, "density", infinite=True))),
    )
    if found[0].ndim != 1 or found[0].shape != found[1].shape or found[0].size < 2:
        raise InputError(
            f"a power spectrum must be two rows of equal length, two points at least, not {np.shape(q)} wave numbers "
            f"and {np.shape(density)} densities.",
            code="wrong-length",
        )
    for values, name in zip(found, ("wave numbers", "densities"), strict=True):
        if not np.all(np.isfinite(values) & (values > 0.0)):
            raise InputError(f"a power spectrum's {name} must be finite and above zero.", code="not-positive")
        values.flags.writeable = False
    if not np.all(np.diff(found[0]) > 0.0):
        raise InputError("a power spectrum's wave numbers must increase from point to point.", code="not-ascending")
    return found


def density_at(q: Array, density: Array, at: ArrayLike) -> Array:
    """Return the density at any wave numbers; zero outside the points (up to rounding)."""
    where = in_si(at, "1/m", "wave_number")
    inside = (where >= q[0] * (1.0 - 1e-12)) & (where <= q[-1] * (1.0 + 1e-12))
    logs = np.interp(np.log(np.where(inside, where, q[0])), np.log(q), np.log(density))
    return np.asarray(np.where(inside, np.exp(logs), 0.0))


def integral(q: Array, density: Array, power: float) -> float:
    """Return ∫ q^power C(q) dq from the first to the last point; InputError if it is too large for computations."""
    # C q^power dq = C q^(power+1) d ln q: an exponential in ln q within each segment.
    logs = np.log(density) + (power + 1.0) * np.log(q)
    width = np.diff(np.log(q))
    rise = np.diff(logs)
    # (e^r − 1)/r, which is one where nothing rises
    with np.errstate(over="ignore", invalid="ignore"):
        mean = np.where(np.abs(rise) < 1e-12, 1.0, np.expm1(rise) / np.where(rise == 0.0, 1.0, rise))
        found = float(np.sum(width * np.exp(logs[:-1]) * mean))
    if not found <= LARGEST:
        raise InputError(
            f"the moment of q^{power:g} is too large for computations; give a lower order.", code="too-large"
        )
    return found


def _cut_out(q: Array, density: Array, first: float, last: float) -> tuple[Array, Array]:
    """Return the points between two wave numbers, with new ones at these."""
    first, last = max(first, float(q[0])), min(last, float(q[-1]))
    if not first < last:
        raise InputError(
            f"the power spectrum reaches from wavelength {2.0 * np.pi / q[-1]:.4g} to {2.0 * np.pi / q[0]:.4g} m; "
            "no part of it lies between the cut-offs.",
            code="no-wave",
        )
    within = q[(q > first) & (q < last)]
    kept = np.concatenate([[first], within, [last]])
    return kept, density_at(q, density, kept)
