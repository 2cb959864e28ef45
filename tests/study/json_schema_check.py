"""A small JSON schema validator, of the words that the schema of run files uses: any other word is an error."""

from __future__ import annotations

import re
from typing import Any

_ABOUT = {"$schema", "$defs", "title", "description", "default", "examples"}
_TYPES: dict[str, Any] = {
    "string": lambda value: isinstance(value, str),
    "number": lambda value: isinstance(value, int | float) and not isinstance(value, bool),
    "integer": lambda value: isinstance(value, int) and not isinstance(value, bool),
    "array": lambda value: isinstance(value, list),
    "object": lambda value: isinstance(value, dict),
}
_LIMITS: dict[str, Any] = {
    "minimum": lambda value, limit: not _TYPES["number"](value) or value >= limit,
    "maximum": lambda value, limit: not _TYPES["number"](value) or value <= limit,
    "exclusiveMinimum": lambda value, limit: not _TYPES["number"](value) or value > limit,
    "exclusiveMaximum": lambda value, limit: not _TYPES["number"](value) or value < limit,
    "minLength": lambda value, limit: not isinstance(value, str) or len(value) >= limit,
    "maxLength": lambda value, limit: not isinstance(value, str) or len(value) <= limit,
    "minItems": lambda value, limit: not isinstance(value, list) or len(value) >= limit,
    "maxItems": lambda value, limit: not isinstance(value, list) or len(value) <= limit,
    "maxProperties": lambda value, limit: not isinstance(value, dict) or len(value) <= limit,
    "pattern": lambda value, limit: not isinstance(value, str) or re.search(limit, value) is not None,
    "type": lambda value, limit: _TYPES[limit](value),
    "const": lambda value, limit: value == limit,
    "enum": lambda value, limit: value in limit,
}


def wrong(value: Any, schema: dict[str, Any], root: dict[str, Any], path: str = "") -> list[str]:
    """Return where a value breaks a schema; nothing if it does not."""
    if "$ref" in schema:  # what stands beside it counts for nothing in draft 7
        return wrong(value, root["$defs"][schema["$ref"].removeprefix("#/$defs/")], root, path)
    found = []
    for word, limit in schema.items():
        if word in _LIMITS:
            if not _LIMITS[word](value, limit):
                found.append(f"{path}: {word} {limit}")
        elif word in ("anyOf", "oneOf"):
            fitting = sum(not wrong(value, one, root, path) for one in limit)
            if fitting == 0 or (word == "oneOf" and fitting > 1):
                found.append(f"{path}: fits {fitting} of {word}")
        elif word == "items":
            for place, entry in enumerate(value if isinstance(value, list) else ()):
                found += wrong(entry, limit, root, f"{path}[{place}]")
        elif word in ("properties", "required", "additionalProperties"):
            found += _of_object(value, word, limit, schema, root, path)
        else:
            assert word in _ABOUT, f"this check does not know {word!r}"
    return found


def _of_object(value: Any, word: str, limit: Any, schema: dict[str, Any], root: dict[str, Any], path: str) -> list[str]:
    if not isinstance(value, dict):
        return []
    if word == "required":
        return [f"{path}: lacks {key}" for key in limit if key not in value]
    known = schema.get("properties", {})
    if word == "properties":
        return [
            text for key in value.keys() & known.keys() for text in wrong(value[key], known[key], root, f"{path}.{key}")
        ]
    others = sorted(value.keys() - known.keys())
    if limit is False:
        return [f"{path}: does not know {key}" for key in others]
    return [text for key in others for text in wrong(value[key], limit, root, f"{path}.{key}")]
