"""Figures of rough surfaces: heights, power spectra, contact pressure, and friction by wavelength."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from viscofric.report.figures.contact import draw_arrow, highest_shown
from viscofric.report.figures.style import INK, Look, decade_ticks, heat_map, looks, speed_ticks, unit_for
from viscofric.units import shown_celsius

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh

    from viscofric.arrays import Array
    from viscofric.contact.periodic.solution import PeriodicSolution
    from viscofric.roughness.patches import FrictionByWavelength
    from viscofric.roughness.persson import PerssonTheory
    from viscofric.roughness.rough_friction import RoughFriction
    from viscofric.roughness.spectrum import PowerSpectrum
    from viscofric.roughness.topography import Topography


_DASHES = ("-", "--", ":", "-.")
#: More points along an edge than this do not show; maps draw every n-th.
_MOST_POINTS = 512


def plot_topography(axes: Axes, topography: Topography) -> tuple[QuadMesh, str]:
    """Draw the heights of a surface seen from above; points without a reading stay blank.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    topography : Topography

    Returns
    -------
    mesh : matplotlib.collections.QuadMesh
    label : str
        For the colour bar of the mesh.
    """
    every = math.ceil(max(topography.shape) / _MOST_POINTS)
    z = topography.heights[::every, ::every] - np.nanmean(topography.heights)
    unit, depth = unit_for(max(topography.size)), unit_for(float(np.nanmax(np.abs(z))) or 1.0)
    x, y = (places[::every] / unit.size for places in (topography.x, topography.y))
    mesh = heat_map(axes, x, y, np.ma.masked_invalid(z / depth.size), "cividis")
    axes.set(xlabel=f"$x$ ({unit.name})", ylabel=f"$y$ ({unit.name})")
    return mesh, f"height above the mean ({depth.name})"


def plot_line_scan(axes: Axes, topography: Topography) -> None:
    """Draw the heights of a line scan, or of the first line along x of a map, over their position."""
    z = topography.heights[:, 0] - np.nanmean(topography.heights[:, 0])
    unit, depth = unit_for(topography.size[0]), unit_for(float(np.nanmax(np.abs(z))) or 1.0)
    axes.plot(topography.x / unit.size, z / depth.size, color=INK, linewidth=0.9)
    axes.set(xlabel=f"$x$ ({unit.name})", ylabel=f"height ({depth.name})")
    axes.margins(x=0.0)


def plot_contact_map(axes: Axes, solution: PeriodicSolution) -> tuple[QuadMesh, str]:
    """Draw where a rough surface touches, and with which pressure; an arrow shows where it goes.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    solution : PeriodicSolution

    Returns
    -------
    mesh : matplotlib.collections.QuadMesh
    label : str
        For the colour bar of the mesh.
    """
    mesh, label = plot_pressure_of_period(axes, solution.x, solution.y, solution.pressure)
    if solution.speed != 0.0:
        sense = math.copysign(1.0, solution.speed)
        mark_motion(axes, (sense * solution.direction[0], sense * solution.direction[1]))
    return mesh, label


def plot_pressure_of_period(
    axes: Axes, x: Array, y: Array, pressure: Array, *, highest: float | None = None
) -> tuple[QuadMesh, str]:
    """Draw the pressure (nx, ny), Pa, on a period; colours end at `highest`, or at 99.5 % of the loaded points."""
    every = math.ceil(max(pressure.shape) / _MOST_POINTS)
    # Contact patches are small: of n² points the highest pressure is drawn.
    shape = tuple(n // every for n in pressure.shape)
    merged = pressure[: shape[0] * every, : shape[1] * every]
    merged = merged.reshape(shape[0], every, shape[1], every).max(axis=(1, 3))
    unit, ends = unit_for(float(x[-1])), highest_shown(merged) if highest is None else highest
    size = unit_for(float(pressure.max()) if highest is None else highest, "Pa")
    along, across = x[: shape[0] * every : every] / unit.size, y[: shape[1] * every : every] / unit.size
    shown = np.ma.masked_equal(merged / size.size, 0.0)
    mesh = heat_map(axes, along, across, shown, "viridis", vmin=0.0, vmax=ends / size.size)
    axes.set(xlabel=f"$x$ ({unit.name})", ylabel=f"$y$ ({unit.name})")
    return mesh, f"pressure ({size.name})"


def mark_motion(axes: Axes, direction: tuple[float, float]) -> None:
    """Draw an arrow in the upper left corner along a unit vector."""
    reach = 0.06 * direction[0], 0.06 * direction[1]
    draw_arrow(axes, (0.1 - reach[0], 0.92 - reach[1]), (0.1 + reach[0], 0.92 + reach[1]))


def plot_power_spectra(axes: Axes, spectra: Mapping[str, PowerSpectrum]) -> None:
    """Draw power spectra over the wave number, with wavelengths along the top."""
    for look, (name, spectrum) in zip(looks(len(spectra)), spectra.items(), strict=True):
        marker = look.marker if len(spectrum.wave_number) <= 60 else ""
        style: dict[str, Any] = {"color": look.colour, "linestyle": look.dashes, "marker": marker, "markersize": 3.5}
        axes.loglog(spectrum.wave_number, spectrum.density, label=name, **style)
    axes.set(xlabel="wave number $q$ (rad/m)", ylabel=r"$C(q)$ (m$^4$)")
    axes.tick_params(which="both", top=False)
    for axis in (axes.xaxis, axes.yaxis):
        decade_ticks(axis)
    above = axes.secondary_xaxis("top", functions=(_turned, _turned))
    above.set_xlabel("wavelength (m)")
    if len(spectra) > 1:
        axes.legend()


def _turned(value: Any) -> Any:
    """Return the wavelength of a wave number, or the other way round."""
    with np.errstate(divide="ignore"):
        return np.asarray(2.0 * np.pi / np.asarray(value, dtype=float))


def plot_friction_by_wavelength(axes: Axes, parts: Mapping[str, FrictionByWavelength]) -> None:
    """Draw what the waves of each length add to the friction coefficient, per decade of wavelength.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    parts : mapping of str to FrictionByWavelength
        By what the legend calls them.
    """
    for look, (name, part) in zip(looks(len(parts)), parts.items(), strict=True):
        per_decade = part.contribution / np.log10(part.edges[:-1] / part.edges[1:])
        axes.stairs(per_decade[::-1], part.edges[::-1], color=look.colour, linestyle=look.dashes, label=name)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0.0)
    axes.set(xlabel="wavelength (m)", ylabel="friction per decade of wavelength")
    decade_ticks(axes.xaxis)
    if len(parts) > 1:
        axes.legend()


def plot_rough_friction(
    axes: Axes,
    found: RoughFriction | Mapping[str, RoughFriction],
    theories: Mapping[str, PerssonTheory] | None = None,
    *,
    area: bool = False,
) -> None:
    """Draw friction on ensembles of surfaces over the speed: the mean, its 95 % interval, and the theory beside it.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    found : RoughFriction, or mapping of str to them
        Several by what the legend calls them, such as "isothermal" and "heated".
    theories : mapping of str to PerssonTheory, optional
        By what the legend calls them; for the same temperatures.  Lines have the colour of the ensemble whose name is
        part of theirs, else that of the first.
    area : bool
        Whether to draw the corrected contact area fraction instead, without an interval.
    """
    several = found if isinstance(found, Mapping) else {"": found}
    rows = max(len(one.temperature) for one in several.values())
    places = [(name, row) for name in several for row in range(rows)]
    dashes = dict.fromkeys(places, 0)
    look_of = dict(zip(places, looks(len(places)), strict=True))
    for (name, row), look in look_of.items():
        _plot_solved(axes, several[name], row, look, f", {name}" if name else "", area=area)
    for title, theory in (theories or {}).items():
        name = next((each for each in several if each in title), next(iter(several)))
        for row in range(rows):
            values = theory.contact_area_fraction if area else theory.friction_coefficient
            dash = _DASHES[dashes[name, row] % len(_DASHES)]
            label = title + _where(theory.temperature[row])
            axes.plot(theory.speed, values[row], color=look_of[name, row].colour, linestyle=dash, label=label)
            dashes[name, row] += 1
    axes.set(xscale="log", ylim=(0.0, None), xlabel="speed (m/s)")
    axes.set_ylabel("contact area over nominal area" if area else "friction coefficient")
    speed_ticks(axes.xaxis)
    axes.legend()


def _plot_solved(axes: Axes, found: RoughFriction, row: int, look: Look, name: str, *, area: bool) -> None:
    """Draw the mean over the surfaces at one temperature, of friction with its 95 % interval."""
    count = len(found.surfaces)
    label = f"solved{name}" + (f", {count} surfaces" if count > 1 else "") + _where(found.temperature[row])
    mean = (found.mean_area if area else found.mean_friction_coefficient)[row]
    axes.plot(found.speed, mean, marker=look.marker, color=look.colour, linestyle="none", label=label)
    if count > 1 and not area:
        lower, upper = found.interval()
        axes.fill_between(found.speed, lower[row], upper[row], color=look.colour, alpha=0.25, linewidth=0.0)


def _where(kelvin: float) -> str:
    """Return what the legend says of a temperature, if one is known."""
    return "" if math.isnan(kelvin) else f", {shown_celsius(float(kelvin), 'z.4g')} °C"
