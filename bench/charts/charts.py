#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what the benchmarks measured: charts.py [--results DIR] [--out DIR] [CHART ...].

Each chart reads one or two of the benchmark's CSV files; without names all are drawn whose files are there, and the others are
listed. One style for all: two hues (ours, others), names at the lines, filled marks where answers are proved and hollow ones
where they are not, the same axes in all panels of a chart, lower is better.
"""
import argparse
import csv
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)

PAPER, INK, TEXT, RULE, OURS = "#fbfaf7", "#16263c", "#3d4c60", "#dcdad3", "#e4572e"
# In turn, so that neighbours differ: others, and what of ours is not as shipped.
OTHERS, VARIANTS = ("#445874", "#7286a5"), ("#b8431f", "#ee9474")
PEERS = ("vclip", "plain", "fcl", "cgal", "bullet", "ccd", "libccd", "ode")
SHAPES = ("fat", "plate", "long")
# What a reader calls the methods; `bench/README.md` says what each is. "our support": the method's own loop on our hill climbing.
READABLE = {
    "vclip": "V-Clip", "plain": "our walk", "plain table": "our walk, table", "fcl indep": "FCL, own GJK",
    "fcl libccd": "FCL, libccd", "fcl libccd climb": "FCL, libccd, our support", "bullet": "Bullet", "bullet climb": "Bullet, our support",
    "bullet guess climb": "Bullet, with guess", "libccd mpr": "libccd MPR, our support", "libccd gjk": "libccd GJK, our support",
    "fcl": "FCL", "fcl node": "FCL, its traversal with triangle caching", "fcl native": "the same, for this machine", "cgal": "CGAL", "swiftlet boxes": "swiftlet without hulls", "ode": "ODE", "swiftlet ~0.1": "swiftlet, to 0.1 r", "swiftlet ~0.01": "swiftlet, to 0.01 r",
}
# Builds of the same method for this machine alone, and what of ours is not as shipped, only crowd a picture of everyone.
CROWD = (" native", " coarsest", " finest", " paper", " first", " single", " double", "swiftlet table")
RANDOM = 400  # the step that stands for random poses
EXACT = 1e-13  # where the charts show an error below it

plt.rcParams.update({
    "font.family": "sans-serif", "font.size": 10, "svg.fonttype": "none", "svg.hashsalt": "swiftlet", "text.color": INK,
    "axes.edgecolor": RULE, "axes.labelcolor": TEXT, "axes.titlesize": 11, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True, "axes.facecolor": PAPER,
    "figure.facecolor": PAPER, "figure.dpi": 100, "grid.color": RULE, "grid.linewidth": 0.7, "xtick.color": TEXT, "ytick.color": TEXT,
    "xtick.minor.size": 0, "ytick.minor.size": 0, "lines.linewidth": 1.3,
})


# ---- What was measured -------------------------------------------------------------------------------------------------------

def number(word):
    try:
        return float(word)
    except ValueError:
        return word


def rows(results, name):
    with open(results / f"{name}.csv", newline="") as file:
        return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(file)]


def names(table):
    """Series in the order of the file, ours last so that they are drawn above."""
    return sorted(dict.fromkeys(row["series"] for row in table), key=is_ours)


def is_ours(series):
    return not series.startswith(PEERS)


def base(series):
    """The method of a series that is swept over a tolerance."""
    return series.split(" ~")[0]


def readable(series):
    return READABLE.get(series, series)


def as_they_come(table):
    return [row for row in table if not base(row["series"]).endswith(CROWD)]


def mean(values):
    values = [v for v in values if v > 0]
    return math.exp(sum(map(math.log, values)) / len(values)) if values else math.nan


# ---- Style -------------------------------------------------------------------------------------------------------------------

def hue(series, place):
    if base(series) == "swiftlet":
        return OURS
    return (VARIANTS if is_ours(series) else OTHERS)[place % 2]


def look(series, place):
    colour = hue(series, place)
    return dict(color=colour, marker="o" if is_ours(series) else "sD^v<>ph"[place % 8], markersize=4.5, markeredgewidth=1.1,
                markerfacecolor=colour if is_ours(series) else PAPER, markeredgecolor=colour,
                linewidth=2.4 if series == "swiftlet" else 1.2, zorder=3 if is_ours(series) else 2)


def figure(title, columns=1, lines=1, width=10.0, height=4.4, names_take=0.0, note="lower is better · ● proved · ○ not proved",
           share=True):
    """Panels on the same axes, or those of a line on the same; `names_take` inches stay free at the right of each for the names
    of its lines."""
    fig, axes = plt.subplots(lines, columns, figsize=(width, height), sharex=share, sharey=share or "row", squeeze=False)
    fig.suptitle(title, x=0.012, y=0.985, ha="left", fontsize=13, fontweight="bold")
    fig.text(0.012, 1 - 0.40 / height, note, ha="left", va="top", color=TEXT, fontsize=9)
    fig.subplots_adjust(left=1.2 / width, right=1 - max(names_take, 0.15) / width, top=1 - 0.95 / height, bottom=0.62 / height,
                        wspace=max(names_take, 0.2) / ((width - 1.1) / columns - names_take), hspace=0.32)
    return fig, axes


def spread(wanted, apart):
    """Heights as near to the wanted ones as possible, at least so far apart; in the same order."""
    order = sorted(range(len(wanted)), key=lambda i: wanted[i])
    groups = []  # [sum of (wanted - offset), members]
    for i in order:
        groups.append([wanted[i], [i]])
        while len(groups) > 1:
            low, high = groups[-2], groups[-1]
            end = low[0] / len(low[1]) + apart * (len(low[1]) - 1)
            if end + apart <= high[0] / len(high[1]):
                break
            low[0] += high[0] - apart * len(low[1]) * len(high[1])
            low[1] += high[1]
            groups.pop()
    found = [0.0] * len(wanted)
    for total, members in groups:
        for k, i in enumerate(members):
            found[i] = total / len(members) + apart * k
    return found


def within(heights, apart, low, high):
    """Heights that `spread` found, moved as little as keeps them between low and high."""
    order = sorted(range(len(heights)), key=lambda i: heights[i])
    for i in order:
        heights[i] = low = max(heights[i], low)
        low += apart
    for i in reversed(order):
        heights[i] = high = min(heights[i], high)
        high -= apart
    return heights


def name_lines(ax, ends, left_of=None):
    """Writes names right of a panel at the heights where lines end, or left of the place `left_of`; ends: (x, y, name, colour)."""
    ends = [end for end in ends if end[1] > 0]
    if not ends:
        return
    ax.figure.canvas.draw()
    box = ax.get_window_extent()
    place = box.x1 + 14 if left_of is None else ax.transData.transform((left_of, 1))[0] - 16
    pixel = lambda x, y: ax.transData.transform((x, y))
    heights = within(spread([pixel(x, y)[1] for x, y, _, _ in ends], 12.5), 12.5, box.y0, box.y1)
    for (x, y, name, colour), height in zip(ends, heights):
        at = (place, height)
        ax.annotate(name, xy=(x, y), xycoords="data", xytext=ax.transAxes.inverted().transform(at), textcoords="axes fraction",
                    va="center", ha="left" if left_of is None else "right", fontsize=9, color=colour, fontweight="bold" if colour == OURS else "normal",
                    annotation_clip=False, arrowprops=dict(arrowstyle="-", relpos=(0 if left_of is None else 1, 0.5), linestyle=(0, (1, 3)), color=colour, linewidth=0.9, shrinkA=1, shrinkB=3))


def motion_axis(ax):
    ax.set_xscale("log")
    ax.set_xlim(0.4, 560)
    ax.set_xticks([1, 10, 45, RANDOM], ["1°", "10°", "45°", "random"], fontsize=9)


def time_axis(ax, label="ns per query"):
    ax.set_yscale("log")
    if label:
        ax.set_ylabel(label)
    ax.yaxis.set_major_formatter(lambda v, _: f"{v:,.0f}".replace(",", " ") if v >= 1 else f"{v:g}")
    ax.yaxis.set_minor_formatter(lambda *_: "")


# ---- Charts ------------------------------------------------------------------------------------------------------------------

def over_motion(table, title, asked, label=readable, what="ns", unit="ns per query"):
    """A panel per shape: the series over the motion per query."""
    fig, axes = figure(title, 3, width=11, height=4.6, names_take=1.95)
    for ax, shape in zip(axes[0], SHAPES):
        ax.set_title(shape)
        motion_axis(ax)
        time_axis(ax, unit if shape == SHAPES[0] else None)
        of_shape = [row for row in table if row["shape"] == shape and row["question"] == asked]
        for place, series in enumerate(names(of_shape)):
            line = sorted((row["step"], row[what]) for row in of_shape if row["series"] == series)
            ax.plot(*zip(*line), **look(series, place))
        ax.set_xlabel("turn per query")
    for ax, shape in zip(axes[0], SHAPES):
        of_shape = [row for row in table if row["shape"] == shape and row["question"] == asked]
        ends = []
        for place, series in enumerate(names(of_shape)):
            step, value = max((row["step"], row[what]) for row in of_shape if row["series"] == series)
            ends.append((step, value, label(series), hue(series, place)))
        name_lines(ax, ends)
    return fig


def orbit(kind):
    def draw(results):
        return over_motion(as_they_come(rows(results, "orbit")), {"distance": "Exact distance", "intersects": "Overlapping or not"}[kind] +
                           ", 2 000 triangles on an orbit", kind)
    return draw


def standing(results):
    shown = {"swiftlet", "swiftlet ~0.1", "vclip", "fcl libccd", "fcl libccd climb", "bullet climb", "bullet", "plain table"}
    table = [row for row in rows(results, "orbit") if row["series"] in shown]
    return over_motion(table, "Exact distance (ours also allowed 0.1 r), 2 000 triangles on an orbit", "distance")


def approximate(results):
    wanted = {("swiftlet", "intersects"): "overlap?", ("swiftlet", "distance"): "exact", ("swiftlet ~0.01", "distance"): "to 0.01 r",
              ("swiftlet ~0.1", "distance"): "to 0.1 r"}
    table = [dict(row, series="swiftlet " + wanted[row["series"], row["question"]], question="any")
             for row in rows(results, "orbit") if (row["series"], row["question"]) in wanted]
    return over_motion(table, "What is asked decides what it costs: overlap, approximate and exact distance", "any",
                       lambda series: series.removeprefix("swiftlet "))


def work(what, title):
    def draw(results):
        table = [row for row in rows(results, "orbit") if is_ours(row["series"]) or row["series"] in ("vclip", "plain")]
        return over_motion([row for row in table if row[what] > 0], title, "distance", what=what, unit="per query")
    return draw


def short(series):
    """A hierarchy's name where the title says its kind and start: cutoff or rate, and S, SS or DD for the refinement."""
    for long, brief in (("Double-Double", "DD"), ("Single-Single", "SS"), ("Single", "S"), ("DK ", ""), ("rate ", ""), (" ours", ""), (" paper", ", paper")):
        series = series.replace(long, brief)
    return series


