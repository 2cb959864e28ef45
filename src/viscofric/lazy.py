"""Public names, imported at first use, so that importing one part does not load the rest; and renamed ones.

A package's public names are written once, as imports in its stub ``__init__.pyi``, which type checkers read, too.
"""

from __future__ import annotations

import functools
import importlib
import sys
import warnings
from collections.abc import Callable
from typing import Any, TypeVar

FRONT_DOOR = "viscofric"
_Named = TypeVar("_Named", bound=Callable[..., Any])


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


def renamed(**names: str) -> Callable[[_Named], _Named]:
    """Return a decorator, ``old="new"``, for a class whose attributes or a function whose arguments had other names.

    The old names still work, with a warning that says what to write.
    """

    def decorated(named: Any) -> Any:
        if isinstance(named, type):
            for old, new in names.items():
                setattr(named, old, property(functools.partial(_attribute, old=old, new=new)))
            return named

        @functools.wraps(named)
        def call(*arguments: Any, **settings: Any) -> Any:
            for old, new in names.items():
                if old not in settings:
                    continue
                if new in settings:
                    raise TypeError(f"{named.__name__}() takes {new}= or its old name {old}=, not both")
                text = f"viscofric: {old}= of {named.__name__}() is deprecated; write {new}=."
                warnings.warn(text, DeprecationWarning, stacklevel=2)
                settings[new] = settings.pop(old)
            return named(*arguments, **settings)

        return call

    return decorated


def _attribute(owner: Any, old: str, new: str) -> Any:
    text = f"viscofric: {type(owner).__name__}.{old} is deprecated; write {new}."
    warnings.warn(text, DeprecationWarning, stacklevel=2)
    return getattr(owner, new)
