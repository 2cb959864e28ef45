"""Traction tables: signed speeds and forces in SI units, replicates told apart, nonsense refused."""

from __future__ import annotations

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.written import write
from viscofric import read_mtm
from viscofric.notes import codes

HEADER = "temperature (degC),replicate,disc speed (mm/s),ball speed (mm/s),load (N),traction force (N)"
ROW = "30,1,-100,90,25,-0.4"
WITHOUT = HEADER.replace("replicate,", "")


def test_signs_and_units_survive(tmp_path):
    runs = read_mtm(write(tmp_path, HEADER, ROW))
    assert runs.disc_speed == pytest.approx([-0.1])
    assert runs.ball_speed == pytest.approx([0.09])
    assert runs.traction_force == pytest.approx([-0.4])
    assert runs.load == pytest.approx([25.0])
    assert runs.temperature == pytest.approx([303.15])
    assert list(runs.replicate) == [1]
    assert runs.notes == ()


def test_metres_per_second_and_other_order_of_columns(tmp_path):
    runs = read_mtm(write(tmp_path, "load (kN),T (K),ball_speed (m/s),disc_speed (m/s),traction (mN)", "1,300,2,3,4"))
    assert runs.load == pytest.approx([1000.0])
    assert runs.disc_speed == pytest.approx([3.0])
    assert runs.traction_force == pytest.approx([0.004])


@pytest.mark.parametrize("line", ["Load: 25 N", "Normalkraft : 25.00 [N]", "Ball load (N),25"])
def test_a_load_above_the_table_holds_for_all_rows(tmp_path, line):
    header = "T (°C),Scheibengeschwindigkeit (mm/s),ball velocity (mm/s),Reibkraft (N)"
    runs = read_mtm(write(tmp_path, line, header, "30,100,90,0.4", "30,-100,-90,-0.4"))
    assert runs.load == pytest.approx([25.0, 25.0])
    assert "value-from-above" in codes(runs.notes)


def test_several_files_follow_each_other(tmp_path):
    first = write(tmp_path, HEADER, ROW, name="one.csv")
    second = write(tmp_path, HEADER, ROW.replace("30,1", "60,2"), name="two.csv")
    runs = read_mtm(first, second)
    assert list(runs.replicate) == [1, 2]
    assert runs.temperature == pytest.approx([303.15, 333.15])
    assert "one.csv" in runs.source
    assert "two.csv" in runs.source


@pytest.mark.parametrize(
    "header",
    [
        "Temperatur (°C),Scheibengeschwindigkeit (mm/s),Kugelgeschwindigkeit (mm/s),Last (N),Reibkraft (N)",
        "Température (°C),Vitesse du disque (mm/s),Vitesse de la bille (mm/s),Charge (N),Force de frottement (N)",
    ],
)
def test_headings_in_other_languages(tmp_path, header):
    runs = read_mtm(write(tmp_path, header, "30,100,90,25,0.4"))
    assert (runs.disc_speed[0], runs.ball_speed[0]) == pytest.approx((0.1, 0.09), rel=1e-12)
    assert (runs.traction_force[0], runs.load[0]) == (0.4, 25.0)


def test_files_that_are_each_numbered_from_one_are_different_repetitions(tmp_path):
    days = ("0.40", "0.41", "0.39")
    files = [
        write(tmp_path, HEADER, *(f"30,{one},100,90,25,{force}" for one in (1, 2)), name=f"day{day}.csv")
        for day, force in enumerate(days)
    ]
    runs = read_mtm(*files)
    assert list(runs.replicate) == [1, 2, 3, 4, 5, 6]
    assert [note.split(":")[0] for note in runs.notes] == ["day1.csv", "day2.csv"]
    assert noted(runs.notes[:1], "replicates-renumbered", "3 to 4")


@pytest.mark.parametrize("other", ["60,1,100,90,25,0.4", "30,1,-100,-90,25,-0.4", "30,1,100,101,25,-0.4"])
def test_files_of_other_conditions_keep_their_replicates(tmp_path, other):
    """One file for each temperature, direction or sense of slip: replicate 1 is the same repetition in all of them."""
    first = write(tmp_path, HEADER, "30,1,100,99,25,0.4", name="one.csv")
    runs = read_mtm(first, write(tmp_path, HEADER, other, name="two.csv"))
    assert list(runs.replicate) == [1, 1]
    assert runs.notes == ()


def test_equal_conditions_are_numbered_though_readings_scatter(tmp_path):
    rows = [
        "30.4,100,90,25,0.4",
        "30.5,120,90,25,0.4",
        "30.6,99.4,90.3,25,0.5",
        "60,100,90,25,0.4",
        "30.1,-100,-90,25,0",
    ]
    runs = read_mtm(write(tmp_path, WITHOUT, *rows))
    assert list(runs.replicate) == [1, 1, 2, 1, 1]
    assert codes(runs.notes) == {"replicates-counted"}