def paper_figure(name, asked, title, keep=lambda series: True):
    def draw(results):
        table = [row for row in rows(results, name) if keep(row["series"])]
        levels = {row["series"]: int(row["levels"]) for row in table}
        label = lambda series: short(readable(series)) + (f" ({levels[series]})" if levels[series] > 1 else "")
        return over_motion(table, title, asked, label)
    return draw


def starts(whose):
    return lambda series: whose in series or series in ("swiftlet", "vclip")


def error(results):
    """Everyone at once: time against error, the geometric means over the three shapes."""
    table = [row for row in as_they_come(rows(results, "error")) if row["step"] < RANDOM]
    points = {}
    for series in names(table):
        of = [row for row in table if row["series"] == series]
        wrong = max(row["allowed" if is_ours(series) else "error"] for row in of)
        points[series] = (max(wrong, EXACT), mean(row["ns"] for row in of))
    kept_free = 1e-17  # the names of what is exact and nothing else stand between
    fig, axes = figure("Time against error: 2 000 triangles, 10° a query, mean of three shapes", width=8.6, height=5.0, names_take=1.9)
    ax = axes[0][0]
    ax.set_xscale("log")
    ax.set_xlim(kept_free, 2)
    ax.set_xticks([EXACT, 1e-9, 1e-6, 1e-4, 1e-2, 1], ["exact", "1e-9", "1e-6", "1e-4", "1e-2", "1"])
    ax.set_xlabel("error over the radius: proved bound (ours), largest one measured (others)")
    time_axis(ax)
    ours = {s: p for s, p in points.items() if base(s) == "swiftlet"}
    others = {s: p for s, p in points.items() if not is_ours(s)}
    shown = [t for _, t in (*ours.values(), *others.values())]
    low = 0.6 * min(shown)
    ax.set_ylim(low, 2 * max(shown))
    # Nobody else is as exact and as fast as any place in here.
    stairs, best = [], min(others.values())[1]
    for e, t in sorted(others.values()):
        stairs += [(e, best), (e, min(best, t))]
        best = min(best, t)
    xs, ys = [EXACT] + [e for e, _ in stairs] + [2], [stairs[0][1]] + [t for _, t in stairs] + [best]
    ax.fill_between(xs, ys, low, color=OURS, alpha=0.10, linewidth=0, zorder=1)
    ax.text(3e-12, low * 1.12, "as exact and as fast: nobody else", color=OURS, fontsize=10, fontweight="bold", va="bottom")
    line = sorted(ours.values())
    ax.plot(*zip(*line), **look("swiftlet", 0))
    methods = list(dict.fromkeys(base(s) for s in others))
    ends = [(*max(line), "swiftlet", OURS)]
    for place, method in enumerate(methods):
        swept = sorted(p for s, p in others.items() if base(s) == method)
        ax.plot(*zip(*swept), **dict(look(method, place), linewidth=0.8))
        ends.append((*swept[-1], readable(method), hue(method, place)))
    name_lines(ax, [end for end in ends if end[0] > EXACT])
    name_lines(ax, [end for end in ends if end[0] == EXACT], left_of=EXACT)
    return fig


