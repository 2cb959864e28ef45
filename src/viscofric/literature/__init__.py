"""Which papers a result rests on: the references, which of them a result needs, and how they are printed."""
