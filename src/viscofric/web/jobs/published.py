"""Job ``published``: published and independent results, each beside what viscofric computes here and now."""

from __future__ import annotations

import itertools
import time
from typing import Any

from viscofric.verification import Outcome, run_checks
from viscofric.verification.published import PUBLISHED
from viscofric.web.figures.spec import Spec, table
from viscofric.web.jobs.context import Context, JobOptions

_HEAD = ["case", "quantity", "computed", "published", "difference", "allowed"]


Options = JobOptions


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Compute all comparisons of ``viscofric verify --published``; the study is not used."""
    from viscofric import __version__

    begun, number = time.perf_counter(), itertools.count()
    outcomes = list(run_checks(PUBLISHED, lambda check: context.progress(next(number), len(PUBLISHED), check.title)))
    all_of = [one for outcome in outcomes for one in outcome.comparisons]
    said = (
        f"{sum(one.passed for one in all_of)} of {len(all_of)} published numbers agree within the allowed difference. "
        f"viscofric {__version__} computed its values on this computer in {time.perf_counter() - begun:.1f} s; the "
        "published values are stored in the program."
    )
    return {"said": said, "checks": [_shown(outcome) for outcome in outcomes]}


def _shown(outcome: Outcome) -> Spec:
    check = outcome.check
    origin = [
        f"Source: {check.source}.",
        check.obtained and f"Obtained: {check.obtained}.",
        check.unstated and f"Not stated there: {check.unstated}.",
        f"Allowed difference: {check.reason}.",
        outcome.trouble,
    ]
    rows = [[one.case, one.quantity, *one.texts] for one in outcome.comparisons]
    return {
        "title": check.title,
        "verdict": "agrees" if outcome.passed else "does not agree",
        "origin": [one.replace("..", ".") for one in origin if one],
        "table": table(check.title, _HEAD, rows),
    }
