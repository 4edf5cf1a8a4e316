// Compiled once for each SIMD target; the processor's best one is chosen at run time.

#include "oracle/internal/filter_kernels.h"

#include <limits>

#include "records/histogram.h"
#include "records/signed_sum.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "oracle/internal/filter_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rastercheck::oracle {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// At most eight lanes, so that the number of lanes divides both a word of 64 samples and a batch.
using Doubles = hn::CappedTag<double, 8>;

template <class D, class M>
std::uint64_t bits_of([[maybe_unused]] D d, M mask) {
  alignas(8) std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  return bytes[0];
}

void ClassifyRow(std::span<const FilterLine> lines, double x, double y, int count,
                 std::uint64_t* inside, std::uint64_t* outside) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int from = 0; from < count; from += 64) {
    std::uint64_t all_in = ~std::uint64_t{0};
    std::uint64_t any_out = 0;
    const int end = count - from < 64 ? count - from : 64;
    for (const FilterLine& line : lines) {
      const auto a = hn::Set(d, line.a);
      const auto row = hn::Set(d, line.b * y + line.c);
      const auto band = hn::Set(d, line.band);
      const auto minus_band = hn::Set(d, -line.band);
      std::uint64_t in = 0;
      std::uint64_t out = 0;
      for (int j = 0; j < end; j += lanes) {
        // The sum is exact, because its terms are integers and multiples of 1/16.
        const auto position = hn::Add(hn::Set(d, x), hn::Iota(d, static_cast<double>(from + j)));
        const auto e = hn::Add(hn::Mul(a, position), row);
        in |= bits_of(d, hn::Gt(e, band)) << j;
        out |= bits_of(d, hn::Lt(e, minus_band)) << j;
      }
      all_in &= in;
      any_out |= out;
    }
    const std::uint64_t valid =
        end == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - std::uint64_t{1};
    inside[from / 64] = all_in & valid;
    outside[from / 64] = any_out & valid;
  }
}

void WeighSamples(const std::array<FilterLine, 3>& edges, const Batch<double>& x,
                  const Batch<double>& y, int count, BatchWeights& weights) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto bands = hn::Set(d, (edges[0].band + edges[1].band + edges[2].band) * (1 + 0x1p-40));
  const auto not_a_number = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < count; k += lanes) {
    const auto u = hn::LoadU(d, x.data() + k);
    const auto v = hn::LoadU(d, y.data() + k);
    const auto edge_at = [&](std::size_t i) HWY_ATTR {
      const auto row = hn::Add(hn::Mul(hn::Set(d, edges[i].b), v), hn::Set(d, edges[i].c));
      return hn::Add(hn::Mul(hn::Set(d, edges[i].a), u), row);
    };
    const auto e0 = edge_at(0);
    const auto e1 = edge_at(1);
    const auto e2 = edge_at(2);
    const auto sum = hn::Add(hn::Add(e0, e1), e2);
    const auto size = hn::Add(hn::Add(hn::Abs(e0), hn::Abs(e1)), hn::Abs(e2));
    const auto error = hn::Add(bands, hn::Mul(hn::Set(d, 0x1p-51), size));
    const auto is_certain = hn::Le(error, hn::Mul(hn::Set(d, 0x1p-20), sum));
    const auto reciprocal = hn::Div(hn::Set(d, 1.0), sum);
    hn::StoreU(e0, d, weights.e[0].data() + k);
    hn::StoreU(e1, d, weights.e[1].data() + k);
    hn::StoreU(e2, d, weights.e[2].data() + k);
    hn::StoreU(error, d, weights.error.data() + k);
    hn::StoreU(hn::IfThenElse(is_certain, reciprocal, not_a_number), d,
               weights.reciprocal.data() + k);
  }
}

/// True in the lanes where the last `zeros` bits of the double are 0.
template <class D, class V>
auto EndsInZeros(D d, V v, int zeros) {
  const hn::RebindToUnsigned<D> whole;
  const auto last = hn::Set(whole, (std::uint64_t{1} << static_cast<unsigned>(zeros)) - 1);
  return hn::RebindMask(d, hn::Eq(hn::And(hn::BitCast(whole, v), last), hn::Zero(whole)));
}

