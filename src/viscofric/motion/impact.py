"""Solve the impact of an indenter of given mass: restitution, contact time, largest force and depth."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viscofric.arguments import whole_number
from viscofric.arrays import Array
from viscofric.contact.bodies import indenter_compliance, lag_of_waves, waves_notes
from viscofric.contact.free.grids import Extent
from viscofric.contact.indenters.indenter import Indenter, insist_on_indenter
from viscofric.errors import ConvergenceError, InputError, wrong_argument
from viscofric.motion.bounce import Bounce
from viscofric.motion.impact_solution import ImpactContact, ImpactSolution, RestitutionCurve
from viscofric.motion.memory import Modes
from viscofric.motion.solution import TransientErrors, TransientSolution
from viscofric.motion.springs import Springs, impact_radius, is_body_of_revolution, profile, row
from viscofric.notes import Note, counted
from viscofric.rheology.material import Material, insist_on_material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.threads import one_blas_thread
from viscofric.units import Quantities, Quantity, number, plain, positive, to_si, to_si_array

TIGHTEST, LOOSEST = 1e-6, 1e-2  # accuracies
#: Springs in the contact for an accuracy of 1e-4, and their maximum number; N springs give a force error of 0.4/N².
_SPRINGS, _MOST_SPRINGS, _OF_SPRINGS = 250, 2500, 0.4
#: Steps of a contact in the first run that counts; the following ones halve them, and the last two are extrapolated.
_STEPS, _LEAST_DIVISION, _HALVINGS = 120, 3, 5
#: Largest contact radius, over that on an elastic half-space of E0.
_MARGIN = 1.03
_MOST_CONTACTS = 1000
#: First step over the time to the depth on an elastic half-space of E∞, and shortest time that the modes resolve.
_FIRST, _RESOLVED = 0.015, 1e-3
#: Part of the largest indentation, less of which is left where an indenter that stays nearly leaves.
_NEAR = 0.01
#: Frequencies of a force, over that of a half-sine as long as the contact.
_HARMONICS = np.geomspace(0.01, 50.0, 120)
#: Error of the compliance by modes that are merged, as a part of the accuracy.
_MERGING = 0.1


@one_blas_thread
def solve_impact(
    material: Material,
    indenter: Indenter,
    *,
    mass: Quantity,
    speed: Quantity,
    gravity: Quantity = 0.0,
    rebounds: int = 1,
    temperature: Quantity | None = None,
    accuracy: Quantity = 1e-4,
    indenter_modulus: Quantity | None = None,
    indenter_poisson_ratio: float = 0.3,
) -> ImpactSolution:
    """Solve the impact of an indenter of given mass on a half-space, and its rebounds.

    The indenter moves along its axis and does not rotate.  The inertia of the half-space is left out; a note
    (`quasi-static`) has its effect if the waves take more than 5 % of the energy of the first rebound.

    Parameters
    ----------
    material : Material
        A table of moduli is replaced by retardation modes fitted to it.
    indenter : Indenter
        Ball, Cone, or another body of revolution.
    mass : float, str or pint.Quantity
        Of the indenter, kg.
    speed : float, str or pint.Quantity
        At the first touch, above zero, m/s.
    gravity : float, str or pint.Quantity
        Acceleration towards the half-space, not below zero, m/s².
    rebounds : int
        Maximum number of contacts to follow; more than one needs gravity.
    temperature : float, str or pint.Quantity, optional
        K if a plain number.  May be left out for a material without a shift law.
    accuracy : float or str
        Largest error of the restitution, absolute.
    indenter_modulus : float, str or pint.Quantity, optional
        Young's modulus of an elastic indenter, Pa; rigid without it.
    indenter_poisson_ratio : float
        Of an elastic indenter.

    Returns
    -------
    ImpactSolution

    Raises
    ------
    InputError
        If a value cannot be used, the indenter is no body of revolution whose profile rises outwards, or the contact
        would be wider than it.
    ConvergenceError
        If the accuracy is not reached.

    Notes
    -----
    Solved by the method of dimensionality reduction (see `solve_transient`) with the equation of motion of the
    indenter.  For one contact it agrees with T. C. T. Ting's solution, and for small losses with [1]_.

    References
    ----------
    .. [1] R. Ramírez, T. Pöschel, N. V. Brilliantov, T. Schwager, Phys. Rev. E 60 (1999) 4465,
       doi:10.1103/PhysRevE.60.4465

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> hit = vf.motion.solve_impact(rubber, vf.Ball("10 mm"), mass="33 g", speed="0.1 m/s")
    >>> f"{hit.restitution:.3f}, {1e3 * hit.contact_time:.2f} ms, {hit.peak_force:.3f} N"
    '0.661, 9.95 ms, 0.977 N'
    """
    kilograms, touching = positive(mass, "kg", "mass"), positive(speed, "m/s", "speed")
    pull = to_si(gravity, "m/s**2", "gravity")
    if pull < 0.0:
        words = "must not be below zero; it points into the half-space."
        raise wrong_argument("gravity", gravity, words, "negative")
    most = whole_number(rebounds, "rebounds", 1, _MOST_CONTACTS)
    if not TIGHTEST <= (wanted := number(accuracy, "accuracy")) <= LOOSEST:
        words = f"must be a number from {TIGHTEST:g} to {LOOSEST:g}, such as 1e-4."
        raise wrong_argument("accuracy", accuracy, words, "out-of-range")
    insist_on_material(material)
    insist_on_indenter(indenter)
    if not is_body_of_revolution(indenter):
        raise InputError(
            f"indenter: the {indenter.noun} is no body of revolution; available: a ball, a cone or another body of "
            "revolution that falls along its axis.",
            code="not-available",
        )
    counterface = indenter_compliance(indenter_modulus, indenter_poisson_ratio)
    falling = _Falling(material, indenter, kilograms, pull, counterface, wanted)
    return falling.solve(touching, most, temperature)


@one_blas_thread
def restitution_curve(
    material: Material,
    indenter: Indenter,
    *,
    speeds: Quantities,
    temperatures: Quantities | None = None,
    mass: Quantity,
    gravity: Quantity = 0.0,
    accuracy: Quantity = 1e-4,
    indenter_modulus: Quantity | None = None,
    indenter_poisson_ratio: float = 0.3,
) -> RestitutionCurve:
    """Compute the restitution of an indenter over speeds and temperatures.

    Parameters
    ----------
    material : Material
    indenter : Indenter
        Ball, Cone, or another body of revolution.
    speeds : (n,) array of float, str or pint.Quantity
        At the touch, m/s.
    temperatures : (m,) array of float, str or pint.Quantity, optional
        K if plain numbers.  May be left out for a material without a shift law.
    mass, gravity, accuracy, indenter_modulus, indenter_poisson_ratio
        As for `solve_impact`.

    Returns
    -------
    RestitutionCurve

    Raises
    ------
    InputError, ConvergenceError
        As for `solve_impact`.

    Examples
    --------
    The restitution has a minimum between glass and rubber:

    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> ball = vf.Ball("5 mm")
    >>> curve = vf.motion.restitution_curve(
    ...     rubber, ball, speeds=["1 m/s"], temperatures=["-40 degC", "0 degC", "60 degC"], mass="4 g"
    ... )
    >>> curve.restitution[:, 0].round(2).tolist()
    [1.0, 0.65, 0.95]
    """
    each = to_si_array(speeds, "m/s", "speeds")
    kelvin = None if temperatures is None else to_si_array(temperatures, "K", "temperatures")
    if not len(each) or (kelvin is not None and not len(kelvin)):
        raise InputError("speeds and temperatures: must hold at least one value.", code="empty")
    hits = [
        [
            solve_impact(
                material, indenter, mass=mass, speed=float(v), gravity=gravity, accuracy=accuracy,
                temperature=None if T is None else float(T), indenter_modulus=indenter_modulus,
                indenter_poisson_ratio=indenter_poisson_ratio,
            )
            for v in each
        ]
        for T in ([None] if kelvin is None else kelvin)
    ]  # fmt: skip

    def table(name: str) -> Array:
        return np.array([[getattr(hit, name) for hit in row] for row in hits], dtype=float)

    notes = counted([hit.warnings for row in hits for hit in row], of="impacts")
    return RestitutionCurve(
        speed=each, temperature=kelvin, restitution=table("restitution"), restitution_error=table("restitution_error"),
        contact_time=table("contact_time"), peak_force=table("peak_force"),
        largest_indentation=table("largest_indentation"), warnings=notes,
    )  # fmt: skip


class _Falling(NamedTuple):
    """An indenter of given mass above a material."""

    material: Material
    indenter: Indenter
    mass: float
    gravity: float
    counterface: float  # compliance of the indenter, 1/Pa
    accuracy: float

    def solve(self, speed: float, rebounds: int, temperature: Quantity | None) -> ImpactSolution:
        indenter, spectrum = self.indenter, self.material.modes_at(temperature)
        plane_strain = 1.0 - self.material.poisson_ratio**2
        glassy = plane_strain / spectrum.E_inf + self.counterface
        relaxed = glassy + plane_strain * float(spectrum.C.sum())
        hard, soft = (
            impact_radius(indenter, 0.5 * self.mass * speed**2, self.mass * self.gravity, 1.0 / one)
            for one in (glassy, relaxed)
        )
        depth = float(profile(indenter, np.array(hard)))
        if depth == 0.0:  # a punch touches over its whole face at once, with a constant stiffness
            period = math.sqrt(0.5 * self.mass * glassy / hard)
            depth = speed * period + self.gravity * period**2
        duration = depth / max(speed, math.sqrt(self.gravity * depth))  # an indenter that is laid down falls, too
        shortest = _RESOLVED * duration
        longest = 10.0 * shortest / _RESOLVED * (relaxed / glassy) ** 0.5
        modes = Modes.of(spectrum)
        if rebounds == 1:
            modes = Modes.for_history(spectrum, shortest, longest, error=_MERGING * self.accuracy)
        count = min(max(_SPRINGS, math.ceil(_SPRINGS * math.sqrt(1e-4 / self.accuracy))), _MOST_SPRINGS)
        s, g, weights = row(indenter, soft if indenter.has_walls else _MARGIN * soft, count)
        instantaneous = plane_strain * modes.instantaneous + self.counterface
        springs = Springs(g, s, weights, instantaneous, plane_strain * modes.C, modes.tau, indenter.has_walls)
        first = Bounce(springs, self.mass, self.gravity, _FIRST * duration).run(speed, rebounds)
        coarse, contacts = None, tuple[ImpactContact, ...]()
        least = max(_LEAST_DIVISION, round(_STEPS / max(len(mesh) for mesh in first.taken)))
        for division in (least * 2**halving for halving in range(_HALVINGS)):
            fine = Bounce(springs, self.mass, self.gravity, 0.0, first.taken, division, recorded=coarse is not None)
            fine.run(speed, rebounds)
            if coarse is not None:
                radius = np.array([row[4] for row in fine.rows])
                of_springs = _OF_SPRINGS / np.maximum(np.searchsorted(s, radius), 1) ** 2
                contacts, largest = _extrapolated(coarse, fine, modes.error, float(of_springs.min()))
                if contacts and largest <= self.accuracy:
                    return self._solution(contacts, coarse, fine, temperature, modes.error + of_springs)
            coarse = fine
        if not contacts:
            raise ConvergenceError(
                "whether the indenter leaves the surface depends on less than the errors of the solution; take another "
                "mass or speed.",
                code="rebound-not-certain",
            )
        raise ConvergenceError(
            f"the restitution has not converged to {self.accuracy:g}; ask for a larger accuracy, or fewer rebounds.",
            code="steps-not-converged",
        )

    def _solution(
        self,
        contacts: tuple[ImpactContact, ...],
        coarse: Bounce,
        fine: Bounce,
        temperature: Quantity | None,
        off: Array,  # error of the compliance at each row, relative
    ) -> ImpactSolution:
        time, depth, velocity, force, radius, stored, dissipated, by_springs = np.array(fine.rows).T
        widest, deepest = float(radius.max()), float(depth.max())
        self.indenter.check(Extent(widest, widest, widest), f"at {contacts[0].speed:g} m/s", "mass or the speed")
        modes = self.material.modes_at(temperature)
        notes: list[Note | None] = [
            *self.indenter.warnings(
                Extent(widest, widest, widest), deepest, float(force.max()), modes.E0, self.material.poisson_ratio
            )
        ]
        if contacts[-1].restitution == 0.0:
            said = "The indenter does not leave the surface again: it comes to rest on it."
            last, values = fine.contacts[-1], {}
            if math.isfinite(last.margin):
                values = {"nearest": last.margin, "restitution": last.leaving / last.speed_in}
            if last.margin < _NEAR * last.largest_depth:
                said += (
                    f" On its way up {1e6 * last.margin:.3g} µm of indentation are left at least: an impact in which "
                    f"none are left has a restitution of about {values['restitution']:.2g}."
                )
            notes.append(Note("no-rebound", said, values=values))
        for contact, one in zip(contacts, fine.contacts, strict=True):
            close = one.margin < _NEAR * one.largest_depth
            if close and 0.0 < contact.restitution <= contact.restitution_error:
                said = (
                    f"The contact that begins at {contact.start:.3g} s ends with a rebound, or not: the largest "
                    f"gap, {1e6 * one.margin:.3g} µm, is within the errors of the solution."
                )
                notes.append(Note("rebound-not-certain", said, values={"gap": one.margin, "start": contact.start}))
        notes += self._waves(contacts[0], time, force, modes)
        known = modes.known_frequencies
        lasting = np.array([one.contact_time for one in contacts])
        beyond = () if known is None else known.beyond(np.pi / lasting, "frequency π over its duration")
        kelvin = None if temperature is None else to_si(temperature, "K", "temperature")
        # By Newton's law, independently of the springs: the loss of kinetic energy plus the work of gravity.
        work = 0.5 * self.mass * (velocity[0] ** 2 - velocity**2) + self.mass * self.gravity * (depth - depth[0])
        balance = work - stored - dissipated
        still = np.zeros_like(time)
        peaks = [max(one.peak_force for one in run.contacts) for run in (coarse, fine)]
        depths = [max(one.largest_depth for one in run.contacts) for run in (coarse, fine)]
        # ½ (e + Δe)² − ½ e²
        parts = [(one.restitution + 0.5 * one.restitution_error) * one.restitution_error for one in contacts]
        lost = self.mass * contacts[0].speed ** 2 * max(parts)
        errors = TransientErrors(
            # Stiff springs touched one by one make a force that is not smooth.
            load=still + abs(peaks[1] - peaks[0]) / 3.0 + off[np.argmax(force)] * peaks[1] + by_springs.max(),
            indentation=still + abs(depths[1] - depths[0]) / 3.0 + off[np.argmax(depth)] * depths[1],
            friction_force=still,
            energy=np.maximum.accumulate(lost + np.abs(balance)),
            balance=balance,
        )
        run = TransientSolution(
            time=time, load=force, indentation=depth, position=np.zeros((len(time), 2)),
            temperature=None if kelvin is None else still + kelvin, friction_force=still, lateral_force=still,
            contact_area=np.pi * radius**2, contact_radius=radius, front=None, rear=None, half_width=None, work=work,
            stored=stored, dissipated=dissipated, errors=errors, steps=len(time) - 1, rejected_steps=0,
            interrupted=False, method="springs", geometry="point", direction=(1.0, 0.0),
            warnings=(*filter(None, notes), *beyond, *self.material.notes_on_modes, *self.material.notes_at(kelvin)),
        )  # fmt: skip
        return ImpactSolution(contacts, run, velocity, self.mass, self.gravity, kelvin, run.warnings)

    def _waves(self, contact: ImpactContact, time: Array, force: Array, modes: RetardationSpectrum) -> tuple[Note, ...]:
        """Return a note if waves take much of the energy of the first contact."""
        # By Fourier's transform of dF/dt. Energy lost on the way in costs the rebound less, that lost last all of it:
        # solved with the waves, impacts on elastic and lossy rubbers had e exp(−λ/2e) to 0.014.
        half, first, nu = 2.0 * contact.time_of_largest, time <= contact.contact_time, self.material.poisson_ratio
        steps, rise, middle = np.diff(time[first]), np.diff(force[first]), 0.5 * (time[first][1:] + time[first][:-1])
        omega = math.pi / half * _HARMONICS
        share = np.sinc(np.outer(omega, steps) / (2.0 * math.pi)) * np.exp(-1j * np.outer(omega, middle))
        taken = lag_of_waves(modes.complex_modulus(omega), nu).real * np.square(np.abs(share @ rise))
        e = contact.restitution
        energy = self.mass * (0.5 * contact.speed**2 + self.gravity * contact.largest_indentation)
        change = -math.expm1(-float(np.trapezoid(taken, omega)) / (math.pi * energy * (e or 1.0)))
        modulus = float(np.abs(modes.complex_modulus(math.pi / half)))
        said = f"waves take about {plain(100.0 * change, 2)} % of the energy of the {'rebound' if e else 'impact'}"
        if e:
            said += f" and lower the restitution from {plain(e, 2)} to about {plain(e * math.sqrt(1.0 - change), 2)}"
        return waves_notes(change, modulus, nu, half, said)


def _extrapolated(
    coarse: Bounce, fine: Bounce, merging: float, of_springs: float
) -> tuple[tuple[ImpactContact, ...], float]:
    """Return the contacts of two runs, one with half the steps of the other; none if the contacts do not correspond."""
    # The error of the restitution e is that of the steps, of merged modes, and of the stiffness by springs, de ~ e ln
    # e; the largest one is also returned. Where these errors of the depth allow that an indenter leaves that stays, or
    # stays that leaves, the restitution jumps: the stated error includes that.
    if [one.separates for one in coarse.contacts] != [one.separates for one in fine.contacts]:
        return (), math.inf
    found, largest = [], 0.0
    for one, two in zip(coarse.contacts, fine.contacts, strict=True):
        columns = [new + (new - old) / 3.0 for old, new in zip(one[:8], two[:8], strict=True)]
        start, duration, speed_in, speed_out, peak, deepest, when, last = columns
        before, after = one.speed_out / one.speed_in, two.speed_out / two.speed_in
        lasting = duration if two.separates else math.inf
        restitution = min(max(speed_out / speed_in, 0.0), 1.0)
        # An indenter that leaves downwards, or faster than it came, has lost its speed in rounding.
        likely = min(max(after, 0.0), 1.0)
        error = abs(after - before) / 3.0 + merging + abs(after - likely)
        error += of_springs * -likely * math.log(likely or 1.0)
        largest = max(largest, error)
        if math.isfinite(two.margin):
            off = abs(two.margin - one.margin) / 3.0 + (merging + of_springs) * two.largest_depth
            if off >= two.margin:  # it could leave with its speed or that of a fall by the error
                fall = 0.0 if two.separates else math.sqrt(2.0 * fine.gravity * off)
                error = min(error + math.hypot(two.leaving, fall) / speed_in, 1.0)
        found.append(ImpactContact(start, speed_in, restitution, lasting, peak, deepest, when, last, error))
    return tuple(found), largest
