"""Friction on an ensemble of rough surfaces, at every speed and temperature, with confidence intervals."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import NormalDist
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypedDict, Unpack

import numpy as np

from viscofric.arguments import insist_on_function
from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.datasets import dataset
from viscofric.errors import ConvergenceError, InputError, brief, check_choice
from viscofric.processes import Workers, call_all
from viscofric.rheology.interface.friction import friction_on_area, insist_on_interface
from viscofric.rheology.material import Material, insist_on_material
from viscofric.roughness.patches import contact_statistics
from viscofric.roughness.topography import Topography
from viscofric.units import Quantities, Quantity, positive, share, to_si_array

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray

    from viscofric.arrays import Array
    from viscofric.contact.arrays.backend import Backend
    from viscofric.contact.bodies import Layer
    from viscofric.rheology.interface.law import InterfaceLaw


#: Of the complementarity: what the grid does to friction is a thousand times more.
_TOLERANCE = 1e-6


class PeriodicSettings(TypedDict, total=False):
    """Settings of `viscofric.contact.periodic.solve.solve_periodic` that may be passed on, by the same names."""

    direction: Sequence[float]
    coulomb: float
    layer: Layer | None
    indenter_modulus: Quantity | None
    indenter_poisson_ratio: float
    tolerance: float
    most_products: int
    backend: Backend | str


@dataclass(frozen=True, eq=False)
class RoughFriction:
    """Friction and contact area on several rough surfaces, over temperatures and speeds.

    Attributes
    ----------
    temperature : (m,) array
        K; NaN where none was given: a material with a shift is then at its reference.
    speed : (n,) array
        m/s.
    pressure : float
        Nominal, Pa.
    surfaces : tuple of str
        Names of the k surfaces.
    friction_coefficient : (m, n, k) array
        For every temperature, speed and surface.
    friction_error : (m, n, k) array
        Estimated error that the grid makes in each; see `PeriodicDiagnostics.friction_error`.
    contact_area_fraction : (m, n, k) array
        Points under pressure over all.
    corrected_area_fraction : (m, n, k) array
        The same, corrected for the excess of counted points; see `ContactStatistics`.
    stretch : (m, n, k) array
        How many times longer the contact patches are along the motion than across; see `ContactStatistics`.
    interface_friction, interface_error : (m, n, k) array or None
        With an interface, its friction τ_s A/F on the corrected area, and the standard error due to the law.
    notes : tuple of str
        On the interface, one sentence each.
    """

    temperature: Array
    speed: Array
    pressure: float
    surfaces: tuple[str, ...]
    friction_coefficient: Array
    friction_error: Array
    contact_area_fraction: Array
    corrected_area_fraction: Array
    stretch: Array
    interface_friction: Array | None = None
    interface_error: Array | None = None
    notes: tuple[str, ...] = ()

    @property
    def total(self) -> Array:
        """Friction coefficient of hysteresis and interface, (m, n, k) array; InputError without an interface."""
        if self.interface_friction is None:
            raise InputError(
                "there is no interfacial friction; give predict_rough_friction() an interface.", code="no-interface"
            )
        return self.friction_coefficient + self.interface_friction

    @property
    def mean_friction(self) -> Array:
        """Mean friction coefficient over the surfaces, (m, n) array."""
        return np.asarray(self.friction_coefficient.mean(axis=-1))

    @property
    def mean_area(self) -> Array:
        """Mean corrected contact area fraction over the surfaces, (m, n) array."""
        return np.asarray(self.corrected_area_fraction.mean(axis=-1))

    def interval(
        self, probability: float = 0.95, *, of: Literal["hysteresis", "total"] = "hysteresis"
    ) -> tuple[Array, Array]:
        """Return the confidence interval of the mean friction of all such surfaces.

        By Student's t, for friction that scatters normally from surface to surface.  That of the total also has the
        error of the law of the interface, which all surfaces share.  The error of the grid is not included.

        Parameters
        ----------
        probability : float
            Between 0 and 1.
        of : {"hysteresis", "total"}

        Returns
        -------
        lower, upper : (m, n) array

        Raises
        ------
        InputError
            If there is one surface only, the probability is out of range, or there is no interface.
        """
        check_choice(of, "of", "hysteresis", "total")
        if of == "hysteresis":
            return interval_of_mean(self.friction_coefficient, probability)
        mean, (lower, _) = self.total.mean(axis=-1), interval_of_mean(self.total, probability)
        assert self.interface_error is not None
        shared = NormalDist().inv_cdf(0.5 + 0.5 * probability) * self.interface_error.mean(axis=-1)
        half = np.hypot(mean - lower, shared)
        return mean - half, mean + half

    def to_dataset(self) -> xarray.Dataset:
        """Return everything over temperature, speed and surface, with the nominal pressure as an attribute."""
        names = {
            "friction_coefficient": "friction coefficient",
            "friction_error": "estimated error of the friction coefficient",
            "contact_area_fraction": "points under pressure over all",
            "corrected_area_fraction": "real over nominal contact area",
            "stretch": "length of contact patches along over across the motion",
            "interface_friction": "friction coefficient of the interface",
            "interface_error": "standard error of the friction coefficient of the interface",
        }
        return dataset(
            ("temperature", "speed", "surface"),
            {
                name: (getattr(self, name), "1", long_name)
                for name, long_name in names.items()
                if getattr(self, name) is not None
            },
            coordinates={
                "temperature": (self.temperature, "K", "temperature"),
                "speed": (self.speed, "m/s", "sliding speed"),
                "surface": (list(self.surfaces), "1", "name of the surface"),
            },
            attributes={"pressure": self.pressure} | ({"notes": "\n".join(self.notes)} if self.notes else {}),
        )


def interval_of_mean(found: Array, probability: float = 0.95) -> tuple[Array, Array]:
    """Return lower and upper limit (...) of the confidence interval of the mean over all surfaces of a kind.

    By Student's t, for values `found` (..., k) on k surfaces that scatter normally.  Raises InputError if there is one
    surface only, or the probability is not between 0 and 1.
    """
    from scipy.special import stdtrit

    wanted, count = share(probability, "probability", example=0.95), found.shape[-1]
    if count < 2:
        raise InputError(
            "interval: needs two surfaces at least, since it rests on the scatter from surface to surface.",
            code="one-surface",
        )
    mean = found.mean(axis=-1)
    reach = float(stdtrit(count - 1, 0.5 + 0.5 * wanted)) * found.std(axis=-1, ddof=1) / math.sqrt(count)
    return mean - reach, mean + reach


def predict_rough_friction(
    material: Material,
    surfaces: Topography | PeriodicSurface | Sequence[Topography | PeriodicSurface],
    *,
    speeds: Quantities,
    pressure: Quantity,
    temperatures: Quantities | None = None,
    interface: InterfaceLaw | None = None,
    workers: int | Workers = 1,
    progress: Callable[[int, int], object] | None = None,
    **settings: Unpack[PeriodicSettings],
) -> RoughFriction:
    """Solve the contact on every one of several rough surfaces at every speed and temperature.

    Parameters
    ----------
    material : Material
    surfaces : Topography, PeriodicSurface, or a list of them
        Periodic; an ensemble is, for instance, ``[vf.self_affine(…, seed=seed) for seed in range(8)]``.
    speeds : float, str, pint.Quantity, or an array or list of them
        Of sliding, m/s; at rest the contact is elastic.
    pressure : float, str or pint.Quantity
        Nominal pressure, Pa.
    temperatures : float, str, pint.Quantity, or an array or list of them, optional
        K if plain numbers; may be left out for a material without a shift.
    interface : InterfaceLaw, optional
        Shear stress of the dry interface on the real contact area, such as from `ShearStress.law`: adds its friction.
        That area depends on the shortest wavelength of the surface, and so does this friction.
    workers : int or Workers
        Processes among which the contacts are distributed; the result is the same to the last digit.
    progress : callable, optional
        Called as ``progress(done, total)`` before the first and after every contact.
    **settings
        Of `solve_periodic`: `direction`, `coulomb`, `layer`, `indenter_modulus`, `indenter_poisson_ratio`, `tolerance`
        (1e-6 if left out), `most_products` and `backend`.

    Returns
    -------
    RoughFriction

    Raises
    ------
    InputError
        If a value cannot be used.
    ConvergenceError
        If a contact cannot be solved; it is named.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="1 ms")
    >>> roads = [
    ...     vf.self_affine(0.8, shape=(64, 64), spacing="10 um", shortest="80 um", rms_slope=0.1, seed=seed)
    ...     for seed in range(3)
    ... ]
    >>> found = vf.predict_rough_friction(rubber, roads, speeds="0.1 m/s", pressure="20 kPa")
    >>> lower, upper = found.interval()
    >>> bool(lower[0, 0] < found.mean_friction[0, 0] < upper[0, 0])
    True
    """
    insist_on_material(material)
    if unknown := settings.keys() - PeriodicSettings.__annotations__.keys():
        raise TypeError(f"predict_rough_friction() got an unexpected keyword argument {min(unknown)!r}")
    named = _named(surfaces)
    velocities = to_si_array(speeds, "m/s", "speeds")
    if not velocities.size:
        raise InputError("speeds must hold at least one value.", code="empty-list")
    kelvins: list[float | None] = [None]
    if temperatures is not None:
        kelvins = [positive(float(one), "K", "temperatures") for one in to_si_array(temperatures, "K", "temperatures")]
        if not kelvins:
            raise InputError("temperatures must hold at least one value.", code="empty-list")
    insist_on_function(progress, "progress")
    load = positive(pressure, "Pa", "pressure")
    if interface is not None:
        insist_on_interface(interface)
    calls: list[dict[str, Any]] = [
        {
            "name": name,
            "material": material,
            "surface": surface,
            "speed": float(speed),
            "temperature": kelvin,
            "pressure": load,
            "tolerance": _TOLERANCE,
            **settings,
        }
        for kelvin in kelvins
        for speed in velocities
        for name, surface in named
    ]

    def report(done: int) -> None:
        if progress is not None:
            progress(done, len(calls))

    report(0)
    with tempfile.TemporaryDirectory(prefix="viscofric-") as folder:
        if (workers.number if isinstance(workers, Workers) else workers) != 1:
            _put_on_disk(calls, Path(folder))
        found: list[_Numbers] = call_all(solve_one, calls, workers=workers, progress=report)
    shape = len(kelvins), len(velocities), len(named)
    numbers: dict[str, Any] = {
        name: np.array([getattr(one, name) for one in found]).reshape(shape) for name in _Numbers._fields
    }
    kelvin_or_nan = np.array([math.nan if kelvin is None else kelvin for kelvin in kelvins])
    area = numbers["corrected_area_fraction"]
    by_interface = {} if interface is None else friction_on_area(interface, velocities, kelvin_or_nan, load, area)
    return RoughFriction(
        temperature=kelvin_or_nan,
        speed=velocities,
        pressure=load,
        surfaces=tuple(name for name, _ in named),
        **numbers,
        **by_interface,
    )


class _Numbers(NamedTuple):
    """Results of one contact."""

    friction_coefficient: float
    friction_error: float
    contact_area_fraction: float
    corrected_area_fraction: float
    stretch: float


class _OnDisk(NamedTuple):
    """A surface in a file, which every process reads for itself: each contact handed over would hold a copy."""

    path: Path
    spacing: tuple[float, float]

    def read(self) -> PeriodicSurface:
        return PeriodicSurface(np.load(self.path), self.spacing)


def _put_on_disk(calls: list[dict[str, Any]], folder: Path) -> None:
    """Put a file in the place of each surface."""
    stored: dict[int, _OnDisk] = {}
    for call in calls:
        surface = call["surface"]
        if id(surface) not in stored:
            path = folder / f"{len(stored)}.npy"
            np.save(path, surface.z)
            stored[id(surface)] = _OnDisk(path, surface.spacing)
    for call in calls:
        call["surface"] = stored[id(call["surface"])]


def solve_one(name: str, surface: PeriodicSurface | _OnDisk, **call: Any) -> _Numbers:
    """Solve one contact of an ensemble, in whatever process; keep its numbers."""
    try:
        solution = solve_periodic(surface=surface.read() if isinstance(surface, _OnDisk) else surface, **call)
    except ConvergenceError as error:
        raise error.at(f"surface {name!r} at {call['speed']:g} m/s") from None
    described = contact_statistics(solution)
    return _Numbers(
        solution.friction_coefficient,
        solution.diagnostics.friction_error,
        described.area_fraction,
        described.corrected_area_fraction,
        described.stretch,
    )


def _named(surfaces: object) -> list[tuple[str, PeriodicSurface]]:
    each = [surfaces] if isinstance(surfaces, (Topography, PeriodicSurface)) else surfaces
    if not isinstance(each, Sequence) or not each:
        raise InputError(
            f"surfaces = {brief(surfaces)}: must be a Topography or PeriodicSurface, or a list of them.",
            code="wrong-type",
        )
    found = []
    for place, one in enumerate(each, 1):
        if isinstance(one, Topography):
            found.append((one.name or f"surface {place}", one.to_surface()))
        elif isinstance(one, PeriodicSurface):
            found.append((f"surface {place}", one))
        else:
            raise InputError(
                f"surfaces: number {place} is {brief(one)}, not a Topography or PeriodicSurface.", code="wrong-type"
            )
    return found
