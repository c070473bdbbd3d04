# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Queries over poses. Laws are those of LAWS.md; the algorithm is [Ehmann & Lin 2000], of depths also [van den Bergen 2001]."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _runtime
from ._answers import Answers, Check, ClosestFeatures, Contacts, Manifold, Sources, Trace
from ._errors import PlaneRule, Refinement, StartPolicy, Status
from ._runtime import Body, MeshModel, Model, Seeds

AnyBody = Union[Model, MeshModel, Body]
Poses = Union[NDArray[np.float64], "tuple[NDArray[np.float64], NDArray[np.float64]]"]


@dataclass
class Tuning:
    """Settings for experts: how a query proceeds. The answer is true with any.

    Attributes
    ----------
    start : StartPolicy
    refinement : Refinement
    plane_rule : PlaneRule
    careful : bool
        Prove bounds by support vertices and certified GJK even where the walk's own tests do.
    """

    start: int = StartPolicy.AUTOMATIC
    refinement: int = Refinement.SINGLE_SINGLE
    plane_rule: int = PlaneRule.MOST_VIOLATED
    careful: bool = False


_PARAMETERS = """a, b : Model, MeshModel or Body
        With `index_a` or `index_b` a sequence of them.
    poses : ndarray of float64, or tuple of two
        Maps B's frame into A's: p_a = R p_b + t. Of shape (4, 4) or (n, 4, 4); a tuple (R, t) of shapes (3, 3) or (n, 3, 3) and
        (3,) or (n, 3); or (7,) or (n, 7), translation and quaternion, whose order `quaternion` names. Any strides; never
        copied. A pose that is not finite or not orthonormal to 1e-6 has the status INVALID_POSE in its row."""

_STEPS = """steps : int, optional
        At most so many changes of feature; then the status is BUDGET and the interval true."""

_BUDGET = f"""{_STEPS}
    finest_level : int, optional
        No level finer is read; then the status is LEVEL_LIMIT."""

_COMMON = """tuning : Tuning, optional
    index_a, index_b : array_like of int, shape (n,), optional
        Which body of the sequence each row is about. Rows then start cold, unless they have seeds.
    seeds : Seeds, optional
        A warm start for each row, which is read and renewed. Without them a row starts from the one before, and each
        1 024th cold: consecutive poses should be near.
    threads : int, optional
        1 to 1 024. Answers are the same bits on any number.
    quaternion : {None, "xyzw", "wxyz"}, optional
    copy : bool, optional
        Convert other dtypes and sequences, instead of refusing them."""

_OUT = """out : Answers, optional
        Of the same query and number of rows: written again, and returned. New memory costs a row about a sixth of a warm
        query, and the second thread more. Arrays taken from it before change with it; after Ctrl-C some rows are new."""

_RAISES = """TypeError, ValueError
        Arguments of another kind, dtype or shape; the message says what came and what is wanted.
    KeyboardInterrupt
        Ctrl-C ends a batch within 100 ms, or when the queries that were begun have ended; its answers are dropped, seeds are
        valid as ever."""

_ERRORS = """absolute : float, optional
        Stop when ``upper - lower <= max(absolute, relative * (the bound nearer to 0))``; the bodies' unit. 0: exact, within `tolerance`.
    relative : float, optional
        A fraction of the bound nearer to 0.
    beyond : float, optional
        Stop when ``lower > beyond``, with the status BEYOND.
    """


def _documented(function: Any) -> Any:
    parts = {
        "PARAMETERS": _PARAMETERS,
        "ERRORS": _ERRORS,
        "STEPS": _STEPS,
        "BUDGET": _BUDGET,
        "COMMON": _COMMON,
        "OUT": _OUT,
        "RAISES": _RAISES,
    }
    for name, text in parts.items():
        function.__doc__ = function.__doc__.replace(f"<{name}>", text.rstrip())
    return function


def _ask(query: str, a: Any, b: Any, poses: Any, threshold: float = 0.0, **options: Any) -> Any:
    defaults: dict[str, Any] = {"absolute": 0.0, "relative": 0.0, "beyond": inf, "finest_level": 0, "out": None}
    return _runtime.run_query(query, a, b, poses, threshold, **{**defaults, **options})


def _answers(query: str, *arguments: Any, out: Optional[Answers], **options: Any) -> Answers:
    if out is None:
        return Answers(_ask(query, *arguments, **options))
    if not isinstance(out, Answers):
        raise TypeError(f"out: expected Answers, got {type(out).__name__}")
    _ask(query, *arguments, out=out.records, **options)
    return out


