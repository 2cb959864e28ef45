"""Solve the steady contact of a periodic rough surface with a viscoelastic half-space or layer."""

from __future__ import annotations

import functools
import logging
import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from viscofric.arguments import exactly_one, whole_number
from viscofric.arrays import Array, ComplexArray
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.bodies import (
    LITTLE_INERTIA,
    Layer,
    checked_coulomb,
    half_space_coupling,
    indenter_compliance,
    inertia_note,
    shear_wave_speed,
    unit_direction,
)
from viscofric.contact.complementarity import ComplementaritySolution
from viscofric.contact.indenters.indenter import too_steep
from viscofric.contact.periodic.heating import PeriodicThermalContact, insist_on_heated_surface, solve_heated_surface
from viscofric.contact.periodic.levels import Work, coarser_shapes, solve_on_levels
from viscofric.contact.periodic.one_grid import Stage
from viscofric.contact.periodic.solution import PeriodicDiagnostics, PeriodicSolution
from viscofric.contact.periodic.surface import Coarser, PeriodicSurface, Topographic, flattening_pressure, wave_number
from viscofric.contact.periodic.transfer import SlidingSolid, dissipation, losses
from viscofric.errors import InputError, wrong_argument
from viscofric.heat.heating import Heating
from viscofric.notes import Note
from viscofric.threads import in_parts, one_blas_thread, so_many, threads_for
from viscofric.units import Quantity, checked_poisson_ratio, number, positive, to_si, velocity

if TYPE_CHECKING:
    from viscofric.rheology.material import Material


logger = logging.getLogger(__name__)

TIGHTEST, LOOSEST = 1e-12, 1e-2  # of the complementarity, in rms heights
#: Friction is resolved relative to its own value, but not below this fraction of the slope of the longest wave.
FRICTION_FLOOR = 1e-3
#: Relative loss of rms height up to which a coarser surface counts as the same.
LIKENESS = 1e-10
# Error of friction as a part of the load on points at the edges of the contact, where no coarser grid has all the
# waves.  Found in random contacts that the other estimate does not cover: 1 to 11 %, 26 % where all points are such.
_UNSURE_AT_EDGES = 0.25
# Points in contact at which it is twice as large: up to four times the friction was seen at one to six points.
_FEW_POINTS = 24
# Least factor by which errors fall where points are twice as close: pressures rise like square roots at the edges.
_FADING = 0.5**1.5
# Frequencies at which moduli are computed for the speeds of shear waves, and interpolated between.
_MODULI = 200
#: Bytes of memory for each point while an elastic and a viscoelastic contact is solved with up to a fifth of the area
#: in contact: those of the arrays and of the surface, and what the allocator keeps.  In full contact up to 30 more.
BYTES_PER_POINT = (105, 120)


