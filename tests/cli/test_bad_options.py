"""A bad value of any option of any command: the error names the option, or the file, and nothing of Python."""

from __future__ import annotations

import contextlib
import re
import shlex
import shutil
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path
from types import FrameType

import click
import numpy as np
import pytest
from click.testing import CliRunner

import viscofric as vf
from cli.calls import refusal_of
from cli.friction_files import curves, runs
from rheology.planted import write_amplitudes, write_moduli
from viscofric.cli import main

pytestmark = pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs a timer of the system")

_RUBBER = "--material 'synthetic fluoroelastomer'"
_CONTACT = "--ball '9.525 mm' --load '25 N'"
_OF_DMA = "--dma dma.csv --reference '30 degC'"
_INDENTED = "--ball '10 mm' --temperature '23 degC' --modes 8 --samples 20"
#: Good calls of the commands that have options with values; each option is tried with the first where it fits.
BASES = (
    f"solve {_RUBBER} {_CONTACT} --speed '20 mm/s' --temperature '60 degC' --accuracy 0.1",
    f"curve {_RUBBER} {_CONTACT} --speed '20 mm/s' --temperature '60 degC' --accuracy 0.1",
    f"transient {_RUBBER} {_CONTACT} --dwell '1 ms' --temperature '60 degC' --accuracy 0.1",
    f"impact {_RUBBER} --ball '9.525 mm' --mass '33 g' --speed '0.1 m/s' --temperature '60 degC' --accuracy 0.01",
    "measure runs.csv",
    "master curves.csv --ball '9.525 mm'",
    "identify curves.csv --ball '9.525 mm' --modes 8 --samples 20 --accuracy 0.1",
    "compare curves.csv curves.csv",
    "run study.toml --out run --finished-only",
    "web --no-browser",
    "verify",
    "new made",
    "export results",
    "material read dma.csv",
    "material fit dma.csv --reference '30 degC' --samples 20 --out fitted",
    "material ramp ramps.csv --reference '30 degC'",
    f"material amplitude payne.csv {_RUBBER} --strain 5 --out scaled.json",
    f"material indentation creep.csv --control load {_INDENTED} --error '1 um'",
    "material show 'synthetic fluoroelastomer' --temperature '60 degC'",
    "material convert 'synthetic fluoroelastomer' card.inp --format abaqus",
)
#: Options that exclude each other.
GROUPS = (
    {"--ball", "--cylinder", "--ellipsoid", "--cone", "--punch", "--height-map", "--profile", "--surface"},
    {"--load", "--indentation", "--pressure"},
    {"--material", "--dma", "--E0", "--E-inf", "--tau"},
    {"--dwell", "--history"},
    {"--times", "--points"},
)
_HEATED = "--heating steel"
_SLID = "--slide '1 mm' --speed '20 mm/s'"
_SIZE = "--anchor-area '2 mm^2' --anchor-load '1 N' --anchor-speed '1 mm/s' --anchor-temperature '30 degC'"
_MODULUS = "--anchor-modulus '2 MPa' --anchor-frequency '1 Hz' --anchor-temperature '30 degC'"
#: What an option leaves no place for, besides what `GROUPS` has.
REPLACES = {
    "--history": {"--load", "--dwell", "--temperature"},
    "--surface": {"--load"},
    "--E0": {"--temperature"},
}
#: What an option needs beside it.
NEEDS = {
    "--spacing": "--profile heights.txt",
    "--height-unit": "--profile heights.txt --spacing '5 um' --load '1e-4 N/m'",
    "--height-map": "--spacing '5 um'",
    "--profile": "--spacing '5 um'",
    "--surface": "--spacing '5 um'",
    "--prepare": "--surface heights.txt --spacing '5 um' --pressure '1 MPa'",
    "--indenter-poisson-ratio": "--indenter-modulus '1 GPa'",
    "--dma": "--reference '30 degC'",
    "--modulus-unit": _OF_DMA,
    "--E0": "--E-inf '10 MPa' --tau '1 ms'",
    "--E-inf": "--E0 '1 MPa' --tau '1 ms'",
    "--tau": "--E0 '1 MPa' --E-inf '10 MPa'",
    "--poisson-ratio": "--E0 '1 MPa' --E-inf '10 MPa' --tau '1 ms'",
    "--heating-rubber": f"{_HEATED} --heating-coulomb 0.4",
    "--heating-coulomb": _HEATED,
    "--heating-slip": f"{_HEATED} --heating-coulomb 0.4",
    "--heating-track": f"{_HEATED} --heating-coulomb 0.4",
    "--slide": "--speed '20 mm/s'",
    "--strokes": _SLID,
    "--history-column": "--history history.csv",
    "--history-sheet": "--history history.csv",
    "--zero-error": "--zero '0.1 N'",
    "--coulomb-error": "--coulomb 0.05",
    "--anchor-modulus": _MODULUS,
    "--anchor-frequency": _MODULUS,
    "--anchor-indentation": _SIZE.replace("--anchor-area '2 mm^2'", ""),
    "--anchor-half-width": _SIZE.replace("--anchor-area '2 mm^2'", ""),
    "--anchor-area": _SIZE,
    "--anchor-speed": _SIZE,
    "--anchor-load": _SIZE,
    "--anchor-temperature": _SIZE,
    "--anchor-error": _SIZE,
    "--prior-band": "--prior 'synthetic fluoroelastomer'",
    "--prior-error": "--prior 'synthetic fluoroelastomer'",
    "--shift-factor-column": "--shift shift.csv",
    "--shift-factor-sheet": "--shift shift.csv",
    "--reference": "",
    "--beside": "--picture a.svg",
    "--assumed-shift": "",
    "--card-law": "",
}
#: As `NEEDS`, of one command.
NEEDS_OF = {
    ("transient", "--speed"): "--slide '1 mm'",
    ("transient", "--direction"): _SLID,
    ("solve", "--reference"): "--dma dma.csv",
    ("curve", "--reference"): "--dma dma.csv",
    ("curve", "--samples"): _OF_DMA,
    ("transient", "--reference"): "--dma dma.csv",
    ("impact", "--height-unit"): "--profile heights.txt --spacing '5 um'",
    ("material indentation", "--height-unit"): "--profile heights.txt --spacing '5 um'",
    (
        "material amplitude",
        "--height-unit",
    ): "--profile heights.txt --spacing '5 um' --load '1e-4 N/m' --speed '1 mm/s'",
    ("impact", "--reference"): "--dma dma.csv",
    ("identify", "--reference"): "--shift 'synthetic fluoroelastomer'",
    ("master", "--reference"): "--shift 'synthetic fluoroelastomer'",
    ("material fit", "--poisson-ratio"): "",
    ("material ramp", "--poisson-ratio"): "",
    ("material indentation", "--poisson-ratio"): "",
    ("material indentation", "--depth"): "--amplitude '2 um'",
    ("material indentation", "--amplitude"): "--depth '100 um'",
    ("material indentation", "--reference"): "--shift 'synthetic fluoroelastomer'",
    ("material convert", "--poisson-ratio"): "",
    ("identify", "--poisson-ratio"): "",
    ("material fit", "--modulus-unit"): "",
    ("material fit", "--modes"): "--spectrum sparse",
    ("material fit", "--tau-ratio"): "--spectrum sparse",
    ("material fit", "--shift-factor-column"): "--shift-factors shift.csv",
    ("material fit", "--shift-factor-sheet"): "--shift-factors shift.csv",
    ("material read", "--modulus-unit"): "",
    ("material ramp", "--modulus-unit"): "",
    ("material amplitude", "--modulus-unit"): "",
    ("material amplitude", "--ball"): "--load '25 N' --speed '20 mm/s'",
    ("material amplitude", "--cylinder"): "--load '25 N/m' --speed '20 mm/s'",
    ("material amplitude", "--load"): "--ball '9.525 mm' --speed '20 mm/s'",
    ("material amplitude", "--speed"): "--ball '9.525 mm' --load '25 N'",
    ("material amplitude", "--contact-temperature"): "--ball '9.525 mm' --load '25 N' --speed '20 mm/s'",
    ("material amplitude", "--ellipsoid"): "--load '25 N' --speed '20 mm/s'",
    ("material amplitude", "--cone"): "--load '25 N' --speed '20 mm/s'",
}
#: Other files that a call is made with, for options of other kinds of data.
FILES_OF = {
    ("material indentation", "--depth"): "stiffness.csv",
    ("material indentation", "--amplitude"): "stiffness.csv",
    ("material indentation", "--mass"): "rebound.csv",
}
#: Options that commands share with `measure`, where they are tried; the others are given friction curves.
SEPARATION = (
    *("zero", "zero-error", "coulomb", "coulomb-error", "except-steps"),
    *("speed-tolerance", "temperature-tolerance"),
)
#: Options that take any text, or whose values are not judged by viscofric.
ANY = {"--out", "--host", "--port", "--name", "--scheduler"}
#: Options for which no text means their default.
DEFAULTED = {"--height-unit", "--shift-factor-sheet"}
#: Kinds of bad values: text, a unit that nothing has, and numbers of the right unit.
TEXTS = ("abc", "", "3 mol", "nan", "-1", "0")
NUMBERS = ("-1", "0", "nan", "inf", "1e300", "-1e-300")
_SIZES = ("layer", "window", "anchor_indentation", "anchor_half_width")
UNITS = {
    "m": (
        "ball",
        "cylinder",
        "punch",
        "spacing",
        "indentation",
        "slide",
        "depth",
        "amplitude",
        "layer",
        "window",
        *_SIZES,
    ),
    "m/s": ("speed", "speeds", "heating_slip", "anchor_speed"),
    "N": ("load", "zero", "zero_error", "anchor_load"),
    "Pa": ("pressure", "rubber_modulus", "glass_modulus", "indenter_modulus", "anchor_modulus"),
    "degC": ("temperature", "temperatures", "reference", "contact_temperature", "anchor_temperature"),
    "K": ("temperature", "temperatures", "reference", "temperature_tolerance"),
    "s": ("tau", "load_time", "dwell", "times", "start"),
    "kg": ("mass",),
    "deg": ("cone", "direction"),
    "Hz": ("frequency", "anchor_frequency"),
    "m^2": ("anchor_area",),
    "m/s^2": ("gravity",),
    "K/min": ("heating_rate",),
    "g/cm^3": ("density",),
}
#: A word of Python: letters with an underscore inside, which no option and no quoted value has.
_PYTHON = re.compile(r"\b[A-Za-z]+(?:_[A-Za-z0-9]+)+\b|\w\(\w+[,)]|[a-z]=\w")
_LONGEST = 1.0  # s of computing, after which a value counts as accepted


