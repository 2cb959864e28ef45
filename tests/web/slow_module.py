"""A module that takes its time to be imported."""

import time

for _ in range(3_000):
    time.sleep(0.01)
