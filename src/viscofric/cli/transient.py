"""``viscofric transient``: one contact over time, as text, JSON, tables, figures and an animation."""

from __future__ import annotations

import json
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli import INTERRUPTED
from viscofric.cli.contact_options import (
    chosen_indenter,
    direction_option,
    elastic_options,
    elastic_record,
    elastic_settings,
    indenter_options,
    inputs_of,
)
from viscofric.cli.errors import reported_errors
from viscofric.cli.files import DASH, OUT, PICTURES, check_ending, refuse_to_overwrite, write_dataset
from viscofric.cli.history_options import chosen_history, chosen_times, history_inputs, history_options
from viscofric.cli.rubber_options import chosen_layer, chosen_rubber, in_contact, rubber_options

if TYPE_CHECKING:
    from viscofric.cli.contact_options import NamedIndenter
    from viscofric.cli.rubber_options import NamedRubber
    from viscofric.motion.history import History
    from viscofric.motion.solution import TransientSolution

_FILE = click.Path(path_type=Path, dir_okay=False)
_TABLES = (".nc", ".csv")
#: Times of an animation, where none are given.
_FILM = 120

_EXAMPLE = """\b
Examples:
  viscofric transient --material "synthetic fluoroelastomer" --ball "9.525 mm" \\
      --load "25 N" --dwell "0.1 s" --slide "20 mm" --speed "100 mm/s" --temperature "60 degC"
  viscofric transient --material "synthetic fluoroelastomer" --ball "9.525 mm" \\
      --history test.csv --picture test.svg
"""


@click.command(name="transient", epilog=_EXAMPLE)
@rubber_options
@indenter_options
@history_options
@direction_option
@elastic_options
@click.option(
    "--accuracy",
    type=float,
    default=1e-3,
    show_default=True,
    help="Target relative error of load, indentation, friction and energy in time.",
)
@click.option("--json", "as_json", is_flag=True, help="Print inputs and results over time as JSON, in SI units.")
@click.option("-o", "--out", type=OUT, help="Write the results over time (.csv or .nc); `-` prints the table.")
@click.option("--picture", type=_FILE, help="Draw forces, indentation, contact and pressures (PNG, SVG or PDF).")
@click.option("--pressures", type=_FILE, help="Draw the pressure at --times, or at five times (PNG, SVG or PDF).")
@click.option(
    "--animation",
    type=_FILE,
    help=f"Draw the pressure over time beside the friction (GIF); sets --points {_FILM} without --times.",
)
def command(as_json: bool, out: Path | None, **parameters: Any) -> None:
    """Solve one contact over time: loading, dwell, start, sliding, return.

    Quantities carry their unit. Without --history, the load is applied at the start; after --dwell, the indenter
    slides. Interrupting (Ctrl-C) keeps the results up to the time reached.
    """
    drawings = {name: parameters.pop(name) for name in ("picture", "pressures", "animation")}
    _check_targets(parameters, out, drawings)
    with reported_errors():
        from viscofric.cli.progress import time_bar
        from viscofric.motion.solve import solve_transient

        rubber, shape = chosen_rubber(parameters), chosen_indenter(parameters)
        layer = chosen_layer(parameters)
        history = chosen_history(parameters, shape.indenter.geometry.dimension, rubber.material.reference)
        times = chosen_times(parameters, history)
        if times is None and drawings["animation"] is not None:
            times = chosen_times({**parameters, "points": _FILM}, history)
        began = time.perf_counter()
        with time_bar("Contact over time", quiet=as_json) as bar:
            run = solve_transient(
                rubber.material,
                shape.indenter,
                history,
                times=times,
                accuracy=parameters["accuracy"],
                layer=layer,
                progress=bar,
                **elastic_settings(parameters),
            )
        seconds = time.perf_counter() - began
        if not len(run.time):  # nothing was reached
            raise KeyboardInterrupt
        name = in_contact(shape.words, rubber, layer)
        if as_json:
            click.echo(json.dumps(_record(parameters, rubber, shape, history, run, seconds), ensure_ascii=False))
        elif out != DASH:
            _print(name, rubber, history, run, seconds)
        if out is not None:
            write_dataset(out, run.to_dataset())
        said = [] if out in (None, DASH) else [f"data     {out}"]
        for written in [*said, *_draw(name, rubber, run, parameters["times"] is not None, **drawings)]:
            click.echo(written, err=as_json or out == DASH)
        for warning in run.warnings:
            click.echo(f"Warning: {warning}", err=True)
    if run.interrupted:
        click.echo(f"Interrupted after {run.time[-1]:.4g} s of the history; the results end there.", err=True)
        click.get_current_context().exit(INTERRUPTED)


def _check_targets(parameters: dict[str, Any], out: Path | None, drawings: dict[str, Path | None]) -> None:
    check_ending(out, "--out", _TABLES)
    for name, target in drawings.items():
        check_ending(target, f"--{name}", (".gif",) if name == "animation" else PICTURES)
    inputs = [*inputs_of(parameters), *history_inputs(parameters)]
    for target in (out, *drawings.values()):
        if target is not None:
            refuse_to_overwrite(target, inputs)


def _record(
    parameters: dict[str, Any],
    rubber: NamedRubber,
    shape: NamedIndenter,
    history: History,
    run: TransientSolution,
    seconds: float,
) -> dict[str, Any]:
    """Return the request and the results in plain types, SI."""
    from viscofric.report.texts.motion import transient_record

    layer = chosen_layer(parameters)
    kelvin = None if history.temperature is None else float(history.temperature[0])
    inputs = {
        "material": rubber.record(kelvin),
        "layer": None if layer is None else {"thickness": layer.thickness, "bonded": layer.bonded},
        "indenter": shape.record | {"elastic": elastic_record(parameters)},
        "accuracy": parameters["accuracy"],
    }
    return transient_record(inputs, history, run, seconds)


def _print(name: str, rubber: NamedRubber, history: History, run: TransientSolution, seconds: float) -> None:
    from viscofric.report.texts.motion import history_words, transient_lines

    synthetic = " (SYNTHETIC, not measured)" if rubber.synthetic else ""
    click.echo(f"{name}{synthetic}")
    click.echo(f"{history_words(history, run.geometry)}\n")
    lines = transient_lines(run, seconds)
    width = max(len(quantity) for quantity, _ in lines)
    for quantity, value in lines:
        click.echo(f"{quantity:<{width}}  {value}")


def _draw(
    name: str,
    rubber: NamedRubber,
    run: TransientSolution,
    at_times: bool,
    *,
    picture: Path | None,
    pressures: Path | None,
    animation: Path | None,
) -> list[str]:
    """Write the requested drawings, and return the messages about them."""
    said = []
    if picture is not None or pressures is not None:
        from viscofric.report.figures.pressures import pressure_strip, transient_figure
        from viscofric.report.figures.saving import save_picture

        shown = run.time if at_times else None
        for path, draw in (
            (picture, partial(transient_figure, run, name)),
            (pressures, partial(pressure_strip, run, shown, name)),
        ):
            if path is not None:
                save_picture(path, draw, name="contact over time", synthetic=rubber.synthetic)
                said.append(f"picture  {path}")
    if animation is not None:
        from viscofric.report.figures.animation import save_animation

        save_animation(animation, run, name, synthetic=rubber.synthetic)
        said.append(f"animation {animation}")
    return said
