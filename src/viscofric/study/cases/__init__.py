"""Contacts that a study asks for: what all have in common, those of an indenter, and those of a rough surface."""
