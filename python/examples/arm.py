# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""A robot arm's clearance over a trajectory: UR10 links over a table and beside a post. arm.py [PICTURE]

The meshes are those of models/fetch: forearm and second wrist. Of the rest of the arm only what the two need is here: the
UR10's published lengths, in metres.
"""

import sys
from pathlib import Path

import numpy as np

import swiftlet

SHOULDER, UPPER_ARM, FOREARM = 0.1273, 0.612, 0.5723  # d1, a2, a3
CACHE = Path(__file__).resolve().parents[2] / "models/cache"


def turn(axis: int, angles: np.ndarray) -> np.ndarray:
    """Rotations about a coordinate axis, (n, 4, 4)."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    poses = np.tile(np.eye(4), (len(angles), 1, 1))
    poses[:, i, i] = poses[:, j, j] = np.cos(angles)
    poses[:, j, i], poses[:, i, j] = np.sin(angles), -np.sin(angles)
    return poses


def shift(x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def links_in_world(q: np.ndarray) -> dict[str, np.ndarray]:
    """Poses of forearm and second wrist at joint angles q (n, 4), by the chain of joint origins of the robot's description."""
    shoulder = shift(0, 0, SHOULDER) @ turn(2, q[:, 0])
    upper_arm = shoulder @ shift(0, 0.220941, 0) @ turn(1, q[:, 1] + np.pi / 2)
    forearm = upper_arm @ shift(0, -0.1719, UPPER_ARM) @ turn(1, q[:, 2])
    wrist_1 = forearm @ shift(0, 0, FOREARM) @ turn(1, q[:, 3] + np.pi / 2)
    wrist_2 = wrist_1 @ shift(0, 0.1149, 0)
    return {"forearm": forearm, "wrist 2": wrist_2}


links = {"forearm": "ur10_forearm.obj", "wrist 2": "ur10_wrist2.obj"}
if not all((CACHE / file).exists() for file in links.values()):
    sys.exit("models/fetch has not run: no links")
models = {name: swiftlet.Model.build(CACHE / file) for name, file in links.items()}
table = swiftlet.Body.box([-1.5, -1.5, -0.05], [1.5, 1.5, 0.0])
post = swiftlet.Body.segment([0.75, 0.35, 0.0], [0.75, 0.35, 1.2], 0.05)

n = 20_000
t = np.linspace(0, 1, n)
q = np.stack([-1.2 + 2.4 * t, -1.1 + 0.35 * np.sin(9 * t), 1.2 + 0.5 * np.sin(7 * t), -1.3 + np.cos(5 * t)], axis=1)
clearance = {}
for name, poses in links_in_world(q).items():
    for obstacle, body in {"table": table, "post": post}.items():
        answers = swiftlet.signed_distance(body, models[name], poses, threads=2)  # obstacles stand in the world's frame
        clearance[f"{name}, {obstacle}"] = answers.value
        nearest = answers.value.argmin()
        state = "free" if answers.lower.min() > 0 else "collides"
        print(f"{name:8} {obstacle:6} least {answers.value[nearest]:+.4f} m at t = {t[nearest]:.3f}: {state}")

if len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(7, 4))
    for name, values in clearance.items():
        axes.plot(t, values, label=name)
    axes.axhline(0, color="black", linewidth=0.5)
    axes.set_xlabel("time along the trajectory")
    axes.set_ylabel("clearance, m")
    axes.legend()
    figure.tight_layout()
    figure.savefig(sys.argv[1])
