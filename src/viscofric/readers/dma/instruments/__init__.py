"""Exports of instruments, each in its own layout."""
