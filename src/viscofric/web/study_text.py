"""The document that the page edits, as the text of a run file, and checked as one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from viscofric.errors import StudyError, brief
from viscofric.notes import Note
from viscofric.study.cases.sweep import COORDINATES
from viscofric.study.run_file.errors import keys
from viscofric.study.run_file.study import FIELDS, TABLES, Study, parse_study

#: What the exported run file is called.
RUN_FILE = "study.toml"
_HEAD = "# Made on the local page of viscofric; to be run with: viscofric run study.toml\n"
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_NO_MATERIAL = Note(
    "no-material",
    "There is no material yet: drop DMA sweeps, or choose a material of the catalogue, in step 1, Data.",
    "material",
)
_LONGEST_LINE = 100
_DEEPEST = 10
#: Keys of a run file, in its order.
KEYS = tuple(field.alias or name for name, field in FIELDS.items())
_OF_INDENTERS = ("shape", *COORDINATES, "modulus", "poisson_ratio")


class DocumentError(StudyError):
    """What is wrong with a document; the place of each problem is its path in it, such as ``conditions.load``."""

    def __init__(self, problems: Sequence[Note]) -> None:
        super().__init__("The study cannot be used:", problems)

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.mistakes,), self.__dict__


def study_of(document: Mapping[str, Any], folder: Path) -> tuple[str, Study]:
    """Return a document as a run file and a checked study; `DocumentError` has every wrong key, unit and range."""
    text = study_text(document)
    path = folder / RUN_FILE
    try:
        study = parse_study(text, path)
    except StudyError as error:
        whole = error.note.reworded(lambda text: text.replace(f"{path}: ", ""))
        mistakes = [one for one in error.mistakes or [whole] if one.where != "material" or "material" in document]
        raise DocumentError(mistakes + ([] if "material" in document else [_NO_MATERIAL])) from None
    for file in study.inputs:
        if file.parent != folder or file.name in ("", ".."):
            words = f"{brief(str(file))} lies elsewhere; drop the file on the page, and give its name alone."
            raise DocumentError([Note("file-not-here", words)])
        if file.name.casefold() == RUN_FILE:
            words = f"A data file is called {file.name}, as the run file itself will be; drop it under another name."
            raise DocumentError([Note("name-of-run-file", words)])
    return text, study


def study_text(document: Mapping[str, Any]) -> str:
    """Write the tables of a document as TOML; raise `DocumentError` for what no run file can hold, such as null."""
    known = [key for key in KEYS if key in document]
    ordered = {key: document[key] for key in [*known, *(key for key in document if key not in known)]}
    tables = {key: value for key, value in ordered.items() if _is_table(value)}
    parts = [_HEAD + "".join(_line(key, value, key) for key, value in ordered.items() if key not in tables)]
    for key, value in tables.items():
        for at, one in enumerate(value if isinstance(value, list) else [value]):
            path = f"{key}[{at}]" if isinstance(value, list) else key
            head = f"[[{_key(key)}]]\n" if isinstance(value, list) else f"[{_key(key)}]\n"
            parts.append(head + "".join(_line(name, entry, f"{path}.{name}") for name, entry in _in_order(key, one)))
    text = "\n".join(parts)
    try:
        text.encode()
    except UnicodeEncodeError:
        raise DocumentError([Note("no-unicode", "The study holds half of a character, which no file can.")]) from None
    return text


def _in_order(key: str, table: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield the entries of a table in the order of the documentation, those that it does not know last."""
    order = {"indenter": _OF_INDENTERS}.get(key) or (keys(TABLES[key]) if key in TABLES else [])
    yield from ((name, table[name]) for name in order if name in table)
    yield from ((name, entry) for name, entry in table.items() if name not in order)


def _is_table(value: object) -> bool:
    return isinstance(value, dict) or (
        isinstance(value, list) and bool(value) and all(isinstance(one, dict) for one in value)
    )


def _line(key: str, value: object, path: str) -> str:
    return f"{_key(key)} = {_value(value, path)}\n"


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _scalar(key, "")


def _value(value: object, path: str, depth: int = 0) -> str:
    if depth > _DEEPEST:
        deep = Note("too-deep", "Lists or tables lie within each other too deeply.", path.partition("[")[0])
        raise DocumentError([deep])
    if isinstance(value, dict):
        inside = [f"{_key(str(key))} = {_value(one, f'{path}.{key}', depth + 1)}" for key, one in value.items()]
        return f"{{ {', '.join(inside)} }}" if inside else "{}"
    if isinstance(value, list | tuple):
        entries = [_value(one, f"{path}[{at}]", depth + 1) for at, one in enumerate(value)]
        line = f"[{', '.join(entries)}]"
        # Within braces a line may not end, so that only lists right below a table are broken.
        return line if len(line) <= _LONGEST_LINE or depth else "[\n" + "".join(f"  {one},\n" for one in entries) + "]"
    return _scalar(value, path)


def _scalar(value: object, path: str) -> str:
    import tomli_w

    if value is None:
        raise DocumentError([Note("null", "Is null; leave the key out, or give it a value.", path)])
    return tomli_w.dumps({"value": value}).removeprefix("value = ").removesuffix("\n")
