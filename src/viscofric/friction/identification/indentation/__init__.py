"""Identification of the material from indentation over time."""
