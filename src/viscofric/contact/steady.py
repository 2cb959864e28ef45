"""Solve the steady contact of an indenter sliding or rolling over a viscoelastic half-space or layer."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from viscofric.arguments import exactly_one, flag
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.bodies import Layer, contact_notes, half_space_coupling
from viscofric.contact.derivatives.friction import FrictionDerivatives, differentiate
from viscofric.contact.free.assembly import assemble
from viscofric.contact.free.estimates import friction_estimate
from viscofric.contact.free.grids import Extent
from viscofric.contact.free.nested import GivenGrid, find_window, refine
from viscofric.contact.free.problem import COARSEST, Control, Problem
from viscofric.contact.free.scale import Scale, ScaledIndenter
from viscofric.contact.free.stage import Stage
from viscofric.contact.heated import insist_on_heatable, solve_heated
from viscofric.contact.heating import FreeThermalContact
from viscofric.contact.indenters.indenter import (
    SMALL_STRAIN,
    Indenter,
    insist_on_indenter,
    insist_on_round_edges,
)
from viscofric.contact.operators.convolution import SteadyMaterial
from viscofric.contact.operators.layer import ScaledLayer
from viscofric.contact.settings import ContactSettings
from viscofric.contact.solution import ContactSolution
from viscofric.errors import InputError, brief
from viscofric.heat.heating import Heating
from viscofric.notes import Note, Remedy
from viscofric.rheology.material import Material, insist_on_material
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, positive, to_si, velocity

__all__ = ["SMALL_STRAIN", "solve_steady"]

LONGEST_MEMORY = 1e100  # in contact radii; its square must not overflow
LOOSE = 5e-3  # accuracy that grids half as fine as usual mostly reach


@one_blas_thread
def solve_steady(
    material: Material,
    indenter: Indenter,
    *,
    speed: Quantity,
    load: Quantity | None = None,
    indentation: Quantity | None = None,
    temperature: Quantity | None = None,
    accuracy: Quantity = 1e-3,
    tolerance: Quantity | None = None,
    finest: int | None = None,
    window: Sequence[Quantity] | None = None,
    grid: int | None = None,
    indenter_modulus: Quantity | None = None,
    indenter_poisson_ratio: Quantity = 0.3,
    layer: Layer | Quantity | None = None,
    backend: Backend | str = "scipy",
    direction: Sequence[float] = (1.0, 0.0),
    coulomb: Quantity = 0.0,
    derivatives: bool = False,
    heating: Heating | None = None,
) -> ContactSolution:
    """Solve the steady contact of an indenter sliding or rolling over a viscoelastic half-space or layer.

    Parameters
    ----------
    material : Material
        A table of moduli is described by modes fitted to it; the solution's warnings state how well.
    indenter : Indenter
        Ball, Ellipsoid, Cone or HeightMap; for a line contact in plane strain, Cylinder or Profile.  A FlatPunch at a
        speed of zero or infinity only.
    speed : float, str or pint.Quantity
        Velocity along `direction` at which the solid is deformed, m/s.  Zero and infinity are the elastic limits; a
        negative one is motion the other way.
    load : float, str or pint.Quantity, optional
        Normal load, N; of a line contact per unit of length, N/m.  Either it or the indentation is given.
    indentation : float, str or pint.Quantity, optional
        Depth of the indenter's lowest point below the undeformed surface, m; of a line contact it has a meaning on a
        layer under a rigid indenter only.
    temperature : float, str or pint.Quantity, optional
        K if a plain number.  May be left out for a material without a shift law.
    accuracy : float or str
        Largest relative error of the friction coefficient (of 1e-6 a0/R where it is smaller, a0 the Hertz radius at
        E0): grids are refined until its changes from one to the next are small enough.
    tolerance : float or str, optional
        Of the complementarity: largest gap under pressure or overlap without it over the indentation; from 1e-13
        to a thousandth of the accuracy.  1e-8, or less if the accuracy needs it, if not given.  The first grids, which
        only start the others, are solved to a thousandth of the accuracy unless `grid` is given.
    finest : int, optional
        Most cells along the window's longer edge: 2048 if not given, 65536 for a line contact.
    window : three lengths, optional
        Distances from the indenter's axis to the rear, the front and the sides of the window of cells, m (rear and
        front for a line contact); found around the contact if not given.
    grid : int, optional
        Cells along the window's longer edge, from 128, instead of an accuracy, which the error estimates then state (a
        few more, so that the axis lies between two of them and halving leads there); found by the accuracy if not
        given.
    indenter_modulus : float, str or pint.Quantity, optional
        Young's modulus of an elastic indenter, Pa; rigid without it.
    indenter_poisson_ratio : float or str
        Of an elastic indenter.
    layer : Layer, float, str or pint.Quantity, optional
        Thickness and base of the material, or the thickness of a bonded layer, such as ``"2 mm"``; a half-space
        without.
    backend : Backend or str
        Arrays and FFTs to solve with, such as "ducc0" or "torch:cuda"; see `Backend`.
    direction : (float, float)
        Of the motion over the indenter's own axes x and y; its length does not matter.  A line contact moves along
        its x only.
    coulomb : float or str
        Coulomb friction coefficient of a contact that slips everywhere, whose shear changes the pressure; negative
        where the indenter slips over the material against its motion, as in rolling with slip.  Neglected by default.
    derivatives : bool
        Whether to differentiate the friction coefficient by every mode, the glassy modulus, the speed and the load or
        indentation, which doubles the time; not with `coulomb`.
    heating : Heating, optional
        Thermal properties and Coulomb heat: the contact is solved at the temperature to which its own friction heats
        it, at ten to twenty times the cost.  Not with `coulomb`, `derivatives` or a layer.

    Returns
    -------
    ContactSolution

    Raises
    ------
    InputError
        If a value cannot be used, or the contact would be wider than the indenter.
    ConvergenceError
        If the solver fails, the accuracy is not reached on the finest grid, or derivatives are not found.

    Notes
    -----
    Solved in units of the elastic contact at E0, so that the user's units do not matter.  The window is found
    on a coarse grid and the grids are nested: each starts from the coarser one's pressure.

    An elastic indenter is a second half-space, which adds (1 − ν_i²)/E_i to the compliance without memory.

    Coulomb friction μ adds −i μ (1−2ν)/(2(1−ν)) q_x/|q| times its response to each wave of pressure [1]_; on layers the
    factor is another (see `viscofric.contact.bodies`), and does not vanish with ν = ½.  The friction coefficient is
    that of the pressure on the slope of the indenter, without μ itself.  The part of it that changes its sign with the
    slip does not dissipate: it exists on an elastic solid as well.

    A layer yields by the factor Θ(qH) less than a half-space to each wave of pressure (see `Layer`); its influence
    coefficients are as exact.  One hundreds of times thinner than the contact is wide, which no grid resolves, is
    refused (ConvergenceError): it is a foundation.

    References
    ----------
    .. [1] K. L. Johnson, Contact Mechanics (1985), sections 3.7 and 7.2.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> solution = vf.solve_steady(rubber, vf.Ball(radius="10 mm"), speed="1 m/s", load="1 N")
    >>> round(solution.friction_coefficient, 4)
    0.0576
    """
    given: dict[str, Any] = {  # that `ContactSettings` checks and converts
        "accuracy": accuracy, "tolerance": tolerance, "finest": finest, "window": window, "grid": grid,
        "indenter_modulus": indenter_modulus, "indenter_poisson_ratio": indenter_poisson_ratio, "layer": layer,
        "backend": backend, "direction": direction, "coulomb": coulomb,
    }  # fmt: skip
    settings = ContactSettings(**given)
    differentiated = flag(derivatives, "derivatives")
    if differentiated:
        _check_derivatives(velocity(speed), settings)
    if heating is not None:
        if differentiated:
            raise InputError("derivatives = True: not with heating; leave out one of them.", code="not-with-heating")
        held = {"load": load, "indentation": indentation}
        contact = thermal_contact(material, indenter, heating, speed, temperature, settings, **held)
        heated: ContactSolution = solve_heated(contact, settings.accuracy)
        return heated
    solved = _solve(material, indenter, speed, load, indentation, temperature, settings)
    solution = solved.solution()
    return replace(solution, derivatives=solved.derivatives()) if differentiated else solution


def thermal_contact(
    material: Material,
    indenter: Indenter,
    heating: Heating,
    speed: Quantity,
    temperature: Quantity | None,
    settings: ContactSettings,
    **held: Quantity | None,
) -> FreeThermalContact:
    """Return a contact that its own friction heats; `held` is its load or indentation.

    Raises InputError if it cannot be: without α(T), a temperature or motion, with shear, or on a layer.
    """
    insist_on_material(material)
    moving = velocity(speed)
    insist_on_heatable(heating, material, moving, temperature, settings.layer, settings.coulomb)
    assert temperature is not None
    insist_on_indenter(indenter)
    if heating.passes > 0 and indenter.geometry.dimension == 1:
        raise InputError("passes: a line contact leaves no circular track.", code="line-track")

    solve = functools.partial(_isothermal, material, indenter, settings, held)
    line = indenter.geometry.dimension == 1
    return FreeThermalContact(material, heating, to_si(temperature, "K", "temperature"), moving, solve, line=line)


def _isothermal(
    material: Material,
    indenter: Indenter,
    settings: ContactSettings,
    held: dict[str, Quantity | None],
    speed: float,
    kelvin: float,
    accuracy: float,
) -> ContactSolution:
    chosen = replace(settings, accuracy=accuracy)
    return _solve(material, indenter, speed, held["load"], held["indentation"], kelvin, chosen).solution()


@one_blas_thread
def solve_and_differentiate(
    material: Material,
    indenter: Indenter,
    *,
    speed: Quantity,
    load: Quantity,
    temperature: Quantity | None = None,
    **settings: Any,
) -> ContactSolution:
    """Solve a contact as `solve_steady` does with derivatives, but without their error estimate.

    That estimate takes an adjoint solve on each of the last grids; without it, the error is infinite, and one solve
    enough.  The speed is neither zero nor infinite; settings and errors as of `solve_steady`.
    """
    chosen = ContactSettings(**settings)
    _check_derivatives(velocity(speed), chosen)
    solved = _solve(material, indenter, speed, load, None, temperature, chosen)
    return replace(solved.solution(), derivatives=solved.derivatives(with_error=False))


@one_blas_thread
def friction_and_derivatives(
    material: Material, indenter: Indenter, *, speed: float, load: float, accuracy: float, **settings: Any
) -> tuple[float, float, FrictionDerivatives]:
    """Return friction, its error and derivatives of a contact, and nothing else: for fits that solve many of them.

    Arguments as of `solve_steady`, without `indentation`, `temperature` and `derivatives`; the speed is neither zero
    nor infinite.  The derivatives have no error estimate, which takes adjoint solves on three grids: it is infinite.
    """
    chosen = ContactSettings(accuracy=accuracy, **settings)
    _check_derivatives(velocity(speed), chosen)
    solved = _solve(material, indenter, speed, load, None, None, chosen)
    estimate, slope = friction_estimate(solved.stages), solved.scale.slope
    value, error = math.copysign(slope, solved.velocity) * estimate.value, slope * estimate.error
    return value, error, solved.derivatives(with_error=False)


class _Solved(NamedTuple):
    """A contact on nested grids, with the material and the units in which it was solved."""

    material: Material
    indenter: Indenter
    settings: ContactSettings
    velocity: float  # m/s
    temperature: float | None  # K
    spectrum: RetardationSpectrum  # at this temperature
    scale: Scale
    given: dict[str, Any]  # load or indentation, SI
    stages: list[Stage]
    contact: Extent  # along the indenter's own axes, m

    def solution(self) -> ContactSolution:
        """Return the solution in SI units, with its warnings."""
        found = assemble(self.stages, self.scale, self.velocity, self.settings.toward, self.temperature)
        # What was given comes back as it was given, free of the rounding of sums and units.
        found = replace(found, **self.given, coulomb=float(self.settings.coulomb))
        notes = contact_notes(
            self.indenter, self.contact, indentation=found.indentation, load=found.load, speed=self.velocity,
            modes=self.spectrum, poisson_ratio=self.material.poisson_ratio, layer=self.settings.layer,
        )  # fmt: skip
        beyond = _beyond_measured(found, self.material.spectrum, self.spectrum)
        about = *self.material.notes_on_modes, *beyond, *self.material.notes_at(self.temperature)
        return replace(found, warnings=(*notes, *about))

    def derivatives(self, *, with_error: bool = True) -> FrictionDerivatives:
        """Return the derivatives of the friction coefficient; without an error estimate, it is infinite."""
        plane_strain = 1.0 - self.material.poisson_ratio**2
        return differentiate(self.stages, self.scale, self.spectrum, plane_strain, self.velocity, with_error=with_error)


def _solve(
    material: Material,
    indenter: Indenter,
    speed: Quantity,
    load: Quantity | None,
    indentation: Quantity | None,
    temperature: Quantity | None,
    settings: ContactSettings,
) -> _Solved:
    """Solve on nested grids, with arguments as given."""
    insist_on_indenter(indenter)
    insist_on_material(material)
    sliding = velocity(speed)
    kelvin = None if temperature is None else to_si(temperature, "K", "temperature")
    geometry, layer = indenter.geometry, settings.layer
    toward = _toward(settings, indenter)
    spectrum = material.modes_at(temperature)
    plane_strain, counterface = 1.0 - material.poisson_ratio**2, settings.counterface
    compliance = plane_strain / spectrum.E0 + counterface
    levelled = geometry.has_far_field or (layer is not None and counterface == 0.0)
    scale, control, given, held = _held(indenter, 1.0 / compliance, load, indentation, levelled)
    solid = _steady_material(spectrum, abs(sliding) / scale.length, plane_strain / compliance, counterface / compliance)
    if settings.coulomb:
        coupling = half_space_coupling(material.poisson_ratio)
        solid = replace(
            solid, drag=settings.coulomb, coupling=coupling, counterface_coupling=settings.counterface_coupling
        )
    if len(solid.compliances):
        insist_on_round_edges(indenter)
    ahead = math.copysign(1.0, sliding)
    shape = ScaledIndenter(indenter, scale, (ahead * toward[0], ahead * toward[1]))
    loose = settings.accuracy >= LOOSE and settings.grid is None and geometry.dimension > 1
    cells = COARSEST // 2 if loose else COARSEST
    problem = Problem(
        geometry, solid, shape, control, settings.residual, settings.where,
        coarsest=cells, coarse_tolerance=settings.coarse_residual,
    )  # fmt: skip
    if layer is not None:
        scaled = ScaledLayer.of(layer, scale.length, material.poisson_ratio)
        problem = replace(problem, geometry=scaled.geometry(geometry, counterface), layer=scaled)
    given_grid = GivenGrid.of(settings.window, settings.grid, scale)
    first = find_window(problem, problem.first_size)
    indenter.check(shape.extent(first.window, first.result.pressure > 0.0), held, next(iter(given)))
    given_grid.check(first.extent, first.window.spacing, scale.length)
    finest = geometry.finest if settings.finest is None else settings.finest
    stages = refine(first, settings.accuracy, finest, given_grid)
    contact = shape.extent(stages[-1].window, stages[-1].result.pressure > 0.0)
    return _Solved(material, indenter, settings, sliding, kelvin, spectrum, scale, given, stages, contact)


def _toward(settings: ContactSettings, indenter: Indenter) -> tuple[float, float]:
    if settings.toward[1] != 0.0 and indenter.geometry.dimension == 1:
        raise InputError(
            f"direction = {brief(settings.direction)}: a {indenter.noun} makes a line contact, which moves along x "
            "only; give (1.0, 0.0) or (-1.0, 0.0).",
            code="line-direction",
        )
    return settings.toward


def _check_derivatives(velocity: float, settings: ContactSettings) -> None:
    if settings.coulomb != 0.0:
        raise InputError(
            f"coulomb = {settings.coulomb:g}: derivatives of the friction are found without shear only; leave coulomb "
            "out, or derivatives and samples of the material.",
            code="no-derivatives",
        )
    if velocity == 0.0 or math.isinf(velocity):
        raise InputError(
            f"derivatives = True: an elastic limit, speed = {velocity:g}, has no friction to differentiate; "
            "give a speed other than zero and infinity.",
            code="elastic-limit",
        )


def _held(
    indenter: Indenter, stiffness: float, load: Quantity | None, indentation: Quantity | None, levelled: bool
) -> tuple[Scale, Control, dict[str, Any], str]:
    """Return the units, what is given in them, in SI, and in words."""
    geometry = indenter.geometry
    exactly_one(load=load, indentation=indentation)
    if load is not None:
        force = positive(load, geometry.load_unit, "load")
        control = Control(load=geometry.parabolic_load)
        held = f"under {force:g} {geometry.load_unit}"
        return Scale.for_load(indenter, stiffness, force), control, {"load": force}, held
    if not levelled:
        raise InputError(
            f"indentation = {indentation!r}: has no meaning in plane strain, where the surface far away is infinitely "
            f"high above the contact; give the load ({geometry.load_unit}).",
            code="no-level",
        )
    depth = positive(indentation, "m", "indentation")  # type: ignore[arg-type]
    scale = Scale.for_indentation(indenter, stiffness, depth)
    return scale, Control(indentation=1.0), {"indentation": depth}, f"{1e3 * depth:g} mm deep"


def _steady_material(
    spectrum: RetardationSpectrum, speed: float, plane_strain: float, counterface: float
) -> SteadyMaterial:
    """Return compliances relative to the relaxed one and memory lengths v τ_k; one spring in the elastic limits.

    `speed` is in lengths per second; `plane_strain`, 1 − ν² in Pa, and `counterface`, the indenter's part, are over the
    relaxed compliance of both bodies.
    """
    none = np.empty(0)
    if speed == 0.0:
        return SteadyMaterial(plane_strain / spectrum.E0, none, none, counterface)
    glassy = plane_strain / spectrum.E_inf
    if math.isinf(speed) or not len(spectrum.tau):
        return SteadyMaterial(glassy, none, none, counterface)
    if speed > LONGEST_MEMORY / max(spectrum.tau):
        raise InputError(
            f"speed: the memory would be more than {LONGEST_MEMORY:g} contact radii long, so that the solid is elastic "
            "with its glassy modulus; ",
            code="too-fast",
            remedy=Remedy(
                "give an infinite speed (math.inf).", "give 'infinite' as the speed, or a warmer temperature."
            ),
        )
    return SteadyMaterial(glassy, plane_strain * np.asarray(spectrum.C), speed * np.asarray(spectrum.tau), counterface)


def _beyond_measured(
    solution: ContactSolution, known: RetardationSpectrum | ModulusTable, modes: RetardationSpectrum
) -> tuple[Note, ...]:
    """Return a note where the friction rests on modes beyond the measured frequencies, or those of a table.

    A table that extrapolates by itself was told to.
    """
    frequencies = modes.known_frequencies
    if frequencies is None or (not isinstance(known, RetardationSpectrum) and known.extrapolate != "refuse"):
        return ()
    return frequencies.beyond(abs(solution.speed) / (0.5 * (solution.front + solution.rear)))
