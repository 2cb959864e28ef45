"""Shear stress of a dry interface: measured Coulomb friction times the mean pressure of the solved contact."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array, Mask
from viscofric.contact.solution import ContactSolution
from viscofric.datasets import Dataset, dataset
from viscofric.errors import InputError, SuperpositionError
from viscofric.friction.agreement import partner
from viscofric.friction.curve_checks import CLEAR_OF_ZERO, shared_error
from viscofric.friction.curves import FrictionCurves, insist_on_curves
from viscofric.friction.shifting.collapse import Collapse, collapse
from viscofric.friction.shifting.found_shifts import found_shifts
from viscofric.friction.shifting.isotherms import friction_isotherms, nominal_temperatures
from viscofric.nominal import SAME_TEMPERATURE, nominal_rows
from viscofric.notes import Note, note_attributes
from viscofric.rheology.interface.fitting import StressTable, compare_stress_laws, fit_stress
from viscofric.rheology.interface.friction import OF_LIMIT
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.shifts.law_comparison import LawComparison
from viscofric.rheology.shifts.shift_law import LN10, ShiftLaw
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantity, positive


@dataclass(frozen=True, eq=False)
class ShearStress(Plotted):
    """Shear stress of a dry interface on its real contact area, one entry per slip speed and temperature.

    Attributes
    ----------
    speed : (n,) array
        Slip speed, m/s.
    temperature : (n,) array
        K.
    load : (n,) array
        Normal load, N (of a line contact per length, N/m).
    shear_stress, error : (n,) array
        τ_s and its standard error, Pa, from those of Coulomb friction and of the contact area's solution.
    mean_pressure : (n,) array
        Load over contact area of the solved contact, Pa.
    reference : float
        Temperature of the master curve, K.
    shift : ShiftLaw or None
        α(T) of the interface: as given, or found from the stress; None where none was found.
    found : bool
        Whether the shift factors were found.
    level_error, area_error : float
        Relative standard errors shared by the points of a temperature, and by all points.
    curves : FrictionCurves
        The measured points that were used.
    overlap : Collapse or None
        How well the shifted curves coincide; None without shift factors.
    notes : tuple of str
        Points left out and doubts, one sentence each.
    """

    speed: Array
    temperature: Array
    load: Array
    shear_stress: Array
    error: Array
    mean_pressure: Array
    reference: float
    shift: ShiftLaw | None
    found: bool
    level_error: float
    area_error: float
    curves: FrictionCurves
    overlap: Collapse | None = None
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.speed)

    def _shown(self) -> Rows:
        return (
            ("slip speed", self.speed, "m/s"),
            ("shear stress", self.shear_stress, "Pa"),
            ("its error", self.error, "Pa"),
            ("mean pressure", self.mean_pressure, "Pa"),
            ("temperature", np.unique(self.temperature), "°C"),
            ("reference", self.reference, "°C"),
            ("shift factors", "none" if self.shift is None else "found" if self.found else "given"),
            ("notes", self.notes),
        )

    @property
    def reduced_speed(self) -> Array:
        """α(T) v, m/s, (n,) array; NaN where α is not known."""
        return self._reduced(self.shift)

    def _reduced(self, shift: ShiftLaw | None) -> Array:
        if shift is None:
            return np.where(np.abs(self.temperature - self.reference) < SAME_TEMPERATURE, self.speed, np.nan)
        return np.asarray(self.speed * 10.0 ** shift.values_at(nominal_temperatures(self.temperature))[0])

    def law(self, kind: str) -> InterfaceLaw:
        """Fit a law to the shear stress, by generalised least squares of its logarithm.

        Parameters
        ----------
        kind : {"constant", "power", "eyring", "gaussian"}

        Returns
        -------
        InterfaceLaw
            With covariance.  Its shift is the one that was given; else, with several temperatures, an Arrhenius law
            fitted together with it.

        Raises
        ------
        InputError
            If the kind is unknown or the stress does not fix the constants.

        Notes
        -----
        Where the law misses the points by more than their errors, the least independent scatter that explains the
        misfit is added to them, and the covariance grows so that normal 95 % intervals are those of Student's t.
        Errors that all points of a temperature share count as `level_error` of `shear_stress` gives them, and where
        the levels of three temperatures or more scatter by clearly more, as these do (restricted likelihood).  95 %
        intervals then hold 92 to 97 % with five temperatures and 85 to 95 % with three; with errors in common of half
        the scatter of a point, which are not seen, 80 to 90 %.
        """
        found = fit_stress(kind, self._table, *self._way).law
        assert found is not None
        return found

    def compare_laws(self) -> LawComparison[InterfaceLaw]:
        """Fit every law and choose by Akaike's criterion, as laws of shift factors are chosen; see `LawComparison`.

        Raises
        ------
        InputError
            If no law can be fitted.
        """
        return compare_stress_laws(self._table, *self._way)

    @property
    def _way(self) -> tuple[ShiftLaw | None, float, bool]:
        """Return a given shift, the reference, and whether an activation energy is to be fitted."""
        given = None if self.found else self.shift
        return given, self.reference, given is None and len(nominal_rows(self.temperature)) > 1

    @cached_property
    def _table(self) -> StressTable:
        """The points with the covariance of their logarithms."""
        isotherms = friction_isotherms(_as_curves(self))
        number = np.repeat(np.arange(len(isotherms)), [len(one) for one in isotherms])
        speed, place, variance = (
            np.concatenate([getattr(one, name) for one in isotherms]) for name in ("speed", "friction", "variance")
        )
        kelvin, scale = np.array([one.temperature for one in isotherms])[number], isotherms[0].scale
        stress = scale.value(place)
        error = LN10 * scale.unit(stress) * np.sqrt(variance)
        near = scale.near(stress, error)
        pressures = float(self.mean_pressure.min()), float(self.mean_pressure.max())
        shared = (self.level_error / LN10) ** 2 * (number[:, None] == number) + (self.area_error / LN10) ** 2

        def about(some: Array) -> StressTable:
            # That of log10 of the law is the error of the stress over the law, which is above zero.
            middle = np.where(near, some, stress)
            unit = LN10 * middle
            values, own = np.log10(middle) + (stress - middle) / unit, np.diag((error / unit) ** 2)
            volume = 2.0 * float(np.sum(np.log(unit[near])))
            return replace(StressTable.of(speed, kelvin, values, own + shared, volume), pressures=pressures)

        first = about(np.maximum(stress, error))
        return replace(first, about=about) if np.any(near) else first

    def to_dataset(self, law: InterfaceLaw | None = None) -> Dataset:
        """Return the points as a labelled data set along ``point``, with units and long names.

        Parameters
        ----------
        law : InterfaceLaw, optional
            Whose shift gives the ``reduced_speed``; that of the stress without it.

        Returns
        -------
        xarray.Dataset
            ``reduced_speed`` is NaN where α is not known.  Attributes: ``reference_temperature`` (K), ``level_error``,
            ``area_error`` and ``notes``, with a law also ``law`` and ``description``.

        Raises
        ------
        InputError
            If the law is none.
        """
        reduced, reference, described = self.reduced_speed, self.reference, {}
        if law is not None:
            insist_on(law, "law", InterfaceLaw)
            described = {"law": law.title, "description": str(law)}
            reduced = self.speed if law.shift is None else self._reduced(law.shift)
            reference = self.reference if law.shift is None else law.shift.reference
        return dataset(
            "point",
            {
                "shear_stress": (self.shear_stress, "Pa", "shear stress of the interface"),
                "shear_stress_error": (self.error, "Pa", "standard error of the shear stress"),
                "mean_pressure": (self.mean_pressure, "Pa", "mean contact pressure"),
                "reduced_speed": (reduced, "m/s", "slip speed times shift factor of the interface"),
            },
            coordinates={
                "speed": (self.speed, "m/s", "slip speed"),
                "temperature": (self.temperature, "K", "temperature"),
                "load": (self.load, self.curves.load_unit, "normal load"),
            },
            attributes={
                **described,
                "reference_temperature": reference,
                "level_error": self.level_error,
                "area_error": self.area_error,
                "notes": "",
            }
            | note_attributes(self.notes),
        )


def shear_stress(
    curves: FrictionCurves,
    contacts: FrictionCurves | Iterable[ContactSolution],
    *,
    shift: ShiftLaw | None = None,
    reference: Quantity | None = None,
    level_error: float = 0.0,
    area_error: float = 0.0,
) -> ShearStress:
    """Return the shear stress of the interface, τ_s = μ_c F/A, from separated friction and solved contacts.

    Parameters
    ----------
    curves : FrictionCurves
        With Coulomb friction, as `separate` gives them.  The speed of the stress is the slip; without slip, the speed.
    contacts : FrictionCurves, or iterable of ContactSolution
        The contact of every point, at its speed, temperature and load (within 5 %): what `solve_steady` gives for
        each, or `predict_friction` for all.  The stress is μ_c times their mean pressure.
    shift : ShiftLaw or ShiftFactors, optional
        α(T) of the interface; found from the stress if left out, as `shift_friction` finds that of friction.
    reference : float, str or pint.Quantity, optional
        Temperature of the master curve, K; that of the shift, or the middle one, if left out.
    level_error : float
        Relative standard error of Coulomb friction that all points of a temperature share; see `shift_friction`.
    area_error : float
        Relative standard error of the contact areas that all points share, as from the modulus.

    Returns
    -------
    ShearStress

    Raises
    ------
    InputError
        If there is no Coulomb friction, a point has no contact, or an argument cannot be used.

    Notes
    -----
    Shear stress is the mean over the contact.  The solved area is that of a smooth surface: where the bodies touch at
    asperities only, the stress on the real area is higher, and the one found here holds for the same roughness alone.

    Examples
    --------
    >>> import numpy as np
    >>> import viscofric as vf
    >>> columns = {"speed": np.array([0.02, 0.06, 0.2]), "temperature": np.full(3, 333.15), "load": np.full(3, 25.0)}
    >>> columns |= {f"viscoelastic{name}": np.full(3, 0.02) for name in ("", "_error", "_scatter")}
    >>> columns["replicates"] = np.full(3, 9)
    >>> rubbed = {"coulomb": np.array([0.20, 0.21, 0.22]), "coulomb_error": np.full(3, 2e-3)}  # made up
    >>> solved = {"mean_pressure": np.full(3, 1e6), "mean_pressure_error": np.full(3, 1e3)}
    >>> measured, contacts = vf.FrictionCurves(**columns, **rubbed), vf.FrictionCurves(**columns, **solved)
    >>> stress = vf.friction.shear_stress(measured, contacts)
    >>> print(stress.law("power"))
    power of speed: τ = 0.2098 ± 0.0012 MPa, n = 0.0413 ± 0.0059, v₀ = 62.14 mm/s
    """
    insist_on_curves(curves, "curves")
    if curves.coulomb is None or curves.coulomb_error is None:
        raise InputError(
            "curves have no Coulomb friction with its standard error; both are found from runs of both directions of "
            "slip.",
            code="no-coulomb",
        )
    insist_on(shift, "shift", ShiftLaw, type(None), right="a law (WLF, …), ShiftFactors or None")
    level, area = shared_error(level_error, "level_error"), shared_error(area_error, "area_error")
    kelvin = None if reference is None else positive(reference, "K", "reference")
    solved = contacts if isinstance(contacts, FrictionCurves) else FrictionCurves.from_solutions(contacts)
    if solved.mean_pressure is None or solved.mean_pressure_error is None:
        raise InputError("contacts have no mean pressure; give what predict_friction() returns.", code="no-pressure")
    coulomb, coulomb_error = curves.coulomb, curves.coulomb_error
    keep, notes = _usable(curves, coulomb, coulomb_error)
    curves, coulomb, coulomb_error = curves.select(keep), coulomb[keep], coulomb_error[keep]
    rows = np.array([partner(curves, row, solved) for row in range(len(curves))])
    pressure = solved.mean_pressure[rows]
    error = np.hypot(coulomb_error * pressure, OF_LIMIT * solved.mean_pressure_error[rows] * coulomb)
    if shift is not None:
        shift = shift if kelvin is None else shift.at_reference(kelvin)
        kelvin = shift.reference
    middle = np.unique(nominal_temperatures(curves.temperature))
    found = ShearStress(
        speed=curves.speed if curves.slip is None else curves.slip,
        temperature=curves.temperature,
        load=curves.load,
        shear_stress=coulomb * pressure,
        error=error,
        mean_pressure=pressure,
        reference=float(middle[len(middle) // 2]) if kelvin is None else kelvin,
        shift=shift,
        found=shift is None,
        level_error=level,
        area_error=area,
        curves=curves,
        notes=notes,
    )
    return _with_overlap(found if shift is not None else _shifted(found, kelvin))


def _usable(curves: FrictionCurves, coulomb: Array, coulomb_error: Array) -> tuple[Mask, tuple[Note, ...]]:
    """Return which points have slip, and notes on the others and on doubts."""
    keep = np.full(len(curves), True) if curves.slip is None else curves.slip > 0.0
    error = np.where(np.isfinite(coulomb_error), coulomb_error, 0.0)
    together = np.sum(coulomb[keep]) > CLEAR_OF_ZERO * np.linalg.norm(error[keep])
    if not together and not np.any(keep & (coulomb > CLEAR_OF_ZERO * error)):
        said = "Coulomb friction with slip is not clear of zero, neither at any point nor that of all together."
        raise InputError(said, code="no-points")
    notes = []
    if curves.slip is None:
        said = "The friction curves state no slip: the slip speed is taken to be the speed, as in pure sliding."
        notes.append(Note("slip-assumed", said))
    if curves.assumption:
        said = f"Coulomb friction rests on an assumption, and so does the shear stress: {curves.assumption}"
        notes.append(Note("assumed-coulomb", said))
    if not np.all(keep):
        said = f"{np.count_nonzero(~keep)} of {len(keep)} points are left out: without slip."
        notes.append(Note("left-out", said, values={"left_out": int(np.count_nonzero(~keep))}))
    return keep, tuple(notes)


def _as_curves(stress: ShearStress) -> FrictionCurves:
    """Return the stress (Pa) as curves of friction over slip speed, for the search for shift factors."""
    curves = stress.curves
    return FrictionCurves(
        speed=stress.speed,
        temperature=stress.temperature,
        load=stress.load,
        viscoelastic=stress.shear_stress,
        viscoelastic_error=stress.error,
        viscoelastic_scatter=stress.error * np.sqrt(curves.replicates),
        replicates=curves.replicates,
        viscoelastic_freedom=curves.coulomb_freedom,
    )


def _shifted(stress: ShearStress, reference: float | None) -> ShearStress:
    """Find shift factors, where there are several temperatures and their curves overlap."""
    isotherms = friction_isotherms(_as_curves(stress))
    if len(isotherms) < 2:
        return stress
    try:
        factors, _ = found_shifts(isotherms, reference, stress.level_error)
    except SuperpositionError as error:
        said = Note("no-shift-factors", f"Shift factors of the interface were not found from shear stress: {error}")
        return replace(stress, notes=(*stress.notes, said))
    return replace(stress, shift=factors, reference=factors.reference, notes=(*stress.notes, *factors.notes))


def _with_overlap(stress: ShearStress) -> ShearStress:
    """Compare neighbouring curves over the reduced speed, where α is known."""
    decades = np.log10(stress.reduced_speed)
    known = np.isfinite(decades)
    if stress.shift is None or not np.any(known):
        return stress
    columns = nominal_temperatures(stress.temperature), decades, stress.shear_stress, stress.error
    return replace(stress, overlap=collapse(*(column[known] for column in columns)))
