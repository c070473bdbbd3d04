# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""The recorded answers of C++ (tests/data/answers.txt), asked again from Python: the same bits, field by field."""

import math

import numpy as np
from conftest import MODELS, SOURCE

import swiftlet

MASK = (1 << 64) - 1


class Twister:
    """std::mt19937_64, whose bits the standard fixes."""

    def __init__(self, seed):
        self.state = [seed]
        for i in range(1, 312):
            x = self.state[-1]
            self.state.append((6364136223846793005 * (x ^ x >> 62) + i) & MASK)
        self.at = 312

    def bits(self):
        if self.at == 312:
            s = self.state
            for i in range(312):
                x = s[i] & 0xFFFFFFFF80000000 | s[(i + 1) % 312] & 0x7FFFFFFF
                s[i] = s[(i + 156) % 312] ^ x >> 1 ^ (0xB5026F5AA96619E9 if x & 1 else 0)
            self.at = 0
        y = self.state[self.at]
        self.at += 1
        y ^= y >> 29 & 0x5555555555555555
        y ^= y << 17 & 0x71D67FFFEDA60000
        y ^= y << 37 & 0xFFF7EEE000000000
        return y ^ y >> 43


def rotation(w, x, y, z):
    s = 2 / (w * w + x * x + y * y + z * z)
    return [
        [1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
        [s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)],
        [s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)],
    ]


def pose_of(r, t):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = r, t
    return pose


