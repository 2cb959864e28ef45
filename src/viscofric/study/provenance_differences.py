"""How two results came about differently: run file, inputs, versions, accuracy."""

from __future__ import annotations

import json
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from viscofric.files import parse_toml

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_MOST_KEYS = 8
_SINGLE = {"data_origin": "data", "accuracy": "accuracy", "seed": "seed"}


def provenance_differences(one: Mapping[Any, Any], other: Mapping[Any, Any]) -> Iterator[str]:
    """Yield what differs between the attributes of two results, one sentence each.

    Parameters
    ----------
    one, other : mapping
        Attributes of the roots of results; friction curves have none.
    """
    if not one or not other:
        yield "Where the friction curves come from is not known: versions, inputs and accuracy are not compared."
        return
    for name, words in _SINGLE.items():
        if str(one.get(name)) != str(other.get(name)):
            yield f"Another {words}: {one.get(name, 'not told')} and {other.get(name, 'not told')}."
    yield from _versions(one, other)
    yield from _inputs(_table(one, "input_hashes"), _table(other, "input_hashes"))
    yield from _run_files(str(one.get("study_text", "")), str(other.get("study_text", "")))


def _versions(one: Mapping[Any, Any], other: Mapping[Any, Any]) -> Iterator[str]:
    here, there = (
        {"viscofric": str(about.get("viscofric_version", "")), **_table(about, "software")} for about in (one, other)
    )
    changed = [
        f"{name} {here.get(name, 'not told')} and {there.get(name, 'not told')}"
        for name in {**here, **there}
        if here.get(name) != there.get(name)
    ]
    if changed:
        yield f"Other versions: {', '.join(changed)}."


def _inputs(here: dict[str, str], there: dict[str, str]) -> Iterator[str]:
    """Tell of input files by their contents: the same file may lie elsewhere."""
    if set(here.values()) == set(there.values()):
        return
    names = [{PurePath(path).name: digest for path, digest in of_one.items()} for of_one in (here, there)]
    for name in sorted({**names[0], **names[1]}):
        first, second = (of_one.get(name) for of_one in names)
        if first is not None and second is not None and first != second:
            yield f"The input {name} has other contents."
        elif first is None and second not in here.values():
            yield f"The input {name} belongs to the second only."
        elif second is None and first not in there.values():
            yield f"The input {name} belongs to the first only."


def _run_files(first: str, second: str) -> Iterator[str]:
    if first == second or not (first and second):  # a table of results does not hold its run file
        return
    try:
        here, there = (dict(_flat(parse_toml(text))) for text in (first, second))
    except ValueError:
        yield "The run files differ."
        return
    changed = [key for key in {**here, **there} if here.get(key) != there.get(key)]
    for key in changed[:_MOST_KEYS]:
        yield f"The run files differ in {key}: {_shown(here.get(key))} and {_shown(there.get(key))}."
    if len(changed) > _MOST_KEYS:
        yield f"The run files differ in {len(changed) - _MOST_KEYS} more keys."


def _flat(table: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every value of nested tables with the keys that lead to it."""
    tables = table.items() if isinstance(table, dict) else enumerate(table, 1)
    for key, value in tables:
        deeper = isinstance(value, dict) or (isinstance(value, list) and value and isinstance(value[0], dict))
        yield from _flat(value, f"{prefix}{key}.") if deeper else [(f"{prefix}{key}", value)]


def _shown(value: Any) -> str:
    return "not given" if value is None else json.dumps(value, ensure_ascii=False, default=str)


def _table(attributes: Mapping[Any, Any], name: str) -> dict[str, str]:
    found = json.loads(str(attributes.get(name, "{}")))
    return {str(key): str(value) for key, value in found.items()}
