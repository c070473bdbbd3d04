// SPDX-FileCopyrightText: 2026 the swiftlet authors
// SPDX-License-Identifier: BSD-3-Clause
// Every error bound, range limit and work limit of the runtime: its unit, the quantity that it is relative to, and its
// derivation. u stands for `kU`, half an ulp of 1, the largest relative error of one rounded operation.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace swiftlet {

// FLT_EVAL_METHOD: 2 and values above 64 are formats wider than double, and -1 may be any; 16 to 64 are no wider than double.
static_assert(
    FLT_EVAL_METHOD >= 0 && FLT_EVAL_METHOD != 2 && FLT_EVAL_METHOD <= 64,
    "this target evaluates doubles in a wider format, and no error bound of swiftlet holds there: compile for x86 with "
    "-msse2 -mfpmath=sse");

inline constexpr double kU = 0x1p-53;                 ///< u: half an ulp of 1
inline constexpr double kSqrt3 = 1.7320508075688774;  ///< the square root of 3, rounded up

// ---- Laws -------------------------------------------------------------------------------------------------------------------

/// Law 2: an exact answer under a rigid pose has upper - lower <= 64 u size; LAWS.md defines size and what a pose that is not
/// rigid adds. Relative to size: length over length.
inline constexpr double kLawTwo = 64 * kU;

/// A rotation R is accepted while every entry of |R^T R - I| is at most this. Dimensionless. The design sets the figure.
inline constexpr double kOrthonormality = 1e-6;
/// Bounds the rounding error of a computed entry of R^T R - I: 3 products and 2 sums of terms whose sum is 1 make 3 u, rounded
/// up by a quarter. Law 2 allows for the exact entry alone, so `law_two` subtracts this from the computed one. Dimensionless.
inline constexpr double kOrthonormalityError = 4 * kU;

// ---- Filters of exact.cpp: relative to the sum of the magnitudes of the terms ----------------------------------------------
// Each bounds the rounding error of a sum of products. A term carries one u for each operation between the stored numbers and
// the result. The constant is the number of these operations, rounded up by a quarter for errors of second order and for the
// rounding of the magnitude itself. Dimensionless.

/// n . (w - v): 1 difference, 1 product, 2 sums.
inline constexpr double kDotError = 5 * kU;
/// (b - a) x (c - a) . (w - v): 3 differences, 2 products, 1 difference, 2 sums = 8; [Shewchuk 1997] proves 7.
inline constexpr double kTripleProductError = 10 * kU;
/// A coordinate of (b - a) x (c - a): 1 difference for each of the two factors, 1 product, 1 difference.
inline constexpr double kCrossProductError = 5 * kU;
/// n . R (w - v): 1 difference, 2 products, 2 + 2 sums.
inline constexpr double kTurnedDotError = 9 * kU;
/// (R^T n) . (w - v), where n is rotated first: 2 products, 2 + 2 sums, 1 difference. Relative to |n|_1 |w - v|_1, which bounds
/// the sum of the magnitudes, because |R_ij| <= 1 + 1e-6.
inline constexpr double kTurnedSupportError = 9 * kU;
/// A coordinate of R^T n for unit n, absolute: 1 product and 2 sums for each of 3 terms of magnitudes that sum to 1 + 1e-6.
inline constexpr double kTurnedError = 4 * kU;
/// n . (w - v) and (R^T n) . (w - v) in double-double arithmetic, which keeps at least 100 bits in each sum and product.
/// Relative to |n|_1 |w - v|_1.
inline constexpr double kWideDotError = 0x1p-96;
/// (b - a) x (c - a) . (d - a) in double-double arithmetic from exact differences: 2 products, 1 difference, 1 product, 2 sums,
/// each right to 2^-100. Relative to the sum of the magnitudes of the terms.
inline constexpr double kWideTripleProductError = 0x1p-96;
/// (b - a) x (c - a) in double-double arithmetic is right to 2^-99 of the product of both lengths. Where it is longer than this
/// share of that product, it is right to 2^-58 of itself; where it is not, `plane` computes it by expansions. Dimensionless.
inline constexpr double kLeastWideArea = 0x1p-40;
/// Bound the error of `exact::Plane::height`. `kPlaneHeightError` is relative to the height: 5 u for the normal's length and 2
/// u for the product, rounded up. `kPlaneHeightFloor` is relative to the largest coordinate: the normal's error of 2^-57, which
/// counts where the height is small beside the points, rounded up.
inline constexpr double kPlaneHeightError = 8 * kU, kPlaneHeightFloor = kU / 8;
/// The determinant of three differences a - (R b + t): 1 product and 4 sums for each, then 2 products, 1 difference, 2 sums.
inline constexpr double kOffsetTripleProductError = 26 * kU;
/// Bounds the error of six times the volume of a tetrahedron of the origin and three of four differences a - (R b + t),
/// relative to the cube of the pair's magnitude m. A difference is off by 7 u of m and an edge, whose length is at most 2 m, by
/// 16 u: a normal of two edges by 64 u of m^2, and the sum of three by 192 u. The products and sums add 52 u of m^2. The dot
/// product with a corner, of length m, makes 244 u of m^3, the corner's own error 7 u of 12 m^3, and its sum 3 u of 12 m^3: 364
/// u. Rounded up.
inline constexpr double kTetrahedronError = 416 * kU;
/// The determinant of three differences a - (R b + t) in double-double arithmetic: 26 operations that keep 100 bits each.
inline constexpr double kWideOffsetTripleProductError = 0x1p-95;

