"""The command line among other programs: one screen of help, completion, pipes."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from importlib import import_module
from importlib.resources import files
from pathlib import Path

import pytest
from click.testing import CliRunner

from cli.calls import call, refusal, succeed
from viscofric.cli import main
from viscofric.cli.overview import COMMANDS

RUNS = Path(str(files("viscofric"))) / "example" / "mtm.csv"
PROGRAM = [sys.executable, "-c", "import sys; sys.argv[0] = 'viscofric'; from viscofric.cli import main; main()"]


def complete(words: str, position: int) -> list[str]:
    asked = {"_VISCOFRIC_COMPLETE": "bash_complete", "COMP_WORDS": words, "COMP_CWORD": str(position)}
    done = subprocess.run(PROGRAM, env={**os.environ, **asked}, capture_output=True, text=True, check=True)
    return [line.partition(",")[2] for line in done.stdout.splitlines()]


def test_help_fits_a_screen_and_names_every_exit_status() -> None:
    lines = call("--help").output.splitlines()
    assert len(lines) < 24  # the prompt takes the last one
    assert max(map(len, lines)) <= 80
    for status in (0, 1, 2, 3, 4, 130, 143):
        assert any(f" {status} " in f" {line} " for line in lines), status


def test_every_command_of_the_overview_exists_by_its_name() -> None:
    for name in COMMANDS:
        assert import_module(f"viscofric.cli.{name}").command.name == name


@pytest.mark.slow
def test_commands_and_options_are_completed() -> None:
    assert complete("viscofric m", 1) == ["material", "measure", "master"]
    assert complete("viscofric material s", 2) == ["show"]
    assert complete("viscofric master --pict", 2) == ["--picture"]
    assert complete("viscofric completion ", 2) == ["bash", "zsh", "fish"]
    assert complete("viscofric transient --before ", 3) == ["untouched", "at rest", "sliding"]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_script_is_one_that_the_shell_takes(shell: str) -> None:
    done = succeed("completion", shell)
    assert f"_VISCOFRIC_COMPLETE={shell}_complete" in done.stdout
    if found := shutil.which(shell):
        subprocess.run([found, "-n"], input=done.stdout, text=True, check=True)


@pytest.mark.slow
def test_a_reader_that_has_enough_is_no_error() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [*PROGRAM, "material", "list"], stdout=writing, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(writing)
    assert done.stderr == ""


def test_runs_are_read_from_a_pipe_and_curves_go_into_one() -> None:
    runner = CliRunner()
    curves = runner.invoke(main, ["measure", "-", "--out", "-"], input=RUNS.read_bytes())
    assert curves.exit_code == 0, curves.output
    assert curves.stdout.startswith("# viscofric friction curves\n# source: standard input (synthetic)\n")
    words = ["master", "-", "--shift", "synthetic fluoroelastomer", "--json"]
    shifted = runner.invoke(main, words, input=curves.stdout)
    assert shifted.exit_code == 0, shifted.output
    assert '"standard input"' in shifted.stdout


def test_what_is_wrong_with_piped_data_names_standard_input() -> None:
    found = refusal("material", "read", "-", given="temperature,frequency\n1,2\n")
    assert found[:2] == (1, "missing-columns")
    assert found.sentence.startswith("standard input: ")
