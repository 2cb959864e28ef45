"""Contacts of a study: their common interface, and the materials that they share."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, ClassVar, NamedTuple, TypeVar

from viscofric.arrays import Mask
from viscofric.contact.bodies import Layer
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.solution import ContactSolution
from viscofric.errors import InputError
from viscofric.friction.cases.interpolation import Between, Node
from viscofric.friction.cases.record import Failure, Record
from viscofric.friction.cases.solving import Task
from viscofric.rheology.material import Material, alpha_and_b
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.units import shown_place

Made = TypeVar("Made")


@dataclass(frozen=True)
class Settings:
    """Settings of all contacts of a plan."""

    accuracy: float  # of the friction coefficient, relative
    sensitive: bool  # whether to find the derivatives of friction by the material's compliance
    fields: frozenset[int]  # numbers of the cases whose fields are kept


class Case(ABC):
    """One contact, SI: frozen and hashable."""

    __slots__ = ()
    material: int  # index in `Study.materials`
    sample: int | None  # bootstrap sample of the material, from 1; None: the best estimate
    temperature: float  # K
    speed: float  # m/s
    layer: Layer | None  # None: a half-space

    #: Begins a sentence about its frequencies.
    FREQUENCIES: ClassVar[str]
    #: Whether contacts at different temperatures and speeds form a friction master curve.
    HAS_MASTER_CURVE: ClassVar[bool]
    #: Columns of its nodes, friction first, that are interpolated by their logarithms.
    LOGARITHMIC: ClassVar[Mask]

    @property
    def alike(self) -> Case:
        """The same for cases that differ by temperature and speed at most."""
        return moved(self, temperature=0.0, speed=0.0)

    @property
    @abstractmethod
    def geometry(self) -> str:
        """Geometry of the contact: "point", "line" or "rough"."""

    @property
    @abstractmethod
    def cost(self) -> str:
        """Its kind in the estimates of computing time; see `viscofric.study.cases.estimates`."""

    @property
    def points(self) -> int:
        """Number of points of its surface; 0 for an indenter."""
        return 0

    @property
    def label(self) -> str:
        """The case in words."""
        sample = "" if self.sample is None else f", sample {self.sample}"
        return f"{shown_place(self.temperature, self.speed)}{self.body_label}{sample}"

    @property
    def body_label(self) -> str:
        """Which of several bodies it has, after a comma."""
        return ""

    @abstractmethod
    def lengths(self, record: Record) -> tuple[float, float]:
        """Return the shortest and the longest length, m, by which speed is divided for its frequencies."""

    @abstractmethod
    def reach(self, record: Record) -> float:
        """Return the number that ranks contacts with a warning; the largest is reported."""

    def task(
        self, modes: RetardationSpectrum, poisson_ratio: float, settings: Settings, *, fields: bool, label: str
    ) -> Task:
        """Return what is to be solved; `modes` are those of its material at its temperature."""
        verb, contact = self.solving(settings)
        rubber = {"modes": modes, "poisson_ratio": poisson_ratio, "temperature": self.temperature}
        return Task(verb, rubber | contact | {"fields": fields}, label)

    @abstractmethod
    def solving(self, settings: Settings) -> tuple[Callable[..., Record], dict[str, Any]]:
        """Return the function that solves it, and its arguments besides the material and what is stored."""

    @abstractmethod
    def solution(
        self, rubbers: Rubbers, accuracy: float, most_points: int | None = None
    ) -> ContactSolution | PeriodicSolution:
        """Return the whole solution; `most_points` limits a rough surface's grid along its longer axis."""

    @abstractmethod
    def record(self, solution: Any) -> Record:
        """Return the stored part of its solution."""

    def insist_on_motion(self) -> None:
        """Raise `InputError` if it is on no curve because its speed is not above zero."""
        if not 0.0 < self.speed < math.inf:
            raise InputError(
                f"speed = {self.speed:g} m/s: must be above zero and finite to lie on a friction curve.",
                code="not-positive",
            )

    @abstractmethod
    def place(self, rubbers: Rubbers) -> Place:
        """Return its place on the curve of its family; InputError if it has none."""

    @abstractmethod
    def node_label(self, ratio: float) -> str:
        """Return the label of a family's contact at a speed that is `ratio` times that at s = 0."""

    @abstractmethod
    def node(self, record: Record, rubbers: Rubbers, accuracy: float) -> Node:
        """Return a solved contact of a family as a node of its curve."""

    @abstractmethod
    def interpolated(
        self, between: Between, cases: Sequence[Any], places: Sequence[Place], rubbers: Rubbers
    ) -> Iterator[tuple[int, Record | Failure]]:
        """Yield number and record of the family's cases between two nodes of its curve, as if they had been solved."""


