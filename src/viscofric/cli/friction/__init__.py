"""``viscofric friction``: from tribometer files to friction curves, master curves, and back to the rubber."""

from __future__ import annotations

import click

from viscofric.cli.lazy import LazyGroup

# command, which is also the module of this package that defines it -> what the overview says
_COMMANDS = {
    "separate": "Separate viscoelastic from Coulomb friction in tribometer files.",
    "shift": "Shift friction curves onto one, and find α(T) from friction alone.",
    "identify": "Find the rubber behind friction, as far as friction tells it.",
}


@click.group(name="friction", cls=LazyGroup, package=__name__, summaries=_COMMANDS, invoke_without_command=True)
@click.pass_context
def command(ctx: click.Context) -> None:
    """Separate friction that was measured, shift it onto one curve, and find the rubber behind it."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
