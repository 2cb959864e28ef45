"""The papers behind each result: references, the references of a result, and their output."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
