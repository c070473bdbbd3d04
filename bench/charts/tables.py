#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Prints what the benchmarks measured as the tables of bench/RESULTS.md: tables.py [--results DIR] [--into FILE] [GROUP ...].

A cell is the time per query of each shape, in ns; `!` marks answers that are wrong, missing, or off by more than their method
states. Rows are sorted by their first cell, ours first. With --into the file's lines between `<!-- GROUP -->` and
`<!-- end of GROUP -->` are replaced.
"""
import argparse
import contextlib
import io
import statistics
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


MESH_QUESTIONS = {"intersects": "intersects", "within0.8": "within 0.8 d", "within1.25": "within 1.25 d", "distance10%": "distance to 10 %",
                  "distance1%": "to 1 %", "distance": "exact"}


def digits(value):
    """Three of them, without an exponent."""
    return f"{value:.0f}" if value >= 100 else f"{value:#.3g}".rstrip(".")


def microseconds(row):
    return digits(row["ns"] / 1000) + ("!" if row["flagged"] else "")


def mesh(rows):
    """Ours and the fastest other, whoever that is; below, how many times as long all that others do takes. Then contacts and
    depths, and what bodies take."""
    at = {(row["scene"], row["question"], row["series"]): row for row in rows}
    scenes = list(dict.fromkeys(row["scene"] for row in rows if row["question"] == "intersects"))
    series_but_ours = [series for series in dict.fromkeys(row["series"] for row in rows) if series != "swiftlet"]
    others = [series for series in series_but_ours if not series.startswith("swiftlet")]
    print("\n| us: ours / fastest other | " + " | ".join(MESH_QUESTIONS.values()) + " |")
    print("|---" * (len(MESH_QUESTIONS) + 1) + "|")
    for scene in scenes:
        cells = []
        for question in MESH_QUESTIONS:
            fastest = min((at[scene, question, other] for other in others if (scene, question, other) in at), key=lambda row: row["ns"], default=None)
            cells.append(f"{microseconds(at[scene, question, 'swiftlet'])} / {microseconds(fastest) if fastest else '-'}")
        print(f"| {scene} | " + " | ".join(cells) + " |")
    for other in series_but_ours:
        cells = []
        for question in MESH_QUESTIONS:
            gains = sorted(at[scene, question, other]["ns"] / at[scene, question, "swiftlet"]["ns"] for scene in scenes
                           if (scene, question, other) in at)
            cells.append(f"{digits(statistics.median(gains))} ({digits(gains[0])} to {digits(gains[-1])})" if gains else "")
        print(f"| *median of {other} over ours (least to most)* | " + " | ".join(cells) + " |")
    mesh_contacts(at, others)
    print("\n| a triangle | bytes | us to build |\n|---|---|---|")
    for series in ["swiftlet"] + series_but_ours:
        of = [row for row in rows if row["series"] == series and row["question"] == "intersects"]
        print(f"| {series} | {statistics.median(row['bytes'] for row in of):.0f} | {statistics.median(row['build_us'] for row in of):.1f} |")


def mesh_contacts(at, others):
    """Contacts within reach of near bodies and of those that overlap; then depths."""
    deep = list(dict.fromkeys(scene for scene, question, _ in at if question == "signed"))
    scenes = list(dict.fromkeys(scene for scene, question, _ in at if question == "contacts"))
    print("\n| contacts: us (how many) | regions, ours | with manifolds: points | " + " | ".join(others_of := [
        other for other in others if any((scene, "contacts", other) in at for scene in scenes)]) + " |")
    print("|---" * (len(others_of) + 3) + "|")
    for scene in scenes:
        cells = [at.get((scene, "contacts", "swiftlet")), at.get((scene, "manifolds", "swiftlet"))]
        cells += [at.get((scene, "contacts", other)) for other in others_of]
        print(f"| {scene} | " + " | ".join(f"{microseconds(row)} ({row['found']:g})" if row else "" for row in cells) + " |")
    print("\n| signed distance | us | without hulls | width of the interval over the depth |\n|---|---|---|---|")
    for scene in deep:
        if (scene, "signed", "swiftlet") in at:
            ours = at[scene, "signed", "swiftlet"]
            print(f"| {scene} | {microseconds(ours)} | {microseconds(at[scene, 'signed', 'swiftlet boxes'])} | {ours['found']:.2g} |")


# Milliseconds at 450 MHz [Ehmann & Lin 2001, tables 1 and 2], by our names of scenes and of ways.
PAPER_SCENES = ["tori", "cup-spoon", "peg-large-ring", "peg-small-ring", "teeth-shifting", "teeth-opening"]
PAPER = {
    "intersects": {
        "CH": [1.510, 0.840, 9.865, 1.410, 43.42, 14.32],
        "CH(FT)": [0.696, 0.505, 3.505, 0.966, 0.177, 4.190],
        "OBBs (RAPID)": [2.711, 0.8761, 0.276, 0.459, 0.514, 0.841],
    },
    "distance": {
        "CH": [4.424, 1.728, 11.81, 2.720, 54.73, 20.23],
        "CH(PC)": [2.452, 1.234, 10.99, 1.910, 11.53, 10.43],
        "CH(PD)": [2.562, 1.284, 11.88, 2.009, 7.152, 9.937],
        "CH(FT)": [2.414, 1.058, 4.938, 1.572, 0.184, 7.980],
        "CH(PC+PD)": [2.498, 1.266, 11.78, 1.969, 1.466, 9.285],
        "CH(PC+FT)": [2.444, 1.070, 4.975, 1.599, 0.114, 8.090],
        "CH(PD+FT)": [1.602, 0.923, 5.105, 1.513, 5.529, 7.740],
        "CH(PC+PD+FT)": [1.612, 0.919, 5.113, 1.526, 5.653, 7.957],
        "spheres swept (PQP)": [7.492, 3.814, 34.91, 36.61, 0.604, 1.733],
    },
}


def layer(rows):
    """SWIFT++'s tables 1 and 2: today's microseconds, and the paper's milliseconds in brackets."""
    at = {(row["scene"], row["question"], row["series"]): row for row in rows}
    series = list(dict.fromkeys(row["series"] for row in rows))
    more = [scene for scene in dict.fromkeys(row["scene"] for row in rows) if scene not in PAPER_SCENES]
    for question, title in {"intersects": "intersection", "distance10%": "distance to 10 %", "distance": "exact distance"}.items():
        paper = PAPER.get(question, {})
        for scenes, heading in ((PAPER_SCENES, f"{title}, us (ms in 2001)"), (more, f"{title}, us")):
            print(f"\n| {heading} | " + " | ".join(scenes) + " |")
            print("|---" * (len(scenes) + 1) + "|")
            for name in series + [name for name in paper if name not in series and scenes is PAPER_SCENES]:
                cells = []
                for i, scene in enumerate(scenes):
                    now = microseconds(at[scene, question, name]) if (scene, question, name) in at else ""
                    then = f"({paper[name][i]:g})" if scenes is PAPER_SCENES and name in paper else ""
                    cells.append(" ".join(word for word in (now, then) if word))
                if any(cells):
                    print(f"| {name} | " + " | ".join(cells) + " |")
    print("\n| a triangle | bytes | us to build |\n|---|---|---|")
    for name in ["swiftlet", "CH", "fcl", "cgal"]:
        of = [row for row in rows if row["series"] == name and row["question"] == "intersects"]
        if of:
            print(f"| {name} | {statistics.median(row['bytes'] for row in of):.0f} | {statistics.median(row['build_us'] for row in of):.1f} |")


