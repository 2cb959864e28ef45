"""Exports of PCS Instruments' MTM and ETM: every row read, slip and rolling reversed where TF1 to TF4 say so."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from readers.refusal import noted, refused
from readers.samples import pcs
from viscofric import read_mtm
from viscofric.notes import codes


def changed(tmp_path, old, new, lines=None, count=1):
    """Write the MTM's sample with something changed, and see that it was there."""
    text = "\n".join(lines or pcs.mtm())
    assert old in text
    return pcs.write(tmp_path, text.replace(old, new, count).split("\n"), "changed.txt")


def note(runs, code):
    found = noted(runs.notes, code)
    assert len(found) == 1, runs.notes
    return found[0]


@pytest.fixture
def mtm(tmp_path):
    return read_mtm(pcs.TRACTION_SAMPLES["MTM"](tmp_path))


def test_every_step_gives_its_signed_readings(mtm):
    assert [(step.number, step.kind, step.readings) for step in mtm.steps] == [
        (2, "BOD_TIMED", 3),
        (3, "TRACTION", 6),
        (4, "BIDIRECTIONAL", 12),
        (5, "POD_TIMED", 3),
    ]
    assert mtm.steps[1].description == "slip reversed"
    assert mtm.steps[1].load == pytest.approx(25.0)
    assert mtm.steps[1].speed == pytest.approx(np.mean(pcs.SPEEDS) * 1e-3)  # disc faster as often as slower
    assert mtm.steps[1].slip_ratio == pytest.approx(pcs.SLIP)
    expected = [pcs.force(disc, ball) for disc, ball in zip(mtm.disc_speed, mtm.ball_speed, strict=True)]
    assert mtm.traction_force[mtm.step >= 4] == pytest.approx(np.array(expected)[mtm.step >= 4], abs=5e-5)  # 4 digits
    assert mtm.load == pytest.approx(np.full(24, 25.0))
    assert mtm.temperature == pytest.approx(np.full(24, 313.15))
    assert mtm.zero_force == pytest.approx(np.full(24, pcs.OFFSET))
    assert mtm.track_radius == pytest.approx(np.full(24, 21.232e-3))


def test_slip_is_reversed_in_TF2_and_rolling_in_TF3_and_TF4(mtm):
    both = mtm.select(mtm.step == 4)
    assert both.disc_speed[:4] == pytest.approx([22e-3, 18e-3, -22e-3, -18e-3])
    assert both.ball_speed[:4] == pytest.approx([18e-3, 22e-3, -18e-3, -22e-3])
    assert list(both.replicate) == [both.replicate[0]] * 4 + [both.replicate[4]] * 4 + [both.replicate[8]] * 4
    assert note(mtm, "reversal-assumed")


def test_speeds_that_are_printed_negative_are_not_reversed_again(tmp_path):
    lines = pcs.mtm()
    headings = pcs.columns()
    places = [headings.index(f"{body} Speed {place}") for body in ("Ball", "Disc") for place in (3, 4)]
    for number, line in enumerate(lines):
        cells = line.split("\t")
        if len(cells) == len(headings) and cells[places[0]] and cells[places[0]][0].isdigit():
            for place in places:
                cells[place] = "-" + cells[place]
            lines[number] = "\t".join(cells)
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert runs.disc_speed[runs.step == 4][:4] == pytest.approx([22e-3, 18e-3, -22e-3, -18e-3])


def test_a_pin_load_beside_a_ball_load_is_none_of_a_ball(tmp_path, mtm):
    """Some exports print both, of which the ball's counts; the ball's own speed is that of the file."""
    lines, headings = pcs.mtm(), pcs.columns()
    pin, ball = headings.index("Pin Load (N)"), headings.index("Ball Load (N)")
    for number, line in enumerate(lines):
        cells = line.split("\t")
        if len(cells) == len(headings) and cells[ball][:1].isdigit():
            cells[pin] = "7.000"
            lines[number] = "\t".join(cells)
    both = read_mtm(pcs.write(tmp_path, lines))
    np.testing.assert_array_equal(both.load, mtm.load)
    np.testing.assert_array_equal(both.ball_speed, mtm.ball_speed)


