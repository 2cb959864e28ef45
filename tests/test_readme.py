"""What README, ARCHITECTURE and docs show is run: Python, commands, run files, in their order, in an empty folder."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
import subprocess
import sys
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import click
import matplotlib
import matplotlib.pyplot as plt
import pytest
from click.testing import CliRunner

from viscofric.cli import main
from viscofric.report.figures import saving

ROOT = Path(__file__).parents[1]
#: What building the site leaves there.
MADE = {"_build", "_generated", "auto_examples"}
WRITTEN = [path for path in ROOT.glob("docs/**/*.md") if not MADE & set(path.parts)]
PAGES = sorted(
    [ROOT / "README.md", ROOT / "PACKAGE.md", ROOT / "ARCHITECTURE.md", ROOT / "paper" / "paper.md", *WRITTEN]
)
FENCE = re.compile(r"^```([\w-]*)([^\n`]*)\n(.*?)^```[ \t]*$", re.MULTILINE | re.DOTALL)
OUTPUT = {"", "text", "mermaid"}
SHELL = {"console", "bash", "sh", "shell"}
FETCHES_OR_MOVES = {"git", "cd", "pip", "uv", "python3.11", "source"}  # what gets the checkout: named, not run
COMPARED = {"printed", "roughly"}  # said after ```text: it is what the command or the Python before it prints
STAYS = {"web"}  # serves until it is stopped: only asked for its help


class Block(NamedTuple):
    """One fenced block of a page."""

    language: str
    text: str
    line: int
    manner: str = ""


def blocks(page: str) -> list[Block]:
    return [Block(m[1], m[3], page.count("\n", 0, m.start()) + 2, m[2].strip()) for m in FENCE.finditer(page)]


def commands(block: Block) -> list[list[str]]:
    """Return what is typed: the lines after a $, or in a script without one all lines but comments."""
    lines = block.text.replace("\\\n", " ").splitlines()
    typed = [line[2:] for line in lines if line.startswith("$ ")]
    if not typed and block.language != "console":
        typed = lines
    return [words for words in (shlex.split(line, comments=True) for line in typed) if words]


def subcommands() -> set[str]:
    return set(main.list_commands(click.Context(main)))


def viscofric(arguments: list[str]) -> str:
    """Run the command line in this process, which has loaded what it needs; return what it prints."""
    if arguments and arguments[0] in STAYS:
        arguments = [arguments[0], "--help"]
    done = CliRunner().invoke(main, arguments, prog_name="viscofric")
    assert done.exit_code == 0, f"viscofric {shlex.join(arguments)}\n{done.output}" + "".join(
        traceback.format_exception(done.exception)
    )
    return done.stdout + done.stderr


def compare_output(block: Block, printed: str, page: Path) -> None:
    """Compare what a page shows of an output with what was printed; … stands for what was left out.

    Where the block says ``roughly``, numbers may differ, and rows of tables are not compared.
    """
    roughly = block.manner == "roughly"

    def plain(text: str) -> str:
        text = " ".join(text.split())
        return re.sub(r"[\d.]+(?:e[+-]?\d+)?", "#", text) if roughly else text

    found = plain(printed)
    for line in block.text.splitlines():
        if roughly and re.match(r"\s*\d", line):
            continue
        for part in filter(None, map(plain, line.split("…"))):
            assert part in found, f"{page.name}, from line {block.line}: {part!r} is not printed, but\n{printed}"


def thin_out(study: Path) -> None:
    """Leave fewer contacts in a study that a page runs, and coarser ones: the demo solves all of them.

    A study without a measurement is a page's own, and quick as it is.
    """
    text = study.read_text(encoding="utf-8")
    if "[measurement]" not in text:
        return
    text, points = re.subn(r"\bpoints = \d+", "points = 2", text, count=1)
    text = re.sub(r'(?m)^temperature = \["10 degC".*\]', 'temperature = ["30 degC", "90 degC"]', text)
    text = re.sub(r"(?m)^draws = \d+", "draws = 20", text)
    text, solver = re.subn(r"(?m)^accuracy = .*$", "accuracy = 0.1\nmaster_curve_points = 5", text)
    assert (points, solver) == (1, 1), f"{study.name} is not the study that this test thins out"
    study.write_text(text, encoding="utf-8")
    runs = study.parent / "mtm.csv"
    lines = runs.read_text(encoding="utf-8").splitlines(keepends=True)
    hottest = ("#", "t", "89.", "90.")  # °C, as measured, below comments and headings
    runs.write_text("".join(line for line in lines if line.startswith(hottest)), encoding="utf-8")


def run_command(words: list[str], folder: Path) -> str:
    """Run a command of a page in the folder; return what it prints."""
    program, arguments = words[0], words[1:]
    if program in FETCHES_OR_MOVES:
        return ""
    if program == "./run":
        known = subcommands() | {"test", "docs", "--help", "--help-all"}
        assert not arguments or arguments[0] in known, f"./run does not know {arguments[0]}"
        if arguments and arguments[0] not in ("demo", "test", "docs"):
            return viscofric(arguments)
        return ""
    assert Path(program).name == "viscofric", f"a command that this test cannot run: {shlex.join(words)}"
    if arguments[:1] == ["run"]:
        thin_out(folder / arguments[1])
    return viscofric(arguments)


def draw_less(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the images of reports out, most of the time of a quick study: tests of the report look at them."""
    monkeypatch.setattr(saving, "_encoded", lambda figure, form: form.encode())