/// A coordinate is 0 or at least this in magnitude, so that products of three of them keep their rounding errors inside the
/// range of doubles. Length.
inline constexpr double kLeastCoordinate = 1e-70;
/// A body's extent is 0 or at least `kLeastExtent`; extents and the coordinates of a translation are at most `kMostCoordinate`.
/// Sixth powers, as the squared height of a vertex over an unnormalised normal, then stay in the range of doubles. Length.
inline constexpr double kLeastExtent = 1e-45, kMostCoordinate = 1e45;
/// True if the signs of products of such a coordinate are exact.
static inline bool is_legal_coordinate(double x) {
  return x == 0 || (std::fabs(x) >= kLeastCoordinate && std::fabs(x) <= kMostCoordinate);
}
/// A sum of squares that is at least this has lost nothing to underflow. Length squared.
inline constexpr double kLeastSquare = 0x1p-900;
/// The least value of law 2's bound: below it the products of a walk underflow. Length. Only a pair of two points, each at the
/// origin of its frame, can have a smaller 64 u size.
inline constexpr double kLeastWidth = 0x1p-450;
/// A vector is normalised only if its largest coordinate is above this: else its inverse may overflow. Product of two lengths.
inline constexpr double kLeastDirection = 0x1p-1000;

/// Bounds the error of a triple product through underflow: a product below 2^-1022 is off by 2^-1075, and a sum of few such
/// products times one more factor of at most 2 `kMostCoordinate` by less than this. Bodies of `kLeastExtent` make products of
/// 2^-448, far above it. Length cubed.
inline constexpr double kUnderflow = 0x1p-900;
/// Exact determinants of differences are computed at a scale where the largest coordinate has this exponent of 2. Its cube
/// stays below 2^1000, and bodies and translations as small as 2^-950 of the largest coordinate lose no bit.
inline constexpr int kProductExponent = 330;

// ---- Rounding of a certificate in doubles (certify.cpp): errors relative to lengths ----------------------------------------

/// Bound the error of the vector R b + t, relative to |b| and |t|. A coordinate of R b is 3 products and 2 sums of terms that
/// |b| bounds, 4 u |b| with the last sum, and sqrt(3) times that for the vector. The last sum also rounds t once.
inline constexpr double kTurnError = 7 * kU, kShiftError = 2 * kU;
/// Bounds the error of a gap n . c - e for a normalised n, relative to the sum of |n_i c_i|: the difference c, 1 product, 2
/// sums and the last difference make 5 u. The length of n is off by 4.5 u: its square carries 3 u, the root halves these and
/// adds 1, then come 1 quotient and 1 product. The sum is rounded up.
inline constexpr double kGapError = 10 * kU;
/// Bounds the error of the cross product of two rounded differences, relative to the product of their lengths: 2 differences,
/// 1 product and 1 difference per term, two terms per coordinate.
inline constexpr double kCrossError = 8 * kU;
/// A convex combination of three points, relative to the largest |p|: 1 product, 2 sums, and weights that sum to 1 only to 3 u.
inline constexpr double kPointError = 7 * kU;
/// Bounds the error of the length of a rounded difference, relative to the length. Its square carries 5 u: 2 of the difference,
/// 1 of the product, 2 of the sums. The root halves these and adds 1; rounded up.
inline constexpr double kNormError = 5 * kU;

