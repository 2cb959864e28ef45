"""The papers behind each result: references, the references of a result, and their output."""
