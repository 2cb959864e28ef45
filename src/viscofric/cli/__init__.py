"""The command line: ``viscofric COMMAND``, one file per command, loaded when it is called."""

from __future__ import annotations

import sys

INTERRUPTED, TERMINATED = 130, 143

try:
    import importlib
    import os
    import signal
    import threading
    from contextlib import contextmanager
    from typing import TYPE_CHECKING, Any, Never

    import click
except KeyboardInterrupt:  # the user may change their mind while Python still loads
    sys.stderr.write("Interrupted.\n")
    sys.exit(INTERRUPTED)

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

# command -> module of this package that defines it, and what the overview says
_COMMANDS = {
    "demo": "Run the built-in example (synthetic data) from start to end.",
    "run": "Run a study: DMA sweeps in, friction, figures and a report out.",
    "new": "Write a run file to start from, with synthetic data to replace.",
    "report": "Write figures and report of a finished study again.",
}


class Terminated(KeyboardInterrupt):
    """The system asked the program to end (SIGTERM); it ends as it does at Ctrl-C, with another status."""


class _LazyGroup(click.Group):
    """Commands whose modules are imported only when they are called, so that --help answers at once."""

    def main(self, *args: Any, standalone_mode: bool = True, **extra: Any) -> Any:
        """Run the command line; an interruption at any moment is one sentence and its own exit status."""
        run: Any = super().main
        if not standalone_mode:
            return run(*args, standalone_mode=False, **extra)
        try:
            with _signals():
                status = run(*args, standalone_mode=False, **extra)
        except click.ClickException as error:
            error.show()
            sys.exit(error.exit_code)
        except (click.Abort, KeyboardInterrupt) as stop:
            # click turns an interruption into Abort, raised from it
            terminated = isinstance(stop, Terminated) or isinstance(stop.__cause__, Terminated)
            click.echo("Terminated." if terminated else "Interrupted.", err=True)
            sys.exit(TERMINATED if terminated else INTERRUPTED)
        sys.exit(status if isinstance(status, int) else 0)

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


@contextmanager
def _signals() -> Iterator[None]:
    """Let SIGTERM end the program as Ctrl-C does, for as long as the command line runs."""

    def terminate(number: int, frame: FrameType | None) -> Never:
        raise Terminated

    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _keep_matplotlib_here() -> None:
    """Give matplotlib a folder in the virtual environment for its caches, so that nothing outside is touched."""
    if sys.prefix != sys.base_prefix and os.access(sys.prefix, os.W_OK):
        os.environ.setdefault("MPLCONFIGDIR", os.path.join(sys.prefix, "var", "matplotlib"))  # noqa: PTH118


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]}, invoke_without_command=True)
@click.version_option(package_name="viscofric", prog_name="viscofric")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Viscoelastic friction of rubber, at any speed and temperature, from laboratory data.

    Exit status: 0 all went well; 1 something is wrong with the input or could not be solved (one sentence says
    what); 2 the command was called wrongly; 3 the study ran, but some of its cases failed; 130 interrupted;
    143 terminated.
    """
    _keep_matplotlib_here()
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
