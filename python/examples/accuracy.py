# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Speed against accuracy: time and widest interval of 200 000 distances, from exact to rough. accuracy.py [PICTURE]"""

import sys
import time

import numpy as np

import swiftlet

rng = np.random.default_rng(2)
points = rng.normal(size=(3000, 3))
points /= np.linalg.norm(points, axis=1)[:, None]
model = swiftlet.Model.build(points)

count = 200_000
poses = np.tile(np.eye(4), (count, 1, 1))
angle = np.radians(np.arange(count))
poses[:, 0, 3], poses[:, 1, 3], poses[:, 2, 3] = 3 * np.cos(angle), 3 * np.sin(angle), np.sin(angle / 77)
relative, times, widths = [0, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1], [], []
exact = swiftlet.distance(model, model, poses)
for wanted in relative:
    begin = time.perf_counter()
    answers = swiftlet.distance(model, model, poses, relative=wanted)
    times.append((time.perf_counter() - begin) * 1e9 / count)
    widths.append(float(((answers.upper - answers.lower) / answers.lower).max()))
    assert (answers.lower <= exact.upper).all() and (answers.upper >= exact.lower).all()
    print(f"relative {wanted:6g}: {times[-1]:6.0f} ns a query, widest interval {widths[-1]:.1e} of the distance")

if len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 3.5))
    axes.loglog(widths, times, marker="o")
    axes.set_xlabel("widest interval over the distance")
    axes.set_ylabel("ns a query")
    figure.tight_layout()
    figure.savefig(sys.argv[1])
