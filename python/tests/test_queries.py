# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Queries over poses: against formulas and numpy, which share nothing with the library."""

import math
import pickle

import numpy as np
import pytest
from conftest import CORNERS, orbit, random_poses, same, shift
from hypothesis import given, settings
from hypothesis import strategies as st

import swiftlet
import swiftlet.scene
from swiftlet import Body, Decision, Status, Verdict

BOX = Body.box([-1, -1, -1], [1, 1, 1])
QUERIES = {
    "distance": lambda a, b, p, **o: swiftlet.distance(a, b, p, **o),
    "signed_distance": lambda a, b, p, **o: swiftlet.signed_distance(a, b, p, **o),
    "intersects": lambda a, b, p, **o: swiftlet.intersects(a, b, p, **o),
    "within": lambda a, b, p, **o: swiftlet.within(a, b, p, 0.5, **o),
    "signed_within": lambda a, b, p, **o: swiftlet.signed_within(a, b, p, -0.1, **o),
    "closest_features": lambda a, b, p, **o: swiftlet.closest_features(a, b, p, **o).answers,
}


def same_fields(a, b):
    """Whether two answers are the same bits but for those between fields."""
    return all(a.records[name].tobytes() == b.records[name].tobytes() for name in a.records.dtype.names)


def box_distance(translation):
    """Of two boxes of half-width 1 along the axes."""
    return np.linalg.norm(np.maximum(np.abs(translation) - 2, 0), axis=-1)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(*[st.floats(-5, 5, width=32)] * 3), min_size=0, max_size=40), st.sampled_from([1, 2, 3]))
def test_distances_of_boxes_are_the_formula(translations, threads):
    t = np.array(translations).reshape(-1, 3)
    poses = np.tile(np.eye(4), (len(t), 1, 1))
    poses[:, :3, 3] = t
    answers = swiftlet.distance(BOX, BOX, poses, threads=threads)
    truth, slack = box_distance(t), 1e-14
    assert answers.shape == (len(t),) and (answers.status == Status.CONVERGED).all()
    assert (answers.lower <= truth + slack).all() and (answers.upper >= truth - slack).all()
    assert (answers.upper - answers.lower <= 1e-12).all()
    apart = truth > 1e-9
    gap = np.einsum("ni,ni->n", answers.point_b - answers.point_a, answers.normal)
    np.testing.assert_allclose(gap[apart], truth[apart], atol=1e-12)


@settings(max_examples=40, deadline=None)
@given(st.floats(0, 2), st.floats(0, 2), st.tuples(*[st.floats(-4, 4)] * 3))
def test_spheres_are_the_formula(r, s, centre):
    answer = swiftlet.signed_distance(Body.point([0, 0, 0], r), Body.point([0, 0, 0], s), shift(*centre))
    truth = math.dist((0, 0, 0), centre) - r - s
    assert answer.shape == () and answer.lower <= truth + 1e-13 and answer.upper >= truth - 1e-13
    assert answer.radius_a == r and answer.radius_b == s


def test_distances_of_hulls_are_below_those_of_vertices_and_planes_prove_them(fat):
    a, b = fat
    poses = random_poses(300, 4)
    answers = swiftlet.distance(a, b, poses)
    vertices_b = np.einsum("nij,vj->nvi", poses[:, :3, :3], b.vertices) + poses[:, None, :3, 3]
    for i in np.flatnonzero(answers.verdict == Verdict.DISJOINT):
        nearest = np.linalg.norm(a.vertices[:, None] - vertices_b[i][None], axis=2).min()
        gap = (vertices_b[i] @ answers.normal[i]).min() - (a.vertices @ answers.normal[i]).max()
        assert answers.lower[i] <= nearest and abs(gap - answers.value[i]) < 1e-13
    assert 30 < (answers.verdict == Verdict.DISJOINT).sum() < 300


