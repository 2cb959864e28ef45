"""What tests of several rooms share."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

# Tests run side by side, a process for each core: threads of BLAS within them only get in each other's way.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Nothing is written to the home folder, matplotlib's cache of fonts included.
os.environ.setdefault("MPLCONFIGDIR", str(Path(sys.prefix) / "var" / "matplotlib"))
# Modules are compiled, and the assertions of tests rewritten, once: not in every process, nor again in every run.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# How long an example takes is not tested: the machine may be busy.
settings.register_profile("viscofric", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("viscofric")
# Hypothesis would parse every module of package and tests for constants to draw, in each process: a fifth of the time
# that collection takes. Without them, what a seed draws does not depend on the modules that a process has loaded.
providers._get_local_constants = lambda: providers._local_constants

ROOT = Path(__file__).resolve().parent.parent


def pytest_sessionstart() -> None:
    """Collect no garbage while tests are collected: hardly any arises, and each search visits all that exists."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Leave what lasts as long as the process, tests and modules, out of later searches for garbage, and have fewer."""
    gc.freeze()
    gc.set_threshold(50_000, 20, 20)
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests of the page, those in a browser as a step of their own, and other steps' as slow.

    `-m "not slow and not page"` is the inner loop.  Tests of the page come first, and so all in one process, as long as
    there are few: one server and one browser.
    """
    items.sort(key=lambda item: item.path.parent.name != "web")
    for item in items:
        if item.path.parent.name == "web":
            item.add_marker("page")
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker("apart")
        if item.get_closest_marker("apart") or item.get_closest_marker("exhaustive"):
            item.add_marker("slow")


@pytest.fixture(scope="session")
def real_data() -> Path:
    """Folder of real measurements, not part of the project; tests that need it are skipped without it."""
    folder = Path(os.environ.get("VISCOFRIC_REAL_DATA", ROOT / ".." / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no real data at {folder}; set VISCOFRIC_REAL_DATA to the folder that holds dma/")
    return folder


@pytest.fixture(scope="session")
def extension() -> Callable[[str], ModuleType]:
    """Import a module of those that make pages of the site."""

    def imported(name: str) -> ModuleType:
        with pytest.MonkeyPatch.context() as patch:
            patch.syspath_prepend(str(ROOT / "docs" / "_extensions"))
            return import_module(name)

    return imported
