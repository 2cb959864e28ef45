"""Studies: a run file in, every case solved and stored as it is solved, labelled results out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from viscofric.lazy import loaded_when_used

if TYPE_CHECKING:
    from viscofric.study.execution import run_study as run_study
    from viscofric.study.results.compare import ResultsComparison as ResultsComparison
    from viscofric.study.results.results import StudyResults as StudyResults
    from viscofric.study.results.results import compare_results as compare_results
    from viscofric.study.results.results import open_results as open_results
    from viscofric.study.run_file.study import Study as Study
    from viscofric.study.run_file.study import load_study as load_study

# public name -> the module that defines it
_HOME = {
    "ResultsComparison": "viscofric.study.results.compare",
    "compare_results": "viscofric.study.results.results",
    "run_study": "viscofric.study.execution",
    "StudyResults": "viscofric.study.results.results",
    "open_results": "viscofric.study.results.results",
    "Study": "viscofric.study.run_file.study",
    "load_study": "viscofric.study.run_file.study",
}

__all__ = [*_HOME]  # noqa: PLE0604
__getattr__ = loaded_when_used(__name__, _HOME)
