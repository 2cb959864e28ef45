"""The wording of refusals of friction; other tests assert their codes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import viscofric as vf
from friction.made_runs import friction_curves, traction_runs
from friction.synthetic_curves import synthetic_curves
from friction.test_curve_files import FOREIGN
from friction.test_tribometry import rows_of, runs_from

if TYPE_CHECKING:
    from collections.abc import Callable

    from viscofric.notes import Reader

LAW = vf.WLF(C1=8.86, C2=101.6, reference="50 degC")
SPEEDS = np.geomspace(0.02, 0.2, 10)
ONE = friction_curves(np.array([0.05]), np.array([303.15]), np.array([0.03]))


def one_way(**settings: object) -> vf.FrictionCurves:
    """Separate runs with one direction of slip."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, configurations=[(1, 1)], speeds=[0.1])
    return vf.separate(runs, **settings)


def drifting() -> vf.FrictionCurves:
    """Separate runs whose temperature drifts without a gap."""
    runs = traction_runs(viscoelastic=lambda v, T: 0.03, speeds=[0.1], temperatures=[303.15], replicates=30)
    return vf.separate(replace(runs, temperature=303.15 + 0.15 * runs.replicate))


def rolling() -> vf.FrictionCurves:
    """Separate runs in pure rolling, in one direction."""
    rows = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03))
    rows[:, 1] = rows[:, 0]
    return vf.separate(runs_from(rows[rows[:, 0] > 0]))


def reversed_signs(disc: int, ball: int, force: int, *, constant_mean: bool = False) -> vf.FrictionCurves:
    """Separate runs in which signs are reversed; at a constant mean speed the sense of slip alone."""
    rows = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03, replicates=3)) * [disc, ball, force, 1, 1, 1]
    if constant_mean:
        rows[:, 1] = 2.0 * rows[:, 0] - rows[:, 1]
    return vf.separate(runs_from(rows))


def with_readings_at_rest() -> vf.FrictionCurves:
    """Separate runs with one reading at rest."""
    rows = rows_of(traction_runs(viscoelastic=lambda v, T: 0.03))
    return vf.separate(runs_from(np.concatenate([rows, [[0.0, 0.0, 0.3, 25.0, 303.15, 1]]])))


def constant(*celsius: float) -> vf.FrictionCurves:
    """Make friction that depends neither on speed nor on temperature."""
    speed, kelvin = np.tile(SPEEDS, len(celsius)), np.repeat(np.array(celsius) + 273.15, 10)
    return friction_curves(speed, kelvin, np.full(speed.size, 0.02))


SAID: list[tuple[Callable[[], object], Reader, str]] = [
    (
        lambda: vf.shift_friction(synthetic_curves(30.0)),
        "python",
        "friction curves at one temperature, 30.0 °C, have no shift factor; give two or more.",
    ),
    (
        lambda: vf.shift_friction(constant(30.0, 40.0)),
        "python",
        (
            "friction curves at 30.0 and 40.0 °C are too flat: friction changes too little with speed for its "
            "errors, so that any shift factor fits."
        ),
    ),
    (
        lambda: vf.shift_friction(synthetic_curves(30.0, 60.0)),
        "python",
        (
            "friction curves at 30.0 and 60.0 °C do not overlap: no shift makes 2 or more of their points "
            "coincide (friction coefficients: 0.00491 to 0.00781, 0.0159 to 0.0252); measure at temperatures in "
            "between, or at more speeds."
        ),
    ),
    (
        lambda: vf.shift_friction(synthetic_curves(30.0, 35.0, 78.0, 90.0), reference="60 degC"),
        "python",
        (
            "no overlapping friction curves at 30.0, 35.0, 78.0 and 90.0 °C include the reference, 60.0 °C; "
            "choose another reference, or measure at temperatures around it or at more speeds."
        ),
    ),
    (
        lambda: vf.shift_friction(replace(constant(50.0), load=np.repeat([10.0, 25.0], 5)), shift=LAW),
        "page",
        (
            "load of the friction curves runs from 10 to 25 N, but a master curve holds at one load; give a ball,"
            " with which loads are reduced to one."
        ),
    ),
    (
        lambda: vf.shift_friction(constant(50.0), shift=LAW)(1.0),
        "python",
        (
            "reduced speed α(T)·v = 1 m/s at 50.0 °C is not covered: friction is known for 0.02 to 0.2 m/s, and "
            "this lies 0.7 decades above; predict it there with predict_friction()."
        ),
    ),
    (
        lambda: vf.compare(ONE, replace(ONE, speed=np.array([0.06]))),
        "python",
        (
            "the point measured at 30.00 °C, 50 mm/s and 25 N has no prediction; predict friction at "
            "measured.speeds, measured.temperatures and the measured load."
        ),
    ),
    (
        lambda: ONE.at_temperature("60 degC"),
        "python",
        "temperature = 60.0 °C: there is no friction curve within 1 K of it; known temperatures: 30.0 °C.",
    ),
    (
        drifting,
        "page",
        (
            "temperature from 30.1 to 34.5 °C has no gaps and cannot be grouped into nominal values: if there is "
            "one nominal value, give “Gap between temperatures”: 1.1 K; if there are several, one below 1 K; or "
            "leave out unsteady readings by “Steps to leave out”."
        ),
    ),
    (
        lambda: one_way(zero=0.3),
        "shell",
        (
            "At 2 of 2 conditions, the first being 30.0 °C and 100 mm/s, the signs of the velocities do not "
            "separate viscoelastic and Coulomb friction; measure also u_disc < 0 with u_disc − u_ball < 0 or "
            "u_disc < 0 with u_disc − u_ball > 0 or u_disc > 0 with u_disc − u_ball < 0, or give the Coulomb "
            "friction to assume (--coulomb)."
        ),
    ),
    (
        rolling,
        "python",
        (
            "At 6 of 6 conditions, the first being 30.0 °C and 20 mm/s, slip is zero (pure rolling) and the signs of "
            "the velocities do not separate the force cell's zero from viscoelastic friction; measure also with the "
            "velocities of disc and ball reversed, or give its zero, read with ball and disc apart (zero=)."
        ),
    ),
    (
        lambda: vf.separate(
            traction_runs(viscoelastic=lambda v, T: v, speeds=0.02 * 1.03 ** np.arange(12), temperatures=[303.15])
        ),
        "python",
        (
            "disc_speed from 20 to 27.68 mm/s has no gaps and cannot be grouped into nominal values: if there is one "
            "nominal value, give speed_tolerance = 0.085; if there are several, one below 0.05; or leave out unsteady "
            "readings, such as by runs.select(abs(abs(runs.disc_speed) - 0.02353) < 0.0014)."
        ),
    ),
]

