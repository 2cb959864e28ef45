"""The verb: solve the steady contact of an indenter sliding or rolling over a viscoelastic half-space."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.nested import (
    COARSEST,
    FEWEST_GRIDS,
    FRICTION_FLOOR,
    Problem,
    find_window,
    friction_estimate,
    refine,
)
from viscofric.contact.operator import SteadyMaterial
from viscofric.contact.reference import hertz_ball
from viscofric.contact.solution import ContactSolution, Diagnostics, Level, edges
from viscofric.errors import InputError
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, positive, to_si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.indenters import Ball
    from viscofric.contact.nested import Stage
    from viscofric.rheology.material import Material
    from viscofric.rheology.spectra.retardation import RetardationSpectrum

    Array: TypeAlias = NDArray[np.float64]

FINEST = 2048
LEAST_FINEST = COARSEST * 2 ** (FEWEST_GRIDS - 1)
TIGHTEST, LOOSEST = 1e-13, 1e-3  # of the solver's tolerance; the latter relative to the accuracy
SMALL_STRAIN = 0.3  # contact radius over ball radius beyond which linear contact is doubtful


@one_blas_thread
def solve_steady(
    material: Material,
    indenter: Ball,
    *,
    speed: Quantity,
    load: Quantity,
    temperature: Quantity | None = None,
    accuracy: float = 1e-3,
    tolerance: float = 1e-8,
    finest: int = FINEST,
) -> ContactSolution:
    """Solve the steady contact of a rigid ball sliding or rolling over a viscoelastic half-space.

    Parameters
    ----------
    material : Material
    indenter : Ball
    speed : float, str or pint.Quantity
        Velocity along x at which the solid is deformed, m/s.  Zero and infinity are the elastic limits; a
        negative one mirrors the solution.
    load : float, str or pint.Quantity
        Normal load, N.
    temperature : float, str or pint.Quantity, optional
        K if a plain number.  May be left out for a material without a shift law.
    accuracy : float
        Relative error of the friction coefficient that is aimed at (of 1e-6 a0/R where it is smaller, a0 the Hertz
        radius at E0): grids are refined until its changes from one to the next promise as much.
    tolerance : float
        Of the complementarity: largest gap under pressure or overlap without it over the indentation; from 1e-13
        to a thousandth of the accuracy.
    finest : int
        Most cells along the window's longer edge.

    Returns
    -------
    ContactSolution

    Raises
    ------
    InputError
        If a value cannot be used, or the contact would be wider than the ball.
    ConvergenceError
        If the solver fails, or the accuracy is not reached on the finest grid.

    Notes
    -----
    Solved in units of the Hertz contact at E0, so that the user's units do not matter.  The window is found
    on a coarse grid and the grids are nested: each starts from the coarser one's pressure.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> solution = vf.solve_steady(rubber, vf.Ball(radius="10 mm"), speed="1 m/s", load="1 N")
    >>> round(solution.friction_coefficient, 4)
    0.0698
    """
    velocity = _velocity(speed)
    force = positive(load, "N", "load")
    if not 0.0 < accuracy < 1.0:
        raise InputError(f"accuracy = {accuracy!r}: must lie between 0 and 1, such as 1e-3.")
    if not TIGHTEST <= tolerance <= LOOSEST * accuracy:
        raise InputError(
            f"tolerance = {tolerance!r}: must lie between {TIGHTEST:g} and {LOOSEST:g} times the accuracy, "
            f"{LOOSEST * accuracy:g}, so that it does not spoil the friction."
        )
    if finest < LEAST_FINEST:
        raise InputError(f"finest = {finest!r}: must be at least {LEAST_FINEST} cells.")
    kelvin = None if temperature is None else to_si(temperature, "K", "temperature")
    spectrum = material.modes_at(kelvin)
    scale = _Scale.of(spectrum, material.poisson_ratio, indenter, force)
    solid = _steady_material(spectrum, abs(velocity) / scale.length)
    problem = Problem(solid, _ScaledIndenter(indenter, scale), tolerance)
    first = find_window(problem, _effective_modulus(solid))
    _check_width(first, scale, force, indenter)
    stages = refine(first, accuracy, finest)
    return _with_warnings(_assemble(stages, scale, velocity, force, kelvin), indenter)


def _velocity(speed: Quantity) -> float:
    if isinstance(speed, float) and math.isinf(speed):
        return speed
    return to_si(speed, "m/s", "speed")


@dataclass(frozen=True)
class _Scale:
    """Units of the Hertz contact at E0: a0, a0²/R and E0 a0/((1−ν²) R)."""

    length: float
    depth: float
    pressure: float

    @classmethod
    def of(cls, spectrum: RetardationSpectrum, poisson_ratio: float, ball: Ball, load: float) -> _Scale:
        radius = float(ball.radius)
        hertz = hertz_ball(load, radius, spectrum.E0, poisson_ratio)
        pressure = spectrum.E0 / (1.0 - poisson_ratio**2) * hertz.radius / radius
        return cls(hertz.radius, hertz.indentation, pressure)

    @property
    def slope(self) -> float:
        """a0/R, the unit of friction coefficients."""
        return self.depth / self.length


@dataclass(frozen=True)
class _ScaledIndenter:
    """An indenter in units of the Hertz contact."""

    indenter: Ball
    scale: _Scale

    def height(self, x: Array, y: Array) -> Array:
        length, depth = self.scale.length, self.scale.depth
        return self.indenter.height(length * x, length * y) / depth

    def slope(self, x: Array, y: Array) -> Array:
        length = self.scale.length
        return self.indenter.slope(length * x, length * y) / self.scale.slope


def _steady_material(spectrum: RetardationSpectrum, speed: float) -> SteadyMaterial:
    """Compliances relative to 1/E0 and memory lengths v τ_k; equal to one spring in the elastic limits."""
    if speed == 0.0:
        return SteadyMaterial(1.0, np.empty(0), np.empty(0))
    if math.isinf(speed):
        return SteadyMaterial(spectrum.E0 / spectrum.E_inf, np.empty(0), np.empty(0))
    return SteadyMaterial(
        spectrum.E0 / spectrum.E_inf, spectrum.E0 * np.asarray(spectrum.C), speed * np.asarray(spectrum.tau)
    )


def _effective_modulus(solid: SteadyMaterial) -> float:
    """|E(v/a)|/E0 at the contact radius a of Hertz with that modulus: a first guess at the contact's size."""
    radius = 1.0
    for _ in range(30):
        compliance = float(np.abs(solid.symbol(np.array([1.0 / radius])))[0])
        radius = compliance ** (1.0 / 3.0)
    return radius**-3


