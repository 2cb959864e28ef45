"""Studies killed at random moments (SIGKILL) and resumed: the same results, and nothing stored is solved again."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest
import xarray

from study.running.kills import STUDY, killed_and_resumed
from viscofric.study import open_results, run_study

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.skipif(not hasattr(os, "fork"), reason="runs are forked, which Windows cannot do")
def test_killed_studies_come_to_the_same_results(tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(STUDY.format(points=14, cases="each"))  # 28 contacts, and 3 along the master curve
    whole = run_study(study)
    contacts = len(list((tmp_path / "study.results" / "cases").iterdir()))
    for workers, kills in ((1, 6), (2, 2)):
        folder = tmp_path / f"killed{workers}"
        account = killed_and_resumed(study, folder, kills=kills, workers=workers, seed=6, contacts=contacts)
        account.check(workers)
        again = open_results(folder)
        for name in ("prediction", "prediction_master"):
            xarray.testing.assert_identical(again.tree[name].to_dataset(), whole.tree[name].to_dataset())
        assert len(set().union(*account.begun)) == len(list((folder / "cases").iterdir())) == contacts