@pytest.mark.parametrize(("steps", "numbers"), [(None, [1, 1, 1, 2, 2]), ([1, 2, 2, 4, 5], [1, 2, 1, 3, 4])])
def test_rows_of_one_pass_are_one_replicate(tmp_path, steps, numbers):
    """Readings in succession at equal values are no repetitions, unless they are of different steps."""
    rows = ["30,100,90,25,0.4", "30,100.2,90,25,0.5", "30,50,45,25,0.5", "30,100,90,25,0.4", "30,99.8,90,25,0.5"]
    header = WITHOUT
    if steps:
        header, rows = f"{WITHOUT},step", [f"{row},{step}" for row, step in zip(rows, steps, strict=True)]
    assert list(read_mtm(write(tmp_path, header, *rows)).replicate) == numbers


@pytest.mark.parametrize("numbered", ["Traction Force 1 (N)", "TF2 (N)", "disc_speed_2 (mm/s)", "Ball Speed #1 (m/s)"])
def test_numbered_forces_and_speeds_are_not_passed_over(tmp_path, numbered):
    """They are readings of their own: of the force with the slip one way and the other."""
    with refused("several-readings-a-row", None, repr(numbered)):
        read_mtm(write(tmp_path, f"{HEADER},{numbered}", f"{ROW},1.2"))


@pytest.mark.parametrize(
    ("heading", "agrees", "contradicts"),
    [("sliding speed (mm/s)", "5", "10"), ("SRR (%)", "5.13", "2.56"), ("SRR (-)", "0.0513", "5.13")],
)
def test_slip_beside_both_speeds_must_agree_with_them(tmp_path, heading, agrees, contradicts):
    header = f"temperature (degC),disc speed (mm/s),ball speed (mm/s),load (N),traction force (N),{heading}"
    for slip, wrong in ((agrees, False), (f"-{agrees}", False), (contradicts, True)):
        path = tmp_path / "runs.csv"
        path.write_text("\n".join([header, *[f"20,100,95,25,1.3,{slip}"] * 3]), encoding="utf-8")
        notes = read_mtm(path).notes
        assert ("slip-contradicts" in codes(notes)) == wrong
        assert ("unused-columns" in codes(notes)) == wrong


def test_a_dash_in_a_row_of_units_is_the_unit_of_a_ratio(tmp_path):
    lines = ["temperature,load,rolling speed,SRR,traction force", "degC,N,mm/s,-,N", "20,25,100,0.5,1.3"]
    assert read_mtm(write(tmp_path, *lines)).disc_speed == pytest.approx([0.125], rel=1e-12)


def test_columns_that_are_not_read_are_named(tmp_path):
    runs = read_mtm(write(tmp_path, f"{HEADER},load 2 (N),remark,step", f"{ROW},25,run in,1"))
    (note,) = runs.notes
    assert codes([note]) == {"unused-columns"}
    assert "'load 2 (N)', 'remark'" in note
    assert "step" not in note


@pytest.mark.parametrize(
    ("lines", "refusal"),
    [
        ([HEADER, ROW.replace("25", "0")], ("not-positive", 2, "0", "'load (N)'")),
        ([HEADER, ROW.replace("25", "-25")], ("not-positive", 2, "-25")),
        ([HEADER, ROW.replace("30,1", "30,1.5")], ("not-a-whole-number", 2)),
        ([HEADER, ROW.replace("-0.4", "nan")], ("not-a-number", 2, "'nan'")),
        ([HEADER, ROW.replace("30,", "-300,")], ("not-positive", 2)),
        ([HEADER.replace("ball speed", "slip"), ROW], ("missing-columns", None, "ball speed", "slip")),
        ([HEADER.replace("mm/s", "mm"), ROW], ("wrong-unit", None, "'disc speed (mm)'", "'mm'")),
    ],
)
def test_what_is_wrong_is_said_in_one_sentence(tmp_path, lines, refusal):
    with refused(*refusal):
        read_mtm(write(tmp_path, *lines))


def test_mixed_replicate_columns_and_no_file_at_all_are_refused(tmp_path):
    first = write(tmp_path, HEADER, ROW, name="one.csv")
    second = write(tmp_path, WITHOUT, ROW.replace("30,1", "30"), name="two.csv")
    with refused("no-replicates", None, "two.csv"):
        read_mtm(first, second)
    with refused("no-files"):
        read_mtm()
    third = write(tmp_path, HEADER, ROW.replace("100", "200", 1), name="three.csv")
    assert len(read_mtm([first, third])) == 2


def test_readings_cannot_be_changed_afterwards(tmp_path):
    runs = read_mtm(write(tmp_path, HEADER, ROW))
    with pytest.raises(ValueError, match="read-only"):
        runs.load[0] = np.pi


def test_replicates_beyond_all_counting_are_refused(tmp_path):
    for number in ("1e30", "-1e30"):
        with refused("not-a-whole-number", 2, "1000000000"):
            read_mtm(write(tmp_path, HEADER, ROW.replace("30,1", f"30,{number}")))


def test_readings_given_twice_are_refused(tmp_path):
    first = write(tmp_path, HEADER, ROW, name="one.csv")
    copy = write(tmp_path, "# a copy", HEADER, ROW, name="two.csv")
    with refused("given-twice", None, "one.csv"):
        read_mtm(first, tmp_path / ".." / tmp_path.name / "one.csv")
    with refused("given-twice", None, "two.csv", "one.csv"):
        read_mtm(first, copy)