@_documented
def distance(
    a: AnyBody | Sequence[AnyBody],
    b: AnyBody | Sequence[AnyBody],
    poses: Poses,
    *,
    absolute: float = 0.0,
    relative: float = 0.0,
    beyond: float = inf,
    steps: Optional[int] = None,
    finest_level: int = 0,
    tuning: Optional[Tuning] = None,
    index_a: Any = None,
    index_b: Any = None,
    seeds: Optional[Seeds] = None,
    threads: int = 1,
    quaternion: Optional[str] = None,
    copy: bool = False,
    out: Optional[Answers] = None,
) -> Answers:
    """Distances between two bodies, as proved intervals.

    Parameters
    ----------
    <PARAMETERS>
    <ERRORS>
    <BUDGET>
    <COMMON>
    <OUT>

    Returns
    -------
    Answers
        ``lower <= true distance <= upper``, always. Of bodies that overlap both are 0, and the normal is NaN.

    Raises
    ------
    <RAISES>

    Notes
    -----
    C++: ``distance`` of query.h, mesh_query.h and batch.h, with the same bits. Source: [Ehmann & Lin 2000].
    """
    return _answers(
        "distance", a, b, poses, absolute=absolute, relative=relative, beyond=beyond, steps=steps, finest_level=finest_level,
        tuning=tuning, index_a=index_a, index_b=index_b, seeds=seeds, threads=threads, quaternion=quaternion, copy=copy,
        out=out,
    )  # fmt: skip


@_documented
def signed_distance(
    a: AnyBody | Sequence[AnyBody],
    b: AnyBody | Sequence[AnyBody],
    poses: Poses,
    *,
    absolute: float = 0.0,
    relative: float = 0.0,
    beyond: float = inf,
    steps: Optional[int] = None,
    finest_level: int = 0,
    tuning: Optional[Tuning] = None,
    index_a: Any = None,
    index_b: Any = None,
    seeds: Optional[Seeds] = None,
    threads: int = 1,
    quaternion: Optional[str] = None,
    copy: bool = False,
    out: Optional[Answers] = None,
) -> Answers:
    """Signed distances: apart the distance, else minus the depth, the least translation that separates.

    Parameters
    ----------
    <PARAMETERS>
    <ERRORS>
    <BUDGET>
    <COMMON>
    <OUT>

    Returns
    -------
    Answers
        Where bodies overlap, moving B by ``-lower`` along `normal` separates them. Of meshes the interval of a depth is what
        can be proved, and the status NOT_CONVERGED where it is wider than asked.

    Raises
    ------
    <RAISES>

    Notes
    -----
    C++: ``signed_distance`` of depth.h, mesh_query.h and batch.h. Source: [van den Bergen 2001].
    """
    return _answers(
        "signed_distance", a, b, poses, absolute=absolute, relative=relative, beyond=beyond, steps=steps,
        finest_level=finest_level, tuning=tuning, index_a=index_a, index_b=index_b, seeds=seeds, threads=threads,
        quaternion=quaternion, copy=copy, out=out,
    )  # fmt: skip


@_documented
def intersects(
    a: AnyBody | Sequence[AnyBody],
    b: AnyBody | Sequence[AnyBody],
    poses: Poses,
    *,
    steps: Optional[int] = None,
    finest_level: int = 0,
    tuning: Optional[Tuning] = None,
    index_a: Any = None,
    index_b: Any = None,
    seeds: Optional[Seeds] = None,
    threads: int = 1,
    quaternion: Optional[str] = None,
    copy: bool = False,
    out: Optional[Answers] = None,
) -> Answers:
    """Whether two bodies share a point: read `verdict`.

    Parameters
    ----------
    <PARAMETERS>
    <BUDGET>
    <COMMON>
    <OUT>

    Returns
    -------
    Answers
        `verdict` is DISJOINT, TOUCHING (within `tolerance` of it) or OVERLAPPING, each proved.

    Raises
    ------
    <RAISES>

    Notes
    -----
    C++: ``intersects`` of query.h, mesh_query.h and batch.h. Ends at the first level pair that is proved disjoint.
    """
    return _answers(
        "intersects", a, b, poses, steps=steps, finest_level=finest_level, tuning=tuning, index_a=index_a, index_b=index_b,
        seeds=seeds, threads=threads, quaternion=quaternion, copy=copy, out=out,
    )  # fmt: skip


