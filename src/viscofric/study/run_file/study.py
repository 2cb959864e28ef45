"""The run file: what a study asks for, read from TOML and checked before anything is computed."""

from __future__ import annotations

import functools
import re
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, Field, TypeAdapter, ValidationError

from viscofric.errors import InputError, StudyError
from viscofric.files import file_path, parse_toml
from viscofric.study.cases.sweep import Sweep, sweep_of
from viscofric.study.run_file.contact import (
    SHAPES,
    ConditionsTable,
    IndenterTable,
    LayerTable,
)
from viscofric.study.run_file.errors import place, problems, told, wrong_tables
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.measurement import MeasurementTable
from viscofric.study.run_file.relations import relations
from viscofric.study.run_file.settings import ClusterTable, OutputsTable, SolverTable, SweepTable, UncertaintyTable
from viscofric.study.run_file.surface import SurfaceTable
from viscofric.study.run_file.tables import RANGE, SEED_RANGE, SeedRange, SpeedRange, Table

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from viscofric.notes import Note
    from viscofric.study.run_file.contact import AnyIndenterTable
    from viscofric.study.run_file.tables import Problem

#: A run file is far shorter; what is longer is something else.
LONGEST_RUN_FILE = 1_000_000  # characters
_MOST_BYTES = 4 * LONGEST_RUN_FILE + 4
#: Tables and lists within each other that a run file may need, and a little more.
_DEEPEST = 10
_MOST_MATERIALS = 100


def _several(value: object) -> object:
    return [value] if isinstance(value, dict | MaterialTable) else value


class Study(Table):
    """A whole run file; quantities in SI, paths resolved against the run file's folder.

    Attributes
    ----------
    title : str
    data_origin : {"measured", "synthetic"}
    materials : tuple of MaterialTable
        [material], or each of several [[material]].
    indenter : BallTable, CylinderTable, EllipsoidTable or ConeTable, or None
    surface : SurfaceTable or None
        A rough surface instead.
    layer : LayerTable or None
    conditions : ConditionsTable
    sweep_table : SweepTable
        [sweep].
    measurement : MeasurementTable or None
    solver : SolverTable
    uncertainty : UncertaintyTable
    outputs : OutputsTable
    cluster : ClusterTable or None
    """

    title: str = Field("Viscoelastic friction", max_length=300, description="Title of the report.")
    data_origin: Literal["measured", "synthetic"] = Field(
        "measured", description="Whether the data were measured or made up; report and figures then say so."
    )
    materials: Annotated[
        tuple[MaterialTable, ...], Field(min_length=1, max_length=_MOST_MATERIALS), BeforeValidator(_several)
    ] = Field(alias="material", description="The rubber; [[material]] for each of several, with a name of its own.")
    indenter: IndenterTable | None = Field(None, description="What slides or rolls over the rubber.")
    surface: SurfaceTable | None = Field(None, description="A rough surface that slides over it, instead.")
    layer: LayerTable | None = Field(None, description="Rubber of finite thickness; a half-space without this table.")
    conditions: ConditionsTable = Field(description="Loads, speeds and temperatures to predict friction at.")
    sweep_table: SweepTable = Field(SweepTable(), alias="sweep", description="Which axes go together.")
    measurement: MeasurementTable | None = Field(None, description="Measured friction to lay beside the prediction.")
    solver: SolverTable = Field(SolverTable(), description="How accurate the friction is to be.")
    uncertainty: UncertaintyTable = Field(UncertaintyTable(), description="How well the rubber is known.")
    outputs: OutputsTable = Field(OutputsTable(), description="What is kept of the solved cases.")
    cluster: ClusterTable | None = Field(None, description="Jobs of a SLURM cluster to solve the cases.")

    def problems(self) -> Iterator[Problem]:
        """Yield what does not fit together between the tables."""
        yield from relations(self._tables)

    @property
    def _tables(self) -> dict[str, Any]:
        """The tables by their keys in a run file."""
        return {field.alias or name: getattr(self, name) for name, field in FIELDS.items()}

    @property
    def material(self) -> MaterialTable:
        """The material; the first of several."""
        return self.materials[0]

    @property
    def inputs(self) -> tuple[Path, ...]:
        """All data files."""
        files = [path for material in self.materials for path in material.inputs]
        files += self.surface.inputs if self.surface else ()
        return (*dict.fromkeys(files), *(self.measurement.inputs if self.measurement else ()))

    @property
    def body(self) -> AnyIndenterTable | SurfaceTable:
        """What slides over the rubber."""
        return self.indenter or self.surface  # type: ignore[return-value]  # one of them is there

    def sweep(self) -> Sweep:
        """Return all cases that the study asks for, with their axes.

        Returns
        -------
        Sweep
        """
        return sweep_of(self._tables)


