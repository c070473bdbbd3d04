# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Bodies and poses that the tests share."""

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

import swiftlet

settings.register_profile("swiftlet", database=None, derandomize=True)  # nothing is written beside the sources
settings.load_profile("swiftlet")

SOURCE = Path(os.environ.get("SWIFTLET_SOURCE", Path(__file__).resolve().parents[2]))
MODELS = SOURCE / "tests/data/models"

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
TRIANGLES = np.array([t for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))])


def shift(x=0.0, y=0.0, z=0.0):
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def random_poses(count, reach, seed=0):
    """Rotations from QR decompositions, translations of any length up to reach."""
    rng = np.random.default_rng(seed)
    q, r = np.linalg.qr(rng.normal(size=(count, 3, 3)))
    q *= np.sign(np.einsum("nii->ni", r))[:, None, :]
    q[np.linalg.det(q) < 0, :, 0] *= -1
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, :3, :3] = q
    poses[:, :3, 3] = rng.uniform(-reach, reach, (count, 3))
    return poses


def orbit(count, radius=2.5, turns=3.0):
    """Consecutive poses that are near."""
    angle = np.linspace(0, 2 * np.pi * turns, count)
    c, s = np.cos(angle), np.sin(angle)
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, 0, 0], poses[:, 0, 1], poses[:, 1, 0], poses[:, 1, 1] = c, -s, s, c
    poses[:, 0, 3], poses[:, 1, 3] = radius * c, radius * s
    return poses


@pytest.fixture(scope="session")
def fat():
    return swiftlet.Model.load(MODELS / "fat_a.swl"), swiftlet.Model.load(MODELS / "fat_b.swl")


@pytest.fixture(scope="session")
def cube():
    return swiftlet.Model.from_arrays(CORNERS, SIDES)


@pytest.fixture(scope="session")
def mesh():
    return swiftlet.MeshModel.from_arrays(CORNERS, TRIANGLES)


def same(a, b):
    """Whether two answers are the same bits."""
    return a.records.tobytes() == b.records.tobytes()
