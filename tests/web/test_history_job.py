"""The page's history becomes [history] of the study, by stages or by a table, and is found in it again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from viscofric.errors import ViscofricError
from viscofric.web.jobs import history
from web.contact_studies import BALL, CONDITIONS, ROUGH, Desk

#: At one load and one speed, which a table of its own needs.
STUDY = {**BALL, "conditions": {**CONDITIONS, "speed": "0.1 m/s"}}


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def rows(*points: tuple[float, float, float]) -> list[dict[str, float]]:
    return [dict(zip(("time", "value", "along"), one, strict=True)) for one in points]


STAGES: dict[str, tuple[list[dict[str, float]], dict[str, Any]]] = {
    "hold": (
        rows((0.0, 0.0, 0.0), (0.1, 25.0, 0.0), (1.1, 25.0, 0.0)),
        {"load_time": "0.1 s", "dwell": "1 s"},
    ),
    "start": (
        rows((0.0, 25.0, 0.0), (0.2, 25.0, 0.0), (0.2, 25.0, 0.1), (0.5, 25.0, 0.1)),
        {"dwell": "0.2 s", "slide": "0.03 m"},
    ),
    "forth and back": (
        rows((0.0, 25.0, 0.1), (0.1, 25.0, 0.1), (0.1, 25.0, -0.1), (0.2, 25.0, -0.1)),
        {"slide": "0.01 m", "strokes": 2},
    ),
}


@pytest.mark.parametrize(("points", "stages"), STAGES.values(), ids=STAGES)
def test_a_history_of_stages_is_written_as_stages_and_found_again(
    desk: Desk, points: list[dict[str, float]], stages: dict[str, Any]
) -> None:
    found = desk.run(history, BALL, rows=points)["history"]
    assert found == {**stages, "before": "untouched"}
    again = desk.run(history, {**STUDY, "history": found})
    given = np.array([list(one.values()) for one in points])
    assert np.array(again["rows"]) == pytest.approx(given, rel=1e-8)  # both have nine digits
    assert (again["control"], again["path"]) == ("load", "speed")


def test_positions_are_stages_too(desk: Desk) -> None:
    points = rows((0.0, 25.0, 0.0), (0.2, 25.0, 0.0), (0.5, 25.0, 0.03))
    found = desk.run(history, BALL, rows=points, path="position", before="at rest")["history"]
    assert found == {"dwell": "0.2 s", "slide": "0.03 m", "before": "at rest"}


OTHERS = {
    "start and stop": rows((0.0, 25.0, 0.1), (0.1, 25.0, 0.1), (0.1, 25.0, 0.0), (0.2, 25.0, 0.0)),
    "unloading": rows((0.0, 25.0, 0.0), (0.1, 0.0, 0.0)),
    "faster and faster": rows((0.0, 25.0, 0.0), (0.1, 25.0, 0.1)),
    "backward": rows((0.0, 25.0, -0.1), (0.1, 25.0, -0.1)),
    "unequal strokes": rows((0.0, 25.0, 0.1), (0.1, 25.0, 0.1), (0.1, 25.0, -0.1), (0.3, 25.0, -0.1)),
}


@pytest.mark.parametrize("points", OTHERS.values(), ids=OTHERS)
def test_another_history_becomes_a_table_of_the_page(desk: Desk, points: list[dict[str, float]]) -> None:
    found = desk.run(history, STUDY, rows=points)["history"]
    assert found == {"file": history.TABLE, "before": "untouched"}
    again = desk.run(history, {**STUDY, "history": found})
    assert again["rows"] == [list(one.values()) for one in points]


@pytest.mark.parametrize(
    ("study", "options", "code"),
    [
        (BALL, {"rows": OTHERS["unloading"]}, "swept-in-file"),  # the study has six speeds
        (BALL, {}, "no-history"),
        (ROUGH, {"rows": OTHERS["unloading"], "control": "pressure"}, "swept-in-file"),
        (STUDY, {"rows": OTHERS["unloading"][::-1]}, "time-goes-back"),
    ],
)
def test_what_no_study_can_have_has_a_code(
    desk: Desk, study: dict[str, Any], options: dict[str, Any], code: str
) -> None:
    with pytest.raises(ViscofricError) as error:
        desk.run(history, study, **options)
    note = getattr(error.value, "mistakes", None) or [error.value]
    assert note[0].code == code
