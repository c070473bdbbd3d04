# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""A UR10 in a cell: its clearance over a grid of joint angles, as a map. ur10_cell.py [PICTURE] [--help]

Two sweeps over the same configurations: how far the moving links are from a table and a post, and whether anything overlaps,
pairs of links that are not neighbours included. (Some of these are 2 cm apart or less in all configurations, so that their
distance would hide the others'.) All pairs of a configuration are one row; poses are made by forward kinematics in the workers.
The picture is of the plane of shoulder lift and elbow: the least clearance over all other joints, and how many of their
combinations are free. Bodies are convex hulls.

Meshes: models/fetch. Joint origins: ur10_robot.urdf.gz of the meshes' package (Debian's libsimbody-dev), generated from
ROS-Industrial's ur_description. Metres, radians.
"""

import argparse
import itertools
import time
from contextlib import ExitStack
from pathlib import Path

import numpy as np

import swiftlet
from swiftlet.dask import FirstOverlap, Grid, Histogram, Least, Map, Verdicts, sweep

CACHE = Path(__file__).resolve().parents[2] / "models/cache"
LINKS = ["base", "shoulder", "upper_arm", "forearm", "wrist1", "wrist2", "wrist3"]
# Of each joint: its frame in the link before, then the axis that it turns about: 1 is y, 2 is z.
JOINTS = [
    ((0, 0, 0.1273), False, 2),
    ((0, 0.220941, 0), True, 1),
    ((0, -0.1719, 0.612), False, 1),
    ((0, 0, 0.5723), True, 1),
    ((0, 0.1149, 0), False, 2),
    ((0, 0, 0.1157), False, 1),
]
TOOL = (0, 0.0922, 0)  # the flange in the frame of wrist 3
TABLE = swiftlet.Body.box([-0.4, -1.2, -0.35], [1.4, 1.2, -0.3])
POST = swiftlet.Body.segment([0.75, 0.35, -0.3], [0.75, 0.35, 1.2], 0.05)
AXES = ["lift", "elbow", "pan", "wrist 1", "wrist 2", "wrist 3"]  # of the grid
WORLD = -1  # the frame that obstacles stand in, which is the base's


def forward(q):
    """Rotations (7, n, 3, 3) and translations (7, n, 3) of the links in the base's frame, at joint angles q (n, 6)."""
    turns, places = np.empty((7, len(q), 3, 3)), np.empty((7, len(q), 3))
    turns[0], places[0] = np.eye(3), 0
    for link, (origin, quarter, axis) in enumerate(JOINTS, 1):
        before = turns[link - 1]
        places[link] = before @ np.array(origin) + places[link - 1]
        # The description's quarter turns are about y, as the joint after them is.
        angle = q[:, link - 1] + (np.pi / 2 if quarter else 0)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        turns[link, :, :, axis] = before[:, :, axis]
        turns[link, :, :, i] = c * before[:, :, i] + s * before[:, :, j]
        turns[link, :, :, j] = c * before[:, :, j] - s * before[:, :, i]
    return turns, places


class Poses:
    """Poses of the pairs: the second body's in the frame of the first."""

    def __init__(self, pairs):
        self.pairs = pairs

    def __call__(self, q):
        turns, places = forward(q)
        made = []
        for a, b in self.pairs:
            if a == WORLD:
                made.append((turns[b], places[b]))
            else:
                back = turns[a].transpose(0, 2, 1)
                made.append((back @ turns[b], (back @ (places[b] - places[a])[:, :, None])[:, :, 0]))
        return made


def cell():
    """Models of the links; pairs of links that are not neighbours, which touch in their joint; pairs of obstacle and link."""
    models = [swiftlet.Model.build(CACHE / f"ur10_{link}.obj") for link in LINKS]
    apart = [(a, b) for a in range(len(LINKS)) for b in range(a + 2, len(LINKS))]
    moving = range(2, len(LINKS))  # base and shoulder stay where they are mounted
    return models, apart, [(WORLD, b) for b in moving for _ in (TABLE, POST)]


def bodies(models, pairs):
    """Of the pairs: an obstacle's pairs come in turns."""
    obstacles = itertools.cycle((TABLE, POST))
    return [next(obstacles) if a == WORLD else models[a] for a, _ in pairs], [models[b] for _, b in pairs]


