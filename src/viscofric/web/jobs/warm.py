"""What the first job of a process would wait for, done before there is one; a process imports it when it is idle."""

import xarray

from viscofric import units
from viscofric.web.jobs import contact, curve, rubber, sweeps

units.registry()  # a second of reading all units there are

__all__ = ["contact", "curve", "rubber", "sweeps", "xarray"]