@one_blas_thread
def solve_periodic(
    material: Material,
    surface: PeriodicSurface | Topographic,
    *,
    speed: Quantity,
    pressure: Quantity | None = None,
    gap: Quantity | None = None,
    temperature: Quantity | None = None,
    direction: Sequence[float] = (1.0, 0.0),
    coulomb: Quantity = 0.0,
    layer: Layer | Quantity | None = None,
    indenter_modulus: Quantity | None = None,
    indenter_poisson_ratio: Quantity = 0.3,
    tolerance: Quantity = 1e-8,
    most_products: int = 10_000,
    backend: Backend | str = "scipy",
    heating: Heating | None = None,
) -> PeriodicSolution:
    """Solve the steady contact of a rough surface that slides over a viscoelastic half-space or layer.

    Parameters
    ----------
    material : Material
        Its spectrum may be a table of moduli as well.
    surface : PeriodicSurface or Topography
        A topography must be periodic and complete.
    speed : float, str or pint.Quantity
        Velocity of the surface along `direction`, m/s; zero is the elastic contact at E0.  With an infinite one
        (``math.inf``), waves respond with E_inf but for those that lie across the motion and are at rest at any speed.
    pressure : float, str or pint.Quantity, optional
        Mean pressure, Pa; either it or the gap is given.
    gap : float, str or pint.Quantity, optional
        Mean gap, m, below that at the first touch (highest summit less mean height).
    temperature : float, str or pint.Quantity, optional
        K if a plain number.  May be left out for a material without a shift law.
    direction : (float, float)
        Of the motion in the plane; its length does not matter.
    coulomb : float or str
        Coulomb friction coefficient, whose shear changes the pressure, as of `solve_steady`.
    layer : Layer, float, str or pint.Quantity, optional
        Thickness and base of the material, or the thickness of a bonded layer, such as ``"2 mm"``; a half-space
        without.
    indenter_modulus : float, str or pint.Quantity, optional
        Young's modulus of the rough body, Pa, whose compliance is added; rigid without.
    indenter_poisson_ratio : float or str
        −1 to 0.5.
    tolerance : float or str
        Of the complementarity: largest gap under pressure or overlap without it over the rms height of the surface.
    most_products : int
        Products with the transfer function on the finest grid after which the solver gives up.
    backend : Backend or str
        Arrays and FFTs to solve with, such as "ducc0" or "torch:cuda"; see `Backend`.
    heating : Heating, optional
        Thermal properties and Coulomb heat: the contact is at the temperature to which its own friction heats its
        spots; `PeriodicSolution.heating` holds it.  Several solves; not with a layer or `coulomb`.

    Returns
    -------
    PeriodicSolution

    Raises
    ------
    InputError
        If a value cannot be used, or the computer has less memory than the contact needs.
    ConvergenceError
        If the solver fails.

    Notes
    -----
    A viscoelastic contact needs about 120 bytes of memory per point: 2 GB for 4096², 8 GB for 8192².

    û = 2(1−ν²) S(−q·v) p̂/|q| holds exactly for each wave, so that a table of moduli needs no modes.  The surface
    repeats itself and so does the pressure: an isolated contact is better solved by `solve_steady`.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> wave = vf.contact.PeriodicSurface(1e-6 * np.cos(2.0 * np.pi * np.arange(64) / 64), spacing=1e-3 / 64)
    >>> solution = vf.solve_periodic(rubber, wave, speed="0.2 m/s", pressure="100 kPa")
    >>> solution.diagnostics.full_contact, round(solution.friction_coefficient, 7)
    (True, 0.0001465)
    """
    if not hasattr(material, "poisson_ratio"):
        raise wrong_argument(
            "material", material, "must be a Material, such as vf.read_card('rubber.json').", "wrong-type"
        )
    whole_number(most_products, "most_products", 1)
    if isinstance(surface, Topographic):  # of a topography, heights may be missing, or not repeat themselves
        surface = surface.to_surface()
    if not isinstance(surface, PeriodicSurface):
        raise wrong_argument("surface", surface, "must be a Topography or a PeriodicSurface.", "wrong-type")
    sliding, toward = velocity(speed), unit_direction(direction)
    exactly_one(pressure=pressure, gap=gap)
    if not TIGHTEST <= (tolerance := number(tolerance, "tolerance")) <= LOOSEST:
        raise InputError(
            f"tolerance = {tolerance:g}: must be a number from {TIGHTEST:g} to {LOOSEST:g}.", code="out-of-range"
        )
    coulomb = checked_coulomb(coulomb)
    indenter_poisson_ratio = checked_poisson_ratio(indenter_poisson_ratio, "indenter_poisson_ratio", above=-1.0)
    layer = Layer.of(layer)
    where = Backend.of(backend)
    modulus = material.at(temperature)
    kelvin = None if temperature is None else to_si(temperature, "K", "temperature")
    if heating is not None:
        insist_on_heated_surface(heating, material, sliding, kelvin, layer, coulomb)
        assert kelvin is not None
        call = {
            "surface": surface, "pressure": pressure, "gap": gap, "direction": direction, "tolerance": tolerance,
            "indenter_modulus": indenter_modulus, "indenter_poisson_ratio": indenter_poisson_ratio,
            "most_products": most_products, "backend": where,
        }  # fmt: skip
        isothermal = functools.partial(_isothermal, material, call)
        return solve_heated_surface(PeriodicThermalContact(material, heating, kelvin, sliding, isothermal))
    solid = SlidingSolid(
        modulus,
        material.poisson_ratio,
        (_component(sliding, toward[0]), _component(sliding, toward[1])),
        layer,
        indenter_compliance(indenter_modulus, indenter_poisson_ratio),
        toward,
        math.copysign(1.0, sliding) * coulomb,
        half_space_coupling(indenter_poisson_ratio),
    )
    _insist_on_memory(surface.shape, BYTES_PER_POINT[not solid.is_symmetric], where)
    with so_many(where.threads):
        given = _Given.of(surface, pressure, gap)
        depth = surface.rms_height
        finest = solid.transfer(surface.shape, surface.spacing)
        # The unit of compliance, m/Pa: that of the most compliant wave.
        unit = float(np.abs(finest).max())
        flattening_pressure(depth, unit)
        finest /= unit
        coarser = surface.coarser(coarser_shapes(surface.shape))
        result, work = solve_on_levels(
            _stages(surface, coarser, solid, _Units(depth, unit), finest),
            mean_pressure=None if given.pressure is None else given.pressure * unit / depth,
            offset=None if given.gap is None else given.gap / depth,
            tolerance=tolerance,
            most_products=most_products,
            backend=where,
        )
        # The friction on the next coarser grid counts where that grid has all the waves of the surface.
        same = coarser[0] if coarser and coarser[0].z.std() >= (1.0 - LIKENESS) * depth else None
        motion = sliding, toward, kelvin
        solution, steepness = _assemble(surface, same, solid, result, work, given, _Units(depth, unit), motion, finest)
    strains = _large_strains(solution, steepness, layer)
    return replace(solution, coulomb=coulomb, warnings=(*solution.warnings, *strains, *material.notes_at(kelvin)))


