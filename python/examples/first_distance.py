# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""First distance: two bodies, one pose, and what an answer says. first_distance.py [PICTURE]"""

import sys

import numpy as np

import swiftlet

corners = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]]
sides = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
tetrahedron = swiftlet.Model.from_arrays(corners, sides)  # Model.build(points) makes the hull of any points

b_in_a = np.eye(4)
b_in_a[:3, 3] = 2, 2, 2
answer = swiftlet.distance(tetrahedron, tetrahedron, b_in_a)
print(f"distance {answer.lower:.12f}, proved to {answer.upper - answer.lower:.0e}")
print("normal", answer.normal.round(6), "from", answer.point_a.round(6), "to", answer.point_b.round(6))
print("check:", bool(swiftlet.check(tetrahedron, tetrahedron, b_in_a, answer)))

poses = np.tile(b_in_a, (100_000, 1, 1))
poses[:, :3, 3] = np.linspace(0, 3, 100_000)[:, None]
many = swiftlet.signed_distance(tetrahedron, tetrahedron, poses, threads=2)
first = np.argmax(many.lower > 0)
print(f"of {len(many)} poses along the diagonal the first {first} overlap; the deepest by {-many.value.min():.6f}")

if len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 3.5))
    axes.plot(poses[:, 0, 3], many.value)
    axes.axhline(0, color="black", linewidth=0.5)
    axes.set_xlabel("translation along (1, 1, 1)")
    axes.set_ylabel("signed distance")
    figure.tight_layout()
    figure.savefig(sys.argv[1])