@_documented
def within(
    a: AnyBody | Sequence[AnyBody],
    b: AnyBody | Sequence[AnyBody],
    poses: Poses,
    threshold: float,
    *,
    steps: Optional[int] = None,
    finest_level: int = 0,
    tuning: Optional[Tuning] = None,
    index_a: Any = None,
    index_b: Any = None,
    seeds: Optional[Seeds] = None,
    threads: int = 1,
    quaternion: Optional[str] = None,
    copy: bool = False,
    out: Optional[Answers] = None,
) -> Answers:
    """Whether the distance is at most `threshold`: read `decision`.

    Parameters
    ----------
    <PARAMETERS>
    threshold : float
        At least 0, in the bodies' unit.
    <BUDGET>
    <COMMON>
    <OUT>

    Returns
    -------
    Answers
        `decision` is YES or NO, each proved, or UNDECIDED within `tolerance` of the threshold.

    Raises
    ------
    <RAISES>

    Notes
    -----
    C++: ``within`` of query.h, mesh_query.h and batch.h. Ends at the first level pair that decides.
    """
    return _answers(
        "within", a, b, poses, threshold, steps=steps, finest_level=finest_level, tuning=tuning, index_a=index_a,
        index_b=index_b, seeds=seeds, threads=threads, quaternion=quaternion, copy=copy, out=out,
    )  # fmt: skip


@_documented
def signed_within(
    a: AnyBody | Sequence[AnyBody],
    b: AnyBody | Sequence[AnyBody],
    poses: Poses,
    threshold: float,
    *,
    steps: Optional[int] = None,
    finest_level: int = 0,
    tuning: Optional[Tuning] = None,
    index_a: Any = None,
    index_b: Any = None,
    seeds: Optional[Seeds] = None,
    threads: int = 1,
    quaternion: Optional[str] = None,
    copy: bool = False,
    out: Optional[Answers] = None,
) -> Answers:
    """Whether the signed distance is at most `threshold`; below 0 whether the depth is at least ``-threshold``.

    Parameters
    ----------
    <PARAMETERS>
    threshold : float
        Of either sign, in the bodies' unit.
    <BUDGET>
    <COMMON>
    <OUT>

    Returns
    -------
    Answers
        `decision` is YES or NO, each proved, or UNDECIDED.

    Raises
    ------
    <RAISES>

    Notes
    -----
    C++: ``signed_within`` of depth.h, mesh_query.h and batch.h.
    """
    return _answers(
        "signed_within", a, b, poses, threshold, steps=steps, finest_level=finest_level, tuning=tuning, index_a=index_a,
        index_b=index_b, seeds=seeds, threads=threads, quaternion=quaternion, copy=copy, out=out,
    )  # fmt: skip


@_documented
def closest_features(
    a: AnyBody | Sequence[AnyBody],
    b: AnyBody | Sequence[AnyBody],
    poses: Poses,
    *,
    beyond: float = inf,
    steps: Optional[int] = None,
    tuning: Optional[Tuning] = None,
    index_a: Any = None,
    index_b: Any = None,
    seeds: Optional[Seeds] = None,
    threads: int = 1,
    quaternion: Optional[str] = None,
    copy: bool = False,
) -> ClosestFeatures:
    """The nearest vertices, edges and faces by the user's own ids, with the exact distance.

    Parameters
    ----------
    <PARAMETERS>
    beyond : float, optional
        Stop when ``lower > beyond``.
    <STEPS>
    <COMMON>

    Returns
    -------
    ClosestFeatures

    Raises
    ------
    <RAISES>

    Notes
    -----
    C++: ``closest_features`` of query.h, mesh_query.h and batch.h.
    """
    records, source_a, source_b = _ask(
        "closest_features", a, b, poses, beyond=beyond, steps=steps, tuning=tuning, index_a=index_a, index_b=index_b, seeds=seeds,
        threads=threads, quaternion=quaternion, copy=copy,
    )  # fmt: skip
    return ClosestFeatures(Answers(records), Sources(*source_a), Sources(*source_b))


def _record(answer: Any) -> Any:
    if isinstance(answer, Answers):
        answer = answer.records
    elif isinstance(answer, _runtime.Answer):
        answer = answer.record
    if isinstance(answer, np.void):  # one row of an array
        answer = np.asarray(answer, answer.dtype)
    if isinstance(answer, np.ndarray) and answer.dtype == _runtime.within_dtype():
        names = _runtime.answer_dtype()
        plain = np.empty(answer.shape, names)
        for name in names.names or ():
            plain[name] = answer[name]
        return plain
    return answer


