"""The plan of the house holds: who imports whom, what starts quickly, what the front door carries."""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import re
import shutil
import subprocess
import sys
import tomllib
from collections import defaultdict
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from viscofric.lazy import full_names, public_names

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "viscofric"

#: From left to right: a module may import from its own room and from those to its left.
ROOMS = {
    "base": (
        "units",
        "errors",
        "arguments",
        "notes",
        "files",
        "data",
        "step_tests",
        "ramps",
        "amplitudes",
        "traction",
        "nominal",
        "thermal",
        "threads",
        "processes",
        "serving",
        "lazy",
        "datasets",
        "checks",
        "arrays",
        "showing",
    ),
    "heat": ("heat",),
    "readers": ("readers",),
    "rheology": ("rheology",),
    "contact": ("contact",),
    "motion": ("motion",),
    "roughness": ("roughness",),
    "friction": ("friction",),
    "verification": ("verification",),
    "study": ("study",),
    "literature": ("literature",),
    "report": ("report",),
    "front door": ("",),
    "web": ("web",),
    "cli": ("cli", "__main__"),
}
ORDER = list(ROOMS)
#: What may not be imported at run time although it lies to the left: (importer, imported, all but these).
FORBIDDEN = [
    ("viscofric.rheology", "viscofric.readers", ("viscofric.rheology.shifts.shift_files",)),
    ("viscofric.contact", "viscofric.rheology", ("viscofric.contact.steady",)),
]
#: The one way from left to right: what a result draws itself with is looked up when it is asked for a figure.
DRAWING = ("viscofric.showing", "viscofric.report.plotting")
FOLDERS_OF_FILES = {"example"}
SLOW_TO_IMPORT = ("matplotlib", "xarray", "pint", "scipy.optimize")


class Import(NamedTuple):
    """One import: who, what, on which line, and whether it happens when the program runs."""

    importer: str
    imported: str
    line: int
    at_run_time: bool

    def __str__(self) -> str:
        return f"{self.importer}, line {self.line}, imports {self.imported}"


def module_name(path: Path) -> str:
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(path): path for path in sorted(SOURCE.rglob("*.py"))}


def rooms_of(module: str) -> list[str]:
    top = [*module.split("."), ""][1]
    return [room for room, members in ROOMS.items() if top in members]


def belongs(module: str, package: str) -> bool:
    return module == package or module.startswith(package + ".")


def walk(text: str) -> Iterator[tuple[ast.AST, bool]]:
    """Yield every node of a program, and whether it belongs to it when it runs."""
    stack: list[tuple[ast.AST, bool]] = [(ast.parse(text), True)]
    while stack:
        node, at_run_time = stack.pop()
        yield node, at_run_time
        children = ast.iter_child_nodes(node)
        if isinstance(node, ast.If) and "TYPE_CHECKING" in (getattr(node.test, word, "") for word in ("id", "attr")):
            body = set(map(id, node.body))
            stack += [(child, at_run_time and id(child) not in body) for child in children]
        else:
            stack += [(child, at_run_time) for child in children]


def called(call: ast.Call) -> str:
    """Return the last name of what is called."""
    return str(getattr(call.func, "attr", getattr(call.func, "id", "")))


def own_imports(module: str, text: str, is_package: bool = False) -> list[Import]:
    """Return the imports of viscofric by viscofric, those within functions and by `import_module` too."""
    found: list[Import] = []
    for node, at_run_time in walk(text):
        found += imports_of(module, node, at_run_time, is_package)
    return found


def imports_of(module: str, node: ast.AST, at_run_time: bool, is_package: bool) -> Iterator[Import]:
    names: list[str] = []
    if isinstance(node, ast.Import):
        names = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom):
        home = node.module or ""
        if node.level:
            parents = module.split(".")
            keep = len(parents) - node.level + is_package
            home = ".".join([*parents[:keep], *([home] if home else [])])
        for alias in node.names:
            inner = f"{home}.{alias.name}"
            names.append(inner if inner in MODULES else home)
    elif isinstance(node, ast.Call) and called(node).endswith(("import_module", "__import__")):
        names = [str(word.value) for word in node.args[:1] if isinstance(word, ast.Constant)]
    for name in names:
        if belongs(name, "viscofric"):
            yield Import(module, name, getattr(node, "lineno", 0), at_run_time)