def commands() -> dict[str, click.Command]:
    """Return all commands by their words."""
    found: dict[str, click.Command] = {}
    context = click.Context(main)

    def walk(command: click.Command, *words: str) -> None:
        if isinstance(command, click.Group):
            for name in command.list_commands(context):
                walk(command.get_command(context, name) or command, *words, name)
        else:
            found[" ".join(words)] = command

    walk(main)
    return found


def base_of(command: str) -> list[str]:
    (base,) = [words for words in map(shlex.split, BASES) if " ".join(words).startswith(f"{command} ")] or [[]]
    return base or command.split()


def call(command: str, option: str, value: str) -> list[str]:
    """Return the good call of a command with a bad value of an option, and with what that needs beside it."""
    words = base_of(command)
    more = shlex.split(NEEDS_OF.get((command, option), NEEDS.get(option, "")))
    beside = [*zip(more[::2], more[1::2], strict=True)]
    given = {name for name, _ in beside} | {option}
    given |= {other for name in given for other in REPLACES.get(name, ())}
    given |= {other for group in GROUPS if group & given for other in group}
    kept, left = [], iter(words)
    for word in left:
        if word in given:
            next(left)
        else:
            kept.append(word)
    if (command, option) in FILES_OF:
        kept[len(command.split())] = FILES_OF[command, option]
        if command == "material indentation":
            kept = [word for word in kept if word not in ("--control", "load")]
            kept[kept.index("--error") + 1] = "0.01"
    return [*kept, *(word for pair in beside if pair[0] != option for word in pair), f"{option}={value}"]


