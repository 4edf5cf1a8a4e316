#pragma once

// The oracle's numbers. Every input is a finite float32, hence dyadic: sums, differences and
// products stay in the ring Z[1/2] and are exact in CGAL::Mpzf, without a gcd. Divided values
// become CGAL::Gmpq, in lowest terms. These numbers are rounded only by functions whose names say
// so.

#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "records/enclosure.h"

namespace rastercheck::oracle {

using Ring = CGAL::Mpzf;
using Field = CGAL::Gmpq;
using RingVector3 = Eigen::Matrix<Ring, 3, 1>;
using RingVector4 = Eigen::Matrix<Ring, 4, 1>;
using RingMatrix4 = Eigen::Matrix<Ring, 4, 4>;

/// Converts a float32 exactly. A subnormal is converted by its bits, because under DAZ or FTZ the
/// processor's own conversion would read zero.
double exact_double(float value);
Ring exact_ring(float value);
Field exact_field(float value);

/// −1, 0 or 1.
int sign_of(const Ring& value);
int sign_of(const Field& value);

Ring magnitude(const Ring& value);
Field magnitude(const Field& value);

/// numerator / denominator, in lowest terms; the denominator must not be zero.
Field quotient(const Ring& numerator, const Ring& denominator);

/// 2^exponent.
Field power_of_two(long exponent);

/// The largest integer <= value.
Field floor_of(const Field& value);
/// The largest integer <= value; the value must lie within ±2^62.
long floor_to_long(const Field& value);
/// The smallest integer >= value; the value must lie within ±2^62.
long ceil_to_long(const Field& value);

/// The largest e with 2^e <= |value|; the value must not be zero.
long floor_log2(const Field& value);

/// The float32 nearest to the value, ties to even, subnormals kept; ±infinity beyond float32.
float nearest_float(const Field& value);

/// The closest doubles around the value; equal if a double holds the value exactly.
records::Enclosure enclose(const Ring& value);
records::Enclosure enclose(const Field& value);
/// Doubles around sqrt(value), for value >= 0.
records::Enclosure enclose_sqrt(const Field& value);
/// Doubles around log2(value), for value > 0.
records::Enclosure enclose_log2(const Field& value);

/// Returns a double near the value. If the double is normal, the two differ by at most 2^-51 times
/// the magnitude of either. CGAL converts a number's two leading limbs, in at most three roundings
/// (proofs/limbs.g).
inline double near_double(const Ring& value) { return value.to_double(); }
inline constexpr double kNearDoubleError = 0x1p-51;
/// True if `near`, the near_double() of `exact`, is within kNearDoubleError of `exact`, and is 0 or
/// between 2^-480 and 2^480 in magnitude. Products of two such numbers, and sums of the products,
/// stay far from overflow and subnormal numbers.
bool has_normal_products(double near, const Ring& exact);

/// A closed interval of exact values.
struct FieldRange {
  Field lo;
  Field hi;
};

}  // namespace rastercheck::oracle
