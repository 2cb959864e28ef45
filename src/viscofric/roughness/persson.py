"""Persson's theory of rubber on rough surfaces: real contact area and friction from a power spectrum and E(ω, T).

The rubber is followed from the longest wave of the surface to ever shorter ones.  Under a nominal pressure σ0 the share
of the surface that is in contact, when no wavelength below 2π/q is resolved, is [1]_ ::

    P(q) = erf(1/(2 √G)),    G(q) = 1/8 ∫_{q0}^{q} dq q³ C(q) ∫_0^{2π} dφ |E(q v cos φ, T_q) / ((1−ν²) σ0)|²

and the friction coefficient of all that the rubber dissipates ::

    μ = 1/2 ∫_{q0}^{q1} dq q³ C(q) S(q) P(q) ∫_0^{2π} dφ cos φ Im E(q v cos φ, T_q) / ((1−ν²) σ0)

with S = 1 in [1]_. Where contact is partial the rubber follows a wave only in part, for which later work takes S = γ +
(1−γ) P², γ ≈ 1/2 [2]_; [3]_ compares such theory with solved contacts. In full contact (P = S = 1) the integral is
exact. At small loads P is √(8/π) σ0 (1−ν²)/(E h'), h' the rms slope, for an elastic solid.

References
----------
.. [1] B. N. J. Persson, "Theory of rubber friction and contact mechanics", J. Chem. Phys. 115 (2001) 3840,
   doi:10.1063/1.1388626
.. [2] B. Lorenz, Y. R. Oh, S. K. Nam, S. H. Jeon, B. N. J. Persson, "Rubber friction on road surfaces: Experiment and
   theory for low sliding speeds", J. Chem. Phys. 142 (2015) 194701
.. [3] M. Scaraggi, B. N. J. Persson, "Viscoelastic contact mechanics between randomly rough surfaces" (2014),
   arXiv:1406.7236
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from viscofric.arguments import insist_on
from viscofric.datasets import dataset
from viscofric.errors import InputError, brief
from viscofric.heat.heating import Heating
from viscofric.rheology.material import Material, insist_on_material
from viscofric.roughness.flash import Flash
from viscofric.roughness.persson_integrals import Case, Scales, Theory
from viscofric.roughness.spectrum import PowerSpectrum
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantities, Quantity, positive, share, to_si, to_si_array

if TYPE_CHECKING:
    import xarray

    from viscofric.arrays import Array


_CLOSEST, _LOOSEST = 1e-8, 0.1


@dataclass(frozen=True, eq=False)
class PerssonTheory:
    """Results of Persson's theory for a rubber that slides on a rough surface.

    Attributes
    ----------
    temperature : (m,) array
        Of the rubber before it meets the surface, K; NaN where none was given: a material with a shift is then at its
        reference.
    speed : (n,) array
        m/s.
    pressure : float
        Nominal, Pa.
    friction_coefficient : (m, n) array
        For every temperature and speed.
    contact_area_fraction : (m, n) array
        Real contact area over nominal, all waves seen.
    flash_temperature : (m, n) array
        Largest rise of temperature over all scales, K; zero without `thermal` or `heating`.
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
        """Return everything over temperature, speed and wave number; attributes are ``pressure`` and ``error``."""
        meanings = {
            "friction_coefficient": ("1", "friction coefficient"),
            "contact_area_fraction": ("1", "real over nominal contact area"),
            "flash_temperature": ("K", "largest rise of temperature"),
            "area_by_scale": ("1", "contact area fraction without shorter waves"),
            "friction_by_scale": ("1", "friction coefficient due to all longer waves"),
            "temperature_rise_by_scale": ("K", "rise of temperature that waves of this length meet"),
        }
        return dataset(
            ("temperature", "speed", "wave_number"),
            {name: (getattr(self, name), *meaning) for name, meaning in meanings.items()},
            coordinates={
                "temperature": (self.temperature, "K", "temperature of the rubber before it meets the surface"),
                "speed": (self.speed, "m/s", "sliding speed"),
                "wave_number": (self.wave_number, "rad/m", "wave number"),
            },
            attributes={"pressure": self.pressure, "error": self.error},
        )


