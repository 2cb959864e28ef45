"""The rubber of a page's run file: checked, made once, and kept for the jobs that follow."""

from __future__ import annotations

import contextlib
import hashlib
import json
import pickle
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from pydantic import create_model

from viscofric.errors import DataFileError, StudyError
from viscofric.files import read_bytes, write_atomically
from viscofric.notes import Note
from viscofric.study.make_rubber import make_rubber
from viscofric.study.rubber import Rubber
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.settings import UncertaintyTable
from viscofric.study.run_file.study import validated
from viscofric.study.run_file.tables import Table, files_of
from viscofric.study.study_rubber import FrictionBands, StudyRubber
from viscofric.web.jobs.context import Context

Made = TypeVar("Made")

#: Rubbers that one child keeps in memory; a made rubber with its draws takes some 300 kB.
_KEPT = 16
_memory: OrderedDict[str, Any] = OrderedDict()


def checked_part(**tables: Any) -> Any:
    """Return some tables of a run file, checked alone: by name, the class and the values of each."""
    kinds: dict[str, Any] = {name: (kind, ...) for name, (kind, _) in tables.items()}
    model = create_model("Part", __base__=Table, **kinds)
    return validated(model, {name: values for name, (_, values) in tables.items()})


def checked_tables(study: Mapping[str, Any], context: Context) -> tuple[MaterialTable, UncertaintyTable]:
    """Check [material] (the first of several) and [uncertainty] alone; paths are those of uploaded files."""
    material = study.get("material")
    if isinstance(material, list) and material:
        material = material[0]
    tables = checked_part(
        material=(MaterialTable, {} if material is None else material),
        uncertainty=(UncertaintyTable, study.get("uncertainty", {})),
    )
    for key in MaterialTable.FILES:
        insist_on_uploads(f"material.{key}", getattr(tables.material, key), context.files)
    return tables.material.relative_to(context.files), tables.uncertainty


def made_rubber(study: Mapping[str, Any], context: Context) -> Rubber:
    """Return the rubber of [material], made by `make_rubber` or found where an earlier job left it."""
    table, _ = checked_tables(study, context)
    return kept("rubber", [table], table.inputs, context, lambda: _made(table))


def friction_bands(study: Mapping[str, Any], context: Context) -> FrictionBands:
    """Return the draws of the rubber of [uncertainty]; `samples` is None where none can be drawn."""
    table, wanted = checked_tables(study, context)
    rubber = made_rubber(study, context)
    settings = [table, wanted.draws, wanted.seed]
    return kept("bands", settings, table.inputs, context, lambda: FrictionBands(rubber, wanted.draws, wanted.seed))


def study_rubber(study: Mapping[str, Any], context: Context, temperatures: Sequence[float] = ()) -> StudyRubber:
    """Return the rubber as a study has it, without members; raise where a temperature (K) has no shift factor."""
    from viscofric.study.rubber import rubber_at

    rubber = rubber_at(made_rubber(study, context), temperatures)
    return StudyRubber(rubber, friction_bands(study, context), ())


def kept(
    name: str, settings: Sequence[object], inputs: Sequence[Path], context: Context, make: Callable[[], Made]
) -> Made:
    """Return what was made before of the same settings and contents of files, by any process; else make it."""
    key = _key(name, settings, inputs)
    if key in _memory:
        _memory.move_to_end(key)
        return _memory[key]  # type: ignore[no-any-return]
    path = context.cache / f"{key}.pickle"
    found = _loaded(path)
    if found is None:
        found = make()
        _store(path, found)
    _memory[key] = found
    while len(_memory) > _KEPT:
        _memory.popitem(last=False)
    return found  # type: ignore[no-any-return]


def _made(table: MaterialTable) -> Rubber:
    rubber = make_rubber(table, liquids=True)
    for fit in (rubber.fit, rubber.step_fit):
        if fit is not None:
            _ = fit.check  # found once, and kept with the rest
    return rubber


def insist_on_uploads(place: str, given: Path | tuple[Path, ...] | None, folder: Path) -> None:
    """Refuse files (or patterns) outside the folder of uploads, named at a `place` of the run file."""
    paths = given if isinstance(given, tuple) else () if given is None else (given,)
    for path in paths:
        outside = path.is_absolute() or len(path.parts) != 1
        missing = [str(path)] if outside else [one.name for one in files_of(folder, path) if not one.is_file()]
        if missing:
            said = f"'{missing[0]}' is not one of the page's files; drop it on the page first."
            raise StudyError(Note("file-not-here", said, place))


def _key(name: str, settings: Sequence[object], inputs: Sequence[Path]) -> str:
    from viscofric import __version__

    digest = hashlib.sha256(f"{__version__} {name}".encode())
    for one in settings:
        text = one.model_dump_json() if isinstance(one, Table) else json.dumps(one)
        digest.update(f"\0{text}".encode())
    for path in inputs:
        digest.update(f"\0{path}\0".encode())
        digest.update(read_bytes(path))
    return f"{name}-{digest.hexdigest()[:32]}"


def _loaded(path: Path) -> Any:
    """Return what another child left in this workspace's own folder; None where it left nothing."""
    try:
        return pickle.loads(path.read_bytes())
    except (OSError, EOFError, pickle.UnpicklingError, AttributeError, ImportError):
        return None


def _store(path: Path, value: object) -> None:
    # A full disk costs time, not the reply.
    with contextlib.suppress(DataFileError):
        write_atomically(path, pickle.dumps(value))