/// Ellipsoids are known of bodies up to so slender: the norm of the map frame M times that of its inverse is at most this.
inline constexpr double kMostSlender = 256;
/// The ellipsoid around a body is larger, and the one inside it smaller, by this share of their size: far more than what they
/// lose along a direction n. M n and M^-T x each lose 3 u of the terms that may cancel, which are `kMostSlender` times as large
/// at most, and the lengths of both and their product 8 u.
inline constexpr double kEllipsoidSlack = 0x1p-24;
/// By how many times a pose's error a line may be shorter in an ellipsoid than what the transposed rotation says. The inverse
/// is the transpose less E R^-1 for E = R^T R - I, whose Frobenius norm is at most 3 errors. Where A = M^-T changes lengths by
/// up to k = `kMostSlender`, y . A E A^-1 y is at most 1.5 sqrt(2 + 2 K^2) = 272 errors for unit y and K = (k + 1 / k) / 2, as
/// |A^T y| |A^-1 y| <= K. Rounded up.
inline constexpr double kSlenderTurn = 2 * kMostSlender;
/// By how many times law 2's bound two ellipsoids have to overlap along the line of centres. The rounding of the line, 13 / 64
/// of the bound, counts K times as above: 26. Bodies that overlap by so much along the line are deep by a bound in any
/// direction.
inline constexpr double kSlenderLine = 4 * kMostSlender;

// ---- Rounding of a walk's tests (marcher.h) -------------------------------------------------------------------------------
// The tests that end a walk also prove bounds. A direction d is taken exactly as it was computed; how far it is from the one
// that was meant shows in the bounds. R is the pose's matrix as it was given: none of these terms needs it to be orthonormal.

