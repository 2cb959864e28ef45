"""The overview of ``viscofric --help``, on one screen of 80 columns and 24 lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import click

#: Heading -> command, which is also the name of its module -> purpose.
GROUPS = {
    "Studies": {
        "demo": "Run the built-in example (synthetic data), start to end.",
        "new": "Write an example run file, with synthetic data.",
        "check": "Validate a run file and its data, or stored results.",
        "run": "Run a study: friction, figures and a report from data.",
        "report": "Write figures and report of a finished study again.",
        "export": "Export results as CSV, Excel workbook, netCDF or zarr.",
        "compare": "Compare two results, case by case.",
    },
    "Material": {
        "material": "Fit a material to DMA sweeps; show, convert or list.",
        "identify": "Infer the modulus from friction data.",
    },
    "Contact": {
        "solve": "Solve one contact: friction, pressure, picture.",
        "curve": "Predict friction against speed and temperature.",
    },
    "Friction": {
        "measure": "Separate Coulomb and viscoelastic friction (MTM).",
        "master": "Friction master curve, and shift factors from friction.",
    },
    "Page": {
        "web": "Open the local page in the browser (no coding needed).",
    },
    "Program": {
        "verify": "Verify the contact engine on this machine, in a minute.",
        "completion": "Print the completion script for a shell.",
    },
}
#: All commands in their order.
COMMANDS = {name: words for group in GROUPS.values() for name, words in group.items()}

_ABOUT = "Viscoelastic friction of rubber, at any speed and temperature, from lab data."
_AFTERWARDS = (
    "viscofric COMMAND --help describes a command, --version prints the version.",
    "Exit status: 0 success, 1 bad input or not solved, 2 wrong usage, 3 some cases",
    "failed, 130 interrupted, 143 terminated.",
)


def write_overview(formatter: click.HelpFormatter) -> None:
    """Write all commands under their headings, and the meaning of the exit statuses."""
    formatter.write("Usage: viscofric COMMAND [OPTIONS] [ARGUMENTS]\n")
    formatter.write(f"{_ABOUT}\n\n")
    for heading, commands in GROUPS.items():
        for row, (name, words) in enumerate(commands.items()):
            formatter.write(f"{heading if row == 0 else '':<9} {name:<11} {words}\n")
    formatter.write("\n" + "".join(f"{line}\n" for line in _AFTERWARDS))