def joint_grid(side, samples):
    """Shoulder lift and elbow, `side` each, which the map shows; then pan and wrists, up to `samples` configurations in all."""
    inner = max(2, round((samples / side**2) ** (1 / 3)))
    lift, elbow = np.linspace(-np.pi, 0, side), np.linspace(-2.6, 2.6, side)
    pan, wrist = np.linspace(-np.pi, np.pi, inner, endpoint=False), np.linspace(-np.pi / 2, np.pi / 2, inner)
    return [lift, elbow, pan, wrist, wrist, [0.0]], inner**3


class Configurations:
    """Values of the grid's axes as joint angles, then poses."""

    def __init__(self, pairs):
        self.poses = Poses(pairs)

    def __call__(self, values):
        return self.poses(values[:, [2, 0, 1, 3, 4, 5]])


def draw(path, axes, near, free):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    lift, elbow = np.degrees(axes[0]), np.degrees(axes[1])
    shape = len(lift), len(elbow)
    figure, panels = pyplot.subplots(1, 2, figsize=(10, 4.2), sharey=True)
    shown = [
        ("least clearance, m", near["lower"].reshape(shape), "viridis"),
        ("free, of all pans and wrists", (free["free"] / free["count"]).reshape(shape), "cividis"),
    ]
    for panel, (title, values, colours) in zip(panels, shown):
        mesh = panel.pcolormesh(elbow, lift, values, cmap=colours, shading="nearest")
        figure.colorbar(mesh, ax=panel)
        panel.set_title(title)
        panel.set_xlabel("elbow, degrees")
    panels[0].set_ylabel("shoulder lift, degrees")
    figure.tight_layout()
    figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("picture", nargs="?")
    parser.add_argument("--samples", type=float, default=2e4, help="configurations, about; 1e8 for the real map")
    parser.add_argument("--side", type=int, default=24, help="cells of the map along each axis")
    parser.add_argument("--workers", type=int, default=0, help="processes of a local Dask cluster; 0: threads")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--chunk", type=int, default=8192)
    parser.add_argument("--absolute", type=float, default=0.002, help="width of the clearances' intervals, m")
    parser.add_argument("--beyond", type=float, default=0.4, help="clearances above it need not be known, m")
    parser.add_argument("--checkpoint", help="two files to go on from, and to keep: this name, .near and .free")
    parser.add_argument("--progress", action="store_true")
    options = parser.parse_args()
    if not all((CACHE / f"ur10_{link}.obj").exists() for link in LINKS):
        raise SystemExit("models/fetch has not run: no links")

    models, apart, in_cell = cell()
    axes, per_cell = joint_grid(options.side, options.samples)
    bins = [0, 0.01, 0.02, 0.05, 0.1, 0.2]
    with ExitStack() as stack:
        how = dict(chunk=options.chunk, progress=options.progress, threads=options.threads)
        if options.workers:
            from distributed import Client, LocalCluster

            cluster = stack.enter_context(
                LocalCluster(n_workers=options.workers, threads_per_worker=1, dashboard_address=None, memory_limit=0)
            )
            how["client"] = stack.enter_context(Client(cluster))

        def over(pairs, reductions, name, **options_of_query):
            file = options.checkpoint and f"{options.checkpoint}.{name}"
            grid = Grid(axes, Configurations(pairs))
            return grid, sweep(*bodies(models, pairs), grid, reductions, checkpoint=file, **how, **options_of_query)

        began = time.perf_counter()
        grid, (near, least, histogram) = over(
            in_cell, (Map(per_cell), Least(), Histogram(bins)), "near", absolute=options.absolute, beyond=options.beyond
        )
        _, (free, verdicts, first) = over(
            apart + in_cell, (Map(per_cell), Verdicts(), FirstOverlap()), "free", query="intersects"
        )
        seconds = time.perf_counter() - began

    count = len(grid)
    print(f"{count} configurations in {seconds:.1f} s: {count / seconds:.0f} a second")
    print(f"of {len(in_cell)} pairs in the cell:")
    for low, high, n in zip(bins, [*bins[1:], np.inf], histogram[1:]):
        print(f"  clearance {low:4.2f} m to {high:4.2f} m: {n}")
    nearest = f"{LINKS[in_cell[least.pair][1]]} and {('table', 'post')[least.pair % 2]}"
    print(f"  least in [{least.lower:.4f}, {least.upper:.4f}] m: {nearest}, configuration {least.index}")
    found = ", ".join(f"{n} {verdict.name.lower()}" for verdict, n in verdicts.items())
    print(f"of these and {len(apart)} pairs of links: {found}")
    print("  first that overlaps:", "none" if first is None else f"{first}: {dict(zip(AXES, grid.values(first).round(3)))}")
    if options.picture:
        draw(options.picture, axes, near, free)


if __name__ == "__main__":
    main()
