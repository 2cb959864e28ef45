"""Sentences of viscofric are compared in `test_messages.py` of each room only, codes and numbers elsewhere."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import chain
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
SOURCE = TESTS.parent / "src" / "viscofric"
#: A test quotes a sentence if it has this many of its words in succession; names and labels are shorter.
FRAGMENT = 4
#: Shorter texts of the source are names or labels.
SENTENCE = 8
#: Calls whose arguments are compared with a text.
COMPARED = {"startswith", "endswith", "find", "index", "count", "search", "match", "fullmatch", "findall"}
EXPECTED = {"match", "naming"}  # arguments of pytest and of `refused`
HELPERS = {"refused", "noted", "notes_with"}
#: The page as people see it, and what benchmarks print, have no codes.
READ_BY_PEOPLE = ("_page.py", "test_export_step.py", "test_benchmarks.py")

_WORDS = re.compile(r"[A-Za-z]+(?: [A-Za-z]+)+")
_QUOTED = re.compile(r"'[^' ][^']*'|\"[^\"]*\"|“[^”]*”|``[^`]*``")


def text_of(node: ast.AST) -> str:
    """Return the text of a literal, with a gap for each value; empty for anything else."""
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "…" for part in node.values)
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def texts(nodes: Iterable[ast.AST]) -> dict[ast.AST, str]:
    """Return the texts among the nodes of a walk, f-strings as a whole, but no docstrings."""
    found, parts = {}, set()
    for one in nodes:  # what is around a text comes before it
        if isinstance(one, ast.JoinedStr):
            parts.update(one.values)
        elif isinstance(one, ast.Expr):
            parts.add(one.value)
        if one not in parts and (text := text_of(one)):
            found[one] = text
    return found


def fragments(text: str) -> Iterator[tuple[str, ...]]:
    """Yield every group of words in succession, without what is quoted."""
    for run in _WORDS.findall(_QUOTED.sub("…", text)):
        words = run.split(" ")
        yield from (tuple(words[place : place + FRAGMENT]) for place in range(len(words) - FRAGMENT + 1))


@cache
def sentences() -> tuple[frozenset[tuple[str, ...]], frozenset[str]]:
    """Return the fragments of all sentences in the source, and all texts in it that are no sentences."""
    found, labels = set(), set()
    modules = (texts(ast.walk(ast.parse(path.read_text("utf-8")))).values() for path in SOURCE.rglob("*.py"))
    page = re.findall(r'"([^"]*)"', (SOURCE / "web" / "start.toml").read_text("utf-8"))
    for text in chain(*modules, page):
        if len(re.findall(r"[A-Za-z]+", text)) < SENTENCE:
            labels.add(text.strip())
        else:
            found.update(fragments(text))
    return frozenset(found), frozenset(labels)


def quoted(source: str) -> Iterator[tuple[int, str]]:
    """Yield the line and the text of each comparison with a sentence in the source of a test."""
    found, labels = sentences()
    nodes = list(ast.walk(ast.parse(source)))
    compared: dict[ast.AST, str] = {}
    for node in nodes:
        parts: list[ast.AST] = []
        if isinstance(node, ast.Compare):
            parts = [node.left, *node.comparators]
        elif isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            parts = [word.value for word in node.keywords if word.arg in EXPECTED]
            parts += node.args if name in COMPARED | HELPERS else []
        for part in parts:
            compared |= texts(ast.walk(part))
    # What goes into viscofric may come out of it.
    given = "\n".join(text for one, text in texts(nodes).items() if one not in compared)
    for one, text in compared.items():
        if text.strip() not in labels and text not in given and any(part in found for part in fragments(text)):
            yield getattr(one, "lineno", 0), text


@pytest.mark.apart
def test_no_test_compares_sentences_but_those_of_messages() -> None:
    found = [
        f"{path.relative_to(TESTS)}, line {line}: {text!r}"
        for path in sorted(TESTS.rglob("*.py"))
        if path.name != "test_messages.py" and not path.name.endswith(READ_BY_PEOPLE)
        for line, text in quoted(path.read_text("utf-8"))
    ]
    assert not found, "\n".join(["compare codes and numbers, or move these to test_messages.py:", *found])


def test_a_quoted_sentence_is_found() -> None:
    part = "cannot be grouped into nominal values"
    assert [line for line, _ in quoted(f'assert code\nassert "{part}" in str(error)')] == [2]
    assert [text for _, text in quoted(f'with raises(ValueError, match="it {part}"): pass')] == [f"it {part}"]
    assert list(quoted(f'note = "{part}"\nassert "{part}" in note')) == []  # the test's own
    assert list(quoted('assert "no-gap" in codes(notes)\nassert names == ["speed", "load"]')) == []
