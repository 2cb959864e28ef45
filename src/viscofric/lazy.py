"""Public names, imported at first use, so that importing one part does not load the rest.

A package's public names are written once, as imports in its stub ``__init__.pyi``, which type checkers read, too.
"""

from __future__ import annotations

import functools
import importlib
import sys
from collections.abc import Callable
from typing import Any

FRONT_DOOR = "viscofric"


@functools.cache
def public_names(package: str) -> dict[str, str]:
    """Return ``{name: module}`` of a package's stub; submodules lie in the package itself."""
    module = sys.modules.get(package) or importlib.import_module(package)
    spec = module.__spec__
    # as the package itself is loaded, from a folder or a zip file
    text = spec.loader.get_data(f"{spec.origin.removesuffix('.py')}.pyi").decode()  # type: ignore[union-attr]
    imports = [part.replace("(", " ").split() for part in f"\n{text}".split("\nfrom ")[1:]]
    return {words[2]: words[0] for words in imports}  # from MODULE import NAME as NAME


def full_names() -> dict[str, str]:
    """Return ``{name: full name}`` of all public names, of the front door and of the submodules that it names."""
    front = public_names(FRONT_DOOR)
    rooms = [f"{FRONT_DOOR}.{name}" for name, home in front.items() if home == FRONT_DOOR]
    found = {name: f"{room}.{name}" for room in rooms for name in public_names(room)}
    return found | {name: f"{FRONT_DOOR}.{name}" for name, home in front.items() if home != FRONT_DOOR}


def loaded_when_used(package: str) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return a package's ``__getattr__``, ``__dir__`` (PEP 562) and ``__all__``, of the names in its stub."""
    homes = public_names(package)
    names = [*homes]

    def fetch(name: str) -> Any:
        if name in homes:
            if homes[name] == package:
                return importlib.import_module(f"{package}.{name}")
            value = getattr(importlib.import_module(homes[name]), name)
            setattr(sys.modules[package], name, value)
            return value
        full = "" if name.startswith("_") else full_names().get(name, "")
        text = f"module {package!r} has no attribute {name!r}" + (f"; write {full}" if full else "")
        raise AttributeError(text, name=name, obj=sys.modules[package])

    return fetch, lambda: sorted(names), names
