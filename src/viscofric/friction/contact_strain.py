"""A contact solved with the moduli of its own strain, beside the linear one: the Payne effect on friction."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from viscofric.arguments import insist_on
from viscofric.contact.indenters.indenter import Indenter
from viscofric.contact.solution import ContactSolution
from viscofric.contact.steady import solve_steady
from viscofric.datasets import Dataset
from viscofric.errors import ConvergenceError
from viscofric.rheology.material import Material
from viscofric.rheology.payne.kraus import KrausLaw, contact_strain, material_at_strain, on_strain
from viscofric.showing import Plotted, Rows
from viscofric.units import Quantity

#: Contact and strain are found in turn, until the strain changes by less than this part …
CONVERGED = 0.02
#: … in at most so many turns.
TURNS = 15


@dataclass(frozen=True, eq=False)
class ContactAtStrain(Plotted):
    """A contact with the moduli of its own strain, and the linear one.

    Parameters
    ----------
    linear : ContactSolution
        With the material as it was measured, at small strain.
    scaled : ContactSolution
        With the material scaled to the strain of this contact.
    strain : float
        Tensile strain that stands for the contact; see `contact_strain`.
    material : Material
        As scaled.
    notes : tuple of str
        That this is an approximation, and where the law is extrapolated.
    """

    linear: ContactSolution
    scaled: ContactSolution
    strain: float
    material: Material
    notes: tuple[str, ...] = ()

    def _shown(self) -> Rows:
        return (
            ("strain", self.strain, "%"),
            ("friction coefficient", self.scaled.friction_coefficient, "", self.scaled.diagnostics.friction_error),
            ("of linear moduli", self.linear.friction_coefficient, "", self.linear.diagnostics.friction_error),
            ("notes", self.notes),
        )

    def to_dataset(self) -> Dataset:
        """Return the numbers of both contacts along the dimension ``moduli``.

        `ContactSolution.numbers` at ``moduli`` "linear" and "at the strain of the contact"; the attributes are
        ``strain`` and ``notes`` (JSON).
        """
        import xarray

        names = ["linear", "at the strain of the contact"]
        words = {"units": "1", "long_name": "moduli of the contact"}
        moduli = xarray.DataArray(names, dims="moduli", name="moduli", attrs=words)
        return xarray.concat([self.linear.numbers, self.scaled.numbers], moduli).assign_attrs(
            strain=self.strain, notes=json.dumps([str(note) for note in self.notes], ensure_ascii=False)
        )


def solve_at_contact_strain(
    material: Material,
    law: KrausLaw,
    indenter: Indenter,
    *,
    speed: Quantity,
    load: Quantity,
    temperature: Quantity | None = None,
    measured_at: float | None = None,
    **settings: Any,
) -> ContactAtStrain:
    """Solve a steady contact with the moduli of its own strain by Kraus's law: an approximation.

    Parameters
    ----------
    material : Material
        At the strain of its frequency sweeps.
    law : KrausLaw
        From `fit_kraus`.
    indenter : Indenter
        Ball, Cylinder, Cone, …; its slope at the mean edge of the contact gives the strain.
    speed, load, temperature
        As for `solve_steady`.
    measured_at : float, optional
        Tensile strain amplitude of the frequency sweeps; the linear limit of the law without it.
    **settings
        Others of `solve_steady`, such as `accuracy` or `layer`.

    Returns
    -------
    ContactAtStrain

    Raises
    ------
    InputError
        As `solve_steady` and `material_at_strain` raise it.
    ConvergenceError
        If contact and strain do not agree after fifteen turns.

    Notes
    -----
    Contact and strain depend on each other: a softer rubber has a larger contact, which strains it more.  They are
    found in turn, each new strain being the mean of the last and that of the contact.

    Examples
    --------
    >>> import viscofric as vf
    >>> law = vf.rheology.KrausLaw(6e6, 3e6, 0.02, 0.6, 9e5, 2e5, 62.8, 333.15, "shear")  # synthetic
    >>> ball, rubber = vf.Ball("9.525 mm"), vf.synthetic_fluoroelastomer()
    >>> contact = dict(speed="20 mm/s", load="5 N", temperature="60 degC", accuracy=0.03)
    >>> both = vf.friction.solve_at_contact_strain(rubber, law, ball, **contact)
    >>> both.scaled.contact_area > both.linear.contact_area
    True
    """
    insist_on(material, "material", Material)
    insist_on(law, "law", KrausLaw)
    insist_on(indenter, "indenter", Indenter)
    arguments = {"speed": speed, "load": load, "temperature": temperature, **settings}
    linear = found = solve_steady(material, indenter, **arguments)
    strain = _strain(indenter, linear)
    for _ in range(TURNS):
        scaled = material_at_strain(material, law, strain, measured_at=measured_at)
        found = solve_steady(scaled, indenter, **arguments)
        now = _strain(indenter, found)
        if abs(now - strain) <= CONVERGED * now:
            return ContactAtStrain(linear, found, strain, scaled, tuple(on_strain(law, strain)))
        strain = 0.5 * (strain + now)
    raise ConvergenceError(
        f"contact and strain do not agree after {TURNS} turns; the last strain was {100 * strain:.3g} %.",
        code="not-converged",
    )


def _strain(indenter: Indenter, contact: ContactSolution) -> float:
    edge = 0.5 * (contact.front + contact.rear)
    slope = indenter.slope(np.array([edge]), np.array([0.0]))
    return contact_strain(abs(float(slope[0])))
