"""The contacts of a study: what all have in common, those of an indenter, and those of a rough surface."""