class Poses(Twister):
    """tests/answers.h's, operation by operation."""

    def __init__(self, seed):
        super().__init__(seed)
        self.turning = np.eye(4)

    def uniform(self, low, high):
        return low + (high - low) * ((self.bits() >> 11) * 2.0**-53)

    def next(self):
        kind = self.bits() % 8
        if kind == 0:
            return pose_of(np.eye(3), [((self.bits() % 17) - 8) / 4 for _ in range(3)])
        w = x = y = z = 0.0
        while w * w + x * x + y * y + z * z < 1e-4:
            w, x, y, z = (self.uniform(-1, 1) for _ in range(4))
        if kind >= 5:
            step = pose_of(rotation(1, 0.01 * x, 0.01 * y, 0.01 * z), [0.01 * w, 0.01 * x, 0.01 * y])
            self.turning = swiftlet.relative(step, self.turning)
            return self.turning
        length = math.sqrt(x * x + y * y + z * z)
        reach = self.uniform(0, 0.1) if kind == 1 else self.uniform(0, 2) if kind == 2 else self.uniform(1.9, 4)
        t = [x * reach / length, y * reach / length, z * reach / length] if length > 0 else [reach, 0, 0]
        self.turning = pose_of(rotation(y, z, w, x), t)
        return self.turning

    def seed(self, size):
        return b"".join(self.bits().to_bytes(8, "little") for _ in range(size // 8))


def models():
    octahedron = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    tetrahedron = np.array([[3, 3, 3], [3, -3, -3], [-3, 3, -3], [-3, -3, 3]], float)
    levels = [(octahedron, faces), cube(), (tetrahedron, [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])]
    return [swiftlet.Model.load(p) for p in sorted(MODELS.iterdir())] + [swiftlet.Model.from_levels(levels)]


def cube():
    """tests/bodies.h's, its corners and sides in that order."""
    corners = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]
    return corners, [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


KINDS = ["none", "vertex", "edge", "face"]


def fields(answer):
    feature = lambda id: f"{KINDS[id >> 30]}:{id & 0x3FFFFFFF}"  # noqa: E731
    return {
        "status": swiftlet.Status(int(answer.status)).name.lower(),
        "verdict": swiftlet.Verdict(int(answer.verdict)).name.lower(),
        "lower": float(answer.lower),
        "upper": float(answer.upper),
        "normal": [float(x) for x in answer.normal],
        "point_a": [float(x) for x in answer.point_a],
        "point_b": [float(x) for x in answer.point_b],
        "level_a": int(answer.level_a),
        "level_b": int(answer.level_b),
        "feature_a": feature(int(answer.feature_a)),
        "feature_b": feature(int(answer.feature_b)),
        "radius_a": float(answer.radius_a),
        "radius_b": float(answer.radius_b),
        "steps": int(answer.steps),
        "plane_tests": int(answer.plane_tests),
        "is_signed": "yes" if answer.is_signed else "no",
        "levels_visited": int(answer.levels_visited),
    }


def is_same(now, recorded):
    """Of a field's value and its text, hexadecimal for doubles; zeros with their signs."""
    if isinstance(now, list):
        parts = recorded.split(",")
        return len(parts) == len(now) and all(map(is_same, now, parts))
    if isinstance(now, float):
        then = float.fromhex(recorded)
        return math.isnan(now) and math.isnan(then) or now == then and math.copysign(1, now) == math.copysign(1, then)
    return str(now) == recorded


def recorded():
    table = {}
    for line in (SOURCE / "tests/data/answers.txt").read_text().splitlines():
        name, *words = line.split(" ")
        table[name] = dict(word.split("=", 1) for word in words)
    return table


def ask_all():
    """Yields name and answer of the questions of each_answer without the policies, and of each_signed_answer."""
    bodies = models()
    size = len(swiftlet.Pair(bodies[0], bodies[0]).seed)
    poses, signed = Poses(1), Poses(2)

    def cold(query, a, b, pose, *more, seed=None, **options):
        pair = swiftlet.Pair(a, b)
        if seed is not None:
            pair.seed = seed
        return getattr(pair, query)(pose, *more, **options)

    for i, a in enumerate(bodies):
        for j, b in enumerate(bodies):
            loose, tested, near, warm = (swiftlet.Pair(a, b) for _ in range(4))
            for n in range(10):
                pose, name = poses.next(), f"{i}-{j}/{n}/"
                yield f"distance/{name}cold", swiftlet.distance(a, b, pose)
                yield f"distance/{name}random", cold("distance", a, b, pose, seed=poses.seed(size))
                yield f"distance/{name}swapped", cold("distance", b, a, swiftlet.inverse(pose))
                yield f"distance/{name}loose", loose.distance(pose, relative=0.01)
                yield f"intersects/{name}warm", tested.intersects(pose)
                yield f"within/{name}warm", near.within(pose, 0.5)
                yield f"distance/{name}limited", cold("distance", a, b, pose, steps=n % 7, finest_level=n % 2)
                yield f"distance/{name}automatic.single_single.most", warm.distance(pose)
    seed = met = b"\0" * size
    for i, a in enumerate(bodies):
        for j, b in enumerate(bodies):
            warm, deep = swiftlet.Pair(a, b), swiftlet.Pair(a, b)
            warm.seed, deep.seed = seed, met  # one chain over all pairs
            for n in range(10):
                pose, name = signed.next(), f"{i}-{j}/{n}/"
                if n % 4:
                    pose = pose.copy()
                    pose[:3, 3] *= 0.25
                random = signed.seed(size)
                yield f"signed_distance/{name}warm", warm.signed_distance(pose)
                yield f"signed_distance/{name}cold", swiftlet.signed_distance(a, b, pose)
                yield f"signed_distance/{name}random", cold("signed_distance", a, b, pose, seed=random)
                yield f"signed_distance/{name}swapped", cold("signed_distance", b, a, swiftlet.inverse(pose))
                yield f"signed_distance/{name}loose", cold("signed_distance", a, b, pose, relative=0.01)
                yield f"signed_distance/{name}limited", cold("signed_distance", a, b, pose, steps=n % 7, finest_level=n % 2)
                yield f"signed_within/{name}warm", deep.signed_within(pose, -0.25)
            seed, met = warm.seed, deep.seed


def test_recorded_answers_are_the_same_bits():
    table, compared, wrong = recorded(), 0, []
    for name, answer in ask_all():
        if name not in table:
            continue
        compared += 1
        for field, now in fields(answer).items():
            if not is_same(now, table[name][field]):
                wrong.append(f"{name} {field}: {now}, recorded {table[name][field]}")
    assert not wrong, f"{len(wrong)} of {compared}: " + "\n".join(wrong[:10])
    assert compared > 400
