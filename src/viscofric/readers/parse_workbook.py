"""Parse a workbook from standard input in a separate process with limited memory; `workbook` starts it.

A crafted workbook can make any parser request hundreds of gigabytes, which ends its process.  This
script imports nothing of viscofric, so that it starts quickly.
"""

from __future__ import annotations

import io
import json
import re
import sys
import zipfile

#: Far above those of a workbook of measurements; a sheet is held in memory with its empty cells.
MOST_CELLS = 5_000_000
LARGEST_MEMORY = 3_000_000_000  # bytes
#: Longer text is neither a heading nor a number; thousands of cells may share one long text.
LONGEST_TEXT = 1000  # characters
LARGEST_ANSWER = 50_000_000  # bytes

_CELL = re.compile(rb"""\sr\s*=\s*["']([A-Z]{1,3})([0-9]{1,7})["']""")


class RefusalError(Exception):
    """The workbook is not one of measurements; the second argument is the code of the refusal."""


def main() -> None:
    """Write ``{"sheets": {name: rows}, "hidden": names}``, or a sentence as "problem", or a package as "missing"."""
    _limit_memory()
    try:
        sheets, hidden = _sheets(sys.stdin.buffer.read())
        answer: dict[str, object] = {"sheets": sheets, "hidden": hidden}
    except RefusalError as error:
        answer = {"problem": error.args[0], "code": error.args[1]}
    except MemoryError:
        answer = {"problem": "needs more memory than a workbook of measurements would.", "code": "too-large"}
    except ImportError:
        answer = {"missing": "python-calamine"}
    written = json.dumps(answer).encode()
    if len(written) > LARGEST_ANSWER:
        problem = f"holds {len(written) / 1e6:.0f} MB of cells, far more than a workbook of measurements does."
        written = json.dumps({"problem": problem, "code": "too-large"}).encode()
    sys.stdout.buffer.write(written)


def _limit_memory() -> None:
    try:
        import resource
    except ImportError:  # Windows has no such limit; sizes are checked all the same
        return
    try:
        resource.setrlimit(resource.RLIMIT_AS, (LARGEST_MEMORY, LARGEST_MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    except (ValueError, OSError):  # a lower limit is set already
        return


def _sheets(data: bytes) -> tuple[dict[str, list[list[object]]], list[str]]:
    import python_calamine

    if data.startswith(b"PK"):
        _insist_on_sense(data)
    try:
        workbook = python_calamine.CalamineWorkbook.from_filelike(io.BytesIO(data))
        kinds = python_calamine.SheetTypeEnum
        listed = [one for one in workbook.sheets_metadata if one.typ == kinds.WorkSheet]
        names = [one.name for one in listed]
        hidden = [one.name for one in listed if one.visible != python_calamine.SheetVisibleEnum.Visible]
        sheets, cells = {}, 0
        for name in names:
            sheet = workbook.get_sheet_by_name(name)
            height, width = sheet.end or (0, 0)
            cells += (height + 1) * (width + 1)
            if cells > MOST_CELLS:
                raise RefusalError(_too_many_cells(cells), "too-large")
            rows = sheet.to_python(skip_empty_area=False)
            sheets[name] = [[_plain(cell) for cell in row] for row in rows]
    except (MemoryError, RefusalError):
        raise
    except BaseException as error:  # noqa: BLE001 - a panic of the parser is no Exception
        raise RefusalError(f"is a damaged or protected workbook ({_first_line(error)}).", "damaged") from None
    return sheets, hidden


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0][:120].rstrip(".")


def _too_many_cells(cells: int) -> str:
    return f"has sheets of {cells:.3g} cells; a workbook of measurements has at most {MOST_CELLS:.3g}."


def _plain(cell: object) -> object:
    """Keep numbers and text; truth values, dates and times become text."""
    if isinstance(cell, (float, int)) and not isinstance(cell, bool):
        return cell
    return str(cell).upper() if isinstance(cell, bool) else str(cell)[:LONGEST_TEXT]


def _insist_on_sense(data: bytes) -> None:
    """Refuse a sheet of billions of cells; the unpacked size of the archive was checked before."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for part in archive.infolist():
                if part.filename.lower().endswith(".xml") and "worksheets/" in part.filename.lower():
                    cells = _extent(archive.read(part))
                    if cells > MOST_CELLS:
                        raise RefusalError(_too_many_cells(cells), "too-large")
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, OSError, EOFError, ValueError, KeyError) as error:
        raise RefusalError(f"is a damaged workbook ({_first_line(error)}).", "damaged") from None
    except Exception as error:  # zlib.error and what else a torn archive raises
        if isinstance(error, RefusalError):
            raise
        raise RefusalError(f"is a damaged workbook ({_first_line(error)}).", "damaged") from None


def _extent(sheet: bytes) -> int:
    """Return rows times columns of the smallest block from the first cell on that holds all cells."""
    width = height = 0
    for letters, digits in _CELL.findall(sheet):
        column = 0
        for letter in letters:
            column = 26 * column + letter - 64
        width, height = max(width, column), max(height, int(digits))
    return width * height


if __name__ == "__main__":
    main()