def test_planted_coefficients_come_back(mtm):
    """Both directions tell the force cell's zero, Coulomb and viscoelastic friction apart."""
    both = mtm.select(mtm.step == 4)
    signs = np.stack([np.ones(len(both)), np.sign(both.disc_speed - both.ball_speed), np.sign(both.disc_speed)])
    fitted = np.linalg.lstsq(signs.T, both.traction_force, rcond=None)[0]
    planted = [pcs.OFFSET, pcs.LOAD * pcs.COULOMB, pcs.LOAD * pcs.VISCOELASTIC]
    assert fitted == pytest.approx(planted, abs=5e-5)  # forces are printed with four digits


def test_a_pin_stands_still(mtm):
    pin = mtm.select(mtm.step == 5)
    assert np.all(pin.ball_speed == 0.0)
    assert pin.disc_speed == pytest.approx([22e-3, 44e-3, 88e-3])
    assert note(mtm, "rows-of-a-pin").values == {"rows": 3}


def test_times_count_from_the_first_reading(mtm):
    # step 2 begins at 10:01:00 with a row at 10 s, step 3 at 10:02:00
    assert list(mtm.time[:5]) == [0.0, 10.0, 20.0, 60.0, 60.0]


def test_an_etm_prints_other_columns(tmp_path):
    runs = read_mtm(pcs.TRACTION_SAMPLES["ETM"](tmp_path))
    assert len(runs) == 12
    assert sorted(set(runs.temperature.round(2))) == [313.15, 333.15]
    # the same speeds at two temperatures: each is the first of its condition, TF1 and TF2 alike
    assert list(runs.replicate) == [1] * 12


def test_decimal_commas_are_the_same_numbers(tmp_path, mtm):
    comma = read_mtm(pcs.TRACTION_SAMPLES["decimal comma"](tmp_path))
    for name in ("disc_speed", "ball_speed", "traction_force", "load", "temperature", "time", "zero_force"):
        assert np.array_equal(getattr(comma, name), getattr(mtm, name))


def test_points_in_columns_that_are_not_read_contradict_no_decimal_commas(tmp_path, mtm):
    path = pcs.TRACTION_SAMPLES["decimal comma"](tmp_path)
    lines = path.read_text(encoding="utf-8").splitlines()
    wide = [number for number, line in enumerate(lines) if line.count("\t") > 20]
    for number in wide:
        lines[number] += "\tversion" if lines[number][:1].isalpha() else "\t1.2"
    path.write_text("\n".join(lines), encoding="utf-8")
    assert np.array_equal(read_mtm(path).traction_force, mtm.traction_force)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("start", [b"", b"\xef\xbb\xbf"])
def test_line_ends_and_marks_do_not_matter(tmp_path, mtm, end, start):
    runs = read_mtm(pcs.write(tmp_path, pcs.mtm(), end=end, start=start))
    assert np.array_equal(runs.traction_force, mtm.traction_force)


def test_the_order_of_columns_does_not_matter(tmp_path, mtm):
    lines = ["\t".join(reversed(line.split("\t"))) if line.count("\t") > 20 else line for line in pcs.mtm()]
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert np.array_equal(runs.traction_force, mtm.traction_force)
    assert np.array_equal(runs.ball_speed, mtm.ball_speed)


def test_repeated_headings_and_cells_left_out_at_the_end_of_rows(tmp_path, mtm):
    lines = pcs.mtm()
    place = next(number for number, line in enumerate(lines) if line.startswith("Step Time"))
    lines.insert(place + 2, lines[place])
    lines = [line.rstrip("\t") for line in lines]
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert np.array_equal(runs.traction_force, mtm.traction_force)


