"""Pressure to displacement on a whole grid of cells."""
