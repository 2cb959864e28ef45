"""Solution of a contact over time: forces, depth, extents, energies and their errors."""

from __future__ import annotations

from dataclasses import dataclass, field
from os import PathLike
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.solution import LINE_NUMBERS, NUMBERS
from viscofric.datasets import DataArray, Dataset, dataset
from viscofric.errors import InputError
from viscofric.heat.result import TransientHeating
from viscofric.motion.mover import Field
from viscofric.motion.restart import Restart
from viscofric.notes import Warned
from viscofric.rheology.interface.friction import total_friction
from viscofric.showing import Plotted, Rows, Shown
from viscofric.units import Quantity, to_si

#: Geometry -> units of forces, energies and areas.
_UNITS = {"point": ("N", "J", "m2"), "line": ("N/m", "J/m", "m"), "periodic": ("Pa", "J/m2", "1")}
_AREAS = {
    "point": NUMBERS["contact_area"][1],
    "line": LINE_NUMBERS["contact_area"][1],
    "periodic": "contact area fraction",
}


@dataclass(frozen=True, eq=False)
class TransientErrors(Shown):
    """Estimated errors of a transient contact in time, absolute, each (n,) along its times.

    They include those of steps, springs or cells, merged modes and the tolerance of the contact conditions; contacts on
    waves take the points of their surface as given.  Of random contacts on waves and on cells, 97 % or more of the
    values were within their stated errors, of those on springs 99.8 % or more (benchmarks/motion).  Contact area,
    radius and edges have no stated errors.

    Attributes
    ----------
    load : array
        N, or as the solution's load.
    indentation : array
        m.
    friction_force : array
        As the load.
    energy : array
        Of the dissipated energy, J.
    balance : array
        Work minus stored and dissipated energy, J.
    """

    load: Array
    indentation: Array
    friction_force: Array
    energy: Array
    balance: Array

    def _shown(self) -> Rows:
        return (
            ("load", self.load),
            ("indentation", self.indentation, "m"),
            ("friction force", self.friction_force),
            ("energy", self.energy),
            ("balance", self.balance),
        )


