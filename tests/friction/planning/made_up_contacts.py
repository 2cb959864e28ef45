"""Cases, and contacts whose numbers are closed forms of the speed instead of solved ones."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

import viscofric as vf
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import ConvergenceError, InputError
from viscofric.friction.cases.indenter_case import IndenterCase
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import Task, solve
from viscofric.friction.planning.plan import Outcome, Plan

BALL = vf.Ball(0.01)
SLS = vf.Material(
    vf.Material.standard_linear_solid(1e6, 1e7, 1e-3).spectrum,
    shift=vf.WLF(C1=8.86, C2=101.6, reference=303.15),
)


def case_of(
    speed: float, temperature: float = 303.15, load: float = 0.05, indenter: Indenter = BALL, **others: Any
) -> IndenterCase:
    """Return a contact asked for, in all that matters to few as it mostly is."""
    return IndenterCase(0, indenter, temperature, speed, load, **others)


def bell(x: float) -> float:
    """Return a friction curve with a maximum, over the unit of slope."""
    return 0.4 / (math.exp(0.5 * x) + math.exp(-0.8 * x)) + 1e-3


def made_up(task: Task, curve: Callable[[float], float] = bell) -> Record:
    """Numbers of a contact of one mode that depend on vτ/a0 only, but for units; made up."""
    asked = task.arguments
    modes, indenter, speed, load = asked["modes"], asked["indenter"], asked["speed"], asked["load"]
    assert isinstance(indenter, vf.Ball)
    stiffness, radius = modes.E0 / (1.0 - asked["poisson_ratio"] ** 2), float(indenter.radius)  # type: ignore[arg-type]
    length = (0.75 * load * radius / stiffness) ** (1.0 / 3.0)  # Hertz
    scale = Scale(indenter.geometry, length, length**2 / radius, stiffness)
    memory = speed * float(modes.tau[0]) / scale.length
    friction, opened = curve(math.log(memory)), 1.0 / (1.0 + memory)
    return Record.of(
        speed=speed,
        temperature=asked["temperature"],
        load=load,
        friction_coefficient=scale.slope * friction,
        friction_error=1e-6 * scale.slope * friction,
        indentation=scale.depth * (0.5 + opened),
        indentation_error=1e-6 * scale.depth,
        contact_area=scale.area * (0.5 + opened),
        contact_area_error=1e-6 * scale.area,
        front=scale.length * (0.5 + opened),
        rear=scale.length * (opened - 0.5),
        half_width=scale.length * (0.5 + opened),
        edge_error=1e-6 * scale.length,
        max_pressure=scale.pressure / (0.5 + opened),
        max_pressure_error=1e-6 * scale.pressure,
        centre_of_pressure=scale.length * friction,
        energy_balance=1e-6,
        complementarity=1e-9,
        cells=128,
        products=100,
    )


def solved(task: Task) -> Outcome:
    """Tell what becomes of a task that is really solved."""
    try:
        return solve(task)
    except (ConvergenceError, InputError) as error:
        return Failure(str(error), task.label)


def carry_out(
    plan: Plan, answer: Callable[[Task], Outcome] = made_up, order: np.random.Generator | None = None
) -> list[list[str]]:
    """Answer all that a plan wants, wave by wave, in its own order or in any; the keys of every wave."""
    waves = []
    while tasks := plan.wanted():
        waves.append(sorted(task.key for task in tasks))
        for row in range(len(tasks)) if order is None else order.permutation(len(tasks)):
            plan.receive(tasks[row].key, answer(tasks[row]))
    return waves