/// Bound the error of the vector from one vertex of a body to another in the common frame, relative to its length: of A 1
/// difference; of B also 3 products and 2 sums, 3 u in each coordinate of R e, sqrt(3) times that for the vector: 6.2 u.
inline constexpr double kWayError = kU, kTurnedWayError = 7 * kU;
/// Bounds the error of a vertex's height above another along d, each rounded on its own, relative to the largest coordinate of
/// the body times |d|_1. Of A, 1 product and 2 sums for both heights and their difference: 8 u. Of B, R^T d is computed first,
/// 3 u, and has |R^T d|_1 <= sqrt(3) |d|_1: (6 + 6 + 2) sqrt(3) u = 25 u. Rounded up by a quarter.
inline constexpr double kScanError = 32 * kU;
/// Bounds the error of a corner's height beside an edge, relative to the distance of the two vertices times |d|_1. The
/// difference of the two vertices has 1 u, its product with d 3 u, and R^T d, of B, 3 u: 7 u. Rounded up.
inline constexpr double kBesideError = 12 * kU;
/// Where the squared sine of two edges is above this, whether their lines are nearest within both is told by 2x2 determinants,
/// whose rounding is then some 2^-30 of them: a wrong answer costs a step, as points are clamped to the edges.
inline constexpr double kSlimArea = 0x1p-20;
/// Bounds the error of u x v for computed u and v, relative to |u| |v|: 1 product and 1 difference, 2 u in each coordinate of
/// terms that make at most 1.2 |u| |v|, and 1 u of the result. Rounded up.
inline constexpr double kFlatError = 4 * kU;
/// A normal n = u x v whose tilt, `kFlatError` over the sine of u and v, is between these is righted: what it has of their
/// plane is taken away. The products of n with both vectors have 3 u, two differences 1 u each: 5 u, within `kAcrossError`.
/// What is taken along either vector is at most twice the tilt over the square of the sine, 2^-20 of n, and its roundings count
/// as little. Together they turn n by at most 2.5 times the tilt: once for its error, and by both 3 u over the sine.
inline constexpr double kLeastTilt = 12 * kU, kMostTilt = kFlatError * 0x1p10;
inline constexpr double kRightedTurn = 3;  ///< bounds that turn, and what the righted normal misses by itself, in tilts
/// Bounds how far u x (w x u) / u . u is from a right angle to u, as a sine: u is the computed vector of an edge, and w leads
/// from one of its points to one at least law 2's bound away from its line. Both products have 3.4 u as above. What the inner
/// one errs by along u is at most 3.4 u of 2 sqrt(3) extents, over a distance of 64 u of them: the outer one's factors make an
/// angle whose sine is 0.97, and its error is 3.5 u of its length. The quotient has 1 u: 4.5 u. Rounded up.
inline constexpr double kAcrossError = 6 * kU;
/// Bounds the error of cof(R) n, the image of a normal n, relative to |n|: 2 u for each cofactor and 3 u for their sum with n,
/// (2 sqrt(3) + 3) u in each coordinate, sqrt(3) times that for the vector: 11.2 u. Rounded up.
inline constexpr double kImageError = 12 * kU;
/// Bounds the error of a point's depth below a facet's `exact::Plane`, relative to the largest coordinate. The plane's height
/// has 8.2 u; the normal's 3 u, the products' 3 u and the difference's 1 u count for |p|: 15.2 u times sqrt(3). Rounded up.
inline constexpr double kInnerError = 32 * kU;
/// Where the tests of a walk prove bounds that are too wide, a plane that may lean by more than this share of law 2's bound
/// over a body's reach is held against the rings of the feature's corners, so that its lean counts only as far as the feature
/// goes.
inline constexpr double kCloseShare = 0.25;
/// Bounds the rounding of the sums that make a point of each body from a vertex and at most two vectors, relative to the pair's
/// magnitude: 2 sums, each u of a vector no longer than the body's points are.
inline constexpr double kPointSumError = 2 * kU;
/// Bounds what the weights of a point of a triangle add, relative to the lengths of its sides: they sum to 1 only to 3 u, and
/// their products have 1 u. Rounded up.
inline constexpr double kWeightError = 5 * kU;
/// Bounds how far the point below p is above or below the plane of a face of many corners, relative to the vector from a corner
/// to p: the height has 1 difference, 1 product and 2 sums, the drop by it 3 u. `kImageError` comes on top. Rounded up.
inline constexpr double kDropError = 8 * kU;
/// Bounds how far the point below p in a face of many corners may be from where own coordinates show it, relative to the pair's
/// magnitude: R^T (p - t) has 7 u, its differences and products 8 u, rounded up; and the pose, taken for a rigid motion, adds
/// `kFootTurn` times its error: 3 for R^T in place of the inverse, 3 for the direction of the plane's normal; rounded up.
inline constexpr double kFootError = 24 * kU, kFootTurn = 8;

/// The entries of a map frame sum to at most this times the level's extent, in magnitude.
inline constexpr double kMostMapFrame = 16;
/// Bounds the rounding error of the excess that `look_up` returns for a direction n of length 1, relative to the level's
/// extent. Points M^-T x differ by at most 2 in a coordinate, and the coordinates of M n sum to at most 16 extents. A
/// coordinate of M n has 3 products and 2 sums, 3 u of its terms, hence 6 u times 16 extents. Where M n lies among the cells'
/// borders is off by 8 u of its length in each of both coordinates of the grid, 32 u in all of the direction's three, twice
/// that for heights: 64 u times 16 extents. An excess of at most 4 times that length has 6 u: 24 u times 16 extents. The
/// direction was turned into the body's frame, which is off by `kTurnedError` in each coordinate, times 2 extents: 24 u; the
/// two heights compared make 24 u; and its length is off by 4.5 u, times 2 sqrt(3): 16 u. The sum is rounded up.
/// What rounds when a map is made is part of the excess.
inline constexpr double kMapError = 2048 * kU;
/// Bounds the rounding of a direction n whose M n is a corner of a cell: at that M n is off by at most this times |M| |n| in
/// each coordinate. A substitution by rows of up to 3 terms has 3 u [Higham 2002, th. 8.5], the corner itself 1 u; rounded up.
inline constexpr double kFrameError = 5 * kU;
/// Times this a map frame is made larger, as its rounding to float32, 2^-24 of each entry, may make it too small. Of slender
/// bodies that lie obliquely that may take more: points M^-T x then differ by up to 2^-16 more than 2, for which `kMapError`
/// has room. Factor.
inline constexpr double kFrameSlack = 1 + 0x1p-20;
/// Of the trace of the moments of a level's surface, this is added to each of the three, so that the map frame of a flat body
/// has an inverse. Directions along which a body is thinner than 1 : 100 are looked up among more cells than they need.
inline constexpr double kLeastMoment = 0x1p-14;