def test_different_loads_are_different_conditions(tmp_path):
    rows = ["30,100,90,25,0.4", "30,100,90,50,0.8", "30,100,90,25.2,0.4", "30,100,90,49.8,0.8"]
    assert list(read_mtm(write(tmp_path, WITHOUT, *rows)).replicate) == [1, 1, 2, 2]


def test_optional_columns_are_read_and_may_have_gaps(tmp_path):
    header = HEADER + ",zero force (mN),time (min),step,track radius (mm)"
    lines = [f"{ROW},250,7,3,21.2", f"{ROW.replace('-0.4', '-0.5')},,6,4,21.2", f"{ROW.replace('-0.4', '-0.6')},-,,4,"]
    runs = read_mtm(write(tmp_path, header, *lines))
    assert runs.zero_force == pytest.approx([0.25, np.nan, np.nan], nan_ok=True)
    assert runs.time == pytest.approx([60.0, 0.0, np.nan], nan_ok=True)
    assert runs.track_radius == pytest.approx([0.0212, 0.0212, np.nan], nan_ok=True)
    assert list(runs.step) == [3, 4, 4]
    assert [step.readings for step in runs.steps] == [1, 2]
    assert runs.steps[1].load == pytest.approx(25.0)
    with refused("not-a-whole-number", 2, "2.5", "'step'"):
        read_mtm(write(tmp_path, HEADER + ",step", ROW + ",2.5"))
    with refused("not-positive", 2, "0", "'track radius (mm)'"):
        read_mtm(write(tmp_path, HEADER + ",track radius (mm)", ROW + ",0"))


def test_columns_that_one_file_lacks_are_not_known_there(tmp_path):
    first = write(tmp_path, HEADER + ",zero force (N),step", ROW + ",0.1,7", name="one.csv")
    second = write(tmp_path, HEADER, ROW.replace("30,1", "60,2"), name="two.csv")
    runs = read_mtm(first, second)
    assert runs.zero_force == pytest.approx([0.1, np.nan], nan_ok=True)
    assert list(runs.step) == [7, 8]
    assert [step.source for step in runs.steps] == [str(first), str(second)]
    assert runs.time is None


def test_times_of_tables_begin_anew_with_each_file(tmp_path):
    first = write(tmp_path, HEADER + ",time (s)", ROW + ",100", ROW + ",105", name="one.csv")
    second = write(tmp_path, HEADER + ",time (s)", ROW.replace("30,1", "60,2") + ",9", name="two.csv")
    runs = read_mtm(first, second)
    assert list(runs.time) == [0.0, 5.0, 0.0]
    assert noted(runs.notes[-1:], "date-unknown")


def test_a_file_of_no_known_kind_and_an_empty_one_are_reported(tmp_path):
    path = tmp_path / "some.bin"
    path.write_bytes(bytes(range(256)))
    with refused("unknown-format", None, "some.bin"):
        read_mtm(path)
    path.write_bytes(b"\r\n")
    with refused("empty"):
        read_mtm(path)


def test_notes_on_one_of_several_files_keep_their_codes(tmp_path):
    first = write(tmp_path, HEADER, ROW, name="one.csv")
    second = write(tmp_path, f"{HEADER},remark", ROW.replace("-0.4", "-0.5,windy"), name="two.csv")
    notes = read_mtm(first, second).notes
    assert "unused-columns" in codes(notes)
    assert any(note.startswith("two.csv: ") for note in notes)


def test_coefficients_in_per_cent_are_fractions(tmp_path):
    heading = "temperature (degC),rolling speed (mm/s),SRR (%),load (N),mu"
    rows = ["25,100,20,20,5", "25,100,-20,20,3"]
    runs = read_mtm(write(tmp_path, f"{heading} (%)", *rows))
    assert runs.traction_force == pytest.approx([1.0, -0.6])
    with refused("wrong-unit", None, "'mu (N)'"):
        read_mtm(write(tmp_path, f"{heading} (N)", *rows))


@pytest.mark.parametrize(("unit", "doubtful"), [("%", False), ("-", True)])
def test_slip_of_surfaces_that_move_in_opposite_directions_is_noted(tmp_path, unit, doubtful):
    heading = f"temperature (degC),rolling speed (mm/s),SRR ({unit}),load (N),mu"
    runs = read_mtm(write(tmp_path, heading, "25,100,20,20,0.05", "25,100,-20,20,0.03"))
    assert ("opposite-speeds" in codes(runs.notes)) == doubtful


def test_specimens_of_one_table_are_not_one_run(tmp_path):
    with refused("several-specimens", 3, "'NR' and 'SBR'"):
        read_mtm(write(tmp_path, f"{HEADER},compound", f"{ROW},NR", f"{ROW},SBR"))
    assert len(read_mtm(write(tmp_path, f"{HEADER},compound", f"{ROW},NR", f"{ROW},NR")).load) == 2
