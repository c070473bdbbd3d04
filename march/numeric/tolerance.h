// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Every epsilon of the runtime: its unit, what it scales with, and why it is that large. u is half an ulp of 1.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace swiftlet {

// FLT_EVAL_METHOD: 2 and what is above 64 are wider than double, -1 is anything; 16 to 64 are narrower, or double itself.
static_assert(
    FLT_EVAL_METHOD >= 0 && FLT_EVAL_METHOD != 2 && FLT_EVAL_METHOD <= 64,
    "this target evaluates doubles in a wider format, and no error bound of swiftlet holds there: compile for x86 with "
    "-msse2 -mfpmath=sse");

inline constexpr double kU = 0x1p-53;
inline constexpr double kSqrt3 = 1.7320508075688774;  ///< above the root

// ---- Laws -------------------------------------------------------------------------------------------------------------------

/// Law 2: an exact answer has upper - lower <= 64 u size. Length over length.
inline constexpr double kLawTwo = 64 * kU;

/// A rotation R is accepted while every entry of R^T R - I is at most this. Dimensionless; the design's figure.
inline constexpr double kOrthonormality = 1e-6;
/// Rounding of such an entry: 3 products and 2 sums of terms whose sum is 1, 3 u, rounded up by a quarter. Law 2 allows for the
/// exact entry and no more, so that its bound is taken with what is surely there. Dimensionless.
inline constexpr double kOrthonormalityError = 4 * kU;

// ---- Filters of exact.cpp: relative to the sum of the magnitudes of the terms ----------------------------------------------
// A term that is a product of k rounded factors, each a sum of few, carries one u per operation on its path. The figures are
// the operation counts, rounded up by a quarter for the second order and for the rounding of the magnitude itself.

/// n . (w - v): 1 difference, 1 product, 2 sums.
inline constexpr double kDotError = 5 * kU;
/// (b - a) x (c - a) . (w - v): 3 differences, 2 products, 1 difference, 2 sums = 8; [Shewchuk 1997] proves 7.
inline constexpr double kTripleProductError = 10 * kU;
/// A coordinate of (b - a) x (c - a): 1 difference, 1 product, 1 difference, and the differences of the other factor.
inline constexpr double kCrossProductError = 5 * kU;
/// n . R (w - v): 1 difference, 2 products, 2 + 2 sums.
inline constexpr double kTurnedDotError = 9 * kU;
/// The same with n rotated first, relative to |n|_1 |w - v|_1, which bounds every product of a rotation's rows (|R_ij| <= 1 +
/// 1e-6).
inline constexpr double kTurnedSupportError = 9 * kU;
/// A coordinate of R^T n for unit n: 3 products of one sum of magnitudes at most 1 + 1e-6, 2 sums.
inline constexpr double kTurnedError = 4 * kU;
/// Either in double-double arithmetic, whose sums and products keep at least 100 bits each.
inline constexpr double kWideDotError = 0x1p-96;
/// (b - a) x (c - a) . (d - a) in the same arithmetic, from exact differences: 2 products, 1 difference, 1 product, 2 sums,
/// each right to 2^-100. Relative to the sum of the magnitudes of the terms.
inline constexpr double kWideTripleProductError = 0x1p-96;
/// (b - a) x (c - a) in the same arithmetic is right to 2^-99 of the product of the lengths. Where it is longer than this share
/// of that product, it is right to 2^-58 of itself; else expansions tell. Dimensionless.
inline constexpr double kLeastWideArea = 0x1p-40;
/// The height of a plane over its exact normal's length: 5 u for the length, 2 for the product, rounded up; and what the normal
/// leaves uncertain, 2^-57, where the height is small beside the points. Relative to the height, and to the largest coordinate.
inline constexpr double kPlaneHeightError = 8 * kU, kPlaneHeightFloor = kU / 8;
/// Three factors a - (R b + t) of 1 product and 4 sums each, then 2 products, 1 difference, 2 sums.
inline constexpr double kOffsetTripleProductError = 26 * kU;
/// The same in double-double arithmetic: 26 operations that keep 100 bits each.
inline constexpr double kWideOffsetTripleProductError = 0x1p-95;

