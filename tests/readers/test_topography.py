"""Heights of surfaces from files: tables, points and arrays of our own, instruments' by the package."""

from __future__ import annotations

import contextlib
import importlib.util
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import viscofric as vf
from readers.refusal import refused
from readers.written import write
from viscofric.notes import codes
from viscofric.readers.topography import package

RANDOM = np.random.default_rng(5)
HEIGHTS = RANDOM.normal(size=(6, 4)).round(4)


def matrix_text(between: str = ",", comma: bool = False) -> str:
    text = "\n".join(between.join(f"{value:.4f}" for value in row) for row in HEIGHTS)
    return text.replace(".", ",") if comma else text


@pytest.mark.parametrize(
    ("between", "comma"), [(",", False), (";", False), ("\t", False), ("  ", False), (";", True), (" ", True)]
)
def test_a_matrix_of_heights_is_read_however_its_cells_are_parted(tmp_path, between, comma):
    path = write(tmp_path, "# a remark\n" + matrix_text(between, comma) + "\n\n")
    found = vf.read_topography(path, unit="um", spacing=("2 um", "3 um"))
    np.testing.assert_allclose(found.heights, 1e-6 * HEIGHTS, rtol=1e-15)
    assert found.spacing == pytest.approx((2e-6, 3e-6), rel=1e-15)
    assert found.name == "table"
    assert codes(found.history) == set()
    assert len(found.history) == 1


def test_decimal_commas_in_one_column_are_known_by_a_missing_height(tmp_path):
    found = vf.read_topography(write(tmp_path, "0,123", "0,125", "nan", "-0,1"), unit="um", spacing="1 um")
    np.testing.assert_allclose(found.heights[:, 0], [1.23e-7, 1.25e-7, np.nan, -1e-7], rtol=1e-12)
    with refused("ambiguous-decimals"):
        vf.read_topography(write(tmp_path, "0,123", "0,125"), unit="um", spacing="1 um")


def test_lines_of_an_image_may_follow_one_another_along_y(tmp_path):
    found = vf.read_topography(write(tmp_path, matrix_text()), unit="um", spacing="1 um", lines="y")
    np.testing.assert_allclose(found.heights, 1e-6 * HEIGHTS.T, rtol=1e-15)


def test_width_and_unit_in_the_remarks_of_a_matrix_are_believed(tmp_path):
    text = "# Channel: Topography\n# Width: 12 um\n# Height: 24 um\n# Value units: nm\n" + matrix_text("\t")
    found = vf.read_topography(write(tmp_path, text))
    np.testing.assert_allclose(found.heights, 1e-9 * HEIGHTS.T, rtol=1e-15)
    assert found.size == pytest.approx((12e-6, 24e-6), rel=1e-14)
    with refused("spacing-not-needed"):
        vf.read_topography(write(tmp_path, text), spacing="1 um")
    with refused("unit-not-needed", None, "'nm'"):
        vf.read_topography(write(tmp_path, text), unit="um")


@pytest.mark.parametrize("width", ["1,000 µm", "ten µm"])
def test_a_width_that_is_no_clear_length_is_refused(tmp_path, width):
    with refused("wrong-unit"):
        vf.read_topography(write(tmp_path, f"# Width: {width}\n# Value units: m\n{matrix_text()}"))


@pytest.mark.parametrize("names", [("Lateral units", "Value units"), ("XY units", "Z units")])
def test_units_in_the_remarks_of_points_are_believed(tmp_path, names):
    remarks = f"# Channel: Height\n# {names[0]}: um\n# {names[1]}: nm\n"
    points = "\n".join(f"{2 * x}\t{3 * y}\t{HEIGHTS[x, y]}" for x in range(6) for y in range(4))
    found = vf.read_topography(write(tmp_path, remarks + points))
    np.testing.assert_allclose(found.heights, 1e-9 * HEIGHTS, rtol=1e-15)
    assert found.spacing == pytest.approx((2e-6, 3e-6), rel=1e-12)
    with refused("unit-not-needed", None, "'um' and 'nm'"):
        vf.read_topography(write(tmp_path, remarks + points), unit="um")


