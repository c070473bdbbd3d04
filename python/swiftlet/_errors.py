# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and enumerations. The values of the enumerations are the library's."""

from __future__ import annotations

from enum import IntEnum
from typing import Any


class ErrorCode(IntEnum):
    """The kind of an :class:`Error`."""

    CANNOT_READ = 0  #: the file is missing or unreadable
    CANNOT_WRITE = 1  #: the file cannot be created or the disk is full; nothing half-written is left
    BAD_FORMAT = 2  #: the data are not in the format expected, or damaged
    BAD_VERSION = 3  #: a format version that this library does not read
    BAD_VALUE = 4  #: an option or a number out of its range; a non-finite coordinate
    EMPTY = 5  #: there are no points
    NOT_CONVEX = 6  #: a reflex edge, or faces that do not close to one convex surface
    NOT_SOLID = 7  #: flat, collinear or a single point where a solid was required
    NOT_ENCLOSING = 8  #: a coarser level does not enclose level 0
    TOO_LARGE = 9  #: more features than 30-bit feature ids can name, or more than the format or machine holds
    CANCELLED = 10  #: the progress callback asked to stop


class Error(Exception):
    """What goes wrong where data enter: files, arrays, options. Queries never raise it; they have a status.

    Attributes
    ----------
    code : ErrorCode
        For the program.
    file : str
        Path of the file at fault; empty if no file is.
    """

    def __init__(self, message: str, code: int = ErrorCode.BAD_VALUE, file: str = "") -> None:
        super().__init__(message)
        self.code = ErrorCode(code)
        self.file = file

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), int(self.code), self.file)


class FileError(Error, OSError):
    """A file that cannot be read or written; also an :class:`OSError`."""


class DataError(Error, ValueError):
    """Data or an option that is refused, with one sentence on what is wrong; also a :class:`ValueError`."""


class Cancelled(Error):
    """The progress callback returned False."""


class Status(IntEnum):
    """How a query ended."""

    NOT_ASKED = 0  #: no query has written this answer: nothing is known
    CONVERGED = 1  #: the interval is as narrow as asked, or the verdict is proved
    BEYOND = 2  #: stopped early because lower > beyond
    BUDGET = 3  #: the query used up its steps; the interval is true
    LEVEL_LIMIT = 4  #: a level that the tolerance needs is absent or finer than allowed; the interval is true
    NOT_CONVERGED = 5  #: the interval is true but wider than asked: depths of meshes, needles and plates
    INVALID_POSE = 6  #: not finite, translates beyond 1e45 or not orthonormal to 1e-6: nothing is known
    INVALID_RADIUS = 7  #: a radius is not a number from 0 to 1e45: nothing is known
    INVALID_BODY = 8  #: a coordinate that no model may have, a box turned inside out, a solid that is not closed


class Verdict(IntEnum):
    """What is proved about two bodies as closed sets."""

    UNDECIDED = 0  #: no other verdict is proved
    DISJOINT = 1  #: lower > 0
    TOUCHING = 2  #: the signed distance is within `tolerance` of 0
    OVERLAPPING = 3  #: the bodies share a point


class Decision(IntEnum):
    """Whether a distance is at most a threshold."""

    UNDECIDED = 0  #: the interval contains the threshold
    NO = 1  #: proved: lower > threshold
    YES = 2  #: proved: upper <= threshold


class FeatureKind(IntEnum):
    """The kind of feature that a feature id names: the id's two highest bits."""

    NONE = 0  #: no feature
    VERTEX = 1  #: the index is one of a level's vertices
    EDGE = 2  #: the index is one of a level's half-edges; of a mesh 3 * triangle + corner
    FACE = 3  #: the index is one of a level's faces; of a mesh a triangle


class BodyKind(IntEnum):
    """What a body is made of."""

    MODEL = 0  #: a convex hull at several levels of detail
    POINT = 1  #: with a radius, a sphere
    SEGMENT = 2  #: with a radius, a capsule
    TRIANGLE = 3  #: flat, with two sides
    BOX = 4  #: its edges are parallel to the axes of the body's frame
    MESH = 5  #: a triangle mesh: its surface
    SOLID = 6  #: a closed triangle mesh and the volume that it bounds


class StartPolicy(IntEnum):
    """Where a query starts. Every policy gives the same verdict and true intervals."""

    AUTOMATIC = 0  #: the seed's features, else the support maps, else the coarsest pair
    PAPER = 1  #: the seed's features, else the coarsest pair [Ehmann & Lin 2000, sec. 5.2]
    FINEST = 2  #: the seed's features on level 0, without the hierarchy
    COARSEST = 3  #: the coarsest level pair
    TABLE = 4  #: level 0, from the start tables or maps, whatever the seed [sec. 5.3]


class Refinement(IntEnum):
    """By how many levels a query descends where a level pair does not answer [sec. 5.2]."""

    SINGLE = 0  #: one level finer in one body
    SINGLE_SINGLE = 1  #: one level finer in both bodies
    DOUBLE_DOUBLE = 2  #: two levels finer in both bodies


class PlaneRule(IntEnum):
    """Which violated Voronoi plane a step follows [sec. 5.1]."""

    MOST_VIOLATED = 0  #: the nearest side of a face that the point is beyond; of a vertex, the highest neighbour
    FIRST_VIOLATED = 1  #: the first one found


class Doubt(IntEnum):
    """Why a walk's own tests did not prove its bounds, so that support vertices and certified GJK did."""

    NONE = 0  #: they did
    NO_MINIMUM = 1  #: the walk got inside a body, stalled, or spent its budget
    NEIGHBOUR = 2  #: a neighbour is as high as the feature within rounding
    WIDTH = 3  #: the bounds are wider than law 2's
    LEAN = 4  #: the points lean against the plane
    THRESHOLD = 5  #: the distance is within law 2's bound of a threshold
    ASKED = 6  #: the caller asked for the careful proof


class Resolution(IntEnum):
    """The spacing of a start table's samples."""

    NONE = 0  #: no samples
    DEGREES_22 = 1  #: 22.5 degrees apart: 114 entries
    DEGREES_11 = 2  #: 11.25 degrees: 482 entries
    DEGREES_5 = 3  #: 5.625 degrees: 1986 entries


class Method(IntEnum):
    """How a coarse level is simplified from the next finer one."""

    COLLAPSE = 0  #: Garland & Heckbert's quadric error edge collapse [sec. 4.5]
    PEEL = 1  #: removal of Dobkin & Kirkpatrick's independent sets [sec. 4.4]


class Enclosing(IntEnum):
    """How a coarse level is made to enclose level 0."""

    TIGHT = 0  #: each vertex is moved to where its faces just clear level 0
    SCALE = 1  #: the paper's way: scaling about the centre of mass
