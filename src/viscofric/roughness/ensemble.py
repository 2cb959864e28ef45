"""Friction on an ensemble of rough surfaces, at every speed and temperature, with confidence intervals."""

from __future__ import annotations

import functools
import math
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypedDict, Unpack

import numpy as np
import scipy.fft

from viscofric.arguments import insist_on_function
from viscofric.arrays import Array
from viscofric.contact.arrays.backend import Backend
from viscofric.contact.bodies import Layer, checked_coulomb
from viscofric.contact.coupling import SurfaceCoupling
from viscofric.contact.heated_curve import heat_columns, solve_states
from viscofric.contact.periodic.heating import ACCURACY, MEAN_LEFT_OUT, PeriodicThermalContact, insist_on_heated_surface
from viscofric.contact.periodic.solution import PeriodicSolution
from viscofric.contact.periodic.solve import solve_periodic
from viscofric.contact.periodic.surface import PeriodicSurface
from viscofric.errors import ConvergenceError, InputError, brief, wrong_argument
from viscofric.heat.heating import Heating
from viscofric.notes import Note, counted
from viscofric.processes import Workers, at_work, call_all
from viscofric.rheology.interface.friction import check_interface_heat, friction_on_area, insist_on_interface
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.material import Material, insist_on_material, unknown_frequencies
from viscofric.roughness.patches import contact_statistics
from viscofric.roughness.rough_friction import HeatedRoughFriction, RoughFriction, shear_notes, states
from viscofric.roughness.topography import Topography
from viscofric.units import Quantities, Quantity, positive


class Numbers(NamedTuple):
    """Results of one contact."""

    friction_coefficient: float
    friction_error: float
    contact_area_fraction: float
    corrected_area_fraction: float
    stretch: float
    notes: tuple[str, ...]


class OnDisk(NamedTuple):
    """A surface in a file, which every process reads for itself: each contact handed over would hold a copy."""

    path: Path
    spacing: tuple[float, float]

    def read(self) -> PeriodicSurface:
        """Return the surface."""
        return PeriodicSurface(np.load(self.path), self.spacing)


def on_disk(
    surfaces: Sequence[tuple[str, PeriodicSurface]], folder: Path
) -> list[tuple[str, PeriodicSurface | OnDisk]]:
    """Return named surfaces as files in a folder."""
    found: list[tuple[str, PeriodicSurface | OnDisk]] = []
    for name, surface in surfaces:
        path = folder / f"{len(found)}.npy"
        np.save(path, surface.z)
        found.append((name, OnDisk(path, surface.spacing)))
    return found


def solve_one(name: str, surface: PeriodicSurface | OnDisk, **call: Any) -> Numbers:
    """Solve one contact of an ensemble, in whatever process; keep its numbers."""
    return _numbers(_solution(name, surface, **call))


def _solution(name: str, surface: PeriodicSurface | OnDisk, **call: Any) -> PeriodicSolution:
    try:
        return solve_periodic(surface=surface.read() if isinstance(surface, OnDisk) else surface, **call)
    except ConvergenceError as error:
        raise error.at(f"surface {name!r} at {call['speed']:g} m/s") from None


#: Statistics of the solution that was asked for last: of heated contacts their area is needed first.
_statistics = functools.lru_cache(maxsize=1)(contact_statistics)


def _numbers(solution: PeriodicSolution) -> Numbers:
    described = _statistics(solution)
    return Numbers(
        solution.friction_coefficient,
        solution.diagnostics.friction_error,
        described.area_fraction,
        described.corrected_area_fraction,
        described.stretch,
        solution.warnings,
    )


@dataclass(frozen=True)
class _ThermalContact(PeriodicThermalContact):
    """Contact of an ensemble, of whose solutions only numbers are kept."""

    def area(self, solution: PeriodicSolution) -> float:
        """Return the corrected contact area over the nominal one."""
        return _statistics(solution).corrected_area_fraction

    def kept(self, solution: PeriodicSolution) -> Numbers:
        """Return the numbers of a solution."""
        return _numbers(solution)


def _isothermal(
    call: dict[str, Any], name: str, surface: PeriodicSurface | OnDisk, speed: float, kelvin: float, _: float
) -> PeriodicSolution:
    return _solution(name, surface, **call, speed=speed, temperature=kelvin)


