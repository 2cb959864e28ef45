"""Figures: functions on an Axes, and whole figures."""