def values_of(option: click.Option) -> tuple[str, ...]:
    """Return bad values of an option; some of them may be good ones."""
    kind = option.type
    if isinstance(kind, click.Path):
        return ("none.txt",)
    if isinstance(kind, click.Tuple):
        return ()
    units = [unit for unit, names in UNITS.items() if option.name in names]
    return TEXTS + tuple(f"{number} {unit}" for unit in units for number in NUMBERS)


def cases() -> Iterator[tuple[str, str, str]]:
    """Yield command, option and bad value."""
    for words, command in commands().items():
        shared = {f"--{name}" for name in SEPARATION} if words in ("master", "identify") else set()
        for option in command.params:
            name = max(option.opts, key=len)
            if not isinstance(option, click.Option) or option.is_flag or option.hidden or name in ANY | shared:
                continue
            if not isinstance(option.type, click.Choice):
                for value in values_of(option):
                    if value or name not in DEFAULTED:
                        yield words, name, value


class _TakesLong(BaseException):
    """A value was accepted, since the command computes."""


@contextmanager
def limited(seconds: float) -> Iterator[list[int]]:
    """Stop what computes for long, since a value that is refused is refused at once; give a list that tells so."""
    stopped: list[int] = []

    def stop(number: int, frame: FrameType | None) -> None:
        while frame is not None:
            if "importlib" in frame.f_code.co_filename:  # a module must not be left half imported
                return
            frame = frame.f_back
        stopped.append(number)
        raise _TakesLong

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds, seconds)  # again where the error is lost, as in a callback of C
    try:
        with contextlib.suppress(_TakesLong):
            yield stopped
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def complaint(command: str, option: str, value: str) -> str:
    """Return the sentence on a bad value if it does not name the option or the file, or names what is of Python."""
    with limited(_LONGEST) as stopped:
        result = CliRunner().invoke(main, call(command, option, value))
    if stopped or result.exit_code in (0, 3, 4):
        return ""
    sentence = refusal_of(result).sentence
    unquoted = re.sub(r"'[^']*'|\"[^\"]*\"|“[^”]*”|\S+\.(csv|txt|toml|json)", "", sentence)
    named = option in sentence or (value == "none.txt" and value in sentence)
    return "" if named and not _PYTHON.search(unquoted) else sentence


