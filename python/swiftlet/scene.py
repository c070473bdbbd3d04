# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Many bodies in one world: with the methods of ``trimesh.collision.CollisionManager``, and :class:`Scene` below it."""

from __future__ import annotations

from math import inf
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from ._answers import Answers, Manifold
from ._errors import Status, Verdict
from ._queries import AnyBody
from ._runtime import Body, MeshModel, Model, Scene

__all__ = ["CollisionManager", "ContactData", "DistanceData", "Scene"]


class ContactData:
    """One contact of a pair, as trimesh has it.

    Attributes
    ----------
    names : set of str
        Both bodies; the one without a name is "__external".
    point : ndarray, shape (3,)
        In the world, half the way between both bodies' points.
    normal : ndarray, shape (3,)
        Unit, in the world, from the body named first to the other; NaN where none is known.
    depth : float
        How deep the bodies are in one another there; below 0 where they are that far apart.
    """

    def __init__(
        self,
        names: tuple[str, str],
        point: NDArray[np.float64],
        normal: NDArray[np.float64],
        depth: float,
        features: tuple[int, int],
    ) -> None:
        self.names = set(names)
        self.point = point
        self.normal = normal
        self.depth = depth
        self._features = dict(zip(names, features))

    def index(self, name: str) -> int:
        """The id of the feature in contact of the body `name`: see :func:`swiftlet.feature_index`."""
        return self._features[name]


class DistanceData(NamedTuple):
    """The nearest pair, as trimesh has it.

    Attributes
    ----------
    names : set of str
    distance : float
        Middle of the proved interval; 0 where the bodies overlap.
    points : dict of str to ndarray
        The nearest point of each body, in the world.
    features : dict of str to int
        The feature that each lies on.
    answer : Answers
        The proved interval, in the frame of the body named first.
    """

    names: set[str]
    distance: float
    points: dict[str, NDArray[np.float64]]
    features: dict[str, int]
    answer: Answers

    def point(self, name: str) -> NDArray[np.float64]:
        """The nearest point of the body `name`, in the world, (3,)."""
        return self.points[name]

    def index(self, name: str) -> int:  # type: ignore[override]  # trimesh names it so
        """The id of the feature that it lies on."""
        return self.features[name]


_EXTERNAL = "__external"


def _body(mesh: Any) -> AnyBody:
    if isinstance(mesh, (Model, MeshModel, Body)):
        return mesh
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return MeshModel.from_arrays(mesh.vertices, mesh.faces)
    raise TypeError(f"mesh: expected a Model, MeshModel, Body, or vertices and faces, got {type(mesh).__name__}")