class Place(NamedTuple):
    """Place of a case on the curve of its family, whose contacts differ only by αv over a length."""

    family: Case  # the one with s = 0 at the reference temperature, with load and modulus of the body divided by b
    s: float  # ln of the speed over the family's, at the same αv over the length
    b: float  # vertical shift
    log_alpha: float
    scale: Scale | None = None  # units of an indenter's case; pressures are b times as large

    @property
    def units(self) -> Scale:
        """Scale of an indenter's case."""
        assert self.scale is not None
        return self.scale


@dataclass(frozen=True, eq=False)
class Rubbers:
    """The materials of the cases, and their bootstrap samples; shared results are cached."""

    materials: Sequence[Material]
    members: Mapping[int, Sequence[Material]]  # index of a material → its bootstrap samples
    _kept: dict[tuple[object, ...], Any] = field(default_factory=dict, repr=False)
    #: Units of contacts, by indenter, stiffness (Pa) and load, or indentation (m).
    scale: Callable[[Indenter, float, float], Scale] = field(default_factory=lambda: cache(Scale.for_load), repr=False)
    scale_at: Callable[[Indenter, float, float], Scale] = field(
        default_factory=lambda: cache(Scale.for_indentation), repr=False
    )

    def of(self, case: Case) -> Material:
        """Return the material of a case; raise `InputError` if there is no such sample."""
        if case.sample is None:
            return self.materials[case.material]
        drawn = self.members.get(case.material, ())
        if not 1 <= case.sample <= len(drawn):
            raise InputError(
                f"sample {case.sample} of material {case.material} does not exist; there are {len(drawn)}, "
                "numbered from 1.",
                code="no-sample",
            )
        return drawn[case.sample - 1]

    def without_notes(self, case: Case) -> Material:
        """Return the material of a case as modes, without the notes on their fit."""
        material = self.of(case)
        return self._once(case, "lean", lambda: replace(material, spectrum=_without_notes(material, None)))

    def shifts(self, case: Case) -> tuple[float, float]:
        """Return α and b of a case's material at its temperature."""
        return self._once(case, case.temperature, lambda: alpha_and_b(self.of(case), case.temperature))

    def modes(self, case: Case, *, at_reference: bool = False) -> RetardationSpectrum:
        """Return the modes of a case's material at its temperature, or at the reference temperature."""
        material = self.of(case)
        kelvin = None if at_reference or material.shift is None else case.temperature
        return self._once(case, ("modes", kelvin), lambda: _without_notes(material, kelvin))

    def _once(self, case: Case, what: object, make: Callable[[], Made]) -> Made:
        """Return what is the same for all cases of one material and sample, made once."""
        key = case.material, case.sample, what
        if key not in self._kept:
            self._kept[key] = make()
        found: Made = self._kept[key]
        return found

    def reference(self, case: Case) -> float:
        """Return the temperature recorded for a family's contacts, K; zero for materials without a shift."""
        reference = self.of(case).reference
        return 0.0 if reference is None else reference

    def task(self, case: Case, settings: Settings, *, fields: bool) -> Task | Failure:
        """Return the task of a single case, or the failure if there can be none."""
        try:
            ratio = self.of(case).poisson_ratio
            return case.task(self.modes(case), ratio, settings, fields=fields, label=case.label)
        except InputError as error:
            return Failure.of(error, case.label)

    def node_task(self, family: Case, ratio: float, settings: Settings) -> Task:
        """Return the task of a family's contact at a speed that is `ratio` times that at s = 0."""
        contact = moved(family, speed=ratio * family.speed)
        modes, label = self.modes(family, at_reference=True), family.node_label(ratio)
        return contact.task(modes, self.of(family).poisson_ratio, settings, fields=False, label=label)


def _without_notes(material: Material, kelvin: float | None) -> RetardationSpectrum:
    """Return the modes of a material without notes, which belong to the material rather than to its contacts."""
    modes = material.modes_at(kelvin)
    # Nothing is known of the fit of a table.
    fit = modes.fit if isinstance(material.spectrum, RetardationSpectrum) else None
    return replace(modes, fit=None if fit is None else replace(fit, notes=()))


def moved(case: Case, **changes: Any) -> Case:
    """Return a case with some attributes changed."""
    return replace(case, **changes)  # type: ignore[type-var]
