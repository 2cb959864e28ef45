"""The run file: what a study asks for, read from TOML and checked before anything is computed."""

from __future__ import annotations

import difflib
import tomllib
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import (
    AfterValidator,
    BaseModel,
    Discriminator,
    Field,
    Tag,
    ValidationError,
    model_validator,
)

from viscofric.errors import StudyError
from viscofric.rheology.uncertainty.sampling import FEWEST_SAMPLES
from viscofric.study.material_table import MaterialTable
from viscofric.study.measurement_table import MeasurementTable
from viscofric.study.quantities import VALUE, Force, Length, Speed, Table, Temperature

_MOST_POINTS = 10_000
_MOST_SAMPLES = 10_000


class SpeedRange(Table):
    """Speeds from one to another."""

    first: Speed = Field(alias="from")
    last: Speed = Field(alias="to")
    points: int = Field(ge=2, le=_MOST_POINTS)
    spacing: Literal["log", "linear"] = "log"

    def speeds(self) -> tuple[float, ...]:
        """All speeds, m/s."""
        spread = np.geomspace if self.spacing == "log" else np.linspace
        return tuple(float(speed) for speed in spread(self.first, self.last, self.points))


class IndenterTable(Table):
    """[indenter]: what slides or rolls over the rubber."""

    shape: Literal["ball"] = "ball"
    radius: Length


class ConditionsTable(Table):
    """[conditions]: load, speeds and temperatures to predict friction at, and how thick the rubber is."""

    load: Force
    speed: Annotated[
        Annotated[SpeedRange, Tag("range")] | Annotated[tuple[Speed, ...], Tag("list"), Field(min_length=1)],
        Discriminator(lambda value: "range" if isinstance(value, dict | SpeedRange) else "list"),
    ]
    temperature: tuple[Temperature, ...] = Field(min_length=1)
    thickness: Length | None = None

    @model_validator(mode="before")
    @classmethod
    def _one_is_a_list(cls, values: Any) -> Any:
        if isinstance(values, dict):
            values = dict(values)
            for key in ("speed", "temperature"):
                if isinstance(values.get(key), str):
                    values[key] = [values[key]]
        return values

    def speeds(self) -> tuple[float, ...]:
        """All speeds, m/s."""
        return self.speed.speeds() if isinstance(self.speed, SpeedRange) else self.speed


def _enough(value: int) -> int:
    if 0 < value < FEWEST_SAMPLES:
        raise ValueError(f"{value} is too few; give {FEWEST_SAMPLES} or more, or 0 for no bands")
    return value


class SolverTable(Table):
    """[solver]: how accurate the friction is to be, and how many rubbers are drawn for its bands."""

    accuracy: float = Field(default=1e-3, ge=1e-4, le=0.1, allow_inf_nan=False)
    master_curve_points: int = Field(default=41, ge=2, le=_MOST_POINTS)
    samples: Annotated[int, AfterValidator(_enough)] = Field(default=200, ge=0, le=_MOST_SAMPLES)


class Study(Table):
    """A whole run file; quantities in SI, paths resolved against the run file's folder."""

    title: str = "Viscoelastic friction"
    data_origin: Literal["measured", "synthetic"] = "measured"
    material: MaterialTable
    indenter: IndenterTable
    conditions: ConditionsTable
    measurement: MeasurementTable | None = None
    solver: SolverTable = SolverTable()

    @property
    def inputs(self) -> tuple[Path, ...]:
        """All data files."""
        return (*self.material.inputs, *(self.measurement.inputs if self.measurement else ()))


def load_study(path: str | Path) -> Study:
    """Read and check a run file.

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
    """
    path = Path(path)
    return parse_study(read_study_text(path), path)


def read_study_text(path: Path) -> str:
    """Return the text of a run file."""
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise StudyError(f"{path}: no such file.") from None
    except IsADirectoryError:
        raise StudyError(f"{path}: is a folder; a run file (TOML) is wanted.") from None
    except UnicodeDecodeError:
        raise StudyError(f"{path}: is not UTF-8 text; save it as UTF-8.") from None
    except (OSError, ValueError) as error:
        raise StudyError(f"{path}: cannot be read ({getattr(error, 'strerror', None) or error}).") from None


def parse_study(text: str, path: Path) -> Study:
    """Check the text of a run file; see `load_study`."""
    try:
        values = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise StudyError(f"{path}: is not valid TOML: {error}.") from None
    try:
        study = Study.model_validate(values)
    except ValidationError as error:
        raise StudyError(f"{path}: {_sentences(error)}") from None
    return _resolve_paths(study, path.parent)


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
        raise StudyError(_sentences(error)) from None


def _sentences(error: ValidationError) -> str:
    """Say all that pydantic found."""
    found = error.errors()
    # A list whose entries are wrong counts as empty too: say only what is wrong with the entries.
    inside = {problem["loc"][:depth] for problem in found for depth in range(len(problem["loc"]))}
    return " ".join(dict.fromkeys(_sentence(problem) for problem in found if problem["loc"] not in inside))


def _resolve_paths(study: Study, folder: Path) -> Study:
    material = study.material.beside(folder)
    measurement = None if study.measurement is None else study.measurement.beside(folder)
    return study.model_copy(update={"material": material, "measurement": measurement})


def _sentence(problem: Any) -> str:
    """One problem that pydantic found, as a sentence that names the field and what would be right."""
    keys = [part for part in problem["loc"] if part not in _BRANCHES]
    field = ".".join(str(key) for key in keys)
    match problem["type"]:
        case "extra_forbidden":
            known = _known_keys(keys[:-1])
            near = difflib.get_close_matches(str(keys[-1]), known, n=1, cutoff=0.5)
            hint = f"did you mean '{near[0]}'?" if near else f"known keys are {', '.join(known)}."
            return f"{field}: unknown key; {hint}"
        case "missing":
            return f"{field}: is missing."
        case "too_short":
            return f"{field}: is empty; at least one value is wanted."
        case "tuple_type":
            return f"{field}: {problem['input']!r} is neither text with a unit, nor a list of such, nor a table."
        case "model_type":
            return f"{field}: {problem['input']!r} is not a table; write [{field}] with its keys below it."
    message = problem["msg"].removeprefix("Value error, ").removeprefix(f"{VALUE} = ")
    place = f"{field}: " if field else ""
    return f"{place}{message}" + ("" if message.endswith((".", "?")) else ".")


def _known_keys(path: list[Any]) -> list[str]:
    """Keys that the table at a path may hold, as the user writes them."""
    model: type[BaseModel] = Study
    for part in path:
        model = TABLES.get(part, model)
    return [field.alias or name for name, field in model.model_fields.items()]


TABLES: dict[Any, type[BaseModel]] = {
    "material": MaterialTable,
    "indenter": IndenterTable,
    "conditions": ConditionsTable,
    "speed": SpeedRange,
    "measurement": MeasurementTable,
    "solver": SolverTable,
}
# Names of the branches of a choice between types: they appear in pydantic's locations, not in the file.
_BRANCHES = {"range", "list"}