@pytest.mark.parametrize("query", QUERIES)
@pytest.mark.parametrize("bodies", ["fat", "mesh"])
def test_any_number_of_threads_gives_the_same_bits(query, bodies, request):
    a, b = request.getfixturevalue("fat") if bodies == "fat" else [request.getfixturevalue("mesh")] * 2
    poses = orbit(5000 if bodies == "fat" else 2200, 2.2)
    one = QUERIES[query](a, b, poses)
    for threads in (2, 64):
        many = QUERIES[query](a, b, poses, threads=threads)
        assert same_fields(one, many)


@pytest.mark.parametrize("query", QUERIES)
def test_chunks_begin_at_multiples_of_1024(query, fat):
    poses = orbit(3000)
    whole = QUERIES[query](*fat, poses)
    first, second = QUERIES[query](*fat, poses[:2048]), QUERIES[query](*fat, poses[2048:])
    for name in whole.records.dtype.names:
        assert whole.records[name].tobytes() == first.records[name].tobytes() + second.records[name].tobytes(), name


@pytest.mark.parametrize("query", ["distance", "signed_distance", "intersects"])
def test_a_chunk_is_a_pair_asked_again_and_again(query, fat):
    poses = orbit(500)
    pair = swiftlet.Pair(*fat)
    alone = [getattr(pair, query)(pose).record for pose in poses]
    answers = QUERIES[query](*fat, poses)
    assert same(answers, swiftlet.Answers(np.array(alone, alone[0].dtype)))
    assert answers[5].lower == answers.lower[5] and answers[::100].shape == (5,) and answers[answers.lower > 0].shape
    with pytest.raises(TypeError, match="expected rows, got 'lower'"):
        answers["lower"]


@pytest.mark.parametrize("query", ["within", "signed_within"])
def test_a_threshold_has_one_place(query):
    ask = getattr(swiftlet.Pair(BOX, BOX), query)
    assert ask(shift(3), 1.5).decision == swiftlet.Decision.YES and ask(shift(3), 0.5).decision == swiftlet.Decision.NO
    with pytest.raises(TypeError, match="missing argument 'threshold'"):
        ask(shift(3))
    assert ask(shift(3), threshold=1.5).decision == swiftlet.Decision.YES
    with pytest.raises(TypeError, match="multiple values"):
        ask(shift(3), 0.5, threshold=1.5)


@pytest.mark.parametrize("query", [name for name in QUERIES if name != "closest_features"])
def test_answers_are_written_again(query, fat):
    a, b = fat
    ask, poses = QUERIES[query], random_poses(1500, 5)
    out = ask(a, b, poses[::-1].copy())
    lower = out.lower
    for threads in (1, 2):
        assert ask(a, b, poses, threads=threads, out=out) is out
        assert same_fields(out, ask(a, b, poses))
    assert np.shares_memory(lower, out.records) and (lower == out.lower).all()
    single = ask(a, b, poses[0])
    assert ask(a, b, poses[1], out=single) is single and same_fields(single, ask(a, b, poses[1]))


def test_answers_to_write_again_are_refused_by_what_came(fat):
    a, b = fat
    poses = random_poses(10, 5)
    out = swiftlet.distance(a, b, poses)
    before = out.records.copy()
    locked = swiftlet.Answers(out.records.copy())
    locked.records.flags.writeable = False
    decided = swiftlet.within(a, b, poses, 0.5)
    for wrong, error, says in (
        (out.records, TypeError, "expected Answers, got ndarray"),
        (decided, TypeError, "answers of the same query"),
        (out[:9], ValueError, "expected 10 rows"),
        (out[0], ValueError, "expected 10 rows"),
        (swiftlet.Answers(out.records[None]), ValueError, "expected 10 rows"),
        (swiftlet.Answers(np.repeat(out.records, 2)[::2]), ValueError, "next to each other"),
        (locked, ValueError, "writeable"),
    ):
        with pytest.raises(error, match=says):
            swiftlet.distance(a, b, poses, out=wrong)
    with pytest.raises(ValueError, match="expected one answer"):
        swiftlet.distance(a, b, poses[0], out=out)
    with pytest.raises(TypeError, match="same query"):
        swiftlet.within(a, b, poses, 0.5, out=out)
    assert before.tobytes() == out.records.tobytes()


