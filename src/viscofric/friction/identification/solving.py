"""Contacts solved at nodes for one material, with the derivatives of friction, as the basis of the fit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Unpack

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.settings import ContactOptions
from viscofric.contact.steady import friction_and_derivatives
from viscofric.errors import ConvergenceError
from viscofric.friction.identification.anchors import ContactAnchor, SolvedContact
from viscofric.friction.identification.forward import CorrectedFriction, Solved
from viscofric.friction.identification.problem import Problem
from viscofric.processes import Workers, call_all
from viscofric.rheology.material import Material
from viscofric.rheology.shifts.shift_law import LN10
from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Contacts solved per decade of reduced speed, and decades beyond the points.  The error of the closed form changes so
#: slowly that four per decade interpolate it to 1e-4 of the friction.
NODES_PER_DECADE = 4
BEYOND = 0.15
FEWEST_NODES = 5


@dataclass(frozen=True, eq=False)
class FrictionResponse:
    """Friction coefficients of one material in n contacts, and their derivatives with respect to its m modes."""

    friction: Array  # (n,), viscoelastic friction coefficient
    error: Array  # (n,), its error estimate
    C: Array  # (n, m), ∂μ/∂C_k at fixed E_inf, so that E0 falls as C_k grows, Pa; finite where C_k is zero
    log_C: Array  # noqa: N815 - (n, m), C_k ∂μ/∂C_k likewise; the symbols of the equations
    log_E_inf: Array  # noqa: N815 - (n,), E_inf ∂μ/∂E_inf at fixed C
    log_speed: Array  # (n,), v ∂μ/∂v
    log_load: Array  # (n,), F ∂μ/∂F


def friction_response(
    spectrum: RetardationSpectrum,
    poisson_ratio: float,
    indenter: Indenter,
    speeds: Array,
    load: Array | float,
    *,
    accuracy: float = 1e-3,
    workers: int | Workers = 1,
    progress: Callable[[int, int], object] | None = None,
    **settings: Unpack[ContactOptions],
) -> FrictionResponse:
    """Solve a contact at each speed (n,), m/s, with derivatives of friction by every mode, E_inf, speed and load."""
    # The spectrum is that at the temperature to which the speeds are reduced; the load, N or N/m, is one or (n,).
    # `progress(done, total)` is called after every contact. ConvergenceError names the speed and load that failed.
    material = Material(spectrum, poisson_ratio=poisson_ratio)
    calls = [
        {
            "material": material,
            "indenter": indenter,
            "speed": float(velocity),
            "load": float(force),
            "accuracy": accuracy,
            "settings": settings,
        }
        for velocity, force in np.broadcast(speeds, load)
    ]

    def report(done: int) -> None:
        if progress is not None:
            progress(done, len(calls))

    rows = np.array(call_all(respond, calls, workers=workers, progress=report))
    C = rows[:, 5:]
    return FrictionResponse(
        friction=rows[:, 0],
        error=rows[:, 1],
        C=C,
        log_C=C * spectrum.C,
        log_E_inf=rows[:, 2],
        log_speed=rows[:, 3],
        log_load=rows[:, 4],
    )


def respond(
    material: Material, indenter: Indenter, speed: float, load: float, accuracy: float, settings: ContactOptions
) -> Array:
    """Solve one contact: friction coefficient, its error, its derivatives by ln E_inf, ln v, ln F and each C_k."""
    try:
        friction, error, found = friction_and_derivatives(
            material, indenter, speed=speed, load=load, accuracy=accuracy, **settings
        )
    except ConvergenceError as failure:
        unit = indenter.geometry.load_unit
        raise failure.at(f"speed {speed:g} m/s under {load:g} {unit}") from failure
    logarithmic = found.logarithmic
    return np.array([friction, error, logarithmic.E_inf, logarithmic.speed, logarithmic.load, *found.C])


@dataclass(frozen=True, eq=False)
class Contacts:
    """Settings for solving contacts."""

    indenter: Indenter
    poisson_ratio: float
    load: float  # N or N/m
    workers: int | Workers
    anchors: tuple[ContactAnchor, ...] = ()  # contacts whose size was measured
    # called with the number of the step, the contacts solved in it, and how many it has
    progress: Callable[[int, int, int], object] | None = None

    def solved(self, problem: Problem, unknowns: Array, step: int, accuracy: float) -> Problem:
        """Return the problem with contacts solved for the material of the unknowns; ConvergenceError if one is not."""
        compliances, log_alpha = problem.split(unknowns)
        spectrum = spectrum_of(compliances, problem.smoothness.tau)
        points = problem.points
        reduced = points.log_speed + log_alpha[points.number]
        low, high = reduced.min() - BEYOND * LN10, reduced.max() + BEYOND * LN10
        count = max(FEWEST_NODES, int(np.ceil(NODES_PER_DECADE * (high - low) / LN10)) + 1)
        nodes = np.linspace(low, high, count)
        response = friction_response(
            spectrum,
            self.poisson_ratio,
            self.indenter,
            np.exp(nodes),
            self.load,
            accuracy=accuracy,
            workers=self.workers,
            progress=lambda done, total: None if self.progress is None else self.progress(step, done, total),
        )
        friction = response.friction
        if not np.all(friction > 0.0):
            raise ConvergenceError(
                "the friction of a contact came out negative; solve more accurately.", code="negative-friction"
            )
        by_glass = np.column_stack([-response.log_E_inf, response.log_C])
        solved = Solved(
            compliances,
            nodes,
            np.log(friction),
            response.error / friction,
            by_glass / friction[:, None],
            response.log_load / friction,
        )
        sizes = tuple(
            SolvedContact.of(
                anchor,
                self.indenter,
                spectrum,
                self.poisson_ratio,
                accuracy,
                compliances,
                float(problem.shifts.row(float(anchor.temperature)) @ log_alpha),
            )
            for anchor in self.anchors
        )
        return replace(problem, friction=CorrectedFriction(problem.friction.first, solved), contacts=sizes)


def spectrum_of(compliances: Array, tau: Array) -> RetardationSpectrum:
    """Return the spectrum of ln(1/E_inf) and every ln C."""
    values = np.exp(compliances)
    return RetardationSpectrum(1.0 / float(values.sum()), 1.0 / float(values[0]), values[1:], tau)
