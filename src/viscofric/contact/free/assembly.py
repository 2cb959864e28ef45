"""From nested solutions in units of the Hertz contact to one solution in SI units."""

from __future__ import annotations

import math

from viscofric.contact.free.estimates import FRICTION_FLOOR, Estimate, FootprintErrors, error_of, friction_estimate
from viscofric.contact.free.scale import Scale
from viscofric.contact.free.stage import Stage
from viscofric.contact.solution import ContactSolution, Diagnostics, Level


def assemble(
    stages: list[Stage], scale: Scale, velocity: float, direction: tuple[float, float], temperature: float | None
) -> ContactSolution:
    """Return the solution of the finest stage in SI units, without warnings, reversed if the indenter moves backwards.

    `stages` are coarsest first; `velocity`, m/s, is along `direction`, of length one; `temperature` in K.
    """
    fine, window = stages[-1], stages[-1].window
    pressure = scale.pressure * fine.result.pressure
    x, y = scale.length * window.x, scale.length * window.y
    displacement = scale.depth * fine.displacement
    slope, friction = math.copysign(scale.slope, velocity), friction_estimate(stages)
    if velocity < 0.0:
        x, y = -x[::-1], -y[::-1]
        pressure, displacement = pressure[::-1, ::-1], displacement[::-1, ::-1]
    return ContactSolution(
        speed=velocity,
        load=scale.force * fine.load,
        temperature=temperature,
        friction_coefficient=slope * friction.value,
        pressure_friction_coefficient=slope * fine.pressure_friction,
        energy_friction_coefficient=slope * fine.energy_friction,
        indentation=scale.depth * fine.indentation,
        contact_area=scale.area * fine.footprint.area,
        front=scale.length * fine.footprint.front,
        rear=scale.length * fine.footprint.rear,
        half_width=scale.length * fine.footprint.side,
        max_pressure=scale.pressure * fine.footprint.peak,
        x=x,
        y=y,
        pressure=pressure,
        displacement=displacement,
        diagnostics=_diagnostics(stages, scale, slope, friction),
        geometry=scale.geometry.name,
        direction=direction,
        lateral_friction_coefficient=slope * fine.lateral_friction,
    )


def _diagnostics(stages: list[Stage], scale: Scale, slope: float, friction: Estimate) -> Diagnostics:
    fine = stages[-1]
    results = [stage.result for stage in stages]
    products = sum(one.products for one in results)
    linear = sum(one.linear_iterations for one in results)
    pressure, energy = fine.pressure_friction, fine.energy_friction
    errors = FootprintErrors.of(stages)
    loaded = fine.problem.control.load is not None
    # The reference level of an indentation may be that of the leading edge, and is as uncertain as that edge.
    indentation = max(error_of(stages, "indentation"), fine.level_slope * errors.edge)
    return Diagnostics(
        shape=fine.window.shape,
        spacing=scale.length * fine.window.spacing,
        collocation_shift=fine.operator.shift,
        complementarity=fine.result.complementarity,
        load=fine.result.load,
        energy=(pressure - energy) / max(abs(pressure), abs(energy), FRICTION_FLOOR),
        friction_error=scale.slope * friction.error,
        indentation_error=scale.depth * (indentation if loaded else 0.0),
        load_error=scale.force * (0.0 if loaded else error_of(stages, "load")),
        edge_error=scale.length * errors.edge,
        contact_area_error=scale.area * errors.area,
        max_pressure_error=scale.pressure * errors.peak,
        centre_of_pressure_error=scale.length * error_of(stages, "centre_of_pressure"),
        peak_resolved=errors.peak_resolved,
        levels=tuple(
            Level(
                cells=max(one.window.shape),
                pressure_friction=slope * one.pressure_friction,
                energy_friction=slope * one.energy_friction,
                indentation=scale.depth * one.indentation,
                products=one.result.products,
            )
            for one in stages
        ),
        set_changes=sum(one.set_changes for one in results),
        linear_iterations=linear,
        products=products,
        ffts=2 * products + 2 * linear,
    )
