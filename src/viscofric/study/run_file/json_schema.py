"""The JSON schema of a run file, for editors, generated from the tables that validate it."""

from __future__ import annotations

from typing import Any

from viscofric.study.run_file.study import Study

DIALECT = "http://json-schema.org/draft-07/schema#"
_WITHOUT_MEANING: dict[str, type] = {"title": str, "default": type(None)}


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a run file in draft 7, which the TOML plug-ins of editors know."""
    schema = _plain(Study.model_json_schema(by_alias=True, mode="validation"))
    material = schema["properties"]["material"]
    one = material.pop("items")
    schema["properties"]["material"] = {
        "description": material["description"],
        "anyOf": [one, {"type": "array", "items": one, "minItems": 1, "maxItems": material["maxItems"]}],
    }
    for table in schema["properties"].values():
        if "$ref" in table:  # other keys are ignored there in this dialect; the table has its own defaults
            table.pop("default", None)
    schema["oneOf"] = [{"required": [body]} for body in ("indenter", "surface")]
    about = "Definition of a study. Every quantity carries its unit; paths are relative to the run file."
    return {"$schema": DIALECT, **schema, "title": "Run file of viscofric", "description": about}


def _plain(node: Any) -> Any:
    """Leave out names of Python's fields and classes, and the null that TOML does not have."""
    if isinstance(node, list):
        return [_plain(entry) for entry in node]
    if not isinstance(node, dict):
        return node
    kept = {
        key: {name: _plain(entry) for name, entry in value.items()} if key in ("properties", "$defs") else _plain(value)
        for key, value in node.items()
        if not (key in _WITHOUT_MEANING and isinstance(value, _WITHOUT_MEANING[key]))
    }
    for choice in ("anyOf", "oneOf"):
        several = [entry for entry in kept.get(choice, ()) if entry != {"type": "null"}]
        if len(several) == 1 and not several[0].keys() & kept.keys():
            del kept[choice]
            kept |= several[0]
        elif several:
            kept[choice] = several
    return kept
