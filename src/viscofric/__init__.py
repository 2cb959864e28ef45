"""Viscoelastic friction of rubber from laboratory data, at any speed and temperature, and back.

The names of daily work are here, others in submodules such as ``viscofric.contact``; each is loaded when first used, so
that importing viscofric costs next to nothing.
"""

from typing import Any

from viscofric.lazy import loaded_when_used

_fetched, __dir__, __all__ = loaded_when_used(__name__)
__all__ += ["__version__"]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        globals()[name] = version("viscofric")  # which reads files each time
        return globals()[name]
    return _fetched(name)
