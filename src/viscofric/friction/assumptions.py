"""Check of the assumptions behind predicted friction: half-space, small strain, no coupling or inertia, isothermal."""

from __future__ import annotations

import numpy as np

from viscofric.arguments import insist_on
from viscofric.arrays import Array
from viscofric.contact.bodies import LITTLE_INERTIA, Layer, inertia_note, shear_wave_speed
from viscofric.contact.indenters.indenter import SMALL_STRAIN, Indenter, insist_on_indenter
from viscofric.errors import InputError
from viscofric.friction.assumption_check import AssumptionCheck, ContactSize, Place, modes_by_temperature, verdict
from viscofric.friction.coulomb import check_coupling
from viscofric.friction.curves import FrictionCurves, insist_on_curves
from viscofric.friction.finite_thickness import check_half_space
from viscofric.friction.warming import Warming
from viscofric.heat.result import HeatColumns
from viscofric.notes import Note, Remedy
from viscofric.rheology.material import Material, insist_on_material, known_at
from viscofric.thermal import BODIES, FILLED_RUBBER, PTFE, ThermalProperties
from viscofric.units import Quantities, Quantity, plain, positive, to_si, to_si_array

#: Representative strain under a ball over a/R (D. Tabor, The Hardness of Metals (1951); K. L. Johnson, Contact
#: Mechanics (1985), section 6.3).
REPRESENTATIVE_STRAIN = 0.2
#: Acceptable relative change of friction by warming or by the rubber's thickness: the repeatability of tribometers.
CHANGE = 0.05
_SOLVE = "solve the contact and give contact_radius"
_HEAT = Remedy(
    "predict with heating.",
    "give --heating.",
    "give [heating].",
    "switch on “Friction heats the contact”.",
    field="heating",
)