def predict_heated(
    call: dict[str, Any],
    contacts: Sequence[dict[str, Any]],
    heating: Heating,
    interface: InterfaceLaw | None,
    workers: int | Workers,
    report: Callable[[int], None],
) -> tuple[list[Numbers], dict[str, Array], tuple[Note, ...]]:
    """Return numbers of all contacts at the temperature that they heat to, the columns of the heat, and notes."""
    # `contacts` have name, surface, speed and temperature each; `call` has the other arguments of `solve_periodic`.
    curves: dict[tuple[int, float, bool], list[int]] = {}
    for row, one in enumerate(contacts):
        backwards = one["speed"] < 0.0  # where a surface is another one
        curves.setdefault((id(one["surface"]), one["temperature"], backwards), []).append(row)
    solve = [functools.partial(_isothermal, call, one["name"], one["surface"]) for one in contacts]
    every = [
        _ThermalContact(call["material"], heating, one["temperature"], one["speed"], isothermal, interface)
        for one, isothermal in zip(contacts, solve, strict=True)
    ]
    with at_work(workers) as processes:
        found = solve_states([[every[row] for row in rows] for rows in curves.values()], ACCURACY, processes, report)
    order = np.argsort([row for rows in curves.values() for row in rows])
    states = [found[row] for row in order]
    notes = dict.fromkeys(note for one in states for note in one.notes if note.code == "states-beyond")
    numbers = [
        one.wanted.solution._replace(
            friction_error=one.wanted.solution.friction_error + one.wanted.friction_left,
            notes=(*one.wanted.solution.notes, *(note for note in one.notes if note.code == "rise-uncertain")),
        )
        for one in states
    ]
    return numbers, heat_columns(states), tuple(notes)


#: Of the complementarity: what the grid does to friction is a thousand times more.
_TOLERANCE = 1e-6


