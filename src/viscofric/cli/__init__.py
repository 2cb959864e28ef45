"""The command line: ``viscofric COMMAND``, one file per command, loaded when it is called."""

from __future__ import annotations

import importlib
from typing import Any

import click

# command -> module of this package that defines it, and what the overview says
_COMMANDS = {
    "demo": "Run the built-in example (synthetic data) from start to end.",
    "run": "Run a study: DMA sweeps in, friction, figures and a report out.",
    "new": "Write a run file to start from, with synthetic data to replace.",
    "report": "Write figures and report of a finished study again.",
}


class _LazyGroup(click.Group):
    """Commands whose modules are imported only when they are called, so that --help answers at once."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _COMMANDS:
            return None
        command: click.Command = importlib.import_module(f"viscofric.cli.{cmd_name}").command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(_COMMANDS.items()))

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        if args and args[0] not in _COMMANDS and not args[0].startswith("-"):
            import difflib

            near = difflib.get_close_matches(args[0], _COMMANDS, n=1)
            hint = f" Did you mean '{near[0]}'?" if near else ""
            raise click.UsageError(f"No such command '{args[0]}'.{hint}", ctx)
        return super().resolve_command(ctx, args)


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="viscofric", prog_name="viscofric")
def main() -> None:
    """Viscoelastic friction of rubber, at any speed and temperature, from laboratory data.

    Exit status: 0 all went well; 1 something is wrong with the input or could not be solved (one sentence says
    what); 2 the command was called wrongly; 3 the study ran, but some of its cases failed; 130 interrupted.
    """
