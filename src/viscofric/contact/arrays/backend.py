"""Array and FFT libraries for the solver: arrays of NumPy, PyTorch or CuPy through the array standard, and their FFTs.

The solvers are written once, against the array standard [1]_.  What it leaves out stands here: FFTs that pad and
overwrite, and gathering and scattering on the cells in contact.  All that comes from and goes to the user is NumPy's.

.. [1] Python array API standard, https://data-apis.org/array-api/.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from viscofric.arguments import whole_number
from viscofric.contact.arrays.transforms import DuccTransforms, ScipyTransforms, Transforms
from viscofric.errors import InputError, not_imported, wrong_argument
from viscofric.showing import Shown
from viscofric.threads import THREADS, in_parts, usable_threads

#: An array of whichever library the backend has.
AnyArray: TypeAlias = Any


Result = TypeVar("Result")

_ON_NUMPY = ("scipy", "ducc0")
_OTHERS = ("torch", "cupy", "array_api_strict")
_HOW_TO_INSTALL = {
    "ducc0": "python -m pip install ducc0",
    "torch": "PyTorch for your machine, see https://pytorch.org/get-started",
    "cupy": "CuPy for your CUDA, see https://docs.cupy.dev/en/stable/install.html",
    "array_api_strict": "python -m pip install array-api-strict",
}
_KNOWN = "'scipy', 'ducc0', 'cupy', or 'torch', which may name a device, as in 'torch:cuda'"


@dataclass(frozen=True)
class Backend(Shown):
    """Arrays and FFTs with which contacts are solved.

    Parameters
    ----------
    name : str
        On NumPy arrays, with the FFTs of that library: "scipy" or "ducc0".  On arrays of the library, and of
        its FFTs: "cupy", or "torch", if need be with a device, as in "torch:cuda"; all in double precision.
        "array_api_strict" shows that the array standard is kept to, slowly.
    threads : int, optional
        Of the work on large NumPy arrays; if not given, the number in the environment variable VISCOFRIC_FFT_THREADS,
        otherwise one for each processor that this process may use, no more than OMP_NUM_THREADS.

    Raises
    ------
    InputError
        If there is no such library or device, or the number of threads cannot be used.

    Notes
    -----
    The CPU threads of PyTorch are PyTorch's to set (``torch.set_num_threads``).

    Examples
    --------
    >>> import viscofric as vf
    >>> vf.contact.Backend("scipy", threads=2)
    Backend(name: scipy; threads: 2)
    """

    name: str = "scipy"
    threads: int | None = None

    def __post_init__(self) -> None:
        if self._library not in (*_ON_NUMPY, *_OTHERS):
            raise wrong_argument("backend", self.name, f"not known; give {_KNOWN}.", "unknown-backend")
        if ":" in self.name and self._library != "torch":
            raise InputError(
                f"backend = {self.name!r}: {self._library} takes no device; give {self._library!r}.", code="no-device"
            )
        if self.threads is not None and self._library not in _ON_NUMPY:
            raise InputError(
                f"threads = {self.threads!r}: is for NumPy arrays, not for {self._library}.", code="no-threads"
            )
        if self.threads is not None:
            whole_number(self.threads, "threads", 1, right=THREADS)
        _ = self.device, self.xp, self.transforms  # now rather than in the middle of a solve

    def __reduce__(self) -> tuple[Any, ...]:
        return Backend, (self.name, self.threads)

    @classmethod
    def of(cls, backend: Backend | str) -> Backend:
        """Return the backend of a name, or the backend itself."""
        return backend if isinstance(backend, Backend) else cls(backend)

    @cached_property
    def _library(self) -> str:
        return str(self.name).partition(":")[0]

    @cached_property
    def _is_strict(self) -> bool:
        return self._library == "array_api_strict"

    @property
    def _device_name(self) -> str:
        return self.name.partition(":")[2]

    @cached_property
    def xp(self) -> Any:
        """Namespace of the array standard."""
        if self._library in _ON_NUMPY:
            return importlib.import_module("array_api_compat.numpy")
        module = self._imported(self._library)
        return (
            module
            if self._library == "array_api_strict"
            else importlib.import_module(f"array_api_compat.{self._library}")
        )

    @cached_property
    def transforms(self) -> Any:
        """FFTs of these arrays."""
        threads = self.threads or usable_threads()
        if self._library == "scipy":
            return ScipyTransforms(self._imported("scipy.fft"), threads)
        if self._library == "ducc0":
            return DuccTransforms(self._imported("ducc0.fft"), threads)
        return Transforms(self.xp.fft)

    @cached_property
    def device(self) -> Any:
        """Device of PyTorch's arrays; None for the only one, or the current one, of other libraries."""
        if self._library == "cupy" and not self._imported("cupy").is_available():
            raise InputError(
                "backend = 'cupy': CuPy finds no GPU here; choose another backend, such as 'scipy'.", code="no-device"
            )
        return _torch_device(self._imported("torch"), self._device_name) if self._library == "torch" else None

    def _imported(self, module: str) -> Any:
        try:
            return importlib.import_module(module)
        except Exception as error:
            why = not_imported(module.partition(".")[0], error, _HOW_TO_INSTALL[self._library])
            raise wrong_argument("backend", self.name, f"{why}.", "not-installed") from error

    @cached_property
    def is_numpy(self) -> bool:
        """Whether arrays are NumPy's; corrections are in single precision then."""
        return self._library in _ON_NUMPY

    def asarray(self, values: Any) -> AnyArray:
        """Move an array here, if it is not here yet; of NumPy's it may be a view."""
        if not isinstance(values, np.ndarray):
            return values
        values = np.ascontiguousarray(values)
        if self.is_numpy:
            return values
        if not values.flags.writeable:
            values = values.copy()
        return self.xp.asarray(values, device=self.device)

    def to_numpy(self, values: AnyArray) -> NDArray[Any]:
        """Move an array back to NumPy."""
        if isinstance(values, np.ndarray):
            return values
        if self._library == "torch":
            return values.cpu().numpy()  # type: ignore[no-any-return]
        if self._library == "cupy":
            return values.get()  # type: ignore[no-any-return]
        return np.from_dlpack(values)

    def floats(self, *values: Any) -> list[float]:
        """Numbers on the device as Python's, all in one transfer."""
        if self.is_numpy or self._is_strict:
            return [float(value) for value in values]
        return self.xp.stack(values).tolist()  # type: ignore[no-any-return]

    def total(self, values: AnyArray) -> Any:
        """Sum of all values; of NumPy's by their method, several times quicker on few values than the function."""
        return values.sum() if self.is_numpy else self.xp.sum(values)

    def largest(self, values: AnyArray) -> Any:
        """Largest value, likewise."""
        return values.max() if self.is_numpy else self.xp.max(values)

    def zeros(self, shape: tuple[int, ...], dtype: Any) -> AnyArray:
        """Array of zeros; of NumPy's, memory that is never written to costs nothing."""
        return self.xp.zeros(shape, dtype=dtype, device=self.device)

    def empty(self, shape: tuple[int, ...], dtype: Any) -> AnyArray:
        """Array of any values."""
        return self.xp.empty(shape, dtype=dtype, device=self.device)

    def positive_part(self, values: AnyArray) -> AnyArray:
        """max(x, 0) in place."""
        if self.is_numpy:
            return np.maximum(values, 0.0, out=values)
        values[...] = self.xp.clip(values, min=0.0)
        return values

    def reciprocal(self, values: AnyArray) -> AnyArray:
        """1/x in place where the library can."""
        return np.divide(1.0, values, out=values) if self.is_numpy else 1.0 / values

    def in_parts(self, function: Callable[..., Result], *arrays: AnyArray) -> list[Result]:
        """Call a function with parts of arrays, see `viscofric.threads.in_parts`; with all of them unless NumPy's."""
        return in_parts(function, *arrays, threads=self.threads) if self.is_numpy else [function(*arrays)]

    def with_true(self, chosen: AnyArray, indices: AnyArray) -> AnyArray:
        """Truth values of a grid, true at some of its cells as well, by their indices; may be overwritten."""
        if self._is_strict:
            xp = self.xp
            order, places = xp.arange(math.prod(chosen.shape)), xp.sort(indices)
            if indices.shape[0]:
                there = xp.clip(xp.searchsorted(places, order), max=indices.shape[0] - 1)
                chosen = chosen | xp.reshape(xp.take(places, there) == order, chosen.shape)
            return chosen
        self.xp.reshape(chosen, (-1,))[indices] = True
        return chosen

    def cells(self, chosen: AnyArray) -> Cells:
        """Cells at which an array of truth values is true."""
        (indices,) = self.xp.nonzero(self.xp.reshape(chosen, (-1,)))
        return (
            Cells(self, chosen, indices) if self._library != "array_api_strict" else MaskedCells(self, chosen, indices)
        )


