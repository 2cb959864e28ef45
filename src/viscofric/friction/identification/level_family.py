"""Materials of nearly equal friction: the best-fitting one for each level of the modulus."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from viscofric.errors import ConvergenceError, InputError
from viscofric.friction.identification.moduli import ModulusObservation
from viscofric.friction.identification.posterior import descend
from viscofric.friction.identification.result import LevelFit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from viscofric.friction.identification.drawn_materials import MaterialOf
    from viscofric.friction.identification.iteration import Weighed
    from viscofric.friction.identification.problem import Problem
    from viscofric.friction.identification.solving import Contacts


#: Relative error of a fixed level.
HELD = 1e-3


def level_family(
    best: Weighed,
    contacts: Contacts,
    material_of: MaterialOf,
    middle: float,
    factors: Sequence[float],
    step: int,
) -> tuple[LevelFit, ...]:
    """Fit the friction with |E| held at levels; contacts are solved once for each but the first.

    `middle` is the frequency at the problem's reference, rad/s; `factors`, ascending, are the levels of |E| over that
    of the identified material; `step` numbers the first step of solving contacts.  Levels at which the contacts are not
    solved are left out.
    """
    log_modulus = float(np.log(np.abs(material_of(best.minimum.place).complex_modulus(middle))))
    found: dict[float, LevelFit] = {}
    for way in (sorted(f for f in factors if f >= 1.0), sorted((f for f in factors if f < 1.0), reverse=True)):
        place, last = best.minimum.place, 1.0
        for factor in way:
            start = place.copy()
            start[: best.problem.modes] -= np.log(factor / last)
            held = _held(best, middle, log_modulus + float(np.log(factor)))
            try:
                problem, place = held, descend(held, start, metric=held.metric).place
                if factor != 1.0:
                    problem = contacts.solved(held, place, step + len(found))
                    place = descend(problem, place, metric=problem.metric).place
            except (ConvergenceError, InputError):
                break
            last = factor
            points = problem.observations.points
            away = problem.log_friction(place)[0] - points.log_friction
            everything, _ = replace(problem, observations=best.problem.observations)(place)
            found[factor] = LevelFit(
                factor=float(factor),
                modulus=float(np.exp(log_modulus) * factor),
                material=material_of(place),
                chi2=float(np.sum((away / points.error) ** 2)),
                rms=float(np.sqrt(np.mean(away**2))),
                penalty=float(everything @ everything),
            )
    least = min((one.penalty for one in found.values()), default=0.0)
    return tuple(replace(found[factor], penalty=found[factor].penalty - least) for factor in sorted(found))


def _held(best: Weighed, middle: float, log_modulus: float) -> Problem:
    problem = best.problem
    level = ModulusObservation(
        np.array([np.log(middle)]), problem.shifts.reference, "magnitude", np.array([log_modulus])
    )
    observations = replace(
        problem.observations, moduli=(*problem.observations.moduli, ((level,), np.array([[1.0 / HELD]])))
    )
    return replace(problem, observations=observations)
