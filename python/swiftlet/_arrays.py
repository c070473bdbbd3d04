# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Plain arrays from which models are made."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np


@dataclass
class LevelArrays:
    """One level of a model as plain arrays, for :meth:`Model.from_levels`.

    Attributes
    ----------
    vertices : array_like, shape (V, 3)
        Each coordinate 0 or from 1e-70 to 1e45 in magnitude, in the caller's unit.
    faces : array_like of int, shape (F, 3), or sequence of loops
        Counter-clockwise from outside.
    vertex_source : array_like of int, shape (V,), optional
        Level 0 only: the user's vertex ids; None: 0, 1, 2, ...
    face_source_begin, face_source : array_like of int, optional
        Level 0 only: lists of the user's triangles per face; `face_source` alone has one id per face.
    child_vertex : array_like of int, shape (V,), optional
        Per vertex a vertex of the finer arrays; None: the nearest.
    child_of_face : array_like of int, shape (F,), optional
        Per face a vertex of the finer arrays, for faces that the finer level lacks.
    """

    vertices: Any
    faces: Any
    vertex_source: Any = None
    face_source_begin: Any = None
    face_source: Any = None
    child_vertex: Any = None
    child_of_face: Any = None


def as_level(level: Any) -> LevelArrays:
    """A level from a pair of vertices and faces, or as it is."""
    given = level if isinstance(level, LevelArrays) else LevelArrays(*level)
    if given.face_source is None or given.face_source_begin is not None:
        return given
    return replace(given, face_source_begin=np.arange(len(given.face_source) + 1))
