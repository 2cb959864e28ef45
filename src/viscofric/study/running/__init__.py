"""Running a plan so that nothing is lost: in this process, in several, or on the machines of a cluster."""

from viscofric.study.running.choice import choose_executor as choose_executor
from viscofric.study.running.events import Event as Event
from viscofric.study.running.events import Progress as Progress
from viscofric.study.running.events import silent as silent
from viscofric.study.running.executors import Executor as Executor
from viscofric.study.running.executors import Processes as Processes
from viscofric.study.running.executors import Serial as Serial
from viscofric.study.running.folder import study_folder as study_folder
from viscofric.study.running.running import run_plan as run_plan
