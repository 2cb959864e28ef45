"""Whether what the friction of a half-space takes for granted holds: thickness, small strain, one temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from viscofric.contact.indenters.indenter import SMALL_STRAIN, Indenter, insist_on_indenter
from viscofric.errors import InputError
from viscofric.friction.assumption_check import AssumptionCheck, ContactSize, verdict
from viscofric.friction.coupling import check_coupling
from viscofric.friction.curves import FrictionCurves, insist_on_curves
from viscofric.friction.half_space import check_half_space
from viscofric.friction.warming import Warming
from viscofric.rheology.material import Material, insist_on_material
from viscofric.thermal import FILLED_RUBBER, PTFE, ThermalProperties
from viscofric.units import Quantity, plain, positive, to_si_array

if TYPE_CHECKING:
    from viscofric.arrays import Array
    from viscofric.units import Quantities


#: Representative strain under a ball over a/R (D. Tabor, The Hardness of Metals (1951); K. L. Johnson, Contact
#: Mechanics (1985), section 6.3).
REPRESENTATIVE_STRAIN = 0.2
#: Change of friction by warming or by the rubber's thickness that passes, relative: tribometers repeat no better.
CHANGE = 0.05
_SOLVE = "solve the contact and give contact_radius"


def check_assumptions(
    material: Material,
    indenter: Indenter,
    curves: FrictionCurves,
    *,
    thickness: Quantity | None = None,
    contact_radius: Quantities | None = None,
    rubber: ThermalProperties = FILLED_RUBBER,
    counterbody: ThermalProperties = PTFE,
) -> tuple[AssumptionCheck, ...]:
    """Check for every point of friction curves what predicted friction takes for granted, and tell of the worst.

    Parameters
    ----------
    material : Material
        With a shift.
    indenter : Indenter
    curves : FrictionCurves
        Measured or predicted: speeds, temperatures, loads and friction.  Measured ones also tell the Coulomb friction
        and the sliding velocity, and with them the heat on the surface.
    thickness : float, str or pint.Quantity, optional
        Of the rubber, m; its base is taken for bonded, on which it is felt more than on a sliding one.
    contact_radius : float, str, pint.Quantity, or one for each point, optional
        Half width or half length of the contact, whichever is larger, where it was solved, m.  If not given, it lies
        between Hertz's at |E(ω = v/a)|, an estimate, and at the rubber modulus E0: no contact on this rubber is wider.
    rubber, counterbody : ThermalProperties
        Of the rubber and of the indenter.  If not given, typical handbook values of a filled rubber and of PTFE, which
        of the usual balls takes the least heat.

    Returns
    -------
    tuple of AssumptionCheck
        - "half-space": contact radius over thickness, at most 1/4, and less where friction on a bonded layer would
          still differ by more than 5 % from that on the half-space.
        - "small contact": contact radius over the radius of a ball or cylinder (of the paraboloid that is as deep, for
          other shapes), at most 0.3.
        - "linearity": representative strain 0.2 a/R, at most that of the limit above, 6 %.
        - "uncoupled", where Coulomb friction is known: what its shear moves the surface by, normal to it, over what the
          pressure does, at most 0.02.  It vanishes on a half-space of ν = ½ only.
        - "one temperature": relative change of friction by the heat that it makes itself, at most 5 %.

    Raises
    ------
    InputError
        If there are no points, the material has no shift, or a value cannot be used.

    Notes
    -----
    What the thickness changes is estimated from the waves that are longer than the layer is thick (see
    `viscofric.friction.finite_thickness`), with the friction of the curves for that on the half-space.  Against layers
    solved on four contact radii and more it is true to 8 % of the change under a ball, 20 % under a cylinder and half
    of it under other shapes, or to 0.002 of friction (0.006 for other shapes) where that is more.  Broad spectra, and
    memory longer than the layer is thick, vτ > H, feel the base farther than the contact's size does.

    Warming by ΔT shifts the speed by d log10 α/dT · ΔT decades, and friction by what the rubber's own, to first order
    in the loss, changes by on that way, at every point by itself.  ΔT is the flash
    temperature of the Coulomb heat μ_c F v_slip, shared between the bodies, and the warming of the bulk by the
    viscoelastic loss (see `viscofric.friction.warming`), on a contact as small as it may be.
    That is an upper bound on what matters: the Coulomb heat warms a thin skin only.  Heat left from one turn of the
    disc to the next is not counted; a thermometer in the rubber tells of it.

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
    one temperature True
    """
    insist_on_curves(curves, "curves")
    insist_on_material(material)
    if not len(curves):
        raise InputError("friction curves hold no points; there are no contacts to check.")
    insist_on_indenter(indenter)
    if material.shift is None:
        raise InputError("material has no shift; what friction makes of warming cannot be told without α(T).")
    for name, body in (("rubber", rubber), ("counterbody", counterbody)):
        if not isinstance(body, ThermalProperties):
            raise InputError(f"{name} must be ThermalProperties (conductivity, density …), not {type(body).__name__}.")
    radii = None if contact_radius is None else _radii(contact_radius, len(curves))
    sizes = [
        ContactSize.of(material, indenter, curves, row, None if radii is None else float(radii[row]))
        for row in range(len(curves))
    ]
    # By both bounds, as the widest of `check_half_space`.
    steepest = max(sizes, key=lambda size: size.largest * size.smallest * size.curvature**2)
    try:
        warming = Warming.of(material, indenter, curves, [size.smallest for size in sizes], rubber, counterbody)
        isothermal = _one_temperature(curves, [size.where for size in sizes], warming, rubber, counterbody)
    except InputError as error:  # the shift factors end where their slope is asked for
        said = f"What warming changes in friction cannot be told: {error}"
        isothermal = AssumptionCheck("one temperature", None, CHANGE, None, said)
    thick = None if thickness is None else positive(thickness, "m", "thickness")
    coupled = check_coupling(curves, material.poisson_ratio, thick, sizes)
    return (
        check_half_space(material, curves, sizes, thick, CHANGE),
        _small_contact(steepest, indenter.noun),
        _linearity(steepest),
        *(() if coupled is None else (coupled,)),
        isothermal,
    )


def _radii(given: Quantities, count: int) -> Array:
    radii = to_si_array(given, "m", "contact_radius")
    if radii.size not in (1, count) or not np.all(radii > 0.0):
        raise InputError(
            f"contact_radius must hold one length above zero, or one for each of the {count} points, in m."
        )
    return np.broadcast_to(radii, (count,))


def _small_contact(size: ContactSize, noun: str) -> AssumptionCheck:
    low, high = size.smallest * size.curvature, size.largest * size.curvature
    holds = verdict(low, high, SMALL_STRAIN)
    ratio = f"{high:.2f}" if low == high else f"{low:.2f} to {high:.2f}"
    said = f"{size}, {ratio} of the {noun}'s radius: up to {SMALL_STRAIN:g} half-space and parabolic {noun} serve"
    said += {True: ".", None: f"; {_SOLVE}.", False: ", beyond they are doubtful; press less or use a larger one."}[
        holds
    ]
    return AssumptionCheck("small contact", high, SMALL_STRAIN, holds, said)


def _linearity(size: ContactSize) -> AssumptionCheck:
    low, high = (REPRESENTATIVE_STRAIN * one * size.curvature for one in (size.smallest, size.largest))
    limit = REPRESENTATIVE_STRAIN * SMALL_STRAIN
    holds = verdict(low, high, limit)
    strain = f"{100 * high:.2g} %" if low == high else f"{100 * low:.2g} to {100 * high:.2g} %"
    beside = {True: "within", None: "about", False: "beyond"}[holds]
    said = (
        f"The rubber is strained by {strain} (0.2 a/R, {size.where}), {beside} the {100 * limit:.2g} % up to which "
        "contact theory is linear; a filled rubber may soften from a tenth of a per cent on (Payne effect), which only "
        "a strain sweep shows."
    )
    return AssumptionCheck("linearity", high, limit, holds, said)


def _one_temperature(
    curves: FrictionCurves,
    places: list[str],
    warming: Warming,
    rubber: ThermalProperties,
    counterbody: ThermalProperties,
) -> AssumptionCheck:
    worst = int(np.argmax(warming.change))
    surface, bulk, decades, change = (float(column[worst]) for column in warming)
    counted = f"Coulomb heat warms the surface by {surface:.2g} K and the viscoelastic loss"
    if curves.coulomb is None or curves.slip is None:
        counted = "Coulomb heat is not counted, for no Coulomb friction is known; the viscoelastic loss warms"
    holds = change <= CHANGE
    served = ": one temperature serves." if holds else f", above the {100 * CHANGE:.0f} % that pass: slide more slowly."
    said = (
        f"{counted} the rubber by {bulk:.2g} K at most ({places[worst]}; typical handbook values of {rubber.name} "
        f"and {counterbody.name} are assumed). That shifts the speed by {decades:.2g} decades and friction by "
        f"{plain(100 * change, 2)} %{served}"
    )
    return AssumptionCheck("one temperature", change, CHANGE, holds, said)
