"""Friction curves are saved and read to the last digit; tables of other tribometers are read, and errors placed."""

from __future__ import annotations

import itertools
import json
import math
from dataclasses import fields, replace
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import viscofric as vf
from friction.made_runs import FOUR, traction_runs
from friction.synthetic_curves import planted_law, synthetic_curves
from readers.samples import workbook
from refusals import refused
from viscofric.errors import DataFileError
from viscofric.files import says_synthetic
from viscofric.friction.curve_files import holds_friction_curves
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, Remedy, codes, note_of
from viscofric.traction import notes_on_copies

FOREIGN = "speed (mm/s);temperature (degC);load (N);viscoelastic friction (%)\n20;30;25;3,1\n200;60;25;2,5\n"
#: Columns that a table has to have.
BARE = {"speed", "temperature", "load", "viscoelastic friction"}
WRITTEN = {"source", "notes", "load_unit", "assumption"}


def read(folder: Path, text: str, **settings: Any) -> FrictionCurves:
    """Write a table, and read it."""
    path = folder / "curves.csv"
    path.write_text(text, encoding="utf-8")
    return vf.read_friction_curves(path, **settings)


def same(one: FrictionCurves, other: FrictionCurves) -> None:
    for field in fields(FrictionCurves):
        here, there = getattr(one, field.name), getattr(other, field.name)
        if isinstance(here, np.ndarray):
            np.testing.assert_array_equal(here, there, err_msg=field.name)
        else:
            assert here == there, field.name


def test_separated_curves_come_back_to_the_last_digit(tmp_path: Path) -> None:
    """Notes, source and assumption too, and infinite errors of what could not be found."""
    runs = traction_runs(viscoelastic=lambda v, T: -0.03, replicates=3, noise=0.01, seed=3)
    one_way = traction_runs(viscoelastic=lambda v, T: 0.03, replicates=1, configurations=FOUR[3:])
    for curves in (
        replace(vf.separate(runs), source="a tribometer, of a kind"),
        replace(vf.separate(one_way, zero=0.3, coulomb=(0.05, 0.01)), source="one"),
    ):
        vf.write_friction_curves(curves, tmp_path / "curves.csv")
        same(vf.read_friction_curves(tmp_path / "curves.csv"), curves)


def test_every_column_is_saved(tmp_path: Path) -> None:
    """Whatever columns friction curves have: none may be lost without a word."""
    random = np.random.default_rng(4)
    names = [field.name for field in fields(FrictionCurves) if field.name not in WRITTEN | {"replicates"}]
    curves = FrictionCurves(
        replicates=np.array([3, 1]),
        source="x",
        load_unit="N/m",
        **{name: random.uniform(1.0, 2.0, 2) for name in names},  # type: ignore[arg-type]
    )
    curves = replace(curves, temperature=np.array([3.0, 900.1]))
    vf.write_friction_curves(curves, tmp_path / "all.csv")
    same(vf.read_friction_curves(tmp_path / "all.csv"), curves)


