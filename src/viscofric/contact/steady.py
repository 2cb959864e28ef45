"""The verb: solve the steady contact of an indenter sliding or rolling over a viscoelastic half-space."""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from viscofric.contact.complementarity import ComplementaritySolution, solve_complementarity
from viscofric.contact.grids import Window, touches_edge
from viscofric.contact.operator import HalfSpaceOperator, SteadyMaterial
from viscofric.contact.reference import hertz_ball
from viscofric.contact.solution import ContactSolution, Diagnostics, edges
from viscofric.errors import ConvergenceError, InputError
from viscofric.threads import one_blas_thread
from viscofric.units import Quantity, positive, to_si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from viscofric.contact.indenters import Ball
    from viscofric.rheology.material import Material
    from viscofric.rheology.spectrum import RetardationSpectrum

    Array: TypeAlias = NDArray[np.float64]

logger = logging.getLogger(__name__)

COARSEST = 32  # cells along the longer edge of the window on the coarsest grid
FINEST = 2048
MARGIN = 0.15  # free space left around the contact, relative to its size
SMALL_STRAIN = 0.3  # contact radius over ball radius beyond which linear contact is doubtful

# Friction is resolved relative to its own value, but not below this fraction of a0/R.
_FRICTION_FLOOR = 1e-6
# Step of the continuation in the glassy compliance, which leads into the hard corner (one mode, E∞ >> E0).
_CONTINUATION = 1.4
_LONGEST_CONTINUATION = 64


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
        Relative error of the friction coefficient that is aimed at (though not below 1e-6 a0/R, a0 the Hertz
        radius at E0): grids are refined until the last step changes it by less, and the energy balance
        agrees as well.
    tolerance : float
        Of the complementarity: largest gap under pressure or overlap without it over the indentation.
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
    kelvin = None if temperature is None else to_si(temperature, "K", "temperature")
    spectrum = material.at(kelvin)
    scale = _Scale.of(spectrum, material.poisson_ratio, indenter, force)
    solid = _steady_material(spectrum, abs(velocity) / scale.length)
    stages = _nested_solutions(
        solid, _effective_modulus(spectrum, abs(velocity) / scale.length), accuracy, tolerance, finest
    )
    solution = _assemble(stages, scale, velocity, force, kelvin)
    _check_geometry(solution, indenter)
    return _with_warnings(solution, indenter)


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


# The load in these units.
_LOAD = 4.0 / 3.0


def _steady_material(spectrum: RetardationSpectrum, speed: float) -> SteadyMaterial:
    """Compliances relative to 1/E0 and memory lengths v τ_k; equal to one spring in the elastic limits."""
    if speed == 0.0:
        return SteadyMaterial(1.0, np.empty(0), np.empty(0))
    if math.isinf(speed):
        return SteadyMaterial(spectrum.E0 / spectrum.E_inf, np.empty(0), np.empty(0))
    return SteadyMaterial(
        spectrum.E0 / spectrum.E_inf, spectrum.E0 * np.asarray(spectrum.C), speed * np.asarray(spectrum.tau)
    )


def _effective_modulus(spectrum: RetardationSpectrum, speed: float) -> float:
    """|E(v/a)|/E0 at the contact radius a of Hertz with that modulus: a first guess at the contact's size."""
    solid = _steady_material(spectrum, speed)
    radius = 1.0
    for _ in range(30):
        compliance = float(np.abs(solid.symbol(np.array([1.0 / radius])))[0])
        radius = compliance ** (1.0 / 3.0)
    return radius**-3


@dataclass(frozen=True, eq=False)
class _Stage:
    """A converged solution on one grid, in units of the Hertz contact at E0."""

    window: Window
    operator: HalfSpaceOperator
    result: ComplementaritySolution

    @property
    def friction(self) -> float:
        pressure = self.result.pressure
        return self.window.cell_area * float(self.window.x @ pressure.sum(axis=1)) / _LOAD

    @property
    def energy_friction(self) -> float:
        return self.operator.dissipated_force(self.result.pressure) / _LOAD


def _nested_solutions(
    solid: SteadyMaterial, modulus: float, accuracy: float, tolerance: float, finest: int
) -> list[_Stage]:
    """Solve on nested grids until the friction changes by less than the accuracy asked for."""
    stages = [_find_window(solid, modulus, tolerance)]
    while True:
        coarse = stages[-1]
        window = coarse.window.refined()
        if max(window.shape) > finest:
            raise ConvergenceError(
                f"the friction coefficient is known to {_friction_error(stages):.1e} of itself on the finest grid "
                f"allowed ({finest} cells); ask for a lower accuracy than {accuracy:g} or allow a finer grid."
            )
        stage = _solve_on(window, solid, coarse.window.resample(coarse.result.pressure, window), tolerance)
        if touches_edge(stage.result.pressure > 0.0):
            # The coarse contact was a little too small: start again from a window around the finer one.
            stages = [_solve_in_window(_around(stage), solid, stage, tolerance)]
            continue
        stages.append(stage)
        logger.debug("grid %s: friction %.6g, %d products", window.shape, stage.friction, stage.result.products)
        if _friction_error(stages) <= accuracy:
            return stages


def _friction_error(stages: list[_Stage]) -> float:
    """Relative error of the friction: its last change, or its distance from the energy balance if larger."""
    if len(stages) < 2:
        return math.inf
    fine, coarse = stages[-1], stages[-2]
    error = max(abs(fine.friction - coarse.friction), abs(fine.friction - fine.energy_friction))
    return error / max(abs(fine.friction), _FRICTION_FLOOR)