@pytest.mark.parametrize("words", ["Height map", "ncols 4\nnrows 6\ncellsize 1"])
def test_a_matrix_below_other_words_is_read_in_the_units_that_the_user_gives(tmp_path, words):
    path = write(tmp_path, f"{words}\n{matrix_text(' ')}")
    found = vf.read_topography(path, unit="um", spacing="2 um")
    np.testing.assert_allclose(np.sort(found.heights.ravel()), np.sort(1e-6 * HEIGHTS.ravel()), rtol=1e-12)
    with refused("unknown-format"):
        vf.read_topography(path, unit="um")


def test_headings_below_remarks_with_units_are_read(tmp_path):
    remarks = "# Lateral units: um\n# Value units: nm\n"
    points = "\n".join(f"{2 * x}\t{HEIGHTS[x, 0]}" for x in range(6))
    found = vf.read_topography(write(tmp_path, remarks + "x (um)\tz (nm)\n" + points))
    np.testing.assert_allclose(found.heights[:, 0], 1e-9 * HEIGHTS[:, 0], rtol=1e-15)


@pytest.mark.parametrize(("remark", "lacking"), [("Lateral units", "heights"), ("Value units", "positions")])
def test_one_unit_of_two_in_remarks_is_refused(tmp_path, remark, lacking):
    points = "\n".join(f"{2 * x}\t{3 * y}\t{HEIGHTS[x, y]}" for x in range(6) for y in range(4))
    path = write(tmp_path, f"# {remark}: um\n{points}")
    with refused("no-unit", None, lacking):
        vf.read_topography(path)
    assert vf.read_topography(path, unit="nm").heights.shape == (6, 4)


@pytest.mark.parametrize("headings", ["Länge (mm);Profil (µm)", "Tastweg [mm];P-Profil [µm]", "距離(mm);高さ(μm)"])
def test_positions_and_heights_are_known_in_the_users_language(tmp_path, headings):
    rows = [f"{0.002 * n:.3f};{height}".replace(".", ",") for n, height in enumerate(HEIGHTS[:, 0])]
    found = vf.read_topography(write(tmp_path, "\n".join([headings, *rows])))
    np.testing.assert_allclose(found.heights[:, 0], 1e-6 * HEIGHTS[:, 0], rtol=1e-12)
    assert found.spacing[0] == pytest.approx(2e-6, rel=1e-12)


@pytest.mark.parametrize("heights", [HEIGHTS, HEIGHTS[:, 0], HEIGHTS[:, :1]])
def test_arrays_that_numpy_saved_are_read(tmp_path, heights):
    path = tmp_path / "scan.npy"
    np.save(path, heights)
    found = vf.read_topography(path, spacing="1 um")
    np.testing.assert_array_equal(found.heights, np.reshape(heights, (6, -1)))


def test_points_in_any_order_find_their_grid_and_holes_stay_holes(tmp_path):
    x, y = np.meshgrid(5.0 + 2.0 * np.arange(6), -1.0 + 3.0 * np.arange(4), indexing="ij")
    # Positions as a scanner writes them: jittered by a hundredth of their distance.
    columns = np.stack([x + RANDOM.uniform(-0.02, 0.02, x.shape), y, HEIGHTS], axis=-1).reshape(-1, 3)
    shuffled = RANDOM.permutation(columns)[2:]
    text = "x (um),y (um),z (nm)\n" + "\n".join(",".join(f"{value:.6f}" for value in row) for row in shuffled)
    found = vf.read_topography(write(tmp_path, text))
    assert found.spacing == pytest.approx((2e-6, 3e-6), rel=5e-3)
    assert found.missing == 2
    there = ~np.isnan(found.heights)
    np.testing.assert_allclose(found.heights[there], 1e-9 * HEIGHTS[there], atol=1e-15)


def test_points_without_headings_are_distinguished_from_a_matrix_by_the_spacing(tmp_path):
    x, y = np.meshgrid(np.arange(6.0), np.arange(4.0), indexing="ij")
    text = "\n".join(f"{a} {b} {c:.4f}" for a, b, c in zip(x.flat, y.flat, HEIGHTS.flat, strict=True))
    points = vf.read_topography(write(tmp_path, text), unit="um")
    np.testing.assert_allclose(points.heights, 1e-6 * HEIGHTS, rtol=1e-14)
    assert vf.read_topography(write(tmp_path, text), spacing="1 um").shape == (24, 3)