/// Coordinates are 0 or at least this, so that products of three of them keep their rounding errors inside the range of
/// doubles. Length.
inline constexpr double kLeastCoordinate = 1e-70;
/// A body's extent and a pose's translation are at most the second, an extent not below the first: sixth powers, the squared
/// height of a vertex over an unnormalised normal, stay inside that range too. Length.
inline constexpr double kLeastExtent = 1e-45, kMostCoordinate = 1e45;
/// A sum of squares above this has lost nothing to underflow. Length squared.
inline constexpr double kLeastSquare = 0x1p-900;
/// Law 2 promises no interval narrower than this: the products of a walk underflow below. Only two points, each the origin of
/// its frame, are a pair so small. Length.
inline constexpr double kLeastWidth = 0x1p-450;
/// The largest coordinate of a vector that is still normalised: below, its inverse may overflow. Products of two lengths.
inline constexpr double kLeastDirection = 0x1p-1000;

/// A product below 2^-1022 is off by 2^-1075; in a sum of few, times one factor more of at most 2 kMostCoordinate, by less than
/// this. Far below all that bodies of kLeastExtent make: their products are of 2^-448. Length cubed.
inline constexpr double kUnderflow = 0x1p-900;
/// Exact determinants of differences are taken where the largest coordinate has this exponent: its cube stays below 2^1000, and
/// of bodies and translations 2^-950 of it no bit is lost. An exponent of 2.
inline constexpr int kProductExponent = 330;

// ---- Rounding of a certificate in doubles (certify.cpp): lengths -----------------------------------------------------------

/// R b + t: a coordinate of R b is 3 products and 2 sums of terms that |b| bounds, 4 u |b| each with the last sum, sqrt(3) for
/// the vector; the last sum also rounds t once.
inline constexpr double kTurnError = 7 * kU, kShiftError = 2 * kU;
/// n . c, normalised: 3 (difference, product, two sums) + 2 (|n| of a normalised n) on the sum of |n_i c_i|, rounded up.
inline constexpr double kGapError = 7 * kU;
/// The cross product of two rounded differences: 2 differences, 1 product, 1 difference per term, two terms per coordinate; the
/// vector's error relative to the product of the lengths.
inline constexpr double kCrossError = 8 * kU;
/// A convex combination of three points: 1 product and 2 sums, and weights whose sum is 1 only to 3 u. Relative to |p|.
inline constexpr double kPointError = 7 * kU;
/// What a walk saw rise along a direction, said of its image at unit length: kDotError; turned there and back, 2 sqrt(3)
/// kTurnedError; normalised, 4. Relative to both lengths.
inline constexpr double kRiseError = 24 * kU;
/// sqrt of a sum of three squares of rounded differences, relative.
inline constexpr double kNormError = 5 * kU;

/// What a support map says of a direction, over the extent: two heights of 3 products and 2 sums of terms of at most the extent
/// when it was made, 24 u; a cell's border off by 4 u in each coordinate of the direction, times 2, 16 u; the direction turned
/// into the body's frame, kTurnedError in each coordinate, times 2, 24 u; two heights again, 24 u; the direction made unit
/// after it was looked up, 2 u of 2 sqrt(3), 7 u, and an excess of at most 4 with it, 4 u of 4, 16 u. Rounded up.
inline constexpr double kMapError = 128 * kU;

/// Double-double arithmetic as gjk.cpp uses it keeps at least 90 bits of the largest term, whatever cancels. Relative to
/// the magnitude of coordinates and translation.
inline constexpr double kDoubleDoubleError = 0x1p-90;

// ---- Checks (brute.h, check_depth.cpp): their own arithmetic, in 106 bits unless said otherwise ----------------------------

