"""The folders of the study depend on each other in one direction only."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import viscofric.study

ROOT = Path(viscofric.study.__file__).parent
#: Folder -> those that its modules may import from, besides their own.
ALLOWED = {
    "cases": set(),
    "run_file": {"cases"},
    "results": {"cases", "run_file"},
    "running": {"cases", "run_file", "results"},
}


@pytest.mark.parametrize("folder", ALLOWED)
def test_folders_import_in_one_direction(folder: str) -> None:
    for path in (ROOT / folder).glob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = [node.module.split(".") for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
        found = {parts[2] for parts in names if parts[:2] == ["viscofric", "study"] and len(parts) > 3}
        assert found <= ALLOWED[folder] | {folder}, path.name
