// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Every error bound of mesh queries, with the quantity that it is relative to and its derivation. u stands for `kU`, as in
// numeric/tolerance.h.
#pragma once

#include "numeric/tolerance.h"

namespace swiftlet {

// ---- Boxes, in floats ---------------------------------------------------------------------------------------------------

/// The product of two axes of a node, less 1 if they are the same, is at most this: their entries are rounded to floats, each
/// off by 2^-25 at most, and those of the third by 3 more. Dimensionless.
inline constexpr double kAxisError = 0x1p-21;
/// The share of a node's size by which boxes are made larger, so that rounding in doubles, 30 u of the size, cannot lose a
/// point, nor that of a node's origin, 10 u of where it is. Dimensionless.
inline constexpr double kBoxMargin = 0x1p-44;

/// The middle of a child's box from its place along a node's axes, over the body's unit. Rows of axes M are orthonormal but for
/// E, |E| <= 3 kAxisError in all; M^T c is off by E c, and M^T (c + (c - M M^T c)) by E^2 c: 9 kAxisError^2 times |c| <= 4,
/// which is 2^-36.8. Rounding, some 100 u, is far below. Rounded up.
inline constexpr double kMiddleError = 0x1p-36;
/// The sum of two radii and that of a distance and this sum are off by u each, relative to all three. Dimensionless.
inline constexpr double kEndError = 4 * kU;

// Bound what rounding does to a bound on the distance of two boxes. A gap along an axis of one node is exact for its own boxes
// and, for those of the other, off by: 3 kAxisError of their size, as a point is found again from its coordinates along axes
// that are not quite at right angles; 2^-19, as an entry of the product of both nodes' axes carries 8 roundings of floats;
// 2^-20 of all lengths for the sums; and 2^-18 of all lengths, where the rotation's inverse is taken to be its transpose: its
// columns are at right angles to 1e-6. That is less than 2^-16 of both sizes and of the distance of both origins. What
// underflows is far below the second, in the pair's unit. The third is relative to a bound: axes are unit to kAxisError, as far
// as the rotation is to 1e-6, and a root and a sum of squares carry 5 roundings.
inline constexpr float kBoxSlack = 0x1p-16f, kLeastBoxSlack = 0x1p-60f, kBoundShare = 0x1p-16f;
// It is also what is taken from bounds on two roots, of all lengths together: the distance of the balls' centres, law 2's size
// and the balls' diameters. In doubles errors are far below it. The gap of the boxes below both roots is computed in floats:
// the way carries 1 rounding of floats, products with the rotation and with a body's axes 4 each, those with boxes 4, and the
// sums 3, less than 2^-20 of all lengths; with the first and the last of the above that is less than 2^-17.
/// Where two roots' boxes overlap along the line of the balls' centres by more than this share of how far they reach along it,
/// or half of it if they shall be farther apart than a threshold, the boxes below are hardly ever apart, and are not asked. A
/// choice of time, no bound rests on it. Dimensionless.
inline constexpr double kMeetLittle = 0.35;
/// What is added to the squares of half the sides of two roots' boxes, over the square of all that they reach, where a
/// direction is sought that parts them: flat boxes have one, too. No bound rests on it. Dimensionless.
inline constexpr float kLeastSpread = 0x1p-9f;
/// The share of a node's size by which its box, put along other axes, is made larger: 3 `kAxisError`, as a point is found again
/// from its coordinates along axes that are not quite at right angles, and what rounding in doubles adds. Dimensionless.
inline constexpr double kNodeBoxShare = 4 * kAxisError;
/// A double times one more than this is, as a float, not below it: two roundings of floats. Dimensionless.
inline constexpr double kFloatUp = 0x1p-22;

// ---- Fronts, in floats --------------------------------------------------------------------------------------------------

// A front's bound n (R c + t) - h - T r, as search and writer compute it, over the pair's unit, v = 2^-24: entries of R and t
// are off by v of themselves, c, of length 2 at most, is a float; a coordinate of R c + t carries 5 v of 4 and 2 v of 6, all
// three 56 v, times n again 4 v of 6; T r is at most 4, h at most 12, and each sum 1 v of itself: less than 128 v in all, once
// for each of the two; and n is longer than 1 by 3 kAxisError at most, of a bound of at most 8: 192 v. Rounded up. What
// rounding did to the gap that the bound began with is taken off before (`kBoundShare`, `kBoxSlack`).
inline constexpr float kFrontSlack = 0x1p-15f;
/// The most that B turns and goes while a front lasts: T, in radians, and W, over the pair's unit. The sums of a group's end,
/// of at most 16, are then within `kFrontSlack` too.
inline constexpr double kMostTurned = 1, kMostGone = 4;
/// The difference of two rotations stretches no vector by more than the root of half the sum of its squares: two singular
/// values are equal and one is 0. Legal ones are off by less than 2e-6 each, which may add their sum and `kHalfRoot` of their
/// sums.
inline constexpr double kHalfRoot = 0.70711, kTurnSlack = 1e-5;
/// How far the balls of a pair's children, of their own boxes and of triangles in them reach from the middle of the node's box,
/// over half its diagonal D: an own box is at most D from the middle along each of its axes on either side, so that its
/// middle and half its diagonal are at most the root of 6 times D; a triangle's, 7 / 3. Rounded up.
inline constexpr float kArmOfNode = 2.5f;

// ---- Pairs of triangles, in doubles -------------------------------------------------------------------------------------

// The way from A's first corner to B's, in A's frame: a coordinate of a rotated corner carries 3 u of its length, at most the
// root of 3 of the extent, and there are three: 9 u. The difference of t and A's corner is off by u of both, and the sum by u
// of itself. Relative to law 2's size; rounded up.
inline constexpr double kWayOfPairError = 12 * kU;
// The rest is relative to the length w of that way, and to the greatest length s of a side from a first corner. A side carries
// 1 u of itself, and one of B, rotated, 6.2 u. A gap along a unit vector: dot products carry 3 u each, the difference of both
// sides' 2 u of s, the last sum 1 u of w + 2 s; and the vector's length is off by 4.5 u, relative to the gap. A distance: a
// point carries 6 u of s beside its sides' error, the difference of both 2 u of s, the last sum 1 u of w + 2 s, and its length
// 5 u of itself. Rounded up.
inline constexpr double kGapOfWay = 5 * kU, kGapOfSide = 20 * kU, kGapOfItself = 5 * kU;
inline constexpr double kLengthOfWay = 2 * kU, kLengthOfSide = 25 * kU, kLengthOfItself = kNormError;
/// A corner's error beside that of the way: its side's, and the last sum, relative to D, the greatest distance of a corner.
inline constexpr double kCornerOfSize = 8 * kU;
// The triple product of three differences of corners, each of length 2 D at most and off by twice a corner's error e: 3 times
// 2 e times (2 D)^2, and 8 roundings of a product of at most (2 D)^3 [Shewchuk 1997]. Rounded up. Moving one
// triangle by a depth changes a product by the depth times two sides.
inline constexpr double kSideOfCorner = 26, kSideOfSize = 80 * kU, kSideOfDepth = 4;

/// A gap along a unit direction, relative to law 2's size: dot products with points carry 3 u of their lengths, at most the
/// root of 3 of an extent, R^T times the direction 5.2 u of B's, that with t 3 u, and two sums 1 u each of all. Rounded up. The
/// direction's length is off by 4.5 u, relative to the gap.
inline constexpr double kAheadError = 28 * kU, kAheadOfItself = 5 * kU;
/// The share of law 2's bound by which what is left out may be nearer than the nearest pair: ties with it are, and are left
/// out.
inline constexpr double kLeftOutShare = 0.75;

// ---- Points inside ------------------------------------------------------------------------------------------------------

/// A point of A's frame in B's, R^-1 (p - t), relative to |p - t|: the difference carries 1 u. An entry of the inverse by
/// cofactors is off by 2 u, as products whose magnitudes sum to 1 carry 1 u and their difference another one: 6 u for the
/// matrix; and by 8.5 u of itself for the determinant, 6.5 u, its inverse and the product with it: the root of 3 times that.
/// The last products and sums carry 3 u, the root of 3 times that. That is 27 u; rounded up.
inline constexpr double kTurnBackError = 32 * kU;
/// A coordinate of a ray's start in a node's axes, from the middle of a child's box, over the mesh's unit: the difference with
/// the origin is off by 4 u, times the root of 3, the dot product by 21 u and the last difference by 8 u; and the products of
/// two coordinates and two directions by 3 u of the coordinates, at most 16, 48 u. That is 84 u; rounded up.
inline constexpr double kRayError = 128 * kU;

// ---- Manifolds ----------------------------------------------------------------------------------------------------------

/// The cosine of two unit vectors is off by 12 u: 3 u of the products and sums, and 4.5 u of the length of each.
inline constexpr double kSlopeError = 12 * kU;
/// An axis parts triangles by a motion along a direction that is farther than this from right angles to it: by one nearer,
/// the way would be longer than any body. Cosine.
inline constexpr double kLeastSlope = 0x1p-20;
/// A triangle whose height over its longest side, as a projection shows them, is less than this counts as its sides: a height
/// above it would be off by more than 2^20 times a corner's error. Two sides whose sine is less do not cross. The same share of
/// law 2's size covers what this and a way along a slant axis add to separations.
inline constexpr double kNarrowest = 0x1p-20;
/// Two candidates for the normal of a crossing are one if their cosine is within this of 1: an angle of 2^-20.
inline constexpr double kSameDirection = 0x1p-41;

// ---- Depths -------------------------------------------------------------------------------------------------------------

/// The height of a box along a unit direction, and of a vertex that is compared with it, over the mesh's unit: dot products
/// of lengths of at most 2 root 3 carry 3 u each, and the sums over the box 7 u. Rounded up.
inline constexpr double kBoxHeightError = 64 * kU;
/// A length of a translation along a direction whose length is off by 4.5 u: what separates is longer by its square, 9 u, and
/// radii by 4.5 u, the last sums by 3 u. Relative to itself, rounded up.
inline constexpr double kMoveError = 24 * kU;
/// What rounding may take from the reach by which two boxes are grown, as a share of it: sums of four coordinates, each rounded
/// when its box grew, lose 10 u of it. What they lose of the coordinates law 2's bound exceeds, by which boxes are grown too.
inline constexpr double kGrownError = 16 * kU;

}  // namespace swiftlet