@_documented
def refine(
    a: AnyBody,
    b: AnyBody,
    poses: Poses,
    so_far: Answers | _runtime.Answer,
    *,
    absolute: float = 0.0,
    relative: float = 0.0,
    beyond: float = inf,
    steps: Optional[int] = None,
    finest_level: int = 0,
    tuning: Optional[Tuning] = None,
    threads: int = 1,
    quaternion: Optional[str] = None,
    copy: bool = False,
) -> Answers:
    """Continues distances of convex bodies from answers about the same bodies and poses, for the work still missing.

    Parameters
    ----------
    <PARAMETERS>
    so_far : Answers
        Of any query, row by row. Their bounds are trusted.
    <ERRORS>
    steps, finest_level, tuning, threads, quaternion, copy : optional
        As :func:`distance` has them.

    Returns
    -------
    Answers
        `steps` and `plane_tests` count this call alone.

    Raises
    ------
    <RAISES>

    Notes
    -----
    C++: ``refine`` of query.h.
    """
    return Answers(
        _runtime.run_refine(
            a, b, poses, _record(so_far), absolute, relative, beyond, steps, finest_level, tuning, threads, quaternion, copy
        )
    )


@_documented
def tolerance(
    a: AnyBody, b: AnyBody, poses: Poses, *, quaternion: Optional[str] = None, copy: bool = False
) -> NDArray[np.float64]:
    """Law 2's bound: the interval of an exact answer is no wider.

    Parameters
    ----------
    <PARAMETERS>
    quaternion, copy : optional
        As :func:`distance` has them.

    Returns
    -------
    ndarray of float64
        Of the poses' leading shape, in the bodies' unit; NaN where a query refuses the bodies or the pose.
    """
    return _runtime.run_tolerance(a, b, poses, quaternion, copy)[()]


def check(
    a: AnyBody,
    b: AnyBody,
    pose: Poses,
    answer: Answers | _runtime.Answer,
    *,
    exact: bool = False,
    quaternion: Optional[str] = None,
    copy: bool = False,
) -> Check:
    """Recomputes by brute force what one answer claims.

    Parameters
    ----------
    a, b : Model, MeshModel or Body
    pose : ndarray of float64, or tuple of two
        One, as :func:`distance` takes it.
    answer : Answers of shape (), or Answer
    exact : bool, default False
        An exact distance or signed distance of convex bodies was asked for: that the interval is within :func:`tolerance`, and
        the points the nearest, is checked too.
    quaternion, copy : optional
        As :func:`distance` has them.

    Returns
    -------
    Check
        True in a condition if the certificate holds; `message` says what failed first.

    Notes
    -----
    Linear in vertices and faces; of meshes about 1 microsecond for each pair of triangles. C++: check.h, mesh_query.h.
    """
    message = _runtime.run_check(a, b, pose, _record(answer), exact, quaternion, copy)
    return Check(not message, message)


def verify(model: Model | MeshModel) -> Check:
    """Proves exactly all that a model or mesh claims: convexity, enclosure, deviations, boxes, hulls.

    Parameters
    ----------
    model : Model or MeshModel

    Returns
    -------
    Check
        True in a condition if all holds; `message` says what failed first. False if level 0 is absent.
    """
    message = _runtime.verify(model)
    return Check(not message, message)


def trace(
    query: str,
    a: AnyBody,
    b: AnyBody,
    pose: Poses,
    *,
    threshold: float = 0.0,
    absolute: float = 0.0,
    relative: float = 0.0,
    beyond: float = inf,
    steps: Optional[int] = None,
    finest_level: int = 0,
    tuning: Optional[Tuning] = None,
    quaternion: Optional[str] = None,
    copy: bool = False,
) -> Trace:
    """Asks one query of convex bodies from a cold start, and tells the level pairs that it visited and what each cost.

    Parameters
    ----------
    query : str
        "distance", "signed_distance", "intersects", "within", "signed_within" or "closest_features".
    a, b : Model or Body
    pose : ndarray of float64, or tuple of two
        One, as :func:`distance` takes it.
    threshold : float, optional
        Of `within` and `signed_within`.
    absolute, relative, beyond, steps, finest_level, tuning, quaternion, copy : optional
        As :func:`distance` has them.

    Returns
    -------
    Trace
    """
    record, levels, proof = _runtime.run_trace(
        query, a, b, pose, threshold, absolute, relative, beyond, steps, finest_level, tuning, quaternion, copy
    )
    return Trace(Answers(record), levels, proof)


