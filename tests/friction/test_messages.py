"""The wording of refusals of friction; other tests assert their codes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import viscofric as vf
from friction.made_runs import friction_curves, traction_runs
from friction.synthetic_curves import synthetic_curves
from friction.test_curve_files import FOREIGN
from friction.test_tribometry import rows_of, runs_from
from viscofric.errors import InputError
from viscofric.friction.curve_checks import outlying_points
from viscofric.friction.identification.conclusions import _anchor_notes
from viscofric.friction.identification.points import usable_points
from viscofric.friction.identification.result import synthetic_notes, with_origin
from viscofric.friction.shifting.collapse import Collapse
from viscofric.notes import Reader, codes

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

RUBBER, BALL = vf.synthetic_fluoroelastomer(), vf.Ball(radius="9.525 mm")
SIZE = (
    "The contact radius is about 2.6 and at most 3.5 mm (Hertz's at |E(v/a)| and at the relaxed modulus, at 60 °C, "
    "20 mm/s and 25 N)"
)


def checked(thickness: str | None = None, **columns: object) -> dict[str, str]:
    """Check the assumptions of four contacts."""
    speed, kelvin = np.tile([0.02, 0.2], 2), np.repeat([303.15, 333.15], 2)
    curves = friction_curves(speed, kelvin, np.array([0.00781, 0.00493, 0.02516, 0.01585]))
    found = vf.check_assumptions(RUBBER, BALL, replace(curves, **columns), thickness=thickness)
    return {check.name: str(check) for check in found}


def test_only_bodies_of_the_handbook_are_called_typical() -> None:
    curves = friction_curves(np.array([0.02]), np.array([303.15]), np.array([0.00781]))
    own = vf.ThermalProperties(1.0, 2000.0, 1000.0, "glass")
    for bodies, said in (
        ({"counterbody": own}, "25 N; typical handbook values of filled rubber are assumed)"),
        ({"counterbody": own, "rubber": own}, "25 N)"),
    ):
        found = vf.check_assumptions(RUBBER, BALL, curves, **bodies)
        (check,) = [str(one) for one in found if one.name == "one temperature"]
        assert said in check


def test_assumptions_say() -> None:
    rest = checked()
    assert rest == {
        "half-space": (
            f"{SIZE}. The half-space assumption needs a thickness of at least 4 contact radii (14 mm), and about "
            "12.2 mm for friction on a bonded layer to agree within 5 % (at 30 °C, 20 mm/s and 25 N); no "
            "thickness was given."
        ),
        "small contact": (
            f"{SIZE}, 0.27 to 0.37 of the ball radius; half-space and parabolic ball are valid up to 0.3; solve the "
            "contact and give contact_radius."
        ),
        "linearity": (
            "The strain of the rubber is 5.4 to 7.4 % (0.2 a/R, at 60 °C, 20 mm/s and 25 N), about the limit of linear "
            "contact theory, 6 %; filled rubber may soften above 0.1 % (Payne effect), which only a strain sweep shows."
        ),
        "quasi-static": (
            "Shear waves in the rubber run at 53 m/s (at |E(v/a)|, with 1150 kg/m³; at 60 °C, 200 mm/s and 25 N). "
            "Inertia, which is left out, changes friction by about 0.0014 % there (good if ≤ 5 %)."
        ),
        "one temperature": (
            "Coulomb heat is not included, as no Coulomb friction is known; the viscoelastic loss warms the face of "
            "the contact by 0.00056 K, and the rubber where the loss is released by 0.0022 K (at 30 °C, 20 mm/s and 25 "
            "N; typical handbook values of filled rubber and PTFE are assumed). This shifts the speed by up to 0.0002 "
            "decades and changes friction by 0.0035 to 0.013 % (good if ≤ 5 %)."
        ),
    }
    rubbed = checked("1 mm", coulomb=np.full(4, 0.5), slip=np.full(4, 0.04))
    assert rubbed["uncoupled"] == (
        "Coulomb friction, a shear stress of 0.78 MPa, also displaces the surface in the normal direction, which "
        "changes the friction coefficient by about 0.013 (268 % of viscoelastic friction; at 30 °C, 200 mm/s and 25 "
        "N), with the opposite sign where the slip is reversed. Contacts were solved without this effect (a change of "
        "79 % for the other bound of the contact size), which is doubtful above 5 %; solve contacts with it (coulomb=, "
        "without heating), or take the mean of friction over both directions of slip. Less slip or Coulomb friction "
        "(PTFE, lubricant) reduces it."
    )
    assert rubbed["one temperature"].startswith(
        "Coulomb heat and the viscoelastic loss warm the face of the contact by "
    )
    assert rubbed["one temperature"].endswith("% (good if ≤ 5 %); predict with heating.")


@pytest.mark.parametrize(
    ("thickness", "sentence"),
    [
        (
            "1 mm",
            (
                "1 mm of rubber, less than 4 contact radii (14 mm), cannot be taken as a half-space: it is thinner "
                "than the contact radius, and such a layer behaves quite differently from a half-space (at 30 °C, 20 "
                "mm/s and 25 N). Solve the contact on a layer (layer=Layer(…)) or use thicker rubber: at least 4 "
                "contact radii (14 mm), and about 12.2 mm for friction within 5 %."
            ),
        ),
        (
            "13 mm",
            (
                "Whether 13 mm of rubber can be taken as a half-space depends on its size: solve the contact and "
                "give contact_radius. With the estimate, friction on a bonded layer of 13 mm is about 4.5 % lower "
                "than on the half-space, the indentation about 14 % smaller (at 30 °C, 20 mm/s and 25 N)."
            ),
        ),
        (
            "16 mm",
            (
                "16 mm of rubber, at least 4 contact radii (14 mm), can be taken as a half-space: friction on a bonded "
                "layer of 16 mm is about 3.3 % lower than on the half-space, the indentation about 12 % smaller (at 30 "
                "°C, 20 mm/s and 25 N)."
            ),
        ),
    ],
)
def test_the_half_space_says(thickness: str, sentence: str) -> None:
    assert checked(thickness)["half-space"] == f"{SIZE}. {sentence}"


def test_identification_says() -> None:
    measured = SimpleNamespace(points=(), measured=lambda place: (np.array([5.03, -1.0]), None))
    best = SimpleNamespace(problem=measured, minimum=SimpleNamespace(place=None))
    level = [vf.Material.standard_linear_solid(E0=one, E_inf=10.0 * one, tau=1e-3) for one in (1e6, 2e6)]
    assert tuple(_anchor_notes(best, SimpleNamespace(materials=level), 30.0, 0.3)) == (
        (
            "The anchor or prior does not fix the level of the modulus at the frequencies of the friction: the "
            "standard error of |E| at 30 rad/s is 49 %; give an anchor near there."
        ),
        "The anchor or prior differs from the fit by 5 of its standard errors: it contradicts the friction or itself.",
    )
    band = SimpleNamespace(low=1.0, high=10.0)
    found = SimpleNamespace(
        material=RUBBER, identified=band, middle=3.0, known=("Known.",), METHOD="friction", UNMEASURED="", notes=()
    )
    for source, behind in (("curves.csv", " (curves.csv)"), ("", "")):
        origin, *known = with_origin(found, source).spectrum.fit.notes
        assert origin == f"The material was identified from friction{behind}; none of its moduli was measured."
        assert origin.code == "identified-from-friction"
        assert known == ["Known."]
    for source, said in (("curves.csv (synthetic)", {"synthetic"}), ("curves.csv", set())):
        found.notes = synthetic_notes(source, None, measured)
        assert codes(found.notes) == codes(with_origin(found, source).spectrum.fit.notes) & {"synthetic"} == said
    assert synthetic_notes("", RUBBER) == ("The prior is synthetic (synthetic fluoroelastomer).",)


def test_points_of_friction_say() -> None:
    speed = np.geomspace(0.02, 0.2, 8)
    curves = friction_curves(speed, np.full(8, 300.0), np.full(8, 0.01), error=1e-4)
    unknown = replace(curves, viscoelastic_error=np.where(speed == speed[2], np.inf, 1e-4))
    (left_out,) = usable_points(unknown, BALL, None, 1e-4).notes
    assert left_out == "1 of 8 points have no standard error that is known and were left out."
    with pytest.raises(vf.InputError) as caught:
        usable_points(
            replace(curves, viscoelastic=-curves.viscoelastic, viscoelastic_error=np.zeros(8)), BALL, None, 0.0
        )
    assert caught.value.words("page") == (
        "viscoelastic friction is −0.01 at 20 mm/s and 26.9 °C, with a standard error of zero: no rubber has it; give "
        "the standard error, or check the signs of the measurement."
    )


def test_outlying_points_say() -> None:
    speed, kelvin, off = np.array([0.01, 0.02, 0.03]), np.full(3, 300.0), np.array([0.0, 1.5, 0.7])
    for relative, by in ((False, "1.5 standard errors"), (True, "150 % of friction")):
        [said] = outlying_points(speed, kelvin, off, relative=relative)
        assert said == (
            f"2 of 3 points, farthest that at 20 mm/s and 26.9 °C by {by}, lie off the others by more than chance "
            "explains and count less; check them."
        )


def test_the_collapse_of_curves_says() -> None:
    said = "Curves of neighbouring temperatures coincide to 2 % (root mean square over 9 points) where they overlap in "
    for error, end in (
        (0.0, "."),
        (0.03, "; their errors alone would make it 3 %."),
        (np.inf, "; their errors alone are unknown."),
    ):
        assert Collapse(0.02, error, 9).sentence == f"{said}reduced speed{end}"


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


@pytest.mark.parametrize(("separated", "code", "part"), [*NOTES, (NOTES[1][0], NOTES[1][1], "negative (−0.03)")])
def test_notes_say(separated: Callable[[], vf.FrictionCurves], code: str, part: str) -> None:
    (said, *_) = [note for note in separated().notes if getattr(note, "code", "") == code]
    assert part in said


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
            "value",
            (
                ": no column for viscoelastic friction; friction curves have 'speed (mm/s)', 'temperature (degC)', "
                "'load (N)' and 'viscoelastic friction', this one has 'speed (mm/s)', 'temperature (degC)', "
                "'load (N)', 'value'; name them, e.g. columns={'viscoelastic_friction': 'heading'}."
            ),
        ),
        (
            "temperature (degC)",
            "temperature",
            (
                ": column 'temperature' has no unit; write it as 'temperature (degC)', or name it: "
                "columns={'temperature': 'temperature (degC)'}."
            ),
        ),
        ("load (N)", "load (Pa)", ": column 'load (Pa)' has the unit 'Pa'; it must be one like 'N'."),
        (
            "friction (%)",
            "friction (N)",
            ": column 'viscoelastic friction (N)' has the unit 'N'; it is a number without a unit, or in '%'.",
        ),
        (
            "20;30",
            "-20;30",
            (
                ", line 2: '-20' in column 'speed (mm/s)' must be above zero; give the mean friction of both "
                "directions of motion in one row."
            ),
        ),
        ("200;60", "200;-300", ", line 3: '-300' in column 'temperature (degC)' must be above absolute zero."),
        (
            "2,5",
            "two",
            (
                ", line 3: 'two' in column 'viscoelastic friction (%)' is not a finite number; correct it, or leave "
                "out the row."
            ),
        ),
        ("2,5", "", ", line 3: the cell in column 'viscoelastic friction (%)' is empty; give a number."),
    ],
)
def test_files_of_curves(old: str, new: str, sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("curves.csv").write_text(FOREIGN.replace(old, new), encoding="utf-8")
    with pytest.raises(vf.DataFileError) as caught:
        vf.read_friction_curves("curves.csv")
    assert str(caught.value) == f"curves.csv{sentence}"


def test_indentation_says() -> None:
    depth = [1e-4, 1.1e-4, -1.0, -1.0, -1.0, -1.0]
    record = vf.friction.IndentationRecord(np.arange(6.0), np.ones(6), depth, 300.0, control="load", error=1e-6)
    with pytest.raises(InputError) as caught:
        vf.identify_from_indentation(record, vf.Ball("10 mm"))
    assert str(caught.value) == (
        "record 1: in only 1 averaged rows the response is clearly above its scatter; at least 5 are needed."
    )
