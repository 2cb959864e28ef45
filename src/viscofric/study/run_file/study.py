"""The run file: a study as written in TOML, validated before anything is computed."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, BeforeValidator, Field, TypeAdapter, ValidationError

from viscofric.errors import InputError, StudyError
from viscofric.files import file_path, parse_toml
from viscofric.notes import Note
from viscofric.showing import Rows, Shown
from viscofric.study.cases.sweep import Sweep, sweep_of
from viscofric.study.run_file.contact import SHAPES, AnyIndenterTable, ConditionsTable, IndenterTable, LayerTable
from viscofric.study.run_file.errors import place, problems, wrong
from viscofric.study.run_file.heating import HeatingTable
from viscofric.study.run_file.history import HistoryTable, ImpactTable
from viscofric.study.run_file.interface import InterfaceTable
from viscofric.study.run_file.material import MaterialTable
from viscofric.study.run_file.measurement import MeasurementTable
from viscofric.study.run_file.relations import relations
from viscofric.study.run_file.settings import ClusterTable, OutputsTable, SolverTable, SweepTable, UncertaintyTable
from viscofric.study.run_file.surface import SurfaceTable
from viscofric.study.run_file.tables import RANGE, SEED_RANGE, Problem, SeedRange, SpeedRange, Table

Part = TypeVar("Part", bound=BaseModel)

#: Far above the length of any run file.
LONGEST_RUN_FILE = 1_000_000  # characters
_MOST_BYTES = 4 * LONGEST_RUN_FILE + 4
#: Tables and lists within each other that a run file may need, and a little more.
_DEEPEST = 10
_MOST_MATERIALS = 100


def isothermal(noun: str, reason: str = "") -> Note:
    """Return the note that such contacts are not heated, with the reason as a clause."""
    return Note("history-isothermal", f"{noun} are not heated{reason}.")


def _several(value: object) -> object:
    return [value] if isinstance(value, dict | MaterialTable) else value


class Study(Shown, Table):
    """A whole run file; quantities in SI, paths resolved against the run file's folder.

    Attributes
    ----------
    title : str
    data_origin : {"measured", "synthetic"}
    author, sample, comment : str or None
        For the report.
    citation, licence : str or None
        Of the data.
    materials : tuple of MaterialTable
        [material], or each of several [[material]].
    indenter : BallTable, CylinderTable, EllipsoidTable or ConeTable, or None
    surface : SurfaceTable or None
        A rough surface instead.
    layer : LayerTable or None
    conditions : ConditionsTable
    sweep_table : SweepTable
        [sweep].
    history : HistoryTable or None
        Every case also over time.
    impact : ImpactTable or None
        Every indenter also as a falling mass.
    measurement : MeasurementTable or None
    interface : InterfaceTable or None
        The friction of a dry interface too.
    heating : HeatingTable or None
        Every case also at the temperature to which its own friction heats it.
    solver : SolverTable
    uncertainty : UncertaintyTable
    outputs : OutputsTable
    cluster : ClusterTable or None
    """

    title: str = Field("Viscoelastic friction", max_length=300, description="Title of the report.")
    data_origin: Literal["measured", "synthetic"] = Field(
        "measured", description="Origin of the data; report and figures label synthetic data."
    )
    author: str | None = Field(None, max_length=300, description="Who made the study; shown in the report.")
    sample: str | None = Field(None, max_length=300, description="Name or number of the specimen; shown in the report.")
    comment: str | None = Field(None, max_length=3000, description="Remarks; shown in the report.")
    citation: str | None = Field(None, max_length=1000, description="Publication or origin of the data, with its DOI.")
    licence: str | None = Field(None, max_length=300, description="Licence of the data, such as 'CC BY 4.0'.")
    materials: Annotated[
        tuple[MaterialTable, ...], Field(min_length=1, max_length=_MOST_MATERIALS), BeforeValidator(_several)
    ] = Field(alias="material", description="The material; [[material]] for each of several, with different names.")
    indenter: IndenterTable | None = Field(None, description="The indenter that slides or rolls over the rubber.")
    surface: SurfaceTable | None = Field(None, description="Instead: a rough surface that slides over the rubber.")
    layer: LayerTable | None = Field(
        None, description="Finite thickness of the rubber; a half-space without this table."
    )
    conditions: ConditionsTable = Field(description="Loads, speeds and temperatures of the prediction.")
    sweep_table: SweepTable = Field(SweepTable(), alias="sweep", description="Axes that vary together.")
    history: HistoryTable | None = Field(None, description="Every case also over time.")
    impact: ImpactTable | None = Field(None, description="Every ball or cone also falls on the rubber.")
    measurement: MeasurementTable | None = Field(None, description="Measured friction to compare with the prediction.")
    interface: InterfaceTable | None = Field(None, description="Friction of the dry interface, added to the rubber's.")
    heating: HeatingTable | None = Field(None, description="Cases also at the temperature of their own friction.")
    solver: SolverTable = Field(SolverTable(), description="Accuracy of the predicted friction.")
    uncertainty: UncertaintyTable = Field(UncertaintyTable(), description="Uncertainty of the material.")
    outputs: OutputsTable = Field(OutputsTable(), description="Stored fields and formats of the results.")
    cluster: ClusterTable | None = Field(None, description="SLURM jobs that solve the cases.")

    def _shown(self) -> Rows:
        return (
            ("title", self.title),
            ("data", self.data_origin),
            ("materials", ", ".join(one.name or "without a name" for one in self.materials)),
            ("contact", "rough surface" if self.indenter is None else type(self.indenter).__name__),
            ("notes", self.notes),
        )

    def _problems(self) -> Iterator[Problem]:
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
        files += self.history.inputs if self.history else ()
        return (*dict.fromkeys(files), *(self.measurement.inputs if self.measurement else ()))

    @property
    def body(self) -> AnyIndenterTable | SurfaceTable:
        """[indenter] or [surface]."""
        return self.indenter or self.surface  # type: ignore[return-value]  # one of them is there

    @property
    def applied_uncertainty(self) -> UncertaintyTable:
        """[uncertainty] where it applies: linearised bands exist for indenters only."""
        return self.uncertainty if self.indenter else self.uncertainty.model_copy(update={"draws": 0})

    @property
    def notes(self) -> tuple[Note, ...]:
        """Requests of the study that have no effect."""
        sampled = any(material.dma or material.steps for material in self.materials)
        over_time = sampled and (self.history is not None or self.impact is not None)
        said = self.uncertainty.notes(rough=self.indenter is None, over_time=over_time)
        if self._against_heating:
            reasons = " or ".join(self._against_heating)
            said = (*said, isothermal("Contacts over time", f": that is not possible with {reasons}"))
        if self.heating is not None and self.impact is not None:
            said = (*said, isothermal("Impacts"))
        return said

    @property
    def heats_histories(self) -> bool:
        """Whether the cases over time are heated, if the material permits it."""
        return self.history is not None and self.heating is not None and not self._against_heating

    @property
    def _against_heating(self) -> list[str]:
        """What keeps the cases over time isothermal, in words; what a history itself brings about is not prescribed."""
        history, heating = self.history, self.heating
        if history is None or heating is None:
            return []
        reasons = {
            "a rough surface": self.surface is not None,
            "a layer": self.layer is not None,
            "a law of the interface": self.interface is not None,
            "a periodic state": history.cycle,
            "steady sliding before": history.before == "sliding",
            "a given sliding velocity": heating.slip is not None,
            "earlier passes": heating.passes > 0,
            "the hot state": heating.branch == "hot",
        }
        return [reason for reason, holds in reasons.items() if holds]

    def sweep(self) -> Sweep:
        """Return all cases of the study, with their axes."""
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
    "history": HistoryTable,
    "impact": ImpactTable,
    "measurement": MeasurementTable,
    "interface": InterfaceTable,
    "heating": HeatingTable,
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
        A TOML file; paths in it are relative to its folder.

    Returns
    -------
    Study

    Raises
    ------
    StudyError
        If the file is missing or is not TOML, or with every wrong key, unit and range in it.

    Examples
    --------
    >>> from importlib.resources import files
    >>> import viscofric as vf
    >>> vf.load_study(files("viscofric") / "example" / "study.toml").title
    'Synthetic fluoroelastomer on a mini-traction machine'
    """
    path = file_path(path)
    return parse_study(read_study_text(path), path)


