"""Studies with [history]: every case over time, its axes, tables of histories, and what is refused."""

from __future__ import annotations

from functools import partial
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
import xarray

import viscofric as vf
from cli.calls import call
from refusals import refused
from viscofric.errors import StudyError
from viscofric.notes import codes
from viscofric.report.captions import captions
from viscofric.report.figures.histories import histories_figure, impacts_figure
from viscofric.report.texts.friction_tables import start_table
from viscofric.report.texts.numbers import length, prefixed
from viscofric.study.cases import history as cases
from viscofric.study.checking import check_study
from viscofric.study.run_file.study import parse_study

BASE = """
[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
radius = "10 mm"
[conditions]
load = "2 N"
speed = "100 mm/s"
temperature = ["30 degC", "60 degC"]
[solver]
accuracy = 0.1
cases = "each"
[outputs]
fields = "none"
"""
ONE = BASE.replace('["30 degC", "60 degC"]', '"30 degC"')
DWELL = '[history]\ndwell = ["10 ms", "20 ms", "50 ms", "0.1 s"]\npoints = 3\n'
TABLE = 'file = "h.csv"\npoints = 3\n'


def written(folder: Path, history: str, base: str = BASE) -> Path:
    path = folder / "study.toml"
    path.write_text(base + history, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> vf.study.StudyResults:
    return vf.run_study(written(tmp_path_factory.mktemp("history"), DWELL))


def test_every_case_is_solved_over_time(results: vf.study.StudyResults) -> None:
    data = results.tree["history"].to_dataset()
    assert dict(data.sizes) == {"temperature": 2, "dwell": 4, "instant": 3}
    assert data["time"].values[0, [0, 3]].tolist() == [[0.0, 5e-3, 0.01], [0.0, 0.05, 0.1]]
    assert data["contact_radius"].attrs["units"] == "m"
    # the same as one solution, at the accuracy and the modes of the case
    rubber = vf.synthetic_fluoroelastomer()
    history = vf.motion.History([0.0, 0.1], load="2 N", temperature="60 degC")
    run = vf.motion.solve_transient(rubber, vf.Ball("10 mm"), history, times=[0.0, 0.05, 0.1], accuracy=0.1)
    found = data.isel(temperature=1, dwell=3)
    # The clock of one temperature is that of the modes at it, up to rounding.
    np.testing.assert_allclose(found["contact_radius"], run.contact_radius, rtol=1e-9)
    np.testing.assert_allclose(found["load_over_time"], 2.0, rtol=1e-9)


def test_solved_histories_are_reused(results: vf.study.StudyResults, tmp_path: Path) -> None:
    events = []
    again = vf.run_study(
        results.folder.with_name("study.toml"), resume=True, progress=lambda event: events.append(event)
    )
    found = [event.event for event in events if event.stage == "histories" and event.label]
    assert found == 8 * ["stored"]
    assert again.tree["history"].identical(results.tree["history"])


def test_histories_are_drawn_and_exported(results: vf.study.StudyResults, tmp_path: Path) -> None:
    figure = histories_figure(results.tree)
    assert figure is not None
    (panel,) = figure.axes
    lines = [line for line in panel.lines if not str(line.get_label()).startswith("_")]
    assert len(lines) == 6  # of eight
    np.testing.assert_allclose(lines[-1].get_xdata(), [0.0, 50.0, 100.0])
    deepest = results.tree["history"]["indentation"].values[-1, -1]
    np.testing.assert_allclose(lines[-1].get_ydata() / lines[-1].get_ydata()[0], deepest / deepest[0])
    assert "6 of 8" in captions(results.tree)["contacts_over_time"]
    assert results.export("excel", tmp_path / "results.xlsx").stat().st_size > 0
    said = [
        call("export", results.folder, "--to", form, "-o", tmp_path / name).stderr
        for form, name in (("csv", "a.csv"), ("excel", "a.xlsx"))
    ]
    assert [bool(one) for one in said] == [True, False]  # what a table of the cases leaves out is said


def test_a_table_gives_the_history(tmp_path: Path) -> None:
    (tmp_path / "h.csv").write_text("t (s),depth (um)\n0,0\n0.1,50\n", encoding="utf-8")
    path = written(tmp_path, f"[history]\n{TABLE}", ONE)
    data = vf.run_study(path).tree["history"].to_dataset()
    assert dict(data.sizes) == {"instant": 3}
    np.testing.assert_allclose(data["indentation"], [0.0, 25e-6, 50e-6], rtol=1e-12)
    assert "dwell" not in data.coords
    wrong = written(tmp_path, f"[history]\n{TABLE}", BASE.replace('"2 N"', '["1 N", "2 N"]'))
    with refused("swept-in-file", StudyError) as caught:
        check_study(vf.load_study(wrong), wrong)
    assert caught.value.field == "history.file"
    written(tmp_path, f"[history]\n{TABLE}", ONE)
    (tmp_path / "h.csv").write_text("t (s),T (degC)\n0,30\n0.1,30\n", encoding="utf-8")
    with refused("swept-in-file", StudyError):
        check_study(vf.load_study(path), path)
    (tmp_path / "h.csv").write_text("t (s),F (N)\n0,1\n-0.1,1\n", encoding="utf-8")
    with refused("time-goes-back", StudyError):
        check_study(vf.load_study(path), path)


def test_friction_at_the_start_is_drawn(tmp_path: Path) -> None:
    base = ONE.replace('"2 N"', '"200 N/m"').replace("30 degC", "60 degC")
    base = base.replace('radius = "10 mm"', 'shape = "cylinder"\nradius = "5 mm"')
    tree = vf.run_study(written(tmp_path, '[history]\ndwell = "0.1 s"\nslide = "0.2 mm"\npoints = 18\n', base)).tree
    data, steady = tree["history"].to_dataset(), float(tree["prediction"]["friction_coefficient"])
    assert float(data["position_x"][-1]) == pytest.approx(2e-4, rel=1e-9)
    # rubber that has crept resists more at first than in steady sliding
    assert float(data["friction_coefficient"].max()) > 2.0 * steady
    figure = histories_figure(tree)
    assert figure is not None
    assert [one.get_ylabel() for one in figure.axes][-1] == r"friction coefficient $\mu$"
    _the_table_has_the_largest_friction(data)


def _the_table_has_the_largest_friction(data: xarray.Dataset) -> None:
    more = data.assign(friction_coefficient=1.1 * data["friction_coefficient"])
    whole = xarray.concat([data, more, data], xarray.Variable("sample", [0, 1, 2]))
    table = start_table(xarray.DataTree.from_dict({"history": whole.expand_dims(dwell=[0.1])}))
    assert table is not None
    (row,) = table.rows
    place = int(data["friction_coefficient"].values.argmax())
    highest, seconds = (float(data[name][place]) for name in ("friction_coefficient", "time"))
    cells = dict(zip(table.headings, row, strict=True))
    assert float(cells["largest friction"].split(" ")[0]) == pytest.approx(highest, rel=0.01)  # as rounded
    assert float(cells["to"]) == pytest.approx(1.1 * highest, rel=0.01)
    assert cells["after"] == prefixed(seconds, None, "s")
    assert cells["after sliding"] == length(float(data["position_x"][place]))


def test_an_interrupted_history_is_not_stored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def impatient(reached: float, last: float) -> None:
        raise KeyboardInterrupt

    path = written(tmp_path, DWELL, ONE)
    with monkeypatch.context() as patch:
        patch.setattr(cases, "solve_transient", partial(vf.motion.solve_transient, progress=impatient))
        with pytest.raises(KeyboardInterrupt):
            vf.run_study(path)
    events: list[str] = []
    vf.run_study(path, resume=True, progress=lambda event: events.append(f"{event.stage} {event.event}"))
    assert "contacts stored" in events
    assert "histories stored" not in events
    assert events.count("histories solved") == 4


def test_a_case_that_fails_is_listed(tmp_path: Path) -> None:
    # sliding before, but at rest at the start
    results = vf.run_study(written(tmp_path, DWELL + 'before = "sliding"\n', ONE))
    assert codes(results.failures) == {"not-sliding"}
    assert "history" not in results.tree


@pytest.mark.parametrize(
    ("key", "history"),
    [
        ("history.dwell", "[history]\n"),
        ("history.dwell", '[history]\ndwell = "-1 s"\n'),
        ("history.dwell", f'[history]\n{TABLE}dwell = "1 s"\n'),
        ("history.columns", '[history]\ndwell = "1 s"\ncolumns = { load = "F" }\n'),
        ("history.strokes", '[history]\ndwell = "1 s"\nstrokes = 2\n'),
        ("history.before", '[history]\ndwell = "1 s"\nbefore = "asleep"\n'),
        ("history.wait", '[history]\nwait = "1 s"\n'),
    ],
)
def test_contradictions_are_reported_at_their_key(tmp_path: Path, key: str, history: str) -> None:
    with refused("", StudyError) as caught:
        parse_study(BASE + history, tmp_path / "study.toml")
    assert key in (caught.value.field, *(one.where for one in caught.value.mistakes))


ROUGH = """
[material]
catalogue = "synthetic fluoroelastomer"
[surface]
hurst = 0.8
rms_slope = 0.1
points = [16, 1]
spacing = "40 um"
shortest = "320 um"
seed = 1
[conditions]
pressure = "0.2 MPa"
direction = "180 deg"
speed = "50 mm/s"
temperature = "60 degC"
[solver]
accuracy = 0.1
cases = "each"
[outputs]
fields = "none"
"""


@pytest.mark.apart
def test_a_rough_surface_slides_from_rest(tmp_path: Path) -> None:
    path = written(tmp_path, '[history]\ndwell = "1 ms"\nslide = "20 um"\npoints = 8\n', ROUGH)
    tree = vf.run_study(path).tree
    data = tree["history"].to_dataset()
    surface = vf.self_affine(0.8, shape=(16, 1), rms_slope=0.1, spacing="40 um", shortest="320 um", seed=1)
    history = vf.motion.History(
        [0.0, 1e-3, 1e-3, 1.4e-3], pressure=2e5, speed=[0.0, 0.0, 0.05, 0.05], direction=(-1.0, 0.0),
        temperature="60 degC",
    )  # fmt: skip
    run = vf.motion.solve_transient(
        vf.synthetic_fluoroelastomer(), surface.to_surface(), history, times=data["time"].values, accuracy=0.1
    )
    np.testing.assert_allclose(data["friction_force"], run.friction_force, rtol=1e-6, atol=1e-6 * 2e5)
    assert data["position_x"].values[-1] == pytest.approx(-2e-5)
    assert data["load_over_time"].attrs == {"units": "Pa", "long_name": "mean pressure"}
    figure = histories_figure(tree)
    assert figure is not None
    assert len(figure.axes) == 2
    (tmp_path / "h.csv").write_text("t (s),p (kPa),x (um)\n0,200,0\n1e-3,200,50\n", encoding="utf-8")
    columns = 'columns = { pressure = "p (kPa)", position = "x (um)" }\n'
    table = written(tmp_path, f"[history]\n{TABLE}{columns}", ROUGH)
    assert check_study(vf.load_study(table), table).singles["histories"][0] == 1
    many = written(tmp_path, f"[history]\n{TABLE}{columns}", ROUGH.replace('"0.2 MPa"', '["0.2 MPa", "0.3 MPa"]'))
    with refused("swept-in-file", StudyError):
        check_study(vf.load_study(many), many)


FALLING = """
[history]
dwell = "10 ms"
points = 3
[impact]
mass = "4 g"
speed = "1 m/s"
"""


@pytest.mark.apart
def test_samples_of_the_material_are_solved_over_time_and_fall(tmp_path: Path) -> None:
    sweeps = files("viscofric") / "example" / "dma.csv"
    source = f'dma = "{sweeps}"\nreference_temperature = "30 degC"'
    base = ONE.replace('catalogue = "synthetic fluoroelastomer"', source) + "[uncertainty]\nmembers = 2\ndraws = 0\n"
    path = written(tmp_path, FALLING, base.replace('"2 N"', '["1 N", "2 N"]'))
    expected = check_study(vf.load_study(path), path)
    assert {name: count for name, (count, _) in expected.singles.items()} == {"histories": 6, "impacts": 3}
    assert expected.seconds > expected.expected.seconds
    tree = vf.run_study(path).tree
    data, hits = tree["history"].to_dataset(), tree["impact"].to_dataset()
    assert dict(data.sizes) == {"sample": 3, "load": 2, "instant": 3}
    assert dict(hits.sizes) == {"sample": 3, "impact_speed": 1}
    # other samples, other results, near the best estimate
    depths, rebounds = data["indentation"].values[..., -1], hits["restitution"].values
    for values in (depths, rebounds):
        spread = np.abs(values[1:] / values[0] - 1.0)
        assert np.all((spread > 0.0) & (spread < 0.05))
    figure = histories_figure(tree)
    assert figure is not None
    assert len(figure.axes[0].collections) == 2  # a band of each line
    fallen = impacts_figure(tree)
    assert fallen is not None
    (axes,) = fallen.axes
    np.testing.assert_allclose(axes.lines[0].get_ydata(), rebounds[0])
    said = captions(tree)
    assert "range" in said["contacts_over_time"]  # two samples beside the best estimate make no 95 %
    assert "4 g" in said["impacts"]


@pytest.mark.slow
def test_the_periodic_state_of_a_table_is_solved(tmp_path: Path) -> None:
    phase = np.linspace(0.0, 2.0 * np.pi, 13)
    rows = "".join(f"{t},{d}\n" for t, d in zip(phase / 100.0, 100.0 + 5.0 * np.sin(phase), strict=True))
    (tmp_path / "h.csv").write_text("t (s),depth (um)\n" + rows, encoding="utf-8")
    path = written(tmp_path, f"[history]\n{TABLE}cycle = true\n".replace("points = 3", "points = 20"), ONE)
    results = vf.run_study(path)
    data = results.tree["history"].to_dataset()
    history = vf.motion.read_history(tmp_path / "h.csv", temperature="30 degC")
    cycle = vf.motion.solve_cycle(
        vf.synthetic_fluoroelastomer(), vf.Ball("10 mm"), history, times=data["time"].values, accuracy=0.1
    )
    assert float(data["loss_stiffness"]) == pytest.approx(cycle.loss_stiffness, rel=1e-6)
    assert data["loss_stiffness"].attrs["units"] == data["loss_stiffness_error"].attrs["units"] == "N/m"
    assert float(data["loss_tangent_error"]) == pytest.approx(cycle.loss_tangent_error, rel=1e-2)
    assert data["load_over_time"].values == pytest.approx(cycle.run.load, rel=1e-6)
    assert "periodic state" in captions(results.tree)["contacts_over_time"]


@pytest.mark.parametrize(
    ("field", "text"),
    [
        ("history.before", '[history]\ndwell = "1 s"\ncycle = true\nbefore = "at rest"\n'),
        ("history.strokes", '[history]\nslide = "1 mm"\ncycle = true\n'),
        ("impact.mass", '[impact]\nmass = "4 s"\nspeed = "1 m/s"\n'),
        ("impact", '[impact]\nmass = "4 g"\nspeed = "1 m/s"\n[layer]\nthickness = "1 mm"\n'),
    ],
)
def test_what_a_cycle_and_an_impact_cannot_have(tmp_path: Path, field: str, text: str) -> None:
    with refused("", StudyError) as caught:
        parse_study(BASE + text, tmp_path / "study.toml")
    assert field in (caught.value.field, *(one.where for one in caught.value.mistakes))


def test_a_rough_surface_does_not_fall(tmp_path: Path) -> None:
    with refused("", StudyError) as caught:
        parse_study(ROUGH + '[impact]\nmass = "4 g"\nspeed = "1 m/s"\n', tmp_path / "study.toml")
    assert caught.value.field == "impact"