def check_assumptions(
    material: Material,
    indenter: Indenter,
    curves: FrictionCurves,
    *,
    thickness: Quantity | None = None,
    layer: Layer | None = None,
    contact_radius: Quantities | None = None,
    rubber: ThermalProperties = FILLED_RUBBER,
    counterbody: ThermalProperties = PTFE,
) -> tuple[AssumptionCheck, ...]:
    """Check the assumptions behind predicted friction at every point of friction curves; return the worst case of each.

    Parameters
    ----------
    material : Material
        With a shift where the curves have several temperatures.
    indenter : Indenter
    curves : FrictionCurves
        Measured or predicted: speeds, temperatures, loads and friction.  Coulomb friction and sliding velocity, where
        they have both, make the heat on the surface.
    thickness : float, str or pint.Quantity, optional
        Of the rubber, m; its base is taken as bonded, which changes friction more than a sliding one.
    layer : Layer, optional
        On which the contacts of the curves were solved: then "half-space" is not checked.
    contact_radius : float, str, pint.Quantity, or one for each point, optional
        Half width or half length of the solved contact, whichever is larger, m.  If not given, it lies between Hertz's
        at |E(ω = v/a)|, an estimate, and Hertz's at the relaxed modulus E0, the largest possible on this material.
    rubber, counterbody : ThermalProperties
        Of the rubber and of the indenter.  If not given, typical handbook values of a filled rubber and of PTFE, the
        usual ball material that conducts the least heat.

    Returns
    -------
    tuple of AssumptionCheck
        - "half-space": contact radius over thickness, at most 1/4, and less where friction on a bonded layer would
          still differ by more than 5 % from that on the half-space.
        - "small contact": contact radius over the radius of a ball or cylinder (of the paraboloid that is as deep, for
          other shapes), at most 0.3.
        - "linearity": representative strain 0.2 a/R, at most that of the limit above, 6 %.
        - "uncoupled", where Coulomb friction is known: estimated change of friction by its shear, over viscoelastic
          friction, at most 5 %.  It vanishes on a half-space of ν = ½ only.
        - "quasi-static": square of the speed over that of shear waves in the rubber, √(|E(v/a)|/(2(1+ν)ρ)), which is
          about the relative change of friction by inertia, at most 5 %.
        - "one temperature": relative change of friction by its own heat, at most 5 %; unknown where the face of the
          contact is warm enough for more, and the rubber below is not.  It holds for curves predicted with heating.

    Raises
    ------
    InputError
        If there are no points, they have several temperatures and the material no shift, or a value cannot be used.

    Notes
    -----
    The effect of the thickness is estimated from the waves longer than the layer is thick (see
    `viscofric.friction.finite_thickness`), taking the friction of the curves as that on the half-space.  Compared with
    solved layers of two contact radii and more, it is accurate to 7 % of the change under a ball and 30 % under a
    cylinder, or to 0.002 of friction; of four and more, under other shapes, to 50 % or 0.006.  With
    broad spectra, and with memory longer than the thickness, vτ > H, the base matters at larger thicknesses than the
    contact's size suggests.

    Warming by ΔT shifts the speed by d log10 α/dT · ΔT decades, and friction by the change of the material's own
    friction along that shift, to first order in the loss, at each point separately.  ΔT is the mean rise of the face of
    the contact, by the Coulomb heat μ_c F v_slip, shared between the bodies, and by the viscoelastic loss below, as in
    ``solve_steady(heating=…)``, under Hertz's pressure on a contact of the smallest possible size.  The rise of the
    rubber where the loss is released is smaller where the heat of the face warms a thin skin only: the change of
    friction lies between those of both.  Heat that remains from one turn of the disc to the next is not included; see
    `Heating`, or measure it with a thermometer in the rubber.

    Examples
    --------
    >>> import viscofric as vf
    >>> rubber, ball = vf.synthetic_fluoroelastomer(), vf.Ball(radius="9.525 mm")
    >>> curves = vf.predict_friction(rubber, ball, speeds="0.1 m/s", temperatures="60 degC", load="5 N")
    >>> for check in vf.check_assumptions(rubber, ball, curves, thickness="10 mm"):
    ...     print(check.name, check.holds)
    half-space True
    small contact True
    linearity True
    quasi-static True
    one temperature True
    """
    insist_on_curves(curves, "curves")
    insist_on_material(material)
    if not len(curves):
        raise InputError("friction curves contain no points; there are no contacts to check.", code="no-points")
    insist_on_indenter(indenter)
    material, _, _ = known_at(material, curves.temperature)
    for name, body in (("rubber", rubber), ("counterbody", counterbody)):
        insist_on(body, name, ThermalProperties, right="ThermalProperties (conductivity, density …)")
    insist_on(layer, "layer", Layer, type(None), right="a Layer, such as Layer(thickness='2 mm')")
    thick = None if thickness is None else positive(thickness, "m", "thickness")
    radii = None if contact_radius is None else _radii(contact_radius, len(curves))
    sizes = ContactSize.all_of(material, indenter, curves, radii)
    # By both bounds, as the widest of `check_half_space`.
    steepest = max(sizes, key=lambda size: size.largest * size.smallest * size.curvature**2)
    if isinstance(curves, HeatColumns):
        isothermal = _heated(curves)
    else:
        isothermal = _isothermal(material, indenter, curves, sizes, rubber, counterbody)
    sheared = layer if layer is not None or thick is None else Layer(thick)
    coupled = check_coupling(curves, material, sheared, [(size.smallest, size.largest) for size in sizes])
    return (
        *(() if layer is not None else (check_half_space(material, curves, sizes, thick, CHANGE),)),
        _small_contact(steepest, indenter.noun),
        _linearity(steepest),
        *(() if coupled is None else (coupled,)),
        _quasi_static(material, sizes, rubber),
        isothermal,
    )


def _radii(given: Quantities, count: int) -> Array:
    radii = to_si_array(given, "m", "contact_radius")
    if radii.size not in (1, count) or not np.all(radii > 0.0):
        raise InputError(
            f"contact_radius must hold one length above zero, or one for each of the {count} points, in m.",
            code="contact-radius",
        )
    return np.broadcast_to(radii, (count,))


def _small_contact(size: ContactSize, noun: str) -> AssumptionCheck:
    low, high = size.smallest * size.curvature, size.largest * size.curvature
    holds = verdict(low, high, SMALL_STRAIN)
    ratio = f"{high:.2f}" if low == high else f"{low:.2f} to {high:.2f}"
    rest = {True: ".", None: f"; {_SOLVE}.", False: "; reduce the load, or use a larger one."}[holds]
    sentence = Note(
        "small-contact",
        f"{size}, {ratio} of the {noun} radius; half-space and parabolic {noun} are valid up to {SMALL_STRAIN:g}{rest}",
        values={"lowest": low, "highest": high, **size.values},
    )
    return AssumptionCheck.of("small contact", holds, sentence, high, SMALL_STRAIN)


