"""Results of impacts: each contact, the solution over time, and the restitution over speed and temperature."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

from viscofric.arrays import Array
from viscofric.datasets import Dataset, dataset
from viscofric.motion.solution import TransientSolution
from viscofric.notes import Warned
from viscofric.showing import Plotted, Rows, shown_as_html, shown_as_text


class ImpactContact(NamedTuple):
    """One contact of an impact with its rebound.

    Attributes
    ----------
    start : float
        Since the first touch, s.
    speed : float
        At the touch, m/s.
    restitution : float
        Speed after the contact over that before it; zero if the indenter stays.
    contact_time : float
        s; infinite if the indenter stays.
    peak_force : float
        N.
    largest_indentation, time_of_largest : float
        m, and its time, s after the touch.
    separation_indentation : float
        Depth of the indenter's lowest point where it leaves the surface, m.
    restitution_error : float
        Estimated, absolute: of steps in time, merged modes and springs.
    """

    start: float
    speed: float
    restitution: float
    contact_time: float
    peak_force: float
    largest_indentation: float
    time_of_largest: float
    separation_indentation: float
    restitution_error: float

    def _shown(self) -> Rows:
        return (
            ("speed", self.speed, "m/s"),
            ("restitution", self.restitution, "", self.restitution_error),
            ("contact time", self.contact_time if math.isfinite(self.contact_time) else "without end (stays)", "s"),
            ("largest force", self.peak_force, "N"),
            ("largest indentation", self.largest_indentation, "m"),
        )

    def __repr__(self) -> str:
        return shown_as_text("ImpactContact", self._shown())

    def _repr_html_(self) -> str:
        return shown_as_html("ImpactContact", self._shown())


@dataclass(frozen=True, eq=False)
class ImpactSolution(Warned, Plotted):
    """Impact of an indenter of some mass.

    Attributes
    ----------
    contacts : tuple of ImpactContact
        In order of time; the properties below are those of the first.
    run : TransientSolution
        Force (its load), indentation, contact radius and energies over time.
    velocity : (n,) array
        Velocity of the indenter into the material at `run.time`, m/s.
    mass : float
        kg.
    gravity : float
        m/s².
    temperature : float or None
        K.
    warnings : tuple of str
        One note for each assumption that is doubtful.
    """

    contacts: tuple[ImpactContact, ...]
    run: TransientSolution = field(repr=False)
    velocity: Array = field(repr=False)
    mass: float
    gravity: float
    temperature: float | None
    warnings: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("contacts", self.contacts),
            ("speed", self.contacts[0].speed, "m/s"),
            ("mass", self.mass, "kg"),
            ("restitution", self.restitution, "", self.restitution_error),
            ("contact time", self.contact_time, "s"),
            ("largest force", self.peak_force, "N"),
            ("largest indentation", self.largest_indentation, "m"),
            ("temperature", self.temperature, "°C"),
            ("warnings", self.warnings),
        )

    @property
    def restitution(self) -> float:
        """Speed after the first contact over that before it; zero if the indenter stays."""
        return self.contacts[0].restitution

    @property
    def restitution_error(self) -> float:
        """Estimated error of the restitution, absolute."""
        return self.contacts[0].restitution_error

    @property
    def contact_time(self) -> float:
        """Duration of the first contact, s; infinite if the indenter stays."""
        return self.contacts[0].contact_time

    @property
    def peak_force(self) -> float:
        """Largest force of the first contact, N."""
        return self.contacts[0].peak_force

    @property
    def largest_indentation(self) -> float:
        """Largest indentation of the first contact, m."""
        return self.contacts[0].largest_indentation

    def to_dataset(self) -> Dataset:
        """Return the data set of `run` with the velocity, and the first contact as attributes."""
        columns = dataset("time", {"velocity": (self.velocity, "m/s", "velocity of the indenter into the material")})
        first = self.contacts[0]._asdict()
        attributes = {"mass": self.mass, "gravity": self.gravity, "contacts": len(self.contacts)} | first
        return self.run.to_dataset().assign(columns.data_vars).assign_attrs(attributes)


@dataclass(frozen=True, eq=False)
class RestitutionCurve(Warned, Plotted):
    """Restitution against speed and temperature.

    Attributes
    ----------
    speed : (n,) array
        m/s.
    temperature : (m,) array or None
        K; None for a material without a shift law, with m = 1.
    restitution, restitution_error : (m, n) array
        Restitution and its estimated error, absolute.
    contact_time : (m, n) array
        s; infinite where the indenter stays.
    peak_force : (m, n) array
        N.
    largest_indentation : (m, n) array
        m.
    warnings : tuple of str
        One note for each assumption that is doubtful.
    """

    speed: Array
    temperature: Array | None
    restitution: Array
    restitution_error: Array
    contact_time: Array
    peak_force: Array
    largest_indentation: Array
    warnings: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("speed", self.speed, "m/s"),
            ("temperature", self.temperature, "°C"),
            ("restitution", self.restitution),
            ("its error", self.restitution_error),
            ("contact time", self.contact_time, "s"),
            ("largest force", self.peak_force, "N"),
            ("largest indentation", self.largest_indentation, "m"),
            ("warnings", self.warnings),
        )

    def to_dataset(self) -> Dataset:
        """Return all columns along ``temperature`` (K, where known) and ``speed`` (m/s)."""
        columns = {
            "restitution": (self.restitution, "1", "coefficient of restitution"),
            "restitution_error": (self.restitution_error, "1", "estimated error of the restitution"),
            "contact_time": (self.contact_time, "s", "contact time"),
            "peak_force": (self.peak_force, "N", "largest force"),
            "largest_indentation": (self.largest_indentation, "m", "largest indentation"),
        }
        coordinates = {"speed": (self.speed, "m/s", "speed of the impact")}
        if self.temperature is None:
            alone = {name: (values[0], unit, text) for name, (values, unit, text) in columns.items()}
            return dataset("speed", alone, coordinates=coordinates)
        coordinates["temperature"] = (self.temperature, "K", "temperature")
        return dataset(("temperature", "speed"), columns, coordinates=coordinates)
