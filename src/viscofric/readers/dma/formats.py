"""The formats of DMA files that are known, and which of them a file is, told by its content."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from viscofric.errors import DataFileError
from viscofric.readers.dma.instruments import (
    eplexor,
    mettler,
    rheocompass,
    trios_json,
    trios_text,
    universal_analysis,
)
from viscofric.readers.dma.tables import delimited, reptate, workbook

if TYPE_CHECKING:
    from viscofric.readers.dma.readings import Readings
    from viscofric.readers.source import Source


class Format(Protocol):
    """What the module of one format offers.

    Attributes
    ----------
    NAME : str
        The format in words: ``"TA Instruments TRIOS text"``.
    """

    @property
    def NAME(self) -> str:
        """The format in words."""

    def recognises(self, source: Source) -> bool:
        """Return whether the file is of this format, told by its content; quick, and never raises."""

    def read(self, source: Source) -> Readings:
        """Return the points of the file, or raise `DataFileError`."""


#: Tried in this order: workbooks and delimited tables come last, since exports of instruments are such too.
FORMATS: tuple[Format, ...] = (
    universal_analysis,
    trios_json,
    trios_text,
    rheocompass,
    mettler,
    eplexor,
    reptate,
    workbook,
    delimited,
)


def format_of(source: Source) -> Format:
    """Return the format of a file.

    Parameters
    ----------
    source : Source
        The file.

    Raises
    ------
    DataFileError
        If the file is empty, or no format recognises it.
    """
    for one in FORMATS:
        if one.recognises(source):
            return one
    if not source.data.strip(b"\0 \t\r\n\xef\xbb\xbf\xff\xfe"):
        raise DataFileError(source.path, "the file is empty; it must hold a header and rows of numbers.")
    if source.text is None:
        what = "is a binary file of no known kind"
    else:
        what = "has no columns that name a modulus and a frequency"
    raise DataFileError(source.path, f"{what}; what can be read: {known()}.")


def known() -> str:
    """Return the names of all formats in one readable list."""
    names = [one.NAME for one in FORMATS]
    return f"{', '.join(names[:-1])} and {names[-1]}"