def test_steps_without_readings_are_counted(mtm):
    assert note(mtm, "steps-without-traction").values["kinds"]["MAPPER"] == 1
    assert note(mtm, "format").values == {
        "profile": "synthetic profile",
        "lubricant": "none",
        "test started": "23/03/2018 10:00:00",
    }


def test_the_last_row_may_be_cut_short(tmp_path):
    lines = pcs.etm()[:-1]
    lines[-1] = "\t".join(lines[-1].split("\t")[:20])
    path = tmp_path / "torn.txt"
    path.write_text("\n".join(lines), encoding="utf-8")
    runs = read_mtm(path)
    assert len(runs) == 10
    assert note(runs, "cut-short").values == {"row": "step 3, row 3"}


def test_a_test_that_was_aborted_is_reported(tmp_path):
    text = "\n".join(pcs.mtm())
    text = text.replace("All steps completed, test completed normally at", "Test aborted by user at")
    text = text.replace("completed:\t5", "completed:\t4")
    runs = read_mtm(pcs.write(tmp_path, text.split("\n")))
    assert "Test aborted by user" in note(runs, "aborted").values["remark"]
    assert {"completed": 4, "planned": 5} in [note.values for note in noted(runs.notes, "steps-missing")]


def test_the_thermometer_can_be_chosen(tmp_path, mtm):
    path = pcs.TRACTION_SAMPLES["MTM"](tmp_path)
    assert read_mtm(path, thermometer="pot").temperature == pytest.approx(np.full(24, 315.15))
    with refused("wrong-choice", None, "thermometer = 'oven'"):
        read_mtm(path, thermometer="oven")
    lines = [line.replace("Lube RTD Temp (degC)", "Something else") for line in pcs.mtm()]
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert runs.temperature == pytest.approx(np.full(24, 315.15))
    assert note(runs, "thermometer-missing").values["missing"] == "lube"


def test_thermometers_that_disagree_are_reported(tmp_path):
    lines = [line.replace("\t42.0\t40.0\t", "\t120.0\t13.0\t") for line in pcs.mtm()]
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert note(runs, "thermometers-differ").values == pytest.approx({"lube": 286.15, "pot": 393.15})


def test_forces_of_the_other_sign_are_turned_round(tmp_path, mtm):
    headings = pcs.columns()
    places = [place for place, name in enumerate(headings) if name.startswith(("TF", "Traction Force"))]
    lines = pcs.mtm()
    for number, line in enumerate(lines):
        cells = line.split("\t")
        if len(cells) == len(headings) and cells[0][:1].isdigit():
            for place in places:
                cells[place] = f"{-float(cells[place]):.4f}" if cells[place] else ""
            lines[number] = "\t".join(cells)
        elif line.startswith("Zero"):
            lines[number] = line.replace("0.2500", "-0.2500")
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert np.array_equal(runs.traction_force, mtm.traction_force)
    assert np.array_equal(runs.zero_force, mtm.zero_force)
    assert note(runs, "force-signs-turned")


def test_what_the_file_says_twice_is_compared(tmp_path):
    signals = pcs.row(pcs.columns("SRR (%)"), 10.0, 20.0, 2)
    first = f"{pcs.force(22, 18):.4f}"
    assert first in signals
    runs = read_mtm(changed(tmp_path, f"\t{first}\t-", f"\t{first.replace('1.', '2.', 1)}\t-"))
    assert note(runs, "force-contradicts").values["first"] == "step 3, row 1"


def test_speeds_that_do_not_fit_the_printed_slip_are_reported(tmp_path):
    runs = read_mtm(changed(tmp_path, "\t18.00", "\t28.00"))
    assert note(runs, "sliding-speed-contradicts").values["first"] == "step 2, row 1"


