"""Readers of instrument files: what a file holds, in SI units, with notes on what was doubtful."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