class CollisionManager:
    """Named bodies in one world, and who collides or is nearest: trimesh's interface over :class:`Scene`.

    A mesh is a :class:`Model`, :class:`MeshModel` or :class:`Body`, or anything with `vertices` and `faces`, which becomes a
    MeshModel: its surface. Bodies that touch within rounding collide. Where trimesh says a negative distance of bodies that
    overlap, here it is 0.

    Parameters
    ----------
    threads : int, optional
        For questions about many pairs. Same answers on any number.
    """

    def __init__(self, *, threads: int = 1) -> None:
        self._scene = Scene(threads=threads)
        self._ids: dict[str, tuple[int, int]] = {}
        self._names: dict[tuple[int, int], str] = {}

    @property
    def scene(self) -> Scene:
        """The scene beneath, whose bodies have these names."""
        return self._scene

    def add_object(self, name: str, mesh: Any, transform: Optional[NDArray[np.float64]] = None) -> None:
        """Adds a body, or replaces the one of this name.

        Parameters
        ----------
        name : str
        mesh : Model, MeshModel, Body, or anything with `vertices` and `faces`
        transform : (4, 4) float64, optional
            Its pose in the world.
        """
        if not isinstance(name, str) or not name:
            raise ValueError(f"name: expected a string that is not empty, got {name!r}")
        body, pose = _body(mesh), _pose(transform)
        if name in self._ids:
            self.remove_object(name)
        id = self._scene.add(name, body, pose)
        self._ids[name] = id
        self._names[id] = name

    def remove_object(self, name: str) -> None:
        """Removes a body. ValueError if there is none of this name."""
        id = self._id(name)
        self._scene.remove(id)
        del self._ids[name], self._names[id]

    def set_transform(self, name: str, transform: NDArray[np.float64]) -> None:
        """Moves a body. ValueError if there is none of this name."""
        self._scene.move(self._id(name), _pose(transform))

    def in_collision_single(
        self,
        mesh: Any,
        transform: Optional[NDArray[np.float64]] = None,
        return_names: bool = False,
        return_data: bool = False,
    ) -> Any:
        """Whether a body that is not in the manager collides with one that is.

        Returns
        -------
        is_collision : bool
        names : set of str, if `return_names`
        contacts : list of ContactData, if `return_data`
        """
        found = _collisions(self._alone(mesh, transform), self, return_data)
        return _result(found, {b for _, b in found[0]}, return_names, return_data)

    def in_collision_internal(self, return_names: bool = False, return_data: bool = False) -> Any:
        """Whether any two bodies of the manager collide.

        Returns
        -------
        is_collision : bool
        names : set of (str, str), if `return_names`
            Each pair sorted.
        contacts : list of ContactData, if `return_data`
        """
        found = _collisions(self, self, return_data)
        return _result(found, {(min(pair), max(pair)) for pair in found[0]}, return_names, return_data)

    def in_collision_other(self, other_manager: CollisionManager, return_names: bool = False, return_data: bool = False) -> Any:
        """Whether a body of this manager collides with one of the other.

        Returns
        -------
        is_collision : bool
        names : set of (str, str), if `return_names`
            A name of this manager, then one of the other.
        contacts : list of ContactData, if `return_data`
        """
        found = _collisions(self, other_manager, return_data)
        return _result(found, set(found[0]), return_names, return_data)

    def min_distance_single(
        self,
        mesh: Any,
        transform: Optional[NDArray[np.float64]] = None,
        return_name: bool = False,
        return_data: bool = False,
    ) -> Any:
        """The least distance of a body that is not in the manager to one that is.

        Returns
        -------
        distance : float
            Infinite where the manager is empty.
        name : str or None, if `return_name`
        data : DistanceData or None, if `return_data`
        """
        distance, names, data = _nearest(self._alone(mesh, transform), self)
        return _distance(distance, names and names[1], data, return_name, return_data)

    def min_distance_internal(self, return_names: bool = False, return_data: bool = False) -> Any:
        """The least distance of two bodies of the manager.

        Returns
        -------
        distance : float
            Infinite where there are not two.
        names : (str, str) or None, if `return_names`
            Sorted.
        data : DistanceData or None, if `return_data`
        """
        distance, names, data = _nearest(self, self)
        return _distance(distance, names and tuple(sorted(names)), data, return_names, return_data)

    def min_distance_other(self, other_manager: CollisionManager, return_names: bool = False, return_data: bool = False) -> Any:
        """The least distance of a body of this manager to one of the other.

        Returns
        -------
        distance : float
            Infinite where a manager is empty.
        names : (str, str) or None, if `return_names`
            A name of this manager, then one of the other.
        data : DistanceData or None, if `return_data`
            By names: of two bodies of one name only the other manager's point and feature.
        """
        distance, names, data = _nearest(self, other_manager)
        return _distance(distance, names, data, return_names, return_data)

    def _id(self, name: str) -> tuple[int, int]:
        if name not in self._ids:
            raise ValueError(f"{name} not in collision manager!")
        return self._ids[name]

    def _alone(self, mesh: Any, transform: Optional[NDArray[np.float64]]) -> CollisionManager:
        """A manager of one body, to ask about this one."""
        alone = CollisionManager()
        alone.add_object(_EXTERNAL, mesh, transform)
        return alone