FIELDS = Study.model_fields
#: Key of a run file, or branch of a choice -> the table behind it; "" is the whole file.
TABLES: dict[str, type[BaseModel]] = {
    "": Study,
    "material": MaterialTable,
    "indenter": SHAPES["ball"],
    **{f"<{shape}>": table for shape, table in SHAPES.items()},
    "surface": SurfaceTable,
    "layer": LayerTable,
    "conditions": ConditionsTable,
    RANGE: SpeedRange,
    SEED_RANGE: SeedRange,
    "sweep": SweepTable,
    "measurement": MeasurementTable,
    "solver": SolverTable,
    "uncertainty": UncertaintyTable,
    "outputs": OutputsTable,
    "cluster": ClusterTable,
}


def load_study(path: str | Path) -> Study:
    r"""Read and check a run file.

    Parameters
    ----------
    path : str or Path
        A TOML file; data files in it are looked for beside it.

    Returns
    -------
    Study

    Raises
    ------
    StudyError
        If the file is missing or is not TOML, or with every wrong key, unit and range in it.

    Examples
    --------
    >>> from pathlib import Path
    >>> import viscofric as vf
    >>> lines = [
    ...     "[material]",
    ...     'catalogue = "synthetic fluoroelastomer"',
    ...     "[indenter]",
    ...     'radius = "9.525 mm"',
    ...     "[conditions]",
    ...     'load = "5 N"',
    ...     'speed = "0.1 m/s"',
    ...     'temperature = ["60 degC", "90 degC"]',
    ...     "[solver]",
    ...     "accuracy = 1e-2",
    ... ]
    >>> _ = Path("ball.toml").write_text("\n".join(lines))
    >>> study = vf.load_study("ball.toml")
    >>> study.title
    'Viscoelastic friction'
    """
    path = file_path(path)
    return parse_study(read_study_text(path), path)


def read_study_text(path: Path) -> str:
    """Return the text of a run file."""
    try:
        with path.open("rb") as file:
            return decoded(file.read(_MOST_BYTES), path)
    except FileNotFoundError:
        raise StudyError(f"{path}: no such file.") from None
    except IsADirectoryError:
        raise StudyError(f"{path}: is a folder; a run file (TOML) is wanted.") from None
    except StudyError:
        raise
    except (OSError, ValueError) as error:
        raise StudyError(f"{path}: cannot be read ({getattr(error, 'strerror', None) or error}).") from None