class Found(NamedTuple):
    """What all modules were searched for: imports, and the places of sentences read and of errors without a code."""

    imports: list[Import]
    sentences: list[str]
    errors: list[str]


@cache
def searched() -> Found:
    """Search every module once for all tests."""
    found = Found([], [], [])
    for module, path in MODULES.items():
        foreign, is_package = any(belongs(module, one) for one in FOREIGN_TEXT), path.name == "__init__.py"
        for node, at_run_time in walk(path.read_text("utf-8")):
            if not isinstance(node, (ast.Import, ast.ImportFrom, ast.Compare, ast.Call)):
                continue
            found.imports.extend(imports_of(module, node, at_run_time, is_package))
            if not foreign:
                found.sentences.extend(f"{module}, line {line}" for line in sentences_read(node))
            if isinstance(node, ast.Call) and lacks_code(node):
                found.errors.append(f"{module}, line {node.lineno}")
    return found


def all_imports() -> list[Import]:
    return [found for found in searched().imports if (found.importer, found.imported) != DRAWING]


def goes_right(found: Import) -> bool:
    (importer,), (imported,) = rooms_of(found.importer), rooms_of(found.imported)
    return ORDER.index(imported) > ORDER.index(importer)


def is_forbidden(found: Import) -> bool:
    return found.at_run_time and any(
        belongs(found.importer, importer) and belongs(found.imported, imported) and found.importer not in but
        for importer, imported, but in FORBIDDEN
    )


def circles(imports: Sequence[Import]) -> list[list[str]]:
    """Return the modules of each circle of imports (strongly connected ones), whatever each import is for."""
    names = sorted({name for found in imports for name in (found.importer, found.imported)})
    rows, columns = np.array([[names.index(f.importer), names.index(f.imported)] for f in imports]).T
    graph = csr_array((np.ones(len(rows)), (rows, columns)), shape=(len(names), len(names)))
    groups = defaultdict(list)
    for name, label in zip(names, connected_components(graph, connection="strong")[1], strict=True):
        groups[label].append(name)
    return [group for group in groups.values() if len(group) > 1]


def test_every_module_has_one_room() -> None:
    homeless = [module for module in MODULES if len(rooms_of(module)) != 1]
    assert not homeless, f"name their room in {Path(__file__).name}: {homeless}"


def test_every_folder_with_python_is_a_package() -> None:
    folders = {path.parent for path in MODULES.values()}
    bare = [
        str(folder.relative_to(ROOT))
        for folder in folders
        if folder.name not in FOLDERS_OF_FILES and not (folder / "__init__.py").exists()
    ]
    assert not bare


def test_data_moves_left_to_right() -> None:
    """No module imports one to its right, not even for the types of its arguments."""
    wrong = [str(found) for found in all_imports() if goes_right(found)]
    assert not wrong, "\n".join(["imports from right to left:", *wrong])


def test_no_modules_import_each_other_in_a_circle() -> None:
    """Inside rooms too, and for types or within functions too: what is read first can be understood first."""
    found = [" -> ".join(circle) for circle in circles(all_imports())]
    assert not found, "\n".join(["circles of imports:", *found])


@pytest.mark.parametrize(
    "way_back",
    [
        "from viscofric.study.cases.sweep import Sweep",
        "def f():\n    from viscofric.study.cases import sweep",
        "if TYPE_CHECKING:\n    import viscofric.study.cases.sweep",
    ],
    ids=["plain", "within a function", "for types"],
)
def test_a_circle_is_found_however_it_is_closed(way_back: str) -> None:
    there = [
        *own_imports("viscofric.study.cases.sweep", "from viscofric.study.run_file.relations import relations"),
        *own_imports("viscofric.study.run_file.relations", "from viscofric.study.run_file.tables import Table"),
    ]
    assert circles(there) == []
    closed = [*there, *own_imports("viscofric.study.run_file.tables", way_back)]
    names = ("cases.sweep", "run_file.relations", "run_file.tables")
    assert circles(closed) == [[f"viscofric.study.{name}" for name in names]]


def test_contact_knows_no_temperature_and_rheology_no_files() -> None:
    """At run time only the verb `solve_steady` meets a material that depends on temperature."""
    wrong = [str(found) for found in all_imports() if is_forbidden(found)]
    assert not wrong, "\n".join(["imports that the plan forbids:", *wrong])


