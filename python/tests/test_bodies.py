# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Models and meshes: made, read, kept, refused."""

import gc
import os
import pickle

import numpy as np
import pytest
from conftest import CORNERS, MODELS, SIDES, TRIANGLES, shift
from hypothesis import given, settings
from hypothesis import strategies as st

import swiftlet
import swiftlet.scene
from swiftlet import Body, BodyKind, MeshModel, Model, build


class Shape:
    """Vertices and faces, as trimesh has them."""

    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces


def test_a_model_is_its_file(fat, tmp_path):
    path = tmp_path / "a.swl"
    assert fat[0].save(path) == path.stat().st_size == fat[0].bytes.size
    for again in (
        Model.load(path),
        Model.load(str(path)),
        Model.map(path),
        Model.from_bytes(path.read_bytes()),
        Model.from_bytes(fat[0].bytes),
    ):
        assert again.hash() == fat[0].hash() and again.bytes.tobytes() == path.read_bytes()
    assert Model.map(path).is_mapped and not Model.load(path).is_mapped
    assert swiftlet.verify(fat[0])


def test_views_are_read_only_and_keep_the_model(cube):
    model = Model.from_arrays(CORNERS, SIDES)
    views = [model.vertices, model.bytes, model.level(0).half_edges, model.source_vertex]
    copies = [v.copy() for v in views]
    del model
    gc.collect()
    for view, copy in zip(views, copies):
        assert not view.flags.writeable and not view.flags.owndata
        np.testing.assert_array_equal(view, copy)
        with pytest.raises(ValueError):
            view[0] = 0
        with pytest.raises(ValueError):
            view.flags.writeable = True


def test_arrays_of_a_level_hold_together(fat):
    for level in fat[0].levels:
        v, h = level.vertices, level.half_edges
        assert (h[h[:, 1], 1] == np.arange(len(h))).all()
        begin, count = level.rings[:, 0], level.rings[:, 1]
        assert count.sum() == len(h) and (begin[1:] == (begin + count)[:-1]).all()
        t = v[level.triangles.astype(int)]
        normals = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
        volume = np.einsum("ni,ni->", t[:, 0], normals) / 6
        assert abs(volume - level.volume) < 1e-9 * volume and len(t) == level.triangle_count
        assert sum(len(f) - 2 for f in level.faces) == len(t)
    assert fat[0].levels[-1].deviation > fat[0].levels[1].deviation > fat[0].levels[0].deviation == 0
    assert fat[0].vertices.shape == fat[0].level(0).vertices.shape
    with pytest.raises(IndexError):
        fat[0].level(9)
    d = np.array([0.3, -2.0, 0.5])
    assert (fat[0].vertices @ d).argmax() == fat[0].support(d)


