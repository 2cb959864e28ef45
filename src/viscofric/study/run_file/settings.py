"""[sweep], [solver], [uncertainty], [outputs] and [cluster] of a run file: how the cases are made, solved and kept."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, WithJsonSchema

from viscofric.rheology.uncertainty.sampling import FEWEST_SAMPLES
from viscofric.study.run_file.tables import BIGGEST_SEED, MOST_POINTS, VALUE, Count, Number, Table, with_unit
from viscofric.units import positive

if TYPE_CHECKING:
    from collections.abc import Iterator

    from viscofric.study.run_file.tables import Problem

_MOST_SAMPLES = 10_000
_MOST_MEMBERS = 1_000
_POINTS = 41  # of the friction master curve
#: Formats in which results are written besides netCDF.
Format = Literal["csv", "excel", "zarr"]

Names = Annotated[tuple[str, ...], Field(min_length=2, max_length=10)]


class SweepTable(Table):
    """[sweep]: which axes go together; all others make a full product."""

    together: tuple[Names, ...] = Field(
        (),
        max_length=10,
        description="Groups of axes that are stepped together, such as [['load', 'radius']]; each has as many values.",
    )

    def problems(self) -> Iterator[Problem]:
        """Yield what does not fit together within the table."""
        seen: set[str] = set()
        for number, group in enumerate(self.together):
            for place, name in enumerate(group):
                if name in seen:
                    yield f"together.{number}.{place}", f"{name!r} is named twice; an axis belongs to one group"
                seen.add(name)


class SolverTable(Table):
    """[solver]: how accurate the friction is to be, and how the cases are solved."""

    accuracy: Number = Field(1e-3, ge=1e-4, le=0.1, description="Numerical error of friction, relative.")
    cases: Literal["curves", "each"] = Field(
        "curves",
        description="Whether similar cases are solved as one curve and interpolated within the accuracy, or each.",
    )
    master_curve_points: Count | None = Field(
        None,
        ge=2,
        le=MOST_POINTS,
        description="Points of the friction master curve; 41 if not given, but none with cases = 'each' unless "
        "friction was measured.",
    )

    def points_along(self, *, measured: bool) -> int:
        """Return the points of the friction master curve, given whether friction was measured; 0 for none."""
        if self.master_curve_points is not None:
            return self.master_curve_points
        return 0 if self.cases == "each" and not measured else _POINTS


def _enough(value: int) -> int:
    if 0 < value < FEWEST_SAMPLES:
        raise ValueError(f"{value} is too few; give {FEWEST_SAMPLES} or more, or 0 for no bands")
    return value


class UncertaintyTable(Table):
    """[uncertainty]: the rubber drawn as other measurements might have given it."""

    draws: Annotated[Count, AfterValidator(_enough)] = Field(
        200,
        ge=0,
        le=_MOST_SAMPLES,
        description="Draws of the rubber for the linearised 95 % bands; 0: none.",
    )
    members: Count = Field(
        0, ge=0, le=_MOST_MEMBERS, description="Draws of the rubber that every case is really solved with, too."
    )
    seed: Count = Field(0, ge=0, le=BIGGEST_SEED, description="Of the random draws: the same seed, the same rubbers.")


class OutputsTable(Table):
    """[outputs]: what is kept of the solved cases, and in which files."""

    fields: Literal["few", "all", "none"] = Field(
        "few", description="Pressure and displacement: of a few chosen cases, of all that are solved, or of none."
    )
    formats: tuple[Format, ...] = Field((), max_length=10, description="Files besides results.nc (netCDF).")


def _bytes(value: object) -> int:
    return round(positive(with_unit(value), "byte", VALUE))


def _seconds(value: object) -> int:
    found = round(positive(with_unit(value), "s", VALUE))
    if found < 1:
        raise ValueError(f"{value!r} is less than a second; write the time that a job may take, such as '2 h'")
    return found


def _quantity(example: str) -> WithJsonSchema:
    return WithJsonSchema({"type": "string", "pattern": r"^\s*[0-9.]+\s*[a-zA-Z]+\s*$", "examples": [example]})


Bytes = Annotated[int, BeforeValidator(_bytes), _quantity("8 GB")]
Seconds = Annotated[int, BeforeValidator(_seconds), _quantity("2 h")]
Line = Annotated[str, Field(min_length=1, max_length=1_000, pattern=r"^[^\r\n\x00]*$")]


class ClusterTable(Table):
    """[cluster]: jobs of a SLURM cluster, each a worker that solves cases (extra "cluster", dask-jobqueue)."""

    queue: Line | None = Field(None, description="Partition that the jobs are sent to; the cluster's default without.")
    account: Line | None = Field(None, description="Account that they are charged to.")
    jobs: Count = Field(1, ge=1, le=1_000, description="How many jobs, each of these cores and this memory.")
    cores: Count = Field(1, ge=1, le=1_024, description="Cores of a job; each solves one case at a time.")
    memory: Bytes = Field(description="Memory of a job.")
    walltime: Seconds = Field(description="Time after which a job ends; what it was solving is taken up by another.")
    extra: tuple[Line, ...] = Field(
        (), max_length=100, description="More directives, each as after #SBATCH: ['--gres=gpu:1']."
    )
    prologue: tuple[Line, ...] = Field(
        (), max_length=100, description="Shell commands before the worker starts: ['module load python']."
    )
