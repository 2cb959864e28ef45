"""Options and statuses that all commands share: `--out`, `--json`, names of options in errors."""

from __future__ import annotations

import contextlib
import json
import re
import shutil
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any

import click
import pytest

from cli.calls import call, refusal, succeed
from cli.friction_files import curves, runs
from readers.samples import workbook
from study.sweeps import made_results
from viscofric.cli import main, run
from viscofric.cli.files import FOLDER, OUT, Written
from viscofric.cli.keys import KeyOption
from viscofric.cli.progress import TerminalProgress
from viscofric.study.run_file.study import TABLES
from viscofric.study.running.running import Event

SOLID = ["--E0", "1 MPa", "--E-inf", "10 MPa", "--tau", "1 ms"]
CATALOGUE = ["--material", "synthetic fluoroelastomer"]
BALL = ["--ball", "9.525 mm", "--speed", "1 m/s", "--load", "5 N", "--accuracy", "0.05"]
INDENTATION = ["material", "indentation", "--ball", "10 mm", "--temperature", "23 degC"]
#: Commands that write neither a file nor a table or figure, and those that print no results.
NO_OUT = {"check", "material list", "web", "completion"}
NO_JSON = {"web", "completion"}
#: Commands with results -> words with which they run within a second or two, in the folder below.
CALLS: dict[str, list[str]] = {
    "new": ["new", "fresh"],
    "check": ["check", "example/study.toml"],
    "report": ["report", "results"],
    "export": ["export", "results", "--to", "csv"],
    "compare": ["compare", "results", "results"],
    "material read": ["material", "read", "dma.csv"],
    "material fit": ["material", "fit", "dma.csv", "--reference", "30 degC", "--samples", "0"],
    "material show": ["material", "show", "PVB interlayer"],
    "material convert": ["material", "convert", "synthetic fluoroelastomer", "card.json", "--format", "json"],
    "material list": ["material", "list"],
    "solve": ["solve", *SOLID, *BALL],
    "curve": ["curve", *CATALOGUE, *BALL],
    "transient": ["transient", *SOLID, "--ball", "10 mm", "--load", "1 N", "--dwell", "1 ms", "--accuracy", "0.05"],
    "impact": ["impact", *SOLID, "--ball", "5 mm", "--mass", "4 g", "--speed", "1 m/s", "--accuracy", "0.01"],
    "measure": ["measure", "runs.csv"],
    "master": ["master", "curves.csv", "--shift", "synthetic fluoroelastomer"],
    "verify": ["verify", "--only", "hertz-ball"],
}
#: Commands whose JSON is tested beside their results, where these take longer: in tests of their own.
ELSEWHERE = {"demo", "run", "identify", "material ramp", "material amplitude", "material indentation"}


def commands(command: click.Command = main, path: str = "") -> Iterator[tuple[str, click.Command]]:
    """Yield every command with its words."""
    if not isinstance(command, click.Group):
        yield path, command
        return
    ctx = click.Context(command)
    for name in command.list_commands(ctx):
        below = command.get_command(ctx, name)
        assert below is not None
        yield from commands(below, f"{path} {name}".strip())


ALL = dict(commands())


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("outputs")
    runs(folder / "runs.csv")
    curves(folder / "curves.csv")
    shutil.copy(str(files("viscofric") / "example" / "dma.csv"), folder)
    shutil.copytree(str(files("viscofric") / "example"), folder / "example")
    made_results(folder / "results", failed=[2])
    return folder


def options(command: click.Command) -> set[str]:
    """Return the options that the help names."""
    shown = (one for one in command.params if isinstance(one, click.Option) and not one.hidden)
    return {typed for one in shown for typed in one.opts}


