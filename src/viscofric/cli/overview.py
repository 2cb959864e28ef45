"""The overview of ``viscofric --help``, and groups that import a command when it is called."""

from __future__ import annotations

import difflib
import importlib
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem


#: Heading -> command, which is also the name of its module -> purpose.
GROUPS = {
    "Studies": {
        "demo": "Run the built-in example (synthetic data), start to end.",
        "new": "Write an example run file, with synthetic data.",
        "check": "Validate a run file and its data, or stored results.",
        "run": "Run a study: friction, figures and a report from data.",
        "report": "Write figures and report of a finished study again.",
        "export": "Export results as CSV, Excel workbook or netCDF.",
        "compare": "Compare two results, case by case.",
    },
    "Material": {
        "material": "Fit a material to DMA sweeps; show, convert or list.",
        "identify": "Infer the modulus from friction data.",
    },
    "Contact": {
        "solve": "Solve one contact: friction, pressure, picture.",
        "curve": "Predict friction against speed and temperature.",
        "transient": "Solve one contact over time: dwell, start, return.",
        "impact": "Solve an impact: restitution, contact time, force.",
    },
    "Friction": {
        "measure": "Separate Coulomb and viscoelastic friction (MTM).",
        "master": "Friction master curve, and shift factors from friction.",
    },
    "Page": {"web": "Open the local page in the browser (no coding needed)."},
    "Program": {
        "verify": "Verify the contact engine on this machine, in a minute.",
        "completion": "Print the completion script for a shell.",
    },
}
COMMANDS = {name: words for group in GROUPS.values() for name, words in group.items()}

_ABOUT = "Hysteresis friction (rolling resistance) of rubber, from laboratory data."
_STATUSES = (
    "0 success, 1 bad input or not solved, 2 wrong usage, 3 cases failed,",
    "4 accuracy missed or check failed, 130 interrupted, 143 terminated.",
)


#: Where the words of a command are kept; see `viscofric.cli.output.typed_command`.
TYPED = "viscofric.words"


def write_overview(formatter: click.HelpFormatter) -> None:
    """Write all commands under their headings, and the meaning of the exit statuses."""
    formatter.write("Usage: viscofric [--version] COMMAND [--help] [OPTIONS] [ARGUMENTS]\n")
    formatter.write(f"{_ABOUT}\n\n")
    for heading, commands in GROUPS.items():
        for row, (name, words) in enumerate(commands.items()):
            formatter.write(f"{heading if row == 0 else '':<9} {name:<11} {words}\n")
    for row, line in enumerate(_STATUSES):
        formatter.write(f"{'Status' if row == 0 else '':<9} {line}\n")


class LazyGroup(click.Group):
    """A group of commands, each in a module of its own with the attribute ``command``."""

    def __init__(self, *args: Any, package: str, summaries: dict[str, str], **extra: Any) -> None:
        super().__init__(*args, **extra)
        self.package, self.summaries = package, summaries

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the commands in the order of the overview."""
        return list(self.summaries)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a command."""
        if cmd_name not in self.summaries:
            return None
        command: click.Command = importlib.import_module(f"{self.package}.{cmd_name}").command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the overview without importing any command."""
        with formatter.section("Commands"):
            formatter.write_dl(list(self.summaries.items()))

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Return commands and options that begin as typed, without importing any command."""
        from click.shell_completion import CompletionItem

        items = [
            CompletionItem(name, help=words) for name, words in self.summaries.items() if name.startswith(incomplete)
        ]
        return items + click.Command.shell_complete(self, ctx, incomplete)

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        """Find the command, or name the nearest one."""
        if args and args[0] not in self.summaries and not args[0].startswith("-"):
            near = difflib.get_close_matches(args[0], self.summaries, n=1)
            hint = f" Did you mean '{near[0]}'?" if near else ""
            raise click.UsageError(f"No such command '{args[0]}'.{hint}", ctx)
        return super().resolve_command(ctx, args)
