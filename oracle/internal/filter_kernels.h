#pragma once

// The cascade's first level: arithmetic in doubles with error bounds known in advance, many samples
// at a time, compiled for each SIMD target. No operation is fused or reordered, so all targets give
// the same bits.
//
// u = 2^-53; rounding is to nearest (oracle/internal/floating_point.h). Every bound below is proved
// by a script in oracle/proofs/, which uses the same names.

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The line a·x + b·y + c in positions relative to some pixel, with coefficients rounded to double.
/// Evaluated at a sample of the box of pixels that the line was made for,
///
///   fl(fl(a x) + fl(fl(b y) + c)),
///
/// differs from the exact line by at most `band`, which covers the errors of the coefficients and
/// the rounding.                                                              (proofs/edge.g)
struct FilterLine {
  double a = 0;
  double b = 0;
  double c = 0;
  double band = 0;
};

/// Tests the samples (x + j, y), j = 0 … count − 1, against the lines. Bit j of `inside`: every
/// line is above its band there, hence positive. Bit j of `outside`: some line is below minus its
/// band. Both must have room for (count + 63)/64 words; bits from count on become zero.
void classify_row(std::span<const FilterLine> lines, double x, double y, int count,
                  std::uint64_t* inside, std::uint64_t* outside);

/// The number of samples judged together.
inline constexpr int kBatchSize = 128;
template <typename T>
using Batch = std::array<T, kBatchSize>;

/// The three edge functions at each sample of a batch, and the reciprocal of their sum D.
struct alignas(64) BatchWeights {
  std::array<Batch<double>, 3> e;
  /// fl(1/D), D = fl(fl(e0 + e1) + e2); NaN if the relative error of D may exceed 2^-20; every
  /// question about the sample then stays open.
  Batch<double> reciprocal;
  /// The largest error of D: Σ band (1 + 2^-40) + 4u Σ|e_i|.               (proofs/sum.g)
  Batch<double> error;
};

/// The weights at the first `count` samples (x[k], y[k]). Each edges[i].band contributes to
/// weights.error.
void weigh_samples(const std::array<FilterLine, 3>& edges, const Batch<double>& x,
                   const Batch<double>& y, int count, BatchWeights& weights);

/// The numbers from which a value's error is computed, as a quotient:
///
///   (f − r)/ulp  =  Σ g_i E_i / (Den · ulp),      g_i = (f p_i − s_i) t_i
///
///   smooth          p = 1    s = r_i           t = 1     Den = Σ E_i
///   noperspective   p = 1    s = r_i           t = w_i   Den = Σ w_i E_i = |det M|
///   depth           p = w_i  s = depth_i w_i   t = 1     Den = |det M|
///
/// f is the computed value. All of these are float32 except the depth's `s`, which is exact in
/// double; f p_i is also exact in double, so g_i has two roundings.
struct ValueFilter {
  std::array<double, 3> p{1, 1, 1};
  std::array<double, 3> s{};
  std::array<double, 3> t{1, 1, 1};
  /// The edges' bands, each rounded up by 2^-40 of itself.
  std::array<double, 3> edge_error{};
  bool is_perspective = true;
  /// |det M| and its largest error; unused for a perspective value.
  double determinant = 1;
  double determinant_error = 0;
  double units = 1;  ///< 1/ulp, a power of two
  /// If not 0, promises: (1) at every sample of the batch the edge functions and their sums have no
  /// error; (2) the sum of all three is the divisor; (3) all of these are multiples of one power of
  /// two, and below 2^exact_bits times that power; (4) all p and t are 1. At most kMostExactBits.
  int exact_bits = 0;
};
inline constexpr int kMostExactBits = 26;

