"""What ``viscofric --help`` shows, on one screen of 80 columns and 24 lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import click

#: Heading -> command, which is also the module that defines it -> what it is for.
GROUPS = {
    "Studies": {
        "demo": "Run the built-in example (synthetic data), start to end.",
        "new": "Write a run file to start from, with data to replace.",
        "check": "Check a run file and its data, or stored results.",
        "run": "Run a study: friction, figures and a report out of data.",
        "report": "Write figures and report of a finished study again.",
        "export": "Write results as CSV, Excel workbook, netCDF or zarr.",
        "compare": "Say where two results differ, and how they came about.",
    },
    "Rubber": {
        "material": "Make a rubber of DMA sweeps, show it, convert it, list.",
        "identify": "Find the rubber behind friction, as far as it tells it.",
    },
    "Contact": {
        "solve": "Solve one contact: friction, pressure, a picture.",
        "curve": "Predict friction against speed at some temperatures.",
    },
    "Friction": {
        "measure": "Separate viscoelastic friction in tribometer files.",
        "master": "Shift friction curves onto one; shift factors of friction.",
    },
    "Page": {
        "web": "Open the page in the browser: all this without a line.",
    },
    "Program": {
        "verify": "Check the contact engine on this machine, in a minute.",
        "completion": "Print what lets a shell complete commands and options.",
    },
}
#: All commands in their order.
COMMANDS = {name: words for group in GROUPS.values() for name, words in group.items()}

_ABOUT = "Viscoelastic friction of rubber, at any speed and temperature, from lab data."
_AFTERWARDS = (
    "viscofric COMMAND --help tells of a command, viscofric --version the version.",
    "Exit status: 0 well, 1 bad input or not solved, 2 called wrongly, 3 some cases",
    "failed, 130 interrupted, 143 terminated.",
)


def write_overview(formatter: click.HelpFormatter) -> None:
    """Write all commands under their headings, and what their exit statuses mean."""
    formatter.write("Usage: viscofric COMMAND [OPTIONS] [ARGUMENTS]\n")
    formatter.write(f"{_ABOUT}\n\n")
    for heading, commands in GROUPS.items():
        for row, (name, words) in enumerate(commands.items()):
            formatter.write(f"{heading if row == 0 else '':<9} {name:<11} {words}\n")
    formatter.write("\n" + "".join(f"{line}\n" for line in _AFTERWARDS))
