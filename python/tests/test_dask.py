# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps on threads and on Dask's local cluster, against whole arrays of answers reduced by numpy alone."""

import os
import signal
import sys
import threading
import time

import numpy as np
import pytest
from conftest import SOURCE, orbit, random_poses

import swiftlet
from swiftlet.dask import FirstOverlap, Grid, Histogram, Least, Map, Rows, Verdicts, sweep

POSES = random_poses(20_500, 2.5)
EDGES = [0, 0.25, 1.0]
ALL = Least(), Histogram(EDGES), FirstOverlap(), Verdicts(), Map(700)


class Slow:
    """Poses that take a while, so that a worker dies amid them."""

    def __len__(self):
        return len(POSES)

    def __call__(self, first, count):
        time.sleep(0.05)
        return random_poses(20_500, 2.5)[first : first + count]


def bits(results):
    least, histogram, first, verdicts, cells = results
    return repr(least), histogram.tobytes(), first, verdicts, cells.tobytes()


@pytest.fixture(scope="module")
def expected(fat):
    return bits(sweep(*fat, POSES, ALL))


def test_reductions_are_numpys(fat):
    least, histogram, first, verdicts, cells = sweep(*fat, POSES, ALL)
    answers = swiftlet.distance(*fat, POSES)
    assert least == (answers.lower.min(), answers.upper.min(), answers.upper.argmin(), 0)
    assert histogram.tolist() == np.histogram(answers.lower, [-np.inf, *EDGES, np.inf])[0].tolist()
    overlaps = answers.verdict == swiftlet.Verdict.OVERLAPPING
    assert first == overlaps.argmax() and overlaps.any()
    assert verdicts == {v: (answers.verdict == v).sum() for v in swiftlet.Verdict}
    for c, cell in enumerate(cells):
        rows = slice(c * 700, (c + 1) * 700)
        assert cell["lower"] == answers.lower[rows].min() and cell["upper"] == answers.upper[rows].min()
        assert cell["index"] == c * 700 + answers.upper[rows].argmin()
        assert cell["overlapping"] == overlaps[rows].sum() and cell["count"] == len(answers.lower[rows])
    assert cells["count"].sum() == len(POSES)


@pytest.mark.parametrize("threads, chunk", [(1, 1024), (2, 3072), (3, 65536)])
def test_bits_depend_on_neither_threads_nor_chunks(fat, expected, threads, chunk):
    assert bits(sweep(*fat, POSES, ALL, threads=threads, chunk=chunk)) == expected


@pytest.mark.parametrize("reduction", ALL, ids=lambda r: type(r).__name__)
def test_parts_merge_in_any_order(reduction):
    rng = np.random.default_rng(1)
    parts = []
    for first in range(0, 5000, 500):
        lower = rng.integers(0, 3, 500) / 4.0  # many ties
        parts.append(reduction.of(Rows(first, lower, lower, rng.integers(0, 4, 500), rng.integers(0, 4, 500).astype(np.uint8))))
    seen = set()
    for _ in range(20):
        heap = [parts[i] for i in rng.permutation(len(parts))]
        while len(heap) > 1:
            i, j = sorted(rng.choice(len(heap), 2, replace=False))
            other = heap.pop(j)
            heap[i] = reduction.merge(heap[i], other)
        seen.add(b"".join(np.ascontiguousarray(array).tobytes() for array in heap[0]))
    assert len(seen) == 1


def test_several_pairs_are_one_row(fat):
    post = swiftlet.Body.point([0.0, 0.0, 3.0], 0.5)
    near, far = orbit(3000), orbit(3000, 4.0)
    made = lambda i, n: [near[i : i + n], far[i : i + n]]  # noqa: E731
    least, verdicts = sweep([fat[0], post], list(fat), made, (Least(), Verdicts()), count=3000)
    upper = np.stack([swiftlet.distance(fat[0], fat[0], near).upper, swiftlet.distance(post, fat[1], far).upper])
    assert least.upper == upper.min() and least.index == upper.min(axis=0).argmin()
    assert least.pair == upper[:, least.index].argmin() and sum(verdicts.values()) == 3000


