"""Studies: a run file in, every case solved and stored as it is solved, labelled results out."""

from viscofric.study.compare import ResultsComparison as ResultsComparison
from viscofric.study.compare import compare_results as compare_results
from viscofric.study.execution import run_study as run_study
from viscofric.study.results import StudyResults as StudyResults
from viscofric.study.results import open_results as open_results
from viscofric.study.run_file import Study as Study
from viscofric.study.run_file import load_study as load_study
