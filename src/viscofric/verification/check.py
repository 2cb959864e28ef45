"""A check: computed numbers, numbers known independently, and the allowed differences with their reasons."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any, Literal, TypeAlias

from viscofric.datasets import plain
from viscofric.errors import InputError, ViscofricError
from viscofric.verification.engine import checking

#: How a computed number is held against the expected one: its difference relative to the expected one, the difference
#: itself, or only from one side.
Measure: TypeAlias = Literal["relative", "absolute", "at least", "at most"]


@dataclass(frozen=True)
class Comparison:
    """One computed number and its expected value."""

    case: str  # the solved problem
    quantity: str  # what is compared, with its unit
    computed: float
    expected: float
    bound: float  # largest error that passes
    measure: Measure = "relative"  # kind of error; of the last two, the amount below or above the expected number

    @property
    def error(self) -> float:
        """Difference in the given measure; infinite without a number to compare."""
        difference = self.computed - self.expected
        if not math.isfinite(difference):
            return math.inf
        if self.measure == "at least":
            return max(0.0, -difference)
        if self.measure == "at most":
            return max(0.0, difference)
        if self.measure == "relative":
            return abs(difference / self.expected) if self.expected != 0.0 else math.inf
        return abs(difference)

    @property
    def passed(self) -> bool:
        """Whether the error is within its bound."""
        return self.error <= self.bound

    @property
    def severity(self) -> float:
        """Error over bound; the largest of a check is shown."""
        if self.bound > 0.0:
            return self.error / self.bound
        return 0.0 if self.error == 0.0 else math.inf

    @property
    def texts(self) -> tuple[str, str, str, str]:
        """Computed and expected number, error and bound as they are shown: per cent of a relative difference."""

        def difference(value: float) -> str:
            return f"{100.0 * value:.2g} %" if self.measure == "relative" else f"{value:.2g}"

        sign = {"at least": "≥ ", "at most": "≤ "}.get(self.measure, "")
        return f"{self.computed:.6g}", f"{sign}{self.expected:.6g}", difference(self.error), difference(self.bound)


@dataclass(frozen=True)
class Check:
    """A set of comparisons of one kind."""

    name: str  # on the command line
    title: str  # subject, in a few words
    group: str  # kind: closed forms, reference values, …
    source: str  # of the expected numbers
    reason: str  # for the bounds
    compare: Callable[[], Iterable[Comparison]]  # computes and yields the comparisons
    obtained: str = ""  # of published numbers: how
    unstated: str = ""  # what their source does not state

    @property
    def origin(self) -> dict[str, str]:
        """How published numbers were obtained, and what their source does not state."""
        return {name: text for name in ("obtained", "unstated") if (text := getattr(self, name))}

    def run(self, backend: str = "scipy") -> Outcome:
        """Compute the comparisons; a contact that cannot be solved is a failure of the check.

        `backend` names arrays and FFTs; see `viscofric.contact.arrays.backend.Backend`.  Raises InputError if there is
        no such library or device.
        """
        began = time.perf_counter()
        found: list[Comparison] = []
        trouble = ""
        with checking(backend):
            try:
                found.extend(self.compare())
            except ViscofricError as error:
                trouble = str(error)
        return Outcome(self, tuple(found), trouble, time.perf_counter() - began)


def checks(group: str) -> Callable[..., Callable[[Callable[[], Iterable[Comparison]]], Check]]:
    """Return what makes a decorator of a check's texts, which makes a function that compares a `Check` of the group."""

    def described(name: str, title: str, source: str, reason: str, **origin: str) -> Any:
        return lambda compare: Check(name, title, group, source, reason, compare, **origin)

    return described


def checks_in(*modules: ModuleType) -> tuple[Check, ...]:
    """Return the checks of modules, in their order."""
    return tuple(one for module in modules for one in vars(module).values() if isinstance(one, Check))


@dataclass(frozen=True)
class Outcome:
    """The result of a check."""

    check: Check
    comparisons: tuple[Comparison, ...]
    trouble: str  # why it could not be completed; empty if it was
    seconds: float  # wall-clock time

    @property
    def passed(self) -> bool:
        """Whether there are comparisons and all are within their bounds."""
        return not self.trouble and bool(self.comparisons) and all(one.passed for one in self.comparisons)

    @property
    def worst(self) -> Comparison | None:
        """The comparison with the largest error over its bound."""
        return max(self.comparisons, key=lambda one: one.severity, default=None)

    @property
    def record(self) -> dict[str, Any]:
        """Everything in plain types; a number that is none is None."""
        check, names = self.check, ("case", "quantity", "computed", "expected", "error", "bound", "measure", "passed")
        comparisons = [{name: getattr(one, name) for name in names} for one in self.comparisons]
        about = {name: getattr(check, name) for name in ("name", "title", "group", "source")}
        about |= {"reason_of_bounds": check.reason, **check.origin}
        verdict = {name: getattr(self, name) for name in ("passed", "trouble", "seconds")}
        return dict(plain({**about, **verdict, "comparisons": comparisons}, digits=None))


def run_checks(
    checks: Sequence[Check], begin: Callable[[Check], None] | None = None, backend: str = "scipy"
) -> Iterator[Outcome]:
    """Run checks one after the other with a backend of arrays and FFTs; `begin` is called before each."""
    for check in checks:
        if begin is not None:
            begin(check)
        yield check.run(backend)


def select(checks: Sequence[Check], names: Sequence[str]) -> tuple[Check, ...]:
    """Return the checks of these names or groups, all without names; InputError names the nearest to an unknown one."""
    if not names:
        return tuple(checks)
    known = {one.name for one in checks} | {one.group for one in checks}
    for name in names:
        if name not in known:
            import difflib

            near = difflib.get_close_matches(name, known, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(one.name for one in checks)}."
            raise InputError(f"there is no check named {name!r}; {hint}", code="unknown-check")
    return tuple(one for one in checks if one.name in names or one.group in names)
