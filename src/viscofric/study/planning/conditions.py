"""Cases as asked for, with their rubber: what each of them is if it is solved by itself."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeAlias

from viscofric.errors import InputError
from viscofric.study.record import Failure
from viscofric.study.solving import Task
from viscofric.study.surface_solving import SurfaceTask
from viscofric.study.sweep import SurfaceCase
from viscofric.units import celsius

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from viscofric.rheology.material import Material
    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.study.sweep import AnyCase

AnyTask: TypeAlias = Task | SurfaceTask


@dataclass(frozen=True, eq=False)
class Rubbers:
    """The materials that cases name by number, and those drawn from their posteriors.

    Attributes
    ----------
    materials : sequence of Material
    members : mapping of int to sequence of Material
        Of a material's number: its posterior's members.
    """

    materials: Sequence[Material]
    members: Mapping[int, Sequence[Material]]
    _modes: dict[tuple[int, int | None, float], RetardationSpectrum] = field(default_factory=dict, repr=False)
    _shifts: dict[tuple[int, int | None, float], tuple[float, float]] = field(default_factory=dict, repr=False)

    def of(self, case: AnyCase) -> Material:
        """Return the material that a case is solved with."""
        return self.named(case.material, case.sample)

    def named(self, material: int, sample: int | None) -> Material:
        """Return a material, or a member of its posterior.

        Raises
        ------
        InputError
            If there is none.
        """
        if sample is None:
            return self.materials[material]
        drawn = self.members.get(material, ())
        if not 1 <= sample <= len(drawn):
            raise InputError(
                f"sample {sample} of material {material} is asked for, but {len(drawn)} are drawn; right would be a "
                "number from 1 to that."
            )
        return drawn[sample - 1]

    def shifts(self, case: AnyCase) -> tuple[float, float]:
        """Return α and b of a case's material at its temperature; what many cases share is found once."""
        key = case.material, case.sample, case.temperature
        if key not in self._shifts:
            material = self.of(case)
            alpha = 1.0 if material.shift is None else float(material.shift(case.temperature))
            b = 1.0 if material.vertical_shift is None else float(material.vertical_shift(case.temperature))
            self._shifts[key] = alpha, b
        return self._shifts[key]

    def modes(self, case: AnyCase) -> RetardationSpectrum:
        """Return the modes of a case's material at its temperature."""
        key = case.material, case.sample, case.temperature
        if key not in self._modes:
            material = self.of(case)
            self._modes[key] = replace(
                material.modes_at(None if material.shift is None else case.temperature), fit=None
            )
        return self._modes[key]


@dataclass(frozen=True)
class Settings:
    """How all contacts of a plan are solved; see `Task`.

    Attributes
    ----------
    accuracy : float
    sensitive : bool
    fields : frozenset of int
        Numbers of the cases whose fields are kept.
    """

    accuracy: float
    sensitive: bool
    fields: frozenset[int]


def task_of(case: AnyCase, rubbers: Rubbers, settings: Settings, fields: bool) -> AnyTask | Failure:
    """Return what solving a case by itself takes, with its fields or without, or why that cannot be."""
    label = label_of(case)
    try:
        shared: dict[str, Any] = {
            "modes": rubbers.modes(case),
            "poisson_ratio": rubbers.of(case).poisson_ratio,
            "speed": case.speed,
            "temperature": case.temperature,
            "layer": case.layer,
            "fields": fields,
            "label": label,
        }
        if isinstance(case, SurfaceCase):
            return SurfaceTask(
                surface=case.surface,
                pressure=case.pressure,
                direction=case.direction,
                surface_modulus=case.surface_modulus,
                surface_poisson_ratio=case.surface_poisson_ratio,
                **shared,
            )
        return Task(
            indenter=case.indenter,
            load=case.load,
            accuracy=settings.accuracy,
            indenter_modulus=case.indenter_modulus,
            indenter_poisson_ratio=case.indenter_poisson_ratio,
            sensitive=settings.sensitive and case.sample is None,
            **shared,
        )
    except InputError as error:
        return Failure(str(error), label)


def label_of(case: AnyCase) -> str:
    """Say which case it is, for people."""
    sample = "" if case.sample is None else f", sample {case.sample}"
    seed = getattr(case.surface, "seed", None) if isinstance(case, SurfaceCase) else None
    of_seed = "" if seed is None else f", seed {seed}"
    return f"{celsius(case.temperature):.4g} °C, {1e3 * case.speed:.4g} mm/s{of_seed}{sample}"
