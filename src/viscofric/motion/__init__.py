"""Contacts in motion: histories of load, depth, path and temperature, and the response of the material."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
