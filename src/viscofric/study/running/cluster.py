"""Tasks solved by the workers of a Dask cluster: those of a running scheduler, or jobs of a batch system."""

from __future__ import annotations

import contextlib
import functools
import logging
import queue
import shutil
import signal
import time
import uuid
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from types import ModuleType
from typing import Any, Self

from viscofric.errors import InputError, ViscofricError, not_imported
from viscofric.friction.cases.solving import Task, solver_fingerprint
from viscofric.study.run_file.settings import ClusterTable
from viscofric.study.running.executors import Answers, Executor, Lost, Outcome, Waiting, take_on_cluster

_PATIENCE = 30.0  # s
_POLLING = 1.0  # s


@dataclass(frozen=True)
class BatchJobs:
    """Workers that are started as jobs of a batch system."""

    jobs: int
    #: Of ``dask_jobqueue.SLURMCluster``: queue, account, cores, memory, walltime …
    settings: dict[str, Any] = field(default_factory=dict)
    kind: str = "SLURMCluster"  # class of `dask_jobqueue`

    @classmethod
    def of(cls, table: ClusterTable) -> Self:
        """Return the jobs of [cluster] of a run file."""
        threads = [f"export {name}=1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")]
        settings: dict[str, Any] = {
            "cores": table.cores,
            "processes": table.cores,  # each solves one case at a time
            "memory": f"{table.memory} B",
            "walltime": _clock(table.walltime),
            "job_extra_directives": list(table.extra),
            "job_script_prologue": [*threads, *table.prologue],
        }
        named = {"queue": table.queue, "account": table.account}
        return cls(table.jobs, settings | {name: value for name, value in named.items() if value is not None})


class Dask(Executor):
    """Distributes tasks to the workers of a Dask cluster: of a scheduler's address, or of the jobs to start."""

    def __init__(self, where: str | BatchJobs) -> None:
        self._where = where
        self._distributed = _imported("distributed")
        self._jobqueue = None if isinstance(where, str) else _imported("dask_jobqueue")
        self._open = contextlib.ExitStack()
        self._client: Any = None

    def __enter__(self) -> Self:
        """Connect to the scheduler, or start jobs; raise `InputError` if there is no reply."""
        with contextlib.ExitStack() as opened:
            address: Any = self._where
            self._insist_on_batch_system()
            opened.enter_context(_without_tracebacks())  # first, so that it outlasts the client
            if isinstance(self._where, BatchJobs):
                address = opened.enter_context(getattr(self._jobqueue, self._where.kind)(**self._where.settings))
                # At least and at most: jobs that end, with their time or their machine, are replaced.
                address.adapt(minimum_jobs=self._where.jobs, maximum_jobs=self._where.jobs)
            try:
                client = self._distributed.Client(address, timeout=_PATIENCE, set_as_default=False)
            except (OSError, ValueError) as error:
                raise InputError(
                    f"scheduler {self._where!r} cannot be reached: {error}.", code="no-scheduler"
                ) from error
            self._client = opened.enter_context(client)
            self._open = opened.pop_all()
        return self

    def _insist_on_batch_system(self) -> None:
        """Raise `InputError` where no jobs can be submitted: Dask would wait for them for ever."""
        if isinstance(self._where, str):
            return
        command = getattr(self._jobqueue, self._where.kind).job_cls.submit_command
        if command is not None and shutil.which(command) is None:
            raise InputError(
                f"cluster: there is no {command} here; run the study where jobs can be submitted, or leave [cluster] "
                "out and give --workers.",
                code="no-batch-system",
            )

    def __exit__(self, *error: object) -> None:
        self._client = None
        self._open.close()

    def map(self, tasks: Sequence[Task]) -> Answers:
        """Solve tasks; see `Executor`."""
        run = uuid.uuid4().hex  # the scheduler keeps names for a while, also of cancelled tasks
        keys = [f"{task.key}-{run}" for task in tasks]
        work = functools.partial(take_on_cluster, fingerprint=solver_fingerprint())
        futures = dict(zip(self._client.map(work, tasks, key=keys, pure=False), tasks, strict=True))
        try:
            for found in self._finished(list(futures)):
                if isinstance(found, Waiting):
                    yield "", found
                    continue
                task = futures.pop(found)
                yield task.key, self._outcome(found, task)
        finally:
            if futures:
                self._client.cancel(list(futures))

    def _finished(self, futures: Sequence[Any]) -> Iterator[Any]:
        """Yield finished futures; yield `Waiting` once if there have been no workers for long."""
        finished: queue.SimpleQueue[Any] = queue.SimpleQueue()
        for future in futures:
            future.add_done_callback(finished.put)
        left, idle_since, reported = len(futures), time.monotonic(), False
        while left:
            try:
                found = finished.get(timeout=_POLLING)  # an endless wait may not notice an interrupt
            except queue.Empty:
                if self._client.scheduler_info()["workers"]:
                    idle_since, reported = time.monotonic(), False
                elif not reported and time.monotonic() > idle_since + _PATIENCE:
                    reported = True
                    yield Waiting(self._why_waiting())
            else:
                left -= 1
                idle_since = time.monotonic()
                yield found

    def _why_waiting(self) -> str:
        if isinstance(self._where, str):
            return (
                f"the scheduler {self._where} has no workers; the study continues when one is started "
                f"(dask worker {self._where})."
            )
        return (
            "none of the cluster's jobs is running: the batch system queues or refused them (see squeue); "
            "the study continues when one starts."
        )

    def _outcome(self, future: Any, task: Task) -> Outcome:
        try:
            outcome: Outcome = future.result()
        except self._distributed.KilledWorker:
            why = "several workers ended while solving it, mostly for lack of memory."
            return Lost(why, task.label, "process-ended")
        except self._distributed.CancelledError as error:
            raise ViscofricError("the Dask scheduler ended, or cancelled the tasks.", code="scheduler-ended") from error
        except ViscofricError:
            raise
        except Exception as error:
            raise ViscofricError(
                f"the workers of the Dask cluster cannot solve the tasks ({type(error).__name__}: {error}); "
                "viscofric must be installed on all machines, in the same version.",
                code="workers-unusable",
            ) from error
        return outcome


@contextlib.contextmanager
def _without_tracebacks() -> Iterator[None]:
    """Keep Dask from printing tracebacks when the scheduler ends, which an error reports."""
    loggers = [logging.getLogger(name) for name in ("distributed.client", "distributed.utils")]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def _clock(seconds: int) -> str:
    """Return a time as SLURM writes it: hours, minutes and seconds."""
    minutes, seconds = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours:02d}:{minutes:02d}:{seconds:02d}"


def _imported(name: str) -> ModuleType:
    interrupted = signal.getsignal(signal.SIGINT)
    try:
        found = import_module(name)
        # dask_jobqueue, as it is imported, makes Ctrl-C end the program silently and with success.
        if signal.getsignal(signal.SIGINT) is not interrupted:
            signal.signal(signal.SIGINT, interrupted)
        return found
    except Exception as error:
        why = not_imported(name, error, "pip install 'viscofric[cluster]'")
        raise InputError(f"clusters need {name}, but {why}.", code="not-installed") from error