/// Below so much of the largest coordinates of u and v the largest of u x v is taken exactly. Dimensionless.
inline constexpr double kCancelled = 0x1p-10;
/// A coordinate of u x v above: u = R d has 3 products and 2 sums of terms that |d| bounds, 6 * 2^-100 of u's largest
/// coordinate, v as much, so that either product is off by 13 * 2^-100 and their difference by 28; over kCancelled. Relative to
/// the normal's largest coordinate.
inline constexpr double kNormalError = 0x1p-85;
/// n . d of a normal and an edge, each scaled to a largest coordinate from 1 to 2: kNormalError of 2, times 2, thrice, and the
/// rest is less. A sign above is sure.
inline constexpr double kSideError = 0x1p-81;
/// The same in doubles: 2 roundings of the factors, 1 product, 2 sums, rounded up to 7 u, of terms whose sum is at most 12.
inline constexpr double kRoughSideError = 84 * kU;
/// n . p of such a normal in doubles: 7 u of terms whose sum is at most 6 coordinates. Relative to the largest coordinate.
inline constexpr double kRoughHeightError = 42 * kU;
/// The height of a plane: its normal leans by at most sqrt(3) kNormalError, points are off by 2^-97 of the magnitude, and
/// product, root and quotient by as much, 2^-82 in all; and of planes that differ by as much any is the least. Relative to the
/// magnitude of coordinates and translation.
inline constexpr double kHeightError = 0x1p-81;
/// Bodies are checked at a scale where the magnitude of coordinates and translation is 2 to this; and of a rotation entries
/// below the second count as 0, which moves points by less than 2^-247 of themselves. Coordinates are then multiples of 2^-138,
/// entries of 2^-303, and the product of three of those and two of these of 2^-1020: no bit of a sign is lost.
inline constexpr int kCheckedExponent = 300;
inline constexpr double kLeastEntry = 0x1p-250;
/// A unit normal's squared length: kNormError twice, once of the length found and once of the division. Dimensionless.
inline constexpr double kUnitError = 12 * kU;

// ---- Where surfaces cross (intersection.cpp): doubles guide, exact signs decide -------------------------------------------

/// Where a ray leaves a body, in point errors over the height of the facet above where it starts: ten of these, rounded up. A
/// wrong guess costs a longer search, never a wrong answer.
inline constexpr double kExitError = 16;

// ---- Faces -----------------------------------------------------------------------------------------------------------------

/// Facets join one walking face while its vertices stay within this height of its plane, relative to the body's extent: each
/// coordinate of a rounded planar polygon is off by half an ulp, sqrt(3)/2 for the vector, and the plane through three such
/// points is off by as much at each, extrapolated up to twice. In ulps of the input's own precision.
inline constexpr double kWalkingFaceUlps = 4;
/// The ulp of input that was float32 when every coordinate is a float, and of doubles.
inline constexpr double kFloatUlp = 0x1p-23, kDoubleUlp = 0x1p-52;

/// A stored normal's squared length is 1 to this, or the file is damaged: far above rounding, far below harm to a walk.
inline constexpr double kUnitNormalError = 1e-9;
/// A level's deviation is measured to this part of itself: a tenth of the 1 % that the design allows above the truth.
inline constexpr double kDeviationPrecision = 1e-3;

// ---- Manifolds -------------------------------------------------------------------------------------------------------------

/// Faces turn as much towards a normal where the cosines differ by no more than this: an angle of 4 ulps of single precision,
/// 2^-21, takes half its square from a cosine. Dimensionless.
inline constexpr double kSameFacing = 0x1p-43;
/// A point of a manifold gives way to one that adds so much more area: enough that the corners of a regular polygon, of which
/// any four opposite ones are as good, do not take turns. A fraction.
inline constexpr double kKeptWorth = 0.125;
/// Points of a manifold that give way at most: two or three leave all as they are. A count.
inline constexpr int kExchanges = 32;
/// Corners of a common area that a manifold is chosen from: the 8 of the manifold before, the deepest, both ends of both
/// borders, and as many to choose between. A count.
inline constexpr int kMostCorners = 20;
/// The angle between the first side of a face and the line that sweeps over it, 12.7 degrees from where they meet at right
/// angles: of a regular polygon of up to 20 corners no side is within 0.1 degrees of that line. Cosine and sine.
inline constexpr double kSweepCos = 40.0 / 41, kSweepSin = 9.0 / 41;

// ---- Bounds on work: counts ------------------------------------------------------------------------------------------------

