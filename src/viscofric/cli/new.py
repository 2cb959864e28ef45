"""``viscofric new FOLDER``: a study to start from, and the JSON schema of run files for editors."""

from __future__ import annotations

import json
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

import click

from viscofric.cli.commands import as_command
from viscofric.cli.files import FOLDER, refusal
from viscofric.cli.output import outputs, print_json

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

SCHEMA = "study.schema.json"
#: What a run file starts with for an editor to find the schema beside it.
SCHEMA_LINE = f"#:schema ./{SCHEMA}\n"
#: Starter files, by their names, and what they show.
TEMPLATES = {
    "example": "all keys of a run file, with measured friction to compare",
    "paper": "speeds, temperatures and load of the paper whose method this is",
    "ball": "a ball against speed and temperature",
    "measured": "measured friction compared with the prediction",
    "cylinder": "a roller (load per unit length)",
    "layer": "rubber of finite thickness",
    "surface": "a rough surface, several seeds",
    "sweep": "several materials, radii and loads",
    "uncertainty": "uncertainty of the predicted friction",
}

_WITH_DATA = {"example": "example", "paper": "templates/paper"}

_EPILOG = "\b\nTemplates:\n" + "\n".join(f"  {name:12} {words}" for name, words in TEMPLATES.items())


@as_command("new", epilog=_EPILOG)
@click.argument("folder", required=False, metavar="[FOLDER|-]", type=click.Path(path_type=Path, allow_dash=True))
@click.option(
    "--template", metavar="NAME", type=click.Choice(list(TEMPLATES)), default="example", help="Template; see below."
)
@click.option(
    "--schema",
    is_flag=True,
    help=f"Also write {SCHEMA}, with which editors complete and check the run file; without FOLDER, print it.",
)
@outputs("Folder to write into, instead of FOLDER.", FOLDER, json="Print the written files as JSON.")
def command(folder: Path | None, template: str, schema: bool, out: Path | None, as_json: bool) -> None:
    """Write an example study to FOLDER: a commented run file and SYNTHETIC data to replace by your own.

    With - instead of FOLDER, only the run file is printed.
    """
    if folder is not None and out is not None:
        raise click.UsageError("FOLDER and --out name the same folder; give one of them.")
    folder = folder or out
    if folder is None:
        if not schema:
            raise click.UsageError("give the FOLDER to write the study into, or - to print its run file.")
        click.echo(_schema(), nl=False)
        return
    run_file = template_text(template)
    if schema:
        run_file = SCHEMA_LINE + run_file
    if str(folder) == "-":
        if as_json:
            raise click.UsageError("- prints the run file; give it without --json.")
        click.echo(run_file, nl=False)
        return
    contents = {"study.toml": run_file.encode()}
    contents |= {source.name: source.read_bytes() for source in _data(template) if f'"{source.name}"' in run_file}
    if schema:
        contents[SCHEMA] = _schema().encode()
    _write(folder, contents)
    if as_json:
        print_json({"run_file": folder / "study.toml", "files": [folder / name for name in contents]})
    else:
        click.echo(f"run file {folder / 'study.toml'}")


def template_text(name: str) -> str:
    """Return a starter file."""
    home = _home(name)
    return (home / ("study.toml" if name in _WITH_DATA else f"{name}.toml")).read_text(encoding="utf-8")


def _home(name: str) -> Traversable:
    """Return the folder of a starter file."""
    return files("viscofric") / _WITH_DATA.get(name, "templates")


def _data(name: str) -> list[Traversable]:
    """Return the data files for a starter file; those of the example unless it has its own."""
    folder = _home(name if name in _WITH_DATA else "example")
    return [source for source in folder.iterdir() if source.name.endswith(".csv")]


def _schema() -> str:
    from viscofric.study.run_file.json_schema import json_schema

    return json.dumps(json_schema(), indent=1, ensure_ascii=False) + "\n"


def _write(folder: Path, contents: dict[str, bytes]) -> None:
    taken = [name for name in contents if (folder / name).exists()]
    if taken:
        raise refusal("not-empty", f"{folder} already holds {', '.join(sorted(taken))}; choose another folder.")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in contents.items():
            (folder / name).write_bytes(content)
    except OSError as error:
        raise refusal("not-written", f"{folder}: cannot be written ({error.strerror or error}).") from error