def test_resumes_after_an_interruption(fat, expected, tmp_path):
    file = tmp_path / "sweep.npz"

    def some(done, count):
        assert 0 < done <= count
        return done < 6000

    with pytest.raises(swiftlet.Cancelled):
        sweep(*fat, POSES, ALL, chunk=1024, checkpoint=file, progress=some)
    begun = []
    assert bits(sweep(*fat, POSES, ALL, chunk=1024, checkpoint=file, progress=lambda done, _: begun.append(done))) == expected
    assert begun[0] > 6000 and os.listdir(tmp_path) == ["sweep.npz"]
    with pytest.raises(swiftlet.DataError, match="another sweep"):
        sweep(*fat, POSES * [1, 1, 1, 1], Least(), chunk=1024, checkpoint=file)
    with pytest.raises(swiftlet.DataError, match="another sweep"):
        sweep(fat[1], fat[0], POSES, ALL, chunk=1024, checkpoint=file)
    file.write_bytes(file.read_bytes()[:100])
    with pytest.raises(swiftlet.DataError, match="not a checkpoint"):
        sweep(*fat, POSES, ALL, chunk=1024, checkpoint=file)
    np.save(tmp_path / "other.npy", np.zeros(3))
    with pytest.raises(swiftlet.DataError, match="not a checkpoint"):
        sweep(*fat, POSES, ALL, chunk=1024, checkpoint=tmp_path / "other.npy")


def interrupted_at(line, function):
    """Calls the function, and raises KeyboardInterrupt before so many lines of `sweep` have run, as Ctrl-C may at any."""
    left = line

    def trace(frame, event, _):
        nonlocal left
        if frame.f_code is not sweep.__code__:
            return None
        left -= event == "line"
        if left == 0:
            raise KeyboardInterrupt
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        function()
    finally:
        sys.settrace(before)


def test_no_interruption_counts_a_chunk_twice(fat, tmp_path):
    interrupted = 0
    for line in range(15, 120, 3):
        file = tmp_path / f"{line}.npz"

        def ask():
            return sweep(*fat, POSES, Verdicts(), checkpoint=file, chunk=1024)

        try:
            interrupted_at(line, ask)
        except KeyboardInterrupt:
            interrupted += 1
        assert sum(ask().values()) == len(POSES), line
    assert interrupted > 20


@pytest.mark.parametrize("function", ["numpy.savez", "os.fsync", "os.replace"])
@pytest.mark.parametrize("error, raised", [(KeyboardInterrupt, KeyboardInterrupt), (OSError, swiftlet.FileError)])
def test_no_interruption_leaves_files(fat, tmp_path, monkeypatch, function, error, raised):
    def fail(*_, **__):
        raise error

    def ask(**options):
        return sweep(*fat, POSES, Verdicts(), chunk=1024, checkpoint=tmp_path / "sweep.npz", **options)

    with pytest.raises(swiftlet.Cancelled):
        ask(progress=lambda done, _: done < 6000)
    before = (tmp_path / "sweep.npz").read_bytes()
    with monkeypatch.context() as patch, pytest.raises(raised):
        patch.setattr(function, fail)
        ask()
    assert os.listdir(tmp_path) == ["sweep.npz"] and (tmp_path / "sweep.npz").read_bytes() == before
    assert sum(ask().values()) == len(POSES)


def test_a_pose_that_is_refused_is_named(fat):
    poses = POSES.copy()
    poses[2500, 0, 0] = 3
    with pytest.raises(ValueError, match="pose 2500: INVALID_POSE"):
        sweep(*fat, poses, Verdicts(), chunk=1024)


def test_a_checkpoint_is_a_regular_file_where_links_lead(fat, tmp_path):
    (tmp_path / "there").mkdir()
    os.symlink("there/sweep.npz", tmp_path / "link.npz")
    for _ in range(2):
        sweep(*fat, POSES, Verdicts(), chunk=1024, checkpoint=tmp_path / "link.npz")
        assert os.path.islink(tmp_path / "link.npz") and (tmp_path / "there" / "sweep.npz").is_file()
    for other in (os.devnull, tmp_path):
        with pytest.raises(swiftlet.FileError, match="is no regular file"):
            sweep(*fat, POSES, Verdicts(), chunk=1024, checkpoint=other)


def test_a_damaged_checkpoint_is_told_so(fat, tmp_path):
    file = tmp_path / "sweep.npz"

    def ask():
        return sweep(*fat, POSES[:3000], Verdicts(), chunk=1024, checkpoint=file)

    expected, whole = ask(), file.read_bytes()
    entry = whole.index(b"PK\x01\x02")  # of the archive's directory: then versions, flags and method
    done = whole.index(b"'shape': (1,)")
    for at, byte in [(entry + 6, 235), (entry + 8, 1), (entry + 8, 32), (entry + 10, 1), (entry + 10, 8), (done + 10, ord("0"))]:
        damaged = bytearray(whole)
        damaged[at] = byte
        file.write_bytes(damaged)
        with pytest.raises(swiftlet.DataError, match="is not a checkpoint of a sweep"):
            ask()
    file.write_bytes(whole)
    assert ask() == expected


