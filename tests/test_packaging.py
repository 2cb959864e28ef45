"""Source distribution and wheel: what they hold, and that viscofric works where nothing else is of the checkout."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from email import message_from_string
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
#: Not of the project: what tools make in a checkout.
MADE = shutil.ignore_patterns(
    ".git", ".venv", ".tools", "__pycache__", "*.egg-info", ".*_cache", ".hypothesis", "_build", "build", "dist"
)

#: What a user does first, in the new environment: help of all commands, a study, its files.
WORK = """
from importlib import resources
from pathlib import Path

import click
from click.testing import CliRunner

import viscofric
from viscofric.cli import main

assert Path(viscofric.__file__).is_relative_to({place!r}), viscofric.__file__


def call(*arguments):
    done = CliRunner().invoke(main, arguments, prog_name="viscofric", catch_exceptions=False)
    assert done.exit_code == 0, done.output
    return done.output


for name in main.list_commands(click.Context(main)):
    assert f"viscofric {{name}}" in call(name, "--help"), name
page = resources.files("viscofric") / "web" / "static" / "index.html"
assert "<title>" in page.read_text(encoding="utf-8")
example = {{one.name for one in (resources.files("viscofric") / "example").iterdir()}}
assert {{"dma.csv", "mtm.csv", "study.toml"}} <= example

call("new", "first")
call("check", "first/study.toml")
Path("small.toml").write_text({study!r}, encoding="utf-8")
call("run", "small.toml", "--quiet")
assert Path("small.results/report.html").stat().st_size > 10_000
results = viscofric.open_results("small.results")
assert not results.failures
assert (results.dataset["friction_coefficient"] > 0.0).all()
"""

STUDY = """
[material]
catalogue = "synthetic fluoroelastomer"

[indenter]
radius = "9.525 mm"

[conditions]
load = "25 N"
speed = ["20 mm/s", "200 mm/s"]
temperature = "60 degC"

[solver]
accuracy = 0.1
master_curve_points = 2
"""


def clean(environment: dict[str, str]) -> dict[str, str]:
    """Leave out what leads to the checkout."""
    return {name: value for name, value in environment.items() if not name.startswith(("PYTHON", "VIRTUAL_ENV"))}


def run(command: list[str], folder: Path, environment: dict[str, str] | None = None, *, together: bool = False) -> str:
    done = subprocess.run(
        command,
        cwd=folder,
        env=environment or clean(dict(os.environ)),
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout + done.stderr if together else done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Return the source distribution, and the wheel that was built from it and not from the checkout."""
    folder = tmp_path_factory.mktemp("built")
    checkout = shutil.copytree(ROOT, folder / "checkout", ignore=MADE)
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", str(folder), str(checkout)]
    said = run(command, folder, together=True)
    assert not re.findall(r"(?i)^warning: no .*|is absent from the `packages`|deprecat.*", said, re.MULTILINE)
    (sdist,), (wheel,) = folder.glob("*.tar.gz"), folder.glob("*.whl")
    return sdist, wheel


