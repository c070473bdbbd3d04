#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prints what the benchmarks measured as the tables of bench/RESULTS.md: tables.py [--results DIR] [GROUP ...].

A cell is the time per query of each shape, in ns; `!` marks answers that are wrong, missing, or off by more than their method
states. Rows are sorted by their first cell, ours first.
"""
import argparse
import sys
from pathlib import Path

import charts


def turn(step):
    return {0: "same pose", charts.RANDOM: "random"}.get(step, f"{step:g} deg")


def cell(rows):
    return " / ".join(f"{row['ns']:.0f}" + ("!" if row["flagged"] else "") for row in rows)


def table(title, rows, key, keys):
    """Series by `key`, whose values are `keys`: (value, heading)."""
    print(f"\n| {title} | " + " | ".join(heading for _, heading in keys) + " |")
    print("|---" * (len(keys) + 1) + "|")
    series = sorted(dict.fromkeys(row["series"] for row in rows),
                    key=lambda name: (not name.startswith("swiftlet"), next(row["ns"] for row in rows if row["series"] == name)))
    for name in series:
        cells = [cell(row for row in rows if row["series"] == name and row[key] == value) for value, _ in keys]
        print(f"| {name} | " + " | ".join(cells) + " |")


def by_turn(title, rows):
    steps = sorted(dict.fromkeys(row["step"] for row in rows))
    table(title, rows, "step", [(step, turn(step)) for step in steps])


def orbit(rows):
    by_turn("exact distance", [row for row in rows if row["question"] == "distance"])
    by_turn("intersection", [row for row in rows if row["question"] == "intersects"])


def depth(rows):
    by_turn("0.01 of the shortest semi-axis deep", [row for row in rows if row["shape"] == "shallow"])
    by_turn("0.3 deep", [row for row in rows if row["shape"] == "deep"])


def manifold(rows):
    cells = [(shape, shape) for shape in dict.fromkeys(row["shape"] for row in rows)]
    table("contact manifold", rows, "shape", cells)


def goals(rows):
    """Ours, and of the baselines the fastest of each cell, which proves nothing."""
    kinds = {"": "exact distance", "/float32": "exact distance, poses in float32", "/overlapping": "verdict, overlapping"}
    for size in sorted(dict.fromkeys(row["triangles"] for row in rows)):
        for end, kind in kinds.items():
            chosen = [row for row in rows if row["triangles"] == size and row["scene"].endswith(end)
                      and (end or not row["scene"].endswith(tuple(kinds)[1:]))]
            fastest = {}
            for row in chosen:
                place = row["shape"], row["step"]
                if row["series"] != "swiftlet" and (place not in fastest or row["ns"] < fastest[place]["ns"]):
                    fastest[place] = row
            if chosen:
                by_turn(f"{size:.0f} triangles, {kind}", [row for row in chosen if row["series"] == "swiftlet"]
                        + [dict(row, series="the fastest baseline, unproved") for row in fastest.values()])


GROUPS = {"orbit": orbit, "goals": goals, "depth": depth, "manifold": manifold}


def main():
    parser = argparse.ArgumentParser(description="Prints what the benchmarks measured as tables.")
    parser.add_argument("groups", nargs="*", metavar="GROUP", help="which: " + " ".join(GROUPS) + "; all that were measured")
    parser.add_argument("--results", type=Path, default=Path(__file__).resolve().parent.parent / "results")
    options = parser.parse_args()
    for group in options.groups:
        if group not in GROUPS:
            parser.error(f"no table of {group}; there are {' '.join(GROUPS)}")
    missing = [group for group in options.groups or GROUPS if not (options.results / f"{group}.csv").is_file()]
    for group in options.groups or GROUPS:
        if group not in missing:
            GROUPS[group](charts.rows(options.results, group))
    if missing:
        print("not measured yet:", " ".join(missing), file=sys.stderr)
    return 1 if missing and options.groups else 0


if __name__ == "__main__":
    sys.exit(main())