def test_headings_may_begin_with_a_blank(tmp_path, mtm):
    lines = ["\t" + line if line.count("\t") > 20 else line for line in pcs.mtm()]
    assert np.array_equal(read_mtm(pcs.write(tmp_path, lines)).traction_force, mtm.traction_force)


@pytest.mark.parametrize(
    ("old", "new", "refusal"),
    [
        ("\t22.00", "\t2z.00", ("not-a-number", 21, "step 2", "'Disc Speed 1'", "'2z.00'")),
        ("\t25.000", "\tinf", ("not-a-number", 21, "step 2", "'Ball Load (N)'", "'inf'")),
        ("\t25.000", "\t1_0", ("not-a-number", 21, "step 2", "'Ball Load (N)'", "'1_0'")),
        ("\t25.000", "\t9e99", ("too-large", 21, "step 2")),
        ("\t25.000", "\t", ("reading-incomplete", 21, "step 2, row 1", "load")),
        ("\t22.00", "\t", ("reading-incomplete", 21, "step 2, row 1", "Disc Speed 1")),
        ("\t18.00", "\t", ("reading-incomplete", 21, "step 2, row 1", "Ball Speed 1")),
        ("\t40.0\t", "\t\t", ("reading-incomplete", 21, "step 2, row 1", "temperature")),
        ("\t40.0\t", "\t-300\t", ("reading-incomplete", 21, "step 2, row 1", "absolute zero")),
        ("Ball Load (N)", "Ball Load (mm)", ("wrong-unit", None, "step 2", "'Ball Load (mm)'", "'N'")),
        ("Ball Load (N)", "Ball Load", ("no-unit", None, "step 2", "'Ball Load'", "(N)")),
        ("(N)\t0.2500", "(N)\t0.25o0", ("not-a-number", 12, "step 1", "'Zero traction force (N)'", "'0.25o0'")),
        ("(mm)\t21.232", "(mm)\t-1", ("not-positive", 19, "step 2", "-1")),
        ("(mm)\t21.232", "\t21.232", ("no-unit", None, "step 2")),
        ("Step 3 started", "Stop 3 started", ("step-type-twice", 26, "step 2")),
        ("10\t", "10", ("row-length", 21, "step 2, row 1", "37 cells", "38 columns")),
        ("\t22.00\t\t\t\t", "\t22.00\t\t\t\t\t\t\t", ("row-length", 21, "step 2, row 1", "41 cells", "38")),
    ],
)
def test_what_is_wrong_is_said_with_step_row_and_column(tmp_path, old, new, refusal):
    with refused(*refusal) as caught:
        read_mtm(changed(tmp_path, old, new))
    assert "changed.txt" in caught.value.path


def test_a_file_without_a_single_force_is_refused(tmp_path):
    with refused("no-points", None, "1"):
        read_mtm(pcs.write(tmp_path, pcs.step(1, "MAPPER", [], "10:00:00")))


def test_rows_without_force_or_load_are_left_out_and_reported(tmp_path):
    path = changed(tmp_path, "\t25.000", "\t-0.012")
    runs = read_mtm(path)
    assert len(runs) == 23
    assert note(runs, "rows-left-out").values == {"rows": 1, "first": "step 2, row 1"}


def test_several_files_make_one_test(tmp_path, mtm):
    first = pcs.TRACTION_SAMPLES["MTM"](tmp_path)
    later = changed(
        tmp_path, "23/03/2018", "24/03/2018", lines=[x.replace("\t40.0\t", "\t60.0\t") for x in pcs.mtm()], count=99
    )
    runs = read_mtm(later, first)
    assert len(runs) == 48
    assert runs.time[24] == 0.0
    assert runs.time[0] == 86400.0
    assert runs.select(runs.step == 9).steps[0].kind == "BIDIRECTIONAL"
    assert [step.number for step in runs.steps] == [2, 3, 4, 5, 7, 8, 9, 10]
    assert runs.steps[0].source == str(later)
    assert runs.notes[0].where == "changed.txt"
    with refused("given-twice"):
        read_mtm(first, pcs.write(tmp_path, pcs.mtm(), "copy.txt"))


