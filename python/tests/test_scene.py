# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes, against all pairs asked one by one, and in trimesh's words."""

import gc
import math
import sys
import weakref

import numpy as np
import pytest
from conftest import CORNERS, TRIANGLES, random_poses, shift

import swiftlet
from swiftlet import Body, Verdict
from swiftlet.scene import CollisionManager, Scene

BOX = Body.box([-1, -1, -1], [1, 1, 1])


class Shape:
    def __init__(self):
        self.vertices, self.faces = CORNERS, TRIANGLES


def test_scenes_are_all_pairs(fat):
    bodies = [fat[k % 2] for k in range(25)]
    poses = random_poses(25, 5, 7)
    scene = Scene(threads=2)
    ids = [scene.add(str(k), b, p) for k, (b, p) in enumerate(zip(bodies, poses))]
    expected = {}
    for i in range(25):
        for j in range(i + 1, 25):
            expected[i, j] = swiftlet.distance(bodies[i], bodies[j], swiftlet.relative(poses[i], poses[j]))
    a, b, records = scene.overlapping()
    assert {(i, j) for i, j in zip(a[:, 0], b[:, 0])} == {k for k, v in expected.items() if v.verdict != Verdict.DISJOINT}
    a, b, records = scene.distances(1.0)
    assert {(i, j) for i, j in zip(a[:, 0], b[:, 0])} == {k for k, v in expected.items() if v.lower <= 1}
    np.testing.assert_allclose(
        [r["lower"] for r in records], [expected[i, j].lower for i, j in zip(a[:, 0], b[:, 0])], atol=1e-12
    )
    assert len(scene.within(1.0)[2]) == len(records)
    scene.ask_only(lambda a, b: a[0] != 3 and b[0] != 3)
    a, b, _ = scene.overlapping()
    assert 3 not in a[:, 0] and 3 not in b[:, 0]
    scene.ask_only(lambda a, b: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        scene.overlapping()
    scene.ask_only(lambda a, b: scene.has(a))
    with pytest.raises(RuntimeError, match="ask_only"):
        scene.overlapping()
    scene.ask_only(None)
    assert scene.find("4") == ids[4] and scene.find("none") is None and scene.name(ids[4]) == "4" and scene.bodies() == ids
    np.testing.assert_array_equal(scene.pose(ids[4]), poses[4])
    assert scene.remove(ids[4]) and not scene.remove(ids[4]) and not scene.has(ids[4]) and len(scene) == 24
    with pytest.raises(ValueError, match="'5' already"):
        scene.add("5", BOX, np.eye(4))


def two_boxes():
    scene = Scene()
    for name, x in (("a", 0), ("b", 1)):
        scene.add(name, BOX, shift(x))
    return scene


@pytest.mark.parametrize("answer, asked", [(None, 0), ([], 0), ("", 0), (np.False_, 0), ("yes", 1), ([0], 1), (np.True_, 1)])
def test_functions_answer_by_what_is_true(answer, asked):
    scene = two_boxes()
    scene.ask_only(lambda a, b: answer)
    assert len(scene.overlapping()[2]) == asked


def test_arguments_are_named_where_they_are_wrong():
    scene = two_boxes()
    for call, message in [
        (lambda: Scene(threads=2.0), "threads: expected a whole number from 1 to 1024, got float"),
        (lambda: CollisionManager(threads=0), "threads: .*, got 0"),
        (lambda: scene.ask_only(3), "asks: expected a function or None, got int"),
        (lambda: scene.within("near"), "threshold: expected a number, got str"),
        (lambda: scene.distances(None), "beyond: expected a number, got NoneType"),
        (lambda: scene.distances(1, relative="x"), "relative: expected a number, got str"),
        (lambda: scene.nearest(absolute=[]), "absolute: expected a number, got list"),
        (lambda: scene.contacts(margin="x"), "margin: expected a number, got str"),
        (lambda: scene.contacts(most_points=9), "most_points: expected a whole number from 1 to 8, got 9"),
    ]:
        with pytest.raises((TypeError, ValueError), match=message):
            call()
    scene.ask_only(lambda a, b: np.zeros(2))
    with pytest.raises(ValueError, match="ambiguous"):
        scene.overlapping()


@pytest.mark.parametrize("kind", [Scene, type("Derived", (Scene,), {})])
def test_a_scene_that_its_function_knows_is_collected(kind):
    class Robot:
        def __init__(self):
            self.scene = kind()
            self.scene.ask_only(self.may_meet)
            self.scene.add("a", BOX, shift(0))
            self.scene.add("b", BOX, shift(1))

        def may_meet(self, a, b):
            gc.collect()
            return self.scene is not None

    robot, function = Robot(), lambda a, b: True
    held = weakref.ref(robot)
    assert len(robot.scene.overlapping()[2]) == 1
    del robot
    gc.collect()
    assert held() is None
    scene, before = kind(), sys.getrefcount(function)
    scene.ask_only(function)
    assert sys.getrefcount(function) == before + 1
    scene.ask_only(None)
    assert sys.getrefcount(function) == before
    scene.ask_only(function)
    del scene
    assert sys.getrefcount(function) == before


def manager(**bodies):
    m = CollisionManager()
    for name, x in bodies.items():
        m.add_object(name, BOX, shift(x))
    return m


def test_collisions_are_told_as_trimesh_tells_them():
    m = manager(a=0, b=1.5, c=6)
    assert m.in_collision_internal() is True
    assert m.in_collision_internal(return_names=True) == (True, {("a", "b")})
    is_collision, names, data = m.in_collision_internal(return_names=True, return_data=True)
    assert is_collision and len(data) == 4
    for contact in data:
        assert contact.names == {"a", "b"} and abs(contact.depth - 0.5) < 1e-12 and abs(contact.point[0] - 0.75) < 1e-12
        np.testing.assert_allclose(contact.normal, [1, 0, 0], atol=1e-12)
        assert contact.index("a") and contact.index("b")
    m.set_transform("b", shift(3))
    assert m.in_collision_internal(return_names=True) == (False, set())
    assert m.in_collision_single(BOX, shift(4.2), return_names=True) == (True, {"b", "c"})
    assert m.in_collision_single(Shape(), shift(20)) is False
    other = manager(x=-1.9, y=50)
    assert m.in_collision_other(other, return_names=True) == (True, {("a", "x")})
    assert other.in_collision_other(m, return_names=True) == (True, {("x", "a")})
    m.remove_object("a")
    assert m.in_collision_other(other) is False
    with pytest.raises(ValueError, match="a not in collision manager"):
        m.set_transform("a", np.eye(4))
    for transform in (np.eye(3), np.eye(4)[:3]):
        with pytest.raises(TypeError, match=r"transform: expected an array of shape \(4, 4\)"):
            m.add_object("b", BOX, transform)
    assert len(m.scene) == 2 and m.in_collision_single(BOX, shift(3)) is True  # the refused ones replaced nothing


def test_what_is_undecided_collides_with_contacts_as_without():
    rng = np.random.default_rng(1)
    points = rng.normal(size=(2000, 3))
    body = swiftlet.Model.build(points / np.linalg.norm(points, axis=1)[:, None] * [3, 1, 0.3]).cut(deviation=0.05)
    m = CollisionManager()
    m.add_object("a", body, np.eye(4))
    seen = set()
    for x in np.linspace(4.8, 6, 61):
        pose = np.eye(4)
        pose[:3, 3] = [x, 0.9, 0.1]
        m.add_object("b", body, pose)
        plain = m.in_collision_internal(return_names=True)
        assert m.in_collision_internal(return_names=True, return_data=True)[:2] == plain
        seen.add(int(swiftlet.distance(body, body, pose[None]).verdict[0]))
        m.remove_object("b")
    assert Verdict.UNDECIDED in seen


def test_distances_are_told_as_trimesh_tells_them():
    m = manager(a=0, b=3.5, c=9)
    distance, names, data = m.min_distance_internal(return_names=True, return_data=True)
    assert abs(distance - 1.5) < 1e-12 and names == ("a", "b") and data.names == {"a", "b"}
    assert abs(data.point("a")[0] - 1) < 1e-12 and abs(data.point("b")[0] - 2.5) < 1e-12
    assert data.answer.lower <= 1.5 <= data.answer.upper
    turned = np.array([[0, -1, 0, 0], [1, 0, 0, 14], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    distance, name, data = m.min_distance_single(BOX, turned, return_name=True, return_data=True)
    assert abs(distance - 12) < 1e-12 and name == "a" and abs(data.point("__external")[1] - 13) < 1e-12
    assert m.min_distance_single(BOX, shift(1)) == 0.0
    other = manager(x=-5, y=14)
    distance, names = m.min_distance_other(other, return_names=True)
    assert abs(distance - 3) < 1e-12 and set(names) in ({"a", "x"}, {"c", "y"})
    assert CollisionManager().min_distance_internal(return_names=True) == (math.inf, None)
    assert CollisionManager().min_distance_single(BOX) == math.inf


def test_what_cannot_be_known_is_no_guess():
    m = manager(a=0, b=9)
    m.set_transform("b", np.full((4, 4), np.nan))
    for ask in (m.in_collision_internal, m.min_distance_internal):
        with pytest.raises(ValueError, match="INVALID_POSE"):
            ask()
    with pytest.raises(TypeError, match="mesh: expected"):
        m.add_object("c", 7)