/// Bounds the error of double-double arithmetic as gjk.cpp uses it, which keeps at least 90 bits of the largest term, whatever
/// cancels. Relative to the magnitude of coordinates and translation.
inline constexpr double kDoubleDoubleError = 0x1p-90;

// ---- Errors of the checks (brute.h, check_depth.cpp): arithmetic of their own, in 106 bits unless said otherwise -----------

/// u x v is computed exactly if its largest coordinate is below this share of the product of those of u and v. Dimensionless.
inline constexpr double kCancelled = 0x1p-10;
/// Bounds the error of a coordinate of other u x v, relative to the largest coordinate of u x v. u = R d has 3 products and
/// 2 sums of terms that |d| bounds, an error of 6 * 2^-100 of u's largest coordinate, and v has as much. Each product is then
/// off by 13 * 2^-100 and their difference by 28 * 2^-100, divided by `kCancelled`.
inline constexpr double kNormalError = 0x1p-85;
/// Bounds the error of n . d for a normal n and an edge d, each scaled to a largest coordinate from 1 to 2: each of three terms
/// is off by `kNormalError` times 2 times 2, and the rest is less. A larger result has a certain sign.
inline constexpr double kSideError = 0x1p-81;
/// n . d at the scale of `kSideError` in doubles: 2 roundings, 1 product, 2 sums, rounded up to 7 u, of terms that sum to 12.
inline constexpr double kRoughSideError = 84 * kU;
/// n . p with n at the scale of `kSideError` in doubles: 7 u of terms that sum to 6 times p's largest coordinate. Relative to
/// it.
inline constexpr double kRoughHeightError = 42 * kU;
/// (b - a) x (c - a) . (p - a) of a turned facet in doubles. Each difference is off by 8 u of itself: 1 difference, 3 products
/// and 2 sums in each of three coordinates. Their cross product is off by twice that and `kCrossError`, 24 u; p - a by
/// `kTurnError`, `kShiftError` and 1 difference, 10 u; their product adds 3 u. The sum is rounded up. Relative to the product
/// of the lengths of both differences and the largest distance of p and a from the origins.
inline constexpr double kRoughFacetError = 48 * kU;
/// Bounds the error of the least height of a plane, relative to the magnitude of coordinates and translation. A plane's normal
/// leans by at most sqrt(3) `kNormalError`, points are off by 2^-97 of the magnitude, and product, root and quotient by as
/// much: 2^-82 in all. It is doubled, because any plane whose height is within 2^-82 of the least may be taken for the lowest.
inline constexpr double kHeightError = 0x1p-81;
/// Bodies are checked at a scale where the magnitude of coordinates and translation has this exponent of 2. Entries of a
/// rotation below `kLeastEntry` count as 0, which moves a point by less than 2^-247 of its distance from the origin.
/// Coordinates are then multiples of 2^-138 and entries of 2^-303, so that a product of three coordinates and two entries is a
/// multiple of 2^-1020: none underflows, and signs are exact.
inline constexpr int kCheckedExponent = 300;
inline constexpr double kLeastEntry = 0x1p-250;
/// Bounds the error of a unit normal's squared length: `kNormError` for computing the length, and again for dividing by it.
inline constexpr double kUnitError = 12 * kU;

// ---- Where surfaces cross (intersection.cpp): doubles guide, exact signs decide -------------------------------------------

/// Bounds the error of the rate at which a ray leaves a body, in point errors over the height of the facet above the ray's
/// start: ten of these, rounded up. A wrong guess costs a longer search, never a wrong answer.
inline constexpr double kExitError = 16;

// ---- Faces -----------------------------------------------------------------------------------------------------------------

