"""A friction test in a folder: sweeps, friction, and a run file with geometry, loads, citation and licence."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from viscofric.errors import StudyError
from viscofric.files import file_path
from viscofric.study.run_file.study import Study, load_study


def open_friction_test(folder: str | PathLike[str]) -> tuple[Path, Study]:
    """Return the run file of a friction test, and what it holds; raise `StudyError` where something is missing."""
    place = file_path(folder)
    if not place.is_dir():
        raise StudyError(f"{place}: is not a folder; expected the folder of a friction test.", code="no-folder")
    found = sorted(place.glob("*.toml"))
    if len(found) != 1:
        names = ", ".join(path.name for path in found) or "none"
        raise StudyError(
            f"{place}: expected one run file (*.toml) beside the sweeps and the friction; found {names}.",
            code="no-run-file",
        )
    study = load_study(found[0])
    missing = [
        (not study.material.dma, '[material] dma = "sweeps.csv"'),
        (study.measurement is None, '[measurement] mtm = "friction.csv" (or curves = "friction.csv")'),
        (not study.citation, 'citation = "…"'),
        (not study.licence, 'licence = "…"'),
    ]
    wanted = [text for lacks, text in missing if lacks]
    if wanted:
        raise StudyError(
            f"{found[0]}: a friction test needs its sweeps, its measured friction, a citation and a licence; add "
            f"{', and '.join(wanted)}.",
            code="incomplete-test",
        )
    return found[0], study
