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
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.contact.bodies import half_space_coupling
from viscofric.contact.coupling import SurfaceCoupling
from viscofric.contact.heated_result import INTERFACE, beyond
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, wrong_argument
from viscofric.heat.heating import Heating
from viscofric.heat.interface import SlidingInterface
from viscofric.heat.result import HeatColumns
from viscofric.notes import Note, Remedy, counted, note_attributes
from viscofric.rheology.interface.friction import (
    check_interface_heat,
    friction_on_area,
    insist_on_interface,
    total_error,
    total_friction,
)
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.material import Material, insist_on_material, unknown_frequencies
from viscofric.roughness.flash import Flash
from viscofric.roughness.persson_integrals import Case, Found, Theory
from viscofric.roughness.rough_friction import shear_notes, states
from viscofric.roughness.spectrum import PowerSpectrum
from viscofric.showing import Plotted, Rows
from viscofric.thermal import ThermalProperties
from viscofric.units import Quantities, Quantity, positive, share, to_si


@dataclass(frozen=True, eq=False)
class PerssonTheory(Plotted):
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
        That of the theory is larger: in partial contact its area was up to a third too small, and its friction within a
        factor of 2.4, of contacts solved numerically.
    interface_friction, interface_error : (m, n) array or None
        With an interface, its friction τ_s A/F on the real contact area, and the standard error due to the law.
    notes : tuple of str
        On frequencies that were not measured, the shortest waves, the interface, and doubts about Coulomb friction, one
        sentence each.
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
    interface_friction: Array | None = None
    interface_error: Array | None = None
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("temperature", self.temperature, "°C"),
            ("speed", self.speed, "m/s"),
            ("pressure", self.pressure, "Pa"),
            ("friction coefficient", self.friction_coefficient),
            ("interface friction", self.interface_friction),
            ("contact area", self.contact_area_fraction, "%"),
            ("wave numbers", self.wave_number, "rad/m"),
            ("error of the integrals", self.error),
            ("notes", self.notes),
        )

    @property
    def total(self) -> Array:
        """Friction coefficient of hysteresis and interface, (m, n) array; InputError without an interface."""
        return total_friction(self.friction_coefficient, self.interface_friction, "persson_theory() an interface")

    @property
    def total_error(self) -> Array | None:
        """Error of `total` by the integrals and the law of the interface, (m, n) array; None without an interface."""
        return total_error(self.friction_error, self.interface_error)

    @property
    def friction_error(self) -> Array:
        """Largest error of the friction coefficient by the integrals, (m, n) array, the same everywhere."""
        return np.full(self.friction_coefficient.shape, self.error * float(np.abs(self.friction_coefficient).max()))

    def to_dataset(self) -> Dataset:
        """Return everything over temperature, speed and wave number, with pressure, error and notes as attributes."""
        meanings = {
            "friction_coefficient": ("1", "friction coefficient"),
            "friction_error": ("1", "largest error of the friction coefficient by the integrals"),
            "contact_area_fraction": ("1", "real over nominal contact area"),
            "flash_temperature": ("K", "largest rise of temperature"),
            "area_by_scale": ("1", "contact area fraction without shorter waves"),
            "friction_by_scale": ("1", "friction coefficient due to all longer waves"),
            "temperature_rise_by_scale": ("K", "rise of temperature that waves of this length meet"),
        }
        if self.interface_friction is not None:
            meanings["interface_friction"] = ("1", "friction coefficient of the interface")
            meanings["interface_error"] = ("1", "standard error of the interface's friction due to its law")
        return dataset(
            ("temperature", "speed", "wave_number"),
            {name: (getattr(self, name), *meaning) for name, meaning in meanings.items()},
            coordinates={
                "temperature": (self.temperature, "K", "temperature of the rubber before it meets the surface"),
                "speed": (self.speed, "m/s", "sliding speed"),
                "wave_number": (self.wave_number, "rad/m", "wave number"),
            },
            attributes={"pressure": self.pressure, "error": self.error} | note_attributes(self.notes),
        )


