"""Made surfaces: self-affine ones, and those of a given power spectrum, from seeds."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
import scipy.fft

from viscofric.arguments import check_cost, flag, numbers, whole_number
from viscofric.arrays import Array, ComplexArray
from viscofric.contact.periodic.surface import hermitian_factor, wave_number
from viscofric.errors import InputError, wrong_argument
from viscofric.notes import Note
from viscofric.roughness.measured_spectrum import LineSpectrum
from viscofric.roughness.spectrum import PowerSpectrum, self_affine_shape, wanted_rms
from viscofric.roughness.topography import Topography
from viscofric.showing import prefixed
from viscofric.units import Quantity, positive, to_si, two_lengths

Density: TypeAlias = Callable[["Array"], "Array"]
#: A wave just at a cut-off is in, whatever the rounding.
_ROUNDING = 1e-9


def self_affine(
    hurst: float,
    *,
    shape: int | tuple[int, int],
    spacing: Quantity | tuple[Quantity, Quantity],
    seed: int,
    shortest: Quantity,
    longest: Quantity | None = None,
    rolloff: Quantity | None = None,
    rms_height: Quantity | None = None,
    rms_slope: float | None = None,
    aspect: float = 1.0,
    angle: Quantity = 0.0,
    exact: bool = True,
) -> Topography:
    """Make a periodic self-affine rough surface, C ∝ q^(−2−2H), or a profile, C ∝ q^(−1−2H).

    The same seed and period give the same waves on any grid that holds them, so that a finer grid resolves the same
    surface better, and a smaller `shortest` adds waves to it.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, above 0, at most 1.
    shape : int or (int, int)
        Points along x and y, or of a profile.
    spacing : float, str, pint.Quantity, or two of them
        Distance of neighbouring points, m.
    seed : int
        Not below zero; another one makes another surface of the same statistics.
    shortest : float, str or pint.Quantity
        Shortest wavelength, m; more than two points long.  A contact needs about eight points in it.
    longest : float, str or pint.Quantity, optional
        Longest wavelength, m; the longer period if left out.
    rolloff : float, str or pint.Quantity, optional
        Wavelength above which the density is constant, m; the longest if left out.
    rms_height : float, str or pint.Quantity, optional
        m; either it or the slope is given.
    rms_slope : float, optional
        Of the gradient's length.
    aspect : float
        How many times longer the correlation along the lay is than across it; 1 is isotropic.  Wavelengths along the
        lay are stretched by its root, those across compressed.
    angle : float, str or pint.Quantity
        Direction of the lay, from x towards y, rad.
    exact : bool
        Whether each surface has exactly the requested rms value (random phases), or only all of them in the
        mean, as pieces of an endless surface with Gaussian heights (random amplitudes too).

    Returns
    -------
    Topography

    Raises
    ------
    InputError
        If a value is out of range, not just one of height and slope is given, or the grid does not hold the waves.

    Examples
    --------
    >>> import viscofric as vf
    >>> road = vf.self_affine(0.8, shape=(256, 256), spacing="1 um", shortest="8 um", rms_slope=0.2, seed=1)
    >>> f"{road.rms_slope:.6f}"
    '0.200000'
    """
    flag(exact, "exact")
    points, steps = _grid(shape, spacing)
    wanted, order = wanted_rms(rms_height, rms_slope)
    period = max(n * d for n, d in zip(points, steps, strict=True) if n > 1)
    H, long, roll, short = self_affine_shape(hurst, period if longest is None else longest, rolloff, shortest)
    power = -1.0 - 2.0 * H if points[1] == 1 else -2.0 - 2.0 * H

    def density(q: Array) -> Array:
        turns = q / (2.0 * math.pi)
        inside = (turns * long >= 1.0 - _ROUNDING) & (turns * short <= 1.0 + _ROUNDING)
        return np.where(inside, np.maximum(turns * roll, 1.0) ** power, 0.0)

    waves = _Waves(points, steps, seed, aspect, angle)
    waves.hold(short)
    series = waves.series(density, exact)
    if (found := waves.expected(density, order)) == 0.0:
        raise InputError(
            f"longest = {long:g} m: no wave of the period lies between it and the shortest, {short:g} m.",
            code="no-wave",
        )
    heights = scipy.fft.irfft2(series * (wanted / math.sqrt(found)), points, norm="forward")
    waves_from, waves_to, rolls = (prefixed(one, None, "m") for one in (long, short, roll))
    rms = f"rms height {prefixed(wanted, None, 'm')}" if order == 0.0 else f"rms slope {wanted:.4g}"
    history = f"made: self-affine, Hurst exponent {H:g}, wavelengths {waves_from} to {waves_to}, "
    history += f"roll-off {rolls}, {rms}{'' if exact else ' in the mean'}, {waves.description}"
    made = {"hurst": H, "longest": long, "shortest": short, "rolloff": roll, "seed": seed, "exact": exact}
    return Topography(
        heights, steps, periodic=True, name=f"self-affine, seed {seed}", history=(Note("made", history, values=made),)
    )


def surface_from_spectrum(
    spectrum: PowerSpectrum | LineSpectrum | Density,
    *,
    shape: int | tuple[int, int],
    spacing: Quantity | tuple[Quantity, Quantity],
    seed: int,
    aspect: float = 1.0,
    angle: Quantity = 0.0,
    exact: bool = True,
) -> Topography:
    """Make a periodic rough surface with a given power spectrum, or a profile.

    Parameters
    ----------
    spectrum : PowerSpectrum, LineSpectrum or callable
        The first for a surface, the second for a profile.  A function takes wave numbers (an array, rad/m) and returns
        their density in the conventions of these two, m⁴ or m³.
    shape : int or (int, int)
        Points along x and y, or of a profile.
    spacing : float, str, pint.Quantity, or two of them
        Distance of neighbouring points, m.
    seed : int
        As for `self_affine`: the same waves on any grid of this period that holds them.
    aspect : float
        How many times longer the correlation along the lay is than across it.
    angle : float, str or pint.Quantity
        Direction of the lay, from x towards y, rad.
    exact : bool
        Whether the amplitude of each wave is just that of the spectrum, or only in the mean; see `self_affine`.

    Returns
    -------
    Topography
        Of all waves that the grid holds: those longer than the period or shorter than two points are missing.

    Raises
    ------
    InputError
        If a value is out of range, the spectrum is of the wrong kind, or has no wave that the grid holds.

    Examples
    --------
    >>> import viscofric as vf
    >>> spectrum = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1 mm", shortest="80 um", rms_slope=0.2)
    >>> made = vf.roughness.surface_from_spectrum(spectrum, shape=(128, 128), spacing="10 um", seed=1)
    >>> made.heights.shape
    (128, 128)
    """
    flag(exact, "exact")
    points, steps = _grid(shape, spacing)
    wanted = LineSpectrum if points[1] == 1 else PowerSpectrum
    other = PowerSpectrum if wanted is LineSpectrum else LineSpectrum
    if isinstance(spectrum, other) or not hasattr(spectrum, "__call__"):  # noqa: B004 - mypy knows callable() too well
        raise wrong_argument(
            "spectrum", spectrum, f"must be a {wanted.__name__} for this shape, or a function.", "wrong-type"
        )
    waves = _Waves(points, steps, seed, aspect, angle)
    if not waves.expected(spectrum, 0.0) > 0.0:
        raise InputError("the spectrum has no wave between the period and two points of the grid.", code="no-wave")
    heights = scipy.fft.irfft2(waves.series(spectrum, exact), points, norm="forward")
    history = f"made: from a power spectrum{'' if exact else ', amplitudes in the mean'}, {waves.description}"
    made = {"seed": seed, "exact": exact}
    return Topography(
        heights,
        steps,
        periodic=True,
        name=f"from a spectrum, seed {seed}",
        history=(Note("made", history, values=made),),
    )


def _grid(
    shape: int | tuple[int, int], spacing: Quantity | tuple[Quantity, Quantity]
) -> tuple[tuple[int, int], tuple[float, float]]:
    points: tuple[int, ...] = shape if isinstance(shape, (tuple, list)) else (shape, 1)
    right = "the points along x (four at least) and y, or of a profile"
    if len(points) != 2:
        raise wrong_argument("shape", shape, f"must be {right}.", "wrong-shape")
    points = tuple(whole_number(n, "shape", least, right=right) for n, least in zip(points, (4, 1), strict=True))
    check_cost(points, "shape: the surface")
    return (points[0], points[1]), two_lengths(spacing)


class _Waves:
    """The waves of a grid: their wave numbers as the lay sees them, and random phases that no grid changes."""

    def __init__(
        self, points: tuple[int, int], steps: tuple[float, float], seed: int, aspect: float, angle: Quantity
    ) -> None:
        self.points, self.steps, self.seed = points, steps, whole_number(seed, "seed", 0)
        self.stretch = math.sqrt(positive(aspect, "dimensionless", "aspect"))
        turn = to_si(angle, "rad", "angle")
        if points[1] == 1 and self.stretch != 1.0:
            raise InputError("aspect: a profile has no lay; leave it out.", code="line-scan")
        qx, qy = wave_number(points, steps)
        self.q = np.hypot(qx, qy)
        if self.stretch != 1.0:
            along = math.cos(turn) * qx + math.sin(turn) * qy
            across = math.cos(turn) * qy - math.sin(turn) * qx
            self.seen = np.hypot(self.stretch * along, across / self.stretch)
        else:
            self.seen = self.q
        lay = "" if self.stretch == 1.0 else f", aspect {self.stretch**2:.4g} along {math.degrees(turn):.4g}°"
        self.description = f"seed {seed}{lay}"
        area = math.prod(n * d for n, d in zip(points, steps, strict=True) if n > 1)
        self.cell = (2.0 * math.pi) ** (1 if points[1] == 1 else 2) / area

    def hold(self, shortest: float) -> None:
        """Refuse a shortest wavelength of two points or less."""
        most = max(self.stretch, 1.0 / self.stretch)
        step = max(d for n, d in zip(self.points, self.steps, strict=True) if n > 1)
        if shortest <= 2.0 * step * most * (1.0 + _ROUNDING):
            raise InputError(
                f"shortest = {shortest:g} m: must be longer than {2.0 * step * most:g} m, two points of the grid "
                f"{'as the lay stretches them ' if most > 1.0 else ''}(eight are good for a contact).",
                code="wave-too-short",
            )

    def variance(self, density: Density) -> Array:
        """Return the mean |ĥ|² of each wave; zero for the mean and for Nyquist waves, which have no direction."""
        found = np.zeros(self.q.shape)
        held = self.q > 0.0
        for axis, n in enumerate(self.points):
            if n % 2 == 0:
                held[(slice(None),) * axis + (n // 2,)] = False
        try:
            found[held] = self.cell * numbers(density(self.seen[held]), "the spectrum's density")
        except InputError:
            raise
        except ValueError:  # another number of values
            raise InputError(
                "the spectrum must return one density for each of the wave numbers it is given.", code="wrong-length"
            ) from None
        if not np.all(np.isfinite(found) & (found >= 0.0)):
            raise InputError(
                "the spectrum's density must be finite and not below zero at all wave numbers.", code="not-positive"
            )
        return found

    def expected(self, density: Density, order: float) -> float:
        """Return the mean of Σ q^order |ĥ|² over all waves."""
        weights = hermitian_factor(self.points[1])
        return float((self.variance(density) * self.q**order * weights).sum())

    def series(self, density: Density, exact: bool) -> ComplexArray:
        """Return Fourier coefficients with random phases, and random amplitudes if not exact."""
        amplitude = np.sqrt(self.variance(density))
        found = np.zeros(amplitude.shape, complex)
        nx = self.points[0]
        half = (nx - 1) // 2
        # A generator for each row, drawn from the longest wave on: a finer grid draws further, and more rows.
        order = np.zeros(2 * half + 1, dtype=int)
        order[1::2], order[2::2] = np.arange(1, half + 1), nx - np.arange(1, half + 1)
        for row in range((self.points[1] + 1) // 2):
            places = order if row else order[1::2]
            drawn = np.random.default_rng((self.seed, row)).random((len(places), 2))
            waves = amplitude[places, row] * np.exp(2j * math.pi * drawn[:, 0])
            if not exact:
                waves *= np.sqrt(-np.log1p(-drawn[:, 1]))
            found[places, row] = waves
            if row == 0:
                found[order[2::2], 0] = np.conj(waves)
        return found