def test_metres_are_taken_for_what_has_no_unit_and_that_is_reported(tmp_path):
    points = write(tmp_path, "0,1e-6\n1e-5,2e-6\n2e-5,0\n")
    assert vf.read_topography(points).history[1].code == "unit-assumed"
    matrix = write(tmp_path, matrix_text())
    taken, *doubt = vf.read_topography(matrix, spacing="1 um").history[1:]
    assert (taken.code, taken.values) == ("unit-assumed", {"unit": "m"})
    assert codes(doubt) == {"implausible-heights"}  # of metres
    assert vf.read_topography(matrix, spacing="1 um", unit="nm").history[1:] == ()


def test_a_line_scan_with_uneven_positions_is_interpolated_and_says_so(tmp_path):
    x = np.array([0.0, 1.0, 2.0, 4.0, 5.0])
    text = "x (um); z (um)\n" + "\n".join(f"{one};{3.0 * one}" for one in x)
    found = vf.read_topography(write(tmp_path, text))
    assert found.is_line
    np.testing.assert_allclose(found.heights[:, 0], 3e-6 * np.arange(6.0), atol=1e-18)
    assert found.history[1].code == "positions-interpolated"
    assert found.history[1].values == {"positions": 5, "even": 6}


@pytest.mark.parametrize("which", ["row", "column", "both"])
def test_numbers_of_lines_are_not_taken_for_heights(tmp_path, which):
    heights = np.random.default_rng(1).normal(size=(7, 8))
    if which != "column":
        heights[0] = np.arange(8)
    if which != "row":
        heights[:, 0] = 0.5 * np.arange(7)
    path = write(tmp_path, "\n".join(",".join(map(str, row)) for row in heights))
    with pytest.raises(vf.DataFileError) as caught:
        vf.read_topography(path, spacing="1 um", unit="um")
    assert caught.value.code == "positions-in-matrix"


def test_a_tilted_plane_is_no_matrix_of_positions(tmp_path):
    plane = np.add.outer(np.arange(7.0), 2.0 * np.arange(8.0))
    path = write(tmp_path, "\n".join(",".join(map(str, row)) for row in plane))
    assert vf.read_topography(path, spacing="1 um", unit="um").heights == pytest.approx(1e-6 * plane)


def test_missing_heights_are_reported_by_words_or_by_a_number(tmp_path):
    path = write(tmp_path, "1,2,NaN\n4,-9999,6\n7,8,\n")
    found = vf.read_topography(path, spacing="1 um", missing=-9999)
    np.testing.assert_array_equal(np.isnan(found.heights), [[0, 0, 1], [0, 1, 0], [0, 0, 1]])


@pytest.mark.parametrize("header", ["x (um);y (um);z (um)\n", ""])
def test_the_number_of_a_missing_height_is_in_the_units_of_the_file(tmp_path, header):
    text = header + "".join(f"{x};{y};{-9999 if x == y == 5 else 1 + x}\n" for x in (0, 5, 10) for y in (0, 5))
    found = vf.read_topography(write(tmp_path, text), missing=-9999, unit="" if header else "um")
    assert np.argwhere(np.isnan(found.heights)).tolist() == [[1, 1]]
    assert np.nanmin(found.heights) == pytest.approx(1e-6)


@pytest.mark.parametrize("mark", [1e-300, -1e-300, -1.7976931348623157e308])
def test_the_number_of_a_missing_height_is_compared_as_printed_whatever_its_size(tmp_path, mark):
    path = write(tmp_path, f"0,1,0\n4,{mark},6\n")
    found = vf.read_topography(path, spacing="1 um", unit="um", missing=mark)
    assert np.argwhere(np.isnan(found.heights)).tolist() == [[1, 1]]


def test_a_height_far_from_all_others_is_noted(tmp_path):
    for hole, suspected in ((-9999, True), (-60, False), (99999, True)):  # a scratch of 20 times the range is none
        path = write(tmp_path, f"1,2,3\n4,{hole},2\n1,2,{hole}\n")
        found = vf.read_topography(path, spacing="1 um", unit="um")
        assert ("missing-suspected" in codes(found.history)) == suspected
        again = vf.read_topography(path, spacing="1 um", unit="um", missing=hole)
        assert "missing-suspected" not in codes(again.history)


