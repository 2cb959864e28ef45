"""Small files that cost far more to open than they are large, one for each way into viscofric; made when needed."""

from __future__ import annotations

import struct
from pathlib import Path

#: Lists within each other, more than Python's parser of JSON takes.
NESTED = 1_100
STUDY = """
[material]
catalogue = "synthetic fluoroelastomer"
[indenter]
radius = "9 mm"
[conditions]
load = "5 N"
speed = "0.1 m/s"
temperature = "60 degC"
"""


def run_files() -> dict[str, str]:
    """Return run files: keys and lists of any depth, numbers of any length, texts that hide what follows them."""
    deep = ".a" * 40_000
    return {
        "dotted key": f"{STUDY}[x]\na{deep} = 1\n",
        "dotted table": f"{STUDY}[a{deep}]\nb = 1\n",
        "quoted parts": STUDY + '[x]\n"a\\""' + '."a\\""' * 40_000 + " = 1\n",
        "behind a text": f'{STUDY}[x]\nx = {{a = """b"c""", a{deep} = 1}}\n',
        "many keys": STUDY + "[x]\n" + "".join(f"b{n}{'.a' * 99} = 1\n" for n in range(4_000)),
        "nested lists": STUDY + "[x]\na = " + "[" * 5_000 + "]" * 5_000 + "\n",
        "digits": STUDY + "[x]\na = " + "1" * 5_000 + "\n",
        "a long line": STUDY + "[x]\na = " + "b" * 900_000 + "\n",
    }


def hdf5(path: Path) -> Path:
    """Write 6 kB of HDF5 that announce one chunk of 3.2 GB."""
    import h5py

    with h5py.File(path, "w") as file:
        file.attrs["viscofric_version"] = "0"
        file.create_dataset("heights", shape=(20_000, 20_000), dtype="f8", chunks=(20_000, 20_000), compression="gzip")
    return path


def array(path: Path) -> Path:
    """Write an .npy file whose header announces 1e13 numbers."""
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000000,), }".ljust(117) + "\n"
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + bytes(64))
    return path


def workbook(path: Path, sheets: tuple[str, ...] = ("Sheet",), rows: int = 10, columns: int = 10) -> Path:
    """Write a workbook whose first sheet is full of numbers."""
    import xlsxwriter

    with xlsxwriter.Workbook(str(path), {"constant_memory": True}) as book:
        for name in sheets:
            sheet = book.add_worksheet(name)
            for row in range(rows if name == sheets[0] else 0):
                sheet.write_row(row, 0, [row + 0.5] * columns)
    return path
