# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Levels and what they cost: an ellipsoid's levels of detail, and a query's work for each tolerance. levels.py [PICTURE]"""

import sys

import numpy as np

import swiftlet

rng = np.random.default_rng(1)
points = rng.normal(size=(4000, 3))
points *= [[3, 2, 1]] / np.linalg.norm(points, axis=1)[:, None]
model = swiftlet.Model.build(points)
print(model)
for level in model.levels:
    print(f"level {level.index}: {level.triangle_count:6} triangles, deviation {level.deviation:.5f}, {level.bytes:7} bytes")

angles = np.linspace(0, 2 * np.pi, 2000)
poses = np.tile(np.eye(4), (len(angles), 1, 1))
poses[:, 0, 0] = poses[:, 1, 1] = np.cos(3 * angles)
poses[:, 1, 0], poses[:, 0, 1] = np.sin(3 * angles), -np.sin(3 * angles)
poses[:, 0, 3], poses[:, 1, 3], poses[:, 2, 3] = 5 * np.cos(angles), 5 * np.sin(angles), np.sin(5 * angles)
tolerances, work, error = [0, 0.003, 0.01, 0.03, 0.1, 0.3, 1], [], []
for tolerance in tolerances:
    answers = swiftlet.distance(model, model, poses, absolute=tolerance, seeds=swiftlet.Seeds(len(poses)))
    work.append(float(answers.plane_tests.mean()))
    error.append(float((answers.upper - answers.lower).max()))
    print(
        f"to {tolerance:6g}: {work[-1]:6.1f} plane tests a query, on level {answers.level_a.max()}, width up to {error[-1]:.1e}"
    )
    assert (answers.upper - answers.lower <= np.maximum(tolerance, swiftlet.tolerance(model, model, poses))).all()

light = model.cut(deviation=0.05)
print(f"cut for 0.05: {light.bytes.size} of {model.bytes.size} bytes")

if len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 3.5))
    axes.semilogx([max(t, 1e-3) for t in tolerances], work, marker="o")
    axes.set_xlabel("error allowed (leftmost: exact)")
    axes.set_ylabel("plane tests a query")
    axes.set_ylim(bottom=0)
    figure.tight_layout()
    figure.savefig(sys.argv[1])