def triangles(results):
    table = [row for row in as_they_come(rows(results, "triangles")) if row["question"] == "distance"]
    steps = [step for step in (10.4, RANDOM) if any(row["step"] == step for row in table)]
    fig, axes = figure("Exact distance against size", 3, len(steps), width=11, height=1.2 + 3.2 * len(steps), names_take=1.95)
    panels = [(ax, shape, step) for line, step in zip(axes, steps) for ax, shape in zip(line, SHAPES)]
    ends = []
    for ax, shape, step in panels:
        ax.set_title(f"{shape}, " + ("random poses" if step == RANDOM else f"{step:.0f}° a query"))
        ax.set_xscale("log")
        ax.set_xticks([200, 2_000, 20_000, 200_000], ["200", "2k", "20k", "200k"], fontsize=9)
        time_axis(ax, "ns per query" if shape == SHAPES[0] else None)
        if step == steps[-1]:
            ax.set_xlabel("triangles")
        of = [row for row in table if row["shape"] == shape and row["step"] == step]
        here = []
        for place, series in enumerate(names(of)):
            line = sorted((row["triangles"], row["ns"]) for row in of if row["series"] == series)
            ax.plot(*zip(*line), **look(series, place))
            here.append((*line[-1], readable(series), hue(series, place)))
        ends.append(here)
    for (ax, _, _), here in zip(panels, ends):
        name_lines(ax, here)
    return fig