def test_decisions_are_the_pairs_too(fat):
    poses, pair = orbit(200, 1.9), swiftlet.Pair(*fat)
    assert list(swiftlet.within(*fat, poses, 0.1).decision) == [pair.within(p, 0.1).decision for p in poses]
    pair.reset()
    assert list(swiftlet.signed_within(*fat, poses, -0.01).decision) == [
        pair.signed_within(p, threshold=-0.01).decision for p in poses
    ]
    assert set(swiftlet.within(*fat, random_poses(300, 2), 0.2).decision) >= {Decision.YES, Decision.NO}


def test_poses_of_every_form_are_the_same():
    half = math.sqrt(0.5)
    matrix = np.array([[0, -1, 0, 3], [1, 0, 0, 1], [0, 0, 1, 0.5], [0, 0, 0, 1.0]])
    expected = swiftlet.distance(BOX, BOX, matrix)
    assert expected.shape == ()
    forms = [
        ((matrix[:3, :3].copy(), matrix[:3, 3].copy()), {}),
        (np.array([3, 1, 0.5, 0, 0, half, half]), {"quaternion": "xyzw"}),
        (np.array([3, 1, 0.5, half, 0, 0, half]), {"quaternion": "wxyz"}),
    ]
    for pose, options in forms:
        one = swiftlet.distance(BOX, BOX, pose, **options)
        assert abs(one.value - expected.value) < 1e-15 and one.shape == ()
        many = tuple(p[None] for p in pose) if isinstance(pose, tuple) else pose[None]
        assert swiftlet.distance(BOX, BOX, many, **options).shape == (1,)
        np.testing.assert_allclose(swiftlet.matrix(pose, **options), matrix, atol=1e-15)
    q = swiftlet.distance(BOX, BOX, np.array([[3, 1, 0.5, 0, 0, half * 1.1, half]]), quaternion="xyzw")
    assert q.status[0] == Status.INVALID_POSE


def test_strided_views_are_taken_as_they_are(fat):
    poses = random_poses(200, 4)
    expected = swiftlet.distance(*fat, poses)
    fortran = np.asfortranarray(poses)
    wide = np.zeros((400, 5, 6))
    wide[::2, :4, 1:5] = poses
    for view in (fortran, wide[::2, :4, 1:5], poses[::-1][::-1], (poses[:, :3, :3], poses[:, :3, 3])):
        assert same(expected, swiftlet.distance(*fat, view))
    transposed = np.ascontiguousarray(poses.transpose(2, 1, 0)).transpose(2, 1, 0)
    assert same(expected, swiftlet.distance(*fat, transposed, threads=2))
    buffer = np.zeros(200 * 128 + 1, np.uint8)[1:].view(np.uint8)
    unaligned = np.ndarray((200, 4, 4), np.float64, buffer)
    unaligned[...] = poses
    assert not unaligned.flags.aligned and same(expected, swiftlet.distance(*fat, unaligned))


@pytest.mark.parametrize(
    "bad, came",
    [
        (np.eye(4, dtype=np.float32), "float32 array of shape (4, 4)"),
        (np.eye(4, dtype=int), "int64 array of shape (4, 4)"),
        (np.eye(4).astype(">f8"), ">f8 array"),
        (np.eye(3), "float64 array of shape (3, 3)"),
        (np.zeros((2, 3, 4)), "float64 array of shape (2, 3, 4)"),
        (np.zeros((1, 1, 4, 4)), "(1, 1, 4, 4)"),
        (np.zeros(()), "float64 array of shape ()"),
        ([[1.0]], "got list"),
        (None, "NoneType"),
        ((np.eye(3),), "a tuple of float64 array of shape (3, 3)"),
        ((np.eye(3), np.zeros((2, 3))), "shape (2, 3)"),
    ],
)
def test_poses_that_are_none_are_refused_by_what_came_and_what_is_wanted(bad, came):
    with pytest.raises(TypeError) as raised:
        swiftlet.distance(BOX, BOX, bad)
    assert came in str(raised.value) and "expected float64 of shape (4, 4)" in str(raised.value)