@given(
    arrays(float, (4, 3), elements=st.floats(1e-99, 1e99)),
    arrays(float, 3, elements=st.floats(1.0, 2000.0)),
    st.booleans(),
)
@settings(
    deadline=None,
    max_examples=20,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
def test_any_finite_numbers_come_back(
    tmp_path: Path, values: np.ndarray, temperature: np.ndarray, negative: bool
) -> None:
    speed, load, friction, error = values
    curves = FrictionCurves(
        speed=speed,
        temperature=temperature,
        load=load,
        viscoelastic=-friction if negative else friction,
        viscoelastic_error=error,
        viscoelastic_scatter=error,
        replicates=np.ones(3),
        source="made up",
    )
    vf.write_friction_curves(curves, tmp_path / "any.csv")
    found = vf.read_friction_curves(tmp_path / "any.csv")
    same(replace(found, notes=()), curves)  # what no rubber has is noted, once
    vf.write_friction_curves(found, tmp_path / "any.csv")
    same(vf.read_friction_curves(tmp_path / "any.csv"), found)


def test_notes_come_back_with_their_codes_and_values(tmp_path: Path) -> None:
    n = np.array([1.0, 2.0])
    said = (
        Note(
            "few-replicates",
            'A "quoted" sentence: with, commas',
            "run 1",
            Remedy("; a", "; b"),
            {"of": np.float64(3.0)},
        ),
        Note("", "A sentence without a code."),
        Note("", '{"no": "record"}'),
    )
    curves = FrictionCurves(n, 300.0 * n, n, 0.1 * n, 0.01 * n, 0.01 * n, np.ones(2), source="made up", notes=said)
    vf.write_friction_curves(curves, tmp_path / "noted.csv")
    found = vf.read_friction_curves(tmp_path / "noted.csv")
    same(found, curves)
    assert [one.record() for one in found.notes[:3]] == [one.record() for one in curves.notes]
    stored = json.loads(curves.points_dataset().attrs["note_records"])
    assert [note_of(one).code for one in stored] == ["few-replicates", "", ""]


def test_a_table_of_another_tribometer_is_read(tmp_path: Path) -> None:
    path = tmp_path / "other.csv"
    path.write_text(FOREIGN, encoding="utf-8")
    curves = vf.read_friction_curves(path)
    np.testing.assert_allclose(curves.speed, [0.02, 0.2], rtol=1e-15)
    np.testing.assert_allclose(curves.temperature, [303.15, 333.15], rtol=1e-15)
    np.testing.assert_allclose(curves.viscoelastic, [0.031, 0.025], rtol=1e-15)
    np.testing.assert_array_equal(curves.viscoelastic_error, np.inf)
    np.testing.assert_array_equal(curves.replicates, 1)
    assert curves.coulomb is None
    assert curves.load_unit == "N"
    assert curves.source == str(path)
    assert "errors-unknown" in codes(curves.notes)


def test_a_table_without_errors_is_shifted_by_the_scatter_of_its_points(tmp_path: Path) -> None:
    """Errors not known are found from the curves: the factors have those that points of 2 % scatter make of them."""
    curves, law, errors = synthetic_curves(30.0, 35.0, 40.0, 46.0, noise=0.02 * np.sqrt(8)), planted_law(), []
    path = tmp_path / "bare.csv"
    vf.write_friction_curves(curves, path)
    rows = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    kept = [place for place, heading in enumerate(rows[0]) if heading.split(" (")[0] in BARE]
    assert len(kept) == len(BARE)
    path.write_text("\n".join(",".join(row[place] for place in kept) for row in rows) + "\n", encoding="utf-8")
    for one in (vf.read_friction_curves(path), curves):
        factors = vf.shift_friction(one, reference="30 degC").shift_factors
        errors.append(factors.standard_errors[1:])
        off = factors.log10_values[1:] - np.asarray(law.at_reference(factors.reference).log10(factors.temperatures[1:]))
        assert np.all(np.abs(off) < 4.0 * errors[-1])
    # The scatter of 40 points is known to 11 %, in both; thrice that.
    np.testing.assert_allclose(errors[0], errors[1], rtol=0.35)


@pytest.mark.parametrize(
    ("given_column", "missing", "expected"),
    [("scatter", "error", 0.002 / 2.0), ("standard error", "scatter", 0.002 * 2.0)],
)
def test_standard_error_and_scatter_follow_from_each_other(
    tmp_path: Path, given_column: str, missing: str, expected: float
) -> None:
    path = tmp_path / "curves.csv"
    path.write_text(
        f"speed (m/s),T (K),load (N/mm),mu viscoelastic,viscoelastic friction {given_column},replicates\n"
        "0.1,300,1,0.03,0.002,4\n",
        encoding="utf-8",
    )
    curves = vf.read_friction_curves(path)
    assert getattr(curves, f"viscoelastic_{missing}") == pytest.approx([expected], rel=1e-15)
    assert curves.load == pytest.approx([1000.0])
    assert curves.load_unit == "N/m"
    assert curves.notes == ()


@pytest.mark.parametrize(
    ("old", "new", "refusal"),
    [
        ("speed (mm/s)", "pace (mm/s)", ("missing-columns", "'speed (mm/s)'")),
        ("60;25", "60;0", ("out-of-range", "line 3", "'0'", "'load (N)'")),
    ],
)
def test_wrong_tables_are_refused_with_the_place(tmp_path: Path, old: str, new: str, refusal: tuple[str, ...]) -> None:
    with refused(refusal[0], DataFileError, naming=refusal[1:]):
        read(tmp_path, FOREIGN.replace(old, new))


@pytest.mark.parametrize("column", ["viscoelastic friction standard error", "viscoelastic friction scatter"])
def test_errors_in_per_cent_of_a_plain_coefficient_are_refused(tmp_path: Path, column: str) -> None:
    path = tmp_path / "curves.csv"
    head, row = "speed (mm/s),temperature (degC),load (N),viscoelastic friction{},{} (%)\n", "20,30,25,{},1\n"
    path.write_text((head + row).format("", column, 0.03), encoding="utf-8")
    with refused("wrong-unit", DataFileError, naming=(column,)):
        vf.read_friction_curves(path)
    path.write_text((head + row).format(" (%)", column, 3), encoding="utf-8")
    assert getattr(vf.read_friction_curves(path), f"viscoelastic_{column.split()[-1]}") == pytest.approx([0.01])


@pytest.mark.parametrize(
    ("column", "cell", "refusal"),
    [
        ("replicates", "2.5", ("out-of-range", "'2.5'", "'replicates'")),
        ("replicates", "0", ("out-of-range",)),
        ("viscoelastic error", "-1", ("out-of-range", "'-1'", "'viscoelastic error'")),
        ("viscoelastic error", "inf", ("not-a-number", "'inf'", "'viscoelastic error'")),
    ],
)
def test_wrong_optional_columns_are_refused(tmp_path: Path, column: str, cell: str, refusal: tuple[str, ...]) -> None:
    with refused(refusal[0], DataFileError, naming=refusal[1:]):
        read(tmp_path, f"speed (m/s),T (K),load (N),viscoelastic,{column}\n1,300,1,0.1,{cell}\n")


def test_no_curves_and_no_folder_are_refused(tmp_path: Path) -> None:
    curves = vf.separate(traction_runs(viscoelastic=lambda v, T: 0.03))
    with refused("empty-list"):
        vf.write_friction_curves(curves.select(np.zeros(len(curves), dtype=bool)), tmp_path / "none.csv")
    (tmp_path / "file").write_text("", encoding="utf-8")
    with refused("not-written", DataFileError):
        vf.write_friction_curves(curves, tmp_path / "file" / "curves.csv")


def test_errors_that_are_not_known_go_through_master_curves(tmp_path: Path) -> None:
    """No standard error is told of what is read from them, and none of the comparison."""
    curves = synthetic_curves(30.0, 35.0, 40.0)
    unknown = replace(curves, viscoelastic_error=np.full(len(curves), np.inf))
    master = vf.shift_friction(unknown, shift=planted_law())
    middle = float(np.sqrt(np.prod(master.reduced_range)))
    assert master.standard_error(middle) == np.inf
    assert master(middle) == pytest.approx(vf.shift_friction(curves, shift=planted_law())(middle), rel=0.02)
    assert master.overlap.error == np.inf
    assert master.overlap.sentence.values["expected"] == np.inf
    assert vf.compare(master, master).share_within_error is None


def test_columns_that_are_not_read_are_named(tmp_path: Path) -> None:
    path = tmp_path / "curves.csv"
    path.write_text(
        FOREIGN.replace("\n20", ";viscoelastic friction std dev\n20").replace("1\n", "1;1\n").replace("5\n", "5;1\n")
    )
    notes = vf.read_friction_curves(path).notes
    (note,) = [note for note in notes if "unused-columns" in codes([note])]
    assert note.values == {"headings": ["viscoelastic friction std dev"]}


def test_friction_of_any_origin_is_noted_and_traction_runs_are_refused(tmp_path: Path) -> None:
    """A coefficient of sliding friction includes Coulomb friction, and a sliding speed is not that of the rubber."""
    path = tmp_path / "curves.csv"
    path.write_text(FOREIGN.replace("viscoelastic friction", "friction coefficient"), encoding="utf-8")
    found = vf.read_friction_curves(path)
    assert found.viscoelastic == pytest.approx([0.031, 0.025], rel=1e-12)
    assert "total-friction" in codes(found.notes)
    for columns in ({"viscoelastic_friction": "friction coefficient (%)"}, None):
        text = FOREIGN if columns is None else path.read_text()
        (tmp_path / "stated.csv").write_text(text, encoding="utf-8")
        assert "total-friction" not in codes(vf.read_friction_curves(tmp_path / "stated.csv", columns=columns).notes)
    speeds = ("rolling speed (mm/s);sliding speed (mm/s)", "disc speed (mm/s);ball speed (mm/s)")
    for header, friction in itertools.product(speeds, ("friction coefficient;0.03", "friction force (N);0.75")):
        runs = tmp_path / "runs.csv"
        name, value = friction.split(";")
        runs.write_text(f"{header};temperature (degC);load (N);{name}\n20;1;30;25;{value}\n", "utf-8")
        assert not holds_friction_curves(runs)
        with refused("traction-runs", DataFileError):
            vf.read_friction_curves(runs)
        assert vf.read_mtm(runs).traction_force == pytest.approx([0.75], rel=1e-12)


@pytest.mark.parametrize(
    "table",
    [
        "speed (mm/s),load (N),friction force (N)\n20,25,10\n200,50,15\n",
        "speed (m/min),Fn (kgf),Ff (gf)\n1.2,2.5,1000\n12,5,1500\n",
        "v (rpm),track radius (m),load (N),Reibkraft (kN)\n30,0.1,25,.01\n300,0.1,50,.015\n",
        "speed (mm/s),load (N/m),friction force (N/m)\n20,25,10\n200,50,15\n",
        "speed (mm/s),friction force 25 N (N)\n20,10\n200,7.5\n",
    ],
)
def test_forces_of_friction_are_read_as_coefficients_in_any_unit(tmp_path: Path, table: str) -> None:
    """A friction force over the load is the coefficient, which includes Coulomb friction."""
    found = read(tmp_path, table, columns={"temperature": "= 30 degC"})
    assert found.viscoelastic == pytest.approx([0.4, 0.3], rel=1e-12)
    assert found.speed[1] / found.speed[0] == pytest.approx(10.0, rel=1e-12)
    assert "total-friction" in codes(found.notes)
    assert "unused-columns" not in codes(found.notes)
    assert holds_friction_curves(tmp_path / "curves.csv")


def test_copies_among_thousands_of_exact_readings_are_found_at_once() -> None:
    """With the cells of rounding of every speed it would take minutes."""
    speed = np.arange(1.0, 3001.0)
    friction = 0.2 + 0.05 * np.random.default_rng(0).standard_normal(3000)
    found = notes_on_copies(np.tile(friction, 2), np.tile(speed, 2))
    assert codes(found) == {"copied-rows"}


def test_columns_of_a_lubricated_test_are_noted(tmp_path: Path) -> None:
    header = "speed (mm/s),load (N),COF,viscosity (mPa s),Hersey number"
    columns = {"temperature": "= 30 degC"}
    found = read(tmp_path, f"{header}\n20,25,0.2,100,8e-5\n", columns=columns)
    assert {"lubricated", "unused-columns"} <= set(codes(found.notes))
    assert "lubricated" not in codes(read(tmp_path, "speed (mm/s),load (N),COF\n20,25,0.2\n", columns=columns).notes)
    assert "unit-assumed" not in codes(found.notes)
    for dry in ("", "none", "Dry"):
        header = "speed (mm/s),load (N),COF,viscosity (mPas),lubricant"
        held = read(tmp_path, f"{header}\n20,25,0.2,,{dry}\n", columns=columns)
        assert not {"lubricated", "unit-assumed"} & set(codes(held.notes))
    runs = tmp_path / "runs.csv"
    runs.write_text("disc speed (mm/s),ball speed (mm/s),load (N),traction force (N),Lubricant\n20,18,25,0.2,PAO\n")
    assert "lubricated" in codes(vf.read_mtm(runs, columns=columns).notes)


def test_a_coefficient_is_preferred_to_its_force_and_zero_load_has_none(tmp_path: Path) -> None:
    table = "speed (mm/s),load (N),friction force (N),COF\n20,25,10,0.41\n"
    columns = {"temperature": "= 30 degC"}
    assert read(tmp_path, table, columns=columns).viscoelastic.tolist() == [0.41]
    with refused("out-of-range", DataFileError):
        read(tmp_path, "speed (mm/s),load (N),friction force (N)\n20,0,10\n", columns=columns)
    with refused("wrong-unit", DataFileError):
        read(tmp_path, "speed (mm/s),load (N/m),friction force (N)\n20,25,10\n", columns=columns)


@pytest.mark.parametrize("friction", ["COF", "friction force (N)"])
def test_sliding_friction_of_both_directions_is_refused(tmp_path: Path, friction: str) -> None:
    """Signed by the direction of motion it is no friction to be read as it is; noise about zero is."""
    columns = {"temperature": "= 30 degC", "load": "= 1 N"}
    with refused("both-directions", DataFileError):
        read(tmp_path, f"speed (mm/s),{friction}\n20,0.41\n20,-0.38\n", columns=columns)
    assert read(tmp_path, f"speed (mm/s),{friction}\n20,0.41\n200,-0.01\n", columns=columns).viscoelastic.min() < 0.0


def test_friction_below_zero_within_its_error_is_of_no_other_direction(tmp_path: Path) -> None:
    header = "speed (mm/s),COF,viscoelastic friction standard error"
    table = f"{header}\n20,0.06,0.03\n200,-0.02,0.03\n"
    found = read(tmp_path, table, columns={"temperature": "= 30 degC", "load": "= 1 N"})
    assert found.viscoelastic.tolist() == [0.06, -0.02]


BOTH = "speed (mm/s),load (N),"
AT = {"temperature": "= 30 degC"}


@pytest.mark.parametrize(
    "table",
    [
        f"{BOTH}COF forward,COF backward\n20,50,0.5,-0.4\n60,50,0.3,-0.32\n",
        f"{BOTH}friction force fwd (N),friction force bwd (N)\n20,50,25,20\n60,50,15,16\n",
        f"{BOTH}direction,COF\n20,50,+,0.5\n60,50,+,0.3\n60,50,-,-0.32\n20,50,-,-0.4\n",
        f"{BOTH}direction,friction force (N)\n20,50,back,20\n20,50,Forward,25\n60,50,Forward,15\n60,50,back,16\n",
    ],
    ids=["coefficients", "forces", "rows", "rows of forces"],
)
def test_friction_of_both_directions_is_their_mean_magnitude(tmp_path: Path, table: str) -> None:
    """Half of the difference is the force cell's offset, which is no scatter."""
    curves = read(tmp_path, table, columns=AT)
    assert curves.viscoelastic == pytest.approx([0.45, 0.31])
    assert curves.speed == pytest.approx([0.02, 0.06])
    assert holds_friction_curves(tmp_path / "curves.csv")
    notes = {note.code: note for note in map(note_of, curves.notes)}
    assert "unused-columns" not in notes
    assert notes["both-directions-averaged"].values == {"pairs": 2, "offset": pytest.approx(0.05 / 0.45)}


def test_errors_of_two_directions_are_those_of_their_mean(tmp_path: Path) -> None:
    """Independent ones fall by √2, as do those of repetitions, which are paired in their order."""
    table = f"{BOTH}direction,COF,viscoelastic scatter,replicates\n"
    rows = "20,50,1,0.5,0.03,4\n20,50,1,0.52,0.03,4\n20,50.4,2,0.4,0.04,5\n20,50,2,0.4,0.04,5\n"
    curves = read(tmp_path, table + rows, columns=AT)
    assert curves.viscoelastic == pytest.approx([0.45, 0.46])
    assert curves.load == pytest.approx([50.2, 50.0])
    assert curves.viscoelastic_scatter == pytest.approx([0.025] * 2)
    assert curves.viscoelastic_error == pytest.approx([0.025 / 2.0] * 2)


@pytest.mark.parametrize(
    ("table", "code"),
    [
        ("COF forward\n20,50,0.5\n", "missing-columns"),
        ("direction,COF\n20,50,1,0.5\n20,50,2,0.4\n60,50,1,0.3\n", "no-partner"),
        ("direction,COF\n20,50,1,0.5\n30,50,2,0.4\n", "no-partner"),
        ("direction,COF\n20,50,1,0.5\n20,50,2,0.4\n20,50,3,0.4\n", "out-of-range"),
    ],
)
def test_a_direction_without_the_other_is_refused(tmp_path: Path, table: str, code: str) -> None:
    with refused(code, DataFileError):
        read(tmp_path, BOTH + table, columns=AT)


def test_headings_of_curves_are_found_as_those_of_any_table(tmp_path: Path) -> None:
    path = tmp_path / "curves.csv"
    path.write_text(FOREIGN, encoding="utf-8")
    plain = vf.read_friction_curves(path)
    names, *rows = FOREIGN.splitlines()
    split = [part.rstrip(")").split(" (") for part in names.split(";")]
    below = [";".join(name for name, _ in split), ";".join(f"[{unit}]" for _, unit in split), *rows]
    for lines in (["Rig 3", "date; today", names, *rows], below, [line.replace(";", "   ") for line in below]):
        path.write_text("\n".join(lines), encoding="utf-8")
        same(replace(vf.read_friction_curves(path), source=""), replace(plain, source=""))


NAMED = {"speed": "v1 (mm/s)", "temperature": "ofen (degC)", "viscoelastic_friction": "#4 (%)"}


def test_columns_of_curves_are_named(tmp_path: Path) -> None:
    text = FOREIGN.replace("speed (mm/s)", "v1").replace("temperature (degC)", "Ofen (degC)")
    strange = tmp_path / "strange.csv"
    strange.write_text("Rig 3\n" + text.replace("viscoelastic friction (%)", "mu_v"), encoding="utf-8")
    (tmp_path / "plain.csv").write_text(FOREIGN, encoding="utf-8")
    assert not holds_friction_curves(strange)
    assert holds_friction_curves(strange, NAMED)
    found, plain = vf.read_friction_curves(strange, columns=NAMED), vf.read_friction_curves(tmp_path / "plain.csv")
    same(replace(found, source="", notes=()), replace(plain, source="", notes=()))
    with refused("missing-columns", DataFileError) as caught:
        vf.read_friction_curves(strange, columns={"speed": "v1 (mm/s)"})
    assert caught.value.note.values["missing"] == ["temperature", "viscoelastic friction"]
    with refused("no-column", DataFileError):
        vf.read_friction_curves(strange, columns=NAMED | {"load": "Kraft"})
    with refused("unknown-quantity"):
        vf.read_friction_curves(strange, columns={"colour": "red"})


def test_curves_of_a_workbook_are_read(tmp_path: Path) -> None:
    path = tmp_path / "rig.xlsx"
    rows = [["speed (mm/s)", "T (degC)", "load (N)", "friction coefficient"], [20.0, 30.0, 25.0, 0.031]]
    workbook.write(path, {"about": [["Rig 3"]], "run 1": rows, "run 2": rows})
    assert holds_friction_curves(path)
    with refused("several-tables", DataFileError):
        vf.read_friction_curves(path)
    assert vf.read_friction_curves(path, sheet="run 2").viscoelastic == pytest.approx([0.031], rel=1e-12)
    with refused("no-sheet", DataFileError):
        vf.read_friction_curves(path, sheet="run 3")


@pytest.mark.parametrize(
    ("header", "log"),
    [
        ("T (°C),Sliding Velocity (mm/s),COF,Fz (N)", False),
        ("Temperature (°C),Gleitgeschwindigkeit (mm/s),Reibungszahl,Normalkraft (N)", False),
        ("Temperatur (°C),Geschwindigkeit (mm/s),Reibwert,Last (N)", False),
        ("Température (°C),Vitesse (mm/s),Coefficient de frottement,Force normale (N)", False),
        ("Temperature (°C),log v (mm/s),µ,load (N)", True),
    ],
)
def test_columns_of_other_tribometers_are_known(tmp_path: Path, header: str, log: bool) -> None:
    speeds = [math.log10(speed) if log else speed for speed in (20.0, 60.0, 200.0)]
    rows = [f"{T},{speed!r},0.0{3 + n},25" for T in (20, 40) for n, speed in enumerate(speeds)]
    curves = read(tmp_path, "\n".join([header, *rows]))
    assert curves.speed == pytest.approx([0.02, 0.06, 0.2] * 2)
    assert curves.viscoelastic == pytest.approx([0.03, 0.04, 0.05] * 2)
    assert {"total-friction", "errors-unknown"} <= codes(curves.notes)
    assert ("decadic-logarithms" in codes(curves.notes)) == log


@pytest.mark.parametrize(
    "text",
    [
        "speed (mm/s);µ 25 °C;µ 40 °C\n1;0,1;0,2\n10;0,15;0,25\n",
        ";25 °C;40 °C\nspeed (mm/s);µ;µ\n1;0,1;0,2\n10;0,15;0,25\n",
        "25 °C\nspeed (mm/s);µ\n1;0,1\n10;0,15\n40 °C\nspeed (mm/s);µ\n1;0,2\n10;0,25\n",
    ],
    ids=["headings", "above", "below"],
)
def test_curves_of_several_temperatures_beside_or_below_each_other(tmp_path: Path, text: str) -> None:
    with refused("missing-columns") as caught:
        read(tmp_path, text)
    assert caught.value.note.values["missing"] == ["load"]
    curves = read(tmp_path, text, columns={"load": "= 20,5 N"})
    assert curves.speed == pytest.approx([1e-3, 1e-2] * 2)
    assert curves.temperature == pytest.approx([298.15] * 2 + [313.15] * 2)
    assert curves.viscoelastic == pytest.approx([0.1, 0.15, 0.2, 0.25])
    assert curves.load == pytest.approx(20.5)
    assert "temperature-from-title" in codes(curves.notes)


@pytest.mark.parametrize(("said", "code"), [("= 20", "no-unit"), ("= ten N", "wrong-columns"), ("= 2 s", "wrong-unit")])
def test_a_value_of_all_rows_is_a_number_with_its_unit(tmp_path: Path, said: str, code: str) -> None:
    with refused(code):
        read(tmp_path, "speed (mm/s),T (°C),mu\n1,25,0.1\n", columns={"load": said})


def test_a_value_of_all_rows_does_not_replace_a_column(tmp_path: Path) -> None:
    with refused("value-not-needed", naming="'load (N)'"):
        read(tmp_path, FOREIGN, columns={"load": "= 0.03 kN"})


def test_gaps_and_named_columns_of_curves_beside_each_other(tmp_path: Path) -> None:
    path = tmp_path / "curves.csv"
    path.write_text("v1;mu 25 °C;mu 40 °C\n1;0.1;-\n10;n/a;0.2\n", encoding="utf-8")
    curves = vf.read_friction_curves(path, columns={"speed": "v1 (mm/s)", "load": "= 20 N"})
    assert curves.speed == pytest.approx([1e-3, 1e-2])
    assert curves.temperature == pytest.approx([298.15, 313.15])
    path.write_text("v (mm/s);mu - 10 °C\n1;0.1\n", encoding="utf-8")  # a dash or a minus
    with refused("dash-or-minus"):
        vf.read_friction_curves(path, columns={"load": "= 20 N"})


def test_curves_of_two_compounds_below_each_other_are_refused(tmp_path: Path) -> None:
    header, rows = FOREIGN.split("\n", 1)
    path = tmp_path / "curves.csv"
    path.write_text(f"Compound A;;;\n{header}\n{rows}Compound B;;;\n{header}\n{rows}", encoding="utf-8")
    with refused("several-tables"):
        vf.read_friction_curves(path)
    path.write_text(f"{header}\n{rows}{header}\n{rows}", encoding="utf-8")  # a header on each page
    assert len(vf.read_friction_curves(path)) == 4


@pytest.mark.parametrize("name", ["mean speed (mm/s)", "average temperature (degC)"])
def test_means_of_speeds_and_temperatures_are_not_those_of_a_point(tmp_path: Path, name: str) -> None:
    kind = "speed (mm/s)" if "speed" in name else "temperature (degC)"
    with refused("missing-columns"):
        read(tmp_path, FOREIGN.replace(kind, name))


def test_unread_columns_of_curves_beside_each_other_are_noted(tmp_path: Path) -> None:
    rows = ";25 °C;;60 °C;", "speed (m/s);mu;sd;mu;sd", "0.01;0.1;0.01;0.2;0.03", "0.1;0.15;0.01;0.25;0.04"
    curves = read(tmp_path, "\n".join(rows), columns={"load": "= 20 N"})
    assert curves.viscoelastic == pytest.approx([0.1, 0.15, 0.2, 0.25])
    (unused,) = (note for note in map(note_of, curves.notes) if note.code == "unused-columns")
    assert unused.values["headings"] == ["25 °C sd", "60 °C sd"]


@pytest.mark.parametrize(("second", "holds"), [("20 N, 60 °C", True), ("40 N, 60 °C", False), ("0,02 kN; 60 °C", True)])
def test_a_load_of_all_rows_is_refused_where_tables_state_several(tmp_path: Path, second: str, holds: bool) -> None:
    path = tmp_path / "curves.csv"
    table = "speed (m/s)\tmu\n0.01\t0.1\n0.1\t0.15"
    path.write_text(f"20 N, 25 °C\n{table}\n\n{second}\n{table}\n", encoding="utf-8")
    if holds:
        assert vf.read_friction_curves(path, columns={"load": "= 20 N"}).load == pytest.approx([20.0] * 4)
        return
    with refused("several-tables") as caught:
        vf.read_friction_curves(path, columns={"load": "= 20 N"})
    assert "40 N" in str(caught.value)


@pytest.mark.parametrize("heading", ["mu_60C", "60 °C mu", "mu 60 °C", "mu (60 °C)", "mu 60 °C (%)"])
def test_a_temperature_of_all_rows_is_not_that_of_another_heading(tmp_path: Path, heading: str) -> None:
    path = tmp_path / "curves.csv"
    rows = f"speed (m/s);{heading.replace('60', '25')};{heading}", "0.01;0.1;0.2", "0.1;0.15;0.25"
    path.write_text("\n".join(rows), encoding="utf-8")
    named = {"load": "= 20 N", "viscoelastic_friction": f"{heading} (-)"}
    with refused("temperatures-contradict") as caught:
        vf.read_friction_curves(path, columns={**named, "temperature": "= 25 degC"})
    assert repr(heading) in str(caught.value)
    assert vf.read_friction_curves(path, columns={**named, "temperature": "= 60 degC"}).viscoelastic.tolist() == [
        0.2,
        0.25,
    ]


@pytest.mark.parametrize(
    ("remark", "made"),
    [
        ("synthetic data", True),
        ("synthetic fluoroelastomer", True),  # of the catalogue
        ("synthetic polyisoprene IR 2200", False),
        ("counterface: synthetic leather", False),
        ("in synthetic base oil", False),
        ("measured, not synthetic", False),
    ],
)
def test_substances_that_are_synthetic_may_be_measured(tmp_path: Path, remark: str, made: bool) -> None:
    path = tmp_path / "data.csv"
    path.write_text(f"# {remark}\nspeed (mm/s)\n20\n")
    assert says_synthetic(path) is made


def test_what_synthetic_runs_and_rubbers_give_is_synthetic_after_writing_and_reading(tmp_path: Path) -> None:
    """Also where the remark of a table is left behind, and in workbooks; measured friction is not."""
    first, again, other = (tmp_path / name for name in ("one.csv", "two.csv", "other.csv"))
    vf.write_friction_curves(vf.separate(vf.read_mtm(files("viscofric") / "example" / "mtm.csv")), first)
    assert says_synthetic(first)
    vf.write_friction_curves(vf.read_friction_curves(first).select([0, 1]), again)
    assert says_synthetic(again)
    rubber = vf.synthetic_fluoroelastomer()
    predicted = vf.predict_friction(rubber, vf.Ball("10 mm"), speeds=[0.1], load="5 N", temperatures=[303.15])
    vf.write_friction_curves(predicted, other)
    assert says_synthetic(other)
    assert str(vf.citations(vf.read_friction_curves(other))) == str(vf.citations(predicted))
    vf.write_friction_curves(replace(predicted, source="a tribometer"), other)
    assert not says_synthetic(other)
    for remark, synthetic in (("# SYNTHETIC, of a model", True), ("# measured on synthetic rubber", False)):
        rows = [[remark], *(line.replace(",", ".").split(";") for line in FOREIGN.splitlines())]
        book = workbook.write(tmp_path / "curves.xlsx", {"friction": rows})
        assert says_synthetic(book) is synthetic
        vf.write_friction_curves(vf.read_friction_curves(book), other)
        assert says_synthetic(other) is synthetic


@pytest.mark.parametrize("stroke", ["stroke", "Stroke length", "Hub"])
def test_frequency_and_stroke_are_a_mean_speed(tmp_path: Path, stroke: str) -> None:
    curves = read(tmp_path, f"frequency (Hz);{stroke} (mm);T (°C);load (N);COF\n10;2;25;20;0.3\n50;1;25;20;0.4")
    assert curves.speed == pytest.approx([0.04, 0.1])  # there and back in one period
    assert "speed-of-stroke" in codes(curves.notes)
    assert "unused-columns" not in codes(curves.notes)


def test_a_stroke_may_be_that_of_all_rows_and_is_asked_for(tmp_path: Path) -> None:
    text = "frequency (Hz);T (°C);load (N);COF\n10;25;20;0.3"
    assert read(tmp_path, text, columns={"stroke": "= 2 mm"}).speed == pytest.approx([0.04])
    with refused("missing-columns"):
        read(tmp_path, text)
