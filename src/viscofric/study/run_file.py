"""The run file: what a study asks for, read from TOML and checked before anything is computed."""

from __future__ import annotations

import difflib
import math
import tomllib
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    ValidationError,
    model_validator,
)

from viscofric.errors import StudyError
from viscofric.units import Quantity, positive, to_si

# Stands for the field's name in messages about units; the location says it better.
_VALUE = "value"


def _with_unit(value: object) -> Quantity:
    """Refuse bare numbers: in a run file every quantity carries its unit."""
    if not isinstance(value, str):
        raise ValueError(f"{value!r} has no unit; write text such as '25 N', '100 mm/s', '30 degC'")
    return value


def _kelvin(value: object) -> float:
    kelvin = to_si(_with_unit(value), "K", _VALUE)
    if kelvin <= 0.0:
        raise ValueError(f"{value!r} lies below absolute zero")
    return kelvin


# A user's value, already turned into SI.
_Length = Annotated[float, BeforeValidator(lambda value: positive(_with_unit(value), "m", _VALUE))]
_Force = Annotated[float, BeforeValidator(lambda value: positive(_with_unit(value), "N", _VALUE))]
_Speed = Annotated[float, BeforeValidator(lambda value: positive(_with_unit(value), "m/s", _VALUE))]
_Temperature = Annotated[float, BeforeValidator(_kelvin)]

_MOST_POINTS = 10_000


class _Table(BaseModel):
    """A table of the run file: no unknown keys, no changes afterwards."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class SpeedRange(_Table):
    """Speeds from one to another."""

    first: _Speed = Field(alias="from")
    last: _Speed = Field(alias="to")
    points: int = Field(ge=2, le=_MOST_POINTS)
    spacing: Literal["log", "linear"] = "log"

    def speeds(self) -> tuple[float, ...]:
        """All speeds, m/s."""
        spread = np.geomspace if self.spacing == "log" else np.linspace
        return tuple(float(speed) for speed in spread(self.first, self.last, self.points))


class MaterialTable(_Table):
    """[material]: the DMA file and how the rubber is made of it."""

    dma: Path
    deformation: Literal["tension", "shear"] | None = None
    poisson_ratio: float = Field(default=0.5, ge=0.0, le=0.5)
    reference_temperature: _Temperature
    shift: Literal["measured", "wlf"] = "measured"
    tau_ratio: float = Field(default=math.e, gt=1.0, le=100.0)


class IndenterTable(_Table):
    """[indenter]: what slides or rolls over the rubber."""

    shape: Literal["ball"] = "ball"
    radius: _Length


class ConditionsTable(_Table):
    """[conditions]: load, speeds and temperatures to predict friction at."""

    load: _Force
    speed: Annotated[
        Annotated[SpeedRange, Tag("range")] | Annotated[tuple[_Speed, ...], Tag("list"), Field(min_length=1)],
        Discriminator(lambda value: "range" if isinstance(value, dict | SpeedRange) else "list"),
    ]
    temperature: tuple[_Temperature, ...] = Field(min_length=1)

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


class MeasurementTable(_Table):
    """[measurement]: traction runs to lay beside the prediction."""

    mtm: tuple[Path, ...] = Field(min_length=1)

    @model_validator(mode="before")
    @classmethod
    def _one_is_a_list(cls, values: Any) -> Any:
        if isinstance(values, dict) and isinstance(values.get("mtm"), str):
            return {**values, "mtm": [values["mtm"]]}
        return values


class SolverTable(_Table):
    """[solver]: how accurate the friction is to be."""

    accuracy: float = Field(default=1e-3, ge=1e-4, le=0.1, allow_inf_nan=False)
    master_curve_points: int = Field(default=41, ge=2, le=_MOST_POINTS)


class Study(_Table):
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
        return (self.material.dma, *(self.measurement.mtm if self.measurement else ()))


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
        found = error.errors()
        # A list whose entries are wrong counts as empty too: say only what is wrong with the entries.
        inside = {problem["loc"][:depth] for problem in found for depth in range(len(problem["loc"]))}
        problems = [_sentence(problem) for problem in found if problem["loc"] not in inside]
        raise StudyError(f"{path}: " + " ".join(dict.fromkeys(problems))) from None
    return _resolve_paths(study, path.parent)


def _resolve_paths(study: Study, folder: Path) -> Study:
    material = study.material.model_copy(update={"dma": folder / study.material.dma})
    measurement = study.measurement
    if measurement is not None:
        measurement = measurement.model_copy(update={"mtm": tuple(folder / file for file in measurement.mtm)})
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
    message = problem["msg"].removeprefix("Value error, ").removeprefix(f"{_VALUE} = ")
    return f"{field}: {message}" + ("" if message.endswith((".", "?")) else ".")


def _known_keys(path: list[Any]) -> list[str]:
    """Keys that the table at a path may hold, as the user writes them."""
    model: type[BaseModel] = Study
    for part in path:
        model = _TABLES.get(part, model)
    return [field.alias or name for name, field in model.model_fields.items()]


_TABLES: dict[Any, type[BaseModel]] = {
    "material": MaterialTable,
    "indenter": IndenterTable,
    "conditions": ConditionsTable,
    "speed": SpeedRange,
    "measurement": MeasurementTable,
    "solver": SolverTable,
}
# Names of the branches of a choice between types: they appear in pydantic's locations, not in the file.
_BRANCHES = {"range", "list"}
