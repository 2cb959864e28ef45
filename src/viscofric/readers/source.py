"""One file as every format sees it: its bytes, its text if it is text, and what the user said of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from viscofric.errors import DataFileError
from viscofric.files import decoded


@dataclass(frozen=True, eq=False)
class Source:
    """What a file holds, opened once and shown to every format.

    Parameters
    ----------
    path : str
        The file, as the user named it.
    data : bytes
        All of it.
    temperature : float, optional
        Of all points, K, where the user gave it because the file does not hold it.
    modulus_unit : str
        Of the moduli, where the user gave it because the file does not name it; else empty.
    """

    path: str
    data: bytes
    temperature: float | None = None
    modulus_unit: str = ""

    @cached_property
    def text(self) -> str | None:
        """The file as text, or None if it is a binary file."""
        try:
            return decoded(_marked(self.data), self.path)
        except DataFileError:
            return None

    @property
    def stem(self) -> str:
        """The file's name without folder and ending."""
        return Path(self.path).stem


def _marked(data: bytes) -> bytes:
    """Return bytes that are UTF-16 without its mark with it: every second byte of the first ones is zero."""
    first, second = data[:200:2], data[1:200:2]
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data
    for mark, zeros, letters in ((b"\xff\xfe", second, first), (b"\xfe\xff", first, second)):
        if len(data) > 20 and 0 not in letters and zeros.count(0) > 0.8 * len(zeros):
            return mark + data[: len(data) - len(data) % 2]
    return data
