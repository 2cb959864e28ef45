"""Job ``check``: whether anything is wrong with a study and its files, and how much it would be to solve."""

from __future__ import annotations

from typing import Any

from viscofric.notes import listed
from viscofric.study.checking import check_study
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.study_text import RUN_FILE, study_of

Options = JobOptions


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Check a study and its files as ``viscofric check`` does; nothing is solved."""
    _, checked = study_of(study, context.files)
    found = check_study(checked, context.files / RUN_FILE)
    return {
        "cases": len(found.sweep.cases),
        "measured_points": None if found.measured is None else len(found.measured.speed),
        "solves": found.expected.solves,
        "seconds": found.seconds,
        "memory": found.expected.memory,
        "synthetic": any(rubber.synthetic for rubber in found.rubbers),
        **listed("notes", found.notes),
    }
