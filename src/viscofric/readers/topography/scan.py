"""What a file of heights holds, before anyone has prepared it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.readers.source import Source


@dataclass(frozen=True)
class Asked:
    """What the user says about a file, where it does not say so itself.

    Parameters
    ----------
    unit : str
        Of the heights (and of the positions, where the file holds them); empty: the file's, or m.
    spacing : (float, float), optional
        Distance of neighbouring points along x and y, m.
    channel : str or int, optional
        Name of one of several fields of heights in a file, or its number counted from 0.
    missing : float, optional
        Number that stands for a point without a reading.
    lines : {"x", "y"}
        Axis along which the lines of a text table, or the rows of an array, follow one another.
    """

    unit: str = ""
    spacing: tuple[float, float] | None = None
    channel: str | int | None = None
    missing: float | None = None
    lines: str = "x"


@dataclass(frozen=True, eq=False)
class Scan:
    """Heights as a file holds them.

    Parameters
    ----------
    heights : (nx, ny) array
        m, NaN where there is no reading; (nx, 1) for a line scan.
    spacing : (float, float)
        Distance of neighbouring points along x and y, m.
    told : str
        What was read, such as ``"read from scan.sur (Digital Surf SUR), channel 'Height'"``.
    periodic : bool
        Whether the file says that the surface repeats itself.
    notes : tuple of str
        What else was done to the readings, one step each.
    """

    heights: Array
    spacing: tuple[float, float]
    told: str
    periodic: bool = False
    notes: tuple[str, ...] = ()


def name_of(source: Source) -> str:
    """Return the name of a file without its folder, as histories show it."""
    return Path(source.path).name
