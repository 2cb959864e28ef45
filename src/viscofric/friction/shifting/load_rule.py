"""Friction at one load from that at another, for indenters whose contacts at all loads are similar."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from viscofric.arrays import Array
from viscofric.contact.indenters.indenter import Indenter
from viscofric.errors import InputError
from viscofric.friction.curves import FrictionCurves
from viscofric.rheology.shifts.vertical_shift import VerticalShift

# Columns in proportion to viscoelastic friction.
_OF_FRICTION = (
    "viscoelastic",
    "viscoelastic_error",
    "viscoelastic_scatter",
    "material_error",
    "viscoelastic_lower",
    "viscoelastic_upper",
)


@dataclass(frozen=True)
class LoadRule:
    """Exact similarity of friction at different loads and vertical shifts.

    The contacts of an indenter without a length of its own on a linear half-space are similar at all loads.  With the
    load relative to a reference load and to the vertical shift b of the modulus, f = F/(b F0), their size is
    proportional to f^p and their strain to f^q, whatever the spectrum.  The time that a point spends in contact is the
    size over the speed, and friction is proportional to the strain, hence

        μ(v, T, F) = f^q μ(α(T) v / f^p, T0, F0),    f = F/(b(T) F0).

    For a ball p = q = 1/3: μ = (a0/R) Φ(v/a0), with a0 the Hertz radius (K. L. Johnson, Contact Mechanics, Cambridge
    1985, ch. 4); for a cylinder, with its load per length, p = q = 1/2; for a cone p = 1/2, q = 0.  It also holds for
    an elastic indenter if b = 1: its compliance is added to the material's, and neither has a length.  It does not
    depend on the material's b(T): friction with E_i corresponds to friction with E_i/b at the reference.  The rule does
    not hold on a layer, whose thickness is a length.
    """

    size: float  # p
    strain: float  # q

    @classmethod
    def of(cls, indenter: Any) -> LoadRule:
        """Return the rule of an indenter; InputError if it is not a ball, an ellipsoid, a cylinder or a cone."""
        exponents = getattr(indenter, "load_exponents", None)
        if exponents is None:
            noun = indenter.noun if isinstance(indenter, Indenter) else type(indenter).__name__
            raise InputError(
                f"indenter of friction curves is a {noun}: contacts at different loads are similar for a Ball, "
                "Ellipsoid, Cylinder or Cone only; leave it out and take curves of one load.",
                code="no-load-rule",
            )
        return cls(*exponents)

    def factors(self, relative_load: Array) -> tuple[Array, Array]:
        """Return f^p, of the speed, and f^q, of the friction, for f = F/(b F0)."""
        return relative_load**self.size, relative_load**self.strain

    def reduced(self, curves: FrictionCurves, load: float, vertical_shift: VerticalShift | None) -> FrictionCurves:
        """Return friction curves at one load and without vertical shift: v/f^p and μ/f^q of every point.

        `load` is F0 in the curves' `load_unit`, `vertical_shift` is b(T), 1 if None.  What does not belong to
        viscoelastic friction is unchanged.
        """
        b = 1.0 if vertical_shift is None else np.asarray(vertical_shift(curves.temperature))
        speed, friction = self.factors(np.asarray(curves.load / (b * load)))
        columns = {name: getattr(curves, name) for name in _OF_FRICTION}
        return replace(
            curves,
            speed=curves.speed / speed,
            load=np.full(len(curves), load),
            **{name: column / friction for name, column in columns.items() if column is not None},
        )
