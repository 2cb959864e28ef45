"""Small text files for readers."""

from __future__ import annotations

from pathlib import Path


def write(folder: Path, *lines: str, name: str = "table.csv", encoding: str = "utf-8") -> Path:
    """Write lines as a file, with LF between them; return its path."""
    path = folder / name
    path.write_bytes("\n".join(lines).encode(encoding))
    return path