def _assemble(
    stages: list[Stage], scale: _Scale, velocity: float, load: float, temperature: float | None
) -> ContactSolution:
    """Bring the finest stage back to SI units, mirrored if the indenter moves backwards."""
    fine, coarse = stages[-1], stages[-2]
    result, window = fine.result, fine.window
    pressure, x = scale.pressure * result.pressure, scale.length * window.x
    displacement = scale.depth * fine.displacement
    slope = math.copysign(scale.slope, velocity)
    friction = friction_estimate(stages)
    lean, energy = fine.pressure_friction, fine.energy_friction
    centre = window.beside
    rear, front = edges(x, pressure[:, centre])
    _, side = edges(scale.length * window.y, pressure.max(axis=0))
    if velocity < 0.0:
        x, pressure, displacement = -x[::-1], pressure[::-1], displacement[::-1]
    results = [stage.result for stage in stages]
    products = sum(one.products for one in results)
    linear = sum(one.linear_iterations for one in results)
    return ContactSolution(
        speed=velocity,
        load=load,
        temperature=temperature,
        friction_coefficient=slope * friction.value,
        pressure_friction_coefficient=slope * lean,
        energy_friction_coefficient=slope * energy,
        indentation=scale.depth * result.indentation,
        contact_area=scale.length**2 * window.cell_area * float(np.count_nonzero(result.pressure)),
        front=front,
        rear=-rear,
        half_width=side,
        max_pressure=float(pressure.max()),
        x=x,
        y=scale.length * window.y,
        pressure=pressure,
        displacement=displacement,
        diagnostics=Diagnostics(
            shape=window.shape,
            spacing=scale.length * window.spacing,
            collocation_shift=fine.operator.shift,
            complementarity=result.complementarity,
            load=result.load,
            energy=(lean - energy) / max(abs(lean), abs(energy), FRICTION_FLOOR),
            friction_error=scale.slope * friction.error,
            indentation_error=scale.depth * abs(result.indentation - coarse.result.indentation),
            levels=tuple(
                Level(
                    cells=max(one.window.shape),
                    pressure_friction=slope * one.pressure_friction,
                    energy_friction=slope * one.energy_friction,
                    indentation=scale.depth * one.result.indentation,
                )
                for one in stages
            ),
            set_changes=sum(one.set_changes for one in results),
            linear_iterations=linear,
            products=products,
            ffts=2 * products + 2 * linear,
        ),
    )


def _check_width(first: Stage, scale: _Scale, load: float, ball: Ball) -> None:
    """Refuse a contact wider than the ball before time is spent on refining it."""
    _, _, side = first.window.extent(first.result.pressure > 0.0)
    width, diameter = 2.0 * scale.length * side, 2.0 * float(ball.radius)
    if width > diameter:
        raise InputError(
            f"under {load:g} N the contact would be {1e3 * width:.3g} mm wide, wider than the ball "
            f"({1e3 * diameter:.3g} mm): the material is too soft for this load; lower the load."
        )


def _with_warnings(solution: ContactSolution, ball: Ball) -> ContactSolution:
    ratio = max(solution.front, solution.rear, solution.half_width) / float(ball.radius)
    if ratio <= SMALL_STRAIN:
        return solution
    warning = (
        f"The contact reaches {ratio:.2f} ball radii from the axis; above {SMALL_STRAIN} the assumption of "
        "small strain and of a parabolic ball is doubtful."
    )
    return replace(solution, warnings=(*solution.warnings, warning))
