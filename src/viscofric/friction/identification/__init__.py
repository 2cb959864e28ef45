"""The rubber read back from its friction."""