/// True in the lanes where sum = fl(a + b) is exactly a + b: a rounding error would show as a
/// changed a or b.
template <class V>
auto IsExactSum(V a, V b, V sum) {
  return hn::And(hn::Eq(hn::Sub(sum, b), a), hn::Eq(hn::Sub(sum, a), b));
}

/// The quotient of a value, valid only at samples with is_sum_exact.
template <class V, class M>
struct ExactQuotient {
  V quotient;         ///< fl(S/D)
  M is_sum_exact;     ///< S is exact
  M is_itself_exact;  ///< the quotient is exact, too
};

template <class D, class V>
auto QuotientWithoutRounding(D d, const ValueFilter& value, const BatchWeights& weights,
                             std::size_t k, V f) {
  auto sum = hn::Zero(d);
  auto divisor = hn::Zero(d);
  auto is_exact = hn::Eq(f, f);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto e = hn::LoadU(d, weights.e[i].data() + k);
    const auto s = hn::Set(d, value.s[i]);
    const auto g = hn::Sub(f, s);
    const auto product = hn::Mul(g, e);
    const auto next = hn::Add(sum, product);
    is_exact = hn::And(
        is_exact, hn::And(IsExactSum(f, hn::Neg(s), g), hn::And(EndsInZeros(d, g, value.exact_bits),
                                                                IsExactSum(sum, product, next))));
    sum = next;
    divisor = hn::Add(divisor, e);
  }
  const auto quotient = hn::Div(sum, divisor);
  const auto is_itself_exact = hn::And(is_exact, hn::And(EndsInZeros(d, quotient, value.exact_bits),
                                                         hn::Eq(hn::Mul(quotient, divisor), sum)));
  return ExactQuotient<V, decltype(is_exact)>{quotient, is_exact, is_itself_exact};
}

void ValueErrors(const ValueFilter& value, const BatchWeights& weights,
                 const Batch<double>& computed, int count, Batch<double>& lo, Batch<double>& hi) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto eight_u = hn::Set(d, 0x1p-50);
  const auto units = hn::Set(d, value.units);
  const auto constant_reciprocal = hn::Set(d, 1.0 / value.determinant);
  const auto constant_error = hn::Set(d, value.determinant_error);
  for (int k = 0; k < count; k += lanes) {
    const auto f = hn::LoadU(d, computed.data() + k);
    auto sum = hn::Zero(d);
    auto sum_error = hn::Zero(d);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = hn::LoadU(d, weights.e[i].data() + k);
      const auto difference = hn::Sub(hn::Mul(f, hn::Set(d, value.p[i])), hn::Set(d, value.s[i]));
      const auto g = hn::Mul(difference, hn::Set(d, value.t[i]));
      const auto e_error = hn::Add(hn::Set(d, value.edge_error[i]), hn::Mul(eight_u, hn::Abs(e)));
      sum = hn::Add(sum, hn::Mul(g, e));
      sum_error = hn::Add(sum_error, hn::Mul(hn::Abs(g), e_error));
    }
    // If D is not certain to be positive, not even an affine value is certain to be defined.
    const auto of_sum = hn::LoadU(d, weights.reciprocal.data() + k);
    const auto reciprocal =
        value.is_perspective ? of_sum
                             : hn::IfThenElse(hn::Eq(of_sum, of_sum), constant_reciprocal, of_sum);
    auto divisor_error =
        value.is_perspective ? hn::LoadU(d, weights.error.data() + k) : constant_error;
    auto q = hn::Mul(sum, reciprocal);
    auto has_no_error = hn::Eq(sum_error, hn::Zero(d));
    if (value.exact_bits > 0) {
      const auto exact = QuotientWithoutRounding(d, value, weights, static_cast<std::size_t>(k), f);
      // Like q, the quotient is NaN if D is not certain.
      const auto quotient = hn::IfThenElse(hn::Eq(of_sum, of_sum), exact.quotient, of_sum);
      q = hn::IfThenElse(exact.is_sum_exact, quotient, q);
      sum_error = hn::IfThenZeroElse(exact.is_sum_exact, sum_error);
      divisor_error = hn::IfThenZeroElse(exact.is_sum_exact, divisor_error);
      has_no_error = hn::Or(has_no_error, exact.is_itself_exact);
    }
    const auto size = hn::Abs(q);
    const auto absolute = hn::Mul(hn::Add(sum_error, hn::Mul(size, divisor_error)), reciprocal);
    const auto h =
        hn::Add(hn::Mul(absolute, hn::Set(d, 1 + 0x1p-18)), hn::Mul(hn::Set(d, 0x1p-51), size));
    // Products that underflow lose less than 2^-900. The sum of h and 2^-900 is large enough that
    // its product with `units`, which is at least 2^-104, does not underflow. If a constant is
    // reproduced, all products are 0; exact values lose nothing.
    const auto radius = hn::IfThenZeroElse(has_no_error, hn::Add(h, hn::Set(d, 0x1p-900)));
    hn::StoreU(hn::Mul(hn::Sub(q, radius), units), d, lo.data() + k);
    hn::StoreU(hn::Mul(hn::Add(q, radius), units), d, hi.data() + k);
  }
}