def _insist_on_memory(shape: tuple[int, int], bytes_per_point: int, backend: Backend) -> None:
    """Refuse a surface that does not fit into this computer's memory."""
    needed = bytes_per_point * math.prod(shape)
    logger.info("%s x %s points: about %.2g GB of memory", *shape, needed / 1e9)
    if backend.is_numpy and needed > (there := _memory()):
        raise InputError(
            f"A contact of {shape[0]} x {shape[1]} points needs about {needed / 1e9:.2g} GB of memory, and this "
            f"computer has {there / 1e9:.2g} GB; give fewer points.",
            code="not-enough-memory",
        )


def _memory() -> float:
    """Return the bytes of memory of this computer; infinity where the system does not say."""
    try:
        return float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    except (AttributeError, ValueError, OSError):
        return math.inf


def _isothermal(material: Material, call: dict[str, Any], speed: float, kelvin: float, _: float) -> PeriodicSolution:
    return solve_periodic(material, speed=speed, temperature=kelvin, **call)


def _large_strains(solution: PeriodicSolution, steepness: float, layer: Layer | None) -> tuple[Note, ...]:
    """Return notes on small strain; for many spots the rms slope counts rather than the steepest place."""
    notes = [too_steep(steepness, "rms slope of the surface within the contact")]
    if layer is not None:
        notes.append(layer.strain_warning(solution.indentation))
    return tuple(filter(None, notes))


class _Given(NamedTuple):
    """Mean pressure (Pa) or mean gap (m)."""

    pressure: float | None
    gap: float | None

    @classmethod
    def of(cls, surface: PeriodicSurface, pressure: Quantity | None, gap: Quantity | None) -> _Given:
        if gap is None:
            return cls(positive(pressure, "Pa", "pressure"), None)  # type: ignore[arg-type]
        distance, first = positive(gap, "m", "gap"), float(surface.z.max() - surface.z.mean())
        if distance >= first:
            raise InputError(
                f"gap = {gap!r}: the surfaces do not touch; give a mean gap below that at the first touch, "
                f"{first:.4g} m.",
                code="no-contact",
            )
        return cls(None, distance)


class _Units(NamedTuple):
    """Depth (m) and compliance of a wave (m/Pa)."""

    depth: float
    compliance: float


def _component(velocity: float, part: float) -> float:
    return velocity * part if part != 0.0 and velocity != 0.0 else 0.0


def _stages(
    surface: PeriodicSurface, coarser: list[Coarser], solid: SlidingSolid, units: _Units, finest: NDArray[Any]
) -> Iterator[Stage]:
    """Yield the contact on each grid, coarsest first, given the transfer function of the finest."""
    # Spacings have the same ratio on all grids, but for the coarsest ones of long strips, where little depends on it.
    toward = solid.toward[0] / surface.spacing[0], solid.toward[1] / surface.spacing[1]
    for z, spacing in reversed(coarser):
        relaxed = functools.partial(solid.relaxed_shape, z.shape, spacing)
        transfer = solid.transfer(z.shape, spacing)
        transfer /= units.compliance
        yield Stage(_heights(z, units), transfer, relaxed, toward)
    relaxed = functools.partial(solid.relaxed_shape, surface.shape, surface.spacing)
    yield Stage(_heights(surface.z, units), finest, relaxed, toward)


def _heights(z: Array, units: _Units) -> Array:
    """Heights above the lowest point of the indenter, which are z downwards, in units of the depth."""
    found, highest = np.empty_like(z), z.max()

    def measure(found: Array, z: Array) -> None:
        found[...] = (highest - z) / units.depth

    in_parts(measure, found, z)
    return found