@pytest.mark.parametrize(
    "above",
    [
        "Position X [mm];Position Y [mm];Height Z [µm]\n",
        "Profilometer 3\nsample;17\n\nX (mm);Y (mm);Z in µm\n",
        "x;y;z\nmm;mm;µm\n",
    ],
)
def test_headings_of_points_are_found_as_those_of_any_table(tmp_path, above):
    rows = [f"{x};{y};{10 * x + y}".replace(".", ",") for x in (0.0, 0.5, 1.0) for y in (0.0, 0.25)]
    found = vf.read_topography(write(tmp_path, above + "\n".join(rows)))
    assert found.spacing == pytest.approx((5e-4, 2.5e-4), rel=1e-9)
    assert found.heights == pytest.approx(1e-6 * np.array([[0, 0.25], [5, 5.25], [10, 10.25]]), rel=1e-9)


def test_true_minus_signs_are_read(tmp_path):
    found = vf.read_topography(write(tmp_path, "1,−2,3\n−4,5,6\n"), unit="um", spacing="1 um")
    assert found.heights == pytest.approx(1e-6 * np.array([[1, -2, 3], [-4, 5, 6]]))


def test_positions_about_a_matrix_are_no_heights(tmp_path):
    rows = [",".join(map(str, row)) for row in ([0.0, 1, 2, 4], [5.0, 3, 1, 2], [10.0, 1, 1, 5])]
    for corner in ("", "x/y", "nan"):
        text = f"{corner},0,10,20\n" + "\n".join(rows)
        found = vf.read_topography(write(tmp_path, text), unit="um")
        assert found.heights == pytest.approx(1e-6 * np.array([[1, 2, 4], [3, 1, 2], [1, 1, 5]]))
        assert found.spacing == pytest.approx((5e-6, 10e-6))
        assert "positions-in-matrix" in codes(found.history)
        image = vf.read_topography(write(tmp_path, text), unit="um", lines="y")
        assert (image.shape, image.spacing) == ((3, 3), pytest.approx((10e-6, 5e-6)))
        assert image.heights[2, 0] == pytest.approx(4e-6)
    uneven = vf.read_topography(write(tmp_path, text.replace("5.0", "6.0")), unit="um", spacing="5 um")
    assert uneven.shape == (4, 4)
    for corner in ("um", "x/y (um)"):
        stated = vf.read_topography(write(tmp_path, text.replace("nan", corner, 1)))
        assert (stated.spacing, stated.heights[0, 2]) == (pytest.approx((5e-6, 10e-6)), pytest.approx(4e-6))


@pytest.mark.parametrize(
    ("text", "arguments", "refusal"),
    [
        ("1,5\n1,25\n0,75\n", {}, ("ambiguous-decimals", 1, "'1,5'")),  # one column, or two
        ("1,5\n2,25\n3,75\n", {"spacing": "1 um"}, ("ambiguous-decimals", 1, "'1,5'")),
        ("1,234;5,678\n9,123;4,567\n", {"spacing": "1 um"}, ("ambiguous-decimals", 1, "'1,234'")),
        ("1.234;5\n9.123;4\n4.321;6\n802;7\n", {"spacing": "1 um"}, ("ambiguous-decimals", 1, "'802'")),
        ("1,2,3,4\n5,6,7,8\n", {}, ("no-spacing",)),
        ("1,2,3,4\n5,6\n", {"spacing": "1 um"}, ("row-length", 2, "2 numbers", "4")),
        (5 * "1,2,3,4\n" + "1,2,3,oops\n", {"spacing": "1 um"}, ("not-a-number", 6, "'oops'")),
        ("x,z\n1,2\n", {}, ("no-unit", None, "'x'")),
        ("x (um),z (um)\n1,2\n2,3\n", {"unit": "um"}, ("unit-not-needed",)),
        ("x (um),z (um)\n1,2\n1,3\n", {}, ("same-position",)),
        ("x (um),y (um),z (um)\n1,2,0\n1.37,3,1\n4,2,1\n5,1,1\n", {}, ("no-grid",)),
        ("x (um),z (um)\n1,2\nnan,3\n", {}, ("not-a-number", 3)),
        ("nan,nan\nnan,nan\n", {"spacing": "1 um"}, ("no-points",)),
        ("x (um),z (um)\n1,2\n", {}, ("no-points",)),
        ("x (um),z (um)\n1,2\n2,3\n", {"spacing": "1 um"}, ("spacing-not-needed",)),
        ("1,2,3,4\n5,6,7,8\n", {"spacing": "1 um", "channel": "height"}, ("no-channel", None, "'height'")),
        ("", {}, ("empty",)),
    ],
)
def test_what_cannot_be_read_is_refused_in_one_sentence_with_the_files_name(tmp_path, text, arguments, refusal):
    path = write(tmp_path, text)
    with refused(*refusal) as caught:
        vf.read_topography(path, **arguments)
    assert "table.csv" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("arguments", "refusal"),
    [
        ({"spacing": ("1 um",)}, ("wrong-count",)),
        ({"spacing": "-1 um"}, ("not-positive",)),
        ({"unit": "kg"}, ("wrong-unit",)),
        ({"lines": "z"}, ("wrong-choice", "'x'", "'y'")),
        ({"missing": "none"}, ("no-number", "'none'")),
        ({"channel": 1.5}, ("no-channel",)),
        ({"unit": 3}, ("not-text",)),
    ],
)
def test_arguments_that_make_no_sense_are_refused(tmp_path, arguments, refusal):
    with refused(refusal[0], None, *refusal[1:]):
        vf.read_topography(write(tmp_path, matrix_text()), **arguments)