/// Computes enclosures [lo[k], hi[k]] of (f − r)/ulp for computed[k] at the first `count` samples;
/// NaN if there is no enclosure. If a constant is reproduced exactly (each g_i = 0), the enclosure
/// is [0, 0].
///
///   S = fl(Σ g_i e_i)           is off by at most H = fl(Σ |g_i| (edge_error_i + 8u |e_i|))
///   q = fl(S · fl(1/Den))       is off by at most
///   h = fl(fl(H + |q| Z) · fl(1/Den)) (1 + 2^-18) + 4u |q|,   Z the largest error of Den
///   lo = fl(q − h'), hi = fl(q + h'),    h' = fl(h + 2^-900) to cover underflow,
///                                        but h' = 0 if all three g_i are 0
///                                                         (proofs/value.g, proofs/quotient.g)
///
/// With exact_bits, the kernel tests at each sample whether S has no error. A sum passes (f − r_i,
/// or a partial sum of S) if subtracting either term returns the other term exactly. A product g_i
/// E_i is exact if the last exact_bits bits of g_i are 0. If so,
///
///   q = fl(S/D)                 is off by at most u |q|, within h = 4u |q|
///   h' = 0                      if q, too, has exact_bits zeros at its end, and fl(q D) = S.
///
/// Nothing underflows: if not 0, |S| is at least 2^-955 (proofs/roundings.g), and D is below 2^620.
void value_errors(const ValueFilter& value, const BatchWeights& weights,
                  const Batch<double>& computed, int count, Batch<double>& lo, Batch<double>& hi);

/// For contracts that leave the placement of vertices open (placement_filter.h): the shift of a
/// sample, in pixels, as a function of its weights: fixed + Σ per_weight_i E_i along each axis.
struct Shift {
  double fixed_x = 0;
  double fixed_y = 0;
  std::array<double, 3> per_weight_x{};
  std::array<double, 3> per_weight_y{};
};

/// The number of shifts per sample.
inline constexpr std::size_t kShifts = 4;

/// The shifts of a batch's samples; NaN unless every guard is above its band at the sample.
struct alignas(64) BatchShifts {
  std::array<Batch<double>, kShifts> x;
  std::array<Batch<double>, kShifts> y;
};

/// Computes the shifts of the first `count` samples (x[k], y[k]), whose weights are `weights`.
void shift_samples(const std::array<Shift, kShifts>& shifts, std::span<const FilterLine> guards,
                   const BatchWeights& weights, const Batch<double>& x, const Batch<double>& y,
                   int count, BatchShifts& shifted);

/// The inputs of find_between_readings() besides the shifts: the edges and their errors, the values
/// to test, and the limits that readings are clamped to.
struct ShiftedReadings {
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  std::array<FilterLine, 3> edges;  ///< only a and b are used
  /// The largest error of E_i at a shifted sample.
  std::array<double, 3> edge_error{};
  bool has_unshifted = false;  ///< the sample itself gives a reading as well
  double least = 0;            ///< smaller values are not tested
  double greatest = 0;         ///< greater values are not tested
  /// Readings at shifted samples are clamped to these ends, unless the ends are infinite.
  records::Enclosure least_end{-kUnbounded, -kUnbounded};
  records::Enclosure greatest_end{kUnbounded, kUnbounded};
};

/// Sets bit k if computed[k] certainly lies between two readings of its value. With g_i as in
/// ValueFilter,
///
///   G(p) = Σ g_i E_i(p)        is >= 0 where the reading at p is <= the computed value,
///                              and <= 0 where the reading is >= the computed value;
///
/// G is affine in p; at a shifted sample p − s, G is G(p) minus one term per axis. G as computed in
/// double is off by at most
///
///   H = fl(Σ |g_i| (edge_error_i + 16u |e_i|)).                        (proofs/shifted.g)
///
/// The bits of samples whose shifts or reciprocal are NaN are cleared.
void find_between_readings(const ValueFilter& value, const ShiftedReadings& readings,
                           const BatchWeights& weights, const BatchShifts& shifts,
                           const Batch<double>& computed, int count,
                           std::array<std::uint64_t, kBatchSize / 64>& is_between);

/// Limits within which an error needs no further test.
struct ErrorLimits {
  double bound = 0;  ///< |error| <= min(bound, kMostSummed)
  double least = 0;  ///< error is at least this
  double most = 0;   ///< error is at most this
};
inline constexpr double kMostSummed = 0x1p23;

/// The errors of a batch that keep the limits and whose enclosures fit one bucket of a
/// records::Histogram.
struct CountedErrors {
  std::array<std::uint64_t, kBatchSize / 64> is_counted{};  ///< bit k
  Batch<std::int64_t> bucket;                               ///< the bucket of each counted error
  /// The sum of the counted errors, in units of records::SignedSum, each rounded outwards: below
  /// 2^(23 + 32 + 7).
  std::int64_t sum_lo = 0;
  std::int64_t sum_hi = 0;
};
void count_errors(const ErrorLimits& limits, const Batch<double>& lo, const Batch<double>& hi,
                  int count, CountedErrors& counted);

}  // namespace rastercheck::oracle
