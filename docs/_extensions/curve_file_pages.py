"""The columns of files of friction curves as Markdown, as their reader and writer know them."""

from __future__ import annotations

from page_parts import cell, table

from viscofric.friction.curve_files import COLUMNS


def page() -> str:
    """Return a row for each column."""
    rows = []
    for unit_inside, heading, others in COLUMNS.values():
        unit = "degC" if unit_inside == "K" else unit_inside  # temperatures are written so, and read in either
        written = f"{heading} ({unit})" if unit else heading
        rows.append([f"`{written}`", ", ".join(f"`{other}`" for other in others), cell(unit) or "1"])
    return table(["heading", "other headings", "unit"], rows, numbers=False)