class Cells:
    """Some of the cells of a grid: values on them are gathered from fields, and scattered into fields.

    `chosen` is (nx, ny), `indices` (n,) those of the chosen cells among all.
    """

    def __init__(self, backend: Backend, chosen: AnyArray, indices: AnyArray) -> None:
        self.backend, self.chosen, self.indices = backend, chosen, indices
        self._field: AnyArray = None

    def __len__(self) -> int:
        return int(self.indices.shape[0])

    def gathered(self, field: AnyArray) -> AnyArray:
        """Values (n,) of a field at the cells."""
        flat = self.backend.xp.reshape(field, (-1,))
        found = self.backend.in_parts(lambda some: flat[some], self.indices)
        return found[0] if len(found) == 1 else self.backend.xp.concat(found)

    def inserted(self, field: AnyArray, values: AnyArray) -> AnyArray:
        """Return a field with values put in at the cells; the field may be overwritten."""
        flat = self.backend.xp.reshape(field, (-1,))

        def insert(some: AnyArray, part: AnyArray) -> None:
            flat[some] = part

        self.backend.in_parts(insert, self.indices, values)
        return field

    def scattered(self, values: AnyArray) -> AnyArray:
        """Field of the values at the cells and of zeros elsewhere; the next call overwrites it."""
        if self._field is None or self._field.dtype != values.dtype:
            self._field = self.backend.zeros(self.chosen.shape, values.dtype)
        return self.inserted(self._field, values)


