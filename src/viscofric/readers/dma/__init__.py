"""Frequency sweeps of dynamic mechanical analysers and rheometers: formats told by content, points made isotherms."""
