"""Markdown tables, and generated files, which are written only if they changed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1]
SOURCE = DOCS.parent / "src" / "viscofric"
#: Where tables and figures lie that pages include; ignored by git.
GENERATED = DOCS / "_generated"


def table(headings: Iterable[str], rows: Iterable[Iterable[str]], *, numbers: bool = True) -> str:
    """Return a table in Markdown; columns of numbers to the right, if there are any."""
    heads, lines = list(headings), [list(row) for row in rows]
    sides = ["---"]
    for column in range(1, len(heads)):
        counts = numbers and any(line[column] and line[column][0] in "−0123456789" for line in lines)
        sides.append("---:" if counts else "---")
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, sides, *lines])


def cell(text: str) -> str:
    """Return text for a table cell: on one line, with Markdown's markup escaped."""
    for mark in "\\|*_<>[]$":
        text = text.replace(mark, "\\" + mark)
    return " ".join(text.split())


def write(name: str, content: str | bytes) -> None:
    """Write a generated file if its content changed, so that only changed pages are rebuilt."""
    path = GENERATED / name
    path.parent.mkdir(parents=True, exist_ok=True)
    new = content.encode() if isinstance(content, str) else content
    if not path.exists() or path.read_bytes() != new:
        path.write_bytes(new)


def digest(*folders: str) -> str:
    """Return a name for the present state of folders and files of the package, and of these extensions."""
    found = hashlib.sha256()
    paths = [SOURCE / folder for folder in folders] + [DOCS / "_extensions"]
    for path in paths:
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file() and "__pycache__" not in file.parts:
                found.update(file.relative_to(DOCS.parent).as_posix().encode() + b"\0" + file.read_bytes())
    return found.hexdigest()


def is_made_of(name: str, state: str) -> bool:
    """Return whether the named output was made in this state; see `made_of`."""
    stamp = GENERATED / f"{name}.state"
    return stamp.exists() and stamp.read_text(encoding="utf-8") == state


def made_of(name: str, state: str) -> None:
    """Note the state in which something was made, after it was."""
    write(f"{name}.state", state)
