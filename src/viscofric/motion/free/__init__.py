"""Free contacts in motion, on cells that are fixed to the body."""
