"""What commands write and print: `--out`, `--picture` and `--json`, the same in all commands."""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import click

from viscofric.cli.commands import Decorator, together
from viscofric.cli.files import DASH, OUT, PICTURES, WRITTEN, check_ending, to_be_written
from viscofric.cli.overview import TYPED
from viscofric.datasets import Dataset
from viscofric.files import says_synthetic

#: Help of `--json` where a study runs.
RUN_JSON = "Print progress as JSON, one object a line; the last one has the outcome."


def outputs(
    out: str = "",
    kind: click.Path = OUT,
    endings: tuple[str, ...] = (),
    *,
    default: Path | None = None,
    picture: str = "",
    synthetic: bool = False,
    json: str = "Print everything as JSON, in SI units.",
) -> Decorator:
    """Return a decorator that adds `--out`, `--picture` and `--json` with such a help, and `--synthetic`."""

    def checked(ctx: click.Context, param: click.Parameter, value: Path | None) -> Path | None:
        if value == DASH and ctx.params.get("as_json"):
            raise click.UsageError(
                "--json and --out - both write to standard output; use one of them, or give --out a file."
            )
        if allowed := PICTURES if param.name == "picture" else endings:
            check_ending(value, f"--{param.name}", allowed)
        return value

    about = "The data are synthetic, and no remark (#) in a file says so: label figures and report accordingly."
    options = (
        (out, click.option("-o", "--out", type=kind, default=default, callback=checked, help=out)),
        (picture, click.option("--picture", type=WRITTEN, callback=checked, help=f"{picture} (PNG, SVG or PDF).")),
        (synthetic, click.option("--synthetic", is_flag=True, help=about)),
        (json, click.option("--json", "as_json", is_flag=True, is_eager=True, help=json)),
    )
    return together(*(option for offered, option in options if offered))


def optional_si(text: str | None, unit: str) -> float | None:
    """Return a quantity as JSON holds it, in SI units; None if it was not given."""
    from viscofric.units import to_si

    return None if text is None else to_si(text, unit)


def is_synthetic(flag: bool, files: Iterable[Path]) -> bool:
    """Whether data are synthetic, by the option or by what their files say."""
    return flag or any(map(says_synthetic, files))


def typed_command() -> str:
    """Return the command as it was typed, to be run again."""
    return shlex.join(["viscofric", *click.get_current_context().meta[TYPED]])


def print_json(record: dict[str, Any], indent: int | None = 2) -> None:
    """Print one JSON object; a number that is not finite is null."""
    from viscofric.datasets import plain

    click.echo(json.dumps(plain(record, digits=None), indent=indent, ensure_ascii=False, allow_nan=False))


def json_record(
    kind: str,
    inputs: dict[str, Any],
    results: Dataset,
    *,
    notes: Iterable[str] = (),
    warnings: Iterable[str] = (),
    **more: Any,
) -> dict[str, Any]:
    """Return what `--json` prints: the request, the data set of the results and more of it, and the notes."""
    from importlib.metadata import version

    from viscofric.datasets import record
    from viscofric.notes import listed

    more = {name: record(one) if hasattr(one, "data_vars") else one for name, one in more.items()}
    # Sentences are attributes as text, and listed as they are.
    found = {name: one for name, one in record(results).items() if name not in ("notes", "note_records", "sentences")}
    return {
        "format": f"viscofric {kind}",
        "viscofric_version": version("viscofric"),
        "inputs": inputs,
        "results": found,
        **more,
        **listed("notes", notes),
        **listed("warnings", warnings),
    }


def answer(record: Callable[[], dict[str, Any]], show: Callable[[], object], *, indent: int | None = 2) -> None:
    """Print what was found: as JSON with `--json`, else for people, unless `--out -` prints a table instead."""
    parameters = click.get_current_context().params
    if parameters["as_json"]:
        print_json(record(), indent)
    elif parameters["out"] != DASH:
        show()


def print_pairs(pairs: Iterable[tuple[str, str]]) -> None:
    """Print pairs of name and value, the values one below the other."""
    pairs = list(pairs)
    width = max((len(name) for name, _ in pairs), default=0)
    for name, value in pairs:
        click.echo(f"{name:<{width}}  {value}")


def write_files(*files: tuple[str, Path | None, Callable[[Path], object]]) -> None:
    """Write the requested ones of files (a word, its path, what writes it; `-` prints it), and name them."""
    for word, path, write in files:
        if path is not None:
            with to_be_written(path) as target:
                write(target)
            if path != DASH:
                print_written((word, path), err=is_piped())


def is_piped() -> bool:
    """Whether standard output has the JSON or the table of `--out -`, so that all else goes to standard error."""
    parameters = click.get_current_context().params
    return bool(parameters["as_json"]) or parameters["out"] == DASH


def print_written(*written: tuple[str, object], figures: Sequence[Path] = (), err: bool = False) -> None:
    """Name written files, a line each; figures, which are many, by their folder."""
    if figures:
        written = (("figures", figures[0].parent), *written)
    for word, path in written:
        click.echo(f"{word:<8} {path}", err=err)


def drawing(figure: str, *results: Any, mark: bool, **settings: Any) -> Callable[[Path], None]:
    """Return what draws results into a file, by "module.function" of `report.figures`; `mark`: as synthetic data."""

    def write(path: Path) -> None:
        from viscofric.report.figures.saving import save_picture

        module, _, function = figure.partition(".")
        draw = getattr(import_module(f"viscofric.report.figures.{module}"), function)
        save_picture(path, partial(draw, *results, **settings), name=figure, synthetic=mark)

    return write


def write_rows(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """Write a table (CSV) with a line for each row, which all have the same names; `-` prints it."""
    import csv
    import io

    from viscofric.files import write_atomically

    text = io.StringIO()
    table = csv.DictWriter(text, list(rows[0]) if rows else [], lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    with to_be_written(path) as target:
        write_atomically(target, text.getvalue().encode())
