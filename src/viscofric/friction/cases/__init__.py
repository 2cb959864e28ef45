"""Contacts to be solved, their similarity and their results: cases of predictions and studies."""
