"""BLAS limited to one thread: threads slow down iterative solvers, many-fold on a busy machine."""

from __future__ import annotations

import functools
import sys
from typing import TYPE_CHECKING, ParamSpec, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

    from threadpoolctl import ThreadpoolController

_Parameters = ParamSpec("_Parameters")
_Result = TypeVar("_Result")


def one_blas_thread(function: Callable[_Parameters, _Result]) -> Callable[_Parameters, _Result]:
    """Decorate a function so that BLAS runs single-threaded within it."""

    @functools.wraps(function)
    def limited(*args: _Parameters.args, **kwargs: _Parameters.kwargs) -> _Result:
        with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
            return function(*args, **kwargs)

    return limited


@functools.lru_cache(maxsize=1)
def _libraries(modules: int) -> ThreadpoolController:
    """Return the thread libraries; the search takes milliseconds and is repeated only after further imports."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
