"""[interface] of a run file: shear stress of the dry interface, fitted to the measurement or given as a law."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from typing import Annotated, Literal

from pydantic import Field

from viscofric.rheology.interface.fitting import KINDS
from viscofric.rheology.interface.law import InterfaceLaw
from viscofric.rheology.shifts.laws import Arrhenius
from viscofric.study.run_file import tables

Volume = Annotated[float, tables.above_zero("m**3"), tables.as_text("20 nm**3")]
Energy = Annotated[float, tables.above_zero("J/mol"), tables.as_text("80 kJ/mol")]
Part = Annotated[tables.Number, Field(ge=0.0, lt=1.0)]
#: Constants of each law.
CONSTANTS = {kind: tuple(one.name for one in fields(law) if not one.kw_only) for kind, law in KINDS.items()}
_ALL = tuple(dict.fromkeys(name for names in CONSTANTS.values() for name in names))


class InterfaceTable(tables.Table):
    """[interface]: shear stress of the dry interface, whose friction is added to the hysteresis of every case."""

    law: Literal["best", "constant", "power", "eyring", "gaussian"] = Field(
        "best",
        description="Law of the shear stress, fitted to measured Coulomb friction unless its constants are given.",
    )
    stress: tables.Pressure | None = Field(None, description="Of 'constant', and of 'power' at speed: shear stress.")
    exponent: tables.Number | None = Field(None, description="Of 'power': exponent of the speed.")
    speed: tables.Speed | None = Field(None, description="Of 'power', 'eyring' and 'gaussian': slip speed v₀ or v_p.")
    activation_volume: Volume | None = Field(None, description="Of 'eyring'.")
    peak: tables.Pressure | None = Field(None, description="Of 'gaussian': largest shear stress.")
    width: Annotated[tables.Number, Field(gt=0.0)] | None = Field(None, description="Of 'gaussian': width in decades.")
    activation_energy: Energy | None = Field(None, description="Of the shift of a given law with temperature.")
    reference: tables.Temperature | None = Field(None, description="Temperature at which the given constants hold.")
    slip: tables.Speed | None = Field(
        None, description="Slip speed of all cases; default: their speed, as in pure sliding."
    )
    level_error: Part = Field(0.0, description="Relative standard error shared by the points of a temperature.")
    area_error: Part = Field(0.0, description="Relative standard error shared by all contact areas.")

    def _problems(self) -> Iterator[tables.Problem]:
        if not self.is_given:
            for name in ("activation_energy", "reference"):
                if getattr(self, name) is not None:
                    yield name, "belongs to a law whose constants are given"
            return
        if self.law == "best":
            said = f"is missing; constants belong to one of {', '.join(map(repr, CONSTANTS))}"
            yield (
                "law",
                tables.worded(said, "is fitted, and takes no constants; empty them or choose the law that they are of"),
            )
            return
        for name in _ALL:
            if (name in CONSTANTS[self.law]) != (getattr(self, name) is not None):
                needed = "is missing" if name in CONSTANTS[self.law] else "is no constant"
                said = f"{needed} of the law {self.law!r}, which has {', '.join(CONSTANTS[self.law])}"
                yield name, tables.worded(said, f"{needed} of this law")
        if (self.activation_energy is None) != (self.reference is None):
            yield "reference", "and activation_energy belong together; give both or neither"
        for name in ("level_error", "area_error"):
            if name in self.model_fields_set:
                yield name, "is for a law that is fitted to the measurement"

    @property
    def is_given(self) -> bool:
        """Whether the law has constants, and is not fitted."""
        return any(getattr(self, name) is not None for name in _ALL)

    def given(self) -> InterfaceLaw:
        """Return the law of the given constants."""
        shift = None
        if self.activation_energy is not None and self.reference is not None:
            shift = Arrhenius(self.activation_energy, self.reference)
        constants = {name: getattr(self, name) for name in CONSTANTS[self.law]}
        return KINDS[self.law](**constants, shift=shift)