def test_pickles_are_bytes_or_a_path_and_hash(fat, mesh, tmp_path):
    assert pickle.loads(pickle.dumps(fat[0], protocol=5)).hash() == fat[0].hash()
    assert pickle.loads(pickle.dumps(mesh)).hash() == mesh.hash()
    path = tmp_path / "m.swl"
    fat[0].save(path)
    mapped = pickle.dumps(Model.map(path))
    assert len(mapped) < 500 and pickle.loads(mapped).is_mapped
    for bytes in (None, *(fat[0].level(k).prefix for k in range(fat[0].level_count))):
        part = Model.map(path, bytes=bytes)
        assert pickle.loads(pickle.dumps(part)).finest_level == part.finest_level
    assert part.finest_level == fat[0].level_count - 1 > 0
    fat[1].save(path)
    with pytest.raises(swiftlet.DataError, match="is not the file"):
        pickle.loads(mapped)
    mesh.save(tmp_path / "m.swm")
    assert pickle.loads(pickle.dumps(MeshModel.map(tmp_path / "m.swm"))).hash() == mesh.hash()
    bodies = [Body(fat[0], 0.5), Body(mesh), Body.solid(mesh, 0.1), Body.point([1, 2, 3], 4), Body.segment([0, 0, 0], [1, 0, 0]),
              Body.triangle([0, 0, 0], [1, 0, 0], [0, 1, 0]), Body.box([0, 0, 0], [1, 2, 3], 1)]  # fmt: skip
    for body in bodies:
        again = pickle.loads(pickle.dumps(body))
        assert again.kind == body.kind and again.radius == body.radius and (again.corners == body.corners).all()
    assert [b.kind for b in bodies[:3]] == [BodyKind.MODEL, BodyKind.MESH, BodyKind.SOLID]
    assert bodies[0].model.hash() == fat[0].hash() and bodies[1].mesh.hash() == mesh.hash() and bodies[3].model is None


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_pickles_by_any_protocol_are_whole_or_refused(fat, mesh, protocol):
    for body in (fat[0], mesh):
        assert pickle.loads(pickle.dumps(body, protocol)).hash() == body.hash()
    assert (pickle.loads(pickle.dumps(Body.point([1, 2, 3], 4), protocol)).corners == [1, 2, 3]).all()
    assert len(pickle.loads(pickle.dumps(swiftlet.Seeds(3), protocol))) == 3
    pair = swiftlet.Pair(*fat)
    answer = pair.distance(shift(3))
    for refused in (fat[0].level(0), mesh.topology, pair, answer, swiftlet.scene.Scene(), swiftlet.scene.CollisionManager()):
        with pytest.raises(TypeError, match=r"cannot pickle 'swiftlet\._runtime\.(Level|Topology|Pair|Answer|Scene)' object"):
            pickle.dumps(refused, protocol)


def test_cuts_and_ensured_levels(fat, tmp_path):
    coarse = fat[0].cut(deviation=0.15)
    assert coarse.finest_level == 1 and coarse.bytes.size < fat[0].bytes.size and coarse.level(0).vertices.shape == (0, 3)
    path = tmp_path / "a.swl"
    fat[0].save(path)
    mapped = Model.map(path, deviation=0.15)
    assert mapped.finest_level == 1 and mapped.ensure(0).finest_level == 0 and mapped.finest_level == 1
    with pytest.raises(swiftlet.DataError):
        coarse.ensure(0)
    for level in (-1, fat[0].level_count):
        with pytest.raises(swiftlet.DataError, match=f"level {level} is not in this model"):
            fat[0].ensure(level)
    path.write_bytes(path.read_bytes()[: fat[0].level(1).prefix + 10])
    with pytest.raises(swiftlet.DataError):
        Model.load(path)
    salvaged, note = Model.salvage(path)
    assert salvaged.finest_level == 1 and note


def test_numbers_of_any_width_are_rounded():
    for dtype in (np.int64, np.uint64, np.longdouble):
        assert Body.point(np.array([2**53 + 1, 0, 1], dtype)).corners[0].tolist() == [2**53, 0, 1]
    with pytest.raises(TypeError):
        Body.point(np.array([1, 2, 3], complex))


def test_pictures_and_words(fat, mesh):
    for body in (fat[0], mesh):
        assert body._repr_svg_().lstrip().startswith(("<svg", "<?xml"))
    assert "3 of 3 levels" in repr(fat[0]) and "closed" in repr(mesh) and "Level 1" in repr(fat[0].level(1))


@pytest.mark.skipif(os.name != "posix", reason="paths are Unicode there")
def test_paths_may_be_any_bytes(fat, mesh, tmp_path):
    for body, load, map in (
        (fat[0], Model.load, Model.map),
        (mesh, MeshModel.load, MeshModel.map),
    ):
        path = os.fsencode(tmp_path) + b"/\xff"
        for name in (path, os.fsdecode(path)):
            with pytest.raises(swiftlet.FileError) as raised:
                load(name)
            assert raised.value.file == os.fsdecode(path)
        with pytest.raises(swiftlet.FileError):
            body.save(path + b"/none")
        body.save(path)
        mapped = pickle.loads(pickle.dumps(map(path)))
        assert mapped.is_mapped and mapped.hash() == body.hash()
        with open(path, "wb") as file:
            file.write(bytes(body.bytes)[:100])
        with pytest.raises(swiftlet.DataError):
            load(path)
        os.remove(path)


