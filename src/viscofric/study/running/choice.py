"""Which executor a study gets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.errors import InputError
from viscofric.study.running.executors import Executor, Nobody, Processes, Serial

if TYPE_CHECKING:
    from viscofric.study.settings_tables import ClusterTable


def choose_executor(
    workers: int | None, scheduler: str | None, cluster: ClusterTable | None, finished_only: bool = False
) -> Executor:
    """Return the executor that is asked for; what is asked for now counts more than the run file.

    Parameters
    ----------
    workers : int, optional
        Processes of this machine.
    scheduler : str, optional
        Address of a Dask scheduler.
    cluster : ClusterTable, optional
        Of the run file.
    finished_only : bool
        Whether nothing is to be done any more.

    Raises
    ------
    InputError
        If both are asked for, the number is none, or Dask is not installed.
    """
    if finished_only:
        if workers is not None or scheduler is not None:
            raise InputError("finished_only: nothing is solved, so that neither workers nor a scheduler are of use.")
        return Nobody()
    if scheduler is not None:
        if workers is not None:
            raise InputError("workers and scheduler: only one of them; a scheduler has workers of its own.")
        from viscofric.study.running.cluster import Dask

        return Dask(scheduler)
    if workers is not None:
        executor = Processes(workers)
        return Serial() if workers == 1 else executor
    if cluster is not None:
        from viscofric.study.running.cluster import BatchJobs, Dask

        return Dask(BatchJobs.of(cluster))
    return Serial()
