"""``viscofric material list``: the rubbers of the catalogue."""

from __future__ import annotations

import click

from viscofric.cli.commands import as_command
from viscofric.cli.output import outputs, print_json


@as_command("list")
@outputs(json="Print the materials as JSON.")
def command(as_json: bool) -> None:
    """List the materials of the catalogue, with their sources."""
    from viscofric.rheology.catalogue import catalogue

    if as_json:
        names = ("name", "kind", "holds", "citation", "remarks")
        print_json({"materials": [{name: getattr(entry, name) for name in names} for entry in catalogue()]})
        return
    for entry in catalogue():
        click.echo(f"{entry.name}  [{entry.kind}]")
        for line in (entry.holds, entry.citation, entry.remarks):
            if line:
                click.echo(f"    {line}")