def _linearity(size: ContactSize) -> AssumptionCheck:
    low, high = (REPRESENTATIVE_STRAIN * one * size.curvature for one in (size.smallest, size.largest))
    limit = REPRESENTATIVE_STRAIN * SMALL_STRAIN
    holds = verdict(low, high, limit)
    strain = f"{100 * high:.2g} %" if low == high else f"{100 * low:.2g} to {100 * high:.2g} %"
    compared = {True: "within", None: "about", False: "beyond"}[holds]
    sentence = Note(
        "linearity",
        f"The strain of the rubber is {strain} (0.2 a/R, {size.where}), {compared} the limit of linear contact theory, "
        f"{100 * limit:.2g} %; filled rubber may soften above 0.1 % (Payne effect), which only a strain sweep shows.",
        values={"lowest": low, "highest": high, **size.where.values},
    )
    return AssumptionCheck.of("linearity", holds, sentence, high, limit)


def _quasi_static(material: Material, sizes: list[ContactSize], rubber: ThermalProperties) -> AssumptionCheck:
    """Return the check of the speed against that of shear waves; see `inertia_note`."""
    modes_at, density = modes_by_temperature(material), to_si(rubber.density, "kg/m^3", "density")

    def waves(size: ContactSize) -> float:
        modulus = modes_at(size.where.temperature).complex_modulus(size.where.speed / size.smallest)
        return shear_wave_speed(abs(complex(modulus)), material.poisson_ratio, density)

    speeds = list(map(waves, sizes))
    row = int(np.argmax([size.where.speed / one for size, one in zip(sizes, speeds, strict=True)]))
    where = sizes[row].where
    worst = inertia_note(where.speed, speeds[row], density, str(where)).valued(**where.values)
    change = float(worst.values["change"])
    return AssumptionCheck.of("quasi-static", change <= LITTLE_INERTIA, worst, change, LITTLE_INERTIA)


def _heated(curves: HeatColumns) -> AssumptionCheck:
    """Return the check of curves that hold friction at the temperature to which it heats the contacts."""
    assert isinstance(curves, FrictionCurves)
    change = np.abs(curves.viscoelastic / curves.isothermal_friction - 1.0)
    row = int(np.argmax(change))
    rise, where = float(curves.temperature_rise[row]), Place.of(curves, row)
    sentence = Note(
        "warming-included",
        f"Friction is that at the temperature to which it heats the contact; this changes it by up to "
        f"{plain(100 * float(change[row]), 2)} % (the rubber is {rise:.2g} K warmer {where}).",
        values={"change": float(change[row]), "rise": rise, **where.values},
    )
    return AssumptionCheck.of("one temperature", True, sentence, None, CHANGE)


def _isothermal(
    material: Material,
    indenter: Indenter,
    curves: FrictionCurves,
    sizes: list[ContactSize],
    rubber: ThermalProperties,
    counterbody: ThermalProperties,
) -> AssumptionCheck:
    """Return the check of curves that hold friction at the temperature of the body."""
    try:
        warming = Warming.worst(material, indenter, curves, [size.smallest for size in sizes], rubber, counterbody)
    except InputError as error:  # the shift factors end where their slope is needed
        unknown = Note("warming-unknown", f"The effect of warming on friction is unknown: {error}")
        return AssumptionCheck.of("one temperature", None, unknown, None, CHANGE)
    where = sizes[warming.row].where
    counted = curves.coulomb is not None and curves.slip is not None
    holds = verdict(warming.least, warming.change, CHANGE)
    heat = "Coulomb heat and the viscoelastic loss warm"
    if not counted:
        missing = "Coulomb friction" if curves.coulomb is None else "sliding velocity"
        heat = f"Coulomb heat is not included, as no {missing} is known; the viscoelastic loss warms"
    low, high = (plain(100 * one, 2) for one in (warming.least, warming.change))
    change = f"{high} %" if low == high else f"{low} to {high} %"
    rest = {True: None, None: "; " + _HEAT, False: "; reduce the slip or the speed, or " + _HEAT}[holds]
    typical = [body.name for body in (rubber, counterbody) if body in BODIES.values()]
    assumed = f"; typical handbook values of {' and '.join(typical)} are assumed" if typical else ""
    sentence = Note(
        "warming",
        f"{heat} the face of the contact by {warming.face:.2g} K, and the rubber where the loss is released by "
        f"{warming.below:.2g} K ({where}{assumed}). This shifts the speed by up to {warming.decades:.2g} decades and "
        f"changes friction by {change} "
        f"(good if ≤ {100 * CHANGE:.0f} %){'.' if rest is None else ''}",
        remedy=rest,
        values={
            "coulomb_counted": counted,
            "face_rise": warming.face,
            "loss_weighted_rise": warming.below,
            "decades": warming.decades,
            "change": warming.change,
            "least_change": warming.least,
            "rubber": rubber.name,
            "counterbody": counterbody.name,
            **where.values,
        },
    )
    return AssumptionCheck.of("one temperature", holds, sentence, warming.change, CHANGE)
