"""A tab's folders with files in them, and jobs run on these without a server."""

from __future__ import annotations

import json
import shutil
from importlib import import_module
from pathlib import Path
from typing import Any

import viscofric
from viscofric.web.jobs import KINDS
from viscofric.web.jobs.context import Context
from web.figure_columns import drawn

EXAMPLE = Path(viscofric.__file__).parent / "templates" / "paper" / "dma.csv"
SWEEPS: dict[str, Any] = {"dma": "dma.csv", "reference_temperature": "30 degC"}


def workspace_with(folder: Path, *files: Path) -> Context:
    """Make the folders of a tab, with copies of files among the uploads."""
    places = [folder / name for name in ("files", "downloads", "cache")]
    for place in places:
        place.mkdir()
    for file in files:
        shutil.copy(file, places[0])
    return Context(*places)


def done(kind: str, context: Context, material: dict[str, Any], **more: Any) -> Any:
    """Run a job and return its answer as the page gets it: what JSON cannot hold would raise."""
    options = more.pop("options", {})
    module = import_module(KINDS[kind].module)
    answer = module.run({"material": material, **more}, module.Options(**options), context)
    return drawn(json.loads(json.dumps(answer, allow_nan=False)))
