"""Mettler-Toledo DMA text in the layout of genuine files: fixed width, ISO-8859-1, a block for each temperature."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from readers.samples.rubber import TEMPERATURES, points

WIDTH = 14


def line(cells: list[str]) -> str:
    """Return cells set to the right in columns of fixed width."""
    return "".join(cell.rjust(WIDTH) for cell in cells)


def block(temperature: float, letter: str = "E", mark: str = '"') -> list[str]:
    """Return the lines of one temperature: two of names and units, then its points, Ts 0.3 K above the programme."""
    names = [
        "Index",
        "Ts",
        "t",
        "f",
        "F",
        "x",
        "Phase",
        "Tr",
        f"{letter}'",
        f"{letter}{mark}",
        f"{letter}*",
        "tan_delta",
    ]
    units = ["[#]", "[°C]", "[s]", "[Hz]", "[N]", "[µm]", "[rad]", "[°C]", "[MPa]", "[MPa]", "[MPa]", "[]"]
    lines = [line(names), line(units)]
    own = [point for point in points() if point[0] == temperature]
    for index, (T, f, storage, loss) in enumerate(own):
        numbers = [T + 0.3, 60.0 * index, f, 3.0, 2.2, 0.1, T]
        numbers += [storage / 1e6, loss / 1e6, abs(complex(storage, loss)) / 1e6, loss / storage]
        lines.append(line([str(index), *(f"{number:.5e}" for number in numbers)]))
    return lines


def text(letter: str = "E") -> str:
    """Return a whole file, with the name of the method that closes it."""
    lines = [one for T in TEMPERATURES for one in block(T, letter)]
    return "\r\n".join([*lines, "]1[Sample_Freq0.1-10_", ""])


def _write(name: str, letter: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        path = folder / f"{name}.txt"
        path.write_bytes(text(letter).encode("iso-8859-1"))
        return path

    return write


SAMPLES: dict[str, Callable[[Path], Path]] = {
    "mettler tension": _write("mettler_tension", "E"),
    "mettler shear": _write("mettler_shear", "G"),
}
