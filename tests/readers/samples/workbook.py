"""Excel workbooks as people write them."""

from __future__ import annotations

from pathlib import Path

from readers.samples.rubber import points

HEADER = ["Temperature (°C)", "Frequency (Hz)", "E' (MPa)", "E'' (MPa)"]


def write(path: Path, sheets: dict[str, list[list]]) -> Path:
    """Write sheets of cells."""
    import xlsxwriter

    with xlsxwriter.Workbook(str(path)) as workbook:
        for name, rows in sheets.items():
            sheet = workbook.add_worksheet(name)
            for number, row in enumerate(rows):
                sheet.write_row(number, 0, row)
    return path


def rows() -> list[list]:
    """Return the synthetic rubber's points under one row of headings."""
    return [HEADER, *([T, f, s / 1e6, loss / 1e6] for T, f, s, loss in points())]


def one_sheet(folder: Path) -> Path:
    """Write a sheet of notes, then one of measurements."""
    return write(folder / "one.xlsx", {"Notes": [["synthetic"], ["by", "nobody"]], "DMA": rows()})


SAMPLES = {"workbook: one sheet": one_sheet}
