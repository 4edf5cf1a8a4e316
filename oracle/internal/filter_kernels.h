#pragma once

// The cascade's first level: doubles whose errors are bounded beforehand, many samples at a time,
// compiled for each SIMD target. No operation is fused and none is left to the compiler's order, so
// that all targets give the same bits.
//
// u = 2^-53; rounding is to nearest (oracle/internal/floating_point.h). Every bound below is proved
// by a script of oracle/proofs/, and stated there in the same names.

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The line a·x + b·y + c of positions relative to some pixel, with coefficients rounded to double.
/// What is computed of it at a sample of the box of pixels that it was made for,
///
///   fl(fl(a x) + fl(fl(b y) + c)),
///
/// differs from the exact line there by at most `band`: the coefficients' own errors and the
/// rounding.                                                               (proofs/edge.g)
struct FilterLine {
  double a = 0;
  double b = 0;
  double c = 0;
  double band = 0;
};

/// What the lines say of the samples (x + j, y), j = 0 … count − 1. Bit j of `inside`: each line is
/// above its band there, hence positive. Bit j of `outside`: some line is below minus its band.
/// Both have room for (count + 63)/64 words; the bits beyond count are zero.
void classify_row(std::span<const FilterLine> lines, double x, double y, int count,
                  std::uint64_t* inside, std::uint64_t* outside);

/// Samples that are judged together.
inline constexpr int kBatchSize = 128;
template <typename T>
using Batch = std::array<T, kBatchSize>;

/// The three edge functions at each of a batch's samples, and what their sum D is divided by.
struct alignas(64) BatchWeights {
  std::array<Batch<double>, 3> e;
  /// fl(1/D), D = fl(fl(e0 + e1) + e2); NaN where D is not certain to within 2^-20 of itself, which
  /// leaves every question of that sample open.
  Batch<double> reciprocal;
  /// D is off by at most this: Σ band (1 + 2^-40) + 4u Σ|e_i|.              (proofs/sum.g)
  Batch<double> error;
};

/// The weights at the first `count` samples (x[k], y[k]); edges[i].band counts.
void weigh_samples(const std::array<FilterLine, 3>& edges, const Batch<double>& x,
                   const Batch<double>& y, int count, BatchWeights& weights);

/// What the error of a value is a quotient of:
///
///   (f − r)/ulp  =  Σ g_i E_i / (Den · ulp),      g_i = (f p_i − s_i) t_i
///
///   smooth          p = 1    s = r_i           t = 1     Den = Σ E_i
///   noperspective   p = 1    s = r_i           t = w_i   Den = Σ w_i E_i = |det M|
///   depth           p = w_i  s = depth_i w_i   t = 1     Den = |det M|
///
/// f is what was computed. All of these are float32 but `s` of the depth, which is exact in double,
/// and f p_i is exact in double: g_i has two roundings.
struct ValueFilter {
  std::array<double, 3> p{1, 1, 1};
  std::array<double, 3> s{};
  std::array<double, 3> t{1, 1, 1};
  /// The edges' bands, each rounded up by 2^-40 of itself.
  std::array<double, 3> edge_error{};
  bool is_perspective = true;
  /// |det M| and what it may be off by; not of a perspective value.
  double determinant = 1;
  double determinant_error = 0;
  double units = 1;  ///< 1/ulp, a power of two
};

/// Enclosures [lo[k], hi[k]] of (f − r)/ulp for computed[k] at the first `count` samples; NaN
/// where there is none. Of constants that come back (each g_i = 0) exactly 0 ± 0.
///
///   S = fl(Σ g_i e_i)           is off by at most H = fl(Σ |g_i| (edge_error_i + 8u |e_i|))
///   q = fl(S · fl(1/Den))       is off by at most
///   h = fl(fl(H + |q| Z) · fl(1/Den)) (1 + 2^-18) + 4u |q|,   Z what Den is off by
///   lo = fl(q − h'), hi = fl(q + h'),    h' = fl(h + 2^-900), for what underflows; 0 if H is
///                                                         (proofs/value.g, proofs/quotient.g)
void value_errors(const ValueFilter& value, const BatchWeights& weights,
                  const Batch<double>& computed, int count, Batch<double>& lo, Batch<double>& hi);

/// Where a contract leaves the placement of vertices open (placement_filter.h): how far a sample is
/// shifted, in pixels, as a function of its weights: fixed + Σ per_weight_i E_i along each axis.
struct Shift {
  double fixed_x = 0;
  double fixed_y = 0;
  std::array<double, 3> per_weight_x{};
  std::array<double, 3> per_weight_y{};
};

/// As many as a triangle's samples have.
inline constexpr std::size_t kShifts = 4;

/// The shifts of a batch's samples; NaN unless every guard is above its band at the sample.
struct alignas(64) BatchShifts {
  std::array<Batch<double>, kShifts> x;
  std::array<Batch<double>, kShifts> y;
};

/// The shifts of the first `count` samples (x[k], y[k]), whose weights these are.
void shift_samples(const std::array<Shift, kShifts>& shifts, std::span<const FilterLine> guards,
                   const BatchWeights& weights, const Batch<double>& x, const Batch<double>& y,
                   int count, BatchShifts& shifted);

/// Holds what is asked of a value besides the readings that shifted samples give.
struct ShiftedReadings {
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  std::array<FilterLine, 3> edges;  ///< a and b count
  /// What E_i may be off by at a shifted sample.
  std::array<double, 3> edge_error{};
  bool has_unshifted = false;  ///< the sample itself gives a reading as well
  double least = 0;            ///< a value below this is not asked about
  double greatest = 0;         ///< nor one above
  /// What readings but that of the sample itself are cut down to; infinite where they are not.
  records::Enclosure least_end{-kUnbounded, -kUnbounded};
  records::Enclosure greatest_end{kUnbounded, kUnbounded};
};

/// Bit k: computed[k] certainly lies between two readings of its value. With g_i as in ValueFilter,
///
///   G(p) = Σ g_i E_i(p)        is >= 0 where the reading at p is at most the computed value,
///                              and <= 0 where it is at least that;
///
/// G is affine in p, and at a shifted sample p − s it is G(p) less what each axis adds. What is
/// computed of that is off by at most
///
///   H = fl(Σ |g_i| (edge_error_i + 16u |e_i|)).                        (proofs/shifted.g)
///
/// Nothing is said (bit 0) of samples whose shifts or reciprocal are NaN.
void find_between_readings(const ValueFilter& value, const ShiftedReadings& readings,
                           const BatchWeights& weights, const BatchShifts& shifts,
                           const Batch<double>& computed, int count,
                           std::array<std::uint64_t, kBatchSize / 64>& is_between);

/// What errors have to keep for nothing else to be asked of them.
struct ErrorLimits {
  double bound = 0;  ///< |error| is at most this, and at most kMostSummed
  double least = 0;  ///< error is at least this
  double most = 0;   ///< error is at most this
};
inline constexpr double kMostSummed = 0x1p23;

/// Errors that keep the limits and of which one bucket of a records::Histogram holds all that the
/// enclosure leaves.
struct CountedErrors {
  std::array<std::uint64_t, kBatchSize / 64> is_counted{};  ///< bit k
  Batch<std::int64_t> bucket;                               ///< of those
  /// Their sum in units of records::SignedSum, each rounded outwards: below 2^(23 + 32 + 7).
  std::int64_t sum_lo = 0;
  std::int64_t sum_hi = 0;
};
void count_errors(const ErrorLimits& limits, const Batch<double>& lo, const Batch<double>& hi,
                  int count, CountedErrors& counted);

}  // namespace rastercheck::oracle
