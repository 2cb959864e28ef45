"""The page's document as a run file: its text, all that is wrong with it, and, packed with its data, to take away."""

from __future__ import annotations

from typing import Any

from viscofric.errors import ViscofricError
from viscofric.notes import Note
from viscofric.study.run_file.study import Study
from viscofric.web.jobs.context import Context, JobOptions, beside_field
from viscofric.web.jobs.export_files import archive, missing_files, offered
from viscofric.web.study_files import named_files
from viscofric.web.study_text import RUN_FILE, DocumentError, study_of, study_text

ARCHIVE = "study.zip"


class Options(JobOptions):
    """How much is wanted."""

    pack: bool = False  # whether the run file is packed, together with its data files, as a download


#: What only a run file without problems has.
_OF_SOUND = ("cases", "about", "files", "download")


def run(study: dict[str, Any], options: Options, context: Context) -> dict[str, Any]:
    """Write and check a run file; what only a sound one has is None where there are ``problems``."""
    text, problems, checked = _checked(study, context)
    if checked is None or problems:
        if options.pack:
            raise DocumentError(problems)
        shown = list(map(beside_field, problems))
        return {"text": text, "problems": shown, "summary": "", **dict.fromkeys(_OF_SOUND)}
    download = None
    if options.pack:
        files = [(path.name, path) for path in checked.inputs]
        download = offered(archive(context.downloads / ARCHIVE, [(RUN_FILE, text), *files]), "run file and data")
    cases, names = len(checked.sweep().cases), [path.name for path in checked.inputs]
    counted = f"{cases} case{'' if cases == 1 else 's'}"
    reads = names[0] if len(names) == 1 else f"{len(names)} data files, which the zip contains"
    return {
        "text": text,
        "problems": [],
        "cases": cases,
        "about": f"It has {counted}.{f' It reads {reads}.' if names else ''}",
        "summary": f"run file: {counted}",
        "files": names,
        "download": download,
    }


def _checked(study: dict[str, Any], context: Context) -> tuple[str, tuple[Note, ...], Study | None]:
    """Return the text, what is wrong with it, and the study if it is one."""
    try:
        text, checked = study_of(study, context.files)
        missing = [
            Note("file-not-here", f"The file {name} is not here; drop it on the page first.", _place_of(study, name))
            for name in missing_files(checked)
        ]
    except DocumentError as error:
        return _text_of(study), error.mistakes, None
    try:
        checked.sweep()
    except ViscofricError as error:
        return text, (error.note.at("conditions"),), None
    return text, tuple(missing), checked


def _text_of(study: dict[str, Any]) -> str:
    """Return what is wrong as text, too, so that it can be looked at."""
    try:
        return study_text(study)
    except DocumentError:
        return ""


def _place_of(study: dict[str, Any], name: str) -> str:
    """Return the path in the document where a file is named; none if a pattern stands for it."""
    return next((one.place for one in named_files(study) if name in one.names), "")
