"""Power spectra of given surfaces: of their Fourier series, or of windowed scans."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
import scipy.fft

from viscofric.arguments import MOST_PER_DECADE, insist_on, whole_number
from viscofric.arrays import Array, gauss, non_negative_fit
from viscofric.contact.periodic.surface import hermitian_factor, wave_number
from viscofric.errors import InputError, check_choice, wrong_argument
from viscofric.roughness.spectrum import NODES, Density, PowerSpectrum, integral
from viscofric.roughness.topography import Topography
from viscofric.showing import Rows
from viscofric.units import to_si

#: Weight of the second differences of the surface's density, which matter only where the lines leave it open.
_SMOOTHNESS = 0.03
#: Fits, each relative to the one before: relative to lines that scatter, densities would be too low.
_FITS = 5
#: Least density, as a share of the median of those above zero.
_FLOOR = 1e-2
# Parts of a decade in which the end of a surface's waves is sought.
_FINE = 100
# Mean square, relative to that of the heights as given, of what rounding leaves of an exact plane or level; it is up to
# 0.8 ε squared for 1024 x 1024 points.
_ROUNDING = (4.0 * np.finfo(np.float64).eps) ** 2


@dataclass(frozen=True, eq=False)
class LineSpectrum(Density):
    """Power spectrum of line scans: a power law between its points, nothing beyond; ⟨h²⟩ = 2 ∫₀ C(q) dq, C in m³.

    Parameters
    ----------
    wave_number : (n,) array
        q = 2π/wavelength, rad/m, increasing.
    density : (n,) array
        C(q), m³, above zero.

    Raises
    ------
    InputError
        If these are not two rows of equal length, positive and finite, with increasing wave numbers.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> q = np.geomspace(1e3, 1e5, 200)
    >>> line = vf.roughness.LineSpectrum(q, 1e-10 * q**-1.6)
    >>> f"{line.moment(0) ** 0.5:.1e} m rms"
    '2.2e-06 m rms'
    """

    _unit: ClassVar[str] = "m**3"
    _name: ClassVar[str] = "power spectral density of lines"

    def _shown(self) -> Rows:
        return *super()._shown(), ("rms height", self.rms_height(), "m"), ("rms slope", self.rms_slope())

    def moment(self, order: float) -> float:
        """Return 2 ∫ q^order C(q) dq: ⟨h²⟩ for 0, ⟨(dh/dx)²⟩ for 2, ⟨(d²h/dx²)²⟩ for 4."""
        return 2.0 * integral(self.wave_number, self.density, to_si(order, "dimensionless", "order"))

    def rms_height(self) -> float:
        """Return the rms height, m."""
        return math.sqrt(self.moment(0.0))

    def rms_slope(self) -> float:
        """Return the rms slope along the line."""
        return math.sqrt(self.moment(2.0))

    def isotropic(self) -> PowerSpectrum:
        """Return the power spectrum of the surface, if it is isotropic, that such lines run across.

        Returns
        -------
        PowerSpectrum
            C of C₁(q) = ∫ dp C(√(q² + p²)), by non-negative least squares, with √2 times the rms slope of the lines.

        Notes
        -----
        A line crosses waves obliquely, so that long wavelengths of a line are in part short waves of the surface.  What
        waves there are beyond the shortest of the lines is not known and taken to be none.
        """
        return PowerSpectrum(self.wave_number, _isotropic_density(self.wave_number, self))


def _isotropic_density(q: Array, line: Callable[[Array], Array]) -> Array:
    """Solve C₁(q) = ∫ dp C(√(q² + p²)) for the density C of a surface at the points of that of its lines, C₁."""
    # C is sought as C₁(k)/k times a factor that is linear in ln k between the points, not below zero, by least squares
    # of the relative misfit. For C ∝ k^(−s) the factor is constant, Γ(s/2)/(√π Γ((s−1)/2)).
    logs, count = np.log(q), len(q)
    rows = np.zeros((count - 1, count))
    for row in range(count - 1):
        # Ends of the segments of ln k, as distances p along the other axis, in which the integrand is smooth.
        ends = np.sqrt(np.maximum(np.square(q[row:]) - q[row] ** 2, 0.0))
        p, weight = (one.reshape(-1, NODES) for one in gauss(NODES, ends))
        k = np.sqrt(q[row] ** 2 + np.square(p))
        values = 2.0 * weight * line(k) / k
        segment = row + np.arange(len(p))[:, None]
        part = (np.log(k) - logs[segment]) / (logs[segment + 1] - logs[segment])
        np.add.at(rows[row], segment + np.zeros(k.shape, int), (1.0 - part) * values)
        np.add.at(rows[row], segment + 1 + np.zeros(k.shape, int), part * values)
    bends = _SMOOTHNESS * np.diff(np.eye(count), 2, axis=0)
    wanted = expected = line(q[:-1])
    for _ in range(_FITS):
        right = np.concatenate([wanted / expected, np.zeros(len(bends))])
        factor = non_negative_fit(np.concatenate([rows / expected[:, None], bends]), right)
        expected = np.maximum(rows @ factor, _FLOOR * wanted)
    density = np.maximum(factor, _FLOOR * float(np.median(factor[factor > 0.0]))) * line(q) / q
    # The mean square slope of the lines is half that of the surface; that of the fit is lower still where they scatter.
    return np.asarray(density * (2.0 / math.pi * integral(q, line(q), 2.0) / integral(q, density, 3.0)))


def power_spectrum(topography: Topography, *, per_decade: int = 12) -> PowerSpectrum:
    """Return the power spectrum of a surface, averaged over all directions.

    Parameters
    ----------
    topography : Topography
        A map without missing points.  One that is not periodic is freed of its tilt, and multiplied by Hann's window
        (of unit mean square).
    per_decade : int
        Points of the spectrum for each decade of wave number.

    Returns
    -------
    PowerSpectrum
        Up to the wave number that the grid holds in all directions, if the surface has such waves.

    Raises
    ------
    InputError
        If it is a line scan, flat or tilted only, has too few points, or heights are missing.

    Notes
    -----
    C at a point is the mean of |ĥ_q|² A/4π² over the waves of a ring of wave numbers, the point where a power law has
    this mean.  By Parseval's theorem their sum over all waves is the mean square height; the curve through the points
    integrates to it within some per cent, most of which lies between the few longest waves.  It ends where the waves
    end.  On twelve points a decade it gives the slope, and friction by Persson's theory, within 1 % of those on forty;
    on two within 5 %, and heights within a fifth, since these do not show where the density bends.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    >>> spectrum = vf.roughness.power_spectrum(road)
    >>> bool(abs(spectrum.rms_height() / road.rms_height - 1.0) < 0.1)
    True
    """
    insist_on(topography, "topography", Topography, right="a Topography; see read_topography")
    if topography.is_line:
        raise InputError("power_spectrum needs a map of heights; line_spectrum takes line scans.", code="line-scan")
    shape = topography.shape
    waves = scipy.fft.rfft2(_windowed(topography, (0, 1))) / (shape[0] * shape[1])
    qx, qy = wave_number(shape, topography.spacing)
    q = np.hypot(qx, qy)
    counts = np.broadcast_to(hermitian_factor(shape[1]), q.shape)
    area = topography.size[0] * topography.size[1]
    density = np.square(np.abs(waves)) * (area / (4.0 * np.pi**2))
    # All waves but the mean, which leaves a disc of the area of one wave's cell.
    limits = 2.0 * np.sqrt(np.pi / area), 2.0 * np.pi / max(topography.size), np.pi / max(topography.spacing)
    rings = _rings(q.ravel(), density.ravel(), counts.ravel(), limits, per_decade)
    # Mean square slopes, of which (qx + i qy)² is what turns twice as the direction turns once.
    weight = counts * density * (q <= limits[-1])
    anisotropy = abs(complex((weight * np.square(qx + 1j * qy)).sum())) / float((weight * np.square(q)).sum())
    return PowerSpectrum(*rings, min(anisotropy, 1.0))


def line_spectrum(topography: Topography, *, axis: Literal["x", "y"] = "x", per_decade: int = 12) -> LineSpectrum:
    """Return the power spectrum of a line scan, or of all lines of a surface along one axis.

    Parameters
    ----------
    topography : Topography
        Without missing points.  Lines that are not periodic are freed of their tilt, and multiplied by Hann's window.
    axis : {"x", "y"}
        Along which the lines run.
    per_decade : int
        Points of the spectrum for each decade of wave number.

    Returns
    -------
    LineSpectrum

    Raises
    ------
    InputError
        If heights are missing, all lines are flat or tilted only, or there are fewer than four points along the axis.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    >>> line = vf.roughness.line_spectrum(road)
    >>> bool(0.5 < (line.moment(0) ** 0.5 / road.rms_height) < 1.5)
    True
    """
    insist_on(topography, "topography", Topography, right="a Topography; see read_topography")
    check_choice(axis, "axis", "x", "y")
    place = "xy".index(axis)
    points, step = topography.shape[place], topography.spacing[place]
    if points < 4:
        raise wrong_argument(
            "axis", axis, f"a spectrum needs four points at least; there are {points} along it.", "too-few-points"
        )
    heights: Array = np.moveaxis(_windowed(topography, (place,)), place, 0)
    waves = np.square(np.abs(scipy.fft.rfft(heights, axis=0) / points)).mean(axis=1)
    q: Array = 2.0 * np.pi * np.fft.rfftfreq(points, step).astype(np.float64)
    density = waves * (points * step / (2.0 * np.pi))
    limits = 0.5 * float(q[1]), float(q[1]), np.pi / step
    return LineSpectrum(*_rings(q, density, np.ones(len(q)), limits, per_decade))


def _windowed(topography: Topography, axes: tuple[int, ...]) -> Array:
    """Return heights less their mean; if not periodic, less their tilt and under Hann's window of unit mean square."""
    # A surface that is flat but for rounding is refused.
    heights = topography.complete()
    rounding = _ROUNDING * float(np.square(heights).mean())
    heights = np.asarray(heights - heights.mean(axis=axes, keepdims=True), dtype=np.float64)
    if not topography.periodic:
        for axis in axes:
            # Each on its own: least squares of a plane on a full grid.
            place = np.linspace(-1.0, 1.0, heights.shape[axis]).reshape((-1, 1) if axis == 0 else -1)
            heights = heights - place * (heights * place).mean(axis=axes, keepdims=True) / np.square(place).mean()
    if not float(np.square(heights - heights.mean(axis=axes, keepdims=True)).mean()) > rounding:
        raise InputError("the surface is flat: its power spectrum is zero.", code="flat")
    if topography.periodic:
        return heights
    for axis in axes:
        points = heights.shape[axis]
        window = np.sqrt(8.0 / 3.0) * (0.5 - 0.5 * np.cos(2.0 * np.pi * (np.arange(points) + 0.5) / points))
        heights = heights * (window[:, None] if axis == 0 else window)
    return np.asarray(heights - heights.mean(axis=axes, keepdims=True), dtype=np.float64)


