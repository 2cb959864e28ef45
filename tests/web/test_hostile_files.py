"""Files made to do harm are refused in a sentence, on the way that the page's files take."""

from __future__ import annotations

import io
import random
import zipfile
from typing import TYPE_CHECKING

import pytest

from readers.samples.workbook import rows, write
from web.served_page import messages_of

if TYPE_CHECKING:
    from pathlib import Path

    import httpx

SHEET = "xl/worksheets/sheet1.xml"


def workbook_with(folder: Path, part: str, *replaced: tuple[bytes, bytes]) -> bytes:
    """Return a workbook of sweeps with something in one part of its archive replaced, where it is first."""
    changed = io.BytesIO()
    with (
        zipfile.ZipFile(write(folder / "sweeps.xlsx", {"DMA": rows()})) as archive,
        zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as fresh,
    ):
        for name in archive.namelist():
            content = archive.read(name)
            for old, new in replaced if name == part else ():
                assert old in content
                content = content.replace(old, new, 1)
            fresh.writestr(name, content)
    return changed.getvalue()


def corner(folder: Path) -> bytes:
    """Return one with a cell in the last corner: 549 GB to a parser."""
    cell = b'<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData>'
    return workbook_with(folder, SHEET, (b"</sheetData>", cell))


def hidden_corner(folder: Path) -> bytes:
    """Return the same with the cell's name written in another way."""
    cell = b'<row r="1048576"><c r="&#88;FD1048576"><v>1</v></c></row></sheetData>'
    return workbook_with(folder, SHEET, (b"</sheetData>", cell))


def bomb(folder: Path) -> bytes:
    """Return one that unpacks to gigabytes."""
    return workbook_with(folder, SHEET, (b"</sheetData>", b"</sheetData>" + b" " * 60_000_000))


def entities(folder: Path) -> bytes:
    """Return one whose texts are of texts of texts."""
    laughs = b"".join(b'<!ENTITY l%d "%s">' % (depth, b"&l%d;" % (depth - 1) * 10) for depth in range(1, 10))
    head = b'<!DOCTYPE sst [<!ENTITY l0 "lol">' + laughs + b"]><sst "
    return workbook_with(folder, "xl/sharedStrings.xml", (b"<sst ", head), (b"<t>", b"<t>&l9;"))


def cut(folder: Path) -> bytes:
    """Return the first half of one."""
    content = write(folder / "sweeps.xlsx", {"DMA": rows()}).read_bytes()
    return content[: len(content) // 2]


def noise(folder: Path) -> bytes:
    """Return bytes by chance that begin as a workbook of the old kind does."""
    return bytes.fromhex("D0CF11E0A1B11AE1") + random.Random(1).randbytes(100_000)


def long_line(folder: Path) -> bytes:
    """Return a table with one line of numbers, without an end."""
    return b"temperature,frequency,storage modulus\n" + b"1," * 5_000_000


_MORE = [hidden_corner, bomb, entities, noise, long_line]


@pytest.mark.parametrize("made", [corner, cut, *(pytest.param(one, marks=pytest.mark.slow) for one in _MORE)])
def test_hostile_file_is_refused_in_a_sentence(client: httpx.Client, tmp_path: Path, made: object) -> None:
    suffix = "csv" if made is long_line else "xlsx"
    content = made(tmp_path)  # type: ignore[operator]
    assert client.put(f"/api/files/hostile.{suffix}", content=content).status_code == 200
    study = {"material": {"dma": f"hostile.{suffix}", "reference_temperature": "30 degC"}}
    last = messages_of(client, "sweeps", study)[-1]
    assert last["event"] == "error"
    assert "hostile." in last["message"]
    assert last["code"] != "internal-error"
    assert "viscofric-web" not in last["message"]  # no place on this machine