@pytest.mark.skipif(os.name != "posix", reason="no other system removes a folder that is in use")
def test_paths_from_nowhere_are_file_errors(tmp_path, monkeypatch):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    for map in (Model.map, MeshModel.map):
        for name in ("", "relative.swl", b"relative.swl"):
            with pytest.raises(swiftlet.FileError) as raised:
                map(name)
            assert raised.value.code == swiftlet.ErrorCode.CANNOT_READ and raised.value.file == os.fsdecode(name)


def test_arguments_are_named_where_they_are_wrong(fat, mesh, tmp_path):
    path = tmp_path / "a.swl"
    fat[0].save(path)
    points = np.random.default_rng(3).normal(size=(30, 3))
    shape = Shape(CORNERS, TRIANGLES)
    for call, message in [
        (lambda: Model.load(path, deviation="fine"), "deviation: expected a number, got str"),
        (lambda: Model.load(path, bytes=1.5), "bytes: expected a whole number from 0 to .*, got float"),
        (lambda: Model.map(path, deviation=None), "deviation: expected a number, got NoneType"),
        (lambda: Model.from_bytes(fat[0].bytes, bytes=-1), "bytes: .*, got -1"),
        (lambda: Model.from_arrays(CORNERS, SIDES, threads=2.0), "threads: expected a whole number from 1 to 1024, got float"),
        (lambda: Model.from_arrays(CORNERS, SIDES, threads=2**70), "threads: .*, got 1180591620717411303424"),
        (lambda: Model.from_arrays(CORNERS, SIDES, repair=np.zeros(2)), "ambiguous"),
        (lambda: Model.from_levels([(CORNERS, SIDES)], resolution=4), "resolution: expected a whole number from 0 to 3, got 4"),
        (lambda: fat[0].with_table(map_cells=2**32), "map_cells: .*, got 4294967296"),
        (lambda: fat[0].with_table(radius_factor="2"), "radius_factor: expected a number, got str"),
        (lambda: fat[0].cut(deviation=10**400), "deviation: expected a number, got one that float64 cannot hold"),
        (lambda: fat[0].cut(deviation=float("nan")), "deviation: expected a number from 0 on, got nan"),
        (lambda: mesh.cut(deviation=-1), "deviation: expected a number from 0 on, got -1"),
        (lambda: fat[0].ensure("all"), "level: expected a whole number"),
        (lambda: fat[0].level(1.0), "index: expected a whole number"),
        (lambda: mesh.cut(deviation=[]), "deviation: expected a number, got list"),
        (lambda: mesh.deviation_at(1.0), "levels: expected a whole number"),
        (lambda: MeshModel.load(path, bytes="all"), "bytes: expected a whole number"),
        (lambda: Body(fat[0], "thick"), "radius: expected a number, got str"),
        (lambda: Body.box([0, 0, 0], [1, 1, 1], None), "radius: expected a number, got NoneType"),
        (lambda: Body.point([0, 0, 0], radius=1j), "radius: expected a number, got complex"),
        (lambda: Body(None), "incompatible constructor arguments"),
        (lambda: Body.solid(None), "incompatible function arguments"),
        (lambda: build.build(points, cutoff=-1), "cutoff: expected a whole number from 0 to 4294967295, got -1"),
        (lambda: build.build(points, method="collapse"), "method: expected a whole number from 0 to 1, got str"),
        (lambda: build.build(points, rate="half"), "rate: expected a number, got str"),
        (lambda: build.build(points, max_levels=2.0), "max_levels: expected a whole number"),
        (lambda: build.build(points, threads=0), "threads: .*, got 0"),
        (lambda: build.build_mesh(shape, levels=1.0), "levels: expected a whole number"),
        (lambda: build.build_mesh(shape, bytes_per_triangle=None), "bytes_per_triangle: expected a number, got NoneType"),
        (lambda: build.build_mesh(shape, least_patch=-1), "least_patch: .*, got -1"),
        (lambda: build.rebuild_hulls(mesh, least_triangles=-1), "least_triangles: .*, got -1"),
        (lambda: build.build(points, progress=lambda fraction, stage: np.zeros(2)), "ambiguous"),
    ]:
        with pytest.raises((TypeError, ValueError), match=message) as raised:
            call()
        assert len(str(raised.value)) < 500
    assert build.build(points, progress=lambda fraction, stage: "go on").report == build.build(points, rate=None).report
    with pytest.raises(swiftlet.Cancelled):
        build.build(points, progress=lambda fraction, stage: "")
    numpys = Model.from_arrays(CORNERS, SIDES, threads=np.int8(2), map_cells=np.uint32(4))
    assert numpys.hash() == Model.from_arrays(CORNERS, SIDES).hash()
    assert Model.load(path, deviation=np.float32(0), bytes=None).finest_level == 0
    with pytest.raises(ValueError, match=f"entry 2 is {2**64 - 1}, which is no index"):
        Model.from_arrays(CORNERS, np.array([[0, 1, 2**64 - 1]], np.uint64))


