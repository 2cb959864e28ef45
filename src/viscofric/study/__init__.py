"""Studies: a run file in, every case solved and stored as it is solved, labelled results out."""

from viscofric.lazy import loaded_when_used

__getattr__, __dir__, __all__ = loaded_when_used(__name__)