def _pose(transform: Optional[NDArray[np.float64]]) -> NDArray[np.float64]:
    pose = np.eye(4) if transform is None else np.asarray(transform, np.float64)
    if pose.shape != (4, 4):
        raise TypeError(f"transform: expected an array of shape (4, 4), got {pose.shape}")
    return pose


def _pairs(
    first: CollisionManager, second: CollisionManager, a: NDArray[np.uint32], b: NDArray[np.uint32]
) -> list[tuple[str, str]]:
    def name(manager: CollisionManager, id: NDArray[np.uint32]) -> str:
        return manager._names[(int(id[0]), int(id[1]))]

    return [(name(first, i), name(second, j)) for i, j in zip(a, b)]


def _known(pair: tuple[str, str], record: Any) -> tuple[str, str]:
    """The pair, unless its bodies or poses were refused: then nothing is known, and to say yes or no would be a guess."""
    status = Status(int(record["status"]))
    if status >= Status.INVALID_POSE:
        raise ValueError(f"{pair[0]} and {pair[1]}: {status.name}, see swiftlet.Status")
    return pair


def _collisions(first: CollisionManager, second: CollisionManager, with_contacts: bool) -> Any:
    """Names of the pairs that collide, and their contacts."""
    target = None if second is first else second._scene
    if not with_contacts:
        a, b, records = first._scene.overlapping(target)
        return [_known(p, r) for p, r in zip(_pairs(first, second, a, b), records)], []
    a, b, records, manifolds = first._scene.contacts(target)
    names, contacts = [], []
    for pair, id, record, parts in zip(_pairs(first, second, a, b), a, records, manifolds):
        _known(pair, record)
        if record["verdict"] == Verdict.DISJOINT:
            continue
        names.append(pair)
        pose = first._scene.pose((int(id[0]), int(id[1])))
        manifold = Manifold(*parts)
        normal = pose[:3, :3] @ manifold.normal
        for p in manifold.points:
            point = pose[:3, :3] @ ((p["point_a"] + p["point_b"]) / 2) + pose[:3, 3]
            contacts.append(
                ContactData(pair, point, normal, -float(p["separation"]), (int(p["feature_a"]), int(p["feature_b"])))
            )
        if not len(manifold.points):
            point = pose[:3, :3] @ ((record["point_a"] + record["point_b"]) / 2) + pose[:3, 3]
            direction = pose[:3, :3] @ record["normal"]
            features = int(record["feature_a"]), int(record["feature_b"])
            contacts.append(ContactData(pair, point, direction, -float(record["lower"]), features))
    return names, contacts


def _nearest(
    first: CollisionManager, second: CollisionManager
) -> tuple[float, Optional[tuple[str, str]], Optional[DistanceData]]:
    """The least distance, and of which pair."""
    _, a, b, records = first._scene.nearest(None if second is first else second._scene)
    if not len(records):
        return inf, None, None
    pair = _pairs(first, second, a, b)[0]
    answer = Answers(records)[0]
    _known(pair, records[0])
    pose = first._scene.pose((int(a[0, 0]), int(a[0, 1])))
    points = [pose[:3, :3] @ p + pose[:3, 3] for p in (answer.point_a, answer.point_b)]
    features = dict(zip(pair, (int(answer.feature_a), int(answer.feature_b))))
    distance = float(answer.value)
    return distance, pair, DistanceData(set(pair), distance, dict(zip(pair, points)), features, answer)


def _result(found: Any, names: set[tuple[str, str]], return_names: bool, return_data: bool) -> Any:
    result = (len(found[0]) > 0, *([names] if return_names else []), *([found[1]] if return_data else []))
    return result if len(result) > 1 else result[0]


def _distance(distance: float, names: Any, data: Any, return_names: bool, return_data: bool) -> Any:
    result = (distance, *([names] if return_names else []), *([data] if return_data else []))
    return result if len(result) > 1 else distance