def test_errors_name_what_is_wrong(tmp_path):
    with pytest.raises(OSError) as raised:
        Model.load(tmp_path / "none.swl")
    assert isinstance(raised.value, swiftlet.FileError) and raised.value.code == swiftlet.ErrorCode.CANNOT_READ
    assert raised.value.file == str(tmp_path / "none.swl")
    assert pickle.loads(pickle.dumps(raised.value)).file == raised.value.file
    dented = CORNERS.copy()
    dented[0] = 0
    with pytest.raises(swiftlet.DataError) as raised:
        Model.from_arrays(dented, SIDES)
    assert raised.value.code == swiftlet.ErrorCode.NOT_CONVEX
    with pytest.raises(swiftlet.DataError):
        Model.from_bytes(b"nothing of ours")
    for vertices, faces, message in [
        (CORNERS[:, :2], SIDES, r"vertices: expected numbers of shape \(n, 3\), got float64 array of shape \(8, 2\)"),
        (CORNERS, [[0, 1, -1]], "is -1, which is no index"),
        (CORNERS, TRIANGLES + 0.5, "faces: expected integers"),
        (CORNERS.astype(str), SIDES, "vertices: expected numbers"),
    ]:
        with pytest.raises((TypeError, ValueError), match=message):
            Model.from_arrays(vertices, faces)
    cube = Model.from_arrays(CORNERS, SIDES)
    cube.save(tmp_path / "cube")
    for path in (str(tmp_path / "cube") + "\0.swl", bytes(tmp_path / "cube") + b"\0.swl"):  # no other file than is named
        with pytest.raises(ValueError, match="null"):
            Model.load(path)
        with pytest.raises(ValueError, match="null"):
            cube.save(path)


