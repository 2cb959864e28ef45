"""``viscofric transient``: one contact over time, as text, JSON, tables, figures and an animation."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from viscofric.cli import INTERRUPTED, TERMINATED, Terminated
from viscofric.cli.commands import as_command, quantity
from viscofric.cli.contact import Contact, heating_options
from viscofric.cli.contact_options import direction_option, elastic_options, indenter_options, surface_options
from viscofric.cli.errors import print_notes
from viscofric.cli.files import DATA, PICTURES, WRITTEN, Source, check_ending, write_dataset
from viscofric.cli.history_options import chosen_history, chosen_times, history_options
from viscofric.cli.output import answer, drawing, json_record, outputs, print_pairs, write_files
from viscofric.cli.rubber_options import layer_options, rubber_options

if TYPE_CHECKING:
    from viscofric.motion.cycle_solution import CycleSolution
    from viscofric.motion.history import History
    from viscofric.motion.solution import TransientSolution

_EXAMPLE = """\b
Examples:
  viscofric transient --material "synthetic fluoroelastomer" --ball "9.525 mm" \\
      --load "25 N" --dwell "0.1 s" --slide "20 mm" --speed "100 mm/s" --temperature "60 degC" --accuracy 5e-3
  viscofric transient --material "synthetic fluoroelastomer" --ball "9.525 mm" \\
      --history test.csv --picture test.svg
  viscofric transient --material "synthetic fluoroelastomer" --surface scan.x3p --pressure "0.2 MPa" \\
      --dwell "10 ms" --slide "1 mm" --speed "10 mm/s" --save-state start.npz
