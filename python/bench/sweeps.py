# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a sweep costs: one pair over many poses on threads and on a Dask cluster of this machine, side by side.

sweeps.py [POSES [ROUNDS [CHUNK]]]. Each round runs all of them, so that what else the machine does meets each; medians. First where one
thread's time goes: making poses by numpy, asking, reducing. `efficiency` is the speed over that of as many single threads.
"""

from __future__ import annotations

import hashlib
import os
import sys
import time
from pathlib import Path
from statistics import median

import numpy as np

import swiftlet
from swiftlet.dask import Histogram, Least, sweep

MODELS = Path(__file__).resolve().parents[2] / "tests/data/models"
BLOCK = 1024


def poses(first: int, count: int) -> np.ndarray:
    """As batches.py has them: B around A, a degree a step, on circles that wander from 1.9 to 4 radii."""
    angle = np.radians(np.arange(first, first + count))
    radius, tilt = 2.95 + 1.05 * np.sin(angle / 50), angle / 360
    made = np.zeros((count, 4, 4))
    c, s = np.cos(angle), np.sin(angle)
    made[:, 0, 0], made[:, 0, 1], made[:, 1, 0], made[:, 1, 1] = c, -s, s, c
    made[:, 2, 2] = made[:, 3, 3] = 1
    made[:, 0, 3], made[:, 1, 3], made[:, 2, 3] = radius * c * np.cos(tilt), radius * s * np.cos(tilt), radius * np.sin(tilt)
    return made


def shares(a: swiftlet.Model, b: swiftlet.Model, count: int) -> None:
    making = asking = 0.0
    for first in range(0, count, BLOCK):
        begin = time.perf_counter()
        made = poses(first, BLOCK)
        middle = time.perf_counter()
        swiftlet.distance(a, b, made)
        making, asking = making + middle - begin, asking + time.perf_counter() - middle
    begin = time.perf_counter()
    sweep(a, b, poses, REDUCTIONS, count=count)
    whole = time.perf_counter() - begin
    for name, seconds in (("made", making), ("asked", asking), ("reduced, and the rest", whole - making - asking), ("whole", whole)):
        print(f"  {name:24} {seconds * 1e9 / count:7.1f} ns a pose")


REDUCTIONS = (Least(), Histogram(np.linspace(0, 4, 65)))


def main(count: int = 10_000_000, rounds: int = 3, chunk: int = 65536) -> int:
    a, b = (swiftlet.Model.map(MODELS / name) for name in ("fat_a.swl", "fat_b.swl"))
    print(f"{count} poses of one pair in chunks of {chunk}, load {os.getloadavg()[0]:.2f} of {os.cpu_count()} cores; one thread:")
    shares(a, b, min(count, 1 << 20))

    from distributed import Client, LocalCluster

    kinds = [("thread", 1), ("thread", 2), ("worker", 1), ("worker", 2)]
    took: dict[tuple[str, int], list[float]] = {kind: [] for kind in kinds}
    hashes = set()
    for _ in range(rounds):
        for kind, many in kinds:
            if kind == "thread":
                begin = time.perf_counter()
                found = sweep(a, b, poses, REDUCTIONS, count=count, chunk=chunk, threads=many)
                seconds = time.perf_counter() - begin
            else:
                with LocalCluster(n_workers=many, threads_per_worker=1, dashboard_address=None, memory_limit=0) as cluster:
                    with Client(cluster) as client:
                        begin = time.perf_counter()
                        found = sweep(a, b, poses, REDUCTIONS, count=count, chunk=chunk, client=client)
                        seconds = time.perf_counter() - begin
            took[kind, many].append(seconds)
            hashes.add(hashlib.sha256(repr([np.asarray(part).tolist() for part in found]).encode()).hexdigest()[:16])
    single = median(took["thread", 1])
    for kind, many in kinds:
        seconds = median(took[kind, many])
        print(f"{many} {kind}{'s' if many > 1 else ' '} {count / seconds / 1e6:7.2f} million poses a second", end="")
        print(f"   efficiency {single / seconds / many:.2f}")
    print(f"hash {' '.join(sorted(hashes))}")
    return 0 if len(hashes) == 1 else 1


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
