# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""What Python costs: batches beside C++'s on the same poses, two threads beside one, and one pose a call.

batches.py PROGRAM [POSES] [ROUNDS], where PROGRAM is swiftlet_python_bench; both take turns, round by round. Medians, in ns,
with new memory for the answers and, by `out`, with memory kept from before.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np

import swiftlet

MODELS = Path(__file__).resolve().parents[2] / "tests/data/models"


def poses_on_orbits(count: int) -> np.ndarray:
    """B around A, a degree a step, on circles that wander from 1.9 to 4 radii."""
    angle = np.radians(np.arange(count))
    radius = 2.95 + 1.05 * np.sin(angle / 50)
    tilt = angle / 360
    poses = np.tile(np.eye(4), (count, 1, 1))
    c, s = np.cos(angle), np.sin(angle)
    poses[:, 0, 0], poses[:, 0, 1], poses[:, 1, 0], poses[:, 1, 1] = c, -s, s, c
    poses[:, 0, 3], poses[:, 1, 3] = radius * c * np.cos(tilt), radius * s * np.cos(tilt)
    poses[:, 2, 3] = radius * np.sin(tilt)
    return poses


def hash_of(answers: swiftlet.Answers) -> str:
    """As batches_main.cpp makes it of the bits of all intervals."""
    value = 0xCBF29CE484222325
    for bits in np.stack([answers.lower, answers.upper], axis=1).view(np.uint64).ravel().tolist():
        value = (value ^ bits) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"


def main(program: str, count: int = 1_000_000, rounds: int = 9) -> int:
    files = MODELS / "fat_a.swl", MODELS / "fat_b.swl"
    a, b = map(swiftlet.Model.load, files)
    poses, wrong = poses_on_orbits(count), 0
    ours: dict[tuple[str, int], float] = {}
    with tempfile.NamedTemporaryFile() as file:
        poses.tofile(file.name)
        for threads in (1, 2):
            kinds = ("new", "kept")  # memory of the answers
            python, cpp = ({kind: [] for kind in kinds} for _ in range(2))
            hashes, out = set(), swiftlet.distance(a, b, poses)
            for _ in range(rounds):
                command = [program, *files, file.name, str(threads), "3"]
                *times, their_hash = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
                mine = {kind: [] for kind in kinds}
                for kind in kinds * 3:
                    begin = time.perf_counter()
                    answers = swiftlet.distance(a, b, poses, threads=threads, out=out if kind == "kept" else None)
                    mine[kind].append((time.perf_counter() - begin) * 1e9 / count)
                    hashes |= {their_hash, hash_of(answers)}
                for place, kind in enumerate(kinds):
                    python[kind].append(min(mine[kind]))
                    cpp[kind].append(min(map(float, times[place::2])))
            wrong += len(hashes) != 1
            for kind in kinds:
                ratio = median(x / y for x, y in zip(python[kind], cpp[kind]))
                ours[kind, threads] = median(python[kind])
                print(
                    f"{threads} thread{'s' if threads > 1 else ' '}, {kind:4} memory   in Python {ours[kind, threads]:6.1f}",
                    end="",
                )
                print(f"   in C++ {median(cpp[kind]):6.1f}   ratio {ratio:.3f}")
            print(f"hash {' '.join(sorted(hashes))}")
    for kind in kinds:
        print(f"two threads are {ours[kind, 1] / ours[kind, 2]:.2f} times one, {kind} memory")

    pair, some = swiftlet.Pair(a, b), list(poses[:100_000])
    calls = {
        "Pair.distance, one pose a call": pair.distance,
        "Pair.intersects, one pose a call": pair.intersects,
        "swiftlet.distance, one pose a call": lambda pose: swiftlet.distance(a, b, pose),
    }
    for name, ask in calls.items():
        times = []
        for _ in range(rounds):
            begin = time.perf_counter()
            for pose in some:
                ask(pose)
            times.append((time.perf_counter() - begin) * 1e9 / len(some))
        print(f"{name:36} {median(times):7.0f}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
