"""What the contacts of a study have in common: their rubber, how they are solved, and the curve that they lie on."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from viscofric.contact.free.scale import Scale
from viscofric.errors import InputError
from viscofric.study.cases.record import Failure
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from viscofric.arrays import Mask
    from viscofric.contact.bodies import Layer
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.contact.solution import ContactSolution
    from viscofric.rheology.material import Material
    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.study.cases.interpolation import Between, Node
    from viscofric.study.cases.record import Record
    from viscofric.study.cases.solving import Task


@dataclass(frozen=True)
class Settings:
    """How all contacts of a plan are solved.

    Attributes
    ----------
    accuracy : float
        Of the friction coefficient, relative.
    sensitive : bool
        Whether to find how friction answers to the rubber's compliance.
    fields : frozenset of int
        Numbers of the cases whose fields are kept.
    """

    accuracy: float
    sensitive: bool
    fields: frozenset[int]


class Case(ABC):
    """One contact, SI: frozen, and equal to another where all of it is.

    Attributes
    ----------
    material : int
        Its number in `Study.materials`, from 0.
    sample : int or None
        Member of the material's posterior that it is solved with, from 1; the best estimate if None.
    temperature : float
        K.
    speed : float
        m/s.
    layer : Layer or None
        A half-space without.
    """

    __slots__ = ()
    material: int
    sample: int | None
    temperature: float
    speed: float
    layer: Layer | None

    #: What lies where its frequencies do, in words.
    FREQUENCIES: ClassVar[str]
    #: Whether contacts that differ in temperature and speed make the friction master curve of a study.
    HAS_MASTER_CURVE: ClassVar[bool]
    #: Which columns of its nodes, the first of them friction, are interpolated by their logarithms.
    LOGARITHMIC: ClassVar[Mask]

    @property
    @abstractmethod
    def alike(self) -> tuple[object, ...]:
        """What cases have in common that differ by temperature and speed at most."""

    @property
    @abstractmethod
    def geometry(self) -> str:
        """What touches: "point", "line" or "rough"."""

    @property
    @abstractmethod
    def cost(self) -> str:
        """Its kind in the estimates of computing time; see `viscofric.study.planning.estimates`."""

    @property
    def points(self) -> int:
        """Points of its surface; none of an indenter."""
        return 0

    @property
    def label(self) -> str:
        """Which case it is, for people."""
        sample = "" if self.sample is None else f", sample {self.sample}"
        return f"{celsius(self.temperature):.4g} °C, {1e3 * self.speed:.4g} mm/s{self.body_label}{sample}"

    @property
    def body_label(self) -> str:
        """Which of several bodies it is, after a comma."""
        return ""

    @abstractmethod
    def lengths(self, record: Record) -> tuple[float, float]:
        """Return the shortest and the longest length that speed is divided by for its frequencies, m."""

    @abstractmethod
    def reach(self, record: Record) -> float:
        """Return the number by which contacts with a warning are ranked; that of the largest is reported."""

    @abstractmethod
    def task(
        self, modes: RetardationSpectrum, poisson_ratio: float, settings: Settings, *, fields: bool, label: str
    ) -> Task:
        """Return what solving it takes.

        Parameters
        ----------
        modes : RetardationSpectrum
            Of its rubber at its temperature.
        poisson_ratio : float
        settings : Settings
        fields : bool
            Whether its fields are kept.
        label : str
        """

    @abstractmethod
    def solution(
        self, rubbers: Rubbers, accuracy: float, most_points: int | None = None
    ) -> ContactSolution | PeriodicSolution:
        """Solve it, and return the whole solution, of which `record` keeps a part.

        Parameters
        ----------
        rubbers : Rubbers
        accuracy : float
            Of the friction coefficient, relative.
        most_points : int, optional
            Along the longer axis of a rough surface.
        """

    @abstractmethod
    def record(self, solution: Any) -> Record:
        """Return what is kept of its solution."""

    def insist_on_motion(self) -> None:
        """Raise `InputError` where it lies on no curve, as its speed is not above zero."""
        if not 0.0 < self.speed < math.inf:
            raise InputError(f"speed = {self.speed:g} m/s: must be above zero and finite to lie on a friction curve.")

    @abstractmethod
    def place(self, rubbers: Rubbers) -> Place:
        """Return where it lies.

        Raises
        ------
        InputError
            If it lies on no curve: its speed is not above zero, or its rubber is not known at its temperature.
        """

    @abstractmethod
    def node_label(self, ratio: float) -> str:
        """Say which contact of a family is solved, whose speed is so many times that at s = 0."""

    @abstractmethod
    def node(self, record: Record, rubbers: Rubbers, accuracy: float) -> Node:
        """Return a solved contact of a family as a node of its curve."""

    @abstractmethod
    def interpolated(
        self, between: Between, cases: Sequence[Any], places: Sequence[Place], rubbers: Rubbers
    ) -> Iterator[tuple[int, Record | Failure]]:
        """Yield number and record of every case of a closed interval of a family's curve, as if it had been solved.

        Parameters
        ----------
        between : Between
            The interval.
        cases, places : sequence of Case and Place
            Of the whole family.
        rubbers : Rubbers
        """


class Place(NamedTuple):
    """Where a case lies on the curve of its family, all contacts of which differ by αv over a length only.

    Attributes
    ----------
    family : Case
        The one of them with s = 0 at the reference temperature, with its load and the modulus of its body over b.
    s : float
        ln of the speed over the family's, at the same αv over the length.
    b : float
        Vertical shift.
    log_alpha : float
        ln α.
    scale : Scale or None
        Units of an indenter's case, but for pressures, which are b times as large.
    """

    family: Case
    s: float
    b: float
    log_alpha: float
    scale: Scale | None = None

    @property
    def units(self) -> Scale:
        """Its scale, of an indenter's case."""
        assert self.scale is not None
        return self.scale