/// States in a row that do not shorten the distance before a walk is given to certified GJK. In exact arithmetic at most
/// three (face, edge, vertex) go by; twelve lets rounding waver on a flat spot.
inline constexpr std::uint32_t kStallLimit = 12;
/// Iterations of certified GJK per arithmetic: a Frank-Wolfe step on an active set of at most four. Each shortens the
/// distance or is the last but `kProgressPatience`.
inline constexpr int kGjkLimit = 400, kProgressPatience = 8;
/// An Automatic start walks from the seed's features while the line of centres turned by no more than so many edges of a body,
/// at half a step each; a cold start costs as much as about six steps, on a level without a map, which is come down to, twice
/// that. A walk that takes more than the last is given up for a cold start (ski rental).
inline constexpr double kWarmEdges = 6, kWarmEdgesUnmapped = 12;
inline constexpr std::uint32_t kTrialSteps = 16;
/// An answer's direction is tried again while the line of centres turned by less than this cosine says, 8 degrees.
inline constexpr double kSameLine = 0.99;
/// Bodies nearer than so many times the sum of their radii are told apart on fine levels: coarse ones deviate by a tenth, and
/// their maps by as much.
inline constexpr double kCloseRadii = 1.25;
/// A cold start looks along maps until its supports lie this many edges of both bodies aside, or so many times.
inline constexpr double kNearEdges = 4;
inline constexpr int kMapGjkSteps = 12;
/// What a map of side s leaves in doubt on average, times s^2 over the extent: 1.1 to 1.7 on ellipsoids. A pair of levels is
/// looked at where this and its deviation, so many times, are within the tolerance.
inline constexpr double kMapDoubt = 1.7, kMapShare = 4;
/// Looks go on past that while what the maps leave in doubt times this is within the tolerance; beyond, they turn in circles.
inline constexpr double kDoubtShare = 3;
/// Looks at levels that overlap by less than they deviate go on while the deviation times this is within the tolerance; beyond,
/// a walk is cheaper. Measured: both take as long at 1.4 to 1.5.
inline constexpr double kHiddenShare = 1.4;
/// Vertices that doubles may find equally high before a certificate asks exact arithmetic which is the highest: two triangles
/// and room for a flat spot.
inline constexpr std::size_t kPlateau = 8;
/// Points of the inner polytope that tells touching from overlapping: 300 vertices slid into contact needed 20 to 32.
inline constexpr int kContactPoints = 32;

// ---- Depth (epa.cpp, facet_proof.cpp) --------------------------------------------------------------------------------------

/// A point of the Minkowski difference put on a grid of half an ulp of the magnitude's binade, 2 u of it: u in each coordinate,
/// sqrt(3) for the vector. Relative to the magnitude.
inline constexpr double kGridError = 2 * kU;
/// A triple product u x v . w of differences: kCrossError for u x v, 4 u for the rest, and w is no longer than twice the
/// magnitude; rounded up. Relative to |u| |v| magnitude.
inline constexpr double kOutwardError = 32 * kU;
/// The ring of points around the top of a polytope is looked for along directions that lean out by so much. A tangent: half
/// and twice of it cost more on the whole.
inline constexpr double kFlare = 0.5;
/// Beyond a side of a confirmed facet they lean by no more than so many times the angle under which the depth sees the nearest
/// point beside that side: planes that lean by two of them are as near as the facet, and those to the point found lean by about
/// half of what it was looked for along. Dimensionless.
inline constexpr double kLean = 3;
/// The local least of a depth is looked for from so many directions at most; along each B stands off by as much as it was deep;
/// and a cold start looks along maps until a direction turns by less. Counts, heights, a cosine.
inline constexpr int kSlides = 8;
inline constexpr double kSlideBy = 2, kSlideTurn = 0.98;
/// Points of the inner polytope: overlaps by a tenth of the bodies take 10 to 30. One that needs more is proved octant by
/// octant, and these by quarters of theirs, so many times.
inline constexpr int kDepthPoints = 128, kDepthCells = 6;
/// The half-angle of the cone that is searched for the facet of a known plane: any shows all of its corners. Radians.
inline constexpr double kNarrowCone = 0x1p-6;

}  // namespace swiftlet
