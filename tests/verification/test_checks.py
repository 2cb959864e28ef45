"""The checks behind `viscofric verify`: they fail where the engine is wrong, and they tell what they found."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from numpy.typing import NDArray

from marks import apart
from refusals import refused
from viscofric.contact import steady
from viscofric.contact.arrays.transforms import ScipyTransforms
from viscofric.contact.bodies import Layer
from viscofric.contact.free.scale import Scale, ScaledIndenter
from viscofric.contact.operators.convolution import ConvolutionOperator
from viscofric.contact.operators.half_space import HalfSpaceOperator, LineOperator
from viscofric.contact.periodic.transfer import SlidingSolid
from viscofric.errors import ConvergenceError
from viscofric.motion import bounce, memory, normal
from viscofric.rheology import material
from viscofric.rheology.spectra.modulus_table import ModulusTable
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.verification import CHECKS, Check, Comparison, run_checks, select

NAMES = [check.name for check in CHECKS]


def scaled(patch: pytest.MonkeyPatch, owner: type, name: str, factor: float) -> None:
    """Let a method return its result times a factor."""
    original = getattr(owner, name)
    patch.setattr(owner, name, lambda *arguments: factor * original(*arguments))


# What may be wrong with an engine, and which check must see it.  3 % of compliance is what a Poisson ratio of 0.48 adds
# to that of 0.5.


def stiff_half_space(patch: pytest.MonkeyPatch) -> None:
    softer(patch, HalfSpaceOperator)


def stiff_line(patch: pytest.MonkeyPatch) -> None:
    softer(patch, LineOperator)


def softer(patch: pytest.MonkeyPatch, owner: type) -> None:
    original = owner._influence  # type: ignore[attr-defined]

    def influence(operator: Any) -> tuple[NDArray[Any], ...]:
        displacement, *dissipation = original(operator)
        return 1.03 * displacement, *dissipation

    patch.setattr(owner, "_influence", influence)


def soft_waves(patch: pytest.MonkeyPatch) -> None:
    scaled(patch, SlidingSolid, "transfer", 1.03)


def soft_layer(patch: pytest.MonkeyPatch) -> None:
    scaled(patch, Layer, "yielding", 1.03)


def relaxation_for_retardation_time(patch: pytest.MonkeyPatch) -> None:
    """Take the relaxation time τ E0/E∞ where τ belongs, the commonest mistake of all."""
    original = steady._steady_material

    def material(spectrum: RetardationSpectrum, speed: float, *rest: float) -> Any:
        return original(spectrum, speed * spectrum.E0 / spectrum.E_inf, *rest)

    patch.setattr(steady, "_steady_material", material)


def lost_energy(patch: pytest.MonkeyPatch) -> None:
    scaled(patch, ConvolutionOperator, "dissipated_force", 0.9)


def absolute_number(patch: pytest.MonkeyPatch) -> None:
    """Add a small number of Pa, harmless in the units of the one who wrote it."""
    original = Scale.for_load

    def for_load(*arguments: Any) -> Scale:
        scale = original(*arguments)
        return replace(scale, stiffness=scale.stiffness + 10.0)

    patch.setattr(Scale, "for_load", for_load)


def one_way(patch: pytest.MonkeyPatch) -> None:
    """Do not turn the indenter round with the motion."""
    patch.setattr(
        steady, "ScaledIndenter", lambda indenter, scale, _toward: ScaledIndenter(indenter, scale, (1.0, 0.0))
    )


def merged_modes(patch: pytest.MonkeyPatch) -> None:
    """Let modes of equal times overwrite each other instead of adding up."""
    original = steady._steady_material

    def material(spectrum: RetardationSpectrum, *rest: float) -> Any:
        times = {float(tau): float(C) for C, tau in zip(spectrum.C, spectrum.tau, strict=True)}
        kept = RetardationSpectrum.__new__(RetardationSpectrum)
        object.__setattr__(kept, "__dict__", dict(spectrum.__dict__))
        object.__setattr__(kept, "C", list(times.values()))
        object.__setattr__(kept, "tau", list(times))
        return original(kept, *rest)

    patch.setattr(steady, "_steady_material", material)


def half_a_shift(patch: pytest.MonkeyPatch) -> None:
    original = RetardationSpectrum.shifted
    patch.setattr(RetardationSpectrum, "shifted", lambda self, alpha, b=1.0: original(self, alpha, math.sqrt(b)))


def not_transposed(patch: pytest.MonkeyPatch) -> None:
    """Solve the adjoint problem with the operator itself, as if it were symmetric."""
    patch.setattr(HalfSpaceOperator, "transposed", lambda self: self)
    patch.setattr(LineOperator, "transposed", lambda self: self)


def late_modes(patch: pytest.MonkeyPatch) -> None:
    """Let modes fitted to a table have the reciprocal frequencies in hertz as their times."""
    original = material.modes_of_table

    def modes(table: ModulusTable) -> RetardationSpectrum:
        fitted = original(table)
        return replace(fitted, tau=2.0 * math.pi * fitted.tau)

    patch.setattr(material, "modes_of_table", modes)


def half_a_memory(patch: pytest.MonkeyPatch) -> None:
    """Let half of the force at the end of a step pass for its mean in the memory of springs."""
    original = memory.step_parts

    def parts(x: NDArray[Any]) -> memory.StepParts:
        found = original(x)
        return found._replace(end=0.5 * found.end)

    patch.setattr(normal, "step_parts", parts)
    patch.setattr(bounce, "step_parts", parts)


def threads_in_the_way(patch: pytest.MonkeyPatch) -> None:
    """Let several threads leave a trace in their FFTs."""
    original = ScipyTransforms.inverse_cropped

    def inverse_cropped(self: Any, *arguments: Any) -> Any:
        return original(self, *arguments) * (1.0 + 1e-4 * (self._threads(2**20) - 1))

    patch.setattr(ScipyTransforms, "inverse_cropped", inverse_cropped)


SEEN_BY: dict[str, Callable[[pytest.MonkeyPatch], None]] = {
    "hertz-ball": stiff_half_space,
    "hertz-cylinder": stiff_line,
    "hertz-ellipsoid": stiff_half_space,
    "sneddon-cone": stiff_half_space,
    "flat-punch": stiff_half_space,
    "full-contact-wave": soft_waves,
    "westergaard": soft_waves,
    "johnson-waves": soft_waves,
    "thick-layer": soft_layer,
    "thin-layers": soft_layer,
    "rolling-on-layer": soft_layer,
    "single-layers": relaxation_for_retardation_time,
    "hunter": relaxation_for_retardation_time,
    "ball-reference": relaxation_for_retardation_time,
    "low-speed": relaxation_for_retardation_time,
    "high-speed": relaxation_for_retardation_time,
    "energy-balance": lost_energy,
    "units": absolute_number,
    "mirror": one_way,
    "split-modes": merged_modes,
    "shifted-friction": half_a_shift,
    "direction": one_way,
    "modulus-table": late_modes,
    "backends": threads_in_the_way,
    "derivatives": not_transposed,
    "lee-radok": half_a_memory,
    "impact": half_a_memory,
    "orders": stiff_half_space,
    "large-windows": relaxation_for_retardation_time,
}
SLOW = ("lee-radok", "orders")


@pytest.mark.slow
# the defects that these find after some seconds, impact and hertz-ball find at once
@pytest.mark.parametrize("name", [*(name for name in NAMES if name not in SLOW), *apart(*SLOW)])
def test_check_fails_where_the_engine_is_wrong(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    SEEN_BY[name](monkeypatch)
    (check,) = select(CHECKS, [name])
    try:
        seen = any(not one.passed for one in check.compare())  # stops at the first
    except ConvergenceError:
        seen = True
    assert seen


def test_names_are_distinguished_and_all_is_said() -> None:
    assert len(set(NAMES)) == len(NAMES)
    assert not set(NAMES) & {check.group for check in CHECKS}
    for check in CHECKS:
        assert check.title, check.name
        assert check.source, check.name
        assert check.reason.endswith("."), check.name


# --- what a comparison is -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("measure", "computed", "expected", "error"),
    [
        ("relative", 1.1, 1.0, 0.1),
        ("relative", 0.0, 0.0, math.inf),
        ("relative", math.nan, 1.0, math.inf),
        ("absolute", -1.0, 0.0, 1.0),
        ("at least", 1.5, 2.0, 0.5),
        ("at least", 2.5, 2.0, 0.0),
        ("at most", 2.5, 2.0, 0.5),
        ("at most", math.inf, 2.0, math.inf),
    ],
)
def test_error_is_that_of_its_measure(measure: Any, computed: float, expected: float, error: float) -> None:
    one = Comparison("case", "quantity", computed, expected, 0.2, measure)
    assert one.error == pytest.approx(error)
    assert one.passed == (error <= 0.2)


def test_nothing_to_compare_and_what_cannot_be_solved_are_failures() -> None:
    def fails() -> list[Comparison]:
        raise ConvergenceError("no window was found.")

    base = Check("name", "title", "group", "source", "reason.", list)
    empty, broken = run_checks([base, replace(base, compare=fails)])
    assert not empty.passed
    assert empty.worst is None
    assert not broken.passed
    assert broken.trouble == "no window was found."


def test_the_worst_is_the_largest_error_over_its_bound() -> None:
    rows = [
        Comparison("a", "x", 1.0, 2.0, 1.0),
        Comparison("b", "x", 1.1, 1.0, 0.1001),
        Comparison("c", "x", 1.0, 1.0, 0.0),
    ]
    check = Check("name", "title", "group", "source", "reason.", lambda: rows)
    outcome = check.run()
    assert outcome.passed
    assert outcome.worst is rows[1]
    assert not replace(check, compare=lambda: [*rows, replace(rows[2], computed=2.0)]).run().passed


def test_checks_are_chosen_by_name_or_group() -> None:
    assert select(CHECKS, []) == CHECKS
    assert [one.name for one in select(CHECKS, ["hunter", "hertz-ball"])] == ["hertz-ball", "hunter"]
    assert {one.group for one in select(CHECKS, ["invariances"])} == {"invariances"}
    with refused("unknown-check", naming="'hunter'"):
        select(CHECKS, ["hunters"])
