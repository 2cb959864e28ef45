"""Errors in a run file as sentences: each with its path in the file and the nearest correct word."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from viscofric.errors import brief
from viscofric.notes import Note
from viscofric.study.run_file.tables import VALUE, as_written

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError


_LONGEST_LIST = 12


def problems(error: ValidationError, values: object, tables: Mapping[str, type[BaseModel]]) -> list[Note]:
    """Return pydantic's errors as notes whose place is the path in the file.

    `values` is the validated TOML; `tables` maps a key of the file, or a branch of a choice, to the table behind it
    ("": the whole file).
    """
    found = error.errors()
    # Pydantic also reports a list with wrong entries as empty: report the entries only.
    inside = {problem["loc"][:depth] for problem in found for depth in range(len(problem["loc"]))}
    kept = [problem for problem in found if problem["loc"] not in inside or problem["type"] != "too_short"]
    # A misspelt key is missing, too: report it as unknown only.
    unknown = [problem["loc"] for problem in found if problem["type"] == "extra_forbidden"]
    meant = {(*loc[:-1], near) for loc in unknown for near in _near(str(loc[-1]), keys(_table(loc[:-1], tables)))}
    kept = [problem for problem in kept if problem["type"] != "missing" or problem["loc"] not in meant]
    return list(dict.fromkeys(_problem(problem, values, tables) for problem in kept))


def place(parts: Iterable[str | int], values: object) -> str:
    """Return a path in the file, ``conditions.temperature[2]``, without branches of choices between types."""
    path = ""
    here: Any = values
    for part in parts:
        if isinstance(part, int):
            if not isinstance(here, list):
                continue
            path += f"[{part}]"
            here = here[part] if part < len(here) else None
        elif not _is_branch(part):
            bare = 0 < len(part) <= 60 and part.isascii() and part.replace("_", "").replace("-", "").isalnum()
            shown = part if bare else brief(part)
            path += f".{shown}" if path else shown
            here = here.get(part) if isinstance(here, dict) else None
    return path


def wrong(where: str, words: str, code: str = "contradiction") -> Note:
    """Return a note about a place in the file."""
    if isinstance(words, Note):
        return words.at(where)
    return Note(code, words if words.endswith((".", "?")) else f"{words}.", where)


def nearest(word: str, known: Iterable[str]) -> str:
    """Return the end of a sentence that names the nearest correct word, or all of them."""
    known = list(known)
    if near := _near(word, known):
        return f"did you mean '{near[0]}'?"
    return f"expected {' or '.join(known) if len(known) < 3 else ', '.join(known[:_LONGEST_LIST])}"


def _is_branch(part: str) -> bool:
    return part.startswith("<") and part.endswith(">")


def _problem(problem: Any, values: object, tables: Mapping[str, type[BaseModel]]) -> Note:
    where = place(problem["loc"], values)
    kind = problem["type"]
    if kind == "extra_forbidden":
        return wrong(where, f"unknown key; {_right_key(problem['loc'], tables)}", "unknown-key")
    shown, limit = as_written(problem["input"]), problem.get("ctx", {})
    words: dict[str, Callable[[], str]] = {
        "missing": lambda: f"is missing{_what_for(problem['loc'], tables)}",
        "too_short": lambda: _too_short(limit),
        "too_long": lambda: f"has {limit['actual_length']} entries; at most {limit['max_length']:,} can be given",
        "tuple_type": lambda: f"{shown} is not a list",
        "model_type": lambda: f"{shown} is not a table; write [{where}] and its keys below it",
        "dict_type": lambda: f"{shown} is not a table",
        "string_type": lambda: f"{shown} is not text; put text in quotes",
        "string_too_short": lambda: "is empty",
        "string_too_long": lambda: f"is longer than {limit['max_length']:,} characters",
        "string_pattern_mismatch": lambda: f"{shown} contains a line break or a control character",
        "int_type": lambda: f"{shown} is not a whole number",
        "float_type": lambda: f"{shown} is not a number",
        "finite_number": lambda: f"{shown} is not a finite number",
        "bool_type": lambda: f"{shown} is neither true nor false",
        "greater_than_equal": lambda: f"{shown} is too small; it must be {limit['ge']:,} or more",
        "greater_than": lambda: f"{shown} is too small; it must be above {limit['gt']:,}",
        "less_than_equal": lambda: f"{shown} is too large; it must be {limit['le']:,} or less",
        "less_than": lambda: f"{shown} is too large; it must be below {limit['lt']:,}",
        "literal_error": lambda: _right_word(problem["input"], limit),
        "union_tag_invalid": lambda: _right_word(problem["input"].get("shape"), limit, "shape = "),
        "union_tag_not_found": lambda: 'shape is not text; write shape = "ball"',
        "path_type": lambda: f"{shown} is not text; expected the name of a file",
    }
    if kind in words:
        return wrong(where, words[kind](), kind.replace("_", "-"))
    if kind == "relation":
        return wrong(where, limit["words"])
    code = getattr(limit.get("error"), "code", "") or "value"
    return wrong(where, problem["msg"].removeprefix("Value error, ").removeprefix(f"{VALUE} = "), code)


def _too_short(limit: dict[str, Any]) -> str:
    if limit["min_length"] == 1:
        return "is empty; give at least one value"
    entries = "entry" if limit["actual_length"] == 1 else "entries"
    return f"has {limit['actual_length']} {entries}; at least {limit['min_length']} are needed"


def _right_word(given: object, limit: dict[str, Any], before: str = "") -> str:
    choices = limit.get("expected") or limit["expected_tags"]
    known = [word.strip("<>") for word in choices.replace(" or ", ", ").replace("'", "").split(", ")]
    hint = nearest(given, known) if isinstance(given, str) else f"expected {', '.join(known)}"
    return f"{before}{as_written(given)} is not known; {hint}"


def _right_key(parts: tuple[Any, ...], tables: Mapping[str, type[BaseModel]]) -> str:
    """Return the key that an unknown key probably stands for."""
    known, wrong = keys(_table(parts[:-1], tables)), str(parts[-1])
    if near := _near(wrong, known):
        return f"did you mean '{near[0]}'?"
    homes = [name for name, table in tables.items() if name and not _is_branch(name) and wrong in keys(table)]
    if homes:
        return f"it belongs in {' or '.join(f'[{name}]' for name in homes)}"
    return f"known keys are {', '.join(known)}"


def _what_for(parts: tuple[Any, ...], tables: Mapping[str, type[BaseModel]]) -> str:
    """Return the description of a missing key."""
    fields = _table(parts[:-1], tables).model_fields
    about = [field.description for name, field in fields.items() if (field.alias or name) == parts[-1]]
    if not about or not about[0]:
        return ""
    return f" ({about[0][0].lower()}{about[0][1:].rstrip('.')})"


def _table(parts: tuple[Any, ...], tables: Mapping[str, type[BaseModel]]) -> type[BaseModel]:
    """Return the table at a path."""
    model = tables[""]
    for part in parts:
        model = tables.get(part, model) if isinstance(part, str) else model
    return model


def _near(word: str, known: Iterable[str]) -> list[str]:
    """Return the known word most similar to a given one, if any is."""
    return difflib.get_close_matches(word[:100].lower(), list(known), n=1, cutoff=0.5)


def keys(model: type[BaseModel]) -> list[str]:
    """Return the keys of a table as the user writes them."""
    return [field.alias or name for name, field in model.model_fields.items()]
