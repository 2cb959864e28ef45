"""Reports of all kinds of studies: sweeps of anything, failures, several rubbers, half-finished ones."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from viscofric.report import html
from viscofric.report.captions import captions
from viscofric.report.figures import saving
from viscofric.report.figures import study as drawing
from viscofric.report.figures.convergence import plot_errors
from viscofric.report.figures.study import contacts, figure_images
from viscofric.report.html import write_report
from viscofric.report.texts import friction_tables
from viscofric.report.texts.checks import all_checks, counted, friction_checks
from viscofric.report.texts.friction_tables import detail_tables, friction_at_a_glance
from viscofric.report.texts.study import inputs, scope

SPEEDS, TEMPERATURES = np.geomspace(1e-3, 1.0, 7), np.linspace(303.15, 363.15, 4)
CURVES = {"temperature": TEMPERATURES, "speed": SPEEDS}
STUDIES: dict[str, dict[str, Any]] = {
    "loads": {"load": [5.0, 25.0, 50.0], **CURVES},
    "load only": {"load": [5.0, 25.0, 50.0]},
    "radius only": {"radius": [0.002, 0.005, 0.01]},
    "rubbers": {"material": ["NBR 70", "FKM 75"], **CURVES},
    "samples": {"sample": [0, 1, 2, 3], **CURVES},
    "temperatures": {"temperature": TEMPERATURES},
    "one case": {},
}


@pytest.fixture
def unread(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let figures be drawn, but not turned into images, and leave those of the rubber out, which others look at."""
    monkeypatch.setattr(saving, "_encoded", lambda *_: b"")
    monkeypatch.setattr(drawing, "RUBBER_FIGURES", {})


@pytest.mark.slow
@pytest.mark.usefixtures("unread")
@pytest.mark.parametrize("name", STUDIES)
def test_every_study_has_a_report(make_study: Callable[..., xr.DataTree], tmp_path: Path, name: str) -> None:
    tree = make_study(STUDIES[name])
    images = figure_images(tree, ("svg",))
    page = write_report(tree, tmp_path, images=images).read_text("utf-8")
    swept = {"loads", "load only", "radius only", "rubbers", "samples", "temperatures"}
    assert ("figure-friction_sweep" in page) == (name in swept)
    assert ("figure-friction_map" in page) == ("speed" in STUDIES[name])
    assert set(images) <= set(captions(tree))
    assert len(scope(tree)) >= 2
    assert {"cases", "requested accuracy"} <= {item.name for item in inputs(tree)}


@pytest.mark.usefixtures("unread")
@pytest.mark.parametrize(
    "missing",
    ["prediction", "prediction_master", "isotherms", "shift_factors", "shift_law", "spectrum", "master_curve", "all"],
)
@pytest.mark.slow
def test_no_group_is_needed(make_study: Callable[..., xr.DataTree], tmp_path: Path, missing: str) -> None:
    tree = make_study(STUDIES["loads"])
    for name in list(tree.children) if missing == "all" else [missing]:
        del tree[name]
    assert write_report(tree, tmp_path).stat().st_size > 1000


def test_failed_and_interpolated_cases_are_marked(make_study: Callable[..., xr.DataTree]) -> None:
    reason = "30 °C, 1 mm/s: the accuracy was not reached."
    tree = make_study(STUDIES["loads"], failed=(0,), failures=json.dumps([reason]))
    (table,) = [table for table in detail_tables(tree) if table.key == "prediction"]
    assert len(table.rows) == 3 * 4 * 7
    remarks = [row[table.headings.index("remark")] for row in table.rows]
    assert remarks[0] == "not solved"
    assert remarks[1] == "interpolated"
    assert table.rows[0][table.headings.index("friction coefficient")] == "–"
    checks = {check.name: check for check in all_checks(tree)}
    assert checks["All cases solved"].verdict == "failed"
    # Every second case of the maker, the first of all failed; each with an error of 4e-4.
    assert checks["Accuracy"].verdict == "passed"
    found = checks["Accuracy"].values
    assert (found["interpolated"], found["of"]) == (42, 83)
    assert found["largest"] == pytest.approx(4e-4, rel=0.01)
    assert counted(list(checks.values())).startswith(f"{len(checks)} checks: 1 failed, ")


