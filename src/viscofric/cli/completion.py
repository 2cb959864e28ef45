"""``viscofric completion SHELL``: the script with which a shell completes commands, options and files."""

from __future__ import annotations

import click

from viscofric.cli.commands import as_command

_VARIABLE = "_VISCOFRIC_COMPLETE"
_EXAMPLE = """\b
Install for all new shells:
  viscofric completion bash >> ~/.bashrc
  viscofric completion zsh >> ~/.zshrc
  viscofric completion fish > ~/.config/fish/completions/viscofric.fish
"""


@as_command("completion", epilog=_EXAMPLE)
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def command(shell: str) -> None:
    """Print the completion script for SHELL: commands, options and files of viscofric."""
    from click.shell_completion import ShellComplete, get_completion_class

    from viscofric.cli import main

    kind = get_completion_class(shell)
    assert kind is not None
    # not the class's own `source`, which for bash first runs the bash that happens to be on the path
    click.echo(ShellComplete.source(kind(main, {}, "viscofric", _VARIABLE)))
