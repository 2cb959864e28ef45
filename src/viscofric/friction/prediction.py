"""Prediction of friction at many speeds and temperatures, by solving a contact for each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Unpack, cast

import numpy as np

from viscofric.arguments import exactly_one, flag, insist_on, insist_on_function
from viscofric.arrays import Array, Mask
from viscofric.contact.bodies import Layer, checked_coulomb
from viscofric.contact.indenters.indenter import Indenter, insist_on_indenter, insist_on_round_edges
from viscofric.contact.settings import ContactOptions
from viscofric.contact.steady import solve_steady
from viscofric.errors import InputError, ViscofricError
from viscofric.files import marked
from viscofric.friction.bands import DrawnMaterials, with_material_band
from viscofric.friction.cases.record import Record, columns_of_contacts, indenter_record
from viscofric.friction.coulomb import check_interface, shear_notes, with_interface
from viscofric.friction.curves import FrictionCurves
from viscofric.friction.heating import predict_heated
from viscofric.friction.planning.shared import SharedContacts, attempt, places_of
from viscofric.friction.sensitivity import solve_with_sensitivity
from viscofric.heat.heating import Heating
from viscofric.notes import Note
from viscofric.processes import Workers, at_work, call_all, counted_from
from viscofric.rheology.catalogue import is_synthetic
from viscofric.rheology.interface.friction import check_interface_heat
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.material import Material, insist_on_material, known_at
from viscofric.rheology.uncertainty.material_samples import MaterialSamples
from viscofric.units import Quantities, Quantity, number, positive, shown_number, shown_place, to_si_array


def predict_friction(
    material: Material,
    indenter: Indenter,
    *,
    speeds: Quantities,
    temperatures: Quantities | None = None,
    load: Quantity | None = None,
    loads: Quantities | None = None,
    samples: MaterialSamples | None = None,
    interface: InterfaceLaw | None = None,
    slip: Quantities | None = None,
    accuracy: Quantity = 1e-3,
    workers: int | Workers = 1,
    progress: Callable[[int, int], object] | None = None,
    heating: Heating | None = None,
    exact: bool = False,
    **settings: Unpack[ContactOptions],
) -> FrictionCurves:
    """Predict friction at every one of the speeds and temperatures.

    Many of them are interpolated between contacts on their common curve, Eq. (10), as finely as the accuracy requires;
    few are solved one by one.

    Parameters
    ----------
    material : Material
        Without a shift it has one temperature, the one given or 20 °C, as the note ``temperature-assumed`` says.
    indenter : Indenter
        Ball, Ellipsoid, Cone, HeightMap, Cylinder or Profile.
    speeds : float, str, pint.Quantity, or an array or list of them
        Speeds at which the rubber is deformed, above zero; m/s if plain numbers.
    temperatures : float, str, pint.Quantity, or an array or list of them
        K if plain numbers; the reference of the material if left out.
    load : float, str or pint.Quantity, optional
        Normal load, N if a plain number; of a line contact per length, N/m.
    loads : float, str, pint.Quantity, or an array or list of them, optional
        Several loads instead: the curves of one load after those of another.
    samples : MaterialSamples, optional
        The material as other measurements might have given it, from `sample_materials` or `identify_material`: the
        curves then hold the standard error that this leaves on friction and the limits of its 95 % band, found to
        first order by one adjoint solve for each contact (see `viscofric.friction.bands`).
    interface : InterfaceLaw, optional
        Shear stress of the dry interface, from `ShearStress.law` or given: the curves then also hold the interfacial
        part τ_s A/F as their Coulomb friction, and `FrictionCurves.total`.  Its standard error has those of the law and
        of the solved area, not that of the material.
    slip : float, str, pint.Quantity, or one for each speed and temperature, optional
        Slip speed of the interface, m/s; the speed at which the rubber is deformed if left out, as in pure sliding.
    accuracy : float or str
        Relative error of each friction coefficient that is aimed at; see `solve_steady`.
    workers : int or Workers
        Processes that share the contacts out among them, or `viscofric.processes.Workers` that are kept for more; the
        result is the same to the last digit.
    progress : callable, optional
        Called as ``progress(done, total)`` with the speeds known, before the first and after every contact.
    heating : Heating, optional
        Thermal properties and Coulomb heat: each contact is at the temperature to which its own friction heats it, in
        its cold and its hot state where it has two.  Three to four times the cost; no samples.  With an interface,
        its shear stress at that temperature makes the Coulomb heat, and the slip is that of the heating.
    exact : bool
        Whether to solve every contact by itself.  This is also done for a table of moduli, and with settings other
        than `layer`, `indenter_modulus` and `indenter_poisson_ratio`.
    **settings
        Of `solve_steady`, the same for all contacts: `layer`, `direction`, `indenter_modulus`,
        `indenter_poisson_ratio`, `tolerance`, `finest`, `window`, `grid`, `backend` and `coulomb` (not
        with samples).

    Returns
    -------
    FrictionCurves
        Load after load and temperature after temperature in the order given, each with all speeds; with samples also
        `material_error`, `viscoelastic_lower` and `viscoelastic_upper`; with heating `HeatedFrictionCurves`.
        The note `beyond-measured` counts the contacts at frequencies beyond those of the material's measurement: there
        neither friction nor its limits are measured; `within_measured_frequencies` says which.

    Raises
    ------
    InputError
        If a value cannot be used.
    ConvergenceError
        If a contact cannot be solved to the accuracy.

    Notes
    -----
    An error of one contact names its conditions, and is raised after the others are solved; without heating its
    attribute `solved` has their curves.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber = vf.synthetic_fluoroelastomer()
    >>> curves = vf.predict_friction(
    ...     rubber,
    ...     vf.Ball(radius="9.525 mm"),
    ...     speeds=["20 mm/s", "200 mm/s"],
    ...     temperatures="60 degC",
    ...     load="25 N",
    ... )
    >>> curves.viscoelastic.round(3)
    array([0.025, 0.016])
    """
    velocities = to_si_array(speeds, "m/s", "speeds")
    if unknown := settings.keys() - ContactOptions.__annotations__.keys():
        raise TypeError(f"predict_friction() got an unexpected keyword argument {min(unknown)!r}")
    insist_on_material(material)
    insist_on_indenter(indenter)
    insist_on_round_edges(indenter)
    insist_on_function(progress, "progress")
    flag(exact, "exact")
    material, kelvins, assumed = known_at(material, temperatures)
    layer = Layer.of(settings.get("layer"))
    if layer is not None:
        settings["layer"] = layer
    unit = indenter.geometry.load_unit
    exactly_one(load=load, loads=loads)
    accuracy = number(accuracy, "accuracy")
    if load is not None:
        forces = np.array([positive(load, unit, "load")])
    else:
        assert loads is not None
        forces = to_si_array(loads, unit, "loads")
        _insist_on_values(forces, "loads", unit)
    _insist_on_values(velocities, "speeds", "m/s")
    _insist_on_values(kelvins, "temperatures", "K")
    assert material.shift is not None
    material.shift(kelvins)  # raises where one is not known, before any contact is solved
    check_interface(interface, slip)
    if heating is not None:
        insist_on(heating, "heating", Heating)
        if samples is not None:
            raise InputError("heating: not with samples; leave out one.", code="not-with-heating")
        check_interface_heat(heating, interface, slip)
    drawn = None if samples is None else DrawnMaterials(samples, material)
    given: dict[str, Any] = {"material": material, "indenter": indenter, "accuracy": accuracy, **settings}
    places = [{"temperature": T, "speed": v} for T in kelvins.tolist() for v in velocities.tolist()]
    parts = [[given | {"load": force} | place for place in places] for force in forces.tolist()]

    def report(done: int) -> None:
        if progress is not None:
            progress(done, sum(map(len, parts)) * (1 if heating is None else 2))

    report(0)
    rise, failure, here = None, None, np.ones(sum(map(len, parts)), dtype=bool)
    with at_work(workers) as processes:
        if heating is not None:
            curves: FrictionCurves
            curves = heated = predict_heated(parts, heating, processes, report, interface, exact=exact)
            slip, rise = None if heating.slip is None else heating.sliding(0.0), heated.face_rise
        else:
            curves, here, failure = _isothermal(parts, drawn, processes, report, exact)
    if interface is not None:
        slips = None if slip is None else to_si_array(slip, "m/s", "slip")
        if slips is not None and slips.size == len(parts[0]):
            slips = np.tile(slips, len(parts))[here]  # the same under each load
        curves = with_interface(curves, interface, slips, rise=rise)
    warmer = getattr(curves, "temperature_rise", None)
    notes = (*assumed, *curves.notes)
    if curves.coulomb is not None:
        solved = checked_coulomb(settings.get("coulomb", 0.0))
        notes += shear_notes(curves, curves.coulomb, [(material, layer)] * len(curves), warmer, solved)
    return _with_error(replace(curves, notes=notes), failure)


def _with_error(curves: FrictionCurves, failure: ViscofricError | None) -> FrictionCurves:
    """Return the curves, or raise the error of contacts that they lack."""
    if failure is not None:
        failure.solved = curves
        raise failure
    return curves


def _isothermal(
    parts: list[list[dict[str, Any]]],
    drawn: DrawnMaterials | None,
    workers: Workers,
    report: Callable[[int], None],
    exact: bool,
) -> tuple[FrictionCurves, Mask, ViscofricError | None]:
    """Return the friction of contacts, those of each load in a part of their own, with the material's band.

    Also which of them are solved, (n,), and the first error of those that are not; it is raised where none is.
    """
    outcomes: list[Record | ViscofricError] = []
    for part in parts:
        outcomes += _outcomes(part, drawn is not None, workers, counted_from(len(outcomes), report), exact)
    here = np.array([isinstance(one, Record) for one in outcomes])
    failure = None if here.all() else _failure(parts, outcomes, here)
    records = [one for one in outcomes if isinstance(one, Record)]
    first = parts[0][0]
    material = first["material"]
    columns = columns_of_contacts(material, records, first["indenter"].geometry.load_unit)
    curves = FrictionCurves(**columns, source=marked("predicted", synthetic=is_synthetic(material)))
    if failure is not None:
        count = int(np.count_nonzero(~here))
        said = f"{count} of {here.size} contacts {'has' if count == 1 else 'have'} no solution: {failure}"
        curves = replace(curves, notes=(Note("unsolved", said, values={"contacts": count}), *curves.notes))
    if drawn is not None:
        curves = with_material_band(curves, [record.sensitivity for record in records], drawn)  # type: ignore[misc]
    return curves, here, failure


def _failure(parts: list[list[dict[str, Any]]], outcomes: list[Record | ViscofricError], here: Mask) -> ViscofricError:
    """Return the first error with the conditions of its contact; raise it as it is if no contact is solved."""
    row = int(np.argmin(here))
    error, contact = cast("ViscofricError", outcomes[row]), [one for part in parts for one in part][row]
    if not here.any():
        raise error
    unit = contact["indenter"].geometry.load_unit
    where = [shown_place(contact["temperature"], contact["speed"])]
    where += [f"{shown_number(contact['load'], '.4g')} {unit}"] if len(parts) > 1 else []
    return error.at(", ".join(where))


def _outcomes(
    contacts: list[dict[str, Any]], sensitive: bool, workers: Workers, report: Callable[[int], None], exact: bool
) -> list[Record | ViscofricError]:
    """Return the records of contacts under one load, or their errors, interpolated between fewer where enough."""
    if not exact:
        shared = SharedContacts.of(contacts[0]["material"], contacts, workers, report, sensitive=sensitive)
        found = [] if shared is None else shared.outcomes(places_of(contacts))
        if found and not (sensitive and any(isinstance(one, Record) and one.sensitivity is None for one in found)):
            return found
    calls = [{"function": _record, "contact": one, "sensitive": sensitive} for one in contacts]
    return call_all(attempt, calls, workers=workers, progress=report)


def _record(contact: dict[str, Any], sensitive: bool) -> Record:
    """Return the record of a contact, arguments of `solve_steady`."""
    solution, known = solve_with_sensitivity(**contact) if sensitive else (solve_steady(**contact), None)
    return indenter_record(solution, contact["temperature"], known)


def _insist_on_values(values: Array, name: str, unit: str) -> None:
    if not values.size:
        raise InputError(f"{name} must hold at least one value.", code="empty-list")
    if not np.all(values > 0.0):
        raise InputError(
            f"{name} must be above zero everywhere, but one is {shown_number(float(values.min()), 'g')} {unit}.",
            code="not-positive",
        )