def test_errors_above_the_accuracy_are_pointed_out(make_study: Callable[..., xr.DataTree]) -> None:
    tree = make_study(STUDIES["loads"], accuracy=1e-4)
    (check,) = [check for check in all_checks(tree) if check.name == "Accuracy"]
    assert check.verdict == "warning"
    assert (check.values["beyond"], check.values["of"]) == (84, 84)


def test_highest_friction_of_each_load_is_reported_at_a_glance(make_study: Callable[..., xr.DataTree]) -> None:
    tree = make_study(STUDIES["loads"])
    glance = friction_at_a_glance(tree)
    assert glance is not None
    assert glance.headings == ["load", "highest friction", "at temperature", "and speed", "lowest friction"]
    friction = tree["prediction"]["friction_coefficient"]
    for row, load in zip(glance.rows, (5.0, 25.0, 50.0), strict=True):
        assert row[0] == f"{load:g}\N{NO-BREAK SPACE}N"
        assert float(row[1].removesuffix(" *")) == pytest.approx(float(friction.sel(load=load).max()), rel=0.005)
        assert float(row[4]) == pytest.approx(float(friction.sel(load=load).min()), rel=0.005)


def test_what_varies_is_said(make_study: Callable[..., xr.DataTree]) -> None:
    listed = {item.name: item.value for item in inputs(make_study(STUDIES["loads"]))}
    assert listed["load"] == "5 N, 25 N and 50 N"
    assert listed["speed"] == "1 mm/s to 1 m/s (7 values)"
    assert listed["cases"] == "84"


