"""Frequency sweeps of dynamic mechanical analysers and rheometers: formats recognised by content, points sorted."""