def test_copy_converts():
    poses = np.stack([shift(3), shift(4)])
    expected = swiftlet.distance(BOX, BOX, poses)
    for other in (poses.astype(np.float32), poses.tolist(), poses.astype(">f8")):
        assert same(expected, swiftlet.distance(BOX, BOX, other, copy=True))
    assert same(expected, swiftlet.distance(BOX, BOX, ([np.eye(3).tolist()] * 2, [[3, 0, 0], [4, 0, 0]]), copy=True))
    with pytest.raises(TypeError):
        swiftlet.distance(BOX, BOX, np.eye(3, dtype=int), copy=True)


def test_the_order_of_a_quaternion_must_be_named():
    with pytest.raises(ValueError, match="xyzw"):
        swiftlet.distance(BOX, BOX, np.zeros((1, 7)))
    with pytest.raises(ValueError, match="got 'zyxw'"):
        swiftlet.distance(BOX, BOX, np.zeros((1, 7)), quaternion="zyxw")


@pytest.mark.parametrize("query", QUERIES)
def test_bad_poses_are_statuses_of_their_rows(query, fat):
    poses = np.tile(shift(3), (6, 1, 1))
    poses[1, 0, 3] = np.nan
    poses[2, 1, 1] = 2
    poses[3, 3, 3] = 2
    poses[4, 0, 0] = np.inf
    answers = QUERIES[query](*fat, poses)
    assert (answers.status == Status.INVALID_POSE).tolist() == [False, True, True, True, True, False]
    assert np.isnan(answers.normal[1:5]).all() and (answers.verdict[1:5] == Verdict.UNDECIDED).all()
    assert np.isinf(answers.upper[1:5]).all() and np.isnan(answers.value[1:5]).all()


@pytest.mark.parametrize("query", QUERIES)
def test_no_poses_give_no_answers(query, fat, mesh):
    for a, b in (fat, (mesh, mesh)):
        answers = QUERIES[query](a, b, np.zeros((0, 4, 4)), threads=3)
        assert answers.shape == (0,) and len(answers) == 0


@pytest.mark.parametrize("threads", [0, -1, 1025])
def test_threads_are_from_1_to_1024(threads):
    with pytest.raises(ValueError, match=f"threads: expected a whole number from 1 to 1024, got {threads}"):
        swiftlet.distance(BOX, BOX, np.eye(4), threads=threads)


@pytest.mark.parametrize("steps, error", [(-1, ValueError), (2**32, ValueError), (2**70, ValueError), (1.5, TypeError)])
def test_steps_are_a_whole_number(steps, error):
    scene = swiftlet.scene.Scene()
    for ask in [
        lambda: swiftlet.distance(BOX, BOX, np.eye(4), steps=steps),
        lambda: swiftlet.contacts(BOX, BOX, np.eye(4), 0.1, steps=steps),
        lambda: swiftlet.Pair(BOX, BOX).distance(np.eye(4), steps=steps),
        lambda: scene.nearest(steps=steps),
    ]:
        with pytest.raises(error, match="steps: expected a whole number from 0 to 4294967295, got "):
            ask()
    with pytest.raises(TypeError, match="finest_level: expected a whole number"):
        swiftlet.Pair(BOX, BOX).distance(np.eye(4), finest_level="all")


