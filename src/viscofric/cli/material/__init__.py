"""``viscofric material``: fit a material to DMA files, and write it for other programs."""

from __future__ import annotations

import click

from viscofric.cli.overview import LazyGroup

# command, which is also the module of this package that defines it -> what the overview says
_COMMANDS = {
    "read": "Print format, isotherms and doubtful data of DMA files.",
    "fit": "Fit a material to DMA files: shift factors, master curve, spectrum, figures.",
    "ramp": "Read temperature ramps: glass transition, and a material by superposition.",
    "amplitude": "Read an amplitude sweep: linear range, Kraus's law, a material at a strain.",
    "indentation": "Identify a material from indentation tests and rebounds.",
    "show": "Print the modulus of a material at a temperature.",
    "convert": "Write a material card of another program.",
    "list": "List the materials of the catalogue.",
}


@click.group(name="material", cls=LazyGroup, package=__name__, summaries=_COMMANDS, invoke_without_command=True)
@click.pass_context
def command(ctx: click.Context) -> None:
    """Fit a material to DMA sweeps, show it, or convert it to material cards."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