@pytest.mark.parametrize(
    ("module", "text", "right", "forbidden"),
    [
        ("viscofric.readers.trios", "from viscofric.errors import DataFileError", False, False),
        ("viscofric.readers.trios", "def f():\n    from viscofric import study", True, False),
        ("viscofric.rheology.sweeps", "from ..contact import steady", True, False),
        (
            "viscofric.rheology.sweeps",
            "import importlib\nimportlib.import_module('viscofric.cli')",
            True,
            False,
        ),
        ("viscofric.rheology.sweeps", "import viscofric.readers.trios", False, True),
        ("viscofric.contact.operators.convolution", "from viscofric.rheology import Material", False, True),
        ("viscofric.contact.operators.convolution", "if TYPE_CHECKING:\n    import viscofric.rheology", False, False),
        ("viscofric.contact.steady", "from viscofric.rheology import Material", False, False),
        ("viscofric.friction.curves", "import viscofric as vf", True, False),
    ],
)
def test_the_rule_finds_what_breaks_it(module: str, text: str, right: bool, forbidden: bool) -> None:
    (found,) = own_imports(module, text)
    assert (goes_right(found), is_forbidden(found)) == (right, forbidden)


@pytest.mark.parametrize(
    "program",
    [
        "import viscofric",
        "import sys; sys.argv = ['viscofric', '--help']; from viscofric.cli import main; main()",
        "import viscofric.web.child",
        (
            "import viscofric as vf; "
            "rubber = vf.Material.standard_linear_solid(E0='1 MPa', E_inf='10 MPa', tau='1 ms'); "
            "vf.solve_steady(rubber, vf.Ball(radius='10 mm'), speed='1 m/s', load='1 N')"
        ),
    ],
    ids=["import", "help", "process of the page", "contact"],
)
def test_start_loads_nothing_slow(program: str) -> None:
    report = (
        f"import atexit, sys; slow = {SLOW_TO_IMPORT!r}\n"
        "atexit.register(lambda: print('loaded:', *filter(sys.modules.get, slow), file=sys.stderr))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", report + program],
        capture_output=True,
        text=True,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr.splitlines()[-1].split() == ["loaded:"]


def test_no_module_imports_parts_of_scipy_that_take_half_a_second_for_one_function() -> None:
    slow = re.compile(r"(from|import) scipy\.(signal|stats)\b")
    assert [module for module, path in MODULES.items() if slow.search(path.read_text("utf-8"))] == []


def test_scripts_and_benchmarks_import_what_there_is() -> None:
    """Most of them are run by hand only."""
    lacking = []
    for path in sorted(one for folder in ("benchmarks", "scripts") for one in (ROOT / folder).rglob("*.py")):
        if ".peers" in path.parts:  # the environment of other programs (benchmarks/contact/make_peers.sh)
            continue
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "viscofric":
                home = importlib.import_module(str(node.module))
                lacking += [
                    f"{path.name}: {node.module}.{one.name}"
                    for one in node.names
                    if not hasattr(home, one.name) and f"{node.module}.{one.name}" not in MODULES
                ]
    assert lacking == []


PACKAGES = [module_name(path.with_suffix(".py")) for path in sorted(SOURCE.rglob("__init__.pyi"))]


@pytest.mark.parametrize("package", PACKAGES)
def test_public_names_resolve_and_say_what_they_are(package: str) -> None:
    room = importlib.import_module(package)
    assert len(set(room.__all__)) == len(room.__all__)
    assert set(room.__all__) <= set(dir(room))
    silent = []
    for name in room.__all__:
        thing = getattr(room, name)
        if inspect.isclass(thing) or inspect.isroutine(thing) or inspect.ismodule(thing):
            reported = inspect.getdoc(thing) or ""
            if not reported or reported.startswith(f"{name}("):  # what dataclasses write by themselves
                silent.append(name)
    assert not silent, f"public, but without a docstring: {silent}"


@pytest.mark.parametrize("package", PACKAGES)
def test_name_that_is_loaded_when_used_is_no_module_too(package: str) -> None:
    """Which of the two an import would find would depend on what was imported before."""
    names = {name for name, home in public_names(package).items() if home != package}
    assert not names & {module.name for module in pkgutil.iter_modules(importlib.import_module(package).__path__)}


