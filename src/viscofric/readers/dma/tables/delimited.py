"""Text tables of DMA sweeps: commas, semicolons, tabs or blanks between columns, one row of headings or two."""

from __future__ import annotations

from viscofric.readers.dma.names import DMA
from viscofric.readers.dma.readings import Readings
from viscofric.readers.dma.tables.dma_table import read_points
from viscofric.readers.source import Source
from viscofric.readers.tables import find_tables, holds_table

NAME = "delimited text"


def recognises(source: Source) -> bool:
    """Return whether a line of the text names columns of a DMA table."""
    return holds_table(source, DMA)


def read(source: Source) -> Readings:
    """Return the points; see `viscofric.readers.dma.tables.dma_table.read_points` for what is raised."""
    return read_points(find_tables(source, DMA)[""], source, NAME, source.stem)