def test_text_for_the_package_index_stands_alone() -> None:
    """No link or image of it leads into the repository, which a package index does not show."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    text = (ROOT / project["readme"]).read_text(encoding="utf-8")
    targets = re.findall(r"\]\(([^)\s]+)|(?:src|href)=\"([^\"]+)", text)
    assert all(one.startswith("https://") for pair in targets for one in pair if one)


def test_recipe_for_conda_has_version_and_dependencies_of_the_package() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    recipe = yaml.safe_load((ROOT / "recipe" / "recipe.yaml").read_text(encoding="utf-8"))
    assert recipe["context"]["version"] == project["version"]
    wanted = [f"python{project['requires-python']}", *map(str.lower, project["dependencies"])]
    found = [one.replace(" ", "").replace("matplotlib-base", "matplotlib") for one in recipe["requirements"]["run"]]
    assert found == wanted


@pytest.mark.parametrize("path", sorted((ROOT / ".github" / "workflows").glob("*.yml")), ids=lambda path: path.name)
def test_workflows_call_what_there_is(path: Path) -> None:
    """Steps that call `run` name commands of it, and Pythons are those that the package supports."""
    workflow = yaml.safe_load(path.read_text(encoding="utf-8"))
    steps = [step.get("run", "") for job in workflow["jobs"].values() for step in job["steps"]]
    called = {words[2] for words in map(str.split, steps) if words[:2] == ["python", "run"]}
    assert called <= {"test", "docs", "verify", "--version"}
    assert any("python -m build" in step for step in steps)
    for script in re.findall(r"(?m)^(\.ci/\S+)", "\n".join(steps)):
        assert os.access(ROOT / script, os.X_OK)


def members(sdist: Path) -> set[str]:
    with tarfile.open(sdist) as archive:
        return {one.name.split("/", 1)[1] for one in archive.getmembers() if one.isfile()}


def tracked() -> set[str]:
    """Files of the project: those that git knows, or, without it, those of the folders that matter most."""
    if (ROOT / ".git").exists() and shutil.which("git"):
        listed = run(["git", "ls-files", "-z"], ROOT, dict(os.environ)).split("\0")
        return {name for name in listed if name and (ROOT / name).is_file()}
    found = [path for top in ("src", "tests") for path in (ROOT / top).rglob("*") if path.is_file()]
    unwanted = ("__pycache__", ".egg-info")
    return {path.relative_to(ROOT).as_posix() for path in found if not any(one in str(path) for one in unwanted)}


@pytest.mark.apart
def test_source_distribution_holds_the_whole_project(built: tuple[Path, Path]) -> None:
    found = members(built[0])
    assert tracked() <= found
    made = {"PKG-INFO", "setup.cfg", *(name for name in found if ".egg-info/" in name)}
    strange = [name for name in found - made if any(one in name for one in ("__pycache__", "_build/", "_generated/"))]
    assert not strange


@pytest.mark.apart
def test_wheel_carries_every_file_of_the_package_and_nothing_else(built: tuple[Path, Path]) -> None:
    with zipfile.ZipFile(built[1]) as archive:
        names = set(archive.namelist())
        about = {Path(name).name: archive.read(name).decode() for name in names if ".dist-info/" in name}
    source = ROOT / "src"
    files = {path.relative_to(source).as_posix() for path in (source / "viscofric").rglob("*") if path.is_file()}
    files = {name for name in files if "__pycache__" not in name}
    assert files <= names, f"not in the wheel: {sorted(files - names)}"
    assert {name.split("/")[0] for name in names - files} == {f"{built[1].name.split('-py3')[0]}.dist-info"}
    assert "viscofric/py.typed" in names
    assert "viscofric = viscofric.cli:main" in about["entry_points.txt"]
    assert about["LICENSE"] == (ROOT / "LICENSE").read_text(encoding="utf-8")
    metadata = message_from_string(about["METADATA"])
    assert metadata["License-Expression"] == "MIT"
    assert metadata["Requires-Python"] == ">=3.11"
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert metadata.get_payload().startswith("# viscofric")
    versions = {f"Programming Language :: Python :: 3.{minor}" for minor in (11, 12, 13)}
    assert versions <= set(metadata.get_all("Classifier"))


def installers(python: Path) -> list[list[str]]:
    """Commands that install a wheel into the environment of a Python, as far as there are any."""
    uv = [str(path) for path in (ROOT / ".tools" / "bin" / "uv", shutil.which("uv")) if path and Path(path).exists()]
    found = [[one, "pip", "install", "--python", str(python), "--no-config"] for one in uv[:1]]
    return found + [[sys.executable, str(pip), "--python", str(python), "install"] for pip in _pips()]


def _pips() -> list[Path]:
    """Return pip as this environment has it, and as Python brings it to make environments with."""
    installed = Path(sysconfig.get_path("purelib")) / "pip"
    try:
        import ensurepip
    except ImportError:  # Debian leaves it out
        bundled: list[Path] = []
    else:
        bundled = [wheel / "pip" for wheel in (Path(ensurepip.__file__).parent / "_bundled").glob("pip-*.whl")]
    return [*([installed] if installed.is_dir() else []), *bundled]


@pytest.mark.apart
def test_installed_elsewhere_it_works(built: tuple[Path, Path], tmp_path: Path) -> None:
    """Dependencies are those of this environment; viscofric itself comes from the wheel."""
    home = tmp_path / "environment"
    run([sys.executable, "-m", "venv", "--without-pip", str(home)], tmp_path)
    paths = {"base": str(home), "platbase": str(home)}
    scheme = sysconfig.get_preferred_scheme("prefix")
    packages, scripts = (Path(sysconfig.get_path(name, scheme, paths)) for name in ("purelib", "scripts"))
    (packages / "dependencies.pth").write_text(sysconfig.get_path("purelib"), encoding="utf-8")
    python = scripts / Path(sys.executable).name
    ways = installers(python)
    if not ways:
        pytest.skip("neither uv nor pip is there to install a wheel with")
    run([*ways[0], "--no-deps", "--no-index", str(built[1])], tmp_path)

    program = scripts / "viscofric"
    assert "Hysteresis friction" in run([str(program), "--help"], tmp_path)
    version = built[1].name.split("-")[1]
    assert run([str(program), "--version"], tmp_path).strip().endswith(version)
    run([str(python), "-W", "error", "-c", WORK.format(place=str(home), study=STUDY)], tmp_path)