def _assemble(
    surface: PeriodicSurface,
    coarser: Coarser | None,
    solid: SlidingSolid,
    result: ComplementaritySolution,
    work: Work,
    given: _Given,
    units: _Units,
    motion: tuple[float, tuple[float, float], float | None],
    transfer: ComplexArray | Array,
) -> tuple[PeriodicSolution, float]:
    """Return to SI units, and balance the energy; also return the rms slope under pressure."""
    velocity, toward, kelvin = motion
    pressure, displacement = result.pressure, result.displacement
    gap, highest = np.empty_like(pressure), surface.z.max()

    def restore(pressure: Array, displacement: Array, gap: Array, z: Array) -> tuple[float, float, int]:
        pressure *= units.depth / units.compliance
        displacement *= units.depth
        gap[...] = displacement + (highest - z) - units.depth * result.indentation
        displacement += compression
        return float(gap.sum()), float(pressure.max()), int(np.count_nonzero(pressure > 0.0))

    mean_pressure = (units.depth / units.compliance) * float(pressure.mean())
    compression = solid.mean_compression() * mean_pressure
    gaps, largest, counts = zip(*in_parts(restore, pressure, displacement, gap, surface.z), strict=True)
    loaded = sum(counts)
    by_slopes, steepness = _on_slopes(surface, pressure, toward)
    transfer *= units.compliance
    dissipated, lost = _dissipated(transfer, surface, toward, pressure)
    by_pressure, by_energy = float(by_slopes[0]), float(dissipated[0])
    notes = too_fast(surface, solid, lost, by_energy) + beyond_measured(surface, solid, lost, by_energy)
    del lost
    estimates = [np.abs(by_slopes - dissipated)]
    if coarser is not None and work.coarser_pressure is not None:
        there = _forces_on(coarser, work.coarser_pressure, solid, units, toward)
        estimates += [np.abs(there[1] - dissipated), _FADING * np.abs(there[1] - there[0])]
    else:
        few = 1.0 + (_FEW_POINTS / loaded) ** 2
        estimates += [np.full(2, _UNSURE_AT_EDGES * few * _load_at_edges(pressure) * math.hypot(*dissipated))]
    error, across = (np.max(estimates, axis=0) / mean_pressure).tolist()
    floor = FRICTION_FLOOR * mean_pressure * 2.0 * math.pi * units.depth / max(surface.period)
    full_contact = loaded == pressure.size
    mean_gap = 0.0 if full_contact else max(0.0, sum(gaps) / gap.size)  # residuals are not gaps
    wanted, found = (given.pressure, mean_pressure) if given.gap is None else (given.gap, mean_gap)
    solution = PeriodicSolution(
        speed=velocity,
        direction=toward,
        temperature=kelvin,
        mean_pressure=mean_pressure if given.pressure is None else given.pressure,
        mean_gap=mean_gap if given.gap is None else given.gap,
        indentation=units.depth * result.indentation + compression,
        friction_coefficient=by_energy / mean_pressure,
        pressure_friction_coefficient=by_pressure / mean_pressure,
        lateral_friction_coefficient=float(dissipated[1]) / mean_pressure,
        contact_area_fraction=loaded / pressure.size,
        max_pressure=max(largest),
        x=surface.x,
        y=surface.y,
        pressure=pressure,
        displacement=displacement,
        gap=gap,
        diagnostics=PeriodicDiagnostics(
            complementarity=result.complementarity,
            load=abs(found / wanted - 1.0),  # type: ignore[operator]
            linear=result.linear,
            energy=(by_pressure - by_energy) / max(abs(by_pressure), abs(by_energy), floor),
            friction_error=error,
            lateral_friction_error=max(error, across),  # small by chance alone where it is small
            full_contact=full_contact,
            products=work.products,
            ffts=work.ffts,
            single_ffts=work.single_ffts,
            splitting_steps=work.splitting_steps,
            set_changes=work.set_changes,
            linear_iterations=work.linear_iterations,
            grids=work.grids,
        ),
        warnings=notes,
    )
    return solution, steepness


def beyond_measured(surface: PeriodicSurface, solid: SlidingSolid, lost: Array, friction: float) -> tuple[Note, ...]:
    """Return a note if much of the friction force per area comes from waves at frequencies that were not measured."""
    known = solid.spectrum.known_frequencies
    if known is None or friction == 0.0 or not all(map(math.isfinite, solid.velocity)):
        return ()
    measured = known.covers(_frequency(surface, solid))
    if measured.all():
        return ()
    share = abs(float(dissipation(lost * ~measured, surface.shape, surface.spacing) @ solid.toward) / friction)
    said: tuple[Note, ...] = known.beyond_part(share)
    return said