@dataclass(frozen=True, eq=False)
class Rubbers:
    """The materials that cases name by number, and those drawn from their posteriors; what many cases share is kept.

    Attributes
    ----------
    materials : sequence of Material
    members : mapping of int to sequence of Material
        Of a material's number: its posterior's members.
    """

    materials: Sequence[Material]
    members: Mapping[int, Sequence[Material]]
    _modes: dict[tuple[int, int | None, float | None], RetardationSpectrum] = field(default_factory=dict, repr=False)
    _shifts: dict[tuple[int, int | None, float], tuple[float, float]] = field(default_factory=dict, repr=False)
    _scales: dict[tuple[Indenter, float, float], Scale] = field(default_factory=dict, repr=False)
    _forces: dict[tuple[Indenter, float, float], float] = field(default_factory=dict, repr=False)

    def of(self, case: Case) -> Material:
        """Return the material that a case is solved with.

        Raises
        ------
        InputError
            If there is none.
        """
        if case.sample is None:
            return self.materials[case.material]
        drawn = self.members.get(case.material, ())
        if not 1 <= case.sample <= len(drawn):
            raise InputError(
                f"sample {case.sample} of material {case.material} is asked for, but {len(drawn)} are drawn; right "
                "would be a number from 1 to that."
            )
        return drawn[case.sample - 1]

    def shifts(self, case: Case) -> tuple[float, float]:
        """Return α and b of a case's material at its temperature."""
        key = case.material, case.sample, case.temperature
        if key not in self._shifts:
            material = self.of(case)
            alpha = 1.0 if material.shift is None else float(material.shift(case.temperature))
            b = 1.0 if material.vertical_shift is None else float(material.vertical_shift(case.temperature))
            self._shifts[key] = alpha, b
        return self._shifts[key]

    def modes(self, case: Case, *, at_reference: bool = False) -> RetardationSpectrum:
        """Return the modes of a case's material at its temperature, or at the reference one."""
        material = self.of(case)
        kelvin = None if at_reference or material.shift is None else case.temperature
        key = case.material, case.sample, kelvin
        if key not in self._modes:
            # How the modes were found is much to send about, and does not matter to the answer.
            self._modes[key] = replace(material.modes_at(kelvin), fit=None)
        return self._modes[key]

    def reference(self, case: Case) -> float:
        """Return the temperature that is written down for a family's contacts, K; zero for rubbers without a shift."""
        reference = self.of(case).reference
        return 0.0 if reference is None else reference

    def scale(self, indenter: Indenter, stiffness: float, load: float) -> Scale:
        """Return the units of an indenter's contact; see `Scale.for_load`."""
        key = indenter, stiffness, load
        if key not in self._scales:
            self._scales[key] = Scale.for_load(*key)
        return self._scales[key]

    def force(self, indenter: Indenter, stiffness: float, indentation: float) -> float:
        """Return the unit of force at an indentation, N or N/m; see `Scale.for_indentation`."""
        key = indenter, stiffness, indentation
        if key not in self._forces:
            self._forces[key] = Scale.for_indentation(*key).force
        return self._forces[key]

    def task(self, case: Case, settings: Settings, *, fields: bool) -> Task | Failure:
        """Return what solving a case by itself takes, with its fields or without, or why that cannot be."""
        try:
            ratio = self.of(case).poisson_ratio
            return case.task(self.modes(case), ratio, settings, fields=fields, label=case.label)
        except InputError as error:
            return Failure.of(error, case.label)

    def node_task(self, family: Case, ratio: float, settings: Settings) -> Task:
        """Return what is solved for a family at a speed so many times that at s = 0."""
        contact = moved(family, speed=ratio * family.speed)
        modes, label = self.modes(family, at_reference=True), family.node_label(ratio)
        return contact.task(modes, self.of(family).poisson_ratio, settings, fields=False, label=label)


def moved(case: Case, **changes: Any) -> Case:
    """Return a case that differs from another in some of what it is."""
    return replace(case, **changes)  # type: ignore[type-var]
