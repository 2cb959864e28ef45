"""Small synthetic files of every format, written as the instruments write them, for tests of the readers.

Each module beside this one belongs to one format and holds ``SAMPLES``, which gives names to functions that
write one file into a folder and return its path.
"""

from __future__ import annotations

import pkgutil
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

#: Name of the sample -> function that writes it into a folder and returns its path.
SAMPLES: dict[str, Callable[[Path], Path]] = {
    name: write
    for module in sorted(one.name for one in pkgutil.iter_modules(__path__))
    for name, write in import_module(f"{__name__}.{module}").SAMPLES.items()
}
