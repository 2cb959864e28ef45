"""[material] of a run file: the source of the material model, and how sweeps are converted into it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, WithJsonSchema

from viscofric.errors import InputError
from viscofric.study.run_file import tables
from viscofric.units import conversion

#: Keys for the source of the material; every run file has one of them, or sweeps and step tests together.
SOURCES = ("dma", "ramps", "creep", "relaxation", "master_curve", "file", "catalogue")
#: Kinds of tests that make one material together.
SEVERAL = (["dma", "creep"], ["dma", "relaxation"])
#: Laws whose constants are fitted to temperature ramps.
RAMP_LAWS = ("wlf", "arrhenius", "vft", "wlf+arrhenius")
#: Keys that a predefined material has too; the others are for the conversion of sweeps.
_OF_ANY = (*SOURCES, "name", "reference_temperature", "amplitude_sweep", "strain", "measured_at")
#: Keys for what files do not state, also those of an amplitude sweep.
_OF_READING = ("deformation", "temperature", "modulus_unit", "columns", "sheet")
#: Keys that are invalid for step tests, which have one curve for each temperature …
_OF_TWO_MODULI = ("shift_by", "shift_weights")
#: … those for one kind of tests, not for sweeps and step tests together …
_OF_ONE_KIND = ("temperature", "modulus_unit", "columns", "sheet", "shift_factors", "fixed_shift_factors")
#: … and those invalid for a master curve, and for temperature ramps.
_TO_SHIFT = ("leave_out_temperatures", "vertical_shift", "shift_by", "shift_weights", "fixed_shift_factors")


def _by_kelvin(value: object) -> object:
    """Convert the temperatures that are the keys of a table to K."""
    if not isinstance(value, dict):
        return value
    found = {tables.kelvin(key): entry for key, entry in value.items()}
    if len(found) < len(value):
        raise ValueError("the same temperature is given twice")
    return found


def _unit_of_modulus(value: str) -> str:
    try:
        conversion(value, "Pa", tables.VALUE)
    except InputError:
        if not value.strip().startswith("1/"):
            raise
        conversion(value, "1/Pa", tables.VALUE)
    return value


def _assumption(value: str) -> str:
    from viscofric.rheology.ramps.superpose import assumed_of  # help does not need it

    assumed_of(value, 300.0)
    return value


def _in_catalogue(value: str) -> str:
    from viscofric.rheology.catalogue import catalogue_entry

    return catalogue_entry(value).name


_Temperatures = Annotated[
    tuple[tables.Temperature, ...],
    BeforeValidator(tables.listed),
    Field(min_length=1),
    tables.one_or_more(tables.schema_of(tables.Temperature)),
]


class MaterialTable(tables.Table):
    """[material]: DMA files and how the material model is fitted to them, or a predefined material."""

    FILES = ("dma", "creep", "relaxation", "ramps", "amplitude_sweep", "master_curve", "file", "shift_factors")

    dma: tables.FileNames | None = Field(
        None, description="DMA sweeps: a file, a list, or a pattern such as 'sweeps/*.txt'."
    )
    ramps: tables.FileNames | None = Field(
        None, description="Instead: temperature ramps at one or several frequencies, as files like those of dma."
    )
    creep: tables.FileNames | None = Field(
        None, description="Instead, or with dma: creep tests, J(t) after a step of stress."
    )
    relaxation: tables.FileNames | None = Field(
        None, description="Instead, or with dma: relaxation tests, E(t) or G(t) after a step of strain."
    )
    master_curve: tables.FileName | None = Field(None, description="Instead: a master curve.")
    file: tables.FileName | None = Field(
        None, description="Instead: a predefined material, rubber.json or another program's card."
    )
    catalogue: Annotated[tables.Words, AfterValidator(_in_catalogue)] | None = Field(
        None, description="Instead: a name in the catalogue (viscofric material list)."
    )

    name: tables.Words = Field("", description="Name of the material; required for several materials.")
    deformation: Literal["tension", "compression", "bending", "shear"] | None = Field(
        None, description="Deformation in the sweeps, if the file does not state it; E = 2(1+ν)G."
    )
    temperature: _Temperatures | None = Field(
        None, description="Temperature of files that do not state it: one for all, or one for each."
    )
    leave_out_temperatures: _Temperatures | None = Field(
        None, description="Temperatures of isotherms of the sweeps to leave out."
    )
    modulus_unit: Annotated[tables.Words, AfterValidator(_unit_of_modulus)] | None = Field(
        None, description="Unit of moduli (of creep compliances '1/MPa') in files that do not state it, such as 'MPa'."
    )
    columns: tables.Headings = Field(
        {}, description="Headings of tables that are not understood: { frequency = 'f in Hz' }; '#2 (Hz)' is column 2."
    )
    sheet: tables.Words | None = Field(None, description="Name of the only sheet of a workbook to read.")
    poisson_ratio: tables.Number = Field(0.5, ge=0.0, le=0.5, description="Poisson's ratio, independent of frequency.")
    reference_temperature: tables.Temperature | None = Field(
        None,
        description="Temperature at which the shift factor is one [default of sweeps and step tests: the middle one of "
        "theirs].",
    )
    vertical_shift: Literal["none", "free", "density"] = Field(
        "none", description="Vertical shift b_T: none, fitted, or density times temperature."
    )
    shift_by: Literal["both", "storage", "loss", "loss-tangent"] = Field(
        "both", description="Moduli that shift factors are found from: E' and E'', one of the two, or tan δ."
    )
    shift_weights: Annotated[
        tuple[Annotated[tables.Number, Field(gt=0.0)], ...] | None, Field(min_length=2, max_length=2)
    ] = Field(None, description="Weights of log E' and log E'' in the superposition, [1, 0.2]; equal if left out.")
    shift: Literal["measured", "best", "wlf", "arrhenius", "vft", "wlf+arrhenius", "polynomial"] = Field(
        "measured", description="Shift factors a_T: as found, or a law fitted to them."
    )
    assumed_shift: Annotated[tables.Words, AfterValidator(_assumption)] | None = Field(
        None,
        description="Law to assume for ramps, needed at one frequency: '250 kJ/mol' (activation energy), "
        "'WLF 17.44, 51.6 K, -30 degC' (C1, C2, their reference), or 'universal'.",
    )
    shift_factors: tables.FileName | None = Field(
        None, description="File of shift factors to use instead of finding them."
    )
    shift_factor_columns: tables.Headings = Field(
        {}, description="Headings in that file that are not understood: { log10_shift_factor = 'lg' }."
    )
    shift_factor_sheet: tables.Words | None = Field(
        None, description="Name of the sheet with shift factors in a workbook."
    )
    fixed_shift_factors: Annotated[
        dict[float, tables.Number],
        BeforeValidator(_by_kelvin),
        WithJsonSchema({"type": "object", "additionalProperties": {"type": "number"}}),
    ] = Field({}, max_length=1_000, description="Single shift factors to hold fixed, log10: { '-20 degC' = 4.2 }.")
    spectrum: Literal["non-negative", "regularised", "sparse"] = Field(
        "non-negative", description="Method of fitting the retardation spectrum."
    )
    modes: tables.Count | None = Field(
        None, ge=1, le=200, description="Largest number of retardation modes of a sparse spectrum."
    )
    tau_ratio: tables.Number = Field(math.e, gt=1.0, le=100.0, description="Ratio of neighbouring retardation times.")

    amplitude_sweep: tables.FileNames | None = Field(
        None, description="Amplitude sweep of the material, from which Kraus's law scales it to strain."
    )
    strain: Annotated[tables.Number, Field(gt=0.0, le=10.0)] | None = Field(
        None, description="Tensile strain to scale the moduli to, a fraction (0.05 is 5 %): an approximation."
    )
    measured_at: Annotated[tables.Number, Field(gt=0.0, le=10.0)] | None = Field(
        None, description="Tensile strain of the sweeps, a fraction; small if left out."
    )

    def _problems(self) -> Iterator[str]:
        given = [name for name in SOURCES if getattr(self, name) is not None]
        if not given:
            yield (
                'has no source of the material; give dma = "sweeps.csv" (or a master_curve, a file with a '
                "predefined material, or a name in the catalogue)"
            )
        if given in SEVERAL:
            kinds = " and ".join(given)
            yield from self._useless(_OF_ONE_KIND, f"for {kinds} together, only for one of them")
            if self.vertical_shift == "free":
                yield 'vertical_shift = "free" is fitted to one kind of tests; choose "density" or "none"'
        elif len(given) > 1:
            yield f"{' and '.join(given)} are both given; give one of them"
        if given in (["file"], ["catalogue"]):
            valid = _OF_ANY if self.amplitude_sweep is None else (*_OF_ANY, *_OF_READING)
            names = [name for name in type(self).model_fields if name not in valid]
            yield from self._useless(names, f"for a predefined material ({given[0]})")
        elif self.reference_temperature is None and (
            self.fixed_shift_factors or set(given) & {"master_curve", "ramps"}
        ):
            yield 'reference_temperature is missing; it is the temperature of the master curve, e.g. "30 degC"'
        if given == ["ramps"]:
            yield from self._doubts_of_ramps()
        if given == ["master_curve"]:
            yield from self.doubts_of_curve("for a master curve, only for sweeps (dma)", "temperature")
        yield from self._doubts_of_shifts()
        if self.modes is not None and self.spectrum != "sparse":
            yield 'modes needs spectrum = "sparse"'

    def _useless(self, names: Sequence[str], where: str) -> Iterator[str]:
        """Yield the keys among some that were given where they cannot be chosen."""
        if found := [name for name in names if name in self.model_fields_set]:
            yield f"{' and '.join(found)} cannot be chosen {where}"

    def doubts_of_curve(self, where: str, *others: str) -> Iterator[str]:
        """Yield the contradictions to one curve, whose parts are not shifted; `others` are keys invalid for it too."""
        yield from self._useless((*others, *_TO_SHIFT), where)
        if self.shift != "measured" and self.shift_factors is None:
            yield "a law for shift needs the shift factors of the master curve; give them as shift_factors"

    def _doubts_of_ramps(self) -> Iterator[str]:
        names = ["temperature", *(name for name in _TO_SHIFT if name != "vertical_shift"), "shift_factors"]
        yield from self._useless(names, "for temperature ramps")
        if self.vertical_shift == "free":
            yield 'vertical_shift = "free" cannot be found from temperature ramps; choose "density" or "none"'
        if self.shift not in ("measured", *RAMP_LAWS):
            yield f"shift of ramps is one of {', '.join(RAMP_LAWS)}; their constants are fitted to all points"
        if self.assumed_shift is not None and "shift" in self.model_fields_set:
            yield "shift and assumed_shift are both given; give one of them"

    def _doubts_of_shifts(self) -> Iterator[str]:
        for name in ("creep", "relaxation"):
            if getattr(self, name) is not None and self.dma is None:
                names = (*_OF_TWO_MODULI, "leave_out_temperatures")
                yield from self._useless(names, f"for {name} tests, only for sweeps (dma)")
        for name in ("strain", "measured_at"):
            if getattr(self, name) is not None and self.amplitude_sweep is None:
                yield f"{name} needs an amplitude_sweep, from which Kraus's law is found"
        if self.assumed_shift is not None and self.ramps is None:
            yield "assumed_shift is for temperature ramps (ramps) only"
        if self.shift_factors is not None and self.fixed_shift_factors:
            yield "shift_factors and fixed_shift_factors are both given; the first one contains all"
        for name in ("shift_factor_columns", "shift_factor_sheet"):
            if name in self.model_fields_set and self.shift_factors is None:
                yield f"{name} is for a file of shift_factors, which is not given"
        if self.shift_factors is not None:
            yield from self._useless(_OF_TWO_MODULI, "with shift_factors, which leave no factor to be found")
        if self.shift_weights is not None and self.shift_by != "both":
            yield f"shift_weights are for E' and E'' together; leave them out with shift_by = \"{self.shift_by}\""
        if self.vertical_shift == "free" and self.shift_by == "loss-tangent":
            yield 'vertical_shift = "free" cannot be found from tan δ (shift_by = "loss-tangent"), where it cancels'

    @property
    def steps(self) -> tuple[Path, ...]:
        """Files of creep or relaxation tests."""
        return self.creep or self.relaxation or ()
