"""What the first jobs of a process would wait for, done before there is one."""

from viscofric import units
from viscofric.web.jobs import contact, curve

units.registry()  # a second of reading all units there are

__all__ = ["contact", "curve"]