void ShiftSamples(const std::array<Shift, kShifts>& shifts, std::span<const FilterLine> guards,
                  const BatchWeights& weights, const Batch<double>& x, const Batch<double>& y,
                  int count, BatchShifts& shifted) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto not_a_number = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < count; k += lanes) {
    const auto u = hn::LoadU(d, x.data() + k);
    const auto v = hn::LoadU(d, y.data() + k);
    auto is_known = hn::FirstN(d, static_cast<std::size_t>(lanes));
    for (const FilterLine& guard : guards) {
      const auto row = hn::Add(hn::Mul(hn::Set(d, guard.b), v), hn::Set(d, guard.c));
      const auto inside = hn::Add(hn::Mul(hn::Set(d, guard.a), u), row);
      is_known = hn::And(is_known, hn::Gt(inside, hn::Set(d, guard.band)));
    }
    const auto e0 = hn::LoadU(d, weights.e[0].data() + k);
    const auto e1 = hn::LoadU(d, weights.e[1].data() + k);
    const auto e2 = hn::LoadU(d, weights.e[2].data() + k);
    const auto store = [&](double fixed, const std::array<double, 3>& per_weight,
                           Batch<double>& into) HWY_ATTR {
      auto shift = hn::Add(hn::Set(d, fixed), hn::Mul(hn::Set(d, per_weight[0]), e0));
      shift = hn::Add(shift, hn::Mul(hn::Set(d, per_weight[1]), e1));
      shift = hn::Add(shift, hn::Mul(hn::Set(d, per_weight[2]), e2));
      hn::StoreU(hn::IfThenElse(is_known, shift, not_a_number), d, into.data() + k);
    };
    for (std::size_t i = 0; i < kShifts; ++i) {
      store(shifts[i].fixed_x, shifts[i].per_weight_x, shifted.x[i]);
      store(shifts[i].fixed_y, shifts[i].per_weight_y, shifted.y[i]);
    }
  }
}