def test_meshes(mesh, tmp_path):
    assert mesh.topology.closed and abs(mesh.topology.volume - 8) < 1e-12 and mesh.topology.components == 1
    assert mesh.vertices.shape == (8, 3) and mesh.faces.shape == (12, 3) and not mesh.vertices.flags.writeable
    np.testing.assert_array_equal(CORNERS[mesh.source_vertex], mesh.vertices)
    user = mesh.source_vertex[mesh.faces][np.argsort(mesh.source_triangle)]
    np.testing.assert_array_equal(np.sort(user, axis=1), np.sort(TRIANGLES, axis=1))
    assert swiftlet.verify(mesh)
    moved = mesh.refit(CORNERS * 2)
    assert (moved.box_max == 2).all() and moved.topology.volume == 64
    assert not swiftlet.is_mesh_file(MODELS / "fat_a.swl")
    mesh.save(tmp_path / "m.swm")
    assert swiftlet.is_mesh_file(tmp_path / "m.swm")
    with pytest.raises(swiftlet.Cancelled):
        MeshModel.from_arrays(CORNERS, TRIANGLES, progress=lambda f: False)
    assert MeshModel.from_arrays(CORNERS, TRIANGLES, progress=lambda f: None).faces.shape == (12, 3)
    with pytest.raises(ZeroDivisionError):
        MeshModel.from_arrays(CORNERS, TRIANGLES, progress=lambda f: 1 / 0)


def test_the_builder_takes_points_files_and_shapes(tmp_path):
    points = np.random.default_rng(3).normal(size=(3000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    built = build.build(points, threads=2)
    model = built.model
    assert model.level_count == len(built.report["levels"]) > 1 and built.report["points_read"] == 3000
    assert Model.build(points).hash() == model.hash() and swiftlet.verify(model)
    assert set(map(tuple, model.vertices)) <= set(map(tuple, points))
    off = tmp_path / "cube.off"
    rows = [f"{x} {y} {z}" for x, y, z in CORNERS] + ["3 " + " ".join(map(str, t)) for t in TRIANGLES]
    off.write_text("OFF\n8 12 0\n" + "\n".join(rows) + "\n")
    shape = Shape(CORNERS, TRIANGLES)
    assert Model.build(off).hash() == Model.build(shape).hash()
    read = build.read_mesh(off)
    np.testing.assert_array_equal(read.vertices, CORNERS)
    np.testing.assert_array_equal(read.faces, TRIANGLES)
    assert len(MeshModel.build(off).faces) == 12
    ball = Shape(model.vertices, model.faces)
    hulled = MeshModel.build(ball, threads=2)
    bare = hulled.refit(ball.vertices * 2)
    assert hulled.hull_count >= 1 and bare.hull_count == 0
    assert build.rebuild_hulls(bare).hull_count >= 1 and swiftlet.verify(hulled)
    with pytest.raises(swiftlet.Cancelled):
        build.build(points, progress=lambda fraction, stage: False)
    assert build.build(points, progress=lambda fraction, stage: None).model.level_count > 0
    with pytest.raises(swiftlet.DataError, match="rate"):
        build.build(points, rate=2.0)
    with pytest.raises(swiftlet.DataError, match="cutoff must be at least 4"):
        build.build(points, cutoff=3)
    with pytest.raises(TypeError):
        build.build_mesh(points)
    with pytest.raises(swiftlet.FileError):
        build.read_mesh(tmp_path / "none.obj")


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(*[st.integers(-50, 50)] * 3), min_size=1, max_size=30))
def test_any_points_have_a_hull_that_holds_them(points):
    array = np.array(points, float)
    model = Model.build(array)
    assert (model.box_min == array.min(axis=0)).all() and (model.box_max == array.max(axis=0)).all()
    body = Body.point([0, 0, 0])
    poses = np.stack([shift(*p) for p in points])
    assert (swiftlet.distance(model, body, poses).lower <= 1e-12).all()


def test_levels_from_arrays_enclose():
    octahedron = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    nested = Model.from_levels([(octahedron, faces), swiftlet.LevelArrays(CORNERS, SIDES)])
    assert nested.level_count == 2 and abs(nested.level(1).deviation - 2 / 3**0.5) < 0.02
    with pytest.raises(swiftlet.DataError) as raised:
        Model.from_levels([(CORNERS, SIDES), (octahedron, faces)])
    assert raised.value.code == swiftlet.ErrorCode.NOT_ENCLOSING
