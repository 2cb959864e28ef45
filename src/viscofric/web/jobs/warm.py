"""What the first jobs of a process would wait for, done before there is one."""

import contourpy
from scipy import optimize

from viscofric import units
from viscofric.web.jobs import contact, curve

units.registry()  # a second of reading all units there are

__all__ = ["contact", "contourpy", "curve", "optimize"]
