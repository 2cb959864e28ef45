"""Job ``measured``: what was recognised in the files of [measurement], and the friction separated from them."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from viscofric.datasets import plain
from viscofric.friction.curve_files import write_friction_curves
from viscofric.notes import listed
from viscofric.report.texts.checks import consistency_shown
from viscofric.report.texts.friction import friction_lines
from viscofric.web.figures.friction import measured_figures
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.friction_data import measured_points, pairs
from viscofric.web.jobs.friction_input import measured, table_of_files

_DOWNLOAD = "friction_curves.csv"


class Options(JobOptions):
    """Options of the job."""

    #: Uploaded files that were dropped; those of [measurement] without
    files: tuple[str, ...] = Field((), max_length=1_000)


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Read and separate the files of [measurement]; no other table is looked at."""
    table = table_of_files(study, context, options.files) if options.files else study.get("measurement")
    context.progress(0, 1, "Reading the files")
    found = measured({**study, "measurement": table}, context)
    result: dict[str, Any] = {
        "table": table,
        "recognised": pairs(found.lines),
        "steps": [{"number": number, "text": text} for number, text in found.steps],
        "runs": found.runs,
        "synthetic": found.synthetic,
        "refusal": found.refusal.words("page") or None,
        **listed("notes", dict.fromkeys(found.notes), "page"),
        "curves": None,
        "summary": "not separated" if found.curves is None else f"{len(found.curves)} points",
    }
    if found.curves is not None:
        check = found.curves.consistency_check  # whether the four sign configurations agree with each other
        write_friction_curves(found.curves, context.downloads / _DOWNLOAD)
        result |= {
            "curves": measured_points(found.curves),
            "points": len(found.curves),
            "lines": pairs(line for line in friction_lines(found.curves) if line[0] not in ("assumed", "residual")),
            "checks": [] if check is None else [consistency_shown(check).record("page")],
            "download": _DOWNLOAD,
        }
    numbers: dict[str, Any] = plain(result)
    return numbers | {"figures": measured_figures(numbers) if numbers["curves"] else {}}
