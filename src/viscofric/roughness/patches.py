"""What a solved rough contact consists of: patches, their stretch, pressures and gaps; its friction by wavelength."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.fft
from numpy.typing import ArrayLike

from viscofric.arguments import MOST_PER_DECADE, insist_on, whole_number
from viscofric.arrays import Array, Mask
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.periodic.surface import hermitian_factor, wave_number, without_nyquist
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, wrong_argument
from viscofric.showing import Plotted, Rows, Shown
from viscofric.units import Quantities, in_si, to_si_array

#: Of a distribution, where their number is given; edges may be as many as one likes.
MOST_CLASSES = 10**6
_BORDER = (math.pi - 1.0 + math.log(2.0)) / 24.0


@dataclass(frozen=True)
class ContactStatistics(Shown):
    """Numbers that describe a contact of rough surfaces.

    Attributes
    ----------
    area_fraction : float
        Points under pressure over all.
    corrected_area_fraction : float
        The same less (π − 1 + ln 2)/24 of the points times the borders along the edge of the contact, by which counting
        points takes too much [1]_; equal where everything is in contact.
    patches : int
        Contact patches, those that touch at corners counted as one, across the edges of the period too.
    chord_along, chord_across : float
        Mean length of the pieces that lines along the motion and across it have in contact, m; infinite if all is in
        contact.  For an oblique motion those along the axis of the grid that is nearer to it and the other one.
    stretch : float
        Their ratio: above one where patches are longer along the motion.
    pressure_in_contact : float
        Mean, Pa.
    pressure_deviation : float
        Standard deviation within the contact, Pa.
    gap_outside : float
        Mean gap where there is no contact, m; zero if all is in contact.
    gap_deviation : float
        Standard deviation of the gap over the whole surface, m.

    References
    ----------
    .. [1] V. A. Yastrebov, G. Anciaux, J.-F. Molinari, Tribol. Int. 114 (2017) 161, doi:10.1016/j.triboint.2017.04.023
    """

    area_fraction: float
    corrected_area_fraction: float
    patches: int
    chord_along: float
    chord_across: float
    stretch: float
    pressure_in_contact: float
    pressure_deviation: float
    gap_outside: float
    gap_deviation: float

    def _shown(self) -> Rows:
        return (
            ("contact area", self.corrected_area_fraction, "%"),
            ("points under pressure", self.area_fraction, "%"),
            ("patches", self.patches),
            ("chord along the motion", self.chord_along, "m"),
            ("chord across", self.chord_across, "m"),
            ("pressure in contact", self.pressure_in_contact, "Pa"),
            ("its standard deviation", self.pressure_deviation, "Pa"),
            ("gap outside", self.gap_outside, "m"),
        )

    def to_dataset(self) -> Dataset:
        """Return all numbers, each without a dimension."""
        meanings = {
            "area_fraction": ("1", "points under pressure over all"),
            "corrected_area_fraction": ("1", "real over nominal contact area"),
            "patches": ("1", "number of contact patches"),
            "chord_along": ("m", "mean length of contact along the motion"),
            "chord_across": ("m", "mean length of contact across the motion"),
            "stretch": ("1", "length of contact patches along over across the motion"),
            "pressure_in_contact": ("Pa", "mean pressure in contact"),
            "pressure_deviation": ("Pa", "standard deviation of the pressure in contact"),
            "gap_outside": ("m", "mean gap where there is no contact"),
            "gap_deviation": ("m", "standard deviation of the gap over the whole surface"),
        }
        return dataset((), {name: (getattr(self, name), *meaning) for name, meaning in meanings.items()})


def contact_statistics(solution: PeriodicSolution) -> ContactStatistics:
    """Describe the contact patches, pressures and gaps of a periodic contact.

    Parameters
    ----------
    solution : PeriodicSolution

    Returns
    -------
    ContactStatistics

    Raises
    ------
    InputError
        If it is something else.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    >>> solution = vf.solve_periodic(rubber, road.to_surface(), speed="0.1 m/s", pressure="5 kPa")
    >>> vf.roughness.contact_statistics(solution).patches
    3
    """
    insist_on(solution, "solution", PeriodicSolution, right="a PeriodicSolution from solve_periodic()")
    loaded = solution.pressure > 0.0
    borders = tuple(int(np.count_nonzero(loaded != np.roll(loaded, 1, axis))) for axis in (0, 1))
    steps = tuple(float(one[1] - one[0]) if len(one) > 1 else 0.0 for one in (solution.x, solution.y))
    count = int(np.count_nonzero(loaded))
    # Every piece of a line has two ends.
    chords = [step * 2.0 * count / ends if ends else math.inf for step, ends in zip(steps, borders, strict=True)]
    if abs(solution.direction[1]) > abs(solution.direction[0]):
        chords.reverse()
    along, across = chords
    within, outside = solution.pressure[loaded], solution.gap[~loaded]
    return ContactStatistics(
        area_fraction=count / loaded.size,
        corrected_area_fraction=(count - _BORDER * sum(borders)) / loaded.size,
        patches=_patches(loaded),
        chord_along=along,
        chord_across=across,
        stretch=along / across if math.isfinite(along) and math.isfinite(across) else 1.0,
        pressure_in_contact=float(within.mean()),
        pressure_deviation=float(within.std()),
        gap_outside=float(outside.mean()) if outside.size else 0.0,
        gap_deviation=float(solution.gap.std()),
    )


def pressure_distribution(solution: PeriodicSolution, edges: ArrayLike | int = 50) -> tuple[Array, Array]:
    """Return how the pressure is distributed over the contact.

    Parameters
    ----------
    solution : PeriodicSolution
    edges : int or (n + 1,) array
        Number of classes of equal width from zero to the highest pressure, or their edges, Pa.

    Returns
    -------
    pressure : (n,) array
        Middles of the classes, Pa.
    density : (n,) array
        Share of the whole surface per pressure, 1/Pa: its integral is the contact area fraction.

    Raises
    ------
    InputError
        If it is no solution of a periodic contact, or the edges are no numbers that increase.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    >>> solution = vf.solve_periodic(rubber, road.to_surface(), speed="0.1 m/s", pressure="5 kPa")
    >>> pressure, density = vf.roughness.pressure_distribution(solution, 20)
    >>> pressure.shape, density.shape
    ((20,), (20,))
    """
    insist_on(solution, "solution", PeriodicSolution, right="a PeriodicSolution from solve_periodic()")
    loaded = solution.pressure[solution.pressure > 0.0]
    if isinstance(edges, int):
        whole_number(edges, "edges", 1, MOST_CLASSES, "a number of classes above zero, or their edges")
        limits = np.linspace(0.0, solution.max_pressure, edges + 1)
    else:
        limits = in_si(edges, "Pa", "edges", infinite=True)
        if limits.ndim != 1 or len(limits) < 2 or not np.all(np.diff(limits) > 0.0):
            raise wrong_argument("edges", edges, "must be two pressures at least, Pa, that increase.", "not-ascending")
    counts, found = np.histogram(loaded, limits)
    return 0.5 * (found[1:] + found[:-1]), counts / (solution.pressure.size * np.diff(found))


def _patches(loaded: Mask) -> int:
    """Count patches that touch at sides or corners, on a surface that repeats itself."""
    from scipy.ndimage import label
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    labels, count = label(loaded, np.ones((3, 3)))
    joined = []
    for axis in (0, 1):
        first, last = np.take(labels, 0, axis), np.take(labels, -1, axis)
        for shift in (-1, 0, 1):
            pairs = np.stack([last, np.roll(first, shift)])
            joined.append(pairs[:, np.all(pairs > 0, axis=0)] - 1)
    one, other = np.concatenate(joined, axis=1)
    graph = coo_array((np.ones(len(one)), (one, other)), shape=(count, count))
    return int(connected_components(graph, directed=False)[0])


#: A wave just at an edge belongs to the longer ones, whatever the rounding.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class FrictionByWavelength(Plotted):
    """Friction coefficient of a contact, by wavelengths of the pressure.

    Attributes
    ----------
    edges : (n + 1,) array
        Wavelengths, from long to short, m.
    contribution : (n,) array
        What the waves between two edges add to the friction coefficient.
    """

    edges: Array
    contribution: Array

    def _shown(self) -> Rows:
        return (
            ("friction coefficient", self.friction_coefficient),
            ("wavelengths", self.edges, "m"),
            ("contributions", self.contribution),
        )

    @property
    def friction_coefficient(self) -> float:
        """Sum of the contributions: that of the contact, if the edges hold all waves."""
        return float(self.cumulative[-1])

    @property
    def cumulative(self) -> Array:
        """Friction coefficient of all waves down to each edge, (n + 1,) array that begins at zero."""
        return np.concatenate([[0.0], np.cumsum(self.contribution)])

    def to_dataset(self) -> Dataset:
        """Return the contributions along ``band``, each with its longest and shortest wavelength."""
        return dataset(
            "band",
            {"contribution": (self.contribution, "1", "friction coefficient of the waves between two wavelengths")},
            coordinates={
                "longest": (self.edges[:-1], "m", "longest wavelength"),
                "shortest": (self.edges[1:], "m", "shortest wavelength"),
            },
        )


def friction_by_wavelength(
    solution: PeriodicSolution, edges: Quantities | None = None, *, per_decade: int = 6
) -> FrictionByWavelength:
    """Return the contributions of wavelengths to the friction coefficient of a periodic contact.

    Parameters
    ----------
    solution : PeriodicSolution
    edges : list of float, str or pint.Quantity, optional
        Wavelengths between which to sum, m, in any order; a wave at an edge is summed with the longer ones.  If left
        out, from the longest to the shortest wave of the grid.
    per_decade : int
        Edges for each decade, where they are left out.

    Returns
    -------
    FrictionByWavelength

    Raises
    ------
    InputError
        If there are fewer than two edges, or they are not lengths above zero.

    Notes
    -----
    The solid dissipates (q·n) Im(û_q p̂_q*) for each wave and unit of length that the surface has gone, n the direction
    of the motion, û = 2(1−ν²) S(−q·v) p̂/|q|.  Waves do not exchange energy, so that their sum is the friction force
    per area, to rounding.  The waves are those of the pressure: where contact is partial, its edges have waves shorter
    than all those of the surface.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> road = vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=1)
    >>> solution = vf.solve_periodic(rubber, road.to_surface(), speed="0.1 m/s", pressure="5 kPa")
    >>> parts = vf.roughness.friction_by_wavelength(solution)
    >>> bool(abs(parts.cumulative[-1] / parts.friction_coefficient - 1.0) < 1e-9)
    True
    """
    insist_on(solution, "solution", PeriodicSolution, right="a PeriodicSolution from solve_periodic()")
    whole_number(per_decade, "per_decade", 1, MOST_PER_DECADE)
    shape = solution.pressure.shape[0], solution.pressure.shape[1]
    spacing = tuple(float(one[1] - one[0]) if len(one) > 1 else 1.0 for one in (solution.x, solution.y))
    qx, qy = wave_number(shape, (spacing[0], spacing[1]))
    along = solution.direction[0] * without_nyquist(qx, shape[0]) + solution.direction[1] * without_nyquist(
        qy, shape[1]
    )
    pressure = scipy.fft.rfft2(solution.pressure)
    displacement = scipy.fft.rfft2(solution.displacement)
    work = along * (displacement * np.conj(pressure)).imag * hermitian_factor(shape[1])
    work /= float(shape[0] * shape[1]) ** 2 * solution.mean_pressure
    q = np.hypot(qx, qy)
    q[0, 0] = np.inf
    limits = _limits(edges, q, per_decade)
    q[0, 0] = 0.0
    # Edges from long to short wavelengths are wave numbers that grow.
    place = np.searchsorted(2.0 * math.pi / limits * (1.0 + _ROUNDING), q.ravel(), side="left") - 1
    # The longest edge itself belongs to the waves below it.
    place[(place == -1) & (q.ravel() >= 2.0 * math.pi / limits[0] * (1.0 - _ROUNDING))] = 0
    inside = (place >= 0) & (place < len(limits) - 1)
    found = np.bincount(place[inside], work.ravel()[inside], minlength=len(limits) - 1)
    return FrictionByWavelength(limits, found.astype(np.float64))


def _limits(edges: Quantities | None, q: Array, per_decade: int) -> Array:
    if edges is not None:
        given = np.sort(to_si_array(edges, "m", "edges"))[::-1]
        if len(given) < 2 or given[-1] <= 0.0 or np.any(np.diff(given) == 0.0):
            raise InputError("edges: must be two wavelengths at least, different and above zero.", code="not-positive")
        return given
    first, last = float(q.min()), float(q[np.isfinite(q)].max())
    count = max(1, math.ceil(per_decade * math.log10(last / first) - _ROUNDING))
    return np.asarray(2.0 * math.pi / (first * 10.0 ** (np.arange(count + 1) / per_decade)), dtype=np.float64)
