"""Texts of the report and of the commands: numbers, tables, checks, lines and records."""