def test_without_the_package_an_instruments_file_names_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    path = tmp_path / "scan.sur"
    path.write_bytes(b"DIGITAL SURF\x00\x01\x02")
    with refused("package-missing", None, "scan.sur", "'viscofric[surfaces]'"):
        vf.read_topography(path)


def write_as_instruments(heights: np.ndarray, folder: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from SurfaceTopography import Topography
    Topography(heights, (12.0, 8.0), unit="um").to_x3p(folder / "map.x3p")
    Topography(np.ma.masked_less(heights, -1.0), (12.0, 8.0), unit="um").to_netcdf(str(folder / "holes.nc"))


@pytest.mark.slow  # importing the package takes seconds
def test_files_of_instruments_are_read_by_the_package(tmp_path, capfd):
    if importlib.util.find_spec("SurfaceTopography") is None:
        pytest.skip("the package SurfaceTopography is not installed")
    # where they are read, too: the package, once imported, stays and slows this process down
    package._APART.call(write_as_instruments, heights=HEIGHTS, folder=tmp_path)
    path = tmp_path / "map.x3p"
    found = vf.read_topography(path)
    np.testing.assert_allclose(found.heights, 1e-6 * HEIGHTS, rtol=1e-12)
    assert found.spacing == pytest.approx((2e-6, 2e-6), rel=1e-12)
    assert "X3P" in found.history[0]
    assert vf.read_topography(tmp_path / "holes.nc").missing == np.count_nonzero(HEIGHTS < -1.0) > 0
    for arguments, refusal in (
        ({"unit": "mm"}, ("unit-not-needed",)),
        ({"spacing": 1.0}, ("spacing-not-needed",)),
        ({"channel": "none"}, ("no-channel", None, "'none'")),
    ):
        with refused(*refusal):
            vf.read_topography(path, **arguments)
    data = path.read_bytes()
    for size in (10, 100, len(data) // 2, len(data) - 30):
        (tmp_path / "cut.x3p").write_bytes(data[:size])
        with refused("damaged", None, "cut.x3p"):  # on one line
            vf.read_topography(tmp_path / "cut.x3p")
    noise = tmp_path / "noise.bin"
    noise.write_bytes(RANDOM.bytes(5000))  # as long as a square of two-byte numbers
    with refused("unknown-format"):
        vf.read_topography(noise, unit="um", spacing="1 um")
    text = write(tmp_path, "r(x) [mm]\ts [um]\n" + "\n".join(f"{0.001 * n}\t{n % 3}" for n in range(9)))
    with refused("unknown-format"):  # the package would read the positions in the one unit that is given
        vf.read_topography(text, unit="um")
    assert capfd.readouterr() == ("", "")


CELLS = st.one_of(
    st.floats(-10.0, 10.0).map(lambda x: f"{x:.3f}"), st.sampled_from(["", "nan", "-", "1e3", "x", "#", "1,5"])
)


@pytest.mark.slow
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(st.lists(CELLS, min_size=1, max_size=4), min_size=1, max_size=6),
    st.sampled_from([",", ";", "\t", " "]),
    st.sampled_from(["", "x (um),y (um),z (um)\n", "x (kg),z (um)\n", "x,z\n", "# Width: 3 um\n", "# Width: 3 bad\n"]),
    st.sampled_from([{}, {"spacing": "1 um"}, {"unit": "nm"}]),
)
def test_any_table_is_read_or_refused_with_its_name(tmp_path, monkeypatch, rows, between, above, arguments):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)  # what is no table is refused at once
    path = write(tmp_path, above + "\n".join(between.join(row) for row in rows), name="any.csv")
    refusal = ""
    try:
        found = vf.read_topography(path, **arguments)
    except vf.DataFileError as error:
        refusal = str(error)
    if refusal:
        assert "any.csv" in refusal
        assert "\n" not in refusal
    else:
        assert found.missing < found.heights.size
        assert np.all(np.isfinite(found.spacing))


@settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=120), st.sampled_from([b"", b"\x93NUMPY\x01\x00", b"\xff\xfe"]))
def test_any_bytes_are_refused_in_one_sentence(tmp_path, monkeypatch, data, start):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    path = tmp_path / "any.bin"
    path.write_bytes(start + data)
    with contextlib.suppress(vf.DataFileError):
        vf.read_topography(path, spacing="1 um")


GRID = np.array([[1.0, 2.0, 4.0], [-1.0, 0.5, 3.0]])  # (2, 3), along x and y, um
LINES = ["1 -1", "2 0.5", "4 3"]
SDF = "aBCR-1.0\nManufacID = A\nNumPoints = 2\nNumProfiles = 3\nXscale = 2e-6\nYscale = 2e-6\nZscale = 1e-6\n"
KEYENCE = '"Date & Time","1/2/2020"\n"XY Calibration","2000","nm"\n"Horizontal","2"\n"Vertical","3"\n"Unit","um"\n'


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize(
    ("head", "lines", "asked"),
    [
        ("ncols 2\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -99\n", LINES[::-1], {"unit": "um"}),
        ("DSAA\n2 3\n0 2\n0 4\n-1 4\n", LINES, {"unit": "um"}),
        (f"{SDF}Zresolution = -1\nDataType = 7\n*\n", [*LINES, "*", "remark", "*"], {}),
        (KEYENCE + '\n"Height"\n', [",".join(f'"{cell}"' for cell in line.split()) for line in LINES], {}),
        ("% heights\n", ["1 2 4", "-1 0.5 3", "End of data"], {"unit": "um", "spacing": "2 um"}),
    ],
)
def test_matrices_behind_a_head_are_read_as_it_states(tmp_path, head, lines, asked, end):
    path = write(tmp_path, (head + "\n".join(lines) + "\n").replace("\n", end))
    found = vf.read_topography(path, **asked)
    assert found.heights == pytest.approx(1e-6 * GRID)
    assert found.spacing == pytest.approx((2e-6, 2e-6))


@pytest.mark.parametrize(
    ("lines", "asked", "code"),
    [
        (["BAD -1", "2 0.5", "4 3"], {}, ""),
        (["NaN -9999", "2 0.5", "4 3"], {}, ""),  # -9999 is a height: only ESRI grids mean none by it
        (["1 -1", "2 0.5"], {}, "row-length"),
        (["1 -1", "2 x", "4 3"], {}, "not-a-number"),
        (LINES, {"unit": "um"}, "unit-not-needed"),
        (LINES, {"spacing": "2 um"}, "spacing-not-needed"),
    ],
)
def test_a_matrix_behind_a_head_is_checked(tmp_path, lines, asked, code):
    path = write(tmp_path, SDF + "*", *lines, "*")
    if code:
        with refused(code):
            vf.read_topography(path, **asked)
    else:
        assert np.argwhere(np.isnan(vf.read_topography(path).heights)).tolist() == [[0, 0]]


def test_a_scale_with_a_decimal_comma_is_no_scale_of_one(tmp_path):
    with refused("unknown-format"):
        vf.read_topography(write(tmp_path, SDF.replace("Zscale = 1e-6", "Zscale = 1,5e-6") + "*", *LINES, "*"))


@pytest.mark.parametrize("stated", ["", "NODATA_value nan\n", "NODATA_value -9999\n"])
def test_grids_of_esri_mean_no_reading_by_minus_9999_or_what_they_state(tmp_path, stated):
    none = "nan" if "nan" in stated else "-9999"
    head = f"ncols 2\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 2\n{stated}"
    path = write(tmp_path, f"{head}{none} 3\n2 0.5\n1 -1")
    assert np.argwhere(np.isnan(vf.read_topography(path, unit="um").heights)).tolist() == [[0, 2]]