NOTES: list[tuple[Callable[[], vf.FrictionCurves], str, str]] = [
    (
        with_readings_at_rest,
        "disc-at-rest",
        "1 of 49 readings were taken with the disc at rest and left out.",
    ),
    (
        lambda: reversed_signs(1, 1, -1),
        "negative-friction",
        "probably the sign of the force, or of the velocities, is reversed.",
    ),
    (
        lambda: reversed_signs(1, 1, 1, constant_mean=True),
        "negative-friction",
        "probably the speeds of disc and ball are exchanged.",
    ),
    (
        lambda: reversed_signs(1, 1, -1, constant_mean=True),
        "negative-friction",
        (
            "Coulomb friction is positive as it should be, so probably the zero of the force cell differs between the "
            "directions of the disc, or the disc turns against the sign of its speed."
        ),
    ),
]


@pytest.mark.parametrize(("separated", "code", "end"), NOTES)
def test_notes_say(separated: Callable[[], vf.FrictionCurves], code: str, end: str) -> None:
    (said, *_) = [note for note in separated().notes if getattr(note, "code", "") == code]
    assert said.endswith(end)


def test_agreement_says() -> None:
    speed, kelvin = np.tile([0.05, 0.1], 2), np.repeat([303.15, 333.15], 2)
    measured = friction_curves(speed, kelvin, np.array([0.01, 0.02, 0.03, 0.04]), error=1e-5)
    assert str(vf.compare(measured, friction_curves(speed, kelvin, 1.1 * measured.viscoelastic))) == (
        "Over 4 points the predicted friction is on average 10.0 % above the measured one (standard error ±0.0 %); the "
        "rms difference is 10.0 %. The difference is within twice the standard error at 0 % of the points."
    )


@pytest.mark.parametrize(("call", "reader", "sentence"), SAID)
def test_refusals_say(call: Callable[[], object], reader: Reader, sentence: str) -> None:
    with pytest.raises(vf.ViscofricError) as caught:
        call()
    assert caught.value.words(reader) == sentence


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("load (N);", "", ", line 2: the row has 4 cells where the header names 3 columns."),
        (
            "viscoelastic friction (%)",
            "mu",
            (
                ": there is no column 'viscoelastic friction'; there are 'speed (mm/s)', 'temperature (degC)', "
                "'load (N)', 'mu'; name them, e.g. columns={'viscoelastic_friction': 'heading'}."
            ),
        ),
        (
            "temperature (degC)",
            "temperature",
            ": column 'temperature' has no unit; write it as 'temperature (degC)'.",
        ),
        ("load (N)", "load (Pa)", ": column 'load (Pa)' has the unit 'Pa'; it must be one like 'N'."),
        (
            "friction (%)",
            "friction (N)",
            ": column 'viscoelastic friction (N)' has the unit 'N'; it is a number without a unit, or in '%'.",
        ),
        ("20;30", "-20;30", ", line 2: '-20' in column 'speed (mm/s)' must be above zero."),
        ("200;60", "200;-300", ", line 3: '-300' in column 'temperature (degC)' must be above absolute zero."),
        ("2,5", "two", ", line 3: 'two' in column 'viscoelastic friction (%)' is not a finite number."),
        ("2,5", "", ", line 3: the cell in column 'viscoelastic friction (%)' is empty; give a number."),
    ],
)
def test_files_of_curves(old: str, new: str, sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("curves.csv").write_text(FOREIGN.replace(old, new), encoding="utf-8")
    with pytest.raises(vf.DataFileError) as caught:
        vf.read_friction_curves("curves.csv")
    assert str(caught.value) == f"curves.csv{sentence}"