class PeriodicSettings(TypedDict, total=False):
    """Settings of `viscofric.contact.periodic.solve.solve_periodic` that may be passed on, by the same names."""

    direction: Sequence[float]
    coulomb: float
    layer: Layer | Quantity | None
    indenter_modulus: Quantity | None
    indenter_poisson_ratio: float
    tolerance: float
    most_products: int
    backend: Backend | str


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
    heating: Heating | None = None,
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
    heating : Heating, optional
        Thermal properties and Coulomb heat: each contact is at the temperature to which its own friction heats its
        spots, in its cold and its hot state where it has two.  With an interface, its shear stress at that temperature
        makes the Coulomb heat, and the slip is that of the heating.  Not with a layer or `coulomb`.
    **settings
        Of `solve_periodic`: `direction`, `coulomb`, `layer`, `indenter_modulus`, `indenter_poisson_ratio`, `tolerance`
        (1e-6 if left out), `most_products` and `backend`.

    Returns
    -------
    RoughFriction
        With heating `HeatedRoughFriction`.

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
    >>> bool(lower[0, 0] < found.mean_friction_coefficient[0, 0] < upper[0, 0])
    True
    """
    insist_on_material(material)
    if unknown := settings.keys() - PeriodicSettings.__annotations__.keys():
        raise TypeError(f"predict_rough_friction() got an unexpected keyword argument {min(unknown)!r}")
    named = _named(surfaces)
    velocities, kelvins = states(speeds, temperatures)
    insist_on_function(progress, "progress")
    load = positive(pressure, "Pa", "pressure")
    if interface is not None:
        insist_on_interface(interface)
    layer = Layer.of(settings.get("layer"))
    call: dict[str, Any] = {"material": material, "pressure": load, "tolerance": _TOLERANCE, **settings, "layer": layer}
    total = len(kelvins) * len(velocities) * len(named)
    if heating is not None:
        total *= 2
        for speed in velocities:
            known = None if temperatures is None else kelvins[0]
            insist_on_heated_surface(heating, material, float(speed), known, layer, call.get("coulomb", 0.0))
        check_interface_heat(heating, interface)

    def report(done: int) -> None:
        if progress is not None:
            progress(done, total)

    report(0)
    shared = _overlaps(named)  # before hours of contacts, which it does not need
    columns: dict[str, Any] = {}
    doubts: tuple[Note, ...] = ()
    with tempfile.TemporaryDirectory(prefix="viscofric-") as folder:
        each: list[tuple[str, PeriodicSurface | OnDisk]] = list(named)
        if (workers.number if isinstance(workers, Workers) else workers) != 1:
            each = on_disk(named, Path(folder))
        contacts = [
            {"name": name, "surface": surface, "speed": float(speed), "temperature": kelvin}
            for kelvin in kelvins
            for speed in velocities
            for name, surface in each
        ]
        if heating is None:
            found = call_all(solve_one, [call | one for one in contacts], workers=workers, progress=report)
        else:
            found, columns, doubts = predict_heated(call, contacts, heating, interface, workers, report)
    shape = len(kelvins), len(velocities), len(named)
    numbers: dict[str, Any] = {name: np.array([getattr(one, name) for one in found]) for name in Numbers._fields[:-1]}
    numbers = {name: column.reshape(shape) for name, column in (numbers | columns).items()}
    numbers["notes"] = (*counted([one.notes for one in found]), *unknown_frequencies(material), *shared)
    kelvin_or_nan = np.array([math.nan if kelvin is None else kelvin for kelvin in kelvins])
    if interface is not None:
        warm = kelvin_or_nan[:, None, None] + numbers.get("face_rise", np.zeros(shape))
        slip = velocities if heating is None else np.array([heating.sliding(float(one)) for one in velocities])
        numbers |= friction_on_area(interface, slip, warm, load, numbers["corrected_area_fraction"])
    if heating is not None:
        left_out = () if heating.nominal_radius is not None else (MEAN_LEFT_OUT,)
        numbers["notes"] = (*numbers["notes"], *doubts, *left_out)
    coulomb = numbers.get("interface_friction", np.full(shape, 0.0 if heating is None else heating.coulomb))
    if coulomb.any():
        coupled = [SurfaceCoupling.of(one, material.poisson_ratio, layer) for _, one in named]
        solved = checked_coulomb(call.get("coulomb", 0.0))
        both = coulomb, numbers["friction_coefficient"], numbers["corrected_area_fraction"]
        numbers["notes"] += shear_notes(*both, velocities, load, coupled, solved)
    result = RoughFriction if heating is None else HeatedRoughFriction
    return result(
        temperature=kelvin_or_nan,
        speed=velocities,
        pressure=load,
        surfaces=tuple(name for name, _ in named),
        **numbers,
    )


#: Curvatures that differ by less than this part of the second one are the same.
_SAME = 0.02
#: Part of the sum of squared curvatures that must be the same where two surfaces overlap.
_SHARED = 0.05
#: Of n points so much more, over √n: some agree by chance; independent surfaces reach 0.18 of 64 points, 0.02 of 64².
_BY_CHANCE = 1.2
#: Largest maxima of the correlation of two surfaces that are tried as their distance.
_TRIED = 4


def _overlaps(surfaces: Sequence[tuple[str, PeriodicSurface]]) -> tuple[Note, ...]:
    """Return a note if surfaces seem to have heights in common, as overlapping pieces of one scan do."""
    # So do surfaces made of equal caps or dimples, some of which always coincide: hence "seem".
    curvatures = [_curvature(surface.z) for _, surface in surfaces]
    pairs = [
        (first, second)
        for second, (_, other) in enumerate(surfaces)
        for first, (_, one) in enumerate(surfaces[:second])
        if np.allclose(one.spacing, other.spacing, rtol=1e-9, atol=0.0)
        and _in_common(curvatures[first], curvatures[second])
    ]
    if not pairs:
        return ()
    count, (first, second) = len(surfaces) * (len(surfaces) - 1) // 2, pairs[0]
    said = (
        f"{len(pairs)} of {count} pairs of surfaces seem to have heights in common, such as numbers {first + 1} and "
        f"{second + 1} ({surfaces[first][0]!r} and {surfaces[second][0]!r}): the interval counts surfaces as "
        "independent, and is then too narrow; give independent surfaces, such as pieces of a scan that do not overlap."
    )
    values = {"pairs": len(pairs), "of": count, "first": first + 1, "second": second + 1}
    return (Note("overlapping-surfaces", said, values=values),)


def _curvature(heights: Array) -> Array:
    """Return differences of heights to those around them, which levelling hardly changes."""
    axes = [axis for axis in range(2) if heights.shape[axis] > 1]
    return np.asarray(sum(np.roll(heights, 1, axis) + np.roll(heights, -1, axis) - 2.0 * heights for axis in axes))


def _in_common(one: Array, other: Array) -> bool:
    """Whether curvatures of two surfaces agree after some shift, over part of the smaller one and beyond chance."""
    if one.size < other.size:
        one, other = other, one
    shape = np.maximum(one.shape, other.shape)
    first, second = (np.pad(each, list(zip((0, 0), shape - each.shape, strict=True))) for each in (one, other))
    product = scipy.fft.rfft2(first) * np.conj(scipy.fft.rfft2(second))
    correlation = scipy.fft.irfft2(product, tuple(shape)).ravel()
    power = np.square(second)
    least = (_SHARED + _BY_CHANCE / math.sqrt(other.size)) * power.sum()

    def shared(shift: Any) -> float:
        same = np.abs(np.roll(first, shift, (0, 1)) - second) <= _SAME * np.abs(second)
        return float(power.sum(where=same))

    tried = min(_TRIED, len(correlation))
    places = np.argpartition(correlation, -tried)[-tried:]
    places = places[correlation[places] > least]
    shifts = -np.transpose(np.unravel_index(places, tuple(shape)))
    # Heights in coarse steps agree at any shift.
    return any(shared(shift) - shared(shift + 5) > least for shift in shifts)


def _named(surfaces: object) -> list[tuple[str, PeriodicSurface]]:
    each = [surfaces] if isinstance(surfaces, (Topography, PeriodicSurface)) else surfaces
    if not isinstance(each, Sequence) or not each:
        raise wrong_argument(
            "surfaces", surfaces, "must be a Topography or PeriodicSurface, or a list of them.", "wrong-type"
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
    for place, (name, one) in enumerate(found, 1):
        for earlier, (_, other) in enumerate(found[: place - 1], 1):
            if one.spacing == other.spacing and np.array_equal(one.z, other.z):
                problem = f"surfaces: number {place} ({name!r}) has the heights of number {earlier}; give each surface "
                raise InputError(f"{problem}once, since the interval counts them as independent.", code="same-surface")
    return found
