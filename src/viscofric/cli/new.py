"""``viscofric new FOLDER``: a run file to start from, with the synthetic example's data beside it."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import click


@click.command(name="new")
@click.argument("folder", type=click.Path(path_type=Path, file_okay=False))
def command(folder: Path) -> None:
    """Write a study to start from into FOLDER: a commented run file and SYNTHETIC data to replace by your own."""
    sources = [source for source in (files("viscofric") / "example").iterdir() if source.is_file()]
    taken = [source.name for source in sources if (folder / source.name).exists()]
    if taken:
        raise click.ClickException(f"{folder} already holds {', '.join(sorted(taken))}; choose another folder.")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for source in sources:
            (folder / source.name).write_bytes(source.read_bytes())
    except OSError as error:
        raise click.ClickException(f"{folder}: cannot be written ({error.strerror or error}).") from error
    click.echo(f"run file {folder / 'study.toml'}")