#: Commands with options that have values.
TRIED = sorted({words for words, *_ in cases()})


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the files that the commands name."""
    folder = tmp_path_factory.mktemp("bad")
    runs(folder / "runs.csv")
    curves(folder / "curves.csv")
    shutil.copy(str(files("viscofric") / "example" / "dma.csv"), folder)
    rubber = vf.synthetic_fluoroelastomer()
    write_moduli(folder / "ramps.csv", rubber.complex_modulus, range(-15, 91, 2), (1.0, 10.0))
    law = vf.rheology.KrausLaw(6e6, 2.5e6, 0.02, 0.6, 6e5, 4e5, 62.8, 333.15, "shear")
    write_amplitudes(folder / "payne.csv", law, np.geomspace(1e-4, 0.5, 20))
    time = np.geomspace(0.05, 20.0, 12)
    depth = (0.75 * rubber.at("30 degC").creep_compliance(time) * 0.75 / 0.1) ** (2.0 / 3.0)
    rows = [f"{t:.8g},1,{1e6 * d:.8g}" for t, d in zip(time, depth, strict=True)]
    write(folder / "creep.csv", "time (s),load (N),depth (um)", *rows)
    write(folder / "rebound.csv", "speed (m/s),contact time (ms),restitution (1)", "0.5,3.1,0.6", "1.5,2.5,0.62")
    rows = ["1,9.3,1", "3,9.9,1.2", "10,10.7,1.5"]
    write(folder / "stiffness.csv", "frequency (Hz),storage stiffness (N/mm),loss stiffness (N/mm)", *rows)
    write(folder / "history.csv", "time (s),load (N)", "0,1", "0.1,1")
    write(folder / "heights.txt", *map(str, 1e-6 * np.sin(np.linspace(0.0, 6.0, 64))))
    write(folder / "shift.csv", "temperature (degC),a_T", "-30,1e5", "30,1", "120,1e-3")
    return folder


def write(path: Path, *rows: str) -> None:
    path.write_text("\n".join(rows), encoding="utf-8")


@pytest.mark.parametrize("command", TRIED)
def test_a_bad_value_is_refused_by_the_name_of_its_option(
    command: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One bad value of each option; `test_bad_values_are_refused_by_the_names_of_their_options` tries all."""
    monkeypatch.chdir(folder)
    first = {option: value for words, option, value in reversed([*cases()]) if words == command}
    found = {f"{option}={value}": complaint(command, option, value) for option, value in first.items()}
    assert {said: sentence for said, sentence in found.items() if sentence} == {}


@pytest.mark.exhaustive
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("command", TRIED)
def test_bad_values_are_refused_by_the_names_of_their_options(
    command: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    found = {(option, value): complaint(command, option, value) for words, option, value in cases() if words == command}
    assert {said: sentence for said, sentence in found.items() if sentence} == {}
