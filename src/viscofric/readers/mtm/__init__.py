"""Traction runs of tribometers: formats recognised by content, readings with signed speeds and forces."""