def scenes(results):
    """Sorted bars, a panel per scene; who gave a wrong or no answer is marked."""
    table = [row for row in as_they_come(rows(results, "scenes")) if row["question"] == "distance"]
    shown = list(dict.fromkeys(row["shape"] for row in table))
    columns = min(4, len(shown))
    lines = math.ceil(len(shown) / columns)
    most = max(sum(row["shape"] == scene for row in table) for scene in shown)
    fig, axes = plt.subplots(lines, columns, figsize=(max(8.6, 3.3 * columns), 1.0 + lines * (0.55 + 0.2 * most)), squeeze=False, sharex=True)
    fig.suptitle("Exact distance in other scenes, 10° a query: ns per query", x=0.012, y=0.985, ha="left", fontsize=13,
                 fontweight="bold")
    fig.text(0.012, 1 - 0.42 / fig.get_figheight(), "lower is better · filled: proved · hollow: not proved · ! beyond its own error, or wrong",
             ha="left", va="top", color=TEXT, fontsize=9)
    for ax in axes.flat[len(shown):]:
        ax.set_axis_off()
    for ax, scene in zip(axes.flat, shown):
        of = sorted((row for row in table if row["shape"] == scene), key=lambda row: -row["ns"])
        for height, row in enumerate(of):
            ours = is_ours(row["series"])
            ax.barh(height, row["ns"], height=0.68, color=OURS if ours else PAPER, edgecolor=OURS if ours else OTHERS[0])
            ax.text(row["ns"] * 1.12, height, f"{row['ns']:,.0f}".replace(",", " ") + (" !" if row["flagged"] else ""), va="center",
                    fontsize=8, color=OURS if ours else TEXT)
        ax.set_yticks(range(len(of)), [readable(row["series"]) for row in of], fontsize=8)
        ax.set_ylim(-0.6, len(of) - 0.4)
        ax.set_title(scene)
        ax.set_xscale("log")
        ax.xaxis.set_major_formatter(lambda v, _: f"{v:,.0f}".replace(",", " "))
        ax.grid(axis="y", visible=False)
        ax.spines["left"].set_visible(False)
        ax.tick_params(axis="y", length=0)
    axes[0][0].set_xlim(min(row["ns"] for row in table) / 1.5, 8 * max(row["ns"] for row in table))
    fig.subplots_adjust(left=1.95 / fig.get_figwidth(), right=1 - 0.15 / fig.get_figwidth(), top=1 - 0.95 / fig.get_figheight(), bottom=0.35 / fig.get_figheight(), wspace=0.85, hspace=0.35)
    return fig