@pytest.mark.parametrize("package", PACKAGES)
def test_a_public_name_comes_from_its_own_room_or_from_the_left(package: str) -> None:
    wrong = [name for name, home in public_names(package).items() if goes_right(Import(package, home, 0, True))]
    assert not wrong


def test_every_public_name_has_one_home() -> None:
    """Submodules are public names of the front door, which has fewer names than they have."""
    homes = [name for package in PACKAGES for name, home in public_names(package).items() if home != package]
    assert len(homes) == len(set(homes))
    submodules = {f"viscofric.{name}" for name, home in public_names("viscofric").items() if home == "viscofric"}
    assert submodules == set(PACKAGES) - {"viscofric"}
    assert 2 * len(public_names("viscofric")) < len(homes)


@pytest.mark.parametrize(
    ("name", "package"),
    [
        ("Ball", "viscofric.contact"),
        ("History", "viscofric"),
        ("plot_isotherms", "viscofric"),
        ("Backend", "viscofric"),
    ],
)
def test_a_name_that_is_not_where_it_is_asked_for_is_an_error_that_says_what_to_write(name: str, package: str) -> None:
    full = full_names()[name]
    assert full != f"{package}.{name}"
    with pytest.raises(AttributeError, match=rf"write {re.escape(full)}$"):
        getattr(importlib.import_module(package), name)


def test_unknown_public_name_is_an_attribute_error() -> None:
    viscofric = importlib.import_module("viscofric")
    with pytest.raises(AttributeError, match="frictoin"):
        viscofric.frictoin  # noqa: B018


