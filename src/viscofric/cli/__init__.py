"""The command line: ``viscofric COMMAND``, one file per command, loaded when it is called."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import FrameType

INTERRUPTED, TERMINATED = 130, 143

try:
    import os
    import signal
    import threading
    from contextlib import contextmanager
    from typing import Any, Never

    import click

    from viscofric.cli.overview import COMMANDS, TYPED, LazyGroup, write_overview
except KeyboardInterrupt:  # the user may change their mind while Python still loads
    sys.stderr.write("Interrupted.\n")
    sys.exit(INTERRUPTED)


class Terminated(KeyboardInterrupt):
    """The system asked the program to end (SIGTERM); it ends as it does at Ctrl-C, with another status."""

    #: Whether it has, also where a solver took the interruption and returned what it had.
    received = False


class _Program(LazyGroup):
    """The whole program: what its commands leave behind becomes an exit status."""

    def format_help(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the overview, which fits a screen."""
        write_overview(formatter)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Keep the words as they were typed, for `typed_command`."""
        ctx.meta[TYPED] = tuple(args)
        return super().parse_args(ctx, args)

    def main(self, *args: Any, standalone_mode: bool = True, **extra: Any) -> Any:
        """Run the command line; an interruption at any moment is one sentence and its own exit status."""
        run: Any = super().main
        if not standalone_mode:
            return run(*args, standalone_mode=False, **extra)
        try:
            with _signals():
                status = run(*args, standalone_mode=False, **extra)
                sys.stdout.flush()
        except click.ClickException as error:
            error.show()
            sys.exit(error.exit_code)
        except (click.Abort, KeyboardInterrupt) as stop:
            # click turns an interruption into Abort, raised from it
            terminated = isinstance(stop, Terminated) or isinstance(stop.__cause__, Terminated)
            click.echo("Terminated." if terminated else "Interrupted.", err=True)
            sys.exit(TERMINATED if terminated else INTERRUPTED)
        except BrokenPipeError:  # `viscofric … | head` has read enough
            _give_up_output()
            sys.exit(1)
        except OSError as error:
            _give_up_output()
            click.echo(f"Error: {error.filename or 'the output'}: {error.strerror or error}.", err=True)
            sys.exit(1)
        sys.exit(status if isinstance(status, int) else 0)


def _give_up_output() -> None:
    """Let Python throw away what it still holds for a standard output that may be a full disk."""
    output = sys.__stdout__
    if output is not None and output is sys.stdout:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, output.fileno())
        os.close(nowhere)


@contextmanager
def _signals() -> Iterator[None]:
    """Let SIGTERM end the program as Ctrl-C does, for as long as the command line runs."""

    def terminate(number: int, frame: FrameType | None) -> Never:
        Terminated.received = True
        raise Terminated

    Terminated.received = False
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


@click.group(
    cls=_Program,
    package=__name__,
    summaries=COMMANDS,
    context_settings={"help_option_names": ["-h", "--help"], "show_default": True},
    invoke_without_command=True,
)
@click.version_option(package_name="viscofric", prog_name="viscofric")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Hysteresis friction (rolling resistance) of rubber, from laboratory data."""
    _keep_matplotlib_here()
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help())