void FindBetweenReadings(const ValueFilter& value, const ShiftedReadings& readings,
                         const BatchWeights& weights, const BatchShifts& shifts,
                         const Batch<double>& computed, int count,
                         std::array<std::uint64_t, kBatchSize / 64>& is_between) {
  const Doubles d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto sixteen_u = hn::Set(d, 0x1p-49);
  const auto zero = hn::Zero(d);
  const bool has_unshifted = readings.has_unshifted;
  is_between = {};
  for (int k = 0; k < count; k += lanes) {
    const auto f = hn::LoadU(d, computed.data() + k);
    auto here = zero;
    auto along_x = zero;
    auto along_y = zero;
    auto error = zero;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = hn::LoadU(d, weights.e[i].data() + k);
      const auto difference = hn::Sub(hn::Mul(f, hn::Set(d, value.p[i])), hn::Set(d, value.s[i]));
      const auto g = hn::Mul(difference, hn::Set(d, value.t[i]));
      const auto e_error =
          hn::Add(hn::Set(d, readings.edge_error[i]), hn::Mul(sixteen_u, hn::Abs(e)));
      here = hn::Add(here, hn::Mul(g, e));
      along_x = hn::Add(along_x, hn::Mul(g, hn::Set(d, readings.edges[i].a)));
      along_y = hn::Add(along_y, hn::Mul(g, hn::Set(d, readings.edges[i].b)));
      error = hn::Add(error, hn::Mul(hn::Abs(g), e_error));
    }
    // Covers products that underflow, as in ValueErrors.
    error = hn::Add(error, hn::IfThenElseZero(hn::Gt(error, zero), hn::Set(d, 0x1p-900)));
    auto least = here;
    auto greatest = here;
    if (!has_unshifted) {
      least = hn::Set(d, std::numeric_limits<double>::infinity());
      greatest = hn::Neg(least);
    }
    for (std::size_t i = 0; i < kShifts; ++i) {
      const auto by_x = hn::Mul(along_x, hn::LoadU(d, shifts.x[i].data() + k));
      const auto by_y = hn::Mul(along_y, hn::LoadU(d, shifts.y[i].data() + k));
      const auto there = hn::Sub(hn::Sub(here, by_x), by_y);
      least = hn::Min(least, there);
      greatest = hn::Max(greatest, there);
    }
    const auto some_below = hn::Ge(greatest, error);
    const auto some_above = hn::Le(least, hn::Neg(error));
    const auto is_asked =
        hn::And(hn::Ge(f, hn::Set(d, readings.least)), hn::Le(f, hn::Set(d, readings.greatest)));
    const auto shift = hn::LoadU(d, shifts.x[0].data() + k);
    // If D is not certain to be positive, the sample itself may have no reading.
    const auto reciprocal = hn::LoadU(d, weights.reciprocal.data() + k);
    const auto has_readings = hn::And(hn::Eq(shift, shift), hn::Eq(reciprocal, reciprocal));
    const auto is_known = hn::And(has_readings, hn::FirstN(d, static_cast<std::size_t>(count - k)));
    const auto all = hn::And(hn::And(some_below, some_above), hn::And(is_asked, is_known));
    is_between[static_cast<std::size_t>(k) / 64] |= bits_of(d, all) << (k % 64);
  }
}

