"""One assumption behind predicted friction, checked, and the size of the contacts for which it is checked."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import NamedTuple

from viscofric.arrays import Array
from viscofric.checks import Check
from viscofric.contact.free.scale import Scale
from viscofric.contact.indenters.indenter import Indenter
from viscofric.datasets import Dataset, dataset
from viscofric.friction.curves import FrictionCurves
from viscofric.notes import Note, Reader, note_of
from viscofric.rheology.material import Material
from viscofric.rheology.spectra.retardation import RetardationSpectrum
from viscofric.showing import Rows, Shown
from viscofric.units import plain, shown_celsius, shown_speed


@dataclass(frozen=True)
class AssumptionCheck(Shown, Check):
    """One assumption behind predicted friction, checked.

    Attributes
    ----------
    name : str
        "half-space", "small contact", "linearity", "uncoupled", "quasi-static" or "one temperature".
    value : float or None
        The number compared with the limit, an upper bound; None where something needed was not given.
    limit : float
        Largest value at which the assumption holds well.
    verdict : {"passed", "warning", "noted"}
        The last where `holds` is unknown.
    holds : bool or None
        Whether it holds; None where that is unknown.
    sentence : str
        The check in words, with lengths in mm and temperatures in °C.
    code : str
        Of the sentence.
    values : mapping
        Numbers of the sentence by name, in SI units, with the temperature, speed and load where it is worst.
    """

    def _shown(self) -> Rows:
        return (
            ("assumption", self.name),
            ("holds", "unknown" if self.holds is None else self.holds),
            ("value", self.value),
            ("limit", self.limit),
        )

    def to_dataset(self) -> Dataset:
        """Return the check as a labelled data set along ``assumption``; see `assumptions_dataset`."""
        return assumptions_dataset((self,))


def assumptions_dataset(checks: Sequence[AssumptionCheck], reader: Reader = "python") -> Dataset:
    """Return checks as a labelled data set along ``assumption``, with sentences for one kind of reader."""
    # `value` is NaN where it is not known; `holds` is 1, 0, or −1 where it cannot be judged.
    from viscofric.datasets import plain

    return dataset(
        "assumption",
        {
            "assumption_name": ([check.name for check in checks], "1", "assumption"),
            "value": (
                [math.nan if check.value is None else check.value for check in checks],
                "1",
                "value compared with the limit",
            ),
            "limit": ([check.limit for check in checks], "1", "largest value at which the assumption holds well"),
            "holds": (
                [-1 if check.holds is None else int(check.holds) for check in checks],
                "1",
                "1: the assumption holds; 0: it does not; -1: unknown",
            ),
            "sentence": ([note_of(check.sentence).words(reader) for check in checks], "1", "the check in words"),
            "code": ([check.code for check in checks], "1", "code of the sentence"),
            "sentence_values": (
                [json.dumps(plain(check.values, None), ensure_ascii=False) for check in checks],
                "1",
                "numbers of the sentence by name, JSON",
            ),
        },
    )


def assumption_checks_of(data: Dataset) -> list[AssumptionCheck]:
    """Return the checks that `assumptions_dataset` put into a data set."""
    columns = (data[name].values.tolist() for name in ("assumption_name", "holds", "value", "limit"))
    sentences = data["sentence"].values.tolist()
    if "code" in data:  # not in results of viscofric 0.1
        of_notes = (data[name].values.tolist() for name in ("code", "sentence", "sentence_values"))
        sentences = [Note(code, words, values=json.loads(held)) for code, words, held in zip(*of_notes, strict=True)]
    return [
        AssumptionCheck.of(name, _HOLDS[holds], sentence, None if math.isnan(value) else value, limit)
        for name, holds, value, limit, sentence in zip(*columns, sentences, strict=True)
    ]


_HOLDS = {1: True, 0: False, -1: None}


def verdict(low: float, high: float, limit: float) -> bool | None:
    """Whether a value that lies between two is within its limit; None if that depends."""
    if high <= limit:
        return True
    return False if low > limit else None


class Place(NamedTuple):
    """Temperature (K), speed (m/s) and load of a point of friction curves."""

    temperature: float
    speed: float
    load: float
    load_unit: str

    @classmethod
    def of(cls, curves: FrictionCurves, row: int) -> Place:
        """Return those of a row."""
        return cls(float(curves.temperature[row]), float(curves.speed[row]), float(curves.load[row]), curves.load_unit)

    @property
    def values(self) -> dict[str, float]:
        """The numbers by name."""
        return {"temperature": self.temperature, "speed": self.speed, "load": self.load}

    def __str__(self) -> str:
        line = self.load_unit == "N/m"
        load = f"{plain(1e-3 * self.load, 3)} N/mm" if line else f"{plain(self.load, 3)} {self.load_unit}"
        return f"at {shown_celsius(self.temperature, 'z.0f')} °C, {shown_speed(self.speed, 3)} and {load}"


def modes_of(material: Material, kelvin: float) -> RetardationSpectrum:
    """Return the modes at a temperature; of a material without shift factors, at the only one that it has."""
    return material.modes_at(None if material.shift is None else kelvin)


def modes_by_temperature(material: Material) -> Callable[[float], RetardationSpectrum]:
    """Return what gives the modes at a temperature, K, and finds those of each once: points of curves share few."""
    return cache(partial(modes_of, material))


@dataclass(frozen=True)
class ContactSize:
    """Size of one contact, as solved or between two of Hertz's."""

    smallest: float  # m, limits of its radius, of a line contact half its width; the same where it was solved
    largest: float  # m
    relaxed: float  # m, Hertz's radius at the relaxed modulus E0, of a round contact: none is larger
    curvature: float  # 1/m, of the equivalent paraboloid
    where: Place

    @classmethod
    def all_of(
        cls, material: Material, indenter: Indenter, curves: FrictionCurves, solved: Array | None = None
    ) -> list[ContactSize]:
        """Return the sizes at the points of friction curves, given the solved radii, m, if there are any."""
        plane_strain = 1.0 - material.poisson_ratio**2
        modes_at = modes_by_temperature(material)
        scale_at = cache(partial(Scale.for_load, indenter))
        found = []
        for row, kelvin in enumerate(curves.temperature.tolist()):
            spectrum, where = modes_at(kelvin), Place.of(curves, row)
            scale = scale_at(spectrum.E0 / plane_strain, where.load)
            smallest = largest = scale.length
            # Hertz: a³ ~ F R/E of a ball, a² ~ F R/E of a cylinder.
            power = 1.0 / (1.0 + scale.geometry.dimension)
            for _ in range(50 if solved is None else 0):
                modulus = abs(complex(spectrum.complex_modulus(where.speed / smallest)))
                before, smallest = smallest, scale.length * (spectrum.E0 / modulus) ** power
                if abs(smallest - before) <= 1e-3 * smallest:
                    break
            if solved is not None:
                smallest = largest = float(solved[row])
            found.append(cls(smallest, largest, scale.length, scale.slope / scale.length, where))
        return found

    @property
    def measure(self) -> str:
        """What the size is called."""
        return "half width of the contact" if self.where.load_unit == "N/m" else "contact radius"

    @property
    def values(self) -> dict[str, float]:
        """Limits of the radius, m, and the place."""
        return {"smallest_radius": self.smallest, "largest_radius": self.largest, **self.where.values}

    def __str__(self) -> str:
        if self.smallest == self.largest:
            return f"The {self.measure} is {1e3 * self.largest:.2g} mm ({self.where})"
        return (
            f"The {self.measure} is about {1e3 * self.smallest:.2g} and at most {1e3 * self.largest:.2g} mm "
            f"(Hertz's at |E(v/a)| and at the relaxed modulus, {self.where})"
        )