def contacts(
    a: AnyBody,
    b: AnyBody,
    pose: Poses,
    reach: float,
    *,
    most: int = 64,
    steps: Optional[int] = None,
    quaternion: Optional[str] = None,
    copy: bool = False,
) -> Contacts:
    """Every region where two bodies, meshes or not, come within `reach` of each other, nearest first.

    Parameters
    ----------
    a, b : Model, MeshModel or Body
    pose : ndarray of float64, or tuple of two
        One, as :func:`distance` takes it.
    reach : float
        At least 0, in the bodies' unit.
    most : int, optional
        At most so many regions are kept, the nearest ones.
    steps : int, optional
        A budget of pairs of nodes and of triangles.
    quaternion, copy : optional
        As :func:`distance` has them.

    Returns
    -------
    Contacts

    Notes
    -----
    0.1 to 0.3 microseconds for each pair of triangles within reach. C++: mesh_contacts.h, which says what a region is.
    """
    status, is_counted, count, work, tests, regions = _runtime.run_contacts(a, b, pose, reach, most, steps, quaternion, copy)
    return Contacts(regions, Status(status), is_counted, count, work, tests)


def manifold(
    a: AnyBody,
    b: AnyBody,
    pose: Poses,
    answer: Any,
    *,
    margin: float = 0.0,
    most_points: int = 4,
    flatness: float = 2.0**-21,
    previous: Optional[Manifold] = None,
    quaternion: Optional[str] = None,
    copy: bool = False,
) -> Manifold:
    """The few points in which two bodies touch, around the nearest or deepest features of an answer.

    Parameters
    ----------
    a, b : Model, MeshModel or Body
    pose : ndarray of float64, or tuple of two
        One, as :func:`distance` takes it.
    answer : Answers of shape (), Answer, or a row of ``Contacts.regions``
        Exact, about these bodies in this pose. Of meshes a region.
    margin : float, optional
        Points of a separation above it plus `tolerance` are left out; the bodies' unit.
    most_points : int, optional
        1 to 8.
    flatness : float, optional
        Faces within this height, relative to the extent, of the contact face are merged into it.
    previous : Manifold, optional
        This pair's last one: a pair at rest keeps its points.
    quaternion, copy : optional
        As :func:`distance` has them.

    Returns
    -------
    Manifold
        Without points where the bodies are farther apart than `margin`, or the answer has no normal.

    Notes
    -----
    C++: manifold.h, mesh_contacts.h.
    """
    if not (previous is None or isinstance(previous, Manifold)):
        raise TypeError(f"previous: expected a Manifold, got {type(previous).__name__}")
    before = None if previous is None else tuple(previous)
    parts = _runtime.run_manifold(a, b, pose, _record(answer), margin, most_points, flatness, before, quaternion, copy)
    return Manifold(*parts)


def relative(
    a_in_world: Poses, b_in_world: Poses, *, quaternion: Optional[str] = None, copy: bool = False
) -> NDArray[np.float64]:
    """Poses of B in A's frame, from both poses in the world.

    Parameters
    ----------
    a_in_world, b_in_world : ndarray of float64, or tuple of two
        As :func:`distance` takes them; one of many, or as many as the other has.
    quaternion, copy : optional
        As :func:`distance` has them.

    Returns
    -------
    ndarray of float64, shape (4, 4) or (n, 4, 4)
        Translations are subtracted first, so a common one that is exact changes no bit; A's rotation is inverted.
    """
    return _runtime.run_relative(a_in_world, b_in_world, quaternion, copy)


def inverse(poses: Poses, *, quaternion: Optional[str] = None, copy: bool = False) -> NDArray[np.float64]:
    """The poses that undo `poses`, as matrices; each rotation is the matrix inverse."""
    return _runtime.run_inverse(poses, quaternion, copy)


def matrix(poses: Poses, *, quaternion: Optional[str] = None, copy: bool = False) -> NDArray[np.float64]:
    """Poses of any form as matrices.

    A quaternion that is not unit, or a last row that is not (0, 0, 0, 1), has a translation of NaN; all others stay what they
    are, those that queries refuse too.
    """
    return _runtime.run_matrix(poses, quaternion, copy)
