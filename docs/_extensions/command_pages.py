"""The command line as Markdown: every command with its usage, help text, arguments and options, from click."""

from __future__ import annotations

import re
from collections.abc import Iterator

import click
from page_parts import cell, table

from viscofric.cli import main
from viscofric.cli.overview import GROUPS


def commands() -> Iterator[tuple[str, list[tuple[str, click.Command]]]]:
    """Yield each heading with the commands under it, those of a group after it: their names, and themselves."""
    context = click.Context(main, info_name="viscofric")
    for heading, names in GROUPS.items():
        found: list[tuple[str, click.Command]] = []
        for name in names:
            command = main.get_command(context, name)
            assert command is not None
            found.append((f"viscofric {name}", command))
            if isinstance(command, click.Group):
                inner = click.Context(command, info_name=name, parent=context)
                for each in command.list_commands(inner):
                    below = command.get_command(inner, each)
                    assert below is not None
                    found.append((f"viscofric {name} {each}", below))
        yield heading, found


def paragraphs(text: str) -> str:
    r"""Return the words of a help text; blocks that click leaves alone (after \b) are shown as typed."""
    shown = []
    for block in re.split(r"\n\s*\n", text.replace("\f", "").strip()):
        lines = block.splitlines()
        if lines and lines[0].strip() == "\b":
            lines = lines[1:]
            if lines and not lines[0].startswith(" "):
                shown.append(cell(lines.pop(0)))
            least = min((len(line) - len(line.lstrip()) for line in lines if line.strip()), default=0)
            shown.append("```text\n" + "\n".join(line[least:] for line in lines) + "\n```")
        else:
            shown.append(cell(block))
    return "\n\n".join(shown)


def option_rows(command: click.Command, context: click.Context) -> list[list[str]]:
    """Return a row for each option: its spelling and its help text."""
    rows = []
    for parameter in command.get_params(context):
        record = parameter.get_help_record(context)
        if record is not None and record[1]:
            rows.append([" ".join(f"`{part}`" for part in record[0].replace("|", "\\|").split(", ")), cell(record[1])])
    return rows


def section(name: str, command: click.Command) -> str:
    """Return the section of one command."""
    parts = name.split()
    context = click.Context(main, info_name=parts[0], **main.context_settings)
    if len(parts) > 2:
        group = main.get_command(context, parts[1])
        assert group is not None
        context = click.Context(group, info_name=parts[1], parent=context)
    context = click.Context(command, info_name=parts[-1], parent=context)
    usage = " ".join([name, *command.collect_usage_pieces(context)])
    shown = [f"```text\n{usage}\n```", paragraphs(command.help or "")]
    rows = option_rows(command, context)
    if rows:
        shown.append(table(["option", "meaning"], rows, numbers=False))
    if command.epilog:
        shown.append(paragraphs(command.epilog))
    label = "command-" + "-".join(parts[1:])
    return f"({label})=\n### {name}\n\n" + "\n\n".join(part for part in shown if part)


def page() -> str:
    """Return all commands."""
    return "\n\n".join(
        f"## {heading}\n\n" + "\n\n".join(section(name, command) for name, command in found)
        for heading, found in commands()
    )
