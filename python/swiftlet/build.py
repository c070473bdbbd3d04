# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""The builder [Ehmann & Lin 2000, sec. 4]: models of points, mesh files and meshes.

What imports this module comes under CGAL's GPL; the models that it makes are the user's.
"""

from __future__ import annotations

import os
from typing import Any, Callable, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _build
from ._errors import Enclosing, Method, Resolution
from ._runtime import MeshModel, Model

__all__ = ["Built", "Mesh", "build", "build_mesh", "read_mesh", "rebuild_hulls"]


class Mesh(NamedTuple):
    """Points and triangles of a mesh file, as the file has them."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]


class Built(NamedTuple):
    """What :func:`build` made.

    Attributes
    ----------
    model : Model
    report : dict
        points_read, triangles_read, duplicates_dropped, interior_dropped, hull_triangles, faces_grouped, closed (whether
        the mesh has a volume), volume_ratio (that over the hull's; 1 where it has none), deepest_dent (how deep inside the
        hull the mesh's deepest vertex is), end (why the hierarchy ended), and levels: a list with each one's vertices, faces,
        triangles, bytes, deviation, volume_ratio.
    """

    model: Model
    report: dict[str, Any]


def read_mesh(path: str | bytes | os.PathLike[Any]) -> Mesh:
    """Reads a mesh file: OBJ, OFF, STL (ascii or binary), PLY, or SWIFT's TRI and POLY, by extension.

    Parameters
    ----------
    path : str or os.PathLike

    Returns
    -------
    Mesh
        Polygons become triangles, concave ones too.

    Raises
    ------
    FileError, DataError
        With the line, if it is known.
    """
    return Mesh(*_build.run_read(path))


def _arrays(source: Any) -> tuple[Any, Any]:
    if isinstance(source, (str, bytes, os.PathLike)):
        return read_mesh(source)
    if hasattr(source, "vertices") and hasattr(source, "faces"):
        return np.asarray(source.vertices), np.asarray(source.faces)
    return source, None


def build(
    source: Any,
    *,
    method: int = Method.COLLAPSE,
    enclosing: int = Enclosing.TIGHT,
    rate: Optional[float] = None,
    cutoff: int = 60,
    max_levels: int = 32,
    max_deviation: float = 0.0,
    deviation: float = 0.0,
    bytes: Optional[int] = None,
    require_convex: bool = False,
    require_solid: bool = False,
    resolution: int = Resolution.NONE,
    radius_factor: float = 2.0,
    map_cells: int = 4,
    progress: Optional[Callable[[float, str], Optional[bool]]] = None,
    threads: int = 1,
) -> Built:
    """Builds the model of a convex hull with its levels of detail.

    Parameters
    ----------
    source : array_like of shape (n, 3), path, or any object with `vertices` and `faces`
        Points; a mesh file; a mesh such as trimesh has. The model is the convex hull of the points; triangles only give
        its faces their ids.
    method : Method, optional
        How a coarse level is simplified from the next finer one.
    enclosing : Enclosing, optional
        How it is made to enclose level 0.
    rate : float, optional
        Triangles of a level over those of the next finer one, in (0, 1); None: what costs queries least.
    cutoff : int, optional
        Least number of triangles that a level is simplified to, at least 4; enclosing may drop some.
    max_levels : int, optional
        1 to 32, level 0 included.
    max_deviation : float, optional
        The hierarchy ends before a level that deviates more; the body's unit; 0: no limit.
    deviation, bytes : optional
        Which levels are kept: :meth:`Model.cut`.
    require_convex, require_solid : bool, optional
        Refuse a mesh with dents; refuse flat, collinear and single-point input.
    resolution, radius_factor, map_cells : optional
        The start table and support maps: :meth:`Model.with_table`.
    progress : callable, optional
        Gets the fraction done and the stage; returning False cancels.
    threads : int, optional
        Same bytes on any number.

    Returns
    -------
    Built

    Raises
    ------
    DataError
        Names the option, vertex or triangle; or NOT_CONVEX, NOT_SOLID where the options refuse.
    FileError
    Cancelled

    Notes
    -----
    On one thread about 15 microseconds per triangle, some 60 on bodies of a few thousand.
    """
    vertices, faces = _arrays(source)
    block, report = _build.run_build(
        vertices, faces, method, enclosing, rate, cutoff, max_levels, max_deviation, deviation, bytes, require_convex,
        require_solid, resolution, radius_factor, map_cells, progress, threads,
    )  # fmt: skip
    return Built(Model.from_bytes(block), report)


def build_mesh(
    source: Any,
    *,
    levels: int = 4,
    least_triangles: int = 64,
    bytes_per_triangle: float = 120.0,
    least_patch: int = 0,
    progress: Optional[Callable[[float, str], Optional[bool]]] = None,
    threads: int = 1,
) -> MeshModel:
    """Makes a mesh whose upper nodes have convex hulls, which answer bodies that are apart by one march.

    Parameters
    ----------
    source : path, or any object with `vertices` and `faces`
    levels : int, optional
        Levels of nodes, from the root on, that may have hulls: 1 to 16.
    least_triangles : int, optional
        Below the root no node of fewer triangles has a hull.
    bytes_per_triangle : float, optional
        The most bytes of the mesh's block: the largest nodes get hulls first.
    least_patch : int, optional
        Where convex patches hold so many triangles in the mean, they have nodes and hulls of their own, if these fit. 0: never.
    progress : callable, optional
        Gets the fraction done and the stage; returning False cancels.
    threads : int, optional
        Same bytes on any number.

    Returns
    -------
    MeshModel

    Raises
    ------
    DataError, FileError, Cancelled
    """
    vertices, faces = _arrays(source)
    if faces is None:
        raise TypeError("source: expected a path or an object with vertices and faces, got " + type(source).__name__)
    return MeshModel.from_bytes(
        _build.run_build_mesh(vertices, faces, levels, least_triangles, bytes_per_triangle, least_patch, progress, threads)
    )


def rebuild_hulls(
    mesh: MeshModel,
    *,
    levels: int = 4,
    least_triangles: int = 64,
    bytes_per_triangle: float = 120.0,
    progress: Optional[Callable[[float, str], Optional[bool]]] = None,
    threads: int = 1,
) -> MeshModel:
    """Returns the mesh with new hulls, for example after :meth:`MeshModel.refit`. Its tree stays:
    patches have the nodes that they had. Options and errors: :func:`build_mesh`."""
    return MeshModel.from_bytes(
        _build.run_rebuild_hulls(mesh.bytes, levels, least_triangles, bytes_per_triangle, progress, threads)
    )
