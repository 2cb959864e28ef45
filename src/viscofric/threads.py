"""Threads: one for BLAS, which slows down iterative solvers many-fold on a busy machine; several for large arrays."""

from __future__ import annotations

import functools
import os
import sys
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from viscofric.arguments import whole_number

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from threadpoolctl import ThreadpoolController

#: Environment variable with the number of threads of the FFTs of large arrays, and of what else is done with these.
THREADS_VARIABLE = "VISCOFRIC_FFT_THREADS"
#: What a number of threads has to be.
THREADS = "a whole number from 1, such as 2"

#: Elements from which on several threads are faster, and elements for each thread.
_LARGE, _EACH = 2**19, 2**17
#: Elements of a part of an array of which several stay in the processor's cache.
_PART = 2**17

_given: ContextVar[int | None] = ContextVar("threads of large arrays", default=None)

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


@contextmanager
def so_many(threads: int | None) -> Iterator[None]:
    """Let work on large arrays have so many threads, whatever the environment says; None leaves it as it is."""
    before = _given.set(_given.get() if threads is None else threads)
    try:
        yield
    finally:
        _given.reset(before)


def usable_threads() -> int:
    """Return the number of threads of work on large arrays.

    It is that of `so_many` or of the environment variable, or one for each processor that this process may use, no more
    than OpenMP's.
    """
    given = _given.get()
    if given is not None:
        return given
    text = os.environ.get(THREADS_VARIABLE)
    if text is None:
        processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        of_openmp = os.environ.get("OMP_NUM_THREADS", "")  # one in the workers of a cluster
        return min(processors, int(of_openmp) or 1) if of_openmp.isdecimal() else processors
    short = len(text) < 7 and text.strip().isdecimal()
    return whole_number(int(text) if short else text, THREADS_VARIABLE, 1, right=THREADS)


def threads_for(elements: int, threads: int | None = None) -> int:
    """Return how many threads work on so many real numbers is to have, of those given or usable."""
    return 1 if elements < _LARGE else min(threads or usable_threads(), elements // _EACH)


def in_parts(function: Callable[..., _Result], *arrays: Any, threads: int | None = None) -> list[_Result]:
    """Call a function with the same rows of all arrays, part after part; return what it returns, in the order of rows.

    Parts of large arrays are shared among so many threads as their FFTs have; each stays in the processor's cache
    from one operation of the function to the next.
    """
    rows, size = arrays[0].shape[0], arrays[0].size
    if size < _LARGE:
        return [function(*arrays)]
    each = max(1, _PART * rows // size)
    starts = range(0, rows, each)
    found: dict[int, _Result] = {}
    waiting = deque(starts)  # unlike an iterator, safe to share among threads without a global lock

    def work() -> None:
        while True:
            try:
                start = waiting.popleft()
            except IndexError:
                return
            try:
                found[start] = function(*(array[start : start + each] for array in arrays))
            except BaseException:
                waiting.clear()  # what is left is of no use
                raise

    number = threads_for(size, threads)
    if number == 1:
        work()
    else:
        with ThreadPoolExecutor(number - 1) as pool:
            others: list[Future[None]] = []
            # Refused once the main thread has ended, and where there can be no more threads: fewer do the work then.
            with suppress(RuntimeError):
                others.extend(pool.submit(work) for _ in range(number - 1))
            work()
            for other in others:
                other.result()
    return [found[start] for start in starts]
