"""``viscofric material read FILES``: what files of mechanical tests hold, and what is doubtful about them."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

import click

from viscofric.cli.commands import as_command
from viscofric.cli.errors import print_notes
from viscofric.cli.files import WRITTEN, Source, plainly, refuse_to_overwrite
from viscofric.cli.output import outputs, print_json, print_written
from viscofric.cli.rubber_options import reading_options
from viscofric.errors import InputError


@as_command("read")
@click.argument("files", nargs=-1, required=True, type=Source())
@reading_options
@outputs("Also write the points used of frequency sweeps to a table (CSV).", WRITTEN)
def command(files: tuple[Path, ...], out: Path | None, as_json: bool, **reading: Any) -> None:
    """Print the kind of test, format, isotherms and doubtful data of FILES.

    FILES are frequency sweeps, temperature ramps, amplitude sweeps, creep or relaxation tests; the kind is recognised
    by content. Several files of one kind make one set, such as one file for each temperature.
    """
    from viscofric.errors import DataFileError

    refuse_to_overwrite(files, out)
    try:
        _print(files, out, as_json, reading)
    except DataFileError as error:
        raise _of_another_kind(files) or error from None


def _print(files: tuple[Path, ...], out: Path | None, as_json: bool, reading: dict[str, Any]) -> None:
    from viscofric.cli.material.readings import described, read_kind
    from viscofric.readers.recognise import by_kind

    stated = {name: reading[name] or None for name in ("modulus_unit", "columns", "sheet")}
    kinds = by_kind(files, temperatures=reading["temperature"], **stated)
    records = []
    for kind, own in kinds.items():
        given = reading["temperature"]
        if len(given) == len(files) > 1:
            given = tuple(given[files.index(path)] for path in own)
        test = read_kind(kind, own, reading | {"temperature": given})
        record, lines = described(kind, test, [plainly(str(path)) for path in own])
        records.append(record)
        if not as_json:
            click.echo("\n".join(lines))
        print_notes(test.notes)
        if out is not None and kind == "dma":
            from viscofric.study.rubber_results import write_sweeps

            print_written(("table", write_sweeps(test, out)), err=as_json)
    if as_json:
        print_json({"tests": records})
    if out is not None and "dma" not in kinds:
        raise click.UsageError("--out is for frequency sweeps.")


def _of_another_kind(files: tuple[Path, ...]) -> InputError | None:
    """Return what is said of a file that is no test, but a material or a table of shift factors; None of others."""
    from viscofric.errors import DataFileError, InputError
    from viscofric.rheology.cards import open_card
    from viscofric.rheology.shifts.shift_files import read_shift_factors

    kinds: dict[Any, str] = {
        open_card: "a material; viscofric material show reads it",
        read_shift_factors: "a table of shift factors; viscofric material fit takes it by --shift-factors",
    }
    for path in files:
        for read, words in kinds.items():
            with contextlib.suppress(InputError):
                read(path)
                return DataFileError(str(path), f"is no mechanical test, but {words}.", code="no-test")
    return None
