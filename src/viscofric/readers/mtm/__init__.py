"""Traction runs of tribometers: formats told by content, readings with signed speeds and forces."""