def test_arguments_are_named_where_they_are_wrong(fat):
    pose, answer = np.eye(4), swiftlet.distance(*fat, shift(3))
    for call, message in [
        (lambda: swiftlet.distance(*fat, pose, threads=2.0), "threads: expected a whole number from 1 to 1024, got float"),
        (lambda: swiftlet.distance(*fat, pose, threads=2**70), "threads: expected a whole number from 1 to 1024, got 1180591620"),
        (lambda: swiftlet.distance(*fat, pose, finest_level=1.0), "finest_level: expected a whole number .*, got float"),
        (lambda: swiftlet.distance(*fat, pose, absolute="x"), "absolute: expected a number, got str"),
        (lambda: swiftlet.distance(*fat, pose, relative=None), "relative: expected a number, got NoneType"),
        (lambda: swiftlet.distance(*fat, pose, beyond=np.zeros(3)), "beyond: expected a number, got float64 array of shape"),
        (lambda: swiftlet.distance(*fat, pose, beyond=10**400), "beyond: expected a number, got one that float64 cannot hold"),
        (lambda: swiftlet.distance(*fat, pose, seeds=3), "seeds: expected Seeds, got int"),
        (lambda: swiftlet.distance(*fat, pose, copy=np.zeros(2)), "ambiguous"),
        (lambda: swiftlet.distance(*fat, pose, tuning=3), "tuning: expected a Tuning, got int"),
        (lambda: swiftlet.distance(*fat, pose, tuning=swiftlet.Tuning(start="x")), "tuning.start: expected a whole .*, got str"),
        (lambda: swiftlet.Pair(*fat, tuning=swiftlet.Tuning(plane_rule=2)), "tuning.plane_rule: .* from 0 to 1, got 2"),
        (lambda: swiftlet.Pair(*fat).distance(pose, relative=10**400), "relative: expected a number, got one that float64"),
        (lambda: swiftlet.within(*fat, pose, None), "threshold: expected a number, got NoneType"),
        (lambda: swiftlet.closest_features(*fat, pose, beyond="far"), "beyond: expected a number, got str"),
        (lambda: swiftlet.refine(*fat, shift(3), answer, threads="all"), "threads: expected a whole number"),
        (lambda: swiftlet.check(*fat, shift(3), answer, exact=np.zeros(2)), "ambiguous"),
        (lambda: swiftlet.trace(1, *fat, pose), "query: expected the name of a query, got int"),
        (lambda: swiftlet.trace("distance", *fat, pose, threshold="x"), "threshold: expected a number, got str"),
        (lambda: swiftlet.contacts(*fat, pose, "near"), "reach: expected a number, got str"),
        (lambda: swiftlet.contacts(*fat, pose, 1, most=-1), "most: expected a whole number from 0 to .*, got -1"),
        (lambda: swiftlet.manifold(*fat, shift(3), answer, margin=None), "margin: expected a number, got NoneType"),
        (lambda: swiftlet.manifold(*fat, shift(3), answer, most_points=1.0), "most_points: .* 1 to 8, got float"),
        (lambda: swiftlet.Seeds(-1), "count: expected a whole number from 0 to .*, got -1"),
        (lambda: swiftlet.Seeds(2.0), "count: expected a whole number"),
        (lambda: swiftlet.Seeds(1).set_pair("first", b""), "row: expected a whole number"),
        (lambda: swiftlet.distance([BOX], BOX, pose, index_a=[2**64 - 1]), f"index_a: entry 0 is {2**64 - 1}, which is no index"),
    ]:
        with pytest.raises((TypeError, ValueError), match=message) as raised:
            call()
        assert len(str(raised.value)) < 200
    with pytest.raises(MemoryError, match=f"count: no memory for {2**62}"):
        swiftlet.Seeds(2**62)
    with pytest.raises(MemoryError, match=f"most: no memory for {2**62}"):
        swiftlet.contacts(*fat, pose, 1, most=2**62)


def test_what_a_number_raises_is_raised(fat):
    class Raising:
        def __index__(self):
            raise KeyboardInterrupt

        __float__ = __index__

    for name in ("threads", "relative", "steps"):
        with pytest.raises(KeyboardInterrupt):
            swiftlet.distance(*fat, np.eye(4), **{name: Raising()})


