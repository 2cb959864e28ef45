"""The reference is complete, pages are in the contents, and what is generated for them says what the code says."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, TypeAlias

import click

import viscofric as vf
from viscofric.cli import main
from viscofric.lazy import full_names
from viscofric.study.run_file import study as run_file

if TYPE_CHECKING:
    import pytest

Extension: TypeAlias = Callable[[str], ModuleType]
ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
MADE = {"_build", "_generated", "auto_examples"}


def pages() -> list[Path]:
    found = [path.relative_to(DOCS) for path in DOCS.rglob("*.md")]
    return sorted(path for path in found if not MADE & set(path.parts) and "api" not in path.parts[:-1])


def test_every_public_name_is_in_the_reference_once() -> None:
    page = (DOCS / "reference" / "api.md").read_text(encoding="utf-8")
    listed = [f"viscofric.{name}" for name in re.findall(r"^   ([\w.]+)$", page, re.MULTILINE)]
    assert len(listed) == len(set(listed))
    assert set(listed) == set(full_names().values())


def test_every_function_of_figures_has_an_example_that_is_run() -> None:
    scripts = [*(DOCS / name for name in pages()), *(ROOT / "examples").glob("*.py")]
    shown = "\n".join(path.read_text(encoding="utf-8") for path in scripts)
    assert {name for name in vf.report.__all__ if not re.search(rf"\b{name}\(", shown)} == set()


def test_modules_that_pages_name_exist() -> None:
    source = ROOT / "src" / "viscofric"
    rooms = {path.name for path in source.iterdir() if path.is_dir()}
    for page in (*(DOCS / name for name in pages()), ROOT / "ARCHITECTURE.md", ROOT / "CONTRIBUTING.md"):
        for name in re.findall(r"`([a-z_]+(?:/[a-z_]+)+)(?:\.py)?`", page.read_text(encoding="utf-8")):
            if name.split("/")[0] in rooms:
                assert (source / name).is_dir() or (source / f"{name}.py").is_file(), f"{page.name}: {name}"


def test_every_page_is_in_the_contents() -> None:
    named: set[Path] = set()
    for page in pages():
        text = (DOCS / page).read_text(encoding="utf-8")
        for block in re.findall(r"```\{toctree\}\n(.*?)```", text, re.DOTALL):
            lines = [line for line in block.splitlines() if line and not line.startswith(":")]
            targets = [re.sub(r".*<(.*)>$", r"\1", line) for line in lines]
            for target in targets:
                if target.startswith("auto_examples"):
                    continue  # made of the scripts in examples
                named |= {path.relative_to(DOCS) for path in (DOCS / page).parent.glob(f"{target}.md")}
    assert set(pages()) - named == {Path("index.md")}


def test_links_between_pages_lead_somewhere() -> None:
    """Sphinx sees to links within the site; these are read in a checkout, too."""
    texts = [*(DOCS / page for page in pages()), *ROOT.glob("*.md"), *ROOT.glob("benchmarks/**/*.md")]
    dead = [
        f"{path.relative_to(ROOT)}: {link}"
        for path in texts
        for link in re.findall(r"\]\(([^)\s#]+)[^)]*\)", path.read_text(encoding="utf-8"))
        if not link.startswith(("http://", "https://", "_generated")) and not (path.parent / link).exists()
    ]
    assert not dead


def test_rows_of_tables_end_in_their_line() -> None:
    """A row that goes on in the next line is two rows on the page."""
    broken = []
    for page in pages():
        lines = (DOCS / page).read_text("utf-8").splitlines()
        rows = [n for n in range(1, len(lines)) if lines[n].startswith("|") and lines[n - 1].startswith("|")]
        broken += [f"{page}, line {n + 1}" for n in rows if not lines[n].rstrip().endswith("|")]
    assert broken == []


def test_every_command_is_in_the_reference_with_all_its_options(extension: Extension) -> None:
    page = extension("command_pages").page()

    def walk(command: click.Command, context: click.Context, name: str) -> Iterator[tuple[str, click.Command]]:
        if isinstance(command, click.Group):
            for each in command.list_commands(context):
                below = command.get_command(context, each)
                assert below is not None
                yield f"{name} {each}", below
                yield from walk(below, click.Context(below, parent=context, info_name=each), f"{name} {each}")

    found = list(walk(main, click.Context(main, info_name="viscofric"), "viscofric"))
    assert len(found) > 15
    parts = dict(re.findall(r"(?ms)^### (viscofric [^\n]+)\n(.*?)(?=^#|^\(|\Z)", page))
    assert set(parts) == {name for name, _ in found}
    for name, command in found:
        for option in command.params:
            if isinstance(option, click.Option) and not option.hidden:
                assert all(f"`{one}" in parts[name] for one in option.opts), f"{name} {option.opts}"


def test_every_key_of_a_run_file_is_in_the_reference(extension: Extension) -> None:
    page = extension("run_file_pages").page()
    tables = dict(re.findall(r"(?ms)^## \[(\w+)\]\n(.*?)(?=^## |\Z)", page))
    models = {
        "material": run_file.MaterialTable,
        "surface": run_file.SurfaceTable,
        "layer": run_file.LayerTable,
        "conditions": run_file.ConditionsTable,
        "sweep": run_file.SweepTable,
        "history": run_file.HistoryTable,
        "impact": run_file.ImpactTable,
        "measurement": run_file.MeasurementTable,
        "interface": run_file.InterfaceTable,
        "heating": run_file.HeatingTable,
        "solver": run_file.SolverTable,
        "uncertainty": run_file.UncertaintyTable,
        "outputs": run_file.OutputsTable,
        "cluster": run_file.ClusterTable,
    }
    assert set(tables) == {*models, "indenter"}
    for name, model in models.items():
        for key, field in model.model_fields.items():
            row = next(line for line in tables[name].splitlines() if line.startswith(f"| `{field.alias or key}` |"))
            assert field.description is not None
            # what Markdown would take for markup is escaped
            assert field.description in re.sub(r"\\(.)", r"\1", row)
    for key in {key for shape in run_file.SHAPES.values() for key in shape.model_fields}:
        assert f"| `{key}` |" in tables["indenter"]
    assert "| `accuracy` | number from 1e-10 to 0.1 | `0.001` |" in tables["solver"]
    assert '| `load` | quantity, such as `"25 N"`, `"2 N/mm"`, a list or a range |' in tables["conditions"]


def test_columns_of_friction_curves_are_in_the_reference(extension: Extension, tmp_path: Path) -> None:
    curves = vf.FrictionCurves([0.1], [300.0], [25.0], [0.01], [0.001], [0.002], [4], source="SYNTHETIC")
    vf.write_friction_curves(curves, tmp_path / "curves.csv")
    lines = (tmp_path / "curves.csv").read_text(encoding="utf-8").splitlines()
    (headings,) = [line for line in lines if line.startswith("speed")]
    page = extension("curve_file_pages").page()
    assert all(f"| `{heading}` |" in page for heading in headings.split(","))


def test_layout_of_results_shows_units_dimensions_and_meaning(extension: Extension) -> None:
    import xarray

    group = xarray.Dataset(
        {"load": (("case",), [1.0, 2.0], {"units": "N", "long_name": "normal load"})},
        {"speed": ((), 3.0, {"units": "m/s", "long_name": "speed"})},
        {"accuracy": 1e-3},
    )
    reported = extension("results_pages").section("/prediction", group)
    assert "| `load` | `case` | N | normal load |" in reported
    assert "| `speed` (coordinate) | one value | m/s | speed |" in reported
    assert "Attributes: `accuracy`." in reported


def test_only_what_has_changed_is_written(
    extension: Extension, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts = extension("page_parts")
    monkeypatch.setattr(parts, "GENERATED", tmp_path)
    parts.write("a/page.md", "one")
    before = (tmp_path / "a" / "page.md").stat().st_mtime_ns
    parts.write("a/page.md", "one")
    assert (tmp_path / "a" / "page.md").stat().st_mtime_ns == before
    parts.write("a/page.md", "two")
    assert (tmp_path / "a" / "page.md").read_text(encoding="utf-8") == "two"
    assert not parts.is_made_of("a", "state")
    parts.made_of("a", "state")
    assert parts.is_made_of("a", "state")
    assert parts.digest("units.py") != parts.digest("errors.py")


def test_cells_of_tables_are_safe(extension: Extension) -> None:
    parts = extension("page_parts")
    assert parts.cell("|E*|\n  <b> [x]") == r"\|E\*\| \<b\> \[x\]"
    assert parts.table(["a", "b"], [["x", "1"], ["y", "−2"]]).splitlines()[1] == "| --- | ---: |"


def test_requests_to_other_hosts_are_found(extension: Extension, tmp_path: Path) -> None:
    fetched = [
        '<script src="https://a.org/x.js"></script>',
        '<link href="//a.org/x.css" rel="stylesheet">',
        '<img alt="" src="http://a.org/x.png">',
        '<p style="background: url(https://a.org/x.png)">',
        "<style>@font-face { src: url('https://a.org/x.woff2') }</style>",
    ]
    followed = '<a href="https://a.org">a</a><link rel="canonical" href="https://a.org"><script src="x.js"></script>'
    offline = extension("offline")
    for page in fetched:
        assert len(offline.requests_of_page(page)) == 1, page
    assert not offline.requests_of_page(followed)
    (tmp_path / "page.html").write_text(followed, encoding="utf-8")
    (tmp_path / "style.css").write_text('/* https://a.org */ @import "https://a.org/x.css";', encoding="utf-8")
    assert list(offline.requests_of_site(tmp_path)) == ["style.css: https://a.org/x.css"]


def test_a_search_finds_pages_that_have_all_its_words(extension: Extension) -> None:
    tables = {"terms": {"roll": [0, 1], "resist": 1}, "titleterms": {"payn": [2], "resist": 2}}
    index = {"docnames": ["a", "b", "c"], **tables}
    results = extension("search_words").results
    assert results(index, "Rolling resistance") == {"b"}
    assert results(index, "Payne") == {"c"}
    assert results(index, "resistances") == {"b", "c"}
    assert results(index, "rolling hysteresis") == set()


def test_run_shows_the_site() -> None:
    reported = subprocess.run([sys.executable, str(ROOT / "run"), "--help"], capture_output=True, text=True, check=True)
    assert "./run docs" in reported.stdout
