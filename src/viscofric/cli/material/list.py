"""``viscofric material list``: the rubbers of the catalogue."""

from __future__ import annotations

import click

from viscofric.cli.errors import reported_errors


@click.command(name="list")
def command() -> None:
    """List the materials of the catalogue, with their sources."""
    from viscofric.rheology.catalogue import catalogue

    with reported_errors():
        for entry in catalogue():
            click.echo(f"{entry.name}  [{entry.kind}]")
            for line in (entry.holds, entry.citation, entry.remarks):
                if line:
                    click.echo(f"    {line}")
