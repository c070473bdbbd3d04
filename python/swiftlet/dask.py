# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps: queries over more poses than memory holds, on the threads of one machine or on a Dask cluster.

>>> import numpy as np, swiftlet
>>> from swiftlet.dask import FirstOverlap, Grid, Least, sweep
>>> def beside(values):                       # poses of a grid's values, in the workers
...     poses = np.tile(np.eye(4), (len(values), 1, 1))
...     poses[:, :3, 3] = values
...     return poses
>>> box = swiftlet.Body.box([-1, -1, -1], [1, 1, 1])
>>> axis = np.linspace(3, 5, 40)
>>> least, first = sweep(box, box, Grid([axis, axis, [0.0]], beside), (Least(), FirstOverlap()))
>>> round(least.upper, 12), least.index, first
(1.414213562373, 0, None)

Only ``client=`` needs Dask (Debian: python3-distributed).
"""

from __future__ import annotations

import hashlib
import json
import operator
import os
import sys
import threading
import time
import uuid
import zipfile
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import suppress
from math import inf, prod
from typing import Any, Callable, Generator, Iterator, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _queries
from ._answers import Answers
from ._errors import Cancelled, DataError, ErrorCode, FileError, Status, Verdict
from ._queries import AnyBody
from ._reductions import FirstOverlap, Histogram, Least, LeastDistance, Map, Partial, Reduction, Rows, Verdicts
from ._runtime import POSES_PER_CHUNK, Body
from ._runtime import VERSION as _VERSION

__all__ = [
    "FirstOverlap",
    "Grid",
    "Histogram",
    "Least",
    "LeastDistance",
    "Map",
    "Reduction",
    "Rows",
    "Verdicts",
    "sweep",
]

_QUERIES = ("distance", "signed_distance", "intersects")
_NOT_OPTIONS = ("threads", "seeds", "index_a", "index_b", "out")
_IN_FLIGHT = 3  # chunks of each thread, running or waiting: enough that none waits for the caller, few in memory
_DELIVERY_SECONDS = 60
_PROBES = 5  # blocks of poses by which a checkpoint knows the sweep

# By worker process: what it computes chunks of, and how many of its workers hold it.
_jobs: dict[str, tuple["_Job", int]] = {}
_jobs_change = threading.Condition()


class Grid:
    """Poses of all combinations of values on axes, the last axis fastest.

    Parameters
    ----------
    axes : sequence of array_like of float
    poses_of : callable
        Takes values, an ndarray of shape (n, len(axes)), and returns what a callable `poses` of :func:`sweep` does. For a cluster
        it must be one that pickle can name or copy.
    """

    def __init__(self, axes: Sequence[Any], poses_of: Callable[[NDArray[np.float64]], Any]) -> None:
        self.axes = [np.array(axis, np.float64) for axis in axes]
        self.poses_of = poses_of
        for i, axis in enumerate(self.axes):
            if axis.ndim != 1 or not len(axis):
                raise ValueError(f"axes[{i}]: expected one or more numbers, got an array of shape {axis.shape}")

    def __len__(self) -> int:
        return prod(len(axis) for axis in self.axes)

    def __call__(self, first: int, count: int) -> Any:
        return self.poses_of(self.values(np.arange(first, first + count)))

    def values(self, index: Any) -> NDArray[np.float64]:
        """The values at indices of poses: of shape (n, len(axes)), or (len(axes),) of one."""
        at = np.unravel_index(index, [len(axis) for axis in self.axes])
        return np.stack([axis[i] for axis, i in zip(self.axes, at)], axis=-1)


def _whole(number: Any, name: str) -> int:
    """An int of any whole number, as NumPy's are: what is written to a checkpoint must be one."""
    try:
        return operator.index(number)
    except TypeError:
        raise TypeError(f"{name}: expected a whole number, got {type(number).__name__}") from None


class _Given:
    """Poses that are there, as a function of indices."""

    def __init__(self, poses: Any) -> None:
        self.parts = poses if isinstance(poses, tuple) else (poses,)
        for part in self.parts:
            if not isinstance(part, np.ndarray) or part.ndim < 2:
                raise TypeError(f"poses: expected a callable or arrays of n poses, got {type(part).__name__}")

    def __len__(self) -> int:
        return len(self.parts[0])

    def __call__(self, first: int, count: int) -> Any:
        parts = tuple(part[first : first + count] for part in self.parts)
        return parts if len(parts) > 1 else parts[0]