/// Facets join one walking face while its vertices stay within this height of its plane, in ulps of the input's precision times
/// the body's extent. Each coordinate of a rounded planar polygon is off by half an ulp, sqrt(3)/2 for the vector; the plane
/// through three such points is off by as much at each of them, and extrapolated up to twice.
inline constexpr double kWalkingFaceUlps = 4;
/// And while their normals are within 0.01 of the face's: a cosine, dimensionless. Beside the edge of a rounded body slivers
/// join corners that are in one line but for rounding, and face anywhere. Merged with a face, they would name it where a walk
/// beside its border has to cross them.
inline constexpr double kWalkingFaceCosine = 0.99995;
/// The ulp of the input, relative to its extent: `kFloatUlp` when every coordinate is a float32, else `kDoubleUlp`.
inline constexpr double kFloatUlp = 0x1p-23, kDoubleUlp = 0x1p-52;

/// A file is refused as damaged if the squared length of a stored normal differs from 1 by this or more. It is far above
/// rounding errors and far below what would mislead a walk. Dimensionless.
inline constexpr double kUnitNormalError = 1e-9;
/// Bounds the error of n . (p - q) relative to the computed sum of its terms' magnitudes: 1 difference, 1 product and 2 sums
/// have 4 u of the terms, whose computed sum may lack 4 u of itself. Rounded up. `kThicknessFloor`, relative to the extent, is
/// more than products lose that underflow.
inline constexpr double kThicknessError = 5 * kU, kThicknessFloor = kU * kU;
/// A coordinate of a stored normal is 0 or at least this in magnitude: smaller ones are stored as 0, and refused in files. The
/// exact height of a vertex along the normal then has no bit below 2^-900. Dimensionless.
inline constexpr double kLeastNormalEntry = 0x1p-500;
/// The relative precision to which a level's deviation is measured: a tenth of the 1 % that the design allows above the truth.
inline constexpr double kDeviationPrecision = 1e-3;

/// A rim (ConvexView::rims) has at least so many corners when it is made.
inline constexpr std::uint32_t kLeastRim = 16;
/// At each side of a rim, the face beyond has its previous corner lower than the rim's plane by more than this times the
/// extent: no contact face merges the two. Above `kMostFlatness` by more than rounding; a rim that is made has twice as much.
inline constexpr double kRimDrop = 0x1.2p-10;

// ---- Manifolds -------------------------------------------------------------------------------------------------------------

/// Two faces count as facing a normal equally where their cosines differ by no more than this: an angle of 2^-21, 4 ulps of
/// single precision, lowers a cosine by half its square. Dimensionless.
inline constexpr double kSameFacing = 0x1p-43;
/// Where the squared sine of two edges of a triangle is above this, the direction of their cross product in doubles is right to
/// half of `kSameFacing`: `kCrossError` over the sine. Elsewhere it comes from `exact::plane`. Dimensionless.
inline constexpr double kSliverArea = 0x1p-12;
/// The points of a manifold give way to others that have more area by more than this fraction. That is enough to keep the
/// corners of a regular polygon, of which any four opposite ones are equally good, from taking turns.
inline constexpr double kKeptWorth = 0.0625;
/// A pair is at rest where the normal has turned since the manifold before by no more than this times the flatness of contact
/// faces: poses whose entries are off by 4 ulps of single precision turn it by 2^-19 at most. Radians.
inline constexpr double kRestingTurn = 8;
/// Where a pair at rest has lost a point of the manifold before, corners count as inside of a face that they miss by no more
/// than this times the flatness of contact faces: both bodies' places are off by 4 ulps of single precision. Relative to the
/// larger body's extent.
inline constexpr double kRestingSlide = 2;
/// The most corners of a common area that a manifold is chosen from, beside those of the previous manifold; of more, those stay
/// whose chords cut off equal areas, three quarters of as many or more. A count.
inline constexpr int kMostCorners = 20;
/// What a chord between such corners may cut off at first, over the area up to there, and by which factor that grows until few
/// corners stay.
inline constexpr double kLeastChord = 0x1p-9, kChordGrowth = 4;
/// Contact faces whose rims have so many corners in all are intersected by halving, in less time than by a sweep. A count.
inline constexpr std::uint32_t kManyCorners = 256;
/// Halving goes on where a border may have an area this many times that which a chord may cut off.
inline constexpr double kSplitArea = 8;
/// Where halving left out corners and has found fewer than so many, it begins anew, and chords may cut off less by this factor.
inline constexpr int kFewCorners = kMostCorners / 2;
inline constexpr double kFinerChord = 0x1p-4;
/// The least part of the extent of the faces' common area that halving takes for that within the farthest separation.
inline constexpr double kLeastPart = 0x1p-20;
/// Halving is for common areas wider than this times the bound within which a corner counts as inside.
inline constexpr double kSurelyCommon = 4;
/// Least cosine of the angle between a face's normal and that of the projection where halving takes the border for convex.
inline constexpr double kLeastFacing = 0x1p-4;
/// Bounds the error of the cross product of two sides of a projected border, whose corners count as exact, relative to the
/// product of the sums of their coordinates: 2 differences, 1 product and 1 difference, 4 u of terms that this sum bounds.
/// Rounded up.
inline constexpr double kCornerError = 8 * kU;
/// Cosine and sine of 12.7 degrees: the angle between the first side of a face and the line that sweeps over it, or the way to
/// its border. No side of a regular polygon of up to 20 corners is then within 0.1 degrees of the line.
inline constexpr double kSweepCos = 40.0 / 41, kSweepSin = 9.0 / 41;

