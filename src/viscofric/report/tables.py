"""The report's tables: those of friction, and those of the rubber."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from viscofric.report.friction_tables import friction_shift_table, measurement_table, prediction_table
from viscofric.report.house_style import degrees
from viscofric.report.results import group, rubbers
from viscofric.report.results import table as texts
from viscofric.report.table import Column, Table, made_table, times

if TYPE_CHECKING:
    import xarray as xr


def _shift_factor_table(tree: xr.DataTree) -> Table | None:
    factors = group(tree, "shift_factors")
    if factors is None:
        return None
    columns = [
        Column("temperature", "temperature", degrees),
        Column("log₁₀ α", "log10_shift_factor", times(1.0)),
        Column("standard error", "standard_error", times(1.0, 2)),
        Column("α", "alpha", times(1.0)),
        Column("log₁₀ b", "log10_vertical_shift", times(1.0)),
        Column("standard error of log₁₀ b", "vertical_standard_error", times(1.0, 2)),
    ]
    full = factors.assign(alpha=10.0 ** factors["log10_shift_factor"])
    return made_table("shift-factors", "Shift factors of the isotherms.", full, columns, is_open=False)


def _law_table(tree: xr.DataTree) -> Table | None:
    laws = group(tree, "laws")
    if laws is None:
        return None
    columns = [
        Column("law", "law", str),
        Column("constants", "constants", str),
        Column("AIC above the lowest", "information_criterion", times(1.0, 3)),
        Column("weight", "akaike_weight", times(1.0, 2)),
        Column("scatter beyond the errors (decades)", "law_scatter", times(1.0, 2)),
    ]
    refused = "".join(f" {title}: {reason}" for title, reason in texts(laws.attrs, "refused").items())
    note = f"{laws.attrs.get('explanation', '')}{refused}".strip()
    return made_table("laws", "Shift laws fitted to the shift factors, compared by AIC.", laws, columns, False, note)


def _spectrum_table(tree: xr.DataTree) -> Table | None:
    spectrum = group(tree, "spectrum")
    if spectrum is None:
        return None
    columns = [
        Column("retardation time τ (s)", "retardation_time", times(1.0)),
        Column("creep coefficient C (1/GPa)", "creep_coefficient", times(1e9)),
    ]
    caption = "Retardation spectrum at the reference temperature: 1/E(ω) = 1/E∞ + Σ C/(1 + iωτ)."
    return made_table("spectrum", caption, spectrum, columns, is_open=False)


def detail_tables(tree: xr.DataTree) -> list[Table]:
    """Return the full tables that the results afford."""
    found = [
        prediction_table(tree, "prediction", "prediction", "Friction predicted for each case.", True),
        measurement_table(tree),
        *_master_and_rubber(tree),
    ]
    for place, (rubber, branch) in enumerate(rubbers(tree), 1):
        found += [
            replace(table, key=f"{table.key}-{place}", caption=f"{rubber}. {table.caption}")
            for table in _master_and_rubber(branch)
            if table is not None
        ]
    return [table for table in found if table is not None]


def _master_and_rubber(tree: xr.DataTree) -> list[Table | None]:
    return [
        prediction_table(
            tree,
            "prediction_master",
            "prediction-master",
            "Friction predicted against the reduced speed, at the reference temperature.",
            False,
        ),
        friction_shift_table(tree),
        _shift_factor_table(tree),
        _law_table(tree),
        _spectrum_table(tree),
    ]