class _Job:
    """What is the same for all chunks of a sweep: bodies, poses, query and reductions."""

    def __init__(self, a: Any, b: Any, poses: Any, count: Optional[int], reductions: tuple[Reduction, ...], query: str,
                 options: dict[str, Any]) -> None:  # fmt: skip
        self.several = isinstance(a, (list, tuple))
        if self.several != isinstance(b, (list, tuple)) or (self.several and (len(a) != len(b) or not a)):
            raise ValueError("a, b: expected two bodies, or two sequences of equally many, pair by pair")
        self.a, self.b = (list(a), list(b)) if self.several else ([a], [b])
        self.poses = poses if callable(poses) else _Given(poses)
        if count is None and not hasattr(self.poses, "__len__"):
            raise ValueError("count: a callable `poses` without a length needs it")
        self.count = len(self.poses) if count is None else _whole(count, "count")
        if self.count < 1:
            raise ValueError(f"count: expected at least one pose, got {self.count}")
        if query not in _QUERIES:
            raise ValueError(f"query: expected one of {', '.join(_QUERIES)}, got {query!r}")
        for name in _NOT_OPTIONS:
            if name in options:
                raise TypeError(f"{name}: a sweep decides it")
        self.reductions, self.query, self.options = reductions, query, options

    def made(self, first: int, count: int) -> list[Any]:
        """Poses of each pair."""
        poses = self.poses(first, count)
        if not self.several:
            return [poses]
        if len(poses) != len(self.a):
            raise ValueError(f"poses({first}, {count}): expected poses for each of {len(self.a)} pairs, got {len(poses)}")
        return list(poses)

    def rows(self, first: int, count: int, memory: Optional[list[Answers]] = None) -> tuple[Rows, list[Answers]]:
        """About the nearest pairs, and the answers, whose memory the next rows may have."""
        ask = getattr(_queries, self.query)
        if memory is None or len(memory[0]) != count:
            memory = [None] * len(self.a)  # type: ignore[list-item]
        answers: list[Answers] = []
        for a, b, poses, out in zip(self.a, self.b, self.made(first, count), memory):
            made = len(poses[0] if isinstance(poses, tuple) else poses)
            answer = ask(a, b, poses, out=out if made == count else None, **self.options)
            if answer.shape != (count,):
                raise ValueError(f"poses({first}, {count}): expected {count} poses, got {answer.shape}")
            if (refused := answer.status >= Status.INVALID_POSE).any():
                i = int(refused.argmax())
                status = Status(int(answer.status[i]))
                what = f"pose {first + i}" if status == Status.INVALID_POSE else "a or b"
                pair = f" of pair {len(answers)}" if self.several else ""
                raise ValueError(f"{what}{pair}: {status.name}, see swiftlet.Status")
            answers.append(answer)
        return _nearest(first, answers), answers

    def partial(self, first: int, count: int) -> list[Partial]:
        """Reduces poses. They are made and asked a block at a time, whatever the chunk: queries start cold at a block, and the
        rounding of a callable may depend on how many poses it makes."""
        end = first + count
        blocks: list[Rows] = []
        memory: Optional[list[Answers]] = None
        for begin in range(first, end, POSES_PER_CHUNK):
            block, memory = self.rows(begin, min(POSES_PER_CHUNK, end - begin), memory)
            blocks.append(block)
        rows = Rows(first, *(np.concatenate(columns) for columns in list(zip(*blocks))[1:]))
        return [reduction.of(rows) for reduction in self.reductions]

    def merged(self, one: list[Partial], other: list[Partial]) -> list[Partial]:
        return [reduction.merge(x, y) for reduction, x, y in zip(self.reductions, one, other)]

    def digest(self, chunk: int) -> str:
        """What a checkpoint is of. Callables have no identity that outlives a process: poses are known by their bits."""
        hashed = hashlib.sha256()
        sweep = [_VERSION, self.count, chunk, self.query, repr(sorted(self.options.items())), repr(self.reductions)]
        hashed.update(json.dumps(sweep).encode())
        for body in (*self.a, *self.b):
            hashed.update(_body_digest(body))
        blocks = -(-self.count // POSES_PER_CHUNK)
        for block in sorted({i * (blocks - 1) // (_PROBES - 1) for i in range(_PROBES)}):
            first = block * POSES_PER_CHUNK
            for poses in self.made(first, min(POSES_PER_CHUNK, self.count - first)):
                for part in poses if isinstance(poses, tuple) else (poses,):
                    hashed.update(np.ascontiguousarray(part).tobytes())
        return hashed.hexdigest()


_BY_RANK = np.array([Verdict.OVERLAPPING, Verdict.UNDECIDED, Verdict.TOUCHING, Verdict.DISJOINT], np.uint8)
_RANK = np.argsort(_BY_RANK).astype(np.uint8)  # of Verdict: the least of a pose's pairs is its verdict


def _nearest(first: int, answers: list[Answers]) -> Rows:
    lower, upper, rank = answers[0].lower, answers[0].upper, _RANK[answers[0].verdict]
    pair = np.zeros(len(lower), np.intp)
    for i, answer in enumerate(answers[1:], 1):
        pair[answer.upper < upper] = i
        lower, upper = np.minimum(lower, answer.lower), np.minimum(upper, answer.upper)
        rank = np.minimum(rank, _RANK[answer.verdict])
    # No zero has a sign, so that equal minima have equal bits.
    return Rows(first, lower + 0.0, upper + 0.0, pair, _BY_RANK[rank])


def _body_digest(body: Any) -> bytes:
    if not isinstance(body, Body):
        return f"{type(body).__name__} {body.hash()}".encode()
    held = body.model if body.model is not None else body.mesh
    return f"{body.kind} {body.radius!r} {'' if held is None else held.hash()}".encode() + body.corners.tobytes()


class _Checkpoint:
    """Which chunks are done, and what they gave: a NumPy .npz file without pickles, replaced whole."""

    def __init__(self, path: Any, digest: str, chunks: int) -> None:
        self.path, self.digest = os.path.realpath(os.fsdecode(path)), digest
        if os.path.exists(self.path) and not os.path.isfile(self.path):
            raise FileError(f"the checkpoint '{self.path}' is no regular file", ErrorCode.CANNOT_WRITE, self.path)
        self.done = np.zeros(chunks, bool)

    def load(self) -> Optional[list[Partial]]:
        if not os.path.exists(self.path):
            return None
        try:
            with zipfile.ZipFile(self.path) as archive:  # NumPy reads what a damaged header says, which may be less than all
                if damaged := archive.testzip():
                    raise ValueError(f"{damaged} is damaged")
            with np.load(self.path, allow_pickle=False) as file:
                digest, done = str(file["sweep"]), np.unpackbits(file["done"], count=len(self.done)).astype(bool)
                widths = file["widths"]
                whole = [tuple(file[f"part_{r}_{i}"] for i in range(width)) for r, width in enumerate(widths)]
        except Exception as error:  # of which kind, only the damage decides
            raise DataError(
                f"'{self.path}' is not a checkpoint of a sweep: {error}", ErrorCode.BAD_FORMAT, self.path
            ) from error
        if digest != self.digest:
            raise DataError(
                f"'{self.path}' is the checkpoint of another sweep: bodies, poses, count, chunk, query, options, reductions or "
                "version differ; give this one another file, or remove it",
                ErrorCode.BAD_VALUE,
                self.path,
            )
        self.done = done
        return whole

    def save(self, whole: Optional[list[Partial]], last: Optional[int]) -> None:
        if whole is None:
            return  # nothing is done
        if last is not None:
            self.done[last] = True
        parts = {f"part_{r}_{i}": array for r, partial in enumerate(whole) for i, array in enumerate(partial)}
        widths = np.array([len(partial) for partial in whole])
        beside = os.path.join(os.path.dirname(self.path), f"sweep-{uuid.uuid4().hex}")
        try:
            with open(beside, "xb", opener=lambda name, flags: os.open(name, flags, 0o600)) as file:
                np.savez(file, sweep=np.array(self.digest), done=np.packbits(self.done), widths=widths, **parts)
                file.flush()
                os.fsync(file.fileno())
            os.replace(beside, self.path)
        except BaseException as error:  # Ctrl-C too leaves nothing beside the checkpoint
            with suppress(OSError):
                os.remove(beside)
            if not isinstance(error, OSError):
                raise
            raise FileError(f"cannot write the checkpoint '{self.path}': {error}", ErrorCode.CANNOT_WRITE, self.path) from error


_Parts = Generator["tuple[int, list[Partial]]", None, None]


def _on_threads(job: _Job, ranges: Iterator[tuple[int, int, int]], threads: int) -> _Parts:
    with ThreadPoolExecutor(threads) as pool:
        waiting: dict[Any, int] = {}
        try:
            while True:
                while len(waiting) < _IN_FLIGHT * threads and (chunk := next(ranges, None)):
                    i, first, count = chunk
                    waiting[pool.submit(job.partial, first, count)] = i
                if not waiting:
                    return
                for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                    yield waiting.pop(future), future.result()
        finally:
            for future in waiting:
                future.cancel()


def _keep(token: str, job: _Job) -> None:
    with _jobs_change:
        _jobs[token] = job, _jobs.get(token, (job, 0))[1] + 1
        _jobs_change.notify_all()


def _drop(token: str) -> None:
    with _jobs_change:
        job, holders = _jobs.pop(token)
        if holders > 1:
            _jobs[token] = job, holders - 1


def _partial_of(token: str, first: int, count: int) -> list[Partial]:
    with _jobs_change:  # a worker that has just started may get a chunk before its job
        if not _jobs_change.wait_for(lambda: token in _jobs, _DELIVERY_SECONDS):
            raise RuntimeError(f"this worker was not told of {token} within {_DELIVERY_SECONDS} s")
        job = _jobs[token][0]
    return job.partial(first, count)


def _on_cluster(job: _Job, ranges: Iterator[tuple[int, int, int]], client: Any) -> _Parts:
    from distributed import WorkerPlugin, as_completed

    token = f"swiftlet-sweep-{uuid.uuid4().hex}"

    class Delivery(WorkerPlugin):
        """Brings the job to each worker once, those included that start later."""

        def setup(self, worker: Any) -> None:
            _keep(token, job)

        def teardown(self, worker: Any) -> None:
            _drop(token)

    client.register_worker_plugin(Delivery(), name=token)
    waiting: dict[Any, int] = {}
    completed: Any = as_completed(with_results=True)  # type: ignore[no-untyped-call]
    threads, counted = 0, -inf
    try:
        while True:
            if time.monotonic() - counted > 1:  # workers come and go
                threads, counted = max(1, sum(client.nthreads().values())), time.monotonic()
            while len(waiting) < _IN_FLIGHT * threads and (chunk := next(ranges, None)):
                i, first, count = chunk
                future = client.submit(_partial_of, token, first, count, key=f"{token}-{i}", pure=False)
                waiting[future] = i
                completed.add(future)
            if not waiting:
                return
            future, partial = next(completed)
            yield waiting.pop(future), partial
    finally:
        client.cancel(list(waiting))
        client.unregister_worker_plugin(token)


class _Bar:
    """Progress on standard error."""

    def __init__(self) -> None:
        self.began, self.at_first, self.shown = time.monotonic(), -1, -inf

    def __call__(self, done: int, count: int) -> None:
        now = time.monotonic()
        self.at_first = done if self.at_first < 0 else self.at_first
        if now - self.shown < 0.2 and done < count:
            return
        self.shown = now
        rate = (done - self.at_first) / max(now - self.began, 1e-9)
        left = f"{(count - done) / rate:.0f} s left" if rate else "?"
        bar = "#" * (30 * done // count)
        end = "\n" if done == count else ""
        sys.stderr.write(f"\r[{bar:<30}] {done / count:6.1%} of {count:.3g} poses, {rate:.3g}/s, {left}  {end}")
        sys.stderr.flush()


def sweep(
    a: Union[AnyBody, Sequence[AnyBody]],
    b: Union[AnyBody, Sequence[AnyBody]],
    poses: Any,
    reduce: Union[Reduction, tuple[Reduction, ...]],
    *,
    count: Optional[int] = None,
    query: str = "distance",
    client: Any = None,
    threads: int = 1,
    chunk: int = 65536,
    checkpoint: Optional[str | os.PathLike[str]] = None,
    every: float = 10.0,
    progress: Union[bool, Callable[[int, int], Any]] = False,
    **options: Any,
) -> Any:
    """Asks a query over any number of poses, which are made and reduced where they are asked.

    Parameters
    ----------
    a, b : Model, MeshModel or Body, or sequences of equally many
        A pair, or pairs which each pose is about. Models that are mapped go to a cluster's workers as path and hash, others as
        bytes, once to each worker.
    poses : callable, :class:`Grid`, or array
        ``poses(first, n)`` returns the poses from index `first` on, at most 1 024 at a time, in any form that queries take: of
        one pair shape (n, 4, 4), (n, 7), or a tuple (R, t); of several pairs a sequence of as many of these. It must be a
        function of the indices alone. Arrays, and tuples of two, are sent to every worker whole; with several pairs they are not
        taken.
    reduce : Reduction, or tuple of them
        :class:`Least`, :class:`Histogram`, :class:`FirstOverlap`, :class:`Verdicts`, :class:`Map`, or one's own.
    count : int, optional
        How many poses; by default ``len(poses)``.
    query : {"distance", "signed_distance", "intersects"}, optional
    client : distributed.Client, optional
        A Dask cluster, whose workers can import swiftlet. None: threads of this process.
    threads : int, optional
        Without a client.
    chunk : int, optional
        Poses of a task, a multiple of 1 024. A worker that dies loses its tasks, which others do again.
    checkpoint : path, optional
        Is read first, if there is one; is replaced, whole, each `every` seconds, at the end, and when the sweep ends by an
        exception, Ctrl-C included.
    every : float, optional
        Seconds.
    progress : bool or callable, optional
        True: a bar on standard error. A callable gets the number of poses done and `count`; returning False cancels.
    **options
        Of the query: absolute, relative, beyond, steps, finest_level, tuning, quaternion, copy.

    Returns
    -------
    object
        What `reduce` makes of all poses; a tuple if it is one. Same bits on any number of threads or workers, for any `chunk`,
        and however often workers died or the sweep was resumed.

    Raises
    ------
    TypeError, ValueError
        Arguments, or what `poses` returned, as a pose that the query refuses: it is named. The first poses are made and asked in
        this process, before any worker has them.
    DataError
        The checkpoint is of another sweep, or none. It knows poses by up to 5 blocks of 1 024 of them, evenly spread.
    FileError
        The checkpoint cannot be written.
    Cancelled
    distributed.KilledWorker
        A chunk outlived no worker, by Dask's count (``distributed.scheduler.allowed-failures``).

    Notes
    -----
    The caller holds one merged part and three chunks' parts for each worker thread; a worker 4 MB for a chunk of 65 536. A chunk
    should take from 0.1 s to 10 s: Dask's share is about a millisecond for each. Figures are in python/README.md.
    """
    reductions = reduce if isinstance(reduce, tuple) else (reduce,)
    for reduction in reductions:
        if not isinstance(reduction, Reduction):
            raise TypeError(f"reduce: expected a Reduction or a tuple of them, got {type(reduction).__name__}")
    if not reductions:
        raise ValueError("reduce: expected at least one")
    chunk, threads = _whole(chunk, "chunk"), _whole(threads, "threads")
    if chunk < 1 or chunk % POSES_PER_CHUNK:
        raise ValueError(f"chunk: expected a multiple of {POSES_PER_CHUNK}, got {chunk}")
    if threads < 1:
        raise ValueError(f"threads: expected at least 1, got {threads}")
    job = _Job(a, b, poses, count, reductions, query, options)
    job.rows(0, min(POSES_PER_CHUNK, job.count))

    chunks = -(-job.count // chunk)
    whole: Optional[list[Partial]] = None
    kept = None if checkpoint is None else _Checkpoint(checkpoint, job.digest(chunk), chunks)
    if kept:
        whole = kept.load()
    report = _Bar() if progress is True else progress
    undone = range(chunks) if kept is None else np.flatnonzero(~kept.done).tolist()
    ranges = ((i, i * chunk, min(chunk, job.count - i * chunk)) for i in undone)
    done = job.count - sum(min(chunk, job.count - i * chunk) for i in undone)
    parts = _on_threads(job, ranges, threads) if client is None else _on_cluster(job, ranges, client)
    saved = time.monotonic()
    latest: tuple[Optional[list[Partial]], Optional[int]] = whole, None  # what the chunks gave, and which of them came last
    try:
        for i, partial in parts:
            merged = partial if latest[0] is None else job.merged(latest[0], partial)
            latest = merged, i  # one store: wherever a signal comes, no chunk is counted twice
            done += min(chunk, job.count - i * chunk)
            if kept:
                kept.done[i] = True
                if time.monotonic() - saved > every:
                    kept.save(*latest)
                    saved = time.monotonic()
            go_on = report(done, job.count) if report else None
            if go_on is not None and not go_on:
                raise Cancelled("the progress callback asked to stop", ErrorCode.CANCELLED)
    finally:
        parts.close()
        if kept:
            kept.save(*latest)
    assert latest[0] is not None
    results = tuple(reduction.result(part) for reduction, part in zip(reductions, latest[0]))
    return results if isinstance(reduce, tuple) else results[0]
