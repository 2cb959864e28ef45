"""The whole study, run as ``viscofric run`` does it: results, report, tables and figures to take away."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

from pydantic import Field

from viscofric.notes import listed
from viscofric.report import write_figures_and_report
from viscofric.report.texts.checks import all_checks
from viscofric.report.texts.study import grouped_failures
from viscofric.study.execution import run_study
from viscofric.study.results.results import StudyResults
from viscofric.study.running.running import STAGES, Event
from viscofric.web.figures.spec import number
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.export_files import archive, lay_out, offered
from viscofric.web.study_text import study_of

_MOST_SHOWN = 8


class Options(JobOptions):
    """How the study is run."""

    #: Processes that solve contacts; the results do not depend on it
    workers: int = Field(1, ge=1, le=os.cpu_count() or 1)


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Run a study; contacts that an earlier run in this workspace solved are taken from there."""
    text, checked = study_of(study, context.files)
    folder = context.cache / "study"
    run_file = lay_out(text, checked, folder)

    def show(event: Event) -> None:
        context.show(event, STAGES[event.stage or "contacts"])

    results = run_study(run_file, resume=True, workers=options.workers, progress=show)
    context.progress(0, 1, STAGES["report"])
    figures, report = write_figures_and_report(results.tree, results.folder)
    downloads = _downloads(results, figures, report, context.downloads)
    cases, failed = int(results.dataset["friction_coefficient"].size), int(results.dataset["failed"].sum())
    doubtful = [check.sentence for check in all_checks(results.tree) if check.verdict in ("warning", "failed")]
    warnings = list(dict.fromkeys([*results.warnings, *doubtful]))
    return {
        "downloads": downloads,
        "cases": cases,
        "summary": f"{cases} cases, results ready",
        "failed": failed,
        "key_numbers": [
            number("cases", str(cases), remark=f"{failed} failed" if failed else "all solved"),
            number("warnings", str(len(warnings)), remark="listed below" if warnings else ""),
        ],
        "failures": grouped_failures(results.failures, _MOST_SHOWN, "page"),
        **listed("warnings", warnings, "page"),
        **listed("notes", dict.fromkeys(results.notes), "page"),
        "synthetic": results.tree.attrs.get("data_origin") == "synthetic",
    }


def _downloads(results: StudyResults, figures: list[Path], report: Path, folder: Path) -> list[dict[str, Any]]:
    """Put what a study left where the page can fetch it."""
    kept = [(report, "report, one page to hand on"), (results.folder / "results.nc", "results, labelled (netCDF)")]
    offers = []
    for path, title in kept:
        shutil.copyfile(path, folder / path.name)
        offers.append(offered(folder / path.name, title))
    offers.append(offered(results.to_csv(folder / "results.csv"), "table of all cases (CSV)"))
    offers.append(offered(results.to_excel(folder / "results.xlsx"), "workbook with all tables (Excel)"))
    pictures = archive(folder / "figures.zip", [(path.name, path) for path in sorted(figures)])
    offers.append(offered(pictures, f"{len(figures)} figures (PNG and SVG)"))
    return offers
