from viscofric.study.results.compare import ResultsComparison as ResultsComparison
from viscofric.study.results.results import StudyResults as StudyResults
from viscofric.study.run_file.study import Study as Study
