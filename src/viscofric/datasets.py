"""Results as labelled data sets, each number with its unit and its name, and values as JSON can hold them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import xarray

#: For annotations; xarray itself takes long to import.
Dataset: TypeAlias = "xarray.Dataset"
DataArray: TypeAlias = "xarray.DataArray"
DataTree: TypeAlias = "xarray.DataTree"
#: Above this power of ten, powers of ten are not exact floats.
_EXACT = 22


def dataset(
    dimension: str | tuple[str, ...],
    columns: Mapping[str, tuple[Any, str, str] | None],
    *,
    coordinates: Mapping[str, tuple[Any, str, str]] | None = None,
    attributes: Mapping[str, Any] | None = None,
) -> Dataset:
    """Return columns along one dimension (or several) as a data set with units and long names.

    A column is (values, unit, long name), or None to be left out.  Values with fewer axes than there are dimensions lie
    along the first of them; single numbers along none.  Coordinates lie along `dimension` or, under a dimension's own
    name, along that dimension.
    """
    import numpy as np
    import xarray

    dimensions = (dimension,) if isinstance(dimension, str) else dimension

    def variable(name: str, entry: tuple[Any, str, str]) -> Any:
        values, unit, long_name = entry
        array = np.asarray(values)
        along = (name,) if name in dimensions else dimensions[: array.ndim]
        return along, array, {"units": unit, "long_name": long_name}

    return xarray.Dataset(
        {name: variable(name, entry) for name, entry in columns.items() if entry is not None},
        {name: variable(name, entry) for name, entry in (coordinates or {}).items()},
        {name: value for name, value in (attributes or {}).items() if value is not None},
    )


def on_grid(points: Dataset, *names: str) -> Dataset | None:
    """Return points along one dimension on the grid of some of their coordinates; None if they do not fill one."""
    import numpy as np

    (dimension,), count = points.sizes, next(iter(points.sizes.values()))
    axes, places = zip(*(np.unique(points[name].values, return_inverse=True) for name in names), strict=True)
    shape = tuple(map(len, axes))
    place = np.ravel_multi_index(places, shape) if count else np.empty(0, dtype=int)
    if math.prod(shape) != count or len(np.unique(place)) < count:
        return None
    ordered = points.isel({dimension: np.argsort(place)})
    variables = {
        name: (names, column.values.reshape(shape), column.attrs)
        for name, column in ordered.variables.items()
        if name not in names
    }
    kept = {name: (name, axis, points[name].attrs) for name, axis in zip(names, axes, strict=True)}
    found = {name: variables.pop(name) for name in points.coords if name in variables}
    return type(points)(variables, kept | found, points.attrs)


def record(data: Dataset, digits: int | None = None) -> dict[str, Any]:
    """Return a data set as JSON can hold it: its attributes, each variable as a list, and ``units`` by name.

    Floats have so many significant `digits`, or all; what is not finite becomes None.
    """
    columns = {str(name): plain(variable.values, digits) for name, variable in data.variables.items()}
    units = {str(name): variable.attrs["units"] for name, variable in data.variables.items() if variable.attrs}
    return {str(name): plain(value, digits) for name, value in data.attrs.items()} | columns | {"units": units}


def plain(value: Any, digits: int | None = 6) -> Any:
    """Return dicts, lists, arrays, scalars, text, None and paths as JSON can hold them.

    Floats have so many significant `digits`, or all; what is not finite becomes None.
    """
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, float):
        return _rounded(value, digits)
    if isinstance(value, Mapping):
        return {str(key): plain(entry, digits) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        if value and all(type(entry) is float for entry in value):
            import numpy as np

            return _of_array(np.array(value), digits)
        return [plain(entry, digits) for entry in value]
    if hasattr(value, "__array__"):
        import numpy as np

        return _of_array(np.asarray(value), digits)
    if isinstance(value, (set, frozenset)):
        return [plain(entry, digits) for entry in sorted(value)]
    return str(value)


def _rounded(value: float, digits: int | None) -> float | None:
    if not math.isfinite(value):
        return None
    return float(value) if digits is None else float(f"{value:.{digits}g}")


def _of_array(values: Any, digits: int | None) -> Any:
    import numpy as np

    if values.dtype.kind != "f":
        return plain(values.tolist(), digits)
    values = values.astype(float)
    finite = np.isfinite(values)
    if digits is not None:
        values = _significant(np.where(finite, values, 0.0), digits)
    if finite.all():
        return values.tolist()
    shown: Any = np.array(values, dtype=object)
    shown[~finite] = None
    return shown.tolist()


def _significant(values: Any, digits: int) -> Any:
    """Round to significant digits, so that the shortest way of writing the results has no more."""
    import numpy as np

    size = np.abs(values)
    power = digits - 1 - np.floor(np.log10(np.where(size > 0.0, size, 1.0)))
    if np.any(np.abs(power) > _EXACT):
        return np.vectorize(partial(_rounded, digits=digits), otypes=[float])(values)
    # multiplied and divided by exact powers only: 123457 / 1e-3 would not be 123457000
    up, down = 10.0 ** np.maximum(power, 0.0), 10.0 ** np.maximum(-power, 0.0)
    return np.round(values * up / down) / up * down