@pytest.mark.parametrize("name", ALL)
def test_options_of_keys_offer_what_the_run_file_knows(name: str) -> None:
    keyed = [one for one in ALL[name].params if isinstance(one, KeyOption)]
    text = "".join(call(*name.split(), "--help").output.split())
    for one in keyed:
        about = TABLES[one.key.table].model_json_schema()["properties"][one.key.key]
        about |= about.get("anyOf", [{}])[0]
        names = ("description", "default", "enum", "type")
        assert {name: one.key.about.get(name) for name in names} == {name: about.get(name) for name in names}, one.name
        known = about.get("enum", ())
        choices = "" if one.is_flag else "|".join(known)
        assert choices.replace(" ", "") in text, one.name
        assert one.help, one.name
        assert one.help.count("default: ") <= 1, one.name
        assert f"e.g. '{about.get('default')}'" not in one.help, one.name


def strict(text: str) -> Any:
    """Return JSON without NaN and infinity."""

    def refuse(name: str) -> None:
        raise AssertionError(name)

    return json.loads(text, parse_constant=refuse)


@pytest.mark.parametrize("name", ALL)
def test_help_has_required_options_first_and_those_without_a_heading_last(name: str) -> None:
    text = call(*name.split(), "--help").output
    blocks = [block.splitlines() for block in text.split("\n\n")[1:] if not block.startswith(" ")]
    rows = [[line for line in lines if re.match(r"  \S", line)] for _, *lines in blocks]
    assert all(row.startswith("  -") for section in rows for row in section), rows
    order = [("[required]" not in "\n".join(block), block[0] == "Options:") for block in blocks]
    assert order == sorted(order)


@pytest.mark.parametrize("name", ALL)
def test_every_command_has_out_and_json_where_they_apply(name: str) -> None:
    found = options(ALL[name])
    assert ({"-o", "--out"} <= found) == (name not in NO_OUT)
    assert ("--json" in found) == (name not in NO_JSON)


def test_every_command_with_json_is_called_here_or_elsewhere() -> None:
    assert set(CALLS) | ELSEWHERE | NO_JSON == set(ALL)


