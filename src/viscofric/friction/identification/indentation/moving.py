"""Records in which the contact shrinks, under a given load or depth: their responses by springs with memory."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.friction.identification.indentation.contact import EXACT, Answer, Shared, Trial, logarithm, wider
from viscofric.friction.identification.indentation.rows import Reduced, RowsContact
from viscofric.motion.march import march
from viscofric.motion.mover import Problem
from viscofric.motion.normal import NormalMotion
from viscofric.motion.schedule import make_schedule
from viscofric.motion.tangents import follow
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum

#: Springs, closer near the axis, and the margin beyond the largest contact radius: the load is then good to 4e-4 while
#: the radius is a tenth of the largest one, and to 1e-4 at the end.
_SPRINGS, _POWER, _MARGIN = 80, 1.5, 1.1
#: Accuracy of the steps that are chosen, which are then halved; most rows at which a step ends.
_ACCURACY, _MOST_ROWS = 1e-3, 1000

#: Ends of steps before the first row, over its time: the accuracy is relative to the largest value, not to early ones.
_EARLY = np.geomspace(0.03, 1.0, 10)
#: Turns of what was prescribed from which a record is an oscillation; smaller ones, relative to the largest value, are
#: scatter.
_OSCILLATES, _TURN = 4, 0.02


@dataclass(frozen=True, eq=False, kw_only=True)
class Moving(RowsContact):
    """The usable rows of a record in which the contact shrinks, averaged."""

    by_springs: ClassVar[bool] = True

    indenter: Indenter
    reduced: Reduced
    shared: Shared = EXACT

    @property
    def log_elastic(self) -> float:
        """Ln of the plane-strain compliance of an elastic contact."""
        prescribed = np.interp(self.time, self.knots, self.values)
        other = prescribed if self.creep else self.reduced(prescribed)
        ratio = (self.average @ other) / self.response
        return float(np.median(np.log(np.maximum(ratio, 1e-300)))) * (-1.0 if self.creep else 1.0)

    def ends(self, trial: Trial) -> tuple[float, float, float]:
        """Return the angular frequencies, rad/s, of steps over the measured times, and of oscillations."""
        low, high, fastest = super().ends(trial)
        turns = _turns(self.knots, self.values)
        if len(turns) < _OSCILLATES:
            return low, high, fastest
        shortest = np.pi / float(np.diff(turns).min())
        return low, max(high, shortest), max(fastest, shortest)

    def answer(self, trial: Trial) -> Answer:
        """Return the response of a material, solved by springs."""
        time, edge = self._steps(trial)
        value, change = self._response(trial, time, edge, self.indenter, self.values, derivatives=True)
        log_value, change = trial.logarithm(value, change, self.response)
        columns = np.zeros((len(self), 3))
        for place, (indenter, values) in self._moved.items():
            moved, _ = self._response(trial, time, edge, indenter, values, derivatives=False)
            columns[:, place] = logarithm(moved, self.response)[0] - log_value
        if self.creep:
            columns[:, 2] = -self.shared.zero * (self.average @ self.reduced.slope(self.depth)) / self.response
        else:
            columns[:, 1] = -self.shared.gain
        return Answer(log_value, change[:, :-1], change[:, -1], columns)

    @cached_property
    def _moved(self) -> dict[int, tuple[Indenter, Array]]:
        """Other indenters and prescribed values, with errors of one standard deviation."""
        found: dict[int, tuple[Indenter, Array]] = {}
        if self.shared.radius > 0.0:
            found[0] = (wider(self.indenter, self.shared.radius), self.values)
        if self.creep and self.shared.gain > 0.0:
            found[1] = self.indenter, (1.0 + self.shared.gain) * self.values
        if not self.creep and self.shared.zero > 0.0:
            # The first value is zero, before the contact.
            found[2] = self.indenter, np.append(0.0, self.values[1:] + self.shared.zero)
        return found

    def _response(
        self, trial: Trial, time: Array, edge: float, indenter: Indenter, values: Array, *, derivatives: bool
    ) -> tuple[Array, Array]:
        """Return the averaged response (n,), and its derivatives as `follow` has them (n, 2 + m)."""
        springs = trial.springs(indenter, edge, _SPRINGS, _POWER)
        given = self._given(time, values)
        control = "load" if self.creep else "indentation"
        found = follow(springs, time, given, control, derivatives=derivatives)
        value, change = (found.depth, found.depth_change) if self.creep else (found.load, found.load_change)
        place = np.clip(np.searchsorted(time, self.time, side="right") - 1, 0, len(time) - 2)
        share = (self.time - time[place]) / np.where(time[place + 1] > time[place], time[place + 1] - time[place], 1.0)
        value = (1.0 - share) * value[place] + share * value[place + 1]
        change = (1.0 - share)[:, None] * change[place] + share[:, None] * change[place + 1]
        if self.creep:
            change = self.reduced.slope(value)[:, None] * change
            value = self.reduced(value)
        return self.average @ value, self.average @ change

    def _given(self, time: Array, values: Array) -> Array:
        """Return what was prescribed at the ends of steps, which have jumps twice."""
        given = np.interp(time, self.knots, values)
        for place in np.flatnonzero(np.diff(self.knots) == 0.0):
            twice = np.flatnonzero(time == self.knots[place])
            given[twice] = values[place : place + 2]
        return given

    def _steps(self, trial: Trial) -> tuple[Array, float]:
        """Return the ends of steps, and the largest contact radius with a margin."""
        strengths = np.exp(trial.compliances)
        E_inf, tau = 1.0 / float(strengths[0]), np.exp(trial.log_alpha) * trial.tau
        E0 = 1.0 / float(strengths.sum())
        ratio = float(np.sqrt(1.0 - trial.plane_strain))
        material = Material(RetardationSpectrum(E0, E_inf, strengths[1:], tau), None, ratio)
        control = "load" if self.creep else "indentation"
        still = np.zeros((len(self.knots), 2))
        schedule = make_schedule(material, self.knots, control, self.values, still, None, None, "untouched")
        problem = Problem(material, self.indenter, schedule, _ACCURACY, None, trial.plane_strain * trial.extra)
        track = march(NormalMotion.of(problem), schedule, accuracy=_ACCURACY, fields=False)
        steps = np.unique([moment.instant.time for moment in track.moments])
        widest = max(moment.seen.extents["contact_radius"] for moment in track.moments)
        jumps = self.knots[:-1][np.diff(self.knots) == 0.0]
        rows = self.time if len(self.time) <= _MOST_ROWS else self.time[:0]
        first = self.knots[0] + (self.time[0] - self.knots[0]) * _EARLY
        time = np.unique(np.concatenate([steps, 0.5 * (steps[1:] + steps[:-1]), first, rows, self.knots]))
        return np.sort(np.concatenate([time, jumps])), _MARGIN * widest


def _turns(time: Array, values: Array) -> Array:
    """Return the times at which values turn, by more than scatter."""
    least, found = _TURN * float(values.max()), []
    way, place = 1.0, 0
    for number, value in enumerate(values):
        if way * (value - values[place]) >= 0.0:
            place = number
        elif way * (values[place] - value) > least:
            found.append(time[place])
            way, place = -way, number
    return np.array(found)