def read_study_text(path: Path) -> str:
    """Return the text of a run file; raise `StudyError` if it cannot be read."""
    try:
        with path.open("rb") as file:
            return decoded(file.read(_MOST_BYTES), path)
    except FileNotFoundError:
        raise StudyError(f"{path}: no such file.", code="no-file") from None
    except IsADirectoryError:
        raise StudyError(f"{path}: is a folder; expected a run file (TOML).", code="is-folder") from None
    except StudyError:
        raise
    except (OSError, ValueError) as error:
        raise StudyError(
            f"{path}: cannot be read ({getattr(error, 'strerror', None) or error}).", code="unreadable"
        ) from None


def decoded(data: bytes, path: Path) -> str:
    """Return the text of a run file's bytes; raise `StudyError` if it is not UTF-8."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise StudyError(f"{path}: is not UTF-8 text; save it as UTF-8.", code="not-utf8") from None


def parse_study(text: str, path: Path) -> Study:
    """Validate the text of a run file; see `load_study`."""
    values = _toml(text, path)
    try:
        study = Study.model_validate(values)
    except ValidationError as error:
        found = list(dict.fromkeys([*problems(error, values, TABLES), *_of_sound_tables(error, values)]))
        many = f" {len(found)} things are wrong:" if len(found) > 1 else ""
        raise StudyError(f"{path}:{many}", found) from None
    return _resolve_paths(study, path)


def validated(table: type[Part], values: dict[str, Any]) -> Part:
    """Validate the values of a part of a run file, with paths unchanged; raise `StudyError` with every error."""
    try:
        return table.model_validate(values)
    except ValidationError as error:
        found = problems(error, values, {**TABLES, "": table})
        whole = StudyError(found[0]) if len(found) == 1 else StudyError(f"{len(found)} things are wrong:", found)
        raise whole from None


def _toml(text: str, path: Path) -> dict[str, Any]:
    if len(text) > LONGEST_RUN_FILE:
        raise StudyError(f"{path}: has more than {LONGEST_RUN_FILE:,} characters; is this a run file?", code="too-long")
    try:
        values = parse_toml(text)
    except InputError:
        raise _too_deep(path) from None
    except ValueError as error:  # of TOML, and of whole numbers with thousands of digits
        raise StudyError(_of_syntax(path, str(error)), code="not-toml") from None
    if _depth(values) > _DEEPEST:
        raise _too_deep(path)
    return values


def _too_deep(path: Path) -> StudyError:
    return StudyError(f"{path}: lists or tables are nested too deeply for a run file.", code="too-deep")


def _of_syntax(path: Path, words: str) -> str:
    """Return what is wrong with the TOML, with line and column."""
    where = str(path)
    if at := re.search(r" \(at (?:line (\d+), column (\d+)|end of document)\)$", words):
        where += f", line {at[1]}, column {at[2]}" if at[1] else ", at its end"
        words = words[: at.start()]
    if twice := re.match(r"Cannot (?:declare|mutate immutable namespace) \(('.*?),?\)", words):
        table = ".".join(part.strip(" '") for part in twice[1].split(","))
        return f"{where}: the table [{table[:100]}] is given twice, or has keys in two places."
    if words.startswith("Cannot overwrite a value"):
        return f"{where}: a key is given twice in the same table."
    if "integer string conversion" in words:
        return f"{where}: a whole number has thousands of digits."
    return f"{where}: is not valid TOML: {words}."


def _depth(values: dict[str, Any]) -> int:
    """Return the depth of nested lists and tables; dotted keys can nest them without limit."""
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
    """Return the contradictions between those tables that are valid by themselves."""
    wrong_keys = {problem["loc"][0] for problem in error.errors() if problem["loc"]}
    if any(problem["type"] == "relation" and len(problem["loc"]) < 1 for problem in error.errors()):
        return []
    sound: dict[str, Any] = {}
    unknown = wrong_keys - {field.alias or name for name, field in FIELDS.items()}
    for name, field in FIELDS.items():
        key = field.alias or name
        # An unknown key may be one of these, misspelt.
        if key not in wrong_keys and not (unknown and key in ("indenter", "surface") and key not in values):
            sound[key] = _adapter(name).validate_python(values[key]) if key in values else field.get_default()
    return [wrong(place(_parts(key), values), words) for key, words in relations(sound)]


def _parts(key: str) -> list[str | int]:
    return [int(part) if part.isdigit() else part for part in key.split(".")] if key else []


def _resolve_paths(study: Study, path: Path) -> Study:
    folder = path.parent
    try:
        materials = tuple(material.relative_to(folder) for material in study.materials)
        tables = {name: getattr(study, name) for name in ("measurement", "surface", "history")}
        others = {name: one.relative_to(folder) for name, one in tables.items() if one is not None}
    except (OSError, ValueError) as error:
        raise StudyError(f"{path}: {getattr(error, 'strerror', None) or error}.", code="unreadable") from None
    return study.model_copy(update={"materials": materials, **others})