@pytest.mark.slow
def test_each_of_several_rubbers_has_its_figures(
    make_study: Callable[..., xr.DataTree], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(saving, "_encoded", lambda *_: b"")
    tree = make_study(STUDIES["rubbers"])
    of_rubber = [name for name in tree.children if name != "prediction"]
    groups = {name: tree[name].to_dataset() for name in of_rubber}
    groups["prediction"] = tree["prediction"].to_dataset()
    several = {f"materials/{place}/{name}": groups[name] for place in (1, 2) for name in of_rubber}
    found = xr.DataTree.from_dict({"prediction": groups["prediction"], **several})
    found.attrs = tree.attrs
    images = figure_images(found, ("svg",))
    assert {"master_curve_1", "master_curve_2", "spectrum_1", "friction_master_curve", "friction_sweep"} <= set(images)
    assert "master_curve" not in images
    page = write_report(found, tmp_path, images=images).read_text("utf-8")
    assert "<h3>Material: NBR 70</h3>" in page
    assert "FKM 75. Shift factors" in page
    assert sum(check.name.endswith("(NBR 70)") for check in all_checks(found)) >= 3


def test_long_tables_are_folded_behind_their_first_rows(
    make_study: Callable[..., xr.DataTree], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(html, "figure_images", lambda *_: {})
    page = write_report(make_study(STUDIES["loads"]), tmp_path).read_text("utf-8")
    first, folded = page.index('id="first-of-prediction"'), page.index('id="table-prediction"')
    assert first < page.index("<details", first) < folded
    assert "All 84 rows" in page


def test_tables_of_large_studies_end_and_name_the_file_with_all_rows(
    make_study: Callable[..., xr.DataTree], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(html, "figure_images", lambda *_: {})
    monkeypatch.setattr(friction_tables, "_LONGEST", 50)
    tree = make_study(STUDIES["loads"])
    page = write_report(tree, tmp_path).read_text("utf-8")
    (shown,) = (one for one in detail_tables(tree) if one.key == "prediction")
    assert shown.left_out == 34
    assert "results.nc" in shown.note
    assert "First 50 of 84 rows" in page
    table = page[page.index('id="table-prediction"') :]
    assert table[: table.index("</table>")].count("<tr>") == 51


def test_errors_of_many_cases_are_drawn_as_an_image() -> None:
    for count, drawn in ((100, False), (3_000, True)):
        speed = np.geomspace(1e-3, 1.0, count)
        errors = {"friction_coefficient": 0.1, "friction_error": 1e-5}
        columns = {name: ("case", np.full(count, value)) for name, value in errors.items()}
        cases = xr.Dataset({**columns, "speed": ("case", speed)})
        axes = Figure().subplots()
        plot_errors(axes, cases)
        assert [line.get_rasterized() for line in axes.lines] == [drawn]


def rough(make_sweep: Callable[..., xr.Dataset], tree: xr.DataTree, error: float) -> xr.DataTree:
    """Results of rough surfaces: no axis, no edges, but a share of the area and a gap."""
    cases = make_sweep({"seed": [1, 2], "temperature": [303.15, 333.15], "speed": [0.01, 0.1, 1.0]})
    friction = cases["friction_coefficient"]
    cases = cases[["friction_coefficient"]].assign(
        friction_error=error * friction, contact_area_fraction=0.0 * friction + 0.02, mean_gap=0.0 * friction + 8e-6
    )
    found = tree.copy()
    found["prediction"] = xr.DataTree(
        cases.assign_coords(pressure=((), 5e4, {"units": "Pa", "long_name": "mean pressure"}))
    )
    for name in ("prediction_master", "measurement", "measurement_master", "agreement", "friction_shift_factors"):
        if name in found.children:
            del found[name]
    found.attrs = {**tree.attrs, "accuracy": 0.01, "indenter": "self-affine rough surface"}
    return found


@pytest.mark.parametrize(("error", "verdict"), [(0.005, "passed"), (0.16, "warning")])
def test_a_rough_surface_is_not_called_a_ball(
    tree: xr.DataTree, make_sweep: Callable[..., xr.Dataset], tmp_path: Path, error: float, verdict: str
) -> None:
    found = rough(make_sweep, tree, error)
    checks = {check.name: check for check in friction_checks(found)}
    assert checks["Accuracy"].verdict == verdict
    assert "Small strain" not in checks
    page = write_report(found, tmp_path, images={"friction_sweep": {"svg": b"<svg></svg>"}}).read_text("utf-8")
    assert "50 kPa" in page.replace("\N{NO-BREAK SPACE}", " ")
    assert "contact area fraction" in page
    assert contacts(found) is None


@pytest.mark.parametrize("points", [(16, 8), (16, 1)])
def test_kept_fields_of_a_rough_surface_are_drawn_on_a_whole_period(
    tree: xr.DataTree, make_sweep: Callable[..., xr.Dataset], points: tuple[int, int]
) -> None:
    found = rough(make_sweep, tree, 0.01)
    pressure = np.zeros(points)
    pressure[3:5, 0], pressure[12, -1] = 2e6, 1e6
    if "fields" in found.children:
        del found["fields"]
    places = {name: (name, 1e-5 * np.arange(count)) for name, count in zip("xy", points, strict=True)}
    reported = {"seed": 2, "mean_pressure": 5e4, "temperature": 333.15, "speed": 0.1}
    kept = {"pressure": (("x", "y"), pressure), "displacement": (("x", "y"), np.zeros(points))}
    found["fields/1"] = xr.DataTree(xr.Dataset(kept, places | reported))
    figure = contacts(found)
    assert figure is not None
    axes = figure.axes[0]
    title = axes.get_title() + axes.get_title("left")
    friction = found["prediction"].to_dataset()["friction_coefficient"].sel(seed=2, temperature=333.15, speed=0.1)
    assert f"{float(friction):.3g}"[:5] in title
    assert "seed 2" in title
    assert f"{100 * np.count_nonzero(pressure) / pressure.size:.3g} % in contact" in title
    if points[1] > 1:
        (mesh,) = axes.collections
        assert mesh.get_array().count() == 3
        assert len(figure.axes) == 2  # with its colour bar, without a profile
    else:
        np.testing.assert_allclose(axes.lines[0].get_ydata(), pressure[:, 0] / 1e6)
    assert "2 seeds" in captions(found)["friction_sweep"]


def test_inputs_list_every_setting_of_the_run_file(make_study: Callable[..., xr.DataTree]) -> None:
    text = """
    author = "A. Author"
    [material]
    catalogue = "synthetic fluoroelastomer"
    [layer]
    thickness = "4 mm"
    base = "sliding"
    [heating]
    counterface = "steel"
    coulomb = [0.1, 0.3]
    [sweep]
    together = [["load", "thickness"]]
    [history]
    cycle = true
    [conditions]
    load = "5 N"
    """
    tree = make_study(STUDIES["loads"], study_text=text, author="A. Author", sample="plate 3", comment="First try.")
    listed = {item.name: item.value for item in inputs(tree)}
    assert (listed["author"], listed["sample"], listed["comment"]) == ("A. Author", "plate 3", "First try.")
    assert (listed["layer: thickness"], listed["layer: base"]) == ("4 mm", "sliding")
    assert (listed["heating: counterface"], listed["heating: coulomb"]) == ("steel", "0.1, 0.3")
    assert (listed["sweep: together"], listed["history: cycle"]) == ('["load", "thickness"]', "true")
    assert not [name for name in listed if "conditions" in name or "catalogue" in name]


@pytest.mark.slow
def test_tables_have_mean_and_interval_over_seeds(make_study: Callable[..., xr.DataTree]) -> None:
    tree = make_study({"seed": [1, 2, 3, 4], "temperature": TEMPERATURES[:2], "speed": SPEEDS[:3]})
    cases = tree["prediction"].to_dataset()
    scatter = xr.DataArray([0.9, 1.0, 1.0, 1.1], dims="seed")
    cases["friction_coefficient"] = cases["friction_coefficient"] * scatter
    tree["prediction"] = xr.DataTree(cases)
    mean = cases["friction_coefficient"].mean("seed").values.ravel()
    (table,) = [one for one in detail_tables(tree) if one.key == "prediction"]
    assert "seed" not in table.headings
    assert len(table.rows) == 6
    # Student's t of three degrees of freedom at 97.5 %: 3.182; standard deviation of the four factors: 0.08165
    half = 3.182 * 0.08165 / 2.0
    columns = {name: [row[place] for row in table.rows] for place, name in enumerate(table.headings)}
    friction, lower, upper = (
        np.array([float(one) for one in columns[name]]) for name in ("friction coefficient", "95 % from", "to")
    )
    np.testing.assert_allclose(np.sort(friction), np.sort(mean), rtol=1e-3)
    np.testing.assert_allclose(upper / friction - 1.0, half, rtol=2e-2)
    np.testing.assert_allclose(1.0 - lower / friction, half, rtol=2e-2)
    assert set(columns["seeds"]) == {"4"}
    glance = friction_at_a_glance(tree)
    assert glance is not None
    assert len(glance.headings) == 3
    assert all("±" in cell for row in glance.rows for cell in row[1:])


@pytest.mark.apart
def test_no_table_is_wider_than_the_page_and_the_pdf_is_a4(tree: xr.DataTree, tmp_path: Path) -> None:
    from web.browser_tab import chromium_path, launched

    path = chromium_path()
    if path is None:
        pytest.skip("no Chromium is on the path")
    report = write_report(tree, tmp_path, images={})
    with launched(path) as browser:
        page = browser.new_page(viewport={"width": 1400, "height": 1000})
        page.goto(report.as_uri())
        for medium, width in (("screen", 1400), ("print", 680)):  # A4 less its margins: 180 mm
            page.emulate_media(media=medium)
            page.set_viewport_size({"width": width, "height": 1000})
            wide = page.evaluate(
                "() => { document.querySelectorAll('details').forEach(one => one.open = true);"
                " return [...document.querySelectorAll('table, pre')].filter(one => one.scrollWidth > one.clientWidth"
                " || one.getBoundingClientRect().right > document.documentElement.clientWidth).map(one => one.id) }"
            )
            assert wide == [], medium
        assert page.locator("table.wide").count() > 0
        content = page.pdf(prefer_css_page_size=True)
    assert content.startswith(b"%PDF-")
    box = re.search(rb"/MediaBox ?\[ ?0 0 ([\d.]+) ([\d.]+)", content)
    assert box is not None
    np.testing.assert_allclose([float(box[1]), float(box[2])], [595.0, 842.0], atol=2.0)
