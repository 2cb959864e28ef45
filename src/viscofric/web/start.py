"""What a fresh page shows, from `start.toml`: its study and forms; and the catalogue, and the limits of requests."""

from __future__ import annotations

import copy
import os
from collections.abc import Iterator
from importlib.resources import files
from typing import Any

from viscofric.files import parse_toml

_PAGE = parse_toml(files("viscofric.web").joinpath("start.toml").read_text(encoding="utf-8"))


def _valued(value: Any) -> Any:
    """Return a value of the forms with None for each `{}`."""
    if isinstance(value, dict):
        return {key: _valued(one) for key, one in value.items()} or None
    return [_valued(one) for one in value] if isinstance(value, list) else value


def _fields(entry: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the fields of an entry of a form, as `fields.js` has them."""
    if "fields" in entry:
        for one in entry["fields"]:
            for field in _fields(one):
                yield field | {"when": [entry["when"] | also for also in field.get("when", [{}])]}
        return
    one = {key: value for key, value in entry.items() if key not in {"left", "begins"}}
    one.setdefault("path", next(iter(one.get("keys", {})), None))
    if one.get("as") in {"choice", "ticks"}:
        one.setdefault("otherwise")
        if isinstance(one["options"], str):
            parts = (option.partition(": ") for option in one["options"].split("; "))
            one["options"] = [[value or None, words or value] for value, _, words in parts]
    if "left" in entry:
        one["when"] = [entry["left"], {one["path"]: True}]
    if "begins" in entry:
        table = one["path"].rpartition(".")[0]
        others = dict.fromkeys(key for keys in entry["begins"].values() for key in keys or {})
        one["sets"] = {
            value: {f"{table}.{key}": to for key, to in (others | (keys or {})).items()}
            for value, keys in entry["begins"].items()
        }
    if one.get("max") == "processors":
        one["max"] = os.cpu_count() or 1
    yield one


#: The study that a page opens with, as a run file would say it.
FIRST_STUDY: dict[str, Any] = _PAGE["study"]
#: What each shape begins with.
SHAPES: dict[str, Any] = _PAGE["shapes"]
#: Fields of the page's forms, by the forms' names on the page.
FORMS: dict[str, list[dict[str, Any]]] = {
    name: [field for entry in entries for field in _fields(_valued(entry))] for name, entries in _PAGE["forms"].items()
}
#: Label on the page -> definition.
GLOSSARY: dict[str, str] = _PAGE["glossary"]


def start(study: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return what the page requests first; `study`: the run file's tables it opens with, instead of the first study."""
    from importlib.metadata import version

    from viscofric.web.workspace import LARGEST_UPLOAD, MOST_FILES

    return {
        "version": version("viscofric"),
        "study": copy.deepcopy(FIRST_STUDY if study is None else study),
        "catalogue": rubbers(),
        "limits": {"upload": LARGEST_UPLOAD, "files": MOST_FILES},
        "forms": FORMS,
        "shapes": SHAPES,
        "glossary": GLOSSARY,
    }


def rubbers() -> list[dict[str, Any]]:
    """Return the rubbers of the catalogue."""
    from viscofric.rheology.catalogue import catalogue

    return [
        {"name": entry.name, "synthetic": entry.kind == "SYNTHETIC", "description": f"{entry.holds} {entry.citation}"}
        for entry in catalogue()
    ]
