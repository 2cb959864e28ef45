"""``viscofric material show RUBBER``: the modulus of a rubber at a temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from viscofric.cli.commands import as_command, quantity
from viscofric.cli.files import DASH, DATA, to_be_written, write_dataset
from viscofric.cli.output import outputs, print_json
from viscofric.datasets import Dataset

if TYPE_CHECKING:
    from pathlib import Path

    from viscofric.rheology.material import Material


@as_command("show")
@click.argument("rubber", metavar="MATERIAL")
@quantity("--temperature", "T", "Temperature, e.g. '60 degC' [default: the material's reference].")
@click.option(
    "--frequency",
    metavar="F",
    multiple=True,
    help="Frequency, e.g. '10 Hz' or '1 rad/s'; may be repeated [default: each decade].",
)
@outputs("Write the modulus (.csv or .nc); `-` prints the table.", endings=DATA)
def command(rubber: str, temperature: str | None, frequency: tuple[str, ...], out: Path | None, as_json: bool) -> None:
    """Print a summary of MATERIAL and its modulus at a temperature.

    MATERIAL is a material file (JSON, or a card of another program), or a catalogue name.
    """
    from viscofric.cli.rubber_options import find_rubber
    from viscofric.datasets import record
    from viscofric.rheology.catalogue import is_synthetic

    material = find_rubber(rubber, "rubber")
    moduli = _moduli(material, temperature, frequency)
    if out is not None:
        with to_be_written(out) as path:
            write_dataset(path, moduli)
    if as_json:
        about = {name: getattr(material, name) for name in ("name", "citation", "poisson_ratio", "reference")}
        about["synthetic"] = is_synthetic(material)
        spectrum = material.to_dataset(temperature)
        print_json({"material": about, "spectrum": record(spectrum), "modulus": record(moduli)})
    elif out != DASH:
        click.echo("\n".join([*_about(material), *_lines(moduli)]))


def _about(material: Material) -> list[str]:
    from viscofric.rheology.catalogue import is_synthetic
    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.units import shown_celsius

    spectrum = material.spectrum
    lines = [material.name or "a rubber without a name"]
    if is_synthetic(material):
        lines.append("SYNTHETIC, not measured")
    if material.citation:
        lines.append(f"source: {material.citation}")
    if isinstance(spectrum, RetardationSpectrum):
        lines.append(f"E0 = {spectrum.E0 / 1e6:.4g} MPa, E_inf = {spectrum.E_inf / 1e6:.4g} MPa, {len(spectrum)} modes")
    lines.append(f"Poisson's ratio {material.poisson_ratio:g}")
    if material.reference is not None:
        at = shown_celsius(material.reference)
        shift = f"reference {at} °C; shift: {type(material.shift).__name__}"
        lines.append(shift if material.has_shift_factors else f"known at {at} °C only, without shift factors")
    return lines


def _moduli(material: Material, temperature: str | None, wanted: tuple[str, ...]) -> Dataset:
    """Return the moduli of a material at a temperature, at frequencies or in each decade."""
    import numpy as np

    from viscofric.rheology.spectra.retardation import RetardationSpectrum
    from viscofric.units import angular_frequency, positive

    kelvin = None if temperature is None else positive(temperature, "K", "temperature")
    now = material.at(kelvin)
    if wanted:
        omega = np.array([angular_frequency(text, "frequency") for text in wanted])
    elif isinstance(now, RetardationSpectrum):
        ends = np.log10([0.01 / now.tau.max(), 100.0 / now.tau.min()]) if len(now) else np.array([0.0, 0.0])
        omega = 10.0 ** np.arange(np.floor(ends[0]), np.ceil(ends[1]) + 1)
    else:
        first, last = np.log10(now.angular_frequency[[0, -1]])
        omega = 10.0 ** np.arange(np.ceil(first), np.floor(last) + 1)
    at = material.reference if kelvin is None else kelvin
    return now.modulus_dataset(omega).assign_attrs({} if at is None else {"temperature": at})


def _lines(moduli: Dataset) -> list[str]:
    import numpy as np

    from viscofric.showing import aligned
    from viscofric.units import shown_celsius

    at = moduli.attrs.get("temperature")
    rows = [["ω (rad/s)", "f (Hz)", "E' (MPa)", "E'' (MPa)", "tan δ"]]
    columns = (moduli[name].values for name in ("angular_frequency", "storage_modulus", "loss_modulus"))
    for frequency, storage, loss in zip(*columns, strict=True):
        numbers = (frequency, frequency / (2 * np.pi), storage / 1e6, loss / 1e6, loss / storage)
        rows.append([f"{number:.4g}" for number in numbers])
    return ["modulus:" if at is None else f"modulus at {shown_celsius(at)} °C:", *aligned(rows)]
