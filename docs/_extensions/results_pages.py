"""The layout of results.nc as Markdown: groups, variables, dimensions and units of studies that are run for it."""

from __future__ import annotations

import re
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from page_parts import SOURCE, cell, digest, is_made_of, made_of, table, write

import viscofric
from viscofric.study.results.tree import GROUPS

if TYPE_CHECKING:
    import xarray

    from viscofric.study.results.results import StudyResults

#: Groups that are alike for every number in their name.
_NUMBERED = re.compile(r"^/(fields|materials)/\d+")


def example(folder: Path) -> StudyResults:
    """Run the built-in example at two speeds, so coarse that it takes seconds."""
    for file in (SOURCE / "example").iterdir():
        shutil.copy(file, folder)
    study = folder / "study.toml"
    text = re.sub(r"\bpoints = \d+", "points = 2", study.read_text(encoding="utf-8"), count=1)
    text = re.sub(r"(?m)^accuracy = .*$", "accuracy = 0.1\nmaster_curve_points = 3", text)
    study.write_text(text, encoding="utf-8")
    runs = folder / "mtm.csv"
    lines = runs.read_text(encoding="utf-8").splitlines(keepends=True)
    others = ("9.", "10.", "19.", "20.", "29.", "30.", "89.", "90.")  # °C: two temperatures of six are enough
    runs.write_text("".join(line for line in lines if not line.startswith(others)), encoding="utf-8")
    return viscofric.run_study(study)


def section(name: str, group: xarray.Dataset) -> str:
    """Return the section of one group."""
    rows = [
        [
            f"`{variable}`" + (" (coordinate)" if variable in group.coords else ""),
            ", ".join(f"`{dimension}`" for dimension in values.dims) or "one value",
            cell(values.attrs.get("units", "")),
            cell(values.attrs.get("long_name", "")),
        ]
        for variable, values in group.variables.items()
    ]
    shown = [f"## `{name}`", GROUPS[name]]
    if rows:
        shown.append(table(["variable", "dimensions", "unit", "meaning"], rows, numbers=False))
    if group.attrs:
        shown.append("Attributes: " + ", ".join(f"`{attribute}`" for attribute in group.attrs) + ".")
    return "\n\n".join(shown)


def page(results: StudyResults) -> str:
    """Return all groups, numbered ones once."""
    shown = {}
    for group in results.tree.subtree:
        name = _NUMBERED.sub(r"/\1/<n>", group.path)
        if group.ds.variables or group.ds.attrs:
            shown.setdefault(name, section(name, group.to_dataset(inherit=False)))
    shown["several"] = "## `/materials/<n>/…`\n\n" + GROUPS["/materials/<n>/…"]
    return "\n\n".join(shown.values())


def generate() -> None:
    """Write the page's tables if the code has changed."""
    state = digest("study", "example")
    if is_made_of("results", state):
        return
    with tempfile.TemporaryDirectory() as folder:
        write("results.md", page(example(Path(folder))))
    made_of("results", state)