def precision(results):
    """Bytes, build time and query time against the error a model is cut for."""
    table, exact = rows(results, "precision"), 1e-4
    fig, axes = plt.subplots(1, 3, figsize=(11, 4.4))
    fig.suptitle("What precision costs: models cut and built for an error of the distance", x=0.012, y=0.985, ha="left", fontsize=13,
                 fontweight="bold")
    fig.text(0.012, 0.91, "lower is better", ha="left", va="top", color=TEXT, fontsize=9)
    shapes = list(dict.fromkeys(row["shape"] for row in table))
    for ax, what, title in zip(axes, ("bytes", "build_seconds", "ns"), ("bytes of a model", "seconds to build it", "ns per query")):
        ax.set_title(title)
        ax.set_xscale("log")
        ax.set_xlim(7e-5, 0.16)
        ax.set_xticks([exact, 1e-3, 1e-2, 1e-1], ["exact", "0.1 %", "1 %", "10 %"])
        ax.set_xlabel("error over the radius")
        time_axis(ax, None)
    fig.subplots_adjust(left=0.085, right=0.875, top=0.80, bottom=0.14, wspace=0.8)
    for ax, what in zip(axes, ("bytes", "build_seconds", "ns")):
        ends = []
        for place, shape in enumerate(shapes):
            line = sorted((row["tolerance"] or exact, row[what]) for row in table if row["shape"] == shape and row[what] > 0)
            if not line:
                continue
            colour = VARIANTS[place % 2]
            ax.plot(*zip(*line), color=colour, marker="o", markersize=3.5, linewidth=1.2)
            ends.append((*line[-1], shape, colour))
        name_lines(ax, ends)
    return fig


def links(results):
    table = rows(results, "links")
    fig, axes = figure("1 000 robot links, each against its neighbours, turning by 2° a frame", width=8.6, height=4.6, names_take=1.7)
    ax = axes[0][0]
    ax.set_xscale("log")
    ax.set_xlim(7e3, 3e6)
    ax.set_xticks([1e4, 1e5, 1e6], ["10 kB", "100 kB", "1 MB"])
    ax.set_xlabel("size of a link, were each a model of its own")
    time_axis(ax)
    ends = []
    for place, row in enumerate(table):
        ours = is_ours(row["method"])
        tolerance = ", exact" if ours and not row["tolerance"] else f", {100 * row['tolerance']:g} %" if ours else ""
        ax.plot(row["bytes_per_link"], row["ns"], **look(row["method"], place))
        ends.append((row["bytes_per_link"], row["ns"], readable(row["method"]) + tolerance, hue(row["method"], place)))
    name_lines(ax, ends)
    return fig


