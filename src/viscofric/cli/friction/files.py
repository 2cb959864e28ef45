"""What the commands on friction share of files: names of those to be written, notes on those read."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

PICTURES, CSV, JSON = (".png", ".svg", ".pdf"), (".csv",), (".json",)


def check_ending(path: Path | None, option: str, endings: tuple[str, ...]) -> None:
    """Stop where the name of a file to be written does not say what goes into it."""
    if path is not None and path.suffix.lower() not in endings:
        raise click.BadParameter(f"{path}: must end in {', '.join(endings)}.", param_hint=option)


def tell_notes(notes: Iterable[str]) -> None:
    """Print notes on the data, where they do not mix with the result."""
    from viscofric.report.messages import readable

    for note in notes:
        click.echo(f"Note: {readable(note)}", err=True)
