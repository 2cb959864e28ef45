"""``viscofric material``: from DMA files to a rubber, and from a rubber to the files of other programs."""

from __future__ import annotations

import click

from viscofric.cli.lazy import LazyGroup

# command, which is also the module of this package that defines it -> what the overview says
_COMMANDS = {
    "read": "Say what DMA files hold, and what is doubtful about them.",
    "fit": "Make a rubber of DMA files: shift factors, master curve, spectrum, figures.",
    "show": "Print the modulus of a rubber at a temperature.",
    "convert": "Write a rubber as a material card of another program.",
    "list": "List the rubbers of the catalogue.",
}


@click.group(name="material", cls=LazyGroup, package=__name__, summaries=_COMMANDS, invoke_without_command=True)
@click.pass_context
def command(ctx: click.Context) -> None:
    """Make a rubber of DMA sweeps, look at one, write it for other programs."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