@dataclass(frozen=True, eq=False)
class TransientSolution(Warned, Plotted):
    """Contact over time.

    All in SI units and along the times, (n,).  Forces, areas and energies are per length in a line contact, and per
    area (loads are mean pressures, areas fractions) in a periodic one.

    Attributes
    ----------
    time : array
        s; at a jump twice, before and after it.
    load : array
        N.
    indentation : array
        m.
    position : (n, 2) array
        m.
    temperature : array or None
        K.
    friction_force, lateral_force : array
        Force of the indenter on the material along the history's direction, and to the left of it, N: positive where
        friction opposes a motion towards the direction.
    contact_area : array
        m².
    contact_radius : array or None
        Radius of a contact that remains one disc, m.
    front, rear, half_width : array or None
        Extents of any other contact, defined as for steady contacts, m.
    work, stored, dissipated : array
        Since the start, J: work of load and friction on the material, energy stored in it, and dissipated by it; each
        computed on its own.
    errors : TransientErrors
    steps, rejected_steps : int
        Steps in time.
    interrupted : bool
        Whether the computation was interrupted; the results up to then are kept.
    method : str
        How it was solved: "springs", "grid" or "waves".
    geometry : str
        "point", "line" or "periodic".
    direction : (float, float)
        Direction of the history and of `friction_force`.
    warnings : tuple of str
        One note for each assumption that is doubtful.
    dent : array or None
        Depth of the surface under the indenter's lowest point, m: the residual indentation after a contact; None
        where it is unknown.
    heating : TransientHeating or None
        Heat, rise of temperature and isothermal friction, where requested; `temperature` then includes the rise.
    interface_friction : array or None
        Coulomb friction over the load along the direction: that given, as long as the indenter slides along it; zero at
        rest, where it is not known, and without load.  The contact is solved without its shear.
    """

    time: Array
    load: Array
    indentation: Array
    position: Array
    temperature: Array | None
    friction_force: Array
    lateral_force: Array
    contact_area: Array
    contact_radius: Array | None
    front: Array | None
    rear: Array | None
    half_width: Array | None
    work: Array
    stored: Array
    dissipated: Array
    errors: TransientErrors
    steps: int
    rejected_steps: int
    interrupted: bool
    method: str
    geometry: str
    direction: tuple[float, float]
    warnings: tuple[str, ...] = ()
    dent: Array | None = None
    heating: TransientHeating | None = None
    interface_friction: Array | None = None
    _fields: tuple[Field | None, ...] = field(default=(), repr=False)
    _restart: Restart | None = field(default=None, repr=False)

    def _shown(self) -> Rows:
        unit = {"line": "N/m", "periodic": "Pa"}.get(self.geometry, "N")
        return (
            ("time", self.time, "s"),
            ("load", self.load, unit),
            ("friction force", self.friction_force, unit),
            ("error of the friction", self.errors.friction_force, unit),
            ("viscoelastic friction", self.friction_coefficient),
            ("interface friction", self.interface_friction),
            ("indentation", self.indentation, "m"),
            ("temperature", self.temperature, "°C"),
            ("solved with", f"{self.method}, {self.steps} steps"),
            ("interrupted", self.interrupted or None),
            ("warnings", self.warnings),
        )

    @property
    def friction_coefficient(self) -> Array:
        """Friction force over load, (n,) array; zero where there is no load."""
        return self._over_load(self.friction_force)

    @property
    def friction_error(self) -> Array:
        """Error estimate of the friction coefficient, (n,) array, that of the force over the load."""
        return self._over_load(self.errors.friction_force)

    @property
    def total(self) -> Array:
        """Viscoelastic plus Coulomb friction over the load, (n,) array; `InputError` without the latter."""
        give = "solve_transient() or solve_cycle() coulomb=, or heating with coulomb"
        return total_friction(self.friction_coefficient, self.interface_friction, give)

    def _over_load(self, force: Array) -> Array:
        loaded = self.load > 0.0
        return np.where(loaded, force / np.where(loaded, self.load, 1.0), 0.0)

    @property
    def energy_imbalance(self) -> float:
        """Largest difference of work from stored and dissipated energy, over the largest of the three."""
        largest = max(float(np.abs(one).max()) for one in (self.work, self.stored, self.dissipated))
        return float(np.abs(self.errors.balance).max()) / largest if largest > 0.0 else 0.0

    @property
    def has_pressures(self) -> bool:
        """Whether pressures were kept."""
        return any(one is not None for one in self._fields)

    def pressure_at(self, time: Quantity) -> DataArray:
        """Return the pressure at one of the times.

        Parameters
        ----------
        time : float, str or pint.Quantity
            One of `time`, s; at a jump, the pressure after it.

        Returns
        -------
        xarray.DataArray
            Pa, along ``r``, or along ``x`` and ``y``, from the indenter's axis (m); its attribute ``error`` is the
            largest error by steps, Pa, within half a cell or spring of the edge perhaps more.

        Raises
        ------
        InputError
            If the pressure at that time was not kept; it is kept for all requested times.

        Notes
        -----
        The pressure next to an advancing edge shows the single time steps, far more than forces and depths: for a ball
        pressed in at a constant rate, up to 9 % of the largest pressure at an accuracy of 1e-3, and 3 % at 1e-4.
        ``error`` is the largest difference from the same contact with steps twice as long.
        """
        import xarray

        seconds = to_si(time, "s", "time")
        near = np.flatnonzero(np.isclose(self.time, seconds, rtol=1e-9, atol=1e-12 * float(np.ptp(self.time))))
        held = self._fields[int(near[-1])] if len(near) and self._fields else None
        if held is None:
            raise InputError(
                f"time = {seconds:g} s: the pressure was not kept there; ask for this time by times=[…] of "
                "solve_transient.",
                code="unknown-time",
            )
        axes = {name: (name, values, {"units": "m"}) for name, values in held.axes.items()}
        seconds = float(self.time[near[-1]])
        attributes = {"units": "Pa", "long_name": "contact pressure", "time": seconds, "error": held.error}
        return xarray.DataArray(held.pressure, coords=axes, dims=tuple(held.axes), attrs=attributes)

    def save_state(self, path: str | PathLike[str]) -> None:
        """Write the last state of the run and its results to a file, to resume it later.

        Parameters
        ----------
        path : str or path
            A file of arrays (.npz), replaced if it exists.

        Raises
        ------
        InputError
            If the contact was heated, or is one period of a cycle; such runs cannot be resumed.
        DataFileError
            If the file cannot be written, or would be too large.

        Examples
        --------
        >>> import viscofric as vf
        >>> rubber = vf.Material.standard_linear_solid(E0="1 MPa", E_inf="10 MPa", tau="10 ms")
        >>> ball, dwell = vf.Ball("10 mm"), vf.motion.History(time=[0.0, 0.1], load="1 N")
        >>> vf.motion.solve_transient(rubber, ball, dwell, times=["0.1 s"]).save_state("dwell.npz")
        >>> longer = vf.motion.History(time=[0.0, 0.1, 0.2], load=["1 N", "1 N", "3 N"])
        >>> run = vf.motion.solve_transient(rubber, ball, longer, times=["0.2 s"], resume="dwell.npz")
        >>> run.time.tolist()
        [0.1, 0.2]
        """
        from viscofric.motion.restart_files import reached, write_restart

        write_restart(path, reached(self._restart))

    def to_dataset(self) -> Dataset:
        """Return forces, depth, extents, energies and errors along ``time`` (s)."""
        force, energy, area = _UNITS[self.geometry]
        columns: dict[str, Any] = {
            "load": (self.load, force, "mean pressure" if self.geometry == "periodic" else "normal load"),
            "indentation": (self.indentation, "m", "indentation"),
            "position_x": (self.position[:, 0], "m", "position along x"),
            "position_y": (self.position[:, 1], "m", "position along y"),
            "temperature": None if self.temperature is None else (self.temperature, "K", "temperature"),
            "friction_force": (self.friction_force, force, "friction force"),
            "lateral_force": (self.lateral_force, force, "lateral force"),
            "friction_coefficient": (self.friction_coefficient, "1", "viscoelastic friction coefficient"),
            "contact_area": (self.contact_area, area, _AREAS[self.geometry]),
        }
        if self.interface_friction is not None:
            columns["interface_friction"] = self.interface_friction, "1", "friction coefficient of the interface"
            columns["total_friction"] = self.total, "1", "friction coefficient of hysteresis and interface together"
        for name in ("contact_radius", "front", "rear", "half_width"):
            values = getattr(self, name)
            words = NUMBERS[name][1] if name in NUMBERS else "contact radius"
            columns[name] = None if values is None else (values, "m", words)
        columns["dent"] = None if self.dent is None else (self.dent, "m", "depth of the surface on the axis")
        columns |= {
            "work": (self.work, energy, "work on the material"),
            "stored": (self.stored, energy, "stored energy"),
            "dissipated": (self.dissipated, energy, "dissipated energy"),
            "load_error": (self.errors.load, force, "estimated error of the load"),
            "indentation_error": (self.errors.indentation, "m", "estimated error of the indentation"),
            "friction_force_error": (self.errors.friction_force, force, "estimated error of the friction force"),
            "energy_error": (self.errors.energy, energy, "estimated error of the dissipated energy"),
            **({} if self.heating is None else self.heating.columns(force, energy)),
        }
        return dataset(
            "time",
            columns,
            coordinates={"time": (self.time, "s", "time")},
            attributes={
                "method": self.method,
                "geometry": self.geometry,
                "direction": list(self.direction),
                "interrupted": int(self.interrupted),
                "energy_imbalance": self.energy_imbalance,
            },
        )