"""


@as_command("transient", epilog=_EXAMPLE)
@rubber_options
@layer_options
@indenter_options
@surface_options
@history_options
@direction_option
@elastic_options
@heating_options(steady=False)
@click.option(
    "--accuracy", default=1e-3, help="Target relative error of load, indentation, friction and energy in time."
)
@click.option("--cycle", is_flag=True, help="Solve the periodic state of the history as one repeated period.")
@quantity(
    "--coulomb",
    "μ",
    "Coulomb friction coefficient, for the total friction; its shear is left out, a note has the effect.",
    default=0.0,
)
@click.option("--resume", type=Source(), metavar="FILE", help="Continue a run from its --save-state (.npz).")
@click.option("--save-state", "state", type=WRITTEN, help="Write the last state (.npz) for --resume.")
@outputs(
    "Write the results over time (.csv or .nc); `-` prints the table.",
    endings=DATA,
    picture="Draw forces, indentation, contact and pressures",
)
@click.option("--pressures", type=WRITTEN, help="Draw the pressure at --times, or at five times (PNG, SVG or PDF).")
@click.option("--animation", type=WRITTEN, help="Draw the pressure over time beside the friction (GIF).")
def command(as_json: bool, out: Path | None, state: Path | None, **parameters: Any) -> None:
    """Solve one contact over time: loading, dwell, start, sliding, return.

    Quantities carry their unit. Without --history, the load is applied at the start; after --dwell, the indenter
    slides. Interrupting (Ctrl-C) keeps the results up to the time reached.
    """
    drawings = {name: parameters.pop(name) for name in ("picture", "pressures", "animation")}
    for name, target in drawings.items():
        check_ending(target, f"--{name}", (".gif",) if name == "animation" else PICTURES)
    check_ending(state, "--save-state", (".npz",))
    _check_pairs(parameters | {"state": state})
    from viscofric.motion.cycle_solution import CycleSolution

    contact = Contact(parameters, out, state, *drawings.values())
    geometry = getattr(contact.body.indenter, "geometry", None)  # a rough surface has none
    line = geometry is not None and geometry.dimension == 1
    history = chosen_history(parameters, line, contact.rubber.material.reference)
    began = time.perf_counter()
    film, drawn = drawings["animation"] is not None, any(drawings.values())
    result = _solved(parameters, contact, history, film=film, drawn=drawn, quiet=as_json)
    seconds = time.perf_counter() - began
    run = result.run if isinstance(result, CycleSolution) else result
    if not len(run.time):  # nothing was reached
        raise KeyboardInterrupt
    answer(
        lambda: _record(contact, history, result, seconds),
        lambda: _print(contact.title, history, result, seconds),
        indent=None,
    )
    _write(contact, result, parameters["times"] is not None, {"out": out, "state": state, **drawings})
    print_notes(run.warnings, word="Warning")
    if run.interrupted:
        word, status = ("Terminated", TERMINATED) if Terminated.received else ("Interrupted", INTERRUPTED)
        click.echo(f"{word} after {run.time[-1]:.4g} s of the history; the results end there.", err=True)
        click.get_current_context().exit(status)


def _check_pairs(parameters: dict[str, Any]) -> None:
    """Refuse options that exclude each other."""
    if parameters["cycle"] and parameters["heating"] is not None:
        raise click.UsageError("--cycle and --heating are both given; a periodic state is isothermal.")
    if parameters["coulomb"] and parameters["heating"] is not None:
        raise click.UsageError(
            "--coulomb and --heating are both given; Coulomb friction that heats is --heating-coulomb."
        )
    reasons = {"cycle": "a periodic state has no end", "heating": "a heated contact has no state"}
    for one, reason in reasons.items():
        for name, typed in (("resume", "--resume"), ("state", "--save-state")):
            if parameters[one] and parameters[name] is not None:
                raise click.UsageError(f"--{one} and {typed} are both given; {reason} to go on from.")


def _solved(
    parameters: dict[str, Any], contact: Contact, history: History, *, film: bool, drawn: bool, quiet: bool
) -> TransientSolution | CycleSolution:
    """Solve the history, or its periodic state."""
    from viscofric.cli.progress import time_bar
    from viscofric.motion.cycle import solve_cycle
    from viscofric.motion.solve import solve_transient

    material, body = contact.rubber.material, contact.body.indenter
    pictures = film or (drawn and parameters["cycle"])  # of a cycle, only the pressures asked for are kept
    times = chosen_times(parameters, history, film=pictures)
    if parameters["cycle"]:
        shown = "{:.0f} periods, {:.2g} away from the periodic state"
        with time_bar("Periodic state", quiet=quiet, shown=shown) as bar:
            return solve_cycle(material, body, history, times=times, progress=bar, **contact.settings)
    with time_bar("Contact over time", quiet=quiet) as bar:
        return solve_transient(
            material, body, history, times=times, progress=bar, resume=parameters["resume"],
            heating=contact.heating, **contact.settings,
        )  # fmt: skip


def _record(
    contact: Contact,
    history: History,
    result: TransientSolution | CycleSolution,
    seconds: float,
) -> dict[str, Any]:
    """Return the request and the results in plain types, SI."""
    from viscofric.report.texts.motion import notes_on_errors

    run: Any = getattr(result, "run", result)
    kelvin = None if history.temperature is None else float(history.temperature[0])
    names = ("time", history.control, "position", "speed", "temperature", "before", "direction")
    said = {name: getattr(history, name) for name in names if getattr(history, name) is not None}
    return json_record(
        "transient 2",
        contact.record(kelvin) | {"history": said},
        result.to_dataset(),
        **{name: getattr(run, name) for name in ("interrupted", "steps", "rejected_steps")},
        seconds=seconds,
        notes=notes_on_errors(run),
        warnings=run.warnings,
    )


def _print(title: str, history: History, result: TransientSolution | CycleSolution, seconds: float) -> None:
    from viscofric.motion.cycle_solution import CycleSolution
    from viscofric.report.texts.motion import cycle_lines, history_words, notes_on_errors, transient_lines

    click.echo(title)
    if isinstance(result, CycleSolution):
        click.echo(f"{history_words(history, result.run.geometry)}, repeated\n")
        print_pairs(cycle_lines(result, seconds))
    else:
        click.echo(f"{history_words(history, result.geometry)}, {history.before} before\n")
        print_pairs(transient_lines(result, seconds))
    for note in notes_on_errors(result.run if isinstance(result, CycleSolution) else result):
        click.echo(f"Note: {note}")


def _write(
    contact: Contact,
    result: TransientSolution | CycleSolution,
    at_times: bool,
    targets: dict[str, Path | None],
) -> None:
    """Write the requested files; pressures `at_times` are those at all times of the solution."""
    run: Any = getattr(result, "run", result)
    name, synthetic = contact.name, contact.synthetic
    whole = drawing("pressures.transient_figure", run, name, mark=synthetic)
    strip = drawing("pressures.pressure_strip", run, run.time if at_times else None, name, mark=synthetic)

    def animate(path: Path) -> None:
        from viscofric.report.figures.animation import save_animation

        save_animation(path, run, name, synthetic=synthetic)

    write_files(
        ("state", targets["state"], lambda path: run.save_state(path)),  # noqa: PLW0108 - not of all of them
        ("data", targets["out"], lambda path: write_dataset(path, result.to_dataset())),
        ("picture", targets["picture"], whole),
        ("picture", targets["pressures"], strip),
        ("animation", targets["animation"], animate),
    )
