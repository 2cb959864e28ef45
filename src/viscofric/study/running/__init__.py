"""Running a plan so that nothing is lost: in this process, in several, or on the machines of a cluster."""