def test_months_may_come_first(tmp_path):
    lines = [line.replace("23/03/2018 10:", "03/23/2018 10:") for line in pcs.mtm()]
    lines = [line + " PM" if line.startswith("Step 5 started") else line for line in lines]
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert list(runs.time[:4]) == [0.0, 10.0, 20.0, 60.0]
    assert runs.time[-1] == 12 * 3600 + 180 + 20.0


def test_steps_without_a_date_follow_the_one_before(tmp_path):
    runs = read_mtm(changed(tmp_path, "23/03/2018 10:02:00", "some day"))
    # step 2 has its rows 10, 20 and 30 s after 10:01:00, step 4 begins at 10:03:00
    assert list(runs.time[:10]) == [0.0, 10.0, 20.0, 30.0, 30.0, 40.0, 40.0, 50.0, 50.0, 120.0]
    assert note(runs, "date-unread").values == {"steps": 1}
    undated = read_mtm(pcs.write(tmp_path, [line.replace("23/03/2018", "on") for line in pcs.mtm()]))
    assert list(undated.time[:6]) == [0.0, 10.0, 20.0, 30.0, 30.0, 40.0]


def test_repetitions_of_a_condition_are_numbered(tmp_path):
    lines = [*pcs.etm(), *pcs.step(4, "Traction", pcs.table(2, "SRR (%)", "ETM"), "10:09:00")]
    runs = read_mtm(pcs.write(tmp_path, lines))
    assert list(runs.replicate) == [1] * 12 + [2] * 6


def test_readings_can_be_selected(mtm):
    warm = mtm.select([0, -1])
    assert len(warm) == 2
    assert (warm.notes[-1].code, warm.notes[-1].values) == ("readings-selected", {"readings": 2, "of": 24})
    assert [step.number for step in warm.steps] == [2, 5]
    for wrong, refusal in (
        (mtm.step == 77, ("wrong-selection",)),
        ([True], ("wrong-selection", None, "24")),
        ([0.5], ("wrong-selection",)),
        ([24], ("wrong-selection", None, "24")),
    ):
        with refused(*refusal):
            mtm.select(wrong)
    numbers = [step.number for step in mtm.steps]
    assert [step.number for step in mtm.select(steps=numbers[:2]).steps] == numbers[:2]
    assert [step.number for step in mtm.select(except_steps=numbers[0]).steps] == numbers[1:]
    slow = mtm.select(mtm.step < numbers[2], steps=numbers[1:])
    assert [step.number for step in slow.steps] == numbers[1:2]
    with refused("no-such-step", None, "step 77", "2", "5"):
        mtm.select(steps=[2, 77])
    with refused("no-steps"):
        replace(mtm, step=None, steps=()).select(except_steps=2)


# Real exports ------------------------------------------------------------------------------------------------------

#: File -> steps, steps with readings, rows with TF1 and TF2, rows with a traction force only.
REAL = {
    "ETM_slim_mapper.txt": (518, 501, 20500, 60),
    "demo-mtm-output.txt": (49, 24, 0, 7200),
    "demo_5.txt": (1, 1, 0, 1000),
    "demo_7.txt": (1, 1, 0, 7500),
}


@cache
def read_once(path):
    """Read a file of megabytes for all tests of it."""
    return read_mtm(path)


def printed_rows(path):
    """Yield the cells of each row by heading, found without the reader: all that begins with a digit after a header."""
    headings = None
    for line in path.read_text("utf-8-sig").splitlines():
        cells = line.split("\t")
        if "Traction Coeff (-)" in cells:
            headings = cells
        elif headings and len(cells) == len(headings):
            yield dict(zip(headings, cells, strict=True))