@pytest.mark.parametrize("name", CALLS)
def test_json_is_one_object_without_nan(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    done = call(*CALLS[name], "--json")
    assert done.exit_code == (run.SOME_CASES_FAILED if name == "report" else 0), done.output
    assert isinstance(strict(done.stdout), dict)


def test_json_has_the_names_of_to_dataset(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import viscofric as vf

    monkeypatch.chdir(folder)
    shown = strict(call(*CALLS["material show"], "--json").stdout)
    material = vf.catalogue_material("PVB interlayer")
    assert set(material.to_dataset().variables) <= set(shown["spectrum"])
    assert {"angular_frequency", "storage_modulus", "loss_modulus"} <= set(shown["modulus"])


@pytest.mark.parametrize(
    "name", ["solve", "curve", "transient", "impact", "measure", "compare", "verify", "material show"]
)
def test_a_table_is_printed_by_out_dash(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    done = succeed(*CALLS[name], "--out", "-")
    rows = [line.split(",") for line in done.stdout.splitlines() if not line.startswith("#")]
    assert len(rows) > 1
    assert len(rows[0]) > 1
    refused = refusal(*CALLS[name], "--out", "-", "--json")
    assert refused.status == 2


@pytest.mark.parametrize(
    "words",
    [
        ["solve", "--dma", "odd.csv", "--reference", "20 degC", *BALL],
        ["transient", *SOLID, "--ball", "10 mm", "--history", "odd.csv"],
        ["measure", "odd.csv"],
        ["master", "odd.csv"],
        ["master", "curves.csv", "--shift", "odd.csv"],
        ["identify", "odd.csv", "--ball", "9.525 mm"],
        ["compare", "odd.csv", "curves.csv"],
        ["compare", "twice.csv", "curves.csv"],
        ["material", "fit", "odd.csv", "--reference", "20 degC", "--out", "made"],
        ["material", "ramp", "odd.csv", "--reference", "20 degC"],
        [*INDENTATION, "odd.csv", "--control", "load"],
        [*INDENTATION, "sheets.xlsx", "--control", "load"],
        [*INDENTATION, "odd.csv", "--mass", "1 g", "--error", "0.01"],
        [*INDENTATION, "odd.csv", "--depth", "1 mm", "--amplitude", "1 um", "--error", "0.01"],
        [*INDENTATION, "creep.csv", "--control", "load", "--shift", "odd.csv"],
    ],
    ids=" ".join,
)
def test_a_remedy_for_columns_names_no_option_that_the_command_lacks(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    curves(tmp_path / "curves.csv")
    rows = [(second, 1, second) for second in range(1, 7)]
    heads = {"odd": "a,b,c", "creep": "time (s),load (N),indentation (um)", "twice": "speed (m/s),velocity (m/s),T (K)"}
    for name, head in heads.items():
        table = [head, *(",".join(map(str, row)) for row in rows)]
        (tmp_path / f"{name}.csv").write_text("\n".join(table), encoding="utf-8")
    sheet = [heads["creep"].split(","), *map(list, rows)]
    workbook.write(tmp_path / "sheets.xlsx", {"one": sheet, "two": sheet})
    found = refusal(*words)
    assert found.code in {"missing-columns", "ambiguous-columns", "several-tables"}, found
    named = set(re.findall(r"--[a-z][a-z-]*", found.sentence))
    assert named <= options(ALL[" ".join(words[: 2 if words[0] == "material" else 1])])


@pytest.mark.parametrize("name", sorted(set(ALL) - NO_OUT))
def test_what_cannot_be_written_is_refused_before_the_work(name: str, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    command = ALL[name]
    written = [one for one in command.params if isinstance(one.type, Written)]
    assert "out" in {one.name for one in written}
    for parameter in written:
        with click.Context(command) as ctx, pytest.raises(click.BadParameter, match="Not a directory"):
            parameter.type.convert(str(tmp_path / "file" / "new" / "result"), parameter, ctx)
    assert sorted(tmp_path.iterdir()) == [tmp_path / "file"]


def test_a_device_is_not_replaced_by_a_table() -> None:
    done = call("solve", *SOLID, *BALL, "--out", "/dev/null")
    assert (done.exit_code, Path("/dev/null").is_char_device()) == (2, True)
    with pytest.raises(click.BadParameter, match="device"):
        OUT.convert("/dev/null", None, None)


def test_the_highest_folder_can_be_named() -> None:
    with contextlib.suppress(click.BadParameter):  # where it takes no files
        assert FOLDER.convert("/", None, None) == Path("/")


def test_only_tables_are_printed_in_place_of_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for arguments in (["demo"], ["run", "study.toml"], ["material", "fit", "dma.csv"]):
        assert call(*arguments, "--out", "-").exit_code == 2
    for arguments in (
        ["solve", "--picture", "-"],
        ["transient", "--save-state", "-"],
        ["transient", "--pressures", "-"],
        ["transient", "--animation", "-"],
        ["material", "indentation", "creep.csv", "--csv", "-"],
        ["material", "convert", "rubber.json", "-", "--format", "json"],
    ):
        done = call(*arguments)
        assert (done.exit_code, done.stdout, "give a name" in done.stderr) == (2, "", True), arguments
    assert call("verify", "--list", "--json").exit_code == 2
    assert call("new", "-", "--json").exit_code == 2
    assert not list(tmp_path.iterdir())


def test_a_narrow_terminal_has_the_numbers_of_a_study_whole(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, value in {"FORCE_COLOR": "1", "TERM": "xterm", "COLUMNS": "80"}.items():
        monkeypatch.setenv(name, value)
    clock = [0.0]
    monkeypatch.setattr("viscofric.cli.progress.time.monotonic", lambda: clock[0])
    with TerminalProgress() as progress:
        progress(Event("stage", "histories", done=0, total=5000))
        clock[0] = 10.0
        progress(Event("solving", "histories", done=1271, total=5000, solves=20, label="0 °C, 3.162 mm/s", key="a"))
        progress(Event("stage", "histories", done=5000, total=5000, solves=50))
    shown = re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", capsys.readouterr().err)
    assert "5000/5000" in shown
    assert "50 solved, 5/s" in shown  # the stage's last event, too, counts from its beginning
    assert all(len(line) <= 80 for line in re.split(r"[\r\n]+", shown))
