"""Job ``recognise``: which key of [material] each uploaded file of a mechanical test belongs to."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import Field

from viscofric.files import says_synthetic
from viscofric.web.jobs.context import Context, JobOptions
from viscofric.web.jobs.rubbers import insist_on_uploads


class Options(JobOptions):
    """Names of uploaded files."""

    files: list[str] = Field(min_length=1, max_length=10_000)


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Sort uploaded files by the kind of test that they hold; say whether one of them was made up."""
    from viscofric.readers.recognise import by_kind

    insist_on_uploads("material", tuple(map(Path, options.files)), context.files)
    files = [context.files / name for name in options.files]
    kinds = {kind: [path.name for path in paths] for kind, paths in by_kind(files).items()}
    return {"kinds": kinds, "synthetic": any(map(says_synthetic, files))}
