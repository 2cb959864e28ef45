"""Coulomb friction over time, and the change of friction by its shear, for contacts that are solved without it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.coupling import ShearedContact, SurfaceCoupling, coupling_notes, sheared_compliance
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.motion.mover import Problem
from viscofric.motion.solution import TransientSolution
from viscofric.notes import Note


def contact_sizes(problem: Problem, run: TransientSolution) -> Array:
    """Return the radius of the disc with the area of the contact, or half its width, (n,), m."""
    area = run.contact_area
    return np.asarray(0.5 * area if problem.kind == "line" else np.sqrt(area / np.pi))


def with_coulomb(
    problem: Problem, run: TransientSolution, coulomb: float, every: TransientSolution | None = None
) -> TransientSolution:
    """Return a run with Coulomb friction, and a note where its shear changes friction by too much."""
    # `every` is the same run at every step, where that is known.
    if coulomb == 0.0:
        return run
    after = np.append(np.diff(run.time) > 0.0, True)  # of a time given once at a jump, the values after it
    sides = zip(run.time.tolist(), after.tolist(), strict=True)
    velocity = np.array([problem.schedule.velocity(time, after=side) for time, side in sides]).reshape(-1, 2)
    speed = np.hypot(*velocity.T)
    sliding = (speed > 0.0) & (run.load > 0.0)
    along = np.divide(velocity @ run.direction, speed, out=np.zeros_like(speed), where=sliding)
    notes = _shear_notes(problem, every or run, coulomb)
    return replace(run, interface_friction=coulomb * along, warnings=(*run.warnings, *notes))


def _shear_notes(problem: Problem, run: TransientSolution, coulomb: float) -> tuple[Note, ...]:
    ratio, layer, line = problem.material.poisson_ratio, problem.layer, problem.kind == "line"
    steps = np.hypot(*np.diff(run.position, axis=0).T)
    speed = np.append(steps / np.maximum(np.diff(run.time), 1e-300), 0.0)
    sliding = (speed > 0.0) & (run.contact_area > 0.0) & (run.load > 0.0)
    contacts = []
    if isinstance(problem.indenter, PeriodicSurface):
        surface = SurfaceCoupling.of(problem.indenter, ratio, layer)
        for row in np.flatnonzero(sliding).tolist():
            friction, area, load = (float(one[row]) for one in (run.friction_coefficient, run.contact_area, run.load))
            contacts.append(surface.contact(coulomb, friction, area, load, f"at {run.time[row]:.3g} s"))
    else:
        # The compliance at v/a is that of a contact that has slid by its own size.
        size = contact_sizes(problem, run)
        slid = np.concatenate([[0.0], np.cumsum(steps)]) >= size
        slid &= np.ptp(run.position, axis=0).max() >= size
        for row in np.flatnonzero(sliding & slid).tolist():
            modes = problem.material.modes_at(None if run.temperature is None else float(run.temperature[row]))
            compliance = sheared_compliance(modes, ratio, layer, float(size[row]), float(speed[row]), line=line)
            stress = coulomb * float(run.load[row] / run.contact_area[row])
            friction, where = float(run.friction_coefficient[row]), f"at {run.time[row]:.3g} s"
            contacts.append(ShearedContact(stress, friction, compliance, line, where=where))
    # Friction passes zero where the motion begins or turns: the largest change counts, over the largest friction.
    largest = max((abs(one.friction) for one in contacts), default=0.0)
    worst = max(contacts, key=lambda one: one.change, default=None)
    return () if worst is None else coupling_notes([replace(worst, friction=largest)])
