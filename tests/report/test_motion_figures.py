"""Figures of contacts over time: what is drawn is what the solution holds, in units that its labels name."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from PIL import Image

import viscofric as vf
from refusals import refused
from viscofric import report
from viscofric.motion.mover import Field
from viscofric.report.data import distance, returns
from viscofric.report.figures.pressures import frames_of, spread_times
from viscofric.report.figures.style import new_figure

TIME = np.array([0.0, 0.1, 0.1, 0.2, 0.3])
ACROSS = np.array([0.0, 1e-3, 1e-3, 5e-3, 1e-3])  # there and back, along y
FRICTION = np.array([0.0, 0.2, 0.2, 0.5, -0.4])


def solution(kind: str, **changes: Any) -> vf.motion.TransientSolution:
    """Return a made-up contact: a disc, a line, or a patch that slides along y and back."""
    n, none = len(TIME), np.zeros(len(TIME))
    radius = 1e-3 * np.arange(n)
    fields = {
        "springs": [Field({"r": 1e-3 * (np.arange(5) + 0.5)}, 1e5 * (np.arange(5) < k)) for k in range(n)],
        "line": [Field({"x": 1e-3 * np.arange(-4.0, 5.0)}, 1e5 * k * np.eye(9)[3]) for k in range(n)],
        "grid": [
            Field({"x": 1e-3 * np.arange(-2.0, 3.0), "y": 1e-3 * np.arange(-3.0, 4.0)}, 1e5 * k * np.eye(5, 7))
            for k in range(n)
        ],
    }[kind]
    round_one = kind == "springs"
    values: dict[str, Any] = {
        "time": TIME, "load": np.full(n, 2.0), "indentation": 1e-4 * np.arange(n),
        "position": np.stack([none, none if round_one else ACROSS], axis=1), "temperature": None,
        "friction_force": none if round_one else FRICTION, "lateral_force": none, "contact_area": np.pi * radius**2,
        "contact_radius": radius if round_one else None, "front": None if round_one else 0.9 * radius,
        "rear": None if round_one else radius, "half_width": radius if kind == "grid" else None, "work": none,
        "stored": none, "dissipated": none,
        "errors": vf.motion.TransientErrors(np.full(n, 0.01), np.full(n, 1e-6), np.full(n, 0.01), none, none),
        "steps": 4,
        "rejected_steps": 0, "interrupted": False, "method": "springs" if round_one else "grid",
        "geometry": "line" if kind == "line" else "point", "direction": (0.0, 1.0), "_fields": tuple(fields),
    }  # fmt: skip
    return vf.motion.TransientSolution(**(values | changes))


def axes() -> Axes:
    return new_figure(4.0, 3.0).subplots()


def drawn(one: Any) -> dict[str, tuple[Any, Any]]:
    return {line.get_label(): line.get_data() for line in one.lines if not str(line.get_label()).startswith("_")}


def test_quantities_are_drawn_against_time_in_the_unit_of_the_label() -> None:
    one = axes()
    report.plot_transient(one, solution("grid").to_dataset(), "friction_force")
    np.testing.assert_allclose(one.lines[0].get_xdata(), 1e3 * TIME)
    np.testing.assert_allclose(one.lines[0].get_ydata(), FRICTION)
    assert (one.get_xlabel(), one.get_ylabel()) == ("time $t$ (ms)", "friction force $T$ (N)")
    band = one.collections[0].get_paths()[0].vertices
    assert band[:, 1].max() == pytest.approx(0.51)  # with the error
    coefficient = axes()
    report.plot_transient(coefficient, solution("grid").to_dataset())
    np.testing.assert_allclose(coefficient.lines[0].get_ydata(), 0.5 * FRICTION)


def test_quantities_are_drawn_against_the_distance_along_the_path() -> None:
    one = axes()
    report.plot_transient(one, solution("grid").to_dataset(), "indentation", against="distance")
    np.testing.assert_allclose(one.lines[0].get_xdata(), [0.0, 1.0, 1.0, 5.0, 9.0], rtol=1e-12)
    np.testing.assert_allclose(one.lines[0].get_ydata(), 100.0 * np.arange(5), rtol=1e-12)
    assert (one.get_xlabel(), one.get_ylabel()) == ("distance $s$ (mm)", r"indentation $\delta$ (µm)")


@pytest.mark.parametrize(
    ("kind", "legend"),
    [("springs", []), ("line", ["ahead of the axis", "behind the axis"]), ("grid", ["half-width across"])],
)
def test_contacts_are_drawn_by_what_they_have(kind: str, legend: list[str]) -> None:
    one = axes()
    report.plot_transient(one, solution(kind).to_dataset(), "contact")
    found = one.get_legend()
    words = [] if found is None else [text.get_text() for text in found.get_texts()]
    assert set(legend) <= set(words)
    np.testing.assert_allclose(one.lines[-2].get_ydata(), np.arange(5), rtol=1e-12)  # mm; the last is the axis
    rough = solution("grid", front=None, rear=None, half_width=None)
    one = axes()
    report.plot_transient(one, rough.to_dataset(), "contact")
    assert one.get_ylabel() == "contact area (mm²)"


def test_other_quantities_are_refused() -> None:
    data = solution("line").to_dataset()
    for given in ({"quantity": "colour"}, {"against": "weather"}):
        with refused("wrong-choice"):
            report.plot_transient(axes(), data, **given)


def test_the_loop_is_friction_against_position_along_the_direction() -> None:
    one, data = axes(), solution("grid").to_dataset()
    report.plot_friction_loop(one, data)
    np.testing.assert_allclose(one.lines[0].get_xdata(), 1e3 * ACROSS)
    np.testing.assert_allclose(one.lines[0].get_ydata(), FRICTION)
    assert len(one.texts) >= 2  # arrows
    assert returns(data)
    assert not returns(solution("springs").to_dataset())
    assert distance(data)[-1] == pytest.approx(9e-3)


def test_profiles_go_through_the_axis() -> None:
    one = axes()
    report.plot_pressure_profiles(one, solution("springs"), [0.2])
    ((x, pressure),) = drawn(one).values()
    np.testing.assert_allclose(x, -np.flip(x))
    np.testing.assert_allclose(pressure, np.flip(pressure))
    assert np.count_nonzero(pressure) == 6
    assert list(drawn(one)) == ["200 ms"]
    report.plot_pressure_profiles(one := axes(), solution("grid"), ["0.1 s", "0.2 s"])
    (_, first), (_, second) = drawn(one).values()
    # of 2 and 3 times 1e5 Pa, in kPa; the row y = 0 is the fourth
    np.testing.assert_allclose([first, second], [200.0 * np.eye(5, 7)[:, 3], 300.0 * np.eye(5, 7)[:, 3]], rtol=1e-12)
    with refused("unknown-time"):
        report.plot_pressure_profiles(axes(), solution("grid"), [0.15])


def test_times_are_spread_evenly() -> None:
    assert spread_times(solution("line"), 2) == [0.1, 0.3]
    assert spread_times(solution("line"), 100) == [0.1, 0.2, 0.3]


@pytest.mark.parametrize("kind", ["springs", "line", "grid"])
def test_frames_have_common_scales(kind: str) -> None:
    run = solution(kind)
    figure = report.pressure_strip(run, title="A strip")
    frames = frames_of(run)
    panels = figure.axes[: len(frames.times)]
    assert [one.get_title() for one in panels] == ["100 ms", "200 ms", "300 ms"]
    assert len({one.get_xlim() for one in panels} | {one.get_ylim() for one in panels}) == 2
    assert len(figure.axes) == len(panels) + (kind == "grid")  # maps have a colour bar
    assert frames.highest * frames.pressure.size == pytest.approx(max(float(one.max()) for one in frames.fields))


@pytest.mark.parametrize(("kind", "count"), [("springs", 5), ("grid", 6)])
def test_one_figure_has_it_all(kind: str, count: int) -> None:
    figure = report.transient_figure(solution(kind), "Title")
    labels = [one.get_ylabel() for one in figure.axes]
    assert len(labels) == count
    assert ("friction coefficient $\\mu$" in labels) == (kind == "grid")
    assert labels[-1] == ("friction force $T$ (N)" if kind == "grid" else "energy (nJ)")


def test_a_slide_after_a_long_dwell_is_drawn_against_its_path() -> None:
    path = np.array([0.0, 0.0, 0.0, 1e-3, 3e-3])
    one_way = solution(
        "grid", time=np.array([0.0, 1.0, 60.0, 60.01, 60.03]), position=np.stack([0 * path, path], axis=1)
    )
    last = report.transient_figure(one_way).axes[-1]
    np.testing.assert_allclose(last.lines[0].get_xdata(), 1e3 * path)  # mm
    np.testing.assert_allclose(last.lines[0].get_ydata(), FRICTION)


@pytest.mark.parametrize("kind", ["line", "grid"])
def test_animations_have_a_frame_for_each_time(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "contact.gif"
    report.save_animation(path, solution(kind), "A contact", synthetic=True)
    with Image.open(path) as film:
        assert film.n_frames == 3  # after the first time, one for both sides of the jump
        frames = []
        for place in range(film.n_frames):
            film.seek(place)
            frames.append(np.asarray(film.convert("L"), dtype=float))
    width = frames[0].shape[1] // 2
    # the pressure is on the left, the time's mark on the right: both change in every frame
    for before, after in itertools.pairwise(frames):
        assert np.abs(after - before)[:, :width].max() > 50.0
        assert np.abs(after - before)[:, width:].max() > 50.0
    with refused("wrong-ending"):
        report.save_animation(tmp_path / "contact.mp4", solution(kind))
