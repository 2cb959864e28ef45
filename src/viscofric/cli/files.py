"""Files named on the command line: what their names must end in, that none is lost, and `-` for what is piped."""

from __future__ import annotations

import io
import sys
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory, TemporaryFile
from typing import TYPE_CHECKING, Any

import click

from viscofric.datasets import Dataset

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from viscofric.contact.solution import ContactSolution

PICTURES, CSV, JSON, DATA = (".png", ".svg", ".pdf"), (".csv",), (".json",), (".nc", ".csv")
_FILES = (*PICTURES, *JSON, *DATA, ".xlsx", ".html", ".toml")  # what no folder is named
DASH = Path("-")
_INPUT = "standard input"


def check_ending(path: Path | None, option: str, endings: tuple[str, ...]) -> None:
    """Stop where the name of a file to be written does not say what goes into it."""
    if path is not None and path != DASH and path.suffix.lower() not in endings:
        raise click.BadParameter(f"{path}: must end in {', '.join(endings)}.", param_hint=option)


def refusal(code: str, sentence: str) -> click.ClickException:
    """Return the error of a command that will not write, with a code as viscofric's errors have."""
    from viscofric.errors import InputError

    error = click.ClickException(sentence)
    error.__cause__ = InputError(sentence, code=code)
    return error


def refuse_to_overwrite(inputs: Iterable[Path], *targets: Path | None) -> None:
    """Stop where a file to be written is one that is read: measurements are not to be lost."""
    read = {path.resolve() for path in inputs}
    for target in targets:
        if target is not None and target.resolve() in read:
            raise refusal("is-input", f"{target} is an input and would be overwritten; choose another name.")


class Named(click.Path):
    """A file or a folder with a name: `-` is none."""

    def __init__(self, **kinds: bool) -> None:
        super().__init__(path_type=Path, **kinds)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path."""
        found: Any = super().convert(value, param, ctx)
        if found == DASH and not self.allow_dash:
            self.fail("`-` stands for standard input or output, which cannot be used here; give a name.", param, ctx)
        if not self.file_okay and found.suffix.lower() in _FILES and not found.is_dir():
            self.fail(f"{found} is written as a folder of files; give a name without {found.suffix}.", param, ctx)
        return found


class Written(Named):
    """A file or a folder to be written; where that is not possible, the command stops before it has computed."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path."""
        found: Any = super().convert(value, param, ctx)
        try:
            if found != DASH:
                _insist_on_writable(found)
        except OSError as error:
            from viscofric.errors import not_written

            self.fail(str(not_written(found, error)), param, ctx)
        return found


def _insist_on_writable(path: Path) -> None:
    """Raise `OSError` where a folder to be written, or the nearest one above that exists, takes no files."""
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise OSError("it is a device or a pipe; give the name of a file")
    here = path.absolute()
    with TemporaryFile(dir=here if here.is_dir() else next(one for one in here.parents if one.exists())):
        pass


#: A file to be read.
FILE = Named(dir_okay=False)
#: Files to be written, of which `OUT` may be `-`.
WRITTEN = Written(dir_okay=False)
OUT = Written(dir_okay=False, allow_dash=True)
FOLDER = Written(file_okay=False)


class Source(click.Path):
    """A file to be read, or `-` for standard input, which is then kept in a file for as long as the command runs."""

    def __init__(self) -> None:
        super().__init__(path_type=Path, allow_dash=True)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path of the file to read."""
        found: Any = super().convert(value, param, ctx)
        return _kept_input(ctx) if found == DASH and ctx is not None else found


def _kept_input(ctx: click.Context) -> Path:
    """Return the file that holds what came from standard input, read once."""
    if _INPUT not in ctx.meta:
        folder = Path(ctx.with_resource(TemporaryDirectory(prefix="viscofric-")))
        ctx.meta[_INPUT] = folder / _INPUT
        from viscofric.files import LARGEST_FILE

        ctx.meta[_INPUT].write_bytes(sys.stdin.buffer.read(LARGEST_FILE + 1))  # one more is refused by its reader
    path: Path = ctx.meta[_INPUT]
    return path


def plainly(sentence: str) -> str:
    """Name standard input in a sentence as what it is, not as the file that it was kept in."""
    ctx = click.get_current_context(silent=True)
    kept = None if ctx is None else ctx.meta.get(_INPUT)
    return sentence if kept is None else sentence.replace(kept.as_posix(), _INPUT).replace(str(kept), _INPUT)


@contextmanager
def to_be_written(path: Path) -> Iterator[Path]:
    """Give the file to write to: the one named, or for `-` one that is then printed."""
    if path != DASH:
        yield path
        return
    with TemporaryDirectory(prefix="viscofric-") as folder:
        target = Path(folder) / "standard output.csv"
        yield target
        click.echo(target.read_bytes(), nl=False)


def write_fields(path: Path, solution: ContactSolution) -> None:
    """Write a contact: netCDF with all numbers, or a table (CSV) of x, y, pressure and displacement of each cell."""
    data = solution.to_dataset()
    write_dataset(path, data if path.suffix.lower() == ".nc" else data[["pressure", "displacement"]])


def write_dataset(path: Path, data: Dataset) -> None:
    """Write a data set: netCDF, or a table (CSV, a row for each point), by the ending of the name."""
    from viscofric.files import write_atomically

    if path.suffix.lower() == ".nc":
        from viscofric.study.results.netcdf import write_netcdf

        write_netcdf(data, path)
        return
    from viscofric.study.results.columns import write_columns

    text = io.StringIO()
    write_columns(text, data)
    write_atomically(path, text.getvalue().encode())
