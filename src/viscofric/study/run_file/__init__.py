"""The run file: its tables, validated, and its errors."""