def stacks(results):
    """The share of towers that still stand, by time, and how far those that stand have moved."""
    table = [row for row in rows(results, "stack") if "tower" in row["scene"]]
    shapes = {"swiftlet": OURS, "Bullet's hulls": OTHERS[0], "Bullet's boxes": OTHERS[1]}
    towers = list(dict.fromkeys(row["scene"].split(" ")[0] for row in table))
    few, many = min(row["iterations"] for row in table), max(row["iterations"] for row in table)
    fig, axes = figure("Towers of ten prisms in Bullet", len(towers), 2, width=10.0, height=5.2, share=False,
                       note=f"above: how many still stand, {few:.0f} solver iterations · below: how far one has moved sideways "
                            f"after 20 s, {many:.0f} iterations, lower is better")
    fig.subplots_adjust(hspace=0.3, bottom=0.07)
    for column, tower in enumerate(towers):
        standing, moved = axes[0][column], axes[1][column]
        sides = int(tower.split("-")[0])
        standing.set_title("boxes" if sides == 4 else f"{sides} sides")
        for place, (shape, colour) in enumerate(shapes.items()):
            runs = [row for row in table if row["shapes"] == shape and row["scene"].startswith(tower)]
            wide = dict(color=colour, linewidth=2.4 if colour == OURS else 1.4, zorder=3 if colour == OURS else 2)
            first = [row for row in runs if row["iterations"] == few]
            if first:
                falls = sorted(row["stood"] / 60 for row in first if row["fell"])
                share = [100 * (1 - i / len(first)) for i in range(len(falls) + 1)]
                standing.step([0, *falls, first[0]["steps"] / 60], [*share, share[-1]], where="post", **wide)
            if column == 0:
                standing.text(0.5, 44 - 14 * place, shape, fontsize=8.5, color=colour, zorder=4,
                              fontweight="bold" if colour == OURS else "normal")
            drifts = [1000 * row["drift"] for row in runs if row["iterations"] == many and not row["fell"]]
            if drifts:
                spread_out = [place + 0.5 * (i / len(drifts) - 0.5) for i in range(len(drifts))]
                moved.plot(spread_out, drifts, "o", color=colour, markersize=3, alpha=0.6, markeredgewidth=0)
                middle = sorted(drifts)[len(drifts) // 2]
                moved.plot([place - 0.38, place + 0.38], [middle, middle], color=colour, linewidth=2.4)
        standing.set_ylim(-4, 104)
        standing.set_yticks([0, 50, 100], ["none", "half", "all"])
        standing.set_xlim(0, 20.5)
        standing.set_xticks([0, 10, 20], ["0", "10 s", "20 s"])
        moved.set_yscale("log")
        moved.set_yticks([1, 10, 100], ["1 mm", "1 cm", "10 cm"])
        moved.set_xlim(-0.6, 2.6)
        moved.set_xticks(range(3), ["swiftlet", "hulls", "boxes"])
        moved.grid(axis="x", visible=False)
    return fig


def meshes(questions, title):
    """A panel per question, a line per scene, a mark per method."""
    def draw(results):
        table = [row for row in rows(results, "mesh") if row["question"] in questions]
        shown = list(dict.fromkeys(row["scene"] for row in table))[::-1]
        fig, axes = figure(title, len(questions), width=11, height=1.6 + 0.24 * len(shown),
                           note="left is better · ● proved · ○ not proved")
        for ax, (question, heading) in zip(axes[0], questions.items()):
            of = [row for row in table if row["question"] == question]
            ax.set_title(heading)
            ax.set_xscale("log")
            ax.set_xlabel("µs per query")
            ax.xaxis.set_major_formatter(lambda v, _: f"{v:,.0f}".replace(",", " ") if v >= 1 else f"{v:g}")
            for height, scene in enumerate(shown):
                times = [row["ns"] / 1000 for row in of if row["scene"] == scene]
                ax.plot([min(times), max(times)], [height, height], color=RULE, linewidth=2.5, zorder=1)
            for place, series in enumerate(names(of)):
                points = [(row["ns"] / 1000, shown.index(row["scene"])) for row in of if row["series"] == series]
                ax.plot(*zip(*points), **dict(look(series, place), linestyle="none", label=READABLE.get(series, series)))
            ax.set_yticks(range(len(shown)), shown, fontsize=8)
            ax.set_ylim(-0.6, len(shown) - 0.4)
            ax.grid(axis="y", visible=False)
            ax.tick_params(axis="y", length=0, pad=1)
        fig.subplots_adjust(left=1.35 / fig.get_figwidth())
        handles, labels = axes[0][0].get_legend_handles_labels()
        fig.legend(handles, labels, loc="upper right", bbox_to_anchor=(0.99, 1 - 0.28 / fig.get_figheight()), ncols=len(labels), frameon=False, fontsize=9)
        return fig
    return draw


CHARTS = {
    "mesh_verdicts": (("mesh",), meshes({"intersects": "do they meet", "within0.8": "within 0.8 d", "within1.25": "within 1.25 d"},
                                        "Meshes: questions of yes or no, d the distance of the pose")),
    "mesh_distances": (("mesh",), meshes({"distance10%": "to 10 %", "distance1%": "to 1 %", "distance": "exact"},
                                         "Meshes: distances, by the error allowed")),
    "stack": (("stack",), stacks),
    "error": (("error",), error),
    "standing": (("orbit",), standing),
    "orbit_distance": (("orbit",), orbit("distance")),
    "orbit_intersects": (("orbit",), orbit("intersects")),
    "approximate": (("orbit",), approximate),
    "steps": (("orbit",), work("steps", "Steps per query, exact distance")),
    "plane_tests": (("orbit",), work("plane_tests", "Plane tests per query, exact distance")),
    "triangles": (("triangles",), triangles),
    "scenes": (("scenes",), scenes),
    "precision": (("precision",), precision),
    "links": (("links",), links),
    "fig5": (("fig5",), paper_figure("fig5", "distance", "Figure 5: marching within level 0; first against most violated plane")),
    "fig6": (("fig6",), paper_figure("fig6", "distance", "Figure 6: start tables, radius factor x resolution, no hierarchy")),
    "fig7_ours": (("fig7",), paper_figure("fig7", "intersects", "Figure 7: Dobkin-Kirkpatrick cutoffs, overlap, our start", starts("ours"))),
    "fig7_paper": (("fig7",), paper_figure("fig7", "intersects", "Figure 7: Dobkin-Kirkpatrick cutoffs, overlap, the paper's start", starts("paper"))),
    "fig8_ours": (("fig8",), paper_figure("fig8", "distance", "Figure 8: Dobkin-Kirkpatrick cutoffs, exact distance, our start", starts("ours"))),
    "fig8_paper": (("fig8",), paper_figure("fig8", "distance", "Figure 8: Dobkin-Kirkpatrick cutoffs, exact distance, the paper's start", starts("paper"))),
    "fig9": (("fig9",), paper_figure("fig9", "intersects", "Figure 9: quadric rates at cutoff 50, overlap; both starts")),
    "fig10": (("fig10",), paper_figure("fig10", "distance", "Figure 10: quadric rates at cutoff 50, exact distance; both starts")),
    "fig11": (("fig11",), paper_figure("fig11", "intersects", "Figure 11: best of each, overlap")),
    "fig12": (("fig12",), paper_figure("fig12", "distance", "Figure 12: best of each, exact distance")),
}


def main():
    here = Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description="Draws what the benchmarks measured, as SVG.")
    parser.add_argument("charts", nargs="*", metavar="CHART", help="which: " + " ".join(CHARTS) + "; all whose results are there")
    parser.add_argument("--results", type=Path, default=here.parent / "results", help="where the CSV files are")
    parser.add_argument("--out", type=Path, default=here, help="where the pictures go")
    options = parser.parse_args()
    for chart in options.charts:
        if chart not in CHARTS:
            parser.error(f"no chart {chart}; there are {' '.join(CHARTS)}")
    missing = []
    for chart in options.charts or CHARTS:
        files, draw = CHARTS[chart]
        if not all((options.results / f"{name}.csv").is_file() for name in files):
            missing.append(chart)
            continue
        drawn = draw(options.results)
        drawn.savefig(options.out / f"{chart}.svg", metadata={"Date": None})
        plt.close(drawn)
        print(options.out / f"{chart}.svg")
    if missing:
        print("not measured yet:", " ".join(missing), file=sys.stderr)
    return 1 if missing and options.charts else 0


if __name__ == "__main__":
    sys.exit(main())