// ---- Bounds on work: counts and dimensionless factors -----------------------------------------------------------------------

/// Halving between contact faces: how many edges of a border wait for what lies below them, how many it looks for on a border,
/// and at how many heights it seeks the common area. What would need more is left out: if that is the deepest corner, the
/// answer's own point takes its place.
inline constexpr int kMostEdges = 14, kMostSplits = 128, kWidthSteps = 16;
/// From this many steps on a walk looks whether it comes back to where it was. A count, a power of two.
inline constexpr std::uint32_t kUnwatchedSteps = 16;
/// A walk that comes back over a face of more sides than this looks at the sides near the last one; the state that ends it
/// looks at all, or of a rim at those where halving leads. A count.
inline constexpr std::uint32_t kManySides = 16;
/// The most facets of one face that are visited for the one below a point.
inline constexpr int kFacetSteps = 32;
/// `kGjkLimit` bounds the iterations of certified GJK per arithmetic, each a Frank-Wolfe step on an active set of at most four.
/// `kProgressPatience` bounds those in a row that neither shorten the distance nor raise the lower bound.
inline constexpr int kGjkLimit = 400, kProgressPatience = 8;
/// An Automatic start walks from the seed's features while the line of centres turned by no more than `kWarmEdges` edges of a
/// body, at half a step each; a cold start costs about five steps. That of a round body, whose first direction costs next to
/// nothing, is worth it from `kWarmEdgesRound` edges on; on a level without a support map it descends from a coarser level and
/// costs twice as much: `kWarmEdgesUnmapped` edges. Those of a verdict and of a depth cost more too: they walk from twice as
/// far. A walk of `kTrialSteps` is given up for a cold start (ski rental).
inline constexpr double kWarmEdges = 5, kWarmEdgesRound = 3, kWarmEdgesUnmapped = 12;
/// A seed keeps its line of centres until that has turned by this many edges.
inline constexpr double kSameEdges = 0.5;
inline constexpr std::uint32_t kTrialSteps = 16;
/// The seed's direction serves while the line of centres turned by less than the angle of `kSameLine`, 8 degrees. It turns with
/// that line, between slender bodies up to the angle of `kTurnedLine`, 2 degrees; beyond, the direction between ellipsoids is
/// nearer to the true one. Up to that of `kNearLine`, 30 degrees, the search between ellipsoids begins at it. Cosines.
inline constexpr double kSameLine = 0.99, kTurnedLine = 0.9994, kNearLine = 0.866;
/// A cold start looks along support maps until its two supports lie aside of each other by no more than `kNearEdges` mean edges
/// of both bodies: at most `kEllipsoidLooks` more times along directions between ellipsoids, then in at most `kMapGjkSteps`
/// steps of GJK.
inline constexpr double kNearEdges = 2;
inline constexpr int kEllipsoidLooks = 4, kMapGjkSteps = 12;
/// Another look along a direction between ellipsoids follows one after which supports lie aside of each other by less than this
/// times what they did before.
inline constexpr double kLookShare = 0.5;
/// The tetrahedron that proved an overlap follows the origin by at most so many corners. Of bodies 0.01 of their radius deep
/// that turn by 45 degrees a query, 16 prove less often, 40 no more often.
inline constexpr int kOriginSteps = 24;
/// Bodies whose map frames differ from a multiple of the identity by less than `kRound` of it are taken for balls, others for
/// ellipsoids, the direction between which `kEllipsoidSteps` steps find. Factor, count.
inline constexpr double kRound = 0.25;
inline constexpr int kEllipsoidSteps = 2;
/// `kMapDoubt` estimates the mean excess of a map of side s, times s^2 over the extent: 5.0 to 5.9 on balls, 0.7 to 2.7 on
/// plates and needles. The maps of a level pair are used where `kMapShare` times the sum of this doubt and the pair's deviation
/// is within the tolerance.
inline constexpr double kMapDoubt = 5, kMapShare = 4;
/// Steps along maps go on between near supports while the deviation plus this times the maps' doubt is within the tolerance;
/// where it is not, the steps cycle.
inline constexpr double kDoubtShare = 3;
/// Steps along maps of levels that overlap by less than they deviate go on while the deviation times this is within the
/// tolerance; where it is not, a walk is cheaper. Measured: both take equally long at 1.4 to 1.5.
inline constexpr double kHiddenShare = 1.4;
/// The most vertices that doubles may find equally high before a certificate asks exact arithmetic which is the highest: two
/// triangles and room for a flat spot.
inline constexpr std::size_t kPlateau = 8;
/// The most points of the inner polytope that tells touching from overlapping: 300 vertices slid into contact needed 20 to 32.
inline constexpr int kContactPoints = 32;

