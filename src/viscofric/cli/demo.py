"""``viscofric demo``: the built-in study of a synthetic fluoroelastomer."""

from __future__ import annotations

from importlib.resources import as_file, files
from pathlib import Path

import click

from viscofric.cli.commands import as_command
from viscofric.cli.files import FOLDER
from viscofric.cli.output import RUN_JSON, outputs


@as_command("demo")
@outputs("Folder for the results.", FOLDER, default=Path("viscofric-demo"), json=RUN_JSON)
def command(out: Path, as_json: bool) -> None:
    """Run the built-in example: DMA and friction data of a SYNTHETIC fluoroelastomer.

    The data are calculated from stated parameters, with noise; nothing was measured.
    """
    from viscofric.cli.run import run_and_report

    click.echo("Built-in example: a SYNTHETIC fluoroelastomer; nothing in it was measured.", err=True)
    with as_file(files("viscofric") / "example") as folder:
        run_and_report(folder / "study.toml", out, resume=True, as_json=as_json)
