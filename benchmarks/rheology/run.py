"""viscofric's rheology beside its peers, on the same data and in the same run.

Usage: python benchmarks/rheology/run.py [--peers] [--seeds N] [--edges N [--friction]] [--offsets N] [--steps N]
       [--first N] [--only TEXT] [--json FILE] [--environment FOLDER] [--limit SECONDS]

Shifting of measured and of planted sweeps, spectra of the master curve, honesty of the stated 95 % bands over many
planted sweeps, exactness of the conversion of spectra.  README.md beside this file says how each is measured.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path
from typing import Any

os.environ.update(OPENBLAS_NUM_THREADS="1", VISCOFRIC_FFT_THREADS="1")
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import cases  # noqa: E402
import others  # noqa: E402
import own  # noqa: E402

import viscofric as vf  # noqa: E402

#: Heading of a column, its key in a row, its format.
SHIFTING = (
    ("CPU s", "seconds", ".3f"),
    ("± given", "uncertainty", ""),
    ("points", "points", "d"),
    ("rms E'", "storage", ".4f"),
    ("rms E''", "loss", ".4f"),
    ("joint", "joint", ".4f"),
    ("α error", "error", ".4f"),
    ("C1", "C1", ".3f"),
    ("C2 (K)", "C2", ".2f"),
)
SPECTRUM = (
    ("CPU s", "seconds", ".4f"),
    ("modes", "modes", "d"),
    ("rms E'", "storage", ".4f"),
    ("rms E''", "loss", ".4f"),
)
COVERAGE = (
    ("CPU s", "seconds", ".2f"),
    ("seeds", "seeds", "d"),
    ("α(T)", "alpha", ".1%"),
    ("E'(ω)", "storage", ".1%"),
    ("E''(ω)", "loss", ".1%"),
)
OFFSETS = (
    ("CPU s", "seconds", ".2f"),
    ("seeds", "seeds", "d"),
    ("α(T)", "alpha", ".1%"),
    ("± α", "alpha_error", ".4f"),
    ("E'(ω)", "storage", ".1%"),
    ("E''(ω)", "loss", ".1%"),
    ("± E''", "loss_width", ".2%"),
    ("tan δ ends", "tangent", ".1%"),
    ("μ ends", "friction", ".1%"),
    ("doubtful", "doubtful", "d"),
)
STEPS = (
    ("CPU s", "seconds", ".2f"),
    ("seeds", "seeds", "d"),
    ("α(T)", "alpha", ".1%"),
    ("± α", "alpha_error", ".4f"),
    ("J, E(t)", "response", ".1%"),
    ("E'(ω)", "storage", ".1%"),
    ("E''(ω)", "loss", ".1%"),
    ("doubtful", "doubtful", "d"),
)
EDGES = (
    ("CPU s", "seconds", ".2f"),
    ("seeds", "seeds", "d"),
    ("strayed", "strayed", ".2%"),
    *((zone, zone, ".0%") for zone in own.ZONES),
    *((f"± {zone}", f"{zone}_width", ".3f") for zone in own.ZONES),
)
ROUND_TRIP = (("CPU s", "seconds", ".4f"), ("modes", "modes", "d"), ("error", "error", ".1e"))


def measure(options: argparse.Namespace) -> dict[str, Any]:
    """Measure everything; return the rows of each table, and what was left out."""
    tables: dict[str, list[dict[str, Any]]] = {}
    left_out = []
    found = cases.measured_case()
    given = [cases.planted_case()]
    if isinstance(found, str):
        left_out.append(found)
    else:
        given.insert(0, found)
    for case in given:
        rows = [own.shifting(case)]
        if options.peers:
            rows += [others.shifting(tool, case, options.environment, options.limit) for tool in others.SHIFTERS]
        tables[f"shifting: {case.name}"] = rows
    curve = vf.superpose(given[0].sweeps, given[0].reference).master_curve
    rows = [own.spectrum(curve, name) for name in own.SPECTRA]
    if options.peers:
        rows += [others.spectrum(tool, curve, options.environment, options.limit) for tool in others.FITTERS]
    tables[f"spectrum: {given[0].name}"] = rows

    def seeds(count: int) -> range:
        return range(options.first, options.first + count)

    if options.seeds:
        tables["planted truth within the stated 95 % bands"] = [
            own.coverage(material, seeds(options.seeds)) for material in cases.MATERIALS
        ]
    if options.edges:
        tables["edges: planted truth within the stated 95 % bands, by distance from the measured range"] = [
            row
            for problem in cases.edge_problems()
            if options.only in problem["title"]
            for row in own.edges(problem, seeds(options.edges), options.friction)
        ]
    if options.offsets:
        tables["offsets of isotherms: planted truth within the stated 95 % bands"] = [
            own.with_offsets(problem, seeds(options.offsets))
            for problem in cases.offset_problems()
            if options.only in problem["title"]
        ]
    if options.steps:
        tables["step tests: planted truth within the stated 95 % bands"] = [
            own.steps(problem, seeds(options.steps))
            for problem in cases.step_problems()
            if options.only in problem["title"]
        ]
    tables["retardation spectrum to Prony series and back"] = [own.round_trip()]
    return {"tables": tables, "left_out": left_out}


def columns_of(title: str) -> tuple[tuple[str, str, str], ...]:
    """Return the columns of a table."""
    kinds = {
        "shifting": SHIFTING,
        "spectrum": SPECTRUM,
        "planted": COVERAGE,
        "edges": EDGES,
        "offsets": OFFSETS,
        "step tests": STEPS,
        "retardation": ROUND_TRIP,
    }
    return next(columns for start, columns in kinds.items() if title.startswith(start))


def print_table(title: str, rows: list[dict[str, Any]]) -> None:
    columns = [column for column in columns_of(title) if any(column[1] in row for row in rows)]
    print(f"\n{title}")
    print(f"{'':38}" + "".join(f"{heading:>10}" for heading, _, _ in columns))
    for row in rows:
        if "error" in row and isinstance(row["error"], str):
            print(f"{row['tool']:38}  {row['error']}")
            continue
        print(f"{row['tool']:38}" + "".join(f"{shown(row.get(key), form):>10}" for _, key, form in columns))
        if "law" in row:
            print(f"{'':38}  {row['law']}")


def shown(value: Any, form: str) -> str:
    """Return a cell's text."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return format(value, form)


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--peers", action="store_true", help="run the peers too (minutes)")
    parser.add_argument("--seeds", type=int, default=20, help="planted sweeps for the bands; 0 leaves them out")
    parser.add_argument(
        "--edges", type=int, default=0, help="sweeps of each family of random rubbers (a minute for 20)"
    )
    parser.add_argument("--friction", action="store_true", help="with --edges: friction too (ten times as long)")
    parser.add_argument("--offsets", type=int, default=0, help="planted sweeps with offsets of isotherms (minutes)")
    parser.add_argument("--steps", type=int, default=0, help="planted creep and relaxation tests (minutes)")
    parser.add_argument("--first", type=int, default=0, help="first seed: others than those a method was set with")
    parser.add_argument("--only", default="", metavar="TEXT", help="of these, problems whose title holds a text")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--environment", type=Path, default=HERE / ".peers", help="the peers' environment")
    parser.add_argument("--limit", type=float, default=300.0, help="seconds for each answer of a peer")
    options = parser.parse_args(arguments)
    results = measure(options)
    for title, rows in results["tables"].items():
        print_table(title, rows)
    for reason in results["left_out"]:
        print(f"\nleft out: {reason}")
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        options.json.write_text(json.dumps(results, indent=1, ensure_ascii=False), encoding="utf-8")


if __name__ == "__main__":
    main()
