"""Persson's theory of rubber on rough surfaces: real contact area and friction from a power spectrum and E(ω, T).

The rubber is followed from the longest wave of the surface to ever shorter ones.  Under a nominal pressure σ0 the share
of the surface that is in contact, as far as it shows when nothing shorter than 2π/q is seen, is [1]_ ::

    P(q) = erf(1/(2 √G)),    G(q) = 1/8 ∫_{q0}^{q} dq q³ C(q) ∫_0^{2π} dφ |E(q v cos φ, T_q) / ((1−ν²) σ0)|²

and the friction coefficient of all that the rubber dissipates ::

    μ = 1/2 ∫_{q0}^{q1} dq q³ C(q) S(q) P(q) ∫_0^{2π} dφ cos φ Im E(q v cos φ, T_q) / ((1−ν²) σ0)

with S = 1 in [1]_.  Where contact is partial the rubber follows a wave only in part, for which later work takes
S = γ + (1−γ) P², γ ≈ 1/2 [2]_.  In full contact (P = S = 1) the integral is exact.  At small loads P is
√(8/π) σ0 (1−ν²)/(E h'), h' the rms slope, for an elastic solid.

References
----------
.. [1] B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840, doi:10.1063/1.1388626
.. [2] B. Lorenz, Y. R. Oh, S. K. Nam, S. H. Jeon, B. N. J. Persson, J. Chem. Phys. 142 (2015) 194701
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
from scipy.special import erf

from viscofric.errors import ConvergenceError, InputError, brief
from viscofric.rheology.material import Material, insist_on_material
from viscofric.roughness.flash import Flash
from viscofric.roughness.spectrum import PowerSpectrum
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantities, Quantity, positive, share, to_si, to_si_array

if TYPE_CHECKING:
    import xarray
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

#: Refinements after which the integrals count as not converged; the first grid has 8 intervals per decade.
_MOST_REFINEMENTS = 7
_FIRST = math.log(10.0) / 8.0
_DIRECTIONS = 12
#: Length of the first interval of ln q, and how much longer the next ones are, over the longest.
_START, _GROWTH = 1e-6, 2.0
_CLOSEST, _LOOSEST = 1e-8, 0.1


@dataclass(frozen=True, eq=False)
class PerssonTheory:
    """What Persson's theory says of a rubber that slides on a rough surface.

    Attributes
    ----------
    temperature : (m,) array
        Of the rubber before it meets the surface, K; NaN for a material without a shift, which has no temperature.
    speed : (n,) array
        m/s.
    pressure : float
        Nominal, Pa.
    friction_coefficient : (m, n) array
        For every temperature and speed.
    contact_area_fraction : (m, n) array
        Real contact area over nominal, all waves seen.
    flash_temperature : (m, n) array
        Largest rise of temperature over all scales, K; zero where none was asked for.
    wave_number : (k,) array
        q of the scales below, rad/m.
    area_by_scale : (m, n, k) array
        P(q): the contact area as it shows when nothing shorter than 2π/q is seen.
    friction_by_scale : (m, n, k) array
        Friction coefficient of all waves up to q.
    temperature_rise_by_scale : (m, n, k) array
        T_q less `temperature`, K.
    error : float
        Largest estimated error of the integrals: of the area, and of the friction coefficient relative to its largest.
    """

    temperature: Array
    speed: Array
    pressure: float
    friction_coefficient: Array
    contact_area_fraction: Array
    flash_temperature: Array
    wave_number: Array
    area_by_scale: Array
    friction_by_scale: Array
    temperature_rise_by_scale: Array
    error: float

    def to_dataset(self) -> xarray.Dataset:
        """Return everything as labelled data with units in its attributes."""
        import xarray

        told = {
            "friction_coefficient": ("1", "friction coefficient"),
            "contact_area_fraction": ("1", "real over nominal contact area"),
            "flash_temperature": ("K", "largest rise of temperature"),
            "area_by_scale": ("1", "contact area over nominal as seen without shorter waves"),
            "friction_by_scale": ("1", "friction coefficient of all longer waves"),
            "temperature_rise_by_scale": ("K", "rise of temperature that waves of this length meet"),
        }
        axes = ("temperature", "speed", "wave_number")
        fields = {name: (getattr(self, name), unit, text) for name, (unit, text) in told.items()}
        return xarray.Dataset(
            {
                name: (axes[: values.ndim], values, {"units": unit, "long_name": text})
                for name, (values, unit, text) in fields.items()
            },
            coords={
                "temperature": ("temperature", self.temperature, {"units": "K"}),
                "speed": ("speed", self.speed, {"units": "m/s"}),
                "wave_number": ("wave_number", self.wave_number, {"units": "rad/m"}),
            },
            attrs={"pressure": self.pressure, "error": self.error},
        )


class _Case(NamedTuple):
    """Temperature (K, or None) and speed (m/s) of one contact."""

    kelvin: float | None
    speed: float


def persson_theory(
    material: Material,
    spectrum: PowerSpectrum,
    *,
    speeds: Quantities,
    pressure: Quantity,
    temperatures: Quantities | None = None,
    gamma: float = 0.5,
    thermal: ThermalProperties | None = None,
    macroasperity_area: float = 0.3,
    accuracy: float = 1e-4,
) -> PerssonTheory:
    """Predict area and friction by Persson's theory, in milliseconds for each speed.

    Parameters
    ----------
    material : Material
    spectrum : PowerSpectrum
        Of the surface, between the cut-offs that count.
    speeds : float, str, pint.Quantity, or an array or list of them
        Of sliding, not below zero, m/s; at rest E0 counts.
    pressure : float, str or pint.Quantity
        Nominal pressure σ0, Pa.
    temperatures : float, str, pint.Quantity, or an array or list of them, optional
        K if plain numbers; may be left out for a material without a shift.
    gamma : float
        γ of S = γ + (1−γ) P²: how much of the dissipation of full contact there is in the contact spots of a partial
        one; 1 gives the theory of 2001.
    thermal : ThermalProperties, optional
        Those of the rubber, with which flash temperatures count (`viscofric.roughness.flash`); isothermal without.
    macroasperity_area : float
        Contact area fraction that shows at the scale of the macroasperities, at which hot spots begin; between 0 and 1.
    accuracy : float
        Of the integrals; see `PerssonTheory.error`.

    Returns
    -------
    PerssonTheory

    Raises
    ------
    InputError
        If a value cannot be used.
    ConvergenceError
        If the integrals do not reach the accuracy, or no flash temperature is found that reproduces itself.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="100 MPa", tau="1 ms")
    >>> road = vf.PowerSpectrum.self_affine(0.8, longest="1 mm", shortest="10 um", rms_slope=0.5)
    >>> theory = vf.persson_theory(rubber, road, speeds=[0.001, 0.1], pressure="0.1 MPa")
    >>> theory.friction_coefficient.shape
    (1, 2)
    """
    insist_on_material(material)
    if not isinstance(spectrum, PowerSpectrum):
        raise InputError(f"spectrum = {brief(spectrum)}: must be a PowerSpectrum; see power_spectrum(topography).")
    velocities = to_si_array(speeds, "m/s", "speeds")
    if not velocities.size or not np.all(velocities >= 0.0):
        raise InputError("speeds must hold at least one value, none of them below zero.")
    kelvins: list[float | None] = [None]
    if temperatures is not None:
        kelvins = [positive(float(one), "K", "temperatures") for one in to_si_array(temperatures, "K", "temperatures")]
    sharing = to_si(gamma, "dimensionless", "gamma")
    if not 0.0 <= sharing <= 1.0:
        raise InputError(f"gamma = {sharing:g}: must lie between 0 and 1.")
    wanted = to_si(accuracy, "dimensionless", "accuracy")
    if not _CLOSEST <= wanted <= _LOOSEST:
        raise InputError(f"accuracy = {wanted:g}: must lie between {_CLOSEST:g} and {_LOOSEST:g}.")
    flash = None
    if thermal is not None:
        if not isinstance(thermal, ThermalProperties):
            raise InputError(f"thermal = {brief(thermal)}: must be ThermalProperties of the rubber.")
        if material.shift is None or temperatures is None:
            raise InputError("thermal: a flash temperature needs a material with a shift, and temperatures.")
        flash = Flash(thermal, share(macroasperity_area, "macroasperity_area", example=0.3))
    solver = _Theory(material, spectrum, positive(pressure, "Pa", "pressure"), sharing, flash)
    cases = [_Case(kelvin, float(speed)) for kelvin in kelvins for speed in velocities]
    found, error = solver.converged(cases, wanted)
    shape = len(kelvins), len(velocities)

    def by_case(rows: list[Array]) -> Array:
        return np.array(rows).reshape(*shape, -1)

    area, friction, rise = (by_case([getattr(one, name) for one in found.cases]) for name in _Scales._fields)
    return PerssonTheory(
        temperature=np.array([math.nan if kelvin is None else kelvin for kelvin in kelvins]),
        speed=velocities,
        pressure=solver.pressure,
        friction_coefficient=friction[..., -1],
        contact_area_fraction=area[..., -1],
        flash_temperature=rise.max(axis=-1),
        wave_number=found.q,
        area_by_scale=area,
        friction_by_scale=friction,
        temperature_rise_by_scale=rise,
        error=error,
    )


class _Scales(NamedTuple):
    """P(q), the friction of all waves up to q, and the rise of temperature, K, at each scale."""

    area: Array
    friction: Array
    rise: Array


class _Found(NamedTuple):
    """All cases on one grid of wave numbers."""

    q: Array
    cases: list[_Scales]


class _Theory:
    """The integrals on grids of wave numbers that are refined until they do not change."""

    def __init__(
        self, material: Material, spectrum: PowerSpectrum, pressure: float, gamma: float, flash: Flash | None
    ) -> None:
        self.material, self.spectrum, self.pressure, self.gamma, self.flash = material, spectrum, pressure, gamma, flash
        self.plane_strain = 1.0 - material.poisson_ratio**2

    def converged(self, cases: list[_Case], accuracy: float) -> tuple[_Found, float]:
        """Return all cases on a grid fine enough, and the estimated error."""
        coarse = self._on_grid(cases, _FIRST, _DIRECTIONS)
        error = math.inf
        for halvings in range(1, _MOST_REFINEMENTS + 1):
            fine = self._on_grid(cases, _FIRST / 2**halvings, _DIRECTIONS * (1 + halvings))
            largest = max(float(np.abs(one.friction).max()) for one in fine.cases)
            error = max(
                max(
                    abs(float(one.area[-1] - two.area[-1])),
                    abs(float(one.friction[-1] - two.friction[-1])) / max(largest, 1e-300),
                )
                for one, two in zip(coarse.cases, fine.cases, strict=True)
            )
            if error <= accuracy:
                return fine, error
            coarse = fine
        raise ConvergenceError(
            f"the integrals of Persson's theory still change by {error:.1g} after {_MOST_REFINEMENTS} refinements; "
            f"ask for an accuracy above {accuracy:g}."
        )

    def _on_grid(self, cases: list[_Case], width: float, directions: int) -> _Found:
        grid = _Grid(_interval_ends(np.log(self.spectrum.wave_number), width), self.spectrum, directions)
        return _Found(grid.q[::2], [self._case(case, grid) for case in cases])

    def _case(self, case: _Case, grid: _Grid) -> _Scales:
        rise = np.zeros(len(grid.q))
        area, dissipated = self._isothermal(case, grid, rise)
        if self.flash is not None and case.speed > 0.0:

            def heated(rise: Array) -> tuple[Array, Array]:
                return self._isothermal(case, grid, rise)

            area, dissipated, rise = self.flash.settled(grid.q, grid.log_weights, case.speed, heated)
        friction = grid.cumulative(0.5 * grid.q * area * dissipated / self.pressure)
        return _Scales(area[::2], friction, rise[::2])

    def _isothermal(self, case: _Case, grid: _Grid, rise: Array) -> tuple[Array, Array]:
        """Return P(q) and q³ C S ∫dφ cos φ Im E/(1−ν²) at given temperatures, at the ends and middles of a grid."""
        modulus = self._modulus(case, grid, rise) / self.plane_strain
        square = 4.0 * (np.square(np.abs(modulus)) @ grid.weights)
        spread = grid.cumulative_everywhere(0.125 * grid.q * grid.cubed_density * square / self.pressure**2)
        root = np.sqrt(np.maximum(spread, 1e-300))
        area = erf(0.5 / root)
        dissipated = grid.cubed_density * 4.0 * (modulus.imag @ (grid.weights * grid.cosines))
        sharing = self.gamma + (1.0 - self.gamma) * area**2
        return area, sharing * dissipated

    def _modulus(self, case: _Case, grid: _Grid, rise: Array) -> NDArray[np.complex128]:
        """Return E(q v cos φ, T_q) for each q and φ."""
        frequency = case.speed * grid.q[:, None] * grid.cosines
        if self.flash is None or case.kelvin is None:
            return np.asarray(self.material.at(case.kelvin).complex_modulus(frequency))
        kelvins = case.kelvin + rise
        shift, vertical = self.material.shift, self.material.vertical_shift
        assert shift is not None
        alpha = np.asarray(shift(kelvins))
        b = np.ones(len(kelvins)) if vertical is None else np.asarray(vertical(kelvins))
        return np.asarray(b[:, None] * self.material.spectrum.complex_modulus(alpha[:, None] * frequency))


def _interval_ends(logs: Array, width: float) -> Array:
    """Return ends of intervals of ln q, no longer than a width, with all points of the spectrum among them.

    Just beyond the longest wave P falls from one like the root of a small distance: intervals grow from there on.
    """
    starts = [_START]
    while starts[-1] < width:
        starts.append(starts[-1] * (1.0 + _GROWTH * width))
    graded = logs[0] + np.concatenate([[0.0], starts])
    parts = np.unique(np.concatenate([logs, graded[graded < logs[-1]]]))
    # Two that differ by rounding are one.
    parts = parts[np.concatenate([[True], np.diff(parts) > 0.1 * _START])]
    counts = np.maximum(1, np.ceil(np.diff(parts) / width)).astype(int)
    pieces = zip(parts[:-1], parts[1:], counts, strict=True)
    return np.concatenate([*(np.linspace(a, b, n, endpoint=False) for a, b, n in pieces), logs[-1:]])


class _Grid:
    """Wave numbers at the ends and in the middles of intervals of ln q (Simpson's rule), and directions φ.

    Directions from 0 to π/2 are crowded towards π/2, where frequencies fall to zero: φ = π/2 (1 − s²), s by Gauss's
    rule.
    """

    def __init__(self, ends: Array, spectrum: PowerSpectrum, directions: int) -> None:
        logs = np.empty(2 * len(ends) - 1)
        logs[::2] = ends
        logs[1::2] = 0.5 * (ends[:-1] + ends[1:])
        self.width = np.diff(ends)
        self.q = np.exp(logs)
        self.cubed_density = self.q**3 * spectrum(self.q)
        place, weight = np.polynomial.legendre.leggauss(directions)
        s = 0.5 * (place + 1.0)
        self.cosines = np.sin(0.5 * math.pi * s**2)
        self.weights = 0.5 * weight * math.pi * s
        self.log_weights = np.zeros(len(self.q))
        self.log_weights[:-2:2] += self.width / 6.0
        self.log_weights[1::2] = 4.0 * self.width / 6.0
        self.log_weights[2::2] += self.width / 6.0

    def cumulative(self, values: Array) -> Array:
        """Return the integral over ln q up to each end of an interval."""
        parts = self.width / 6.0 * (values[:-2:2] + 4.0 * values[1::2] + values[2::2])
        return np.concatenate([[0.0], np.cumsum(parts)])

    def cumulative_everywhere(self, values: Array) -> Array:
        """Return the integral up to each end and middle; to the middle, that of the parabola through the three."""
        ends = self.cumulative(values)
        found = np.empty(len(values))
        found[::2] = ends
        found[1::2] = ends[:-1] + self.width / 24.0 * (5.0 * values[:-2:2] + 8.0 * values[1::2] - values[2::2])
        return found
