"""Fields of the page's forms: a label, the path in the study, and what `static/js/fields.js` does with it."""

from __future__ import annotations

from typing import Any, TypeAlias

Field: TypeAlias = dict[str, Any]


def field(path: str, label: str, kind: str | None = None, **more: Any) -> Field:
    """Return a field: of a quantity, if its kind is given, or of text."""
    return {"path": path, "label": label, **({"kind": kind} if kind else {}), **more}


def number(path: str, label: str, **more: Any) -> Field:
    """Return a field of a plain number."""
    return field(path, label, **{"as": "number", **more})


def spread(path: str, label: str, kind: str, **more: Any) -> Field:
    """Return a field of a quantity that is one value, a list or a range."""
    return field(path, label, kind, **{"as": "range", **more})


def choice(path: str, label: str, options: str | list[Any], otherwise: Any = None, **more: Any) -> Field:
    """Return a choice among values, each with its words on the page or alone: a list, or "value; value: words"."""
    if isinstance(options, str):
        options = [[value, words or value] for value, _, words in (one.partition(": ") for one in options.split("; "))]
    return field(path, label, None, **{"as": "choice", "options": options, "otherwise": otherwise, **more})


def switch(label: str, keys: dict[str, Any], **more: Any) -> Field:
    """Return a switch of some keys, with the values that it gives them."""
    return field(next(iter(keys)), label, **{"as": "switch", "keys": keys, **more})


def when(where: dict[str, Any], *fields: Field) -> list[Field]:
    """Return fields that are shown under a condition: paths, and whether each is given or which values it has."""
    return [{**one, "when": [{**where, **also} for also in one.get("when", [{}])]} for one in fields]


def left(where: dict[str, Any], one: Field) -> Field:
    """Return a field that is shown under a condition, or where a value is left there, so that it can be emptied."""
    return {**one, "when": [where, {one["path"]: True}]}