GROUPS = {"orbit": orbit, "goals": goals, "depth": depth, "manifold": manifold, "mesh": mesh, "layer": layer}


def write_into(path, group, text):
    before, begin, rest = path.read_text().partition(f"<!-- {group} -->\n")
    old, end, after = rest.partition(f"<!-- end of {group} -->")
    if not end:
        sys.exit(f"{path} has no place for {group}")
    path.write_text(before + begin + text.lstrip("\n") + end + after)


def main():
    parser = argparse.ArgumentParser(description="Prints what the benchmarks measured as tables.")
    parser.add_argument("groups", nargs="*", metavar="GROUP", help="which: " + " ".join(GROUPS) + "; all that were measured")
    parser.add_argument("--results", type=Path, default=Path(__file__).resolve().parent.parent / "results")
    parser.add_argument("--into", type=Path, metavar="FILE", help="write them there, each in its place")
    options = parser.parse_args()
    for group in options.groups:
        if group not in GROUPS:
            parser.error(f"no table of {group}; there are {' '.join(GROUPS)}")
    missing = [group for group in options.groups or GROUPS if not (options.results / f"{group}.csv").is_file()]
    for group in options.groups or GROUPS:
        if group not in missing:
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                GROUPS[group](charts.rows(options.results, group))
            if options.into:
                write_into(options.into, group, printed.getvalue())
            else:
                print(printed.getvalue(), end="")
    if missing:
        print("not measured yet:", " ".join(missing), file=sys.stderr)
    return 1 if missing and options.groups else 0


if __name__ == "__main__":
    sys.exit(main())