@pytest.mark.parametrize("name", sorted(REAL))
@pytest.mark.slow
def test_real_exports_are_read_completely(real_data, name):
    path = real_data / "mtm" / name
    if not path.is_file():
        pytest.skip(f"no real export {path}")
    steps, with_readings, pairs, single = REAL[name]
    runs = read_once(path)
    rows = list(printed_rows(path))
    assert len(rows) == pairs + single
    assert len(runs) == 2 * pairs + single
    assert len(runs.steps) == with_readings
    if steps > with_readings:
        assert noted(runs.notes, "steps-without-traction", f"{steps - with_readings} of {steps} steps")
    place = 0
    forces, coefficients, slips = [], [], []
    for row in rows:
        reversed_slip = bool(row["TF1 (N)"])
        load = float(row["Ball Load (N)"] or row["Pin Load (N)"])
        assert runs.load[place] == load
        force, slip = runs.traction_force[place], runs.disc_speed[place] - runs.ball_speed[place]
        if reversed_slip:
            force = (force - runs.traction_force[place + 1]) / 2
            slip = (slip - runs.disc_speed[place + 1] + runs.ball_speed[place + 1]) / 2
        forces.append(force - float(row["Traction Force (N)"]))
        coefficients.append(abs(force) / load - float(row["Traction Coeff (-)"]))
        slips.append(1e3 * slip - float(row["Sliding Speed (mm/s)"]))
        place += 1 + reversed_slip
    assert place == len(runs)
    # Printed with four digits, TF1 and TF2 too: half a digit, and half of one digit's rounding twice.
    assert np.abs(forces).max() <= 1.0e-4 + 1e-9
    # Four digits of the coefficient; that of the force (5e-5 N) and of the load (5e-4 N) at 5 N and more.
    assert np.abs(coefficients).max() <= 5e-5 + (5e-5 + 5e-4 * 0.12) / 5.0
    # Two digits of speeds in mm/s, three of them in the difference.
    assert np.abs(slips).max() <= 0.02
    assert not any(code.endswith("-contradicts") for code in codes(runs.notes))


@pytest.fixture(scope="module")
def real_pairs(real_data):
    """Rows of a real ETM with TF1 and TF2 at clear slip: two readings each."""
    path = real_data / "mtm" / "ETM_slim_mapper.txt"
    if not path.is_file():
        pytest.skip(f"no real export {path}")
    runs = read_once(path)
    # step 2 is timed, all others reverse the slip
    ratio = (runs.disc_speed - runs.ball_speed)[60:].reshape(-1, 2) / runs.disc_speed[60:].reshape(-1, 2)
    clear = np.flatnonzero(np.abs(ratio).min(axis=1) > 0.05)
    return runs.select(np.stack([60 + 2 * clear, 61 + 2 * clear], axis=1).ravel())


def test_coulomb_friction_of_a_real_machine_follows_the_slip_of_the_disc(real_pairs):
    along = real_pairs.traction_force * np.sign(real_pairs.disc_speed - real_pairs.ball_speed)
    assert np.mean(along > 0.0) > 0.999


def test_the_zero_reading_has_not_been_taken_off_TF1_and_TF2(real_pairs):
    """Most of the zero reading's change from step to step is its own error, which readings then must not hold."""
    first = real_pairs.select(np.arange(0, len(real_pairs), 2))
    half_sum = real_pairs.traction_force.reshape(-1, 2).mean(axis=1)
    steps = np.unique(first.step)
    zero = np.diff([first.zero_force[first.step == step][0] for step in steps])
    middle = np.diff([np.median(half_sum[first.step == step]) for step in steps])
    (slope, _), covariance = np.polyfit(zero, middle, 1, cov=True)
    own_error = -2.0 * np.corrcoef(zero[1:], zero[:-1])[0, 1]  # 1 for independent errors, 0 for a random walk
    error = float(np.sqrt(covariance[0, 0]))
    assert own_error > 0.8
    assert abs(slope) < 3.0 * error < own_error
