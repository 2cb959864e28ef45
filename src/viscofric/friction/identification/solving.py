"""Contacts solved at nodes for one material, with the derivatives of friction, as the basis of the fit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
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


def respond(material: Material, indenter: Indenter, speed: float, load: float, accuracy: float) -> Array:
    """Solve one contact: friction coefficient, its error, its derivatives by ln F, ln(1/E_inf) and each ln C."""
    try:
        friction, error, found = friction_and_derivatives(material, indenter, speed=speed, load=load, accuracy=accuracy)
    except ConvergenceError as failure:
        unit = indenter.geometry.load_unit
        raise failure.at(f"speed {speed:g} m/s under {load:g} {unit}") from failure
    logarithmic = found.logarithmic
    return np.array([friction, error, logarithmic.load, -logarithmic.E_inf, *(found.C * material.modes_at().C)])


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
        material = Material(spectrum, poisson_ratio=self.poisson_ratio)
        points = problem.points
        reduced = points.log_speed + log_alpha[points.number]
        low, high = reduced.min() - BEYOND * LN10, reduced.max() + BEYOND * LN10
        count = max(FEWEST_NODES, int(np.ceil(NODES_PER_DECADE * (high - low) / LN10)) + 1)
        solved = self.at(compliances, material, np.linspace(low, high, count), step, accuracy)
        alphas = [float(problem.shifts.row(float(one.temperature)) @ log_alpha) for one in self.anchors]
        sizes = tuple(
            SolvedContact.of(anchor, self.indenter, material, accuracy, compliances, alpha)
            for anchor, alpha in zip(self.anchors, alphas, strict=True)
        )
        return replace(problem, friction=CorrectedFriction(problem.friction.first, solved), contacts=sizes)

    def at(self, compliances: Array, material: Material, log_speed: Array, step: int, accuracy: float) -> Solved:
        """Return the contacts at each ln v (k,), m/s, of a material of these `compliances`."""
        common = {"material": material, "indenter": self.indenter, "load": float(self.load), "accuracy": accuracy}
        calls = [common | {"speed": speed} for speed in np.exp(log_speed).tolist()]

        def report(done: int) -> None:
            if self.progress is not None:
                self.progress(step, done, len(calls))

        rows = np.array(call_all(respond, calls, workers=self.workers, progress=report))
        friction = rows[:, :1]
        if not np.all(friction > 0.0):
            raise ConvergenceError(
                "the friction of a contact came out negative; solve more accurately.", code="negative-friction"
            )
        relative = rows[:, 1:] / friction
        error, load_slope = relative[:, 0], relative[:, 1]
        return Solved(compliances, log_speed, np.log(friction[:, 0]), error, relative[:, 2:], load_slope)


def spectrum_of(compliances: Array, tau: Array) -> RetardationSpectrum:
    """Return the spectrum of ln(1/E_inf) and every ln C."""
    values = np.exp(compliances)
    return RetardationSpectrum(1.0 / float(values.sum()), 1.0 / float(values[0]), values[1:], tau)