def decoded(data: bytes, path: Path) -> str:
    """Return the text that the bytes of a run file are."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise StudyError(f"{path}: is not UTF-8 text; save it as UTF-8.") from None


def parse_study(text: str, path: Path) -> Study:
    """Check the text of a run file; see `load_study`."""
    values = _toml(text, path)
    try:
        study = Study.model_validate(values)
    except ValidationError as error:
        found = list(dict.fromkeys([*problems(error, values, TABLES), *_of_sound_tables(error, values)]))
        many = f" {len(found)} things are wrong:" if len(found) > 1 else ""
        raise StudyError(f"{path}:{many}", found) from None
    return _resolve_paths(study, path)


def material_of(values: dict[str, Any]) -> MaterialTable:
    """Check the values of [material] alone, with paths as they are.

    Raises
    ------
    StudyError
        With every wrong key, unit and range.
    """
    try:
        return MaterialTable.model_validate(values)
    except ValidationError as error:
        raise wrong_tables(error, values, {**TABLES, "": MaterialTable}) from None


def _toml(text: str, path: Path) -> dict[str, Any]:
    if len(text) > LONGEST_RUN_FILE:
        raise StudyError(f"{path}: has more than {LONGEST_RUN_FILE:,} characters; is this a run file?")
    try:
        values = parse_toml(text)
    except InputError as error:
        raise StudyError(f"{path}: {error} for a run file.") from None
    except ValueError as error:  # of TOML, and of whole numbers with thousands of digits
        raise StudyError(_of_syntax(path, str(error))) from None
    if _depth(values) > _DEEPEST:
        raise StudyError(f"{path}: lists or tables lie within each other too deeply for a run file.")
    return values


def _of_syntax(path: Path, words: str) -> str:
    """Say what is wrong with the TOML, in words for people, and where."""
    where = str(path)
    if at := re.search(r" \(at (?:line (\d+), column (\d+)|end of document)\)$", words):
        where += f", line {at[1]}, column {at[2]}" if at[1] else ", at its end"
        words = words[: at.start()]
    if twice := re.match(r"Cannot (?:declare|mutate immutable namespace) \(('.*?),?\)", words):
        table = ".".join(part.strip(" '") for part in twice[1].split(","))
        return f"{where}: the table [{table[:100]}] is there twice, or has keys in two places."
    if words.startswith("Cannot overwrite a value"):
        return f"{where}: a key is given twice in the same table."
    if "integer string conversion" in words:
        return f"{where}: a whole number has thousands of digits."
    return f"{where}: is not valid TOML: {words}."


def _depth(values: dict[str, Any]) -> int:
    """Return how deeply lists and tables lie within each other; dotted keys make them as deep as they like."""
    depth, level = 0, list(values.values())
    while level and depth <= _DEEPEST:
        depth += 1
        level = [
            entry
            for one in level
            if isinstance(one, dict | list)
            for entry in (one.values() if isinstance(one, dict) else one)
        ]
    return depth


@functools.cache
def _adapter(name: str) -> TypeAdapter[Any]:
    field = FIELDS[name]
    whole: Any = Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation
    return TypeAdapter(whole)


def _of_sound_tables(error: ValidationError, values: dict[str, Any]) -> list[Note]:
    """Say what does not fit together between the tables that are right in themselves."""
    wrong = {problem["loc"][0] for problem in error.errors() if problem["loc"]}
    if any(problem["type"] == "relation" and len(problem["loc"]) < 1 for problem in error.errors()):
        return []
    sound: dict[str, Any] = {}
    unknown = wrong - {field.alias or name for name, field in FIELDS.items()}
    for name, field in FIELDS.items():
        key = field.alias or name
        # A table whose name is misspelt may be one of these.
        if key not in wrong and not (unknown and key in ("indenter", "surface") and key not in values):
            sound[key] = _adapter(name).validate_python(values[key]) if key in values else field.get_default()
    return [told(place(_parts(key), values), words) for key, words in relations(sound)]


def _parts(key: str) -> list[str | int]:
    return [int(part) if part.isdigit() else part for part in key.split(".")] if key else []


def _resolve_paths(study: Study, path: Path) -> Study:
    folder = path.parent
    try:
        materials = tuple(material.beside(folder) for material in study.materials)
        measurement = None if study.measurement is None else study.measurement.beside(folder)
        surface = None if study.surface is None else study.surface.beside(folder)
    except (OSError, ValueError) as error:
        raise StudyError(f"{path}: {getattr(error, 'strerror', None) or error}.") from None
    return study.model_copy(update={"materials": materials, "measurement": measurement, "surface": surface})
