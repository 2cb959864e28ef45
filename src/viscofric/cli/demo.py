"""``viscofric demo``: the built-in study of a synthetic fluoroelastomer."""

from __future__ import annotations

from importlib.resources import as_file, files
from pathlib import Path

import click


@click.command(name="demo")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("viscofric-demo"),
    show_default=True,
    help="Folder for the results.",
)
def command(output: Path) -> None:
    """Run the built-in example: DMA and friction data of a SYNTHETIC fluoroelastomer.

    The data are calculated from stated parameters, with noise; nothing was measured.
    """
    from viscofric.cli.run import run_and_report

    click.echo("Built-in example: a SYNTHETIC fluoroelastomer; nothing in it was measured.", err=True)
    with as_file(files("viscofric") / "example") as folder:
        run_and_report(folder / "study.toml", output, resume=True)