@dataclass(frozen=True, eq=False)
class HeatedPerssonTheory(HeatColumns, PerssonTheory):
    """Results of Persson's theory with the heat of friction.

    Attributes of `PerssonTheory`, and:

    Attributes
    ----------
    isothermal_friction : (m, n) array
        Friction coefficient without heating.
    temperature_rise, loss_weighted_rise : (m, n) array
        Mean of the rise over all scales, weighted with what each loses, K.
    coulomb_rise, loss_rise : (m, n) array
        Its parts due to Coulomb friction and to the loss, K.
    track_rise : (m, n) array
        Zero.
    face_rise : (m, n) array
        Rise of the surface of the macroasperity contacts, K.
    cold_friction, cold_rise, hot_friction, hot_rise : (m, n) array
        Friction and rise of the states reached from a cold and from a hot start, equal where there is one only.
    """

    def __post_init__(self) -> None:
        self.keep_heat(self.friction_coefficient.shape)
        super().__post_init__()

    def to_dataset(self) -> Dataset:
        """Return everything as `PerssonTheory` does, with the columns of the heat."""
        return super().to_dataset().assign(self.heat_variables("temperature", "speed"))


_CLOSEST, _LOOSEST = 1e-8, 0.1
#: Rises from which hot states are looked for, K: the first at which α is known.
_HOT = (300.0, 200.0, 150.0, 100.0, 70.0, 50.0, 30.0, 20.0, 10.0, 5.0)
#: Two states are one where their rises differ by less than this, K, plus the same share of it.
_SAME = 1e-2
#: Anisotropy that is noted; that of isotropic surfaces of some ten waves' length is below this by chance.
_ANISOTROPIC = 0.25
#: Share of the shortest octave of waves in friction or area that is noted.
_BY_CUT_OFF = 0.05


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
    interface: InterfaceLaw | None = None,
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
        In place of `thermal`: flash temperatures with the Coulomb heat that rubber and counterface share, and the
        isothermal friction beside.  `average` has no meaning here: every scale has its temperature; there is neither
        track nor nominal contact.
    interface : InterfaceLaw, optional
        Shear stress of the dry interface on the real contact area, such as from `ShearStress.law`: adds its friction.
        With heating, its shear stress at the temperature of the macroasperity contacts makes the Coulomb heat.
    macroasperity_area : float
        Contact area fraction that shows at the scale of the macroasperities, at which hot spots begin; between 0 and 1.
    accuracy : float
        Of the integrals; see `PerssonTheory.error`.

    Returns
    -------
    PerssonTheory
        With heating `HeatedPerssonTheory`.

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
    >>> road = vf.roughness.PowerSpectrum.self_affine(0.8, longest="1 mm", shortest="10 um", rms_slope=0.5)
    >>> theory = vf.persson_theory(rubber, road, speeds=[0.001, 0.1], pressure="0.1 MPa")
    >>> theory.friction_coefficient.shape
    (1, 2)
    """
    insist_on_material(material)
    insist_on(spectrum, "spectrum", PowerSpectrum, right="a PowerSpectrum; see power_spectrum(topography)")
    velocities, kelvins = states(speeds, temperatures)
    if not np.all(velocities >= 0.0):
        raise wrong_argument("speeds", speeds, "must not be below zero.", "negative")
    sharing = to_si(gamma, "dimensionless", "gamma")
    if not 0.0 <= sharing <= 1.0:
        raise InputError(f"gamma = {sharing:g}: must lie between 0 and 1.", code="out-of-range")
    wanted = to_si(accuracy, "dimensionless", "accuracy")
    if not _CLOSEST <= wanted <= _LOOSEST:
        raise InputError(f"accuracy = {wanted:g}: must lie between {_CLOSEST:g} and {_LOOSEST:g}.", code="out-of-range")
    spots = share(macroasperity_area, "macroasperity_area", example=0.3)
    nominal = positive(pressure, "Pa", "pressure")
    if interface is not None:
        insist_on_interface(interface)
    flash = _flash(thermal, heating, interface, spots, nominal)
    if flash is not None and (material.shift is None or temperatures is None):
        raise InputError("A flash temperature needs a material with a shift, and temperatures.", code="no-shift")
    cases = [Case(kelvin, float(speed)) for kelvin in kelvins for speed in velocities]

    def solved(flash: Flash | None) -> tuple[Found, float]:
        return Theory(material, spectrum, nominal, sharing, flash).converged(cases, wanted)

    found, error = solved(flash)
    shape = len(kelvins), len(velocities)
    kind: Any = PerssonTheory
    columns: dict[str, Array] = {}
    if heating is not None:
        assert flash is not None
        kind = HeatedPerssonTheory
        hot, hot_error = solved(replace(flash, start=_hottest(material, max(one or 0.0 for one in kelvins))))
        isothermal, isothermal_error = solved(None)
        error = max(error, hot_error, isothermal_error)
        columns = {name: one.reshape(shape) for name, one in _columns(isothermal, found, hot, heating.branch).items()}
        found = hot if heating.branch == "hot" else found

    def by_case(name: str) -> Array:
        return np.array([getattr(one, name) for one in found.cases]).reshape(*shape, -1)

    area, friction, rise = by_case("area"), by_case("friction"), by_case("rise")
    result: PerssonTheory = kind(
        temperature=np.array([math.nan if kelvin is None else kelvin for kelvin in kelvins]),
        speed=velocities,
        pressure=nominal,
        friction_coefficient=friction[..., -1],
        contact_area_fraction=area[..., -1],
        flash_temperature=rise.max(axis=-1),
        wave_number=found.q,
        area_by_scale=area,
        friction_by_scale=friction,
        temperature_rise_by_scale=rise,
        error=error,
        **columns,
    )
    surface = SurfaceCoupling(spectrum.rms_slope(), half_space_coupling(material.poisson_ratio))
    finished = _with_coulomb(result, surface, heating, interface)
    notes = (
        *finished.notes,
        *_beyond_measured(material, finished),
        *unknown_frequencies(material),
        *material.notes_at(None if np.isnan(finished.temperature).any() else finished.temperature),
        *_one_way(spectrum),
        *_cut_off(finished),
    )
    return replace(finished, notes=notes)


def _one_way(spectrum: PowerSpectrum) -> tuple[Note, ...]:
    """Return a note where friction depends on the direction of sliding, over which the theory takes the mean."""
    # A wave at an angle φ to the motion contributes to friction in full contact as |cos φ|ⁿ, n = 2 where E'' grows with
    # frequency, which makes the change equal to the anisotropy; 2n/(n + 2) of it for other n.
    share = spectrum.anisotropy
    if share <= _ANISOTROPIC:
        return ()
    said = (
        f"The surface is anisotropic: in one direction its mean square slope is {100.0 * share:.0f} % above the mean "
        "of all directions, across it as much below. The theory takes this mean; in full contact friction along these "
        "two directions differs from it by up to about as much; "
    )
    remedy = Remedy("solve the surface with direction= (predict_rough_friction).")
    return (Note("anisotropic-surface", said, remedy=remedy, values={"anisotropy": share}),)


def _cut_off(found: PerssonTheory) -> tuple[Note, ...]:
    """Return a note where results depend on the shortest wavelength, which the user chooses."""
    before = int(np.searchsorted(found.wave_number, 0.5 * found.wave_number[-1], side="right")) - 1
    if before < 0:
        return ()
    friction, area = found.friction_by_scale, found.area_by_scale
    left = np.divide(
        friction[..., before], friction[..., -1], out=np.ones(area.shape[:-1]), where=friction[..., -1] > 0
    )
    share, larger = float(1.0 - left.min()), float((area[..., before] / area[..., -1]).max() - 1.0)
    if max(share, larger) <= _BY_CUT_OFF:
        return ()
    said = (
        f"The shortest octave of waves makes up to {100.0 * share:.2g} % of the friction, and contact areas are up to "
        f"{100.0 * larger:.2g} % larger without it: both depend on the shortest wavelength of the spectrum; "
    )
    remedy = Remedy("compare several (PowerSpectrum.limited(shortest=…)).")
    return (Note("cut-off", said, remedy=remedy, values={"friction": share, "area": larger}),)


def _beyond_measured(material: Material, found: PerssonTheory) -> tuple[Note, ...]:
    """Return a note where wave numbers q at frequencies qv that were not measured matter to the friction."""
    known = material.spectrum.known_frequencies
    if known is None:
        return ()
    frequency = found.speed[:, None] * found.wave_number
    if material.shift is not None and not np.isnan(found.temperature).any():
        frequency = frequency * material.shift(found.temperature[:, None, None] + found.temperature_rise_by_scale)
    parts = np.diff(found.friction_by_scale, axis=-1, prepend=0.0)
    beyond = np.where(known.covers(frequency), 0.0, parts).sum(axis=-1)
    shares = np.divide(beyond, found.friction_coefficient, out=np.zeros_like(beyond), where=beyond > 0.0)
    return counted([known.beyond_part(share) for share in shares.ravel().tolist()], shares.ravel().tolist())


def _with_coulomb(
    result: PerssonTheory, surface: SurfaceCoupling, heating: Heating | None, interface: InterfaceLaw | None
) -> PerssonTheory:
    """Return results with the friction of an interface, and with notes on Coulomb friction."""
    friction, area = result.friction_coefficient, result.contact_area_fraction
    coulomb = np.full(friction.shape, 0.0 if heating is None else heating.coulomb)
    notes: tuple[str, ...] = ()
    if interface is not None:
        slip, face = result.speed, np.broadcast_to(result.temperature[:, None], friction.shape)
        if heating is not None:
            assert isinstance(result, HeatedPerssonTheory)
            slip, face = np.array([heating.sliding(float(one)) for one in slip]), face + result.face_rise
            _insist_on_known(interface, slip, face)
        rubbed = friction_on_area(interface, slip, face[..., None], result.pressure, area[..., None])
        notes, coulomb = rubbed["notes"], rubbed["interface_friction"][..., 0]
        result = replace(result, interface_friction=coulomb, interface_error=rubbed["interface_error"][..., 0])
    sheared = shear_notes(
        coulomb[..., None], friction[..., None], area[..., None], result.speed, result.pressure, [surface]
    )
    return replace(result, notes=(*notes, *sheared))


def _insist_on_known(law: InterfaceLaw, slip: Array, face: Array) -> None:
    """Raise InputError where the law of the interface is not known at the temperature of the faces (m, n), K."""
    for kelvin, speed in zip(face.ravel().tolist(), np.broadcast_to(slip, face.shape).ravel().tolist(), strict=True):
        if speed > 0.0 and not SlidingInterface(law, speed, kelvin).is_known(0.0):
            raise beyond(INTERFACE, kelvin)


def _columns(isothermal: Found, cold: Found, hot: Found, branch: str) -> dict[str, Array]:
    """Return the columns of `HeatColumns`, (n,) each; hot states that differ from cold ones by rounding are these."""
    ends = []
    for one, other in zip(cold.cases, hot.cases, strict=True):
        same = abs(other.mean_rise - one.mean_rise) <= _SAME * (1.0 + one.mean_rise)
        ends.append((one, one if same else other))
    chosen = [pair[branch == "hot"] for pair in ends]
    mean = np.array([one.mean_rise for one in chosen])
    by_coulomb = np.array([one.coulomb_rise for one in chosen])
    columns = {
        "isothermal_friction": np.array([float(one.friction[-1]) for one in isothermal.cases]),
        "temperature_rise": mean,
        "coulomb_rise": by_coulomb,
        "loss_rise": mean - by_coulomb,
        "track_rise": np.zeros(len(mean)),
        "face_rise": np.array([one.face_rise for one in chosen]),
        "loss_weighted_rise": mean,
    }
    for name, side in (("cold", [one for one, _ in ends]), ("hot", [one for _, one in ends])):
        columns[f"{name}_friction"] = np.array([float(one.friction[-1]) for one in side])
        columns[f"{name}_rise"] = np.array([one.mean_rise for one in side])
    return columns


def _hottest(material: Material, kelvin: float) -> float:
    """Return a rise of temperature, K, at which α is known, from which a hot state is looked for."""
    assert material.shift is not None
    return next((rise for rise in _HOT if material.shift.valid_at(kelvin + rise)), 0.0)


def _flash(
    thermal: ThermalProperties | None,
    heating: Heating | None,
    interface: InterfaceLaw | None,
    area: float,
    pressure: float,
) -> Flash | None:
    """Return the parameters of hot spots of a contact area fraction; None where nothing is heated."""
    if heating is not None:
        insist_on(heating, "heating", Heating)
        check_interface_heat(heating, interface)
        if thermal is not None or heating.passes > 0 or heating.nominal_radius is not None:
            raise InputError(
                "heating: not with thermal, a track or a nominal_radius; leave out one of them.",
                code="not-with-heating",
            )
        return Flash(heating.rubber, area, heating, pressure, interface)
    if thermal is None:
        return None
    insist_on(thermal, "thermal", ThermalProperties, right="ThermalProperties of the rubber")
    if interface is not None:
        raise InputError("thermal: not with an interface, which makes heat; give heating.", code="not-with-heating")
    return Flash(thermal, area)