def test_rows_choose_their_bodies(fat, mesh):
    a, poses = [fat[0], fat[1], BOX], random_poses(600, 4)
    index = np.arange(600) % 3
    answers = swiftlet.distance(a, fat[1], poses, index_a=index, threads=2)
    for k in range(3):
        rows = index == k
        alone = swiftlet.distance(a[k], fat[1], poses[rows])
        np.testing.assert_allclose(answers.value[rows], alone.value, atol=1e-13)
    one_pose = swiftlet.distance(a, [mesh, BOX], shift(3), index_a=[0, 1, 2], index_b=[0, 0, 1])
    assert one_pose.shape == (3,) and abs(one_pose.value[2] - 1) < 1e-14
    assert swiftlet.distance(a, BOX, shift(3), index_a=np.zeros(0, int)).shape == (0,)
    assert swiftlet.distance([], [], shift(3), index_a=[], index_b=[]).shape == (0,)
    with pytest.raises(ValueError, match="index_b: 3 rows, but there are 0"):
        swiftlet.distance(a, [BOX], shift(3), index_a=[], index_b=[0, 0, 0])
    with pytest.raises(IndexError, match="entry 1 is 3, of 3 bodies"):
        swiftlet.distance(a, BOX, shift(3), index_a=[0, 3])
    with pytest.raises(ValueError, match="index_a: 2 rows, but there are 3"):
        swiftlet.distance(a, BOX, np.tile(np.eye(4), (3, 1, 1)), index_a=[0, 1])
    with pytest.raises(ValueError, match="is -1"):
        swiftlet.distance(a, BOX, shift(3), index_a=[-1])
    with pytest.raises(TypeError, match="sequence of bodies"):
        swiftlet.distance(BOX, BOX, shift(3), index_a=[0])


def test_seeds_change_the_work_and_not_the_truth(fat):
    poses = orbit(400, 2.4)
    seeds = swiftlet.Seeds(400)
    cold = swiftlet.distance(*fat, poses, seeds=seeds)
    warm = swiftlet.distance(*fat, poses, seeds=seeds, threads=2)
    np.testing.assert_allclose(cold.value, warm.value, atol=1e-13)
    assert warm.plane_tests.sum() < cold.plane_tests.sum()
    again = pickle.loads(pickle.dumps(seeds))
    assert same(swiftlet.distance(*fat, poses, seeds=seeds), swiftlet.distance(*fat, poses, seeds=again))
    seeds.reset()
    assert same(cold, swiftlet.distance(*fat, poses, seeds=seeds))
    with pytest.raises(ValueError, match="3 seeds for 400 rows"):
        swiftlet.distance(*fat, poses, seeds=swiftlet.Seeds(3))


def test_looser_answers_are_true_and_refined(fat):
    poses = random_poses(100, 6, seed=5)
    exact, loose = swiftlet.distance(*fat, poses), swiftlet.distance(*fat, poses, relative=0.1)
    assert (loose.lower <= exact.upper).all() and (loose.upper >= exact.lower).all()
    assert loose.plane_tests.sum() < exact.plane_tests.sum()
    refined = swiftlet.refine(*fat, poses, loose)
    np.testing.assert_allclose(refined.value, exact.value, atol=1e-13)
    assert (refined.upper - refined.lower <= swiftlet.tolerance(*fat, poses) * 2).all()
    beyond = swiftlet.distance(*fat, poses, beyond=0.5)
    assert (beyond.status == Status.BEYOND).any() and (beyond.lower[beyond.status == Status.BEYOND] > 0.5).all()
    few = swiftlet.distance(*fat, poses, steps=0)
    assert (few.lower <= exact.upper).all() and (few.upper >= exact.lower).all()
    coarse = swiftlet.distance(*fat, poses, finest_level=1)
    assert (coarse.status == Status.LEVEL_LIMIT).any()
    with pytest.raises(ValueError, match="99 answers for 100 poses"):
        swiftlet.refine(*fat, poses, loose[:99])
    with pytest.raises(TypeError, match="expected answers, got float64 array"):
        swiftlet.refine(*fat, poses, loose.lower)


