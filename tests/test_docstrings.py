"""Docstrings tell the truth: the parameters that they document are those of the signature."""

from __future__ import annotations

import dataclasses
import inspect
import re

import pytest

import viscofric

PUBLIC = [name for name in viscofric.__all__ if callable(getattr(viscofric, name))]


def documented(docstring: str) -> list[str]:
    """Names in the section "Parameters" of a numpydoc docstring."""
    lines = inspect.cleandoc(docstring).splitlines()
    if "Parameters" not in lines:
        return []
    names: list[str] = []
    body = lines[lines.index("Parameters") + 2 :]
    for line, following in zip(body, [*body[1:], ""], strict=True):
        if re.fullmatch(r"-{3,}", following):  # the next section
            break
        if line and not line.startswith(" "):
            names += [name.strip().lstrip("*") for name in line.split(":")[0].split(",")]
    return names


def signature(function: object) -> list[str]:
    return [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]


def methods() -> list[tuple[str, object]]:
    """Functions and public methods that have a section of parameters."""
    found = []
    for name in PUBLIC:
        one = getattr(viscofric, name)
        if not inspect.isclass(one):
            found.append((name, one))
            continue
        for key, member in vars(one).items():
            function = getattr(member, "__func__", member)
            if not key.startswith("_") and inspect.isfunction(function) and documented(function.__doc__ or ""):
                found.append((f"{name}.{key}", function))
    return found


@pytest.mark.parametrize(("name", "function"), methods(), ids=lambda value: value if isinstance(value, str) else "")
def test_documented_parameters_are_those_of_the_signature(name, function):
    assert function.__doc__, f"{name} has no docstring"
    assert documented(function.__doc__) == signature(function)


@pytest.mark.parametrize("name", [name for name in PUBLIC if dataclasses.is_dataclass(getattr(viscofric, name))])
def test_documented_parameters_of_a_dataclass_are_those_it_takes(name):
    one = getattr(viscofric, name)
    told = documented(one.__doc__)
    assert not told or told == signature(one)
