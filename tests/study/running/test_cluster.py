"""Studies on a Dask cluster: the same bits as in one process, also where a worker is killed."""

from __future__ import annotations

import logging
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import viscofric as vf
from refusals import refused
from study.running.tasks import TwoWaves
from viscofric.study.run_file.settings import ClusterTable
from viscofric.study.running.cluster import BatchJobs, Dask
from viscofric.study.running.executors import Processes
from viscofric.study.running.running import Event, choose_executor, run_plan
from viscofric.study.running.store import CaseStore

TABLE = ClusterTable.model_validate(
    {
        "jobs": 3,
        "cores": 4,
        "memory": "8 GB",
        "walltime": "90 min",
        "queue": "short",
        "account": "rubber",
        "extra": ["--exclusive"],
        "prologue": ["module load python"],
    }
)


@pytest.mark.apart
@pytest.mark.timeout(600)  # Dask starts several processes
def test_worker_killed_amid_a_study_changes_no_bit(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    # Of a worker that is killed, Dask tells at length.
    for name in ("distributed", "distributed.scheduler", "distributed.nanny", "distributed.client"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    alone = TwoWaves()
    run_plan(alone, CaseStore(tmp_path / "alone"), Processes())
    shared, killed = TwoWaves(), []
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=logging.CRITICAL
    ) as cluster:

        def kill(event: Event) -> None:
            if event.event == "solved" and not killed:
                killed.append(cluster.workers[0].process.process)
                killed[0].kill()

        store = CaseStore(tmp_path / "shared")
        with choose_executor(None, cluster.scheduler_address, None) as executor:
            assert isinstance(executor, Dask)
            run_plan(shared, store, executor, kill)
    assert killed
    assert shared.bits() == alone.bits()
    assert sorted(store.stored()) == sorted(shared.known)


@pytest.mark.slow
def test_study_waits_for_workers_and_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr("viscofric.study.running.cluster._PATIENCE", 0.1)
    monkeypatch.setattr("viscofric.study.running.cluster._POLLING", 0.05)
    plan, heard = TwoWaves(), []
    with distributed.LocalCluster(
        n_workers=0, processes=False, protocol="tcp", dashboard_address=None, silence_logs=logging.CRITICAL
    ) as cluster:

        def start_worker(event: Event) -> None:
            heard.append(event)
            if event.event == "waiting":
                cluster.scale(1)

        with choose_executor(None, cluster.scheduler_address, None) as executor:
            run_plan(plan, CaseStore(tmp_path), executor, start_worker)
        said = {event.reason for event in heard if event.event == "waiting"}  # again where the worker is slow to start
        (reason,) = said
        assert reason is not None
        assert reason.count(cluster.scheduler_address) == 2  # what has no workers, and what to start
    assert len(plan.known) == 8


def test_what_dask_prints_is_kept_back_until_its_client_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    logger = logging.getLogger("distributed.client")
    before = logger.level
    levels = []

    class Client:
        def __init__(self, *_: object, **__: object) -> None: ...

        def __enter__(self) -> Client:
            return self

        def __exit__(self, *_: object) -> None:  # where the scheduler is gone, Dask prints its traceback here
            levels.append(logger.level)

    monkeypatch.setattr(distributed, "Client", Client)
    with Dask("tcp://127.0.0.1:9"):
        levels.append(logger.level)
    assert levels == [logging.CRITICAL, logging.CRITICAL]
    assert logger.level == before


def test_jobs_are_those_of_the_run_file() -> None:
    jobqueue = pytest.importorskip("dask_jobqueue")
    jobs = BatchJobs.of(TABLE)
    with jobqueue.SLURMCluster(**jobs.settings, scheduler_options={"dashboard_address": None}) as cluster:
        script = cluster.job_script()
    for line in (
        "#SBATCH -p short",
        "#SBATCH -A rubber",
        "#SBATCH --cpus-per-task=4",
        "#SBATCH --mem=8G",
        "#SBATCH -t 01:30:00",
        "#SBATCH --exclusive",
        "export OPENBLAS_NUM_THREADS=1",
        "module load python",
    ):
        assert line in script.splitlines()
    # One case at a time and core.
    assert "--nthreads 1 " in script
    assert "--nworkers 4 " in script
    assert jobs.jobs == 3


def test_ctrl_c_stays_an_interruption_where_jobs_are_prepared() -> None:
    pytest.importorskip("dask_jobqueue")
    code = (
        "import signal\n"
        "from viscofric.study.running.cluster import BatchJobs, Dask\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # which a test in the background has not
        "Dask(BatchJobs(1))\n"
        "assert signal.getsignal(signal.SIGINT) is signal.default_int_handler"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


@pytest.mark.apart
def test_a_study_runs_as_jobs_of_slurm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("dask_jobqueue")
    monkeypatch.chdir(tmp_path)  # where jobs write their messages
    if shutil.which("sinfo") is None:
        pytest.skip("there is no SLURM on this machine")
    idle = subprocess.run(["sinfo", "-h", "-t", "idle", "-o", "%P"], capture_output=True, text=True, timeout=20).stdout
    if not idle:
        pytest.skip("SLURM has no idle machine")
    conditions = 'load = "5 N"\nspeed = ["20 mm/s", "200 mm/s"]\ntemperature = "60 degC"'
    text = (
        '[material]\ncatalogue = "synthetic fluoroelastomer"\n[indenter]\nradius = "9.525 mm"\n'
        f"[conditions]\n{conditions}\n[solver]\naccuracy = 1e-2\n"
    )
    queue = idle.split()[0].rstrip("*")
    jobs = f'[cluster]\nqueue = "{queue}"\njobs = 1\ncores = 1\nmemory = "2 GB"\nwalltime = "1 h"\n'
    found = []
    for name, added in (("alone", ""), ("jobs", jobs)):
        study = tmp_path / f"{name}.toml"
        study.write_text(text + added)
        found.append(vf.run_study(study).dataset["friction_coefficient"].values)
    assert found[0].tolist() == found[1].tolist()


def test_jobs_where_none_can_be_sent_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("dask_jobqueue")
    monkeypatch.setenv("PATH", "")
    with refused("no-batch-system"):
        Dask(BatchJobs.of(TABLE)).__enter__()


def test_scheduler_that_does_not_answer_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("viscofric.study.running.cluster._PATIENCE", 0.3)
    with refused("no-scheduler"):
        Dask("tcp://127.0.0.1:9").__enter__()


def test_what_is_missing_is_named_with_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with refused("not-installed"):
        choose_executor(None, "tcp://10.0.0.1:8786", None)
    with refused("two-executors"):
        choose_executor(2, "tcp://10.0.0.1:8786", None)
