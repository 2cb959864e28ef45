"""A workspace with measured friction, for tests of the jobs on it: folders, files, and the study of a page."""

from __future__ import annotations

import json
import shutil
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

import viscofric as vf
from friction.synthetic_curves import synthetic_curves
from viscofric.web.jobs.context import Context
from web.figure_columns import drawn

EXAMPLE = Path(vf.__file__).parent / "templates" / "paper"
STUDY: dict[str, Any] = {
    "material": {"catalogue": "synthetic fluoroelastomer"},
    "indenter": {"shape": "ball", "radius": "9.525 mm"},
    "conditions": {"load": "25 N", "speed": "20 mm/s", "temperature": "60 degC"},
    "solver": {"accuracy": 1e-2},
}
NOISE = 0.015


def curves() -> vf.FrictionCurves:
    """Return friction of the synthetic rubber at five temperatures whose curves overlap, with noise."""
    return synthetic_curves(30, 35, 40, 46, 52, noise=NOISE, seed=5)


def workspace(folder: Path) -> Context:
    """Return a context with the example's traction runs and DMA, and with friction curves of the same rubber."""
    for name in ("files", "downloads", "cache"):
        (folder / name).mkdir(parents=True)
    for name in ("mtm.csv", "dma.csv"):
        shutil.copy(EXAMPLE / name, folder / "files")
    vf.write_friction_curves(curves(), folder / "files" / "curves.csv")
    return Context(folder / "files", folder / "downloads", folder / "cache")


def done(kind: str, context: Context, study: dict[str, Any], **options: Any) -> dict[str, Any]:
    """Do a job; return its result as the page gets it: JSON, in which a NaN would be an error."""
    job = import_module(f"viscofric.web.jobs.{kind}")
    result = job.run(study, job.Options.model_validate(options), context)
    read: dict[str, Any] = json.loads(json.dumps(result, allow_nan=False))
    return drawn(read)


def column(isotherms: list[dict[str, Any]], name: str) -> Any:
    """Return a column of all isotherms, one after the other; NaN for null."""
    return np.array([value for one in isotherms for value in one[name]], dtype=float)
