"""Contacts solved at nodes for one material, with the derivatives of friction; the fit is made about them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Unpack

import numpy as np

from viscofric.contact.indenters.indenter import Indenter, insist_on_indenter
from viscofric.contact.steady import friction_and_derivatives
from viscofric.errors import ConvergenceError, InputError
from viscofric.friction.identification.anchors import SolvedContact
from viscofric.friction.identification.forward import CorrectedFriction, Solved
from viscofric.processes import Workers, call_all
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import Quantities, positive, to_si_array

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.arrays import Array
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.contact.settings import ContactOptions
    from viscofric.friction.identification.anchors import ContactAnchor
    from viscofric.friction.identification.problem import Problem
    from viscofric.processes import Workers


#: Contacts that are solved per decade of reduced speed, and how far beyond the points, decades.  What the closed form
#: misses changes so slowly that four per decade carry it to 1e-4 of the friction.
NODES_PER_DECADE = 4
BEYOND = 0.15
FEWEST_NODES = 5
LN10 = float(np.log(10.0))


@dataclass(frozen=True, eq=False)
class FrictionResponse:
    """Friction coefficients of one rubber in n contacts, and their derivatives with respect to its m modes.

    Attributes
    ----------
    speed : (n,) array
        m/s.
    load : (n,) array
        N; of a line contact, N/m.
    friction : (n,) array
        Viscoelastic friction coefficient.
    error : (n,) array
        Its error estimate.
    C : (n, m) array
        ∂μ/∂C_k at fixed E_inf, so that E0 falls as C_k grows; Pa.  Finite where C_k is zero.
    log_C : (n, m) array
        C_k ∂μ/∂C_k, likewise.
    log_E_inf : (n,) array
        E_inf ∂μ/∂E_inf at fixed C.
    log_speed, log_load : (n,) array
        v ∂μ/∂v and F ∂μ/∂F.
    """

    speed: Array
    load: Array
    friction: Array
    error: Array
    C: Array
    log_C: Array  # noqa: N815 - the symbols of the equations
    log_E_inf: Array  # noqa: N815
    log_speed: Array
    log_load: Array


def friction_response(
    spectrum: RetardationSpectrum,
    poisson_ratio: float,
    indenter: Indenter,
    speeds: Quantities,
    load: Quantities,
    *,
    accuracy: float = 1e-3,
    workers: int | Workers = 1,
    progress: Callable[[int, int], object] | None = None,
    **settings: Unpack[ContactOptions],
) -> FrictionResponse:
    """Solve a contact at each of the speeds, with the derivatives of friction by every mode, E_inf, speed and load.

    Parameters
    ----------
    spectrum : RetardationSpectrum
        Of m modes, at the temperature to which the speeds are reduced.
    poisson_ratio : float
        Of the rubber.
    indenter : Indenter
    speeds : (n,) array, or text or quantities
        (Reduced) speeds at which the rubber is deformed, above zero; m/s.
    load : float or (n,) array, or text or quantities
        Normal load, the same at all speeds or one for each; N, of a line contact N/m.
    accuracy : float
        Relative error of each friction coefficient that is aimed at; see `solve_steady`.
    workers : int or Workers
        Processes that solve contacts, or `viscofric.processes.Workers` that are kept for more; the result does not
        depend on them.
    progress : callable, optional
        Called as ``progress(done, total)`` after every contact.
    **settings
        Of `solve_steady`, the same for all contacts, such as `layer`.

    Returns
    -------
    FrictionResponse

    Raises
    ------
    InputError
        If a value cannot be used.
    ConvergenceError
        If a contact or its derivatives cannot be solved; the message names its speed and load.

    Examples
    --------
    >>> import viscofric as vf
    >>> from viscofric.friction.identification.solving import friction_response
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> ball = vf.Ball(radius="9.525 mm")
    >>> response = friction_response(rubber.modes_at("60 degC"), 0.5, ball, ["20 mm/s", "200 mm/s"], "25 N")
    >>> response.friction.round(3)
    array([0.025, 0.016])
    >>> response.log_speed.round(3)
    array([-0.004, -0.003])
    """
    insist_on_indenter(indenter)
    velocities, forces = contacts(indenter, speeds, load)
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
        for velocity, force in zip(velocities, forces, strict=True)
    ]

    def report(done: int) -> None:
        if progress is not None:
            progress(done, len(calls))

    rows = np.array(call_all(respond, calls, workers=workers, progress=report))
    C = rows[:, 5:]
    return FrictionResponse(
        speed=velocities,
        load=forces,
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
        raise ConvergenceError(f"speed {speed:g} m/s under {load:g} {unit}: {failure}") from failure
    logarithmic = found.logarithmic
    return np.array([friction, error, logarithmic.E_inf, logarithmic.speed, logarithmic.load, *found.C])


def contacts(indenter: Indenter, speeds: Quantities, load: Quantities) -> tuple[Array, Array]:
    """Return the speed and the load of every contact."""
    velocities = to_si_array(speeds, "m/s", "speeds")
    forces = to_si_array(load, indenter.geometry.load_unit, "load")
    if not velocities.size:
        raise InputError("speeds must hold at least one value.")
    if not np.all(velocities > 0.0):
        raise InputError(f"speeds must be above zero everywhere, but one is {velocities.min():g} m/s.")
    if forces.size not in (1, velocities.size):
        raise InputError(
            f"load holds {forces.size} values: must hold one, or one for each of {velocities.size} speeds."
        )
    for force in forces:
        positive(float(force), indenter.geometry.load_unit, "load")
    return velocities, np.broadcast_to(forces, velocities.shape).copy()


@dataclass(frozen=True, eq=False)
class Contacts:
    """How contacts are solved.

    Attributes
    ----------
    indenter : Indenter
    poisson_ratio : float
    load : float
        N or N/m.
    accuracy : float
    workers : int or Workers
    anchors : tuple of ContactAnchor
        Contacts whose size was measured.
    progress : callable or None
        Called with the number of the step, and how many of how many contacts are solved in it.
    """

    indenter: Indenter
    poisson_ratio: float
    load: float
    accuracy: float
    workers: int | Workers
    anchors: tuple[ContactAnchor, ...] = ()
    progress: Callable[[int, int, int], object] | None = None

    def solved(self, problem: Problem, unknowns: Array, step: int) -> Problem:
        """Return the problem with contacts solved for the rubber that the unknowns describe.

        Raises
        ------
        ConvergenceError
            If a contact is not solved.
        """
        compliances, log_alpha = problem.split(unknowns)
        spectrum = spectrum_of(compliances, problem.smoothness.tau)
        points = problem.observations.points
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
            accuracy=self.accuracy,
            workers=self.workers,
            progress=lambda done, total: None if self.progress is None else self.progress(step, done, total),
        )
        friction = response.friction
        if not np.all(friction > 0.0):
            raise ConvergenceError("the friction of a contact came out negative; solve more accurately.")
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
                self.accuracy,
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