def test_closest_features_are_the_users_ids(cube):
    named = swiftlet.Model.from_arrays(CORNERS, [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]],
                                       vertex_source=np.arange(8) + 100, face_source=np.arange(6) + 50)  # fmt: skip
    found = swiftlet.closest_features(
        named, Body.point([0, 0, 0]), np.stack([shift(3, 0.2, 0.1), shift(2, 2, 2), shift(2, 2, 0)])
    )
    assert found.answers.shape == (3,) and found.source_a.begin.tolist()[-1] == len(found.source_a.triangles)
    assert found.source_a.kind.tolist() == [swiftlet.FeatureKind.FACE, swiftlet.FeatureKind.VERTEX, swiftlet.FeatureKind.EDGE]
    assert found.source_a.triangles[: found.source_a.begin[1]].tolist() == [51]
    assert found.source_a.vertices[1, 0] == 107 and set(found.source_a.vertices[2].tolist()) == {106, 107}


def test_checks_hold_and_catch(fat):
    pose = shift(3)
    answer = swiftlet.distance(*fat, pose)
    assert swiftlet.check(*fat, pose, answer) and swiftlet.check(*fat, pose, swiftlet.Pair(*fat).signed_distance(pose))
    wrong = pickle.loads(pickle.dumps(answer))
    wrong.records["lower"] += 0.1
    wrong.records["upper"] += 0.1
    refused = swiftlet.check(*fat, pose, wrong)
    assert not refused and "lower" in refused.message
    loose = swiftlet.distance(*fat, pose, absolute=0.5)
    assert swiftlet.check(*fat, pose, answer, exact=True) and swiftlet.check(*fat, pose, loose)
    assert "exact" in swiftlet.check(*fat, pose, loose, exact=True).message


def test_a_trace_tells_what_levels_cost(fat):
    seen = swiftlet.trace("distance", *fat, shift(3), relative=0.001)
    assert len(seen.levels) == seen.answer.levels_visited > 0
    assert seen.levels["plane_tests"].sum() <= seen.answer.plane_tests
    proof = swiftlet.trace("intersects", *fat, shift(0.1)).proof
    assert 1 <= len(proof) <= 4
    with pytest.raises(ValueError, match="got 'nearest'"):
        swiftlet.trace("nearest", *fat, shift(3))


def test_manifolds_of_a_box_on_a_box(cube):
    pose = shift(0, 0, 1.9)
    points = swiftlet.manifold(cube, cube, pose, swiftlet.signed_distance(cube, cube, pose))
    assert len(points.points) == 4
    np.testing.assert_allclose(np.abs(points.points["point_a"]), 1, atol=1e-12)
    np.testing.assert_allclose(points.points["separation"], -0.1, atol=1e-12)
    again = swiftlet.manifold(cube, cube, pose, swiftlet.Pair(cube, cube).signed_distance(pose), previous=points)
    assert again.points.tobytes() == points.points.tobytes()
    with pytest.raises(TypeError, match="previous: expected a Manifold, got tuple"):
        swiftlet.manifold(cube, cube, pose, swiftlet.distance(cube, cube, pose), previous=(1, 2))
    with pytest.raises(ValueError, match="from 1 to 8, got 9"):
        swiftlet.manifold(cube, cube, pose, swiftlet.signed_distance(cube, cube, pose), most_points=9)