// ---- Depth (epa.cpp, facet_proof.cpp) --------------------------------------------------------------------------------------

/// Bounds how far a point of the Minkowski difference moves when it is put on the grid, relative to the magnitude. The grid's
/// step is 2 u of the magnitude's binade: u in each coordinate, sqrt(3) u for the vector; rounded up.
inline constexpr double kGridError = 2 * kU;
/// Bounds the error of a triple product u x v . w of differences, relative to |u| |v| times the magnitude: `kCrossError` for
/// u x v and 4 u for the rest, times 2, as w is no longer than twice the magnitude; rounded up. Where w is no longer than the
/// magnitude, it bounds that and the error of |u x v| times a height together: 12 u and 8 u, and 2 u for the height's product.
inline constexpr double kOutwardError = 32 * kU;
/// An expanding polytope begins with points beyond the sides of the start's polygon, along directions that lean outwards from
/// its normal. This is the tangent of the angle: half and twice of it cost more on the whole.
inline constexpr double kFlare = 0.5;
/// The local least of a depth is searched for along at most `kSlides` directions. Along each, B is moved by `kSlideBy` times
/// the height of the overlap, and so stands off by as much as it was deep. A cold start steps along maps until a direction
/// turns by less than the angle of the cosine `kSlideTurn`. A count, heights, a cosine.
inline constexpr int kSlides = 8;
inline constexpr double kSlideBy = 2, kSlideTurn = 0.98;
/// The most points of the surface that proves a facet to be the nearest: 4 or 5, mostly, of a shallow overlap, and 25 to 45 of
/// round bodies that overlap by a third of their size.
inline constexpr std::size_t kFacetPoints = 64;
/// `kDepthPoints` is the most points of the inner polytope: overlaps by a tenth of the bodies take 10 to 30. A depth that needs
/// more is proved octant by octant, and an octant by its quarters, up to `kDepthCones` in all; `kRoughDepthCones` where the
/// levels' deviation makes the bounds wider than asked anyway. A cone is divided up to `kConeQuarters` times: its corners are
/// multiples of 2^-24, whose cross products are exact. Counts.
inline constexpr int kDepthPoints = 128, kDepthCones = 1 << 15, kRoughDepthCones = 1 << 7, kConeQuarters = 24;

}  // namespace swiftlet
