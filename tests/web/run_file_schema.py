"""The keys of a run file, from the tables that validate it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from viscofric.study.run_file.json_schema import json_schema

_SCHEMA = json_schema()


def nodes(node: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield a part of the schema and all that may stand in its place: branches, references, entries of a list."""
    yield node
    for branch in [*node.get("anyOf", ()), *node.get("oneOf", ()), *node.get("allOf", ())]:
        yield from nodes(branch)
    if "$ref" in node:
        yield from nodes(_SCHEMA["$defs"][node["$ref"].rpartition("/")[2]])
    if "items" in node:
        yield from nodes(node["items"])


def found(path: str) -> list[dict[str, Any]]:
    """Return what the schema says of a key of a run file."""
    here = [_SCHEMA]
    for part in path.split("."):
        here = [key for one in here for node in nodes(one) if (key := node.get("properties", {}).get(part))]
    return [node for one in here for node in nodes(one)]


def keys() -> set[str]:
    """Return the paths of all keys: those of tables, and those beside them."""
    every = set()
    for table, node in _SCHEMA["properties"].items():
        below = {name for one in nodes(node) for name in one.get("properties", {})}
        every |= {f"{table}.{name}" for name in below} or {table}
    return every
