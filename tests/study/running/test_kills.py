"""Studies killed at random moments (SIGKILL) and resumed: the same results, and nothing stored is solved again."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
import xarray

from study.running.kills import STUDY, killed_and_resumed
from viscofric.study import open_results, run_study

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.slow
@pytest.mark.timeout(600)  # starts five programs
def test_killed_studies_come_to_the_same_results(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(STUDY.format(points=12, cases="each"))
    whole = run_study(study)
    account = killed_and_resumed(study, tmp_path / "killed", kills=3, workers=1, seed=6, apart=0.3)
    account.check(workers=1)
    again = open_results(tmp_path / "killed")
    for name in ("prediction", "prediction_master"):
        xarray.testing.assert_identical(again.tree[name].to_dataset(), whole.tree[name].to_dataset())
    assert len(set().union(*account.solved)) <= len(list((tmp_path / "study.results" / "cases").iterdir()))
