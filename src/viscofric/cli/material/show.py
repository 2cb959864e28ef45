"""``viscofric material show RUBBER``: the modulus of a rubber at a temperature."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from viscofric.cli.errors import reported_errors

if TYPE_CHECKING:
    from viscofric.rheology.material import Material


@click.command(name="show")
@click.argument("rubber", metavar="MATERIAL")
@click.option("--temperature", metavar="T", help="Temperature, e.g. '60 degC' [default: the material's reference].")
@click.option(
    "--frequency",
    metavar="F",
    multiple=True,
    help="Frequency, e.g. '10 Hz' or '1 rad/s'; may be repeated [default: each decade].",
)
def command(rubber: str, temperature: str | None, frequency: tuple[str, ...]) -> None:
    """Print a summary of MATERIAL and its modulus at a temperature.

    MATERIAL is a material file (JSON, CSV, or a card of another program), or a catalogue name.
    """
    from viscofric.cli.rubber_options import find_rubber

    with reported_errors():
        material = find_rubber(rubber)
        lines = [*_about(material), *_moduli(material, temperature, frequency)]
    for line in lines:
        click.echo(line)


def _about(material: Material) -> list[str]:
    from viscofric.rheology import RetardationSpectrum
    from viscofric.units import shown_celsius

    spectrum = material.spectrum
    lines = [material.name or "a rubber without a name"]
    if material.citation:
        lines.append(f"source: {material.citation}")
    if isinstance(spectrum, RetardationSpectrum):
        lines.append(f"E0 = {spectrum.E0 / 1e6:.4g} MPa, E_inf = {spectrum.E_inf / 1e6:.4g} MPa, {len(spectrum)} modes")
    lines.append(f"Poisson's ratio {material.poisson_ratio:g}")
    if material.reference is not None:
        lines.append(f"reference {shown_celsius(material.reference)} °C; shift: {type(material.shift).__name__}")
    return lines


def _moduli(material: Material, temperature: str | None, wanted: tuple[str, ...]) -> list[str]:
    import numpy as np

    from viscofric.rheology import RetardationSpectrum
    from viscofric.units import angular_frequency, positive, shown_celsius

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
    modulus = now.complex_modulus(omega)
    at = material.reference if kelvin is None else kelvin
    heading = "" if at is None else f" at {shown_celsius(at)} °C"
    headings = zip(("ω (rad/s)", "f (Hz)", "E' (MPa)", "E'' (MPa)", "tan δ"), (12, 10, 10, 10, 8), strict=True)
    lines = ["  ".join(f"{name:>{width}}" for name, width in headings) + heading]
    for frequency, value in zip(omega, modulus, strict=True):
        lines.append(
            f"{frequency:12.4g}  {frequency / (2 * np.pi):10.4g}  {value.real / 1e6:10.4g}  {value.imag / 1e6:10.4g}"
            f"  {value.imag / value.real:8.4g}"
        )
    return lines