def _rings(
    q: Array, density: Array, counts: Array, limits: tuple[float, float, float], per_decade: int
) -> tuple[Array, Array]:
    """Return mean wave numbers and densities of rings of wave numbers, from limits[1] on, and points at both ends."""
    # The waves in the first ring stand for all wave numbers from limits[0] on: the cells of a grid of waves fill the
    # plane. Cells of longer waves that the surface is without stay empty.
    whole_number(per_decade, "per_decade", 1, MOST_PER_DECADE)
    start, first, last = limits
    # Rounding in what a surface was made without is no roughness.
    loud = (q >= first * (1.0 - 1e-9)) & (q <= last * (1.0 + 1e-9)) & (density > 1e-24 * density.max(initial=0.0))
    if not loud.any():
        raise InputError(
            "the surface has no waves of the lengths that its grid holds in all directions; a power spectrum needs "
            "several: give more points.",
            code="too-few-points",
        )
    place = np.floor(_FINE * np.log10(q[loud] / first) + 1e-6).astype(int)
    # What a window spreads beyond the shortest waves of a surface has no curvature, and is no roughness.
    curvature = np.bincount(place, (counts * density * q**4)[loud])
    last = first * 10.0 ** ((np.flatnonzero(np.cumsum(curvature[::-1])[::-1] > 1e-6 * curvature.sum())[-1] + 1) / _FINE)
    # Waves of directions in which an anisotropic surface has none are a part of the mean.
    seen = q[loud & (q <= last)]
    within = (q >= seen.min()) & (q <= seen.max())
    q, density, counts = q[within], density[within], counts[within]
    start = max(start, float(q.min()) - 0.5 * first)
    ring = np.floor(per_decade * np.log10(q / first) + 1e-6).astype(int)
    # Rings without waves of the surface are a part of the one before.
    ring = (np.cumsum(np.bincount(ring, loud[within]) > 0.0) - 1)[ring]
    mean_density = np.bincount(ring, counts * density) / np.bincount(ring, counts)
    # Where a power law has its mean over a ring, up to the fourth power of the ring's width, for any exponent.
    share = counts * np.sqrt(density)
    mean_q = np.exp(np.bincount(ring, share * np.log(q)) / np.bincount(ring, share))
    if len(mean_q) < 2:
        raise InputError(
            "the surface has waves of one length only; a power spectrum needs several.", code="too-few-points"
        )
    # Wide rings have longer waves than the first point, and shorter ones than the last.
    for place, wave in ((0, float(q.min())), (-1, float(q.max()))):
        if abs(wave / mean_q[place] - 1.0) > 1e-6:
            fall = np.diff(np.log(mean_density))[place] / np.diff(np.log(mean_q))[place]
            level = mean_density[place] * (wave / mean_q[place]) ** min(fall, 0.0)
            at = 0 if place == 0 else len(mean_q)
            mean_q, mean_density = np.insert(mean_q, at, wave), np.insert(mean_density, at, level)
    if start < mean_q[0] * (1.0 - 1e-6):
        mean_q, mean_density = np.append(start, mean_q), np.append(mean_density[0], mean_density)
    return mean_q, mean_density