@pytest.mark.parametrize("stop", [False, np.False_, 0])
def test_progress_cancels_by_whatever_is_false(fat, stop):
    with pytest.raises(swiftlet.Cancelled):
        sweep(*fat, POSES, Verdicts(), progress=lambda done, count: stop)
    for go_on in (None, True, np.True_):
        assert sum(sweep(*fat, POSES, Verdicts(), progress=lambda done, count: go_on).values()) == len(POSES)


def test_numpys_whole_numbers_are_taken(fat, tmp_path):
    options = dict(count=np.int64(3000), chunk=np.uint32(1024), threads=np.int8(2))
    for checkpoint in (None, tmp_path / "sweep.npz", os.fsencode(tmp_path / "bytes.npz")):
        assert sum(sweep(*fat, POSES, Verdicts(), checkpoint=checkpoint, **options).values()) == 3000
    assert sum(sweep(*fat, POSES, Verdicts(), checkpoint=tmp_path / "sweep.npz", count=3000, chunk=1024).values()) == 3000
    for name in options:
        with pytest.raises(TypeError, match=f"{name}: expected a whole number, got float"):
            sweep(*fat, POSES, Verdicts(), **{**options, name: 1024.0})


def test_says_what_is_wrong(fat):
    with pytest.raises(ValueError, match="multiple of 1024"):
        sweep(*fat, POSES, Least(), chunk=1000)
    with pytest.raises(ValueError, match="without a length"):
        sweep(*fat, lambda i, n: POSES[i : i + n], Least())
    with pytest.raises(ValueError, match="expected 10 poses"):
        sweep(*fat, lambda i, n: POSES[:3], Least(), count=10)
    with pytest.raises(TypeError, match="seeds: a sweep decides"):
        sweep(*fat, POSES, Least(), seeds=None)
    with pytest.raises(TypeError, match="expected a Reduction"):
        sweep(*fat, POSES, min)
    assert len(Grid([range(1000)] * 4, None)) == 10**12


def test_a_cluster_gives_the_same_bits_though_a_worker_is_killed(fat, expected):
    distributed = pytest.importorskip("distributed", reason="Dask is not installed: python3-distributed")
    options = dict(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, memory_limit=0)
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        assert bits(sweep(*fat, POSES, ALL, client=client, chunk=2048)) == expected
        victim, killed = next(iter(client.run(os.getpid).values())), threading.Event()

        def kill(done, count):
            if not killed.is_set() and done < count:
                os.kill(victim, signal.SIGKILL)
                killed.set()

        assert bits(sweep(*fat, Slow(), ALL, client=client, chunk=2048, progress=kill)) == expected
        assert killed.is_set()


def by_dh(q):
    """The UR10's flange by the Denavit-Hartenberg parameters that its maker publishes."""
    pose = np.eye(4)
    d, a = [0.1273, 0, 0, 0.163941, 0.1157, 0.0922], [0, -0.612, -0.5723, 0, 0, 0]
    for angle, offset, length, twist in zip(q, d, a, [np.pi / 2, 0, 0, np.pi / 2, -np.pi / 2, 0]):
        c, s, ct, st = np.cos(angle), np.sin(angle), np.cos(twist), np.sin(twist)
        rows = [c, -s * ct, s * st, length * c], [s, c * ct, -c * st, length * s], [0, st, ct, offset], [0, 0, 0, 1]
        pose = pose @ np.array(rows)
    return pose


def test_the_ur10_stands_where_its_maker_says(monkeypatch):
    pytest.importorskip("swiftlet.build")
    monkeypatch.syspath_prepend(str(SOURCE / "python/examples"))
    ur10_cell = __import__("ur10_cell")
    q = np.vstack([np.zeros(6), np.random.default_rng(3).uniform(-3, 3, (50, 6))])
    turns, places = ur10_cell.forward(q)
    flange = places[6] + turns[6] @ np.array(ur10_cell.TOOL)
    half_turn = np.array([-1, -1, 1])  # the maker's base frame is the description's, turned by half about z
    assert np.allclose(flange[0] * half_turn, [-1.1843, -0.256141, 0.0116], atol=1e-12)
    for at, angles in zip(flange, q):
        assert np.allclose(at * half_turn, by_dh(angles)[:3, 3], atol=1e-9)
    del sys.modules["ur10_cell"]


def test_a_later_block_of_the_wrong_length_is_named() -> None:
    def poses(first: int, count: int) -> np.ndarray:
        return np.tile(np.eye(4), (count if first < 1024 else count - 1, 1, 1))

    point = swiftlet.Body.point([0, 0, 0])
    with pytest.raises(ValueError, match=r"poses\(1024, 1024\): expected 1024 poses"):
        sweep(point, point, poses, Least(), count=4096)
    with pytest.raises(TypeError, match="out: a sweep decides it"):
        sweep(point, point, poses, Least(), count=4096, out=swiftlet.distance(point, point, poses(0, 4)))