def test_version_is_that_of_pyproject() -> None:
    """pyproject.toml is the one place of the version, and what is installed agrees with it."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert importlib.import_module("viscofric").__version__ == project["version"]


def tracked_files() -> list[Path]:
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("needs the git checkout, to tell the project's files from others")
    command = ["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\0")
    return [ROOT / name for name in names if name and (ROOT / name).is_file()]


def test_no_file_names_a_place_on_one_machine() -> None:
    place = re.compile(r"(?<![\w.~])/(?:work|root|home|Users)/|(?<!\w)[A-Z]:\\Users\\")
    this_file = Path(__file__).resolve()
    found = []
    for path in tracked_files():
        if path.resolve() == this_file:
            continue
        try:
            text = path.read_text("utf-8")
        except UnicodeDecodeError:
            continue  # an instrument's or another binary file
        found += [f"{path.relative_to(ROOT)}: {one[0]}" for one in place.finditer(text)]
    assert not found


def test_lock_is_complete_and_names_no_index() -> None:
    lock = (ROOT / "requirements.lock").read_text("utf-8")
    locked = {name.lower() for name in re.findall(r"^([A-Za-z0-9._-]+)==", lock, re.MULTILINE)}
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = project["optional-dependencies"]
    wanted = sum((extras[name] for name in ("dev", "cluster", "surfaces")), project["dependencies"])
    names = {re.split(r"[<>=!~;\[ ]", line)[0].lower() for line in wanted} - {"viscofric"}
    assert names <= locked, "renew it: CONTRIBUTING.md"
    assert not re.search(r"://|^\s*-(?!-hash)", lock, re.MULTILINE)
    assert not any(name.startswith(("torch", "nvidia", "cuda", "cupy")) for name in locked)


#: Modules that look into text which viscofric did not write: files, arguments, messages of others, SVG, addresses.
FOREIGN_TEXT = (
    "viscofric.cli.speed_options",
    "viscofric.readers",
    "viscofric.rheology.cards",
    "viscofric.rheology.shifts.shift_files",
    "viscofric.units",
    "viscofric.files",
    "viscofric.contact.arrays.backend",
    "viscofric.literature.citations",
    "viscofric.study.run_file.study",
    "viscofric.study.results.file",
    "viscofric.study.results.export",
    "viscofric.study.run_file.tables",
    "viscofric.friction.cases.surfaces",
    "viscofric.report.html",
    "viscofric.web.access",
    "viscofric.web.study_text",
    "viscofric.web.workspace",
)
SEARCHES = ("startswith", "endswith", "partition", "rpartition", "removeprefix", "removesuffix", "split", "replace")


def sentences_read(node: ast.AST) -> Iterator[int]:
    """Yield the line that searches text for several words (an error's: any), compares with many, or imports `re`."""
    if not isinstance(node, (ast.Import, ast.ImportFrom, ast.Compare, ast.Call)):
        return
    sought: list[ast.expr] = []
    if isinstance(node, (ast.Import, ast.ImportFrom)):
        if "re" in [getattr(node, "module", None), *(alias.name for alias in node.names)]:
            yield node.lineno
    elif isinstance(node, ast.Compare) and isinstance(node.ops[0], (ast.In, ast.NotIn)):
        sought, least = [node.left], 3
        if isinstance(node.left, ast.Constant) and ast.unparse(node.comparators[0]) in ("str(error)", "str(note)"):
            least = 1
    elif isinstance(node, ast.Compare):
        sought, least = [node.left, *node.comparators], 5
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in SEARCHES:
        sought, least = node.args[:1], 3
    if any(
        isinstance(one, ast.Constant) and isinstance(one.value, str) and len(one.value.split()) >= least
        for one in sought
    ):
        yield node.lineno
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and rewrites_text(node):
        yield node.lineno


def rewrites_text(call: ast.Call) -> bool:
    """Whether a call reads the label of a figure back, or puts minus signs into text instead of into its numbers."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else ""
    return name == "get_text" or (name == "replace" and [ast.unparse(one) for one in call.args[1:2]] == ["'−'"])


@pytest.mark.parametrize(
    "line",
    [
        'label.set_text(label.get_text().replace("measured", "synthetic"))',
        'said = sentence.replace("-", "−")',
        'said = "cannot be written" in str(error)',
        'said = note.partition("was left out of")[0]',
        'said = "overlap in reduced speed" in note',
        "import re",
        'said = "x" in str(error)',
    ],
)
def test_reading_sentences_is_noticed(line: str) -> None:
    assert [number for node, _ in walk(line) for number in sentences_read(node)] == [1]


def test_no_module_reads_the_sentences_of_another() -> None:
    """Notes and errors have codes, so that a sentence can be reworded without breaking a program."""
    found = searched().sentences
    assert not found, f"use the codes of notes and errors, and values where the text is made, instead: {found}"


def lacks_code(call: ast.Call) -> bool:
    return (
        getattr(call.func, "id", "") in {"InputError", "DataFileError", "ConvergenceError"}
        and any(isinstance(one, (ast.JoinedStr, ast.Constant)) for one in call.args[:2])
        and not {"code", None} & {one.arg for one in call.keywords}
    )


@pytest.mark.parametrize(("line", "lacks"), [('InputError("no")', True), ('InputError("no", code="no")', False)])
def test_an_error_without_a_code_is_noticed(line: str, lacks: bool) -> None:
    assert any(isinstance(node, ast.Call) and lacks_code(node) for node, _ in walk(line)) == lacks


def test_every_error_has_a_code() -> None:
    """Errors that are made of a sentence have a code beside it; those that are made of a note have the note's."""
    assert not searched().errors


def test_the_page_reads_no_sentences() -> None:
    """Its patterns are for numbers, units and names of fields, and none is made of text."""
    scripts = [path for path in (SOURCE / "web" / "static" / "js").rglob("*.js") if "vendor" not in path.parts]
    words = r"[\"'`](?:[^\"'`\s]+ ){2}|/(?:[^/\s]+ ){2}"
    sought = re.compile(rf"\bRegExp\(|\.(?:replace|match|includes|startsWith|endsWith|split)\((?:{words})")
    found = [f"{path.name}: {one[0]}" for path in scripts for one in sought.finditer(path.read_text("utf-8"))]
    assert scripts
    assert not found


def texts_of(room: str, pattern: str) -> set[str]:
    """Return what a pattern finds in a module, or in those of a folder."""
    paths = (SOURCE / room).rglob("*.py") if (SOURCE / room).is_dir() else [SOURCE / room]
    return {one for path in paths for one in re.findall(pattern, path.read_text("utf-8"))}


def test_a_new_coordinate_of_a_study_has_its_unit_name_and_place() -> None:
    from viscofric.study.cases.sweep import COORDINATES
    from viscofric.study.run_file.contact import SHAPES
    from viscofric.study.run_file.surface import SurfaceTable

    bodies = [*SHAPES.values(), SurfaceTable]
    varied = {name for body in bodies for name in body.CONDITIONS} | {"material", "sample", "thickness", "seed"}
    varied |= {name for body in SHAPES.values() for name in body.AXES} | {"temperature", "speed"}
    assert varied == set(COORDINATES)


def test_a_new_shape_is_offered_by_run_files_commands_and_page() -> None:
    from viscofric.cli.contact_options import KINDS
    from viscofric.contact.indenters import shapes
    from viscofric.contact.indenters.indenter import Indenter
    from viscofric.study.run_file.contact import SHAPES
    from viscofric.web import start

    kinds = {name for name, one in vars(shapes).items() if isinstance(one, type) and issubclass(one, Indenter)}
    assert {name for name in kinds if name[0] != "_"} - {"Indenter"} == set(KINDS.values())
    sliding = {name for name, kind in KINDS.items() if not getattr(shapes, kind).has_walls}
    assert {name: table.KIND.__name__ for name, table in SHAPES.items()} == {name: KINDS[name] for name in sliding}
    assert sliding <= set(start.SHAPES)
    page = str(start.FORMS["shape"])
    assert all(f"'{name}'" in page for name in sliding)
    assert all(f"'indenter.{axis}'" in page for table in SHAPES.values() for axis in table.AXES)
    for table in SHAPES.values():  # similarity at all loads: both or none
        one = table.KIND(*[0.01] * len(table.AXES))
        assert (one.load_exponents is None) == (one.similar() is None)


def test_a_new_shift_law_is_offered_by_run_files_commands_and_page() -> None:
    from typing import get_args

    from viscofric.cli.master import _LAWS
    from viscofric.rheology.shifts.law_fitting import LAWS, TITLES
    from viscofric.study.run_file.material import RAMP_LAWS, MaterialTable
    from viscofric.web.jobs import master
    from viscofric.web.start import FORMS

    laws = set(LAWS)
    assert set(TITLES) == laws
    assert set(RAMP_LAWS) < laws
    assert set(get_args(MaterialTable.model_fields["shift"].annotation)) == laws | {"measured", "best"}
    for name, path, others in (("shift", "material.shift", "measured"), ("master", "@friction.law", "none")):
        (form,) = (one for one in FORMS[name] if one["path"] == path)
        assert {value for value, _ in form["options"]} == laws | {"best", others}
    assert set(_LAWS) == set(get_args(master.Options.model_fields["law"].annotation)) == laws | {"best", "none"}


def test_a_new_format_of_sweeps_is_documented() -> None:
    from viscofric.readers.dma.read import FORMATS

    page = (ROOT / "docs" / "reference" / "dma_files.md").read_text("utf-8")
    first = [line.split("|")[1].strip() for line in page.splitlines() if line.startswith("| ")]
    makers = {one.NAME: " ".join(one.NAME.split()[:2]) for one in FORMATS}
    assert [name for name, maker in makers.items() if not any(row.startswith(maker) for row in first)] == []


def test_a_new_number_of_a_contact_has_a_meaning_wherever_it_is_shown() -> None:
    """The page's definitions; results, report, page and commands take name, unit and error from the number itself."""
    from viscofric.contact.periodic.solution import NUMBERS as PERIODIC
    from viscofric.contact.solution import ERRORS, LINE_NUMBERS, NUMBERS
    from viscofric.report.texts.contact import _NOT_SHOWN
    from viscofric.web.start import GLOSSARY

    for numbers in (NUMBERS, LINE_NUMBERS, PERIODIC):
        names = {words for name, (_, words) in numbers.items() if name not in (*ERRORS.values(), *_NOT_SHOWN)}
        assert {one[0].upper() + one[1:] for one in names} <= set(GLOSSARY)
        assert {name for name in numbers if name.endswith("_error")} <= set(ERRORS.values())


def test_a_new_note_on_contacts_has_words_at_the_points_of_the_page() -> None:
    from viscofric.web.jobs.curve import _DOUBTS

    places = ("contact/indenters", "contact/bodies.py")
    codes = {code for place in places for code in texts_of(place, r'Note\(\s*"([a-z-]+)"')}
    assert len(codes) > 4
    assert codes <= set(_DOUBTS)


def test_a_new_group_of_results_is_documented() -> None:
    from viscofric.study.results.tree import GROUPS

    made = texts_of("study", r'"(/[a-z_]+)"')
    assert len(made) > 15
    assert made <= set(GROUPS)
