"""[sweep], [solver], [uncertainty], [outputs] and [cluster] of a run file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, WithJsonSchema

from viscofric.notes import Note
from viscofric.study.run_file.tables import BIGGEST_SEED, MOST_POINTS, VALUE, Count, Number, Problem, Table, with_unit
from viscofric.units import positive

_MOST_SAMPLES = 10_000
_MOST_MEMBERS = 1_000
_POINTS = 41  # of the friction master curve
#: Formats in which results are written besides netCDF.
Format = Literal["csv", "excel"]

Names = Annotated[tuple[str, ...], Field(min_length=2, max_length=10)]


class SweepTable(Table):
    """[sweep]: axes that vary together; all others form a full product."""

    together: tuple[Names, ...] = Field(
        (),
        max_length=10,
        description="Groups of axes that vary together, such as [['load', 'radius']]; all of the same length.",
    )

    def _problems(self) -> Iterator[Problem]:
        seen: set[str] = set()
        for number, group in enumerate(self.together):
            for place, name in enumerate(group):
                if name in seen:
                    yield f"together.{number}.{place}", f"{name!r} is named twice; an axis belongs to one group"
                seen.add(name)


class SolverTable(Table):
    """[solver]: accuracy of friction, and how the cases are solved."""

    accuracy: Number = Field(1e-3, ge=1e-10, le=0.1, description="Relative numerical error of friction.")
    cases: Literal["curves", "each"] = Field(
        "curves",
        description="Solve similar cases as one curve and interpolate within the accuracy, or solve each case.",
    )
    master_curve_points: Count | None = Field(
        None,
        ge=2,
        le=MOST_POINTS,
        description="Points of the friction master curve; default: 41, or none with cases = 'each' unless "
        "friction was measured.",
    )

    def points_along(self, *, measured: bool) -> int:
        """Return the number of points of the friction master curve; 0 for none."""
        if self.master_curve_points is not None:
            return self.master_curve_points
        return 0 if self.cases == "each" and not measured else _POINTS


def _enough(value: int) -> int:
    from viscofric.rheology.uncertainty.sampling import FEWEST_SAMPLES  # help does not need it

    if 0 < value < FEWEST_SAMPLES:
        raise ValueError(f"{value} is too few; give {FEWEST_SAMPLES} or more, or 0 for no bands")
    return value


_NO_BANDS = Note(
    "no-bands",
    "Friction on a rough surface has no linearised 95 % bands, which are found for indenters only; [uncertainty] "
    "members solves every case with samples of the material, and several seeds show how friction scatters from surface "
    "to surface.",
)
_NO_BANDS_OVER_TIME = Note(
    "no-bands",
    "Contacts over time and impacts have no linearised 95 % bands; [uncertainty] members solves them also with samples "
    "of the material, whose scatter is the band.",
)


class UncertaintyTable(Table):
    """[uncertainty]: bootstrap samples of the material."""

    draws: Annotated[Count, AfterValidator(_enough)] = Field(
        200,
        ge=0,
        le=_MOST_SAMPLES,
        description="Bootstrap samples of the material for the linearised 95 % bands; 0: none.",
    )
    members: Count = Field(
        0, ge=0, le=_MOST_MEMBERS, description="Bootstrap samples of the material with which every case is also solved."
    )
    seed: Count = Field(
        0, ge=0, le=BIGGEST_SEED, description="Seed of the random numbers; the same seed gives the same samples."
    )

    def notes(self, *, rough: bool, over_time: bool) -> tuple[Note, ...]:
        """Return what has no linearised bands: friction of a rough surface, contacts over time without members."""
        found = [(_NO_BANDS, rough), (_NO_BANDS_OVER_TIME, over_time and not self.members)]
        return tuple(note for note, so in found if so and self.draws)


class OutputsTable(Table):
    """[outputs]: the stored fields, and the formats of the results."""

    fields: Literal["few", "all", "none"] = Field(
        "few", description="Stored pressure and displacement: of a few cases, of all solved ones, or of none."
    )
    formats: tuple[Format, ...] = Field((), max_length=10, description="Formats to write besides results.nc (netCDF).")


def _bytes(value: object) -> int:
    return round(positive(with_unit(value), "byte", VALUE))


def _seconds(value: object) -> int:
    found = round(positive(with_unit(value), "s", VALUE))
    if found < 1:
        raise ValueError(f"{value!r} is less than a second; give the time limit of a job, such as '2 h'")
    return found


def _quantity(example: str) -> WithJsonSchema:
    return WithJsonSchema({"type": "string", "pattern": r"^\s*[0-9.]+\s*[a-zA-Z]+\s*$", "examples": [example]})


Bytes = Annotated[int, BeforeValidator(_bytes), _quantity("8 GB")]
Seconds = Annotated[int, BeforeValidator(_seconds), _quantity("2 h")]
Line = Annotated[str, Field(min_length=1, max_length=1_000, pattern=r"^[^\r\n\x00]*$")]


class ClusterTable(Table):
    """[cluster]: jobs of a SLURM cluster that solve cases (extra "cluster", dask-jobqueue)."""

    queue: Line | None = Field(None, description="Partition of the jobs; default: that of the cluster.")
    account: Line | None = Field(None, description="Account of the jobs.")
    jobs: Count = Field(1, ge=1, le=1_000, description="Number of jobs, each with these cores and this memory.")
    cores: Count = Field(1, ge=1, le=1_024, description="Cores of a job; each solves one case at a time.")
    memory: Bytes = Field(description="Memory of a job.")
    walltime: Seconds = Field(description="Time limit of a job; another job takes over its unfinished cases.")
    extra: tuple[Line, ...] = Field((), max_length=100, description="Further #SBATCH directives: ['--gres=gpu:1'].")
    prologue: tuple[Line, ...] = Field(
        (), max_length=100, description="Shell commands before the worker starts: ['module load python']."
    )
