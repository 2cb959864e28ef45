"""Anton Paar RheoCompass exports, written from a description of the layout: no genuine file was at hand."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from readers.samples.rubber import TEMPERATURES, points


class Language(NamedTuple):
    """The words of one language, and its decimal mark."""

    project: str
    result: str
    interval: str
    data: str
    point: str
    frequency: str
    storage: str
    loss: str
    strain: str
    temperature: str
    rate: str
    status: str
    mark: str


ENGLISH = Language(
    "Project:", "Result:", "Interval and data points:", "Interval data:", "Point No.", "Angular Frequency",
    "Storage Modulus", "Loss Modulus", "Shear Strain", "Temperature", "Shear Rate", "Status", ".",
)  # fmt: skip
GERMAN = Language(
    "Projekt:", "Ergebnis:", "Abschnitt und Datenpunkte:", "Abschnittsdaten:", "Punkt-Nr.", "Kreisfrequenz",
    "Speichermodul", "Verlustmodul", "Scherdeformation", "Temperatur", "Scherrate", "Status", ",",
)  # fmt: skip
FRENCH = Language(
    "Projet:", "Résultat:", "Intervalle et points de données:", "Interval données:", "Point No.", "Fréquence Angulaire",
    "Module de Stockage", "Module de Perte", "Déformation de Cisaillement", "Température", "Gradient de Cisaillement",
    "Etat", ",",
)  # fmt: skip
PORTUGUESE = Language(
    "Projeto:", "Resultado:", "Intervalo e ponto de dados:", "Dados do intervalo:", "No. do Ponto",
    "Frequência Angular", "Módulo de Armazenamento", "Módulo de Perda", "Deformação de Cisalhamento", "Temperatura",
    "Taxa de Cisalhamento", "Status", ",",
)  # fmt: skip
SPANISH = Language(
    "Proyecto:", "Resultado:", "Intervalo y puntos de datos:", "Datos del intervalo:", "Punto n.º",
    "Frecuencia angular", "Módulo de almacenamiento", "Módulo de pérdida", "Deformación de cizalla", "Temperatura",
    "Velocidad de cizalla", "Estado", ",",
)  # fmt: skip
ITALIAN = Language(
    "Progetto:", "Risultato:", "Intervallo e punti dati:", "Dati intervallo:", "Punto n.", "Frequenza angolare",
    "Modulo conservativo", "Modulo dissipativo", "Deformazione di taglio", "Temperatura", "Velocità di taglio",
    "Stato", ",",
)  # fmt: skip
LANGUAGES = {
    "english": ENGLISH,
    "german": GERMAN,
    "french": FRENCH,
    "portuguese": PORTUGUESE,
    "spanish": SPANISH,
    "italian": ITALIAN,
}


def lines(words: Language) -> list[str]:
    """Return an export of two results: sweeps of 0.1 % strain, the last after a rotation and a sweep of amplitude."""

    def number(value: float) -> str:
        return f"{value:.8G}".replace(".", words.mark)

    def interval(place: int, columns: list[tuple[str, str]], rows: list[list[float]]) -> list[str]:
        head = [f"{words.interval}\t{place}\t{len(rows)}"]
        head.append("\t".join([words.data, words.point, *(name for name, _ in columns), words.status]))
        head.append("\t" * (len(columns) + 2))
        head.append("\t".join(["", "", *(unit for _, unit in columns), ""]))
        body = [
            "\t".join(["", str(index), *(number(value) for value in row), "Dy_auto"])
            for index, row in enumerate(rows, start=1)
        ]
        return [*head, *body, ""]

    sweep = [(words.temperature, "[°C]"), (words.frequency, "[rad/s]"), (words.storage, "[kPa]"), (words.loss, "[Pa]")]
    sweep.append((words.strain, "[%]"))
    found = [f"{words.project}\tRubber", "", "Test:\tSweeps of frequency", "", f"{words.result}\tSweeps 1", ""]
    for place, temperature in enumerate(TEMPERATURES, start=1):
        if temperature == TEMPERATURES[-1]:
            found += [f"{words.result}\tSweeps 2", ""]
            found += interval(1, [(words.temperature, "[°C]"), (words.rate, "[1/s]")], [[30.0, 1.5], [30.0, 2.5]])
            held = [[30.0, 6.2831853, 10.0, 5e3, strain] for strain in (0.1, 1.0, 10.0)]
            found += interval(2, sweep, held)
        own = [point for point in points() if point[0] == temperature]
        # From high to low frequency, as rheometers sweep.
        rows = [[T, 2.0 * math.pi * f, storage / 1e3, loss, 0.1] for T, f, storage, loss in reversed(own)]
        found += interval(place, sweep, rows)
    return found


def _write(name: str, words: Language) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        path = folder / f"rheocompass_{name}.csv"
        path.write_bytes(b"\xff\xfe" + ("\r\n".join(lines(words)) + "\r\n").encode("utf-16-le"))
        return path

    return write


SAMPLES: dict[str, Callable[[Path], Path]] = {
    f"rheocompass {name}": _write(name, words) for name, words in LANGUAGES.items()
}
