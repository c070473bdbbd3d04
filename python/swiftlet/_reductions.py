# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a sweep keeps of its answers. It knows nothing of where they arise."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from ._errors import Verdict

Partial = tuple[NDArray[Any], ...]


class Rows(NamedTuple):
    """Answers of consecutive poses. Of several pairs each row is about the nearest of them.

    Attributes
    ----------
    first : int
        Index of the first pose in the sweep.
    lower, upper : ndarray of float64, shape (n,)
        Proved bounds on the least distance of all pairs.
    pair : ndarray of int64, shape (n,)
        The pair of least `upper`; the first of those that are equal.
    verdict : ndarray of uint8, shape (n,)
        A :class:`swiftlet.Verdict` on all pairs: OVERLAPPING if any pair is, else UNDECIDED, TOUCHING or DISJOINT, in this order.
    """

    first: int
    lower: NDArray[np.float64]
    upper: NDArray[np.float64]
    pair: NDArray[np.int64]
    verdict: NDArray[np.uint8]


class Reduction:
    """A function of answers that may be computed in parts, in any order.

    A subclass gives the three methods. `merge` must be associative and commutative in the bits of its result, as minima, maxima
    and sums of integers are and sums of floats are not; ties go to the least index. Its `repr` must name its parameters, since a
    checkpoint is told from another's by it; :class:`Histogram` shows how.
    """

    def of(self, rows: Rows) -> Partial:
        """Reduces consecutive rows to a tuple of arrays, of any shapes and of numeric dtypes."""
        raise NotImplementedError

    def merge(self, one: Partial, other: Partial) -> Partial:
        """Reduces two parts to one."""
        raise NotImplementedError

    def result(self, whole: Partial) -> Any:
        """What the sweep returns, of the whole."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"


class LeastDistance(NamedTuple):
    """What :class:`Least` finds: the least distance is in [`lower`, `upper`], and `upper` is that of pose `index`."""

    lower: float
    upper: float
    index: int  # type: ignore[assignment]  # a tuple has a method of this name
    pair: int


class Least(Reduction):
    """The least distance, and the pose and pair at which it is; the first of those that are equal."""

    def of(self, rows: Rows) -> Partial:
        at = int(np.argmin(rows.upper))
        return rows.lower.min(keepdims=True), rows.upper[at : at + 1], np.array([rows.first + at]), rows.pair[at : at + 1]

    def merge(self, one: Partial, other: Partial) -> Partial:
        nearer = min(one, other, key=lambda part: (part[1][0], part[2][0]))
        return np.minimum(one[0], other[0]), *nearer[1:]

    def result(self, whole: Partial) -> LeastDistance:
        lower, upper, index, pair = whole
        return LeastDistance(float(lower[0]), float(upper[0]), int(index[0]), int(pair[0]))


class Histogram(Reduction):
    """How many poses have a proved distance (the lower bound) within bins.

    Parameters
    ----------
    edges : array_like of float, shape (m,)
        Ascending. The result is an int64 array of shape (m + 1,): below ``edges[0]``, from ``edges[i]`` to below
        ``edges[i + 1]``, and from ``edges[-1]`` on.
    """

    def __init__(self, edges: Sequence[float]) -> None:
        self.edges = np.asarray(edges, np.float64)
        if self.edges.ndim != 1 or not len(self.edges) or not np.all(np.diff(self.edges) > 0) or np.isnan(self.edges).any():
            raise ValueError(f"edges: expected one or more ascending numbers, got {edges!r}")

    def of(self, rows: Rows) -> Partial:
        bins = np.searchsorted(self.edges, rows.lower, side="right")
        return (np.bincount(bins, minlength=len(self.edges) + 1),)

    def merge(self, one: Partial, other: Partial) -> Partial:
        return (one[0] + other[0],)

    def result(self, whole: Partial) -> NDArray[np.int64]:
        return whole[0]

    def __repr__(self) -> str:
        return f"Histogram({self.edges.tolist()})"


class FirstOverlap(Reduction):
    """The least index of a pose that is proved to overlap; None if there is none."""

    def of(self, rows: Rows) -> Partial:
        at = np.flatnonzero(rows.verdict == Verdict.OVERLAPPING)[:1]
        return (at + rows.first,)

    def merge(self, one: Partial, other: Partial) -> Partial:
        return (np.sort(np.concatenate([one[0], other[0]]))[:1],)

    def result(self, whole: Partial) -> Optional[int]:
        return int(whole[0][0]) if len(whole[0]) else None


class Verdicts(Reduction):
    """How many poses have each verdict: a dict of :class:`swiftlet.Verdict` to int."""

    def of(self, rows: Rows) -> Partial:
        return (np.bincount(rows.verdict, minlength=len(Verdict)),)

    def merge(self, one: Partial, other: Partial) -> Partial:
        return (one[0] + other[0],)

    def result(self, whole: Partial) -> dict[Verdict, int]:
        return {verdict: int(whole[0][verdict]) for verdict in Verdict}


class Map(Reduction):
    """The least distance within each cell of consecutive poses; of a grid the innermost axes are a cell.

    Parameters
    ----------
    per : int
        Poses in a cell; cell c holds those from ``c * per`` on. The result is a structured array over the cells: lower, upper,
        index and pair as :class:`LeastDistance` has them, `free` and `overlapping` (poses that are proved to be) and `count`:
        56 bytes a cell, in the caller's memory.
    """

    _FIELDS = [("lower", "f8"), ("upper", "f8"), *((name, "i8") for name in ("index", "pair", "free", "overlapping", "count"))]

    def __init__(self, per: int) -> None:
        if per < 1:
            raise ValueError(f"per: expected at least 1, got {per}")
        self.per = int(per)

    def of(self, rows: Rows) -> Partial:
        index = np.arange(rows.first, rows.first + len(rows.lower))
        free, over = rows.verdict == Verdict.DISJOINT, rows.verdict == Verdict.OVERLAPPING
        counts = np.stack([free, over, np.ones_like(free)], axis=1).astype(np.int64)
        return self._per_cell(index // self.per, rows.lower, rows.upper, index, rows.pair, counts)

    def merge(self, one: Partial, other: Partial) -> Partial:
        return self._per_cell(*(np.concatenate(both) for both in zip(one, other)))

    def result(self, whole: Partial) -> NDArray[np.void]:
        cell, lower, upper, index, pair, counts = whole
        cells = np.empty(len(cell), self._FIELDS)
        for name, column in zip(cells.dtype.names or (), (lower, upper, index, pair, *counts.T)):
            cells[name] = column
        return cells

    def _per_cell(self, cell: Any, lower: Any, upper: Any, index: Any, pair: Any, counts: Any) -> Partial:
        order = np.lexsort((index, upper, cell))
        begin = np.flatnonzero(np.diff(cell[order], prepend=-1))
        nearest = order[begin]
        lowest = np.minimum.reduceat(lower[order], begin)
        return cell[nearest], lowest, upper[nearest], index[nearest], pair[nearest], np.add.reduceat(counts[order], begin)

    def __repr__(self) -> str:
        return f"Map({self.per})"
