# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Answers as objects of arrays."""

from __future__ import annotations

from typing import Any, Iterator, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _runtime
from ._errors import Decision, FeatureKind, Status, Verdict

_ANSWER = _runtime.answer_dtype()
_WITHIN = _runtime.within_dtype()


class Answers:
    """What a query found in each pose: arrays over the rows that were asked.

    The leading shape S of every array is that of the poses: () for one of shape (4, 4), (n,) for (n, 4, 4). Arrays are strided
    views of `records`, which holds the library's answers as they are; indexing and iterating give answers of fewer rows. Points
    and directions are in A's frame, lengths in the bodies' unit. A number that means nothing is NaN.

    Attributes
    ----------
    records : ndarray
        Structured, of shape S, 128 bytes a row, 136 of `within`.
    """

    __slots__ = ("records",)

    def __init__(self, records: NDArray[np.void]) -> None:
        if not isinstance(records, np.ndarray) or records.dtype not in (_ANSWER, _WITHIN):
            raise TypeError(f"records: expected an array of answers, got {type(records).__name__}")
        self.records = records

    @property
    def lower(self) -> NDArray[np.float64]:
        """Proved lower bound on the distance, or the signed distance, S."""
        return self.records["lower"][()]

    @property
    def upper(self) -> NDArray[np.float64]:
        """Proved upper bound, S; infinite where nothing is known."""
        return self.records["upper"][()]

    @property
    def value(self) -> NDArray[np.float64]:
        """Middle of the interval, S: at most half its width from the truth; NaN if a bound is infinite."""
        known = np.isfinite(self.lower) & np.isfinite(self.upper)
        with np.errstate(invalid="ignore"):
            return np.where(known, self.lower + (self.upper - self.lower) / 2, np.nan)[()]

    @property
    def normal(self) -> NDArray[np.float64]:
        """Unit direction from A to B whose gap proves `lower`, S + (3,); NaN where none is known."""
        return self.records["normal"]

    @property
    def point_a(self) -> NDArray[np.float64]:
        """Witness point of A, in A's frame, S + (3,): nearest to B, or deepest inside."""
        return self.records["point_a"]

    @property
    def point_b(self) -> NDArray[np.float64]:
        """Witness point of B, in A's frame, S + (3,): `point_a` + distance * `normal`."""
        return self.records["point_b"]

    @property
    def status(self) -> NDArray[np.uint8]:
        """How the query ended, S: a :class:`Status`. A bad pose is INVALID_POSE in its row."""
        return self.records["status"][()]

    @property
    def verdict(self) -> NDArray[np.uint8]:
        """What is proved, S: a :class:`Verdict`."""
        return self.records["verdict"][()]

    @property
    def decision(self) -> NDArray[np.uint8]:
        """Whether the distance is at most the threshold, S: a :class:`Decision`; of `within` and `signed_within` alone."""
        if self.records.dtype != _WITHIN:
            raise AttributeError("decision: answers of `within` and `signed_within` have one")
        return self.records["decision"][()]

    @property
    def is_signed(self) -> NDArray[np.bool_]:
        """True where the bounds are of the signed distance, S."""
        return self.records["is_signed"][()]

    @property
    def feature_a(self) -> NDArray[np.uint32]:
        """Id of the feature of A that holds `point_a`, S: see :func:`feature_kind` and :func:`feature_index`."""
        return self.records["feature_a"][()]

    @property
    def feature_b(self) -> NDArray[np.uint32]:
        """Id of the feature of B that holds `point_b`, S."""
        return self.records["feature_b"][()]

    @property
    def level_a(self) -> NDArray[np.int16]:
        """The level of A that answered, S."""
        return self.records["level_a"][()]

    @property
    def level_b(self) -> NDArray[np.int16]:
        """The level of B that answered, S."""
        return self.records["level_b"][()]

    @property
    def levels_visited(self) -> NDArray[np.uint8]:
        """Number of level pairs visited, S."""
        return self.records["levels_visited"][()]

    @property
    def steps(self) -> NDArray[np.uint32]:
        """Work, S: changes of feature; of meshes pairs of nodes opened."""
        return self.records["steps"][()]

    @property
    def plane_tests(self) -> NDArray[np.uint32]:
        """Work, S: planes and supports evaluated; of meshes pairs of triangles."""
        return self.records["plane_tests"][()]

    @property
    def radius_a(self) -> NDArray[np.float64]:
        """A's radius, S."""
        return self.records["radius_a"][()]

    @property
    def radius_b(self) -> NDArray[np.float64]:
        """B's radius, S."""
        return self.records["radius_b"][()]

    @property
    def shape(self) -> tuple[int, ...]:
        """S: () or (n,)."""
        return self.records.shape

    def __len__(self) -> int:
        return len(self.records)

    def __getitem__(self, rows: Any) -> Answers:
        chosen = self.records[rows]
        if chosen.dtype != self.records.dtype:
            raise TypeError(f"expected rows, got {rows!r}: fields are attributes, and columns of `records`")
        return Answers(np.asarray(chosen))

    def __iter__(self) -> Iterator[Answers]:
        return (self[i] for i in range(len(self)))

    def __reduce__(self) -> tuple[Any, ...]:
        return Answers, (self.records,)

    def __repr__(self) -> str:
        return describe(self)


