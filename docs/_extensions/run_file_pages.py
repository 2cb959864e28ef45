"""The tables of a run file as Markdown: every key with its values, default and meaning, as the models know them."""

from __future__ import annotations

import re
from typing import Any

from page_parts import cell, table

from viscofric.study.run_file.json_schema import json_schema

#: A default that says more in words than in numbers.
_WORDS = {2.718281828459045: "e = 2.718…"}


class Schema:
    """The JSON schema of run files, and descriptions of its parts."""

    def __init__(self) -> None:
        self.root = json_schema()

    def resolved(self, node: dict[str, Any]) -> dict[str, Any]:
        """Resolve a reference, and add the keys given with it."""
        if "$ref" not in node:
            return node
        target = self.root["$defs"][node["$ref"].rsplit("/", 1)[1]]
        return target | {key: value for key, value in node.items() if key != "$ref"}

    def choices(self, node: dict[str, Any]) -> list[dict[str, Any]]:
        """Return the permitted types of a value, in order."""
        node = self.resolved(node)
        for kind in ("oneOf", "anyOf"):
            if kind in node:
                return [found for one in node[kind] for found in self.choices(one)]
        return [node]

    def values(self, node: dict[str, Any]) -> str:
        """Describe the permitted values."""
        found = self.choices(node)
        is_range = any("from" in one.get("properties", {}) for one in found)
        single = [one for one in found if one.get("type") not in ("object", "array")]
        kinds = list(dict.fromkeys(self._single(one) for one in single))
        listed = [one for one in found if one.get("type") == "array"]
        if not single and listed:
            kinds = [f"list of {self.values(listed[0].get('items', {}))}"]
        elif listed:
            kinds.append("a list")
        if is_range:
            kinds.append("a range")
        elif any(one.get("type") == "object" for one in found):
            kinds.append("a table")
        return ", ".join(kinds[:-1]) + (" or " if len(kinds) > 1 else "") + kinds[-1]

    def _single(self, node: dict[str, Any]) -> str:
        if "const" in node:
            return f'`"{node["const"]}"`'
        if "enum" in node:
            return ", ".join(f'`"{one}"`' for one in node["enum"])
        if "examples" in node:
            return "quantity, such as " + ", ".join(f'`"{one}"`' for one in node["examples"])
        kind = {"string": "text", "integer": "whole number", "number": "number", "boolean": "`true` or `false`"}
        return kind[node["type"]] + self._limits(node)

    @staticmethod
    def _limits(node: dict[str, Any]) -> str:
        signs = {"exclusiveMinimum": "above", "minimum": "from", "exclusiveMaximum": "below", "maximum": "to"}
        shown = [f"{word} {node[key]:g}" for key, word in signs.items() if key in node and abs(node[key]) < 1e15]
        return " " + " ".join(shown) if shown else ""


def default(key: str, node: dict[str, Any], required: list[str]) -> str:
    """Describe the default of a key."""
    if key in required:
        return "required"
    value = node.get("default")
    if value is None or value in ([], {}, ""):
        return "none"
    if isinstance(value, float) and value in _WORDS:
        return _WORDS[value]
    return f'`"{value}"`' if isinstance(value, str) else f"`{str(value).lower()}`"


def rows(schema: Schema, model: dict[str, Any], skip: frozenset[str] = frozenset()) -> list[list[str]]:
    """Return a row for each key of a table."""
    return [
        [
            f"`{key}`",
            schema.values(node),
            default(key, schema.resolved(node), model.get("required", [])),
            cell(schema.resolved(node).get("description", "")),
        ]
        for key, node in model["properties"].items()
        if key not in skip
    ]


def _table(rows_of_keys: list[list[str]]) -> str:
    return table(["key", "value", "default", "meaning"], rows_of_keys, numbers=False)


def words(model: dict[str, Any]) -> str:
    """Return the description of a table, without its name."""
    text = re.sub(r"^\[[\w\]\[ ,]+\]: ", "", model.get("description", ""))
    return cell(text[:1].upper() + text[1:])


def page() -> str:
    """Return all tables in the order of a run file."""
    schema = Schema()
    tables = {key: schema.choices(node) for key, node in schema.root["properties"].items()}
    tables = {key: [one for one in found if "properties" in one] for key, found in tables.items()}
    plain = {**schema.root, "properties": {k: v for k, v in schema.root["properties"].items() if not tables[k]}}
    shown = ["## Top level", _table(rows(schema, plain))]
    for key, models in tables.items():
        if not models:
            continue
        shown.append(f"(table-{key})=\n## [{key}]")
        common = frozenset.intersection(*(frozenset(one["properties"]) for one in models)) - {"shape"}
        for model in models:
            if len(models) > 1:
                shape = model["properties"]["shape"]["const"]
                shown.append(f'### shape = "{shape}"')
            shown += [words(model), _table(rows(schema, model, common if len(models) > 1 else frozenset()))]
        if len(models) > 1:
            shared = {**models[0], "properties": {k: v for k, v in models[0]["properties"].items() if k in common}}
            shown += ["### All shapes", _table(rows(schema, shared))]
    return "\n\n".join(part for part in shown if part)
