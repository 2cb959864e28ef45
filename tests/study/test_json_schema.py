"""The JSON schema of run files: good ones fit it, mistakes that editors can see do not."""

from __future__ import annotations

import json
import tomllib
from typing import Any

import jsonschema_rs
import pytest
from annotated_types import Ge

from refusals import refused
from viscofric.cli.new import SCHEMA_LINE, TEMPLATES, template_text
from viscofric.contact.settings import ContactSettings
from viscofric.study.run_file.errors import keys
from viscofric.study.run_file.json_schema import json_schema
from viscofric.study.run_file.settings import SolverTable
from viscofric.study.run_file.study import TABLES, Study

SCHEMA = json_schema()
VALIDATOR = jsonschema_rs.validator_for(SCHEMA)


def faults(text: str) -> list[str]:
    return [error.message for error in VALIDATOR.iter_errors(tomllib.loads(text))]


def with_all_keys() -> str:
    """Return the example with the keys behind its comments, but for those that exclude each other."""
    lines = template_text("example").splitlines()
    tables = [f"# {key} = " for table in TABLES.values() for key in keys(table)]
    return "\n".join(line.removeprefix("# ") if line.startswith(("# [", *tables)) else line for line in lines)


@pytest.mark.parametrize("name", TEMPLATES)
def test_starter_files_fit(name: str) -> None:
    assert faults(SCHEMA_LINE + template_text(name)) == []


def test_every_key_of_the_example_fits() -> None:
    assert faults(with_all_keys()) == []


@pytest.mark.parametrize(
    ("good", "bad"),
    [
        ('load = "10 N"', "load = 10"),
        ('load = "10 N"', 'load = "N"'),
        ('load = "10 N"', 'load = "10"'),
        ('load = "10 N"', "load = []"),
        ('load = "10 N"', 'laod = "25 N"'),
        ('shape = "ball"', 'shape = "bal"'),
        ('shape = "ball"', 'shape = "cone"'),
        ("points = 13", "points = 1"),
        ("points = 13", 'points = "13"'),
        ('spacing = "log"', 'spacing = "logarithmic"'),
        ("accuracy = 1e-3", "accuracy = 1e-11"),
        ("draws = 200", "draws = -1"),
        ("[indenter]", "[[indenter]]"),
        ("[solver]", "[solvers]"),
    ],
)
def test_mistakes_do_not_fit(good: str, bad: str) -> None:
    text = template_text("example")
    assert good in text
    assert faults(text.replace(good, bad, 1))


def test_several_materials_fit() -> None:
    assert faults(template_text("sweep").replace("[[material]]", "[material]", 1).replace("[[material]]", "[x]")) != []
    assert faults(template_text("sweep")) == []


def described(node: Any, name: str = "") -> list[str]:
    """Return the keys in a schema that nothing describes."""
    if not isinstance(node, dict):
        return []
    bare = []
    for key, entry in node.get("properties", {}).items():
        if not entry.get("description"):
            bare.append(f"{name}.{key}")
    for key, entry in node.get("$defs", {}).items():
        bare += described(entry, key)
    return bare


def test_every_key_is_described_and_every_table_is_there() -> None:
    assert described(SCHEMA) == []
    assert set(SCHEMA["properties"]) == set(keys(Study))
    assert SCHEMA["required"] == ["material", "conditions"]
    assert SCHEMA["oneOf"] == [{"required": ["indenter"]}, {"required": ["surface"]}]
    assert json.loads(json.dumps(SCHEMA)) == SCHEMA


def test_accuracies_of_run_files_begin_where_those_of_contacts_do() -> None:
    [least] = [one.ge for one in SolverTable.model_fields["accuracy"].metadata if isinstance(one, Ge)]
    assert ContactSettings(accuracy=least).accuracy == least
    with refused("out-of-range"):
        ContactSettings(accuracy=0.99 * least)