def describe(answer: Any) -> str:
    """One line about an answer, or many."""
    if isinstance(answer, Answers) and answer.shape:
        counts = ", ".join(
            f"{count} {Verdict(v).name.lower()}" for v, count in zip(*np.unique(answer.verdict, return_counts=True))
        )
        return f"<swiftlet.Answers: {len(answer)} rows, {counts or 'none'}>"
    status, verdict = Status(answer.status), Verdict(answer.verdict)
    kind = "signed distance" if answer.is_signed else "distance"
    return (
        f"<swiftlet answer: {verdict.name.lower()}, {kind} in [{answer.lower:.17g}, {answer.upper:.17g}], "
        f"{status.name.lower()}>"
    )


class Sources(NamedTuple):
    """The nearest features of one side by the user's own ids.

    Attributes
    ----------
    kind : ndarray of uint8, shape (n,)
        A :class:`FeatureKind`; NONE where the answer is not on level 0.
    vertices : ndarray of uint32, shape (n, 2)
        The vertex, or both ends of the edge; 2**32 - 1 where there is none.
    begin : ndarray of int64, shape (n + 1,)
        Row i's triangles are ``triangles[begin[i]:begin[i + 1]]``.
    triangles : ndarray of uint32
        Of a face the user's triangles, none or several.
    """

    kind: NDArray[np.uint8]
    vertices: NDArray[np.uint32]
    begin: NDArray[np.int64]
    triangles: NDArray[np.uint32]


class ClosestFeatures(NamedTuple):
    """What :func:`closest_features` found: exact answers on level 0, and the features of both sides."""

    answers: Answers
    source_a: Sources
    source_b: Sources


class Contacts(NamedTuple):
    """What :func:`contacts` found.

    Attributes
    ----------
    regions : ndarray
        Structured, nearest first: lower, upper, normal, point_a, point_b, verdict, feature_a, feature_b, triangle_a,
        triangle_b, box_min, box_max.
    status : Status
        CONVERGED: all regions are here. BUDGET: not all are. LEVEL_LIMIT: a mesh was cut, and none are here, or a convex
        model lacks level 0: those of its finest level are here, and some may be none of the body.
    is_counted : bool
        `count` is the number of regions.
    count : int
        Regions in all; unless `is_counted` as many as were told apart.
    steps, plane_tests : int
        Pairs of nodes opened, and pairs of triangles looked at.
    """

    regions: NDArray[np.void]
    status: Status
    is_counted: bool
    count: int  # type: ignore[assignment]  # a tuple has a method of this name
    steps: int
    plane_tests: int


class Manifold(NamedTuple):
    """A few points that stand for the area in which two bodies touch, in A's frame.

    Attributes
    ----------
    normal : ndarray, shape (3,)
        Unit, from A to B.
    face_a, face_b : int
        Ids of the contact faces; 0 where a body has no faces.
    points : ndarray, shape (k,)
        Structured: point_a, point_b, separation, feature_a, feature_b; the one of least separation first.
    """

    normal: NDArray[np.float64]
    face_a: int
    face_b: int
    points: NDArray[np.void]


class Trace(NamedTuple):
    """What :func:`trace` saw.

    Attributes
    ----------
    answer : Answers
        Of shape ().
    levels : ndarray, shape (k,)
        Structured, one row for each level pair visited: level_a, level_b, lower, upper, steps, plane_tests, doubt.
    proof : ndarray of uint32, shape (p, 2)
        Up to four pairs of vertices that prove an overlap; none where the answer does not rest on such a proof.
    """

    answer: Answers
    levels: NDArray[np.void]
    proof: NDArray[np.uint32]


class Check(NamedTuple):
    """Whether a certificate holds, and what failed first; true in a condition if it holds."""

    ok: bool
    message: str

    def __bool__(self) -> bool:
        return self.ok


def feature_kind(ids: Any) -> Any:
    """The kinds of feature ids: :class:`FeatureKind` of one, uint8 of an array."""
    kinds = np.asarray(ids, np.uint32) >> 30
    return kinds.astype(np.uint8) if kinds.shape else FeatureKind(int(kinds))


def feature_index(ids: Any) -> Any:
    """The indices of feature ids within their kind, on their level: int of one, uint32 of an array."""
    indices = np.asarray(ids, np.uint32) & np.uint32(0x3FFFFFFF)
    return indices if indices.shape else int(indices)
