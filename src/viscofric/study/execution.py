"""Running a study: from its run file to the material, all contacts, and the comparison with a measurement."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from viscofric.arguments import flag, insist_on, insist_on_function
from viscofric.datasets import Dataset, DataTree
from viscofric.files import file_path, says_synthetic
from viscofric.friction.cases.record import Failure
from viscofric.friction.cases.surfaces import notes_on
from viscofric.notes import Note, Reader, dumped, note_of, records
from viscofric.study.assumptions import assumption_checks, assumption_warnings, assumptions
from viscofric.study.cases.singles import Singles
from viscofric.study.contacts import Contacts, Solved, doubts, missed_accuracy, nothing_solved
from viscofric.study.heating import NO_LAW, Heatings
from viscofric.study.histories import Histories, Impacts, material_notes
from viscofric.study.interface import StudyInterface, interface_columns, study_interface
from viscofric.study.measurement import Measurement, read_measurement
from viscofric.study.results.file import DESCRIBED, save_results
from viscofric.study.results.results import StudyResults, input_hashes, provenance
from viscofric.study.results.tree import field_groups, master_prediction, material_groups, prediction, setting
from viscofric.study.rubber_datasets import rubber_groups
from viscofric.study.run_file.study import Study, parse_study, read_study_text
from viscofric.study.running.folder import study_folder
from viscofric.study.running.running import Event, Progress, choose_executor, run_plan, silent
from viscofric.study.study_rubber import StudyRubber, all_within, band_columns

Groups = dict[str, Dataset]


# Contacts named in a sentence.
_MOST_LABELS = 5


def run_study(
    path: str | Path,
    *,
    output: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    scheduler: str | None = None,
    finished_only: bool = False,
    progress: Progress = silent,
) -> StudyResults:
    r"""Run a study: material from DMA, friction of every case, comparison with a measurement.

    Parameters
    ----------
    path : str or Path
        The run file (TOML).
    output : str or Path, optional
        Folder for the results; ``<run file>.results`` next to the run file if not given.
    resume : bool
        Whether the folder may hold what another run left, finished or not.  Contacts that are solved there are taken as
        they are if they are the same to the last digit, whatever the run file was then, and the results are replaced.
        Without it, such a folder is refused.
    workers : int, optional
        Processes of this machine that solve contacts; one, or the run file's [cluster], if not given.
    scheduler : str, optional
        Address of a Dask scheduler, such as ``"tcp://10.0.0.1:8786"``, whose workers solve contacts instead.
    finished_only : bool
        Whether to solve nothing, and put together what another run of the study solved before it was interrupted; the
        other cases count as failed, until a run with `resume` solves them.
    progress : callable, optional
        Gets an `Event` of each stage that begins or takes a step, and of each contact.

    Returns
    -------
    StudyResults
        Also stored in the folder, as ``results.nc``.  The same to the last digit however many workers there were and
        however often the study was interrupted.  Cases that could not be solved are listed in ``failures``.

    Raises
    ------
    StudyError
        If the run file is wrong, the folder is in use or not to be resumed, or no case at all could be solved.
    DataFileError, SuperpositionError, InputError
        If a data file cannot be used, or the folder cannot be written.
    ViscofricError
        If there are no workers of use.

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
    >>> results = vf.run_study("ball.toml")
    >>> results.dataset["friction_coefficient"].values.round(3)
    array([0.01 , 0.017])
    """
    path = file_path(path)
    insist_on_function(progress, "progress", needed=True)
    for name, value in (("resume", resume), ("finished_only", finished_only)):
        flag(value, name)
    insist_on(scheduler, "scheduler", str, type(None), right="the address of a Dask scheduler, such as 'tcp://…:8786'")
    text = read_study_text(path)
    study = parse_study(text, path)
    folder = path.with_suffix(".results") if output is None else file_path(output)
    executor = choose_executor(workers, scheduler, study.cluster, finished_only)
    # Workers start while the inputs are read.
    with study_folder(folder, resume or finished_only) as store, executor:
        hashes = input_hashes(study.inputs, path.parent)
        rubbers, measured = _inputs(study, _staged(progress))
        contacts = Contacts(study, rubbers, measured)
        arguments = study, contacts.sweep, contacts.plan.rubbers
        over_time = Histories.of(*arguments), Impacts.of(*arguments)
        damaged = run_plan(contacts.plan, store, executor, progress)
        interface = study_interface(contacts)
        heatings = Heatings.of(*arguments, interface.law)
        singles: list[Singles] = [one for one in (heatings, *over_time) if one is not None]
        for one in singles:
            damaged += run_plan(one, store, executor, _as_stage(progress, one.STAGE))
        tree = tree_of(contacts, _damage(damaged, finished_only), singles, interface)
        name = path.name.encode(errors="backslashreplace").decode()  # a file name may hold bytes that are no text
        tree.attrs |= {"study_file": name, "study_text": text, "input_hashes": hashes, **provenance()}
        save_results(tree, folder)
        results = StudyResults(tree, folder)
        for form in study.outputs.formats:
            results.export(form)
    return results


def _as_stage(progress: Progress, name: str) -> Progress:
    """Return a callback that reports the events of contacts as those of another stage."""

    def report(event: Event) -> None:
        progress(replace(event, stage=name))

    return report


def _staged(progress: Progress) -> Callable[[str, Callable[[], Any]], Any]:
    """Return a function that runs a step and reports it as a stage."""

    def stage(name: str, step: Callable[[], Any]) -> Any:
        progress(Event("stage", stage=name, done=0, total=1))
        result = step()
        progress(Event("stage", stage=name, done=1, total=1))
        return result

    return stage


def _inputs(
    study: Study, stage: Callable[[str, Callable[[], Any]], Any]
) -> tuple[list[StudyRubber], Measurement | None]:
    """Read materials and measurement of a study."""
    conditions, table = study.conditions, study.measurement
    curves = None if table is None else stage("measurement", lambda: read_measurement(table))
    rubbers: list[StudyRubber] = stage(
        "material",
        lambda: [StudyRubber.of(one, study.applied_uncertainty, conditions.temperature) for one in study.materials],
    )
    if curves is None:
        return rubbers, None
    first: Any = study.sweep().cases[0]  # of a ball, as it is measured
    load = float(conditions.load[0])
    return rubbers, stage("shift", lambda: Measurement(curves, rubbers[0].material, first.indenter, load))


def _damage(labels: Sequence[str], finished_only: bool) -> list[str]:
    """Return a note about damaged stored contacts."""
    if not labels:
        return []
    many = (
        f"{len(labels)} stored contacts were damaged (they do"
        if len(labels) > 1
        else "1 stored contact was damaged (it does"
    )
    shown = "; ".join(labels[:_MOST_LABELS]) + ("; …" if len(labels) > _MOST_LABELS else "")
    done = "counted as not solved" if finished_only else "solved again"
    return [Note("damaged-cases", f"{many} not match the checksum) and {done}: {shown}.")]


def tree_of(
    contacts: Contacts,
    doubtful: Iterable[str] = (),
    singles: Sequence[Singles] = (),
    interface: StudyInterface | None = None,
    reader: Reader = "run_file",
) -> DataTree:
    """Return all results of a study from its contacts, whose plan has run; raise `StudyError` if no case was solved.

    Checks have their sentences in the words of a `reader`; notes have those of all.
    """
    import xarray

    study, rubbers, measured = contacts.study, contacts.rubbers, contacts.measured
    requested, at_points, along = contacts.results()
    failures = list(dict.fromkeys(one.note for part in (requested, at_points, along) for one in part.failures))
    failures += [note for one in singles for note in one.failures]
    if not requested.records:
        raise nothing_solved(failures[0])
    groups, about = material_groups(
        [rubber_groups(one.rubber, one.bands.samples) for one in rubbers], [one.rubber.attributes for one in rubbers]
    )

    def within(part: Solved) -> list[bool] | None:
        return all_within(rubbers, part.of_records, part.records)

    interface = study_interface(contacts) if interface is None else interface
    rubbed = interface_columns(contacts, interface, requested)
    groups |= interface.groups
    groups["/prediction"] = prediction(
        contacts.sweep,
        requested.outcomes,
        within=within(requested),
        curves=band_columns(rubbers, requested.of_records, requested.records),
        interface=rubbed.columns,
    )
    groups |= field_groups(contacts.sweep, requested.outcomes)
    if along.records:
        curves = rubbers[0].bands.curves(along.records)
        groups["/prediction_master"] = master_prediction(along.records, along.cases[0].geometry, within(along), curves)
        if measured is not None:
            points: list[Any] = [None if isinstance(one, Failure) else one for one in at_points.outcomes]
            inside = all_within(rubbers, at_points.cases, points)
            groups |= measured.groups(points, inside, curves, rubbers[0].bands)
    for one in singles:
        groups |= one.groups()
    checked = assumption_checks(contacts, requested, at_points, interface.law)
    groups |= assumptions(checked, reader)
    tree = xarray.DataTree.from_dict(groups)
    of_friction = [*(measured.notes if measured else ()), *interface.notes, *rubbed.notes]
    if study.heating is not None and study.interface is not None and interface.law is None:
        of_friction.append(NO_LAW)
    of_friction += material_notes(study, contacts.plan.rubbers.materials)
    if study.surface is not None:
        first: Any = contacts.sweep.cases[0]
        of_friction += notes_on(first.surface)
    notes = [note for one in rubbers for note in _named(one, one.notes, rubbers)]
    said = [words for one in rubbers for words in _named(one, one.doubts(study.conditions.temperature), rubbers)]
    tree.attrs = {
        "title": study.title,
        "data_origin": _origin(study, rubbers),
        **{name: text for name in DESCRIBED if (text := getattr(study, name))},
        "notes": _listed([*notes, *study.notes, *of_friction]),
        "warnings": _listed(
            [
                *doubtful,
                *said,
                *doubts((requested, at_points, along), rubbers),
                *assumption_warnings(checked),
                *missed_accuracy(requested, study)[1],
                *(note for one in singles for note in one.warnings),
            ]
        ),
        "failures": _listed(failures),
        **about,
        **setting(study, contacts.sweep, rubbers),
    }
    return tree


def _origin(study: Study, rubbers: Sequence[StudyRubber]) -> str:
    """Return the origin of the data; a material or a file that calls itself synthetic is so whatever the study says."""
    made_up = any(one.rubber.synthetic for one in rubbers) or any(map(says_synthetic, study.inputs))
    return "synthetic" if made_up else study.data_origin


def _named(one: StudyRubber, sentences: Iterable[str], rubbers: Sequence[StudyRubber]) -> list[Note]:
    """Return notes with the name of their material if there are several."""
    name = one.material.name if len(rubbers) > 1 else ""
    return [note_of(sentence).at(name) for sentence in sentences]


def _listed(sentences: Iterable[str]) -> str:
    return dumped(records(sentences))