class MaskedCells(Cells):
    """The same where values are not put in by arrays of indices, which the standard does not ask for."""

    def inserted(self, field: AnyArray, values: AnyArray) -> AnyArray:
        """Return a field with values put in at the cells."""
        return self.backend.xp.where(self.chosen, self.scattered(values), field)

    def scattered(self, values: AnyArray) -> AnyArray:
        """Field of the values at the cells and of zeros elsewhere."""
        xp = self.backend.xp
        # Where each cell stands among the chosen ones; the others take any value.
        order = xp.cumulative_sum(xp.astype(xp.reshape(self.chosen, (-1,)), xp.int64)) - 1
        field = xp.reshape(xp.take(values, xp.clip(order, min=0)), self.chosen.shape)
        return xp.where(self.chosen, field, xp.zeros_like(field))


def _torch_device(torch: Any, name: str) -> Any:
    try:
        # Without a name, the one that PyTorch takes by itself.
        return torch.zeros(1, dtype=torch.float64, device=name or None).device
    except (RuntimeError, TypeError, AssertionError) as error:
        # A device that is not there, and one (such as mps) without double precision.
        raise InputError(
            f"backend = 'torch:{name}': PyTorch computes in double precision on no such device here; choose another, "
            "such as 'torch:cpu', or install PyTorch for it (https://pytorch.org/get-started).",
            code="no-device",
        ) from error