def _find_window(solid: SteadyMaterial, modulus: float, tolerance: float) -> _Stage:
    """Solve on coarse grids until the window fits the contact: nothing cut off, little space wasted."""
    radius = modulus ** (-1.0 / 3.0)
    window = Window.around(1.5 * radius, 1.5 * radius, 1.5 * radius, COARSEST)
    guess = np.sqrt(np.maximum(0.0, 1.0 - (window.x[:, None] ** 2 + window.y**2) / radius**2))
    stage = _solve_on(window, solid, guess, tolerance)
    for _ in range(20):
        loaded = stage.result.pressure > 0.0
        if touches_edge(loaded):
            old = stage.window
            size = old.spacing * max(old.shape)
            rear, front, side = old.spacing * old.behind, old.spacing * old.ahead, old.spacing * old.beside
            window = Window.around(rear + 0.3 * size, front + 0.3 * size, side + 0.3 * size, COARSEST)
        else:
            window = _around(stage)
            if window.spacing > 0.8 * stage.window.spacing:
                return stage
        stage = _solve_in_window(window, solid, stage, tolerance)
    raise ConvergenceError("no window was found that holds the contact; the indenter may be too blunt.")


def _around(stage: _Stage) -> Window:
    rear, front, side = stage.window.extent(stage.result.pressure > 0.0)
    margin = MARGIN * max(rear + front, 2.0 * side)
    return Window.around(rear + margin, front + margin, side + margin, COARSEST)


def _solve_in_window(window: Window, solid: SteadyMaterial, before: _Stage, tolerance: float) -> _Stage:
    return _solve_on(window, solid, before.window.resample(before.result.pressure, window), tolerance)


def _solve_on(window: Window, solid: SteadyMaterial, guess: Array, tolerance: float) -> _Stage:
    """Solve on one grid; where that fails, come from a material with a softer glassy state."""
    height = 0.5 * (window.x[:, None] ** 2 + window.y**2)
    load = _LOAD / window.cell_area

    def attempt(glassy: float, start: Array) -> _Stage:
        operator = HalfSpaceOperator(window, replace(solid, glassy=glassy))
        return _Stage(window, operator, solve_complementarity(operator, height, load, start, tolerance=tolerance))

    stage = attempt(solid.glassy, guess)
    if stage.result.converged:
        return stage
    glassy, factor, good = 0.1, _CONTINUATION, guess
    for _ in range(_LONGEST_CONTINUATION):
        stage = attempt(glassy, good)
        if stage.result.converged:
            if glassy <= solid.glassy:
                return stage
            good, reached = stage.result.pressure, glassy
            glassy = max(solid.glassy, reached / factor)
        elif glassy >= 0.1:
            break
        else:
            factor = math.sqrt(factor)
            glassy = max(solid.glassy, glassy * factor)
    raise ConvergenceError(
        f"the contact did not converge on a grid of {window.shape[0]} x {window.shape[1]} cells: after "
        f"{stage.result.products} products a gap of {stage.result.complementarity:.1e} of the indentation was "
        f"left where {tolerance:.0e} was asked for."
    )


def _assemble(
    stages: list[_Stage], scale: _Scale, velocity: float, load: float, temperature: float | None
) -> ContactSolution:
    """Bring the finest stage back to SI units, mirrored if the indenter moves backwards."""
    fine, coarse = stages[-1], stages[-2]
    result, window = fine.result, fine.window
    pressure, displacement, x = (
        scale.pressure * result.pressure,
        scale.depth * result.displacement,
        scale.length * window.x,
    )
    friction, energy_friction = scale.slope * fine.friction, scale.slope * fine.energy_friction
    centre = window.beside
    rear, front = edges(x, pressure[:, centre])
    _, side = edges(scale.length * window.y, pressure.max(axis=0))
    if velocity < 0.0:
        x, pressure, displacement = -x[::-1], pressure[::-1], displacement[::-1]
        friction, energy_friction = -friction, -energy_friction
    larger = max(abs(friction), abs(energy_friction), _FRICTION_FLOOR * scale.slope)
    results = [stage.result for stage in stages]
    products = sum(one.products for one in results)
    linear = sum(one.linear_iterations for one in results)
    return ContactSolution(
        speed=velocity,
        load=load,
        temperature=temperature,
        friction_coefficient=friction,
        energy_friction_coefficient=energy_friction,
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
            complementarity=result.complementarity,
            load=result.load,
            energy=(friction - energy_friction) / larger,
            friction_error=scale.slope * _friction_error(stages) * max(abs(fine.friction), _FRICTION_FLOOR),
            indentation_error=scale.depth * abs(result.indentation - coarse.result.indentation),
            levels=tuple(
                (
                    max(one.window.shape),
                    math.copysign(scale.slope, velocity) * one.friction,
                    scale.depth * one.result.indentation,
                )
                for one in stages
            ),
            set_changes=sum(one.set_changes for one in results),
            linear_iterations=linear,
            products=products,
            ffts=2 * products + 2 * linear,
        ),
    )


def _check_geometry(solution: ContactSolution, ball: Ball) -> None:
    radius = float(ball.radius)
    if solution.half_width > radius:
        raise InputError(
            f"under {solution.load:g} N the contact would be {2e3 * solution.half_width:.3g} mm wide, wider than "
            f"the ball ({2e3 * radius:.3g} mm): the material is too soft for this load; lower the load."
        )


def _with_warnings(solution: ContactSolution, ball: Ball) -> ContactSolution:
    ratio = solution.half_width / float(ball.radius)
    if ratio <= SMALL_STRAIN:
        return solution
    warning = (
        f"The contact's half-width is {ratio:.2f} of the ball's radius; above {SMALL_STRAIN} the assumption of "
        "small strain and of a parabolic ball is doubtful."
    )
    return replace(solution, warnings=(*solution.warnings, warning))
