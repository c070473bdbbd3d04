# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
import os
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import NDArray


def run_read(path: str | bytes | os.PathLike[Any]) -> tuple[NDArray[np.float64], NDArray[np.uint32]]: ...
def run_build(
    points: Any, triangles: Any, method: int, enclosing: int, rate: Optional[float], cutoff: int, max_levels: int,
    max_deviation: float, deviation: float, bytes: Optional[int], require_convex: bool, require_solid: bool, resolution: int,
    radius_factor: float, map_cells: int, progress: Optional[Callable[..., Optional[bool]]], threads: int,
) -> tuple[bytes, dict[str, Any]]: ...
def run_build_mesh(
    points: Any, triangles: Any, levels: int, least_triangles: int, bytes_per_triangle: float, least_patch: int,
    progress: Optional[Callable[..., Optional[bool]]], threads: int,
) -> bytes: ...
def run_rebuild_hulls(
    data: Any, levels: int, least_triangles: int, bytes_per_triangle: float,
    progress: Optional[Callable[..., Optional[bool]]], threads: int,
) -> bytes: ...