def check_study(block: Block, folder: Path) -> None:
    """Read the run file as `viscofric run` does; it stays in the folder for the commands that follow.

    It is stored under the name in its first line, where that is a comment, else as study.toml.
    """
    from viscofric import load_study

    name = re.match(r"#\s*([\w-]+\.toml)\b", block.text)
    path = folder / (name[1] if name else "study.toml")
    path.write_text(block.text, encoding="utf-8")
    load_study(path)


def as_case(page: Path) -> Any:
    """Return a page as a test's case: those of the site, which take a minute, are tests of their own step."""
    name = page.relative_to(ROOT).as_posix()
    apart = name.startswith(("docs/", "paper/", "PACKAGE"))
    marks = [pytest.mark.apart] if apart else [pytest.mark.slow] if name == "README.md" else []
    return pytest.param(page, id=name, marks=marks)


@pytest.fixture
def drawn_apart() -> Iterator[None]:
    """Leave matplotlib as it was: pages set its look and leave figures open, as readers do."""
    with matplotlib.rc_context():
        yield
    plt.close("all")


@pytest.mark.usefixtures("drawn_apart")
@pytest.mark.timeout(600)
@pytest.mark.parametrize("page", map(as_case, PAGES))
def test_what_the_page_shows_works(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    draw_less(monkeypatch)
    namespace: dict[str, Any] = {"__name__": "__main__"}
    printed = ""
    for block in blocks(page.read_text(encoding="utf-8")):
        if block.language in {"python", "py"}:
            code = "\n" * (block.line - 1) + block.text  # so that a traceback names the page's line
            with contextlib.redirect_stdout(io.StringIO()) as heard:
                exec(compile(code, str(page), "exec"), namespace)
            printed = heard.getvalue()
        elif block.language in SHELL:
            for words in commands(block):
                printed = run_command(words, tmp_path)
        elif block.language == "toml":
            if "[material]" in block.text:
                check_study(block, tmp_path)
        elif block.language == "text" and block.manner in COMPARED:
            compare_output(block, printed, page)
        else:
            assert block.language in OUTPUT, f"{page.name}, line {block.line}: what is {block.language!r}?"


def test_readme_shows_the_two_commands() -> None:
    readme = blocks((ROOT / "README.md").read_text(encoding="utf-8"))
    typed = [" ".join(words[:2]) for block in readme if block.language in SHELL for words in commands(block)]
    assert {"./run demo", "./run test"} <= set(typed)
    reported = subprocess.run([sys.executable, str(ROOT / "run"), "--help"], capture_output=True, text=True, check=True)
    assert all(command in reported.stdout for command in ("./run demo", "./run test"))


def test_output_that_is_not_printed_is_found() -> None:
    printed = "T    mu\n30  0.12\n\nover 12 points within 0.3 %; more words.\n"
    compare_output(Block("text", "T  mu\n…\nover 12 points … more", 1, "printed"), printed, Path("a.md"))
    compare_output(Block("text", "T  mu\n30  0.13\nover 13 points within 4e-2 %", 1, "roughly"), printed, Path("a.md"))
    for line, manner in (("over 13 points", "printed"), ("over 13 points without", "roughly")):
        with pytest.raises(AssertionError, match=r"over .* is not printed"):
            compare_output(Block("text", line, 1, manner), printed, Path("a.md"))


def test_blocks_and_commands_are_found() -> None:
    page = "x\n```console\n$ viscofric run \\\n  a.toml  # why\nout\n```\n```bash\n./run demo\n```\n```\n$ no\n```\n"
    console, script, output = blocks(page)
    assert commands(console) == [["viscofric", "run", "a.toml"]]
    assert commands(script) == [["./run", "demo"]]
    assert (console.line, script.line, output.language) == (3, 8, "")


@pytest.mark.parametrize("name", ["index.md", "tread.md"])
def test_tutorials_show_the_figures_that_they_draw(name: str) -> None:
    """They are drawn by its own Python when the site is built, so that each that it shows must be saved there."""
    page = (ROOT / "docs" / "tutorial" / name).read_text(encoding="utf-8")
    shown = re.findall(r"_generated/tutorial/([\w-]+\.svg)", page)
    saved = re.findall(r'savefig\("([\w-]+\.svg)"\)', page)
    assert shown
    assert shown == saved