void CountErrors(const ErrorLimits& limits, const Batch<double>& lo, const Batch<double>& hi,
                 int count, CountedErrors& counted) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> whole;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  const double* borders = records::Histogram::borders_begin();
  constexpr int kLastStep = static_cast<int>(records::Histogram::kBorderCount) - 2;
  const auto bound = hn::Set(d, limits.bound < kMostSummed ? limits.bound : kMostSummed);
  const auto least_limit = hn::Set(d, limits.least);
  const auto most_limit = hn::Set(d, limits.most);
  const auto first_border = hn::Set(d, borders[0]);
  const auto units = hn::Set(d, 1 / records::SignedSum::kUnit);
  auto sum_lo = hn::Zero(whole);
  auto sum_hi = hn::Zero(whole);
  counted.is_counted = {};
  for (int k = 0; k < count; k += lanes) {
    const auto low = hn::LoadU(d, lo.data() + k);
    const auto high = hn::LoadU(d, hi.data() + k);
    const auto low_size = hn::Abs(low);
    const auto high_size = hn::Abs(high);
    // NaN fails these comparisons, so it never counts as within the limits.
    const auto keeps_bound = hn::And(hn::Le(low_size, bound), hn::Le(high_size, bound));
    const auto keeps_limits = hn::And(hn::Ge(low, least_limit), hn::Le(high, most_limit));
    const auto is_asked = hn::And(hn::And(keeps_bound, keeps_limits),
                                  hn::FirstN(d, static_cast<std::size_t>(count - k)));
    const auto most = hn::Max(low_size, high_size);
    const auto holds_zero = hn::And(hn::Le(low, zero), hn::Ge(high, zero));
    const auto least = hn::IfThenZeroElse(holds_zero, hn::Min(low_size, high_size));
    // The bucket of `most`, as records::Histogram::bucket_of finds it.
    const auto bits = hn::Sub(hn::BitCast(whole, most), hn::Set(whole, 1));
    const auto first_step =
        hn::Set(whole, static_cast<std::int64_t>(records::Histogram::kFirstStep));
    auto step = hn::Sub(hn::ShiftRight<records::Histogram::kBitsBelowStep>(bits), first_step);
    step = hn::Max(hn::Min(step, hn::Set(whole, kLastStep)), hn::Zero(whole));
    const auto border = hn::GatherIndex(d, borders, hn::Add(step, hn::Set(whole, 1)));
    const auto is_next = hn::RebindMask(whole, hn::Gt(most, border));
    const auto in_octaves =
        hn::Add(step, hn::IfThenElse(is_next, hn::Set(whole, 3), hn::Set(whole, 2)));
    const auto below = hn::GatherIndex(d, borders, hn::Sub(in_octaves, hn::Set(whole, 2)));
    const auto is_small = hn::Le(most, first_border);
    const auto is_zero = hn::Eq(most, zero);
    const auto above_lower = hn::Gt(least, hn::IfThenZeroElse(is_small, below));
    const auto is_counted = hn::And(is_asked, hn::Or(is_zero, above_lower));
    auto bucket = hn::IfThenElse(hn::RebindMask(whole, is_small), hn::Set(whole, 1), in_octaves);
    bucket = hn::IfThenZeroElse(hn::RebindMask(whole, is_zero), bucket);
    hn::StoreU(bucket, whole, counted.bucket.data() + k);
    counted.is_counted[static_cast<std::size_t>(k) / 64] |= bits_of(d, is_counted) << (k % 64);

    const auto in_units = [&](auto value) HWY_ATTR {
      return hn::ConvertTo(whole, hn::Floor(hn::Mul(hn::IfThenElseZero(is_counted, value), units)));
    };
    sum_lo = hn::Add(sum_lo, in_units(low));
    sum_hi = hn::Sub(sum_hi, in_units(hn::Neg(high)));
  }
  Batch<std::int64_t> parts;
  counted.sum_lo = 0;
  counted.sum_hi = 0;
  hn::StoreU(sum_lo, whole, parts.data());
  for (std::size_t i = 0; i < hn::Lanes(whole); ++i) counted.sum_lo += parts[i];
  hn::StoreU(sum_hi, whole, parts.data());
  for (std::size_t i = 0; i < hn::Lanes(whole); ++i) counted.sum_hi += parts[i];
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::oracle
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::oracle {

HWY_EXPORT(ClassifyRow);
HWY_EXPORT(WeighSamples);
HWY_EXPORT(ValueErrors);
HWY_EXPORT(ShiftSamples);
HWY_EXPORT(FindBetweenReadings);
HWY_EXPORT(CountErrors);

void classify_row(std::span<const FilterLine> lines, double x, double y, int count,
                  std::uint64_t* inside, std::uint64_t* outside) {
  HWY_DYNAMIC_DISPATCH(ClassifyRow)(lines, x, y, count, inside, outside);
}

void weigh_samples(const std::array<FilterLine, 3>& edges, const Batch<double>& x,
                   const Batch<double>& y, int count, BatchWeights& weights) {
  HWY_DYNAMIC_DISPATCH(WeighSamples)(edges, x, y, count, weights);
}

void value_errors(const ValueFilter& value, const BatchWeights& weights,
                  const Batch<double>& computed, int count, Batch<double>& lo, Batch<double>& hi) {
  HWY_DYNAMIC_DISPATCH(ValueErrors)(value, weights, computed, count, lo, hi);
}

void shift_samples(const std::array<Shift, kShifts>& shifts, std::span<const FilterLine> guards,
                   const BatchWeights& weights, const Batch<double>& x, const Batch<double>& y,
                   int count, BatchShifts& shifted) {
  HWY_DYNAMIC_DISPATCH(ShiftSamples)(shifts, guards, weights, x, y, count, shifted);
}

void find_between_readings(const ValueFilter& value, const ShiftedReadings& readings,
                           const BatchWeights& weights, const BatchShifts& shifts,
                           const Batch<double>& computed, int count,
                           std::array<std::uint64_t, kBatchSize / 64>& is_between) {
  HWY_DYNAMIC_DISPATCH(FindBetweenReadings)
  (value, readings, weights, shifts, computed, count, is_between);
}

void count_errors(const ErrorLimits& limits, const Batch<double>& lo, const Batch<double>& hi,
                  int count, CountedErrors& counted) {
  HWY_DYNAMIC_DISPATCH(CountErrors)(limits, lo, hi, count, counted);
}

}  // namespace rastercheck::oracle
#endif  // HWY_ONCE
