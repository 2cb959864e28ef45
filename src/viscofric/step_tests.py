"""Creep and relaxation tests as readers return them: responses over time after a step, in SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from viscofric.arguments import sentences, whole_number
from viscofric.arrays import Array, Indices
from viscofric.data import Deformation, Origin, set_columns, set_members, tensile_from_shear
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, check_choice
from viscofric.showing import Items, Plotted, Rows, Shown
from viscofric.units import Quantities, Quantity, in_either, positive, shown_celsius

#: What was held: the stress (creep) or the strain (relaxation).
StepKind: TypeAlias = Literal["creep", "relaxation"]
#: Name, unit and long name of the response in data sets.
_RESPONSE = {
    "creep": ("creep_compliance", "1/Pa", "creep compliance"),
    "relaxation": ("relaxation_modulus", "Pa", "relaxation modulus"),
}
_RESPONSE_UNITS = [unit for _, unit, _ in _RESPONSE.values()]


@dataclass(frozen=True, eq=False)
class StepTest(Shown):
    """The response to one step of stress (creep) or of strain (relaxation) at one temperature.

    Parameters
    ----------
    temperature : float
        Mean measured temperature, K.
    time : (n,) array
        Since the step, ascending, without repeats, above zero, s.
    response : (n,) array
        Creep compliance J(t), 1/Pa, or relaxation modulus, Pa; positive, tensile or shear
        (`StepTests.kind`, `StepTests.deformation`).  Text and quantities have a unit of either.
    unit : {"", "Pa", "1/Pa"}
        Of the response, where it was given with one: it must be that of `StepTests.kind`.

    Raises
    ------
    InputError
        If the arrays differ in length, a value is not above zero and finite, or the units differ.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> warm = vf.readers.StepTest(298.15, np.array([0.1, 1.0, 10.0]), np.array([1.0e-7, 1.5e-7, 2.2e-7]))
    >>> vf.readers.StepTest("25 degC", [0.1, 1.0], ["3.1 MPa", "2.4 MPa"]).unit
    'Pa'
    """

    temperature: float
    time: Array
    response: Array
    unit: str = ""

    if TYPE_CHECKING:  # what is given, converted when made

        def __init__(
            self,
            temperature: Quantity,
            time: Quantities,
            response: Quantities | ArrayLike,
            unit: str = "",
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "temperature", positive(self.temperature, "K", "temperature of a step test"))
        check_choice(self.unit, "unit", "", *_RESPONSE_UNITS)
        units = [self.unit] if self.unit else _RESPONSE_UNITS
        response, unit = in_either(self.response, units, "response of a step test")
        object.__setattr__(self, "response", response)
        object.__setattr__(self, "unit", self.unit or unit)
        set_columns(self, "time", "response", of="a step test", per="time")
        if np.any(np.diff(self.time) <= 0):
            raise InputError("the times of a step test must ascend without repeats.", code="not-ascending")

    def __len__(self) -> int:
        return len(self.time)

    def _shown(self) -> Rows:
        return (
            ("temperature", self.temperature, "°C"),
            ("time", self.time, "s"),
            ("response", self.response, self.unit),
        )

    def thinned(self, per_decade: int) -> StepTest:
        """Return the test with the points in each of so many equal parts of a decade of time averaged.

        Times and responses are averaged geometrically.  Instruments record at equal intervals, which puts nine tenths
        of the points into the last decade, with errors that are alike from one to the next.
        """
        whole_number(per_decade, "per_decade", 1, 10_000)
        number, count = parts_of_decades(self.time, per_decade)
        time, response = (
            np.exp(np.bincount(number, weights=np.log(one)) / count) for one in (self.time, self.response)
        )
        return StepTest(self.temperature, time, response, self.unit)


def parts_of_decades(time: Array, per_decade: int) -> tuple[Indices, Indices]:
    """Return the number (n,) of the part of a decade that each ascending time lies in, and how many each part holds."""
    part = np.floor(np.log10(time) * per_decade + 1e-9).astype(np.int64)
    _, number, count = np.unique(part, return_inverse=True, return_counts=True)
    return number, count


@dataclass(frozen=True, eq=False)
class StepTests(Origin, Plotted, Items[StepTest]):
    """Creep tests, or relaxation tests, of one material at several temperatures.

    Parameters
    ----------
    tests : tuple of StepTest
        In ascending temperature.
    kind : {"creep", "relaxation"}
        Whether the responses are compliances after a step of stress, or moduli after a step of strain.
    deformation : {"tension", "compression", "bending", "shear"}
        Of the sample: whether the moduli are G (shear) or E (all others).
    source : str
        Origin, such as a file's name.
    notes : tuple of str
        What the reader found doubtful, left out, sorted or averaged: one sentence each.
    format : str
        The recognised format in words; empty for tests from no file.

    Raises
    ------
    InputError
        If a value is not of these.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> warm = vf.readers.StepTest(298.15, np.array([0.1, 1.0, 10.0]), np.array([3.0e-7, 4.5e-7, 6.0e-7]))
    >>> creep = vf.readers.StepTests((warm,), kind="creep", deformation="shear")
    >>> creep.in_tension(0.5).tests[0].response  # D = J/(2(1+ν))
    array([1.0e-07, 1.5e-07, 2.0e-07])
    """

    tests: tuple[StepTest, ...]
    kind: StepKind
    deformation: Deformation = "tension"
    source: str = ""
    notes: tuple[str, ...] = ()
    format: str = ""

    def __post_init__(self) -> None:
        check_choice(self.kind, "kind", "creep", "relaxation")
        self._check_origin("the step tests")
        set_members(self, "tests", StepTest, lambda one: one.temperature)
        for one in self.tests:
            if one.unit not in ("", right := _RESPONSE[self.kind][1]):
                raise InputError(
                    f"tests: the response at {shown_celsius(one.temperature)} °C is in {one.unit}, but that of a "
                    f"{self.kind} test is in {right}; give the kind that was measured.",
                    code="wrong-unit",
                )

    def _items(self) -> Sequence[StepTest]:
        return self.tests

    def _shown(self) -> Rows:
        return (
            ("kind", self.kind),
            ("tests", self.tests),
            ("readings", sum(map(len, self.tests))),
            ("temperature", self.temperatures, "°C"),
            *self._shown_origin(),
        )

    @property
    def temperatures(self) -> Array:
        """Temperatures of the tests, K, ascending."""
        return np.array([one.temperature for one in self.tests])

    def in_tension(self, poisson_ratio: float) -> StepTests:
        """Return the tests in tension: E = 2(1+ν)G, D = J/(2(1+ν)) if they were measured in shear.

        ν is taken as constant.
        """
        if self.deformation != "shear":
            return self
        factor, note = tensile_from_shear(poisson_ratio, "responses")
        factor = 1.0 / factor if self.kind == "creep" else factor
        tests = tuple(replace(one, response=factor * one.response) for one in self.tests)
        return replace(self, tests=tests, deformation="tension", notes=(*self.notes, note))

    def thinned(self, per_decade: int) -> StepTests:
        """Return the tests with the points in each of so many equal parts of a decade averaged; see `StepTest`."""
        whole_number(per_decade, "per_decade", 1, 10_000)
        return replace(self, tests=tuple(one.thinned(per_decade) for one in self.tests))

    def to_dataset(self) -> Dataset:
        """Return the points along the dimension ``reading``, test by test.

        Returns
        -------
        xarray.Dataset
            ``temperature`` (K), ``time`` (s) and ``creep_compliance`` (1/Pa) or ``relaxation_modulus`` (Pa); the
            attributes are ``kind``, ``deformation``, ``source`` and ``format``.
        """
        return dataset(
            "reading",
            step_columns(
                self.kind,
                np.repeat(self.temperatures, [len(one) for one in self.tests]),
                np.concatenate([np.empty(0), *(one.time for one in self.tests)]),
                np.concatenate([np.empty(0), *(one.response for one in self.tests)]),
            ),
            attributes={"kind": self.kind} | self._origin(),
        )


@dataclass(frozen=True, eq=False)
class StepMasterCurve(Plotted):
    """Tensile creep compliance or relaxation modulus over reduced time, at one reference temperature.

    Parameters
    ----------
    time : (n,) array
        Reduced, t/α(T), ascending, s.
    response : (n,) array
        Creep compliance, 1/Pa, or relaxation modulus, Pa.
    temperature : (n,) array
        Of the test that each point comes from, K.
    reference : float
        K.
    kind : {"creep", "relaxation"}
        Which of the two.
    notes : tuple of str
        What is behind the curve, such as synthetic measurements.

    Raises
    ------
    InputError
        If the arrays differ in length, a value is not above zero and finite, or the times do not ascend.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> curve = vf.readers.StepMasterCurve(
    ...     np.array([0.1, 10.0]), np.array([1e-7, 4e-7]), np.full(2, 303.15), 303.15, "creep"
    ... )
    """

    time: Array
    response: Array
    temperature: Array
    reference: float
    kind: StepKind
    notes: tuple[str, ...] = ()

    if TYPE_CHECKING:  # what is given, converted when made

        def __init__(
            self,
            time: Quantities,
            response: Quantities | ArrayLike,
            temperature: Quantities,
            reference: Quantity,
            kind: StepKind,
            notes: tuple[str, ...] = (),
        ) -> None: ...

    def __post_init__(self) -> None:
        check_choice(self.kind, "kind", "creep", "relaxation")
        response, _ = in_either(self.response, [_RESPONSE[self.kind][1]], "response of a master curve")
        object.__setattr__(self, "response", response)
        set_columns(self, "time", "response", "temperature", of="a master curve", per="point")
        object.__setattr__(self, "reference", positive(self.reference, "K", "reference"))
        object.__setattr__(self, "notes", sentences(self.notes, "notes of a master curve"))
        if np.any(np.diff(self.time) < 0):
            raise InputError("the times of a master curve must ascend.", code="not-ascending")

    def __len__(self) -> int:
        return len(self.time)

    def _shown(self) -> Rows:
        return (
            ("kind", self.kind),
            ("reduced time", self.time, "s"),
            (
                "compliance" if self.kind == "creep" else "modulus",
                self.response,
                "1/Pa" if self.kind == "creep" else "Pa",
            ),
            ("measured at", self.temperature, "°C"),
            ("reference", self.reference, "°C"),
            ("notes", self.notes),
        )

    @property
    def modulus(self) -> Array:
        """The relaxation modulus, or 1/J(t) of creep; Pa."""
        return np.asarray(1.0 / self.response if self.kind == "creep" else self.response)

    def to_dataset(self) -> Dataset:
        """Return the points along the dimension ``reading``.

        Returns
        -------
        xarray.Dataset
            ``temperature`` (K), ``time`` (s) and ``creep_compliance`` (1/Pa) or ``relaxation_modulus`` (Pa); the
            attributes ``kind`` and ``reference_temperature`` (K).
        """
        return dataset(
            "reading",
            step_columns(self.kind, self.temperature, self.time, self.response),
            attributes={"kind": self.kind, "reference_temperature": self.reference},
        )


def step_columns(
    kind: StepKind, temperature: Array, time: Array, response: Array, *, fitted: bool = False
) -> dict[str, tuple[Array, str, str] | None]:
    """Return columns of a data set of step responses; of a `fitted` spectrum only the response."""
    name, unit, long_name = _RESPONSE[kind]
    if fitted:
        return {f"fitted_{name}": (response, unit, f"{long_name} of the fitted spectrum")}
    return {
        "temperature": (temperature, "K", "temperature"),
        "time": (time, "s", "time after the step"),
        name: (response, unit, long_name),
    }