def test_contacts_of_meshes_are_regions(mesh):
    found = swiftlet.contacts(mesh, mesh, shift(0, 0, 2.05), 0.1)
    assert found.status == Status.CONVERGED and found.count == 1 and found.is_counted
    assert abs(found.regions["lower"][0] - 0.05) < 1e-12
    points = swiftlet.manifold(mesh, mesh, shift(0, 0, 2.05), found.regions[0:1], margin=0.1)
    np.testing.assert_allclose(points.points["separation"], 0.05, atol=1e-12)
    assert swiftlet.contacts(mesh, mesh, shift(0, 0, 9), 0.1).count == 0


def test_solids_know_their_inside(mesh):
    small = Body.box([-0.1, -0.1, -0.1], [0.1, 0.1, 0.1])
    assert swiftlet.intersects(mesh, small, np.eye(4)).verdict == Verdict.DISJOINT
    assert swiftlet.intersects(Body.solid(mesh), small, np.eye(4)).verdict == Verdict.OVERLAPPING
    open_mesh = swiftlet.MeshModel.from_arrays(CORNERS, [[0, 1, 2]])
    assert swiftlet.distance(Body.solid(open_mesh), small, np.eye(4)).status == Status.INVALID_BODY


def test_relative_and_inverse_are_those_of_matrices():
    a, b = random_poses(50, 10, 1), random_poses(50, 10, 2)
    np.testing.assert_allclose(swiftlet.relative(a, b), np.linalg.inv(a) @ b, atol=1e-12)
    np.testing.assert_allclose(swiftlet.relative(a[0], b), np.linalg.inv(a[0]) @ b, atol=1e-12)
    np.testing.assert_allclose(swiftlet.inverse(a), np.linalg.inv(a), atol=1e-12)
    with pytest.raises(ValueError, match="b_in_world: 3 poses, but a_in_world has 50"):
        swiftlet.relative(a, b[:3])


def test_answers_are_indexed_pickled_and_said(fat):
    poses = random_poses(10, 5)
    answers = swiftlet.within(*fat, poses, 1.0)
    assert len(list(answers)) == 10 and answers[3].shape == () and answers[2:4].shape == (2,)
    assert answers[answers.decision == Decision.NO].shape == ((answers.decision == Decision.NO).sum(),)
    assert same(pickle.loads(pickle.dumps(answers)), answers)
    assert "10 rows" in repr(answers) and "distance in [" in repr(answers[0])
    with pytest.raises(AttributeError):
        swiftlet.distance(*fat, poses).decision
    assert swiftlet.feature_kind(answers.feature_a[answers.status == 1]).dtype == np.uint8
    assert np.shares_memory(answers.lower, answers.records)


def test_a_pair_says_what_is_wrong(fat):
    pair = swiftlet.Pair(*fat)
    for call, message in [
        (lambda: pair.distance(), "expected a pose"),
        (lambda: pair.distance(np.eye(4), 1.0), "2 positional"),
        (lambda: pair.distance(np.eye(4), relativ=1.0), "unexpected keyword argument 'relativ'"),
        (lambda: pair.intersects(np.eye(4), relative=1.0), "unexpected keyword"),
        (lambda: pair.within(np.eye(4)), "threshold"),
        (lambda: pair.within(np.eye(4), "near"), "threshold: expected a number, got str"),
        (lambda: pair.distance(np.eye(4, dtype=np.float32)), "pose: expected float64"),
        (lambda: swiftlet.Pair(1, 2), "a: expected a Model, MeshModel or Body, got int"),
        (lambda: swiftlet.Answer(), "cannot create"),
    ]:
        with pytest.raises(TypeError, match=message.replace("(", r"\(")):
            call()
    with pytest.raises(ValueError, match="takes one, got 2"):
        pair.distance(np.stack([np.eye(4)] * 2))

    class Kept(swiftlet.Pair):
        pass

    assert Kept(*fat).distance(shift(3)).lower == swiftlet.Pair(*fat).distance(shift(3)).lower
    pair.seed = b"\xff" * len(pair.seed)
    assert abs(pair.distance(shift(3)).value - swiftlet.distance(*fat, shift(3)).value) < 1e-13
