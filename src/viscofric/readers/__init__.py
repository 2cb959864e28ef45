"""Readers of instrument files: what a file holds, in SI units, with notes on what was doubtful."""

from viscofric.readers.dma.read import read_dma
from viscofric.readers.mtm.read import read_mtm
from viscofric.readers.steps.read import read_step_tests

__all__ = ["read_dma", "read_mtm", "read_step_tests"]
