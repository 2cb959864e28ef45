"""Figures and an HTML report, made from a study's results alone: they can be made again from the file.

Nothing here is loaded before it is used: matplotlib and Jinja2 take their time.
"""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