def too_fast(
    surface: PeriodicSurface,
    solid: SlidingSolid,
    lost: Array,
    friction: float,
    clock: float = 1.0,
    where: str = "",
) -> tuple[Note, ...]:
    """Return a note if inertia changes the friction force per area by much, of each wave by the square of its speed.

    The solid's velocity is per time of a clock, which runs so many times as fast as time.
    """

    def slowness(frequency: Array) -> Array:
        """Return the square of one over the speed of shear waves, s²/m²."""
        softness = np.abs(solid.spectrum.compliance(frequency))
        return np.asarray(softness / shear_wave_speed(1.0, solid.poisson_ratio) ** 2)

    speed = clock * math.hypot(*solid.velocity)
    if friction == 0.0 or speed == 0.0 or not math.isfinite(speed):
        return ()
    frequency = _frequency(surface, solid)
    lowest, highest = float(frequency.min(where=frequency > 0.0, initial=math.inf)), float(frequency.max())
    if speed**2 * float(slowness(np.array([lowest]))[0]) <= LITTLE_INERTIA:
        return ()
    known = np.geomspace(lowest, highest, _MODULI)
    part = np.exp(np.interp(np.log(np.maximum(frequency, lowest)), np.log(known), np.log(slowness(known))))
    qx, qy = wave_number(surface.shape, surface.spacing)
    square = qx**2 + qy**2
    square[0, 0] = 1.0
    weighted = lost * (part * (clock * frequency) ** 2 / square)
    change = abs(float(dissipation(weighted, surface.shape, surface.spacing) @ solid.toward) / friction)
    if change <= LITTLE_INERTIA:
        return ()
    return (inertia_note(speed, speed / math.sqrt(change), where=where, frequency="qv"),)


def _frequency(surface: PeriodicSurface, solid: SlidingSolid) -> Array:
    """Return |q·v| of each wave, rad/s; of a motion along an axis, one for all waves across it."""
    qx, qy = wave_number(surface.shape, surface.spacing)
    along = [part * q for part, q in zip(solid.velocity, (qx, qy), strict=True) if part]
    return np.asarray(np.abs(sum(along))) if along else 0.0 * qx


def _on_slopes(surface: PeriodicSurface, pressure: Array, toward: tuple[float, float]) -> tuple[Array, float]:
    """Return the force per area (2,) from the pressure on the slopes, and the rms slope under pressure."""

    def sums(slope: Array, pressure: Array) -> tuple[float, float, int]:
        under = slope[pressure > 0.0]
        return float(np.vdot(pressure, slope)), float(under @ under), under.size

    x, y = (np.sum(surface.on_slopes(axis, sums, pressure), axis=0) for axis in (0, 1))
    # Heights fall where the indenter's surface rises towards the material: ∂h/∂x = −∂z/∂x.
    force = -np.array([x[0], y[0]]) / pressure.size
    return _along_and_across(toward) @ force, math.sqrt((x[1] + y[1]) / max(x[2], 1))  # none on a coarser grid


def _dissipated(
    transfer: ComplexArray | Array, surface: PeriodicSurface, toward: tuple[float, float], pressure: Array
) -> tuple[Array, Array]:
    """Return the same force (2,) from the energy that the solid dissipates, and the `losses`."""
    lost = losses(transfer, surface.shape, scipy.fft.rfft2(pressure, workers=threads_for(pressure.size)))
    return _along_and_across(toward) @ dissipation(lost, surface.shape, surface.spacing), lost


def _along_and_across(toward: tuple[float, float]) -> Array:
    """Return unit vectors along the motion, and across it to the left."""
    return np.array([toward, (-toward[1], toward[0])])


def _load_at_edges(pressure: Array) -> float:
    """Return the share of the load on points beside free ones, whose cells the edges of the contact cut somewhere."""
    loaded = pressure > 0.0
    within = loaded.copy()
    for axis in (0, 1):
        for step in (1, -1):
            within &= np.roll(loaded, step, axis)
    return 1.0 - float(pressure[within].sum()) / float(pressure.sum())


def _forces_on(
    coarser: Coarser, pressure: Array, solid: SlidingSolid, units: _Units, toward: tuple[float, float]
) -> tuple[Array, Array]:
    """Return the force per area (2,) on the next coarser grid, by the pressure on the slopes and by the energy."""
    pressure, surface = (units.depth / units.compliance) * pressure, PeriodicSurface(*coarser)
    transfer = solid.transfer(surface.shape, surface.spacing)
    return _on_slopes(surface, pressure, toward)[0], _dissipated(transfer, surface, toward, pressure)[0]
