"""What is no value of the right kind is refused in one sentence that names it, by every verb of friction."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscofric as vf
from friction.made_runs import traction_runs
from refusals import refused

_SPEED, _KELVIN = np.tile(np.geomspace(0.02, 0.2, 6), 3), np.repeat([303.15, 308.15, 313.15], 6)
_LAW = vf.WLF(C1=9.0, C2=100.0, reference=303.15)
_FRICTION = 0.01 * (1.0 + (_LAW(_KELVIN) * _SPEED / 0.02) ** -0.4)
_COLUMNS: dict[str, Any] = {
    "speed": _SPEED,
    "temperature": _KELVIN,
    "load": np.full(18, 25.0),
    "viscoelastic": _FRICTION,
    "viscoelastic_error": 0.01 * _FRICTION,
    "viscoelastic_scatter": np.zeros(18),
    "replicates": np.ones(18),
}
_CURVES = vf.FrictionCurves(**_COLUMNS)
_RUNS = traction_runs(viscoelastic=lambda v, T: 0.02, replicates=1)
_RUBBER, _BALL = vf.synthetic_fluoroelastomer(), vf.Ball(radius="9.525 mm")
_FACTORS = vf.ShiftFactors([303.15, 313.15], [0.0, -1.0], 303.15, np.zeros((2, 2)))


def _separate(runs: Any = _RUNS, **settings: Any) -> object:
    return vf.separate(runs, **settings)


def _write(curves: Any = _CURVES, path: Any = "curves.csv") -> object:
    return vf.write_friction_curves(curves, path)


def _check(material: Any = _RUBBER, indenter: Any = _BALL, curves: Any = _CURVES, **settings: Any) -> object:
    return vf.check_assumptions(material, indenter, curves, **settings)


def _predict(material: Any = _RUBBER, indenter: Any = _BALL, **given: Any) -> object:
    return vf.predict_friction(material, indenter, **{"speeds": 0.1, "temperatures": 330.0, "load": 5.0} | given)


def _shift(curves: Any = _CURVES, **settings: Any) -> object:
    return vf.shift_friction(curves, **settings)


def _compare_factors(found: Any = _FACTORS, other: Any = _LAW) -> object:
    return vf.friction.compare_shift_factors(found, other)


def _compare(measured: Any = _CURVES, predicted: Any = _CURVES) -> object:
    return vf.compare(measured, predicted)


def _anchor(**given: Any) -> object:
    return vf.friction.ModulusAnchor(
        **{"modulus": "3 MPa", "angular_frequency": "60 rad/s", "temperature": 300.0} | given
    )


def _identify(curves: Any = _CURVES, indenter: Any = _BALL, **settings: Any) -> object:
    return vf.identify_material(curves, indenter=indenter, **settings)


_SHARED = "level_error common_error drift_error coulomb_level_error"
#: verb -> the arguments that are tried, and of these that may be left out, for which None is right
_VERBS: dict[Callable[..., object], tuple[str, str]] = {
    _separate: ("runs outliers speed_tolerance temperature_tolerance", "zero coulomb"),
    _write: ("curves path", ""),
    vf.read_friction_curves: ("path", ""),
    _check: ("material indenter curves rubber counterbody", "thickness contact_radius"),
    _predict: ("material indenter speeds load accuracy workers", "temperatures samples layer window"),
    _shift: ("curves level_error", "shift reference vertical_shift indenter load"),
    _compare_factors: ("found other", ""),
    _compare: ("measured predicted", ""),
    _CURVES.interval: ("level of", ""),
    _CURVES.select: ("keep", ""),
    _CURVES.at_temperature: ("temperature", ""),
    _CURVES.at_load: ("load", ""),
    vf.FrictionCurves.from_solutions: ("solutions", ""),
    _RUNS.select: ("", "rows steps except_steps"),
    _identify: (
        f"curves indenter levels limit modes samples seed accuracy prior_error poisson_ratio {_SHARED}",
        "load shift anchor prior reference",
    ),
    _anchor: ("modulus angular_frequency temperature part error", ""),
}
#: Of no use to any argument.
_WRONG = (
    "5 xyz",
    -1,
    True,
    {"a": 1},
    object(),
    np.array([1.0, np.nan]),
    float("nan"),
    ("a", "b", "c"),
    1j,
    np.zeros((9, 9)),
)


@pytest.mark.parametrize(
    ("verb", "argument", "optional"),
    [
        pytest.param(verb, argument, argument in optional, id=f"{verb.__name__.strip('_')}-{argument}")
        for verb, (needed, optional) in _VERBS.items()
        for argument in (*needed.split(), *optional.split())
    ],
)
def test_a_value_of_the_wrong_kind_is_refused(
    verb: Callable[..., object], argument: str, optional: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    # A reading of the force cell, a name like any other, a whole number.
    right = {("zero", -1), ("path", "5 xyz"), ("seed", True)}
    for wrong in (*_WRONG, *(() if optional else (None,))):
        if isinstance(wrong, (str, int)) and (argument, wrong) in right:
            continue
        with pytest.raises(vf.InputError) as caught:
            verb(**{argument: wrong})
        # One sentence that can be read: no array or object is printed in full.
        assert len(str(caught.value)) < 320, argument
        assert "\n" not in str(caught.value), argument


@pytest.mark.parametrize("name", [*_COLUMNS, "load_unit"])
def test_columns_of_something_else_make_no_friction_curves(name: str) -> None:
    for wrong in ("fast", {}, object(), [1j] * 18, [b"x"] * 18, 10**400, float("nan")):
        with refused(name):
            vf.FrictionCurves(**_COLUMNS | {name: wrong})


def test_half_a_replicate_is_refused() -> None:
    with refused("not-a-whole-number"):
        vf.FrictionCurves(**_COLUMNS | {"replicates": np.full(18, 1.5)})


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
        (lambda: _predict(temperatures=5.0), ("out-of-range",)),
    ],
)
def test_what_was_meant_is_reported(call: Callable[[], object], refusal: tuple[str, ...]) -> None:
    with refused(refusal[0], naming=refusal[1:]):
        call()
