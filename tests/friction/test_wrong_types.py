"""What is not of the right kind is refused by the verbs of friction in words that say what was meant."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import viscofric as vf
from friction.made_runs import traction_runs
from refusals import refused

_CURVES = vf.FrictionCurves([0.1], [303.15], [25.0], [0.02], [1e-4], [0.0], [1])
_RUNS = traction_runs(viscoelastic=lambda v, T: 0.02, replicates=1)


def test_half_a_replicate_is_refused() -> None:
    with refused("not-a-whole-number"):
        vf.FrictionCurves([0.1], [303.15], [25.0], [0.02], [1e-4], [0.0], [1.5])


@pytest.mark.parametrize(
    ("call", "refusal"),
    [
        (lambda: vf.separate(_CURVES), ("wrong-type", "runs", "TractionRuns")),  # type: ignore[arg-type]
        (lambda: vf.write_friction_curves(_RUNS, "x.csv"), ("wrong-type",)),  # type: ignore[arg-type]
        (lambda: vf.read_friction_curves(None), ("not-a-name",)),  # type: ignore[arg-type]
        (lambda: vf.read_mtm(5), ("not-a-name",)),  # type: ignore[arg-type]
        (lambda: vf.read_mtm(["a.csv", "b.csv"]), ("files-in-a-list",)),  # type: ignore[arg-type]
        (lambda: vf.separate(_RUNS, speed_tolerance="five"), ("no-number", "speed_tolerance = 'five'")),  # type: ignore[arg-type]
        (lambda: vf.separate(_RUNS, zero="5 mm"), ("wrong-unit", "zero = '5 mm'")),
        (
            lambda: vf.predict_friction(
                vf.synthetic_fluoroelastomer(), vf.Ball("1 cm"), speeds=0.1, temperatures=5.0, load=5.0
            ),
            ("out-of-range",),
        ),
        (
            lambda: vf.solve_steady(
                vf.synthetic_fluoroelastomer(), vf.Ball("1 cm"), speed=0.1, temperature=60.0, load=5.0
            ),
            ("out-of-range", "'60 degC'"),
        ),
    ],
)
def test_what_was_meant_is_reported(call: Callable[[], object], refusal: tuple[str, ...]) -> None:
    with refused(refusal[0], naming=refusal[1:]):
        call()
