"""Studies killed at random moments (SIGKILL) and resumed: the same results, and nothing stored is solved again."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
import xarray

from study.running.kills import STUDY, Runs, killed_and_resumed
from viscofric import open_results


@pytest.mark.apart
@pytest.mark.timeout(600)
@pytest.mark.skipif(not hasattr(os, "fork"), reason="runs are forked, which Windows cannot do")
def test_killed_studies_come_to_the_same_results(tmp_path: Path) -> None:
    """As often as VISCOFRIC_KILLS says; a hundred take two minutes on a machine with nothing else to do."""
    often = int(os.environ.get("VISCOFRIC_KILLS", "3"))
    study = tmp_path / "study.toml"
    # twice as many contacts as kills, and more, at two temperatures, and 3 along the master curve
    study.write_text(STUDY.format(points=3 + often, cases="each"))
    with Runs() as runs:
        status, _ = runs.run(study, tmp_path / "whole", 1, None, 0.0)
        assert status == 0
        whole = open_results(tmp_path / "whole")
        contacts = len(list((tmp_path / "whole" / "cases").iterdir()))
        for workers, kills in ((1, often), (2, 1 + often // 4)):
            folder = tmp_path / f"killed{workers}"
            account = killed_and_resumed(runs, study, folder, kills, workers, seed=6, contacts=contacts)
            account.check(workers)
            again = open_results(folder)
            for name in ("prediction", "prediction_master"):
                xarray.testing.assert_identical(again.tree[name].to_dataset(), whole.tree[name].to_dataset())
            assert not list((folder / "cases").glob(".*"))  # nothing half-written is left
            assert len(set().union(*account.begun)) == len(list((folder / "cases").iterdir())) == contacts