def persson_theory(
    material: Material,
    spectrum: PowerSpectrum,
    *,
    speeds: Quantities,
    pressure: Quantity,
    temperatures: Quantities | None = None,
    gamma: float = 0.5,
    thermal: ThermalProperties | None = None,
    heating: Heating | None = None,
    macroasperity_area: float = 0.3,
    accuracy: float = 1e-4,
) -> PerssonTheory:
    """Predict area and friction by Persson's theory, in milliseconds for each speed.

    Parameters
    ----------
    material : Material
    spectrum : PowerSpectrum
        Of the surface, between its cut-offs.
    speeds : float, str, pint.Quantity, or an array or list of them
        Of sliding, not below zero, m/s; at rest E0 applies.
    pressure : float, str or pint.Quantity
        Nominal pressure σ0, Pa.
    temperatures : float, str, pint.Quantity, or an array or list of them, optional
        K if plain numbers; may be left out for a material without a shift.
    gamma : float
        γ of S = γ + (1−γ) P²: how much of the dissipation of full contact there is in the contact spots of a partial
        one; 1 gives the theory of 2001.
    thermal : ThermalProperties, optional
        Those of the rubber, with which flash temperatures count (`viscofric.roughness.flash`); isothermal without.
    heating : Heating, optional
        In place of `thermal`: flash temperatures with the Coulomb heat that rubber and counterface share.  From a cold
        start; `average` and `branch` have no meaning here, and there is no track.
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
        raise InputError(
            f"spectrum = {brief(spectrum)}: must be a PowerSpectrum; see power_spectrum(topography).", code="wrong-type"
        )
    velocities = to_si_array(speeds, "m/s", "speeds")
    if not velocities.size or not np.all(velocities >= 0.0):
        raise InputError("speeds must hold at least one value, none of them below zero.", code="empty-list")
    kelvins: list[float | None] = [None]
    if temperatures is not None:
        kelvins = [positive(float(one), "K", "temperatures") for one in to_si_array(temperatures, "K", "temperatures")]
        if not kelvins:
            raise InputError("temperatures must hold at least one value.", code="empty-list")
    sharing = to_si(gamma, "dimensionless", "gamma")
    if not 0.0 <= sharing <= 1.0:
        raise InputError(f"gamma = {sharing:g}: must lie between 0 and 1.", code="out-of-range")
    wanted = to_si(accuracy, "dimensionless", "accuracy")
    if not _CLOSEST <= wanted <= _LOOSEST:
        raise InputError(f"accuracy = {wanted:g}: must lie between {_CLOSEST:g} and {_LOOSEST:g}.", code="out-of-range")
    spots = share(macroasperity_area, "macroasperity_area", example=0.3)
    nominal = positive(pressure, "Pa", "pressure")
    flash = _flash(thermal, heating, spots, nominal)
    if flash is not None and (material.shift is None or temperatures is None):
        raise InputError("A flash temperature needs a material with a shift, and temperatures.", code="no-shift")
    solver = Theory(material, spectrum, nominal, sharing, flash)
    cases = [Case(kelvin, float(speed)) for kelvin in kelvins for speed in velocities]
    found, error = solver.converged(cases, wanted)
    shape = len(kelvins), len(velocities)

    def by_case(rows: list[Array]) -> Array:
        return np.array(rows).reshape(*shape, -1)

    area, friction, rise = (by_case([getattr(one, name) for one in found.cases]) for name in Scales._fields)
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


def _flash(thermal: ThermalProperties | None, heating: Heating | None, area: float, pressure: float) -> Flash | None:
    """Return the parameters of hot spots of a contact area fraction; None where nothing is heated."""
    if heating is not None:
        insist_on(heating, "heating", Heating)
        if thermal is not None or heating.passes > 0:
            raise InputError("heating: not with thermal or a track; leave out one of them.", code="not-with-heating")
        return Flash(heating.rubber, area, heating, pressure)
    if thermal is None:
        return None
    if not isinstance(thermal, ThermalProperties):
        raise InputError(f"thermal = {brief(thermal)}: must be ThermalProperties of the rubber.", code="wrong-type")
    return Flash(thermal, area)
