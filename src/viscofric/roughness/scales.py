"""Contribution of each wavelength to the friction of a solved contact."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.fft

from viscofric.arguments import MOST_PER_DECADE, insist_on, whole_number
from viscofric.arrays import Array
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.periodic.surface import hermitian_factor, wave_number, without_nyquist
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantities, to_si_array

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
