// Compares the filter's kernels with rationals, with every kind of vector instructions, and the
// kinds with each other.

#include "oracle/internal/filter_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "oracle/internal/intervals.h"
#include "oracle/internal/triangle_filter.h"
#include "records/histogram.h"
#include "records/signed_sum.h"
#include "tests/oracle/drawing.h"
#include "tests/simd_targets.h"

namespace rastercheck::oracle::filter_kernels_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A number of about this size with twice as many bits as a double.
Ring long_number(Dice& dice, int exponent) {
  const auto part = [&dice](int e) {
    return Ring(std::ldexp(static_cast<double>(dice.bits() >> 11) - 0x1p52, e - 52));
  };
  return part(exponent) + part(exponent - 54);
}

/// A line whose value at a sample is zero to within about 2^-50 of the size of its terms.
Line line_through(Dice& dice, const Point& p, int exponent) {
  const Ring a = dice.one_in(8) ? Ring(0) : long_number(dice, exponent - dice.between(0, 9));
  const Ring b = dice.one_in(8) ? Ring(0) : long_number(dice, exponent);
  const Ring size = magnitude(a) * p.u + magnitude(b) * p.v;
  const Ring off = size * Ring(dice.between(-24, 24)) * Ring(0x1p-53);
  return {a, b, off - a * p.u - b * p.v};
}

struct Place {
  double x;
  double y;
  Point point() const { return {Ring(x), Ring(y)}; }
};

Place random_place(Dice& dice, const PixelBox& box) {
  return {dice.between(0, box.x1 - 1) + dice.between(0, 15) / 16.0,
          dice.between(0, box.y1 - 1) + dice.between(0, 15) / 16.0};
}

Field at(const FilterLine& line, double x, double y) {
  return Field(line.a) * Field(x) + Field(line.b) * Field(y) + Field(line.c);
}

/// The largest difference, at (x, y), between the filter's line and the exact line, whose
/// coefficients are within kNearDoubleError of the filter's.
Field slack_of(const FilterLine& line, double x, double y) {
  return Field(kNearDoubleError) * at({std::abs(line.a), std::abs(line.b), std::abs(line.c)}, x, y);
}

class FilterKernels : public testing::TestWithParam<std::int64_t> {
 protected:
  OnTarget on_target_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Targets, FilterKernels, testing::ValuesIn(all_targets()), target_name);

bool bit(const std::vector<std::uint64_t>& words, int j) {
  return (words[static_cast<std::size_t>(j) / 64] >> (j % 64) & 1U) != 0;
}

// By hand: x − k/2 and y − 1/4, with y at least 1/4.
TEST_P(FilterKernels, RowsAreClassifiedToTheBit) {
  for (const int count : {1, 7, 63, 64, 65, 127, 128, 129, 200}) {
    for (int k = -1; k <= 2 * count; ++k) {
      const std::array<FilterLine, 2> lines{{{1, 0, -0.5 * k, 0x1p-40}, {0, 1, -0.25, 0}}};
      const auto words = static_cast<std::size_t>((count + 63) / 64);
      for (const double y : {0.25, 0.5}) {
        std::vector<std::uint64_t> inside(words, ~std::uint64_t{0});
        std::vector<std::uint64_t> outside(words, ~std::uint64_t{0});
        classify_row(lines, 0.5, y, count, inside.data(), outside.data());
        for (int j = 0; j < 64 * static_cast<int>(words); ++j) {
          const int side = 2 * j + 1 - k;
          ASSERT_EQ(bit(inside, j), j < count && side > 0 && y > 0.25) << j << " of " << count;
          ASSERT_EQ(bit(outside, j), j < count && side < 0) << j << " of " << count;
        }
      }
    }
  }
}

// Kills: a band that is smaller than the errors of the coefficients plus the roundings.
TEST_P(FilterKernels, ClassifySamplesOnTheRightSideOfLines) {
  Dice dice(1);
  int decided = 0;
  int near = 0;
  for (int round = 0; round < 400; ++round) {
    const PixelBox box{0, 0, dice.between(1, 130), dice.pick({1, 9, 16384})};
    const Place place = random_place(dice, box);
    std::array<Line, 2> exact;
    std::array<FilterLine, 2> lines;
    for (std::size_t i = 0; i < 2; ++i) {
      exact[i] = line_through(dice, place.point(), dice.pick({0, 30, -500, 500}));
      lines[i] = filter_line(exact[i], box).value();
    }
    std::vector<std::uint64_t> inside(3);
    std::vector<std::uint64_t> outside(3);
    const double x0 = place.x - std::floor(place.x);
    classify_row(lines, x0, place.y, box.x1, inside.data(), outside.data());
    const int at_place = static_cast<int>(std::floor(place.x));
    for (int j = std::max(0, at_place - 2); j < std::min(box.x1, at_place + 3); ++j) {
      bool all_clear = true;
      bool any_clear_out = false;
      bool may_be_in = true;
      bool may_be_out = false;
      for (std::size_t i = 0; i < 2; ++i) {
        const Field e = at(lines[i], x0 + j, place.y);
        const Field slack = slack_of(lines[i], x0 + j, place.y);
        const Field band(lines[i].band);
        may_be_in =
            may_be_in && e > slack && sign_of(exact[i].at({Ring(x0 + j), Ring(place.y)})) > 0;
        may_be_out = may_be_out || e < -slack;
        all_clear = all_clear && e > 2 * band;
        any_clear_out = any_clear_out || e < -2 * band;
        near += magnitude(e) < 2 * band ? 1 : 0;
      }
      ASSERT_TRUE(may_be_in || !bit(inside, j)) << round;
      ASSERT_TRUE(may_be_out || !bit(outside, j)) << round;
      ASSERT_TRUE(bit(inside, j) || !all_clear) << round;
      ASSERT_TRUE(bit(outside, j) || !any_clear_out) << round;
      decided += bit(inside, j) || bit(outside, j) ? 1 : 0;
    }
  }
  EXPECT_GT(decided, 400);
  EXPECT_GT(near, 400);
}

// Coefficients from 2^-600 to 2^600, and 0.
TEST(FilterLines, AreMadeOfCoefficientsWithinTheLimitsOnly) {
  const PixelBox box{0, 0, 8, 8};
  const auto is_made = [&box](const Ring& a, const Ring& b, const Ring& c) {
    return filter_line({a, b, c}, box).has_value();
  };
  const Ring one(1);
  for (const double limit : {0x1p-600, 0x1p600}) {
    const Ring within(limit);
    const Ring beyond(std::nextafter(limit, limit < 1 ? 0 : kInfinity));
    EXPECT_TRUE(is_made(within, one, -one) && is_made(one, -within, one) &&
                is_made(one, one, within));
    EXPECT_FALSE(is_made(beyond, one, one) || is_made(one, -beyond, one) ||
                 is_made(one, one, beyond));
  }
  EXPECT_TRUE(is_made(Ring(0), Ring(0), Ring(0)));
}

// CGAL's own conversion is wrong at both ends of the range of doubles: 2^1024 becomes infinity, and
// when rounding upwards the smallest numbers become 2^-1074 and more.
TEST(IntervalLines, HoldNumbersBeyondTheDoubles) {
  const Ring big(0x1p1000);
  const Ring small(0x1p-1000);
  for (const Ring& number :
       {big * Ring(0x1p24), big * Ring(0x1.8p24), big * big, small * Ring(0x1.8p-75),
        small * Ring(0x1.8p-60), small * small, small * small * Ring(3), small * small * small}) {
    for (const Ring& signed_number : {number, -number}) {
      std::array<Interval, 2> intervals;
      intervals[0] = interval_of(signed_number);
      {
        const UpwardRounding upward;
        intervals[1] = interval_of(signed_number);
      }
      for (const Interval& interval : intervals) {
        EXPECT_TRUE(interval.inf() == -kInfinity || Ring(interval.inf()) <= signed_number);
        EXPECT_TRUE(interval.sup() == kInfinity || Ring(interval.sup()) >= signed_number);
        EXPECT_FALSE(interval.inf() == 0 && interval.sup() == 0);
        EXPECT_LT(interval.inf(), kInfinity);
        EXPECT_GT(interval.sup(), -kInfinity);
      }
    }
  }
}

/// Three edges across a box, most of them zero at a sample to within about 2^-50 of their terms'
/// size.
struct Edges {
  PixelBox box;
  std::array<Line, 3> exact;
  std::array<FilterLine, 3> lines;
  Batch<double> x{};
  Batch<double> y{};
  int count = 0;
};

Edges random_edges(Dice& dice) {
  Edges edges;
  edges.box = {0, 0, dice.between(1, 40), dice.between(1, 40)};
  const int exponent = dice.pick({0, 20, -560, 560});
  const Place near = random_place(dice, edges.box);
  // Usually one edge is close to zero at the sample, and the others, and so D, are well above zero.
  // In the other cases two edges cancel, or all are close to zero, and D is close to zero.
  const int kind = dice.between(0, 5);
  const auto past = static_cast<std::size_t>(dice.between(0, 3));
  const Ring height = magnitude(long_number(dice, exponent + 3)) + Ring(std::ldexp(1.0, exponent));
  for (std::size_t i = 0; i < 3; ++i) {
    Line& line = edges.exact[i];
    line = line_through(dice, near.point(), exponent - dice.between(0, 20));
    if (kind == 0) {
      const Ring less(1 - std::ldexp(1.0, -dice.between(10, 40)));
      line.c += i == 0 ? height : i == 1 ? -height * less : Ring(0);
    } else if (kind > 1 && i != past) {
      line.c += height;
    }
    edges.lines[i] = filter_line(line, edges.box).value();
  }
  edges.count = dice.pick({1, 5, 64, 127, 128});
  for (std::size_t k = 0; k < static_cast<std::size_t>(edges.count); ++k) {
    const Place place = dice.one_in(2) ? near : random_place(dice, edges.box);
    edges.x[k] = place.x;
    edges.y[k] = place.y;
  }
  return edges;
}

/// A few of a batch's samples, among them the first and the last.
std::vector<std::size_t> some_lanes(Dice& dice, int count) {
  return {0, static_cast<std::size_t>(count) - 1,
          static_cast<std::size_t>(dice.between(0, count - 1)),
          static_cast<std::size_t>(dice.between(0, count - 1))};
}

std::array<Field, 3> exact_edges(const Edges& edges, std::size_t k) {
  const Point p{Ring(edges.x[k]), Ring(edges.y[k])};
  return {Field(edges.exact[0].at(p)), Field(edges.exact[1].at(p)), Field(edges.exact[2].at(p))};
}

TEST_P(FilterKernels, WeightsAreWithinTheirBounds) {
  Dice dice(2);
  int certain = 0;
  int uncertain = 0;
  for (int round = 0; round < 400; ++round) {
    const Edges edges = random_edges(dice);
    BatchWeights weights;
    weigh_samples(edges.lines, edges.x, edges.y, edges.count, weights);
    for (const std::size_t k : some_lanes(dice, edges.count)) {
      const std::array<Field, 3> exact = exact_edges(edges, k);
      Field off = 0;  // bound, with the largest allowed errors of coefficients
      for (std::size_t i = 0; i < 3; ++i) {
        const Field e(weights.e[i][k]);
        const Field slack = slack_of(edges.lines[i], edges.x[k], edges.y[k]);
        const Field of_doubles = at(edges.lines[i], edges.x[k], edges.y[k]);
        ASSERT_LE(magnitude(e - of_doubles) + slack, Field(edges.lines[i].band)) << round;
        ASSERT_LE(magnitude(e - exact[i]), Field(edges.lines[i].band)) << round;
        off += Field(edges.lines[i].band);
      }
      const double sum = weights.e[0][k] + weights.e[1][k] + weights.e[2][k];
      const Field of_computed =
          Field(weights.e[0][k]) + Field(weights.e[1][k]) + Field(weights.e[2][k]);
      ASSERT_LE(magnitude(Field(sum) - of_computed) + off, Field(weights.error[k])) << round;
      const bool is_certain = !std::isnan(weights.reciprocal[k]);
      ASSERT_EQ(is_certain, weights.error[k] <= 0x1p-20 * sum) << round;
      ++(is_certain ? certain : uncertain);
      if (!is_certain) continue;
      ASSERT_GT(exact[0] + exact[1] + exact[2], Field(0)) << round;
      ASSERT_EQ(weights.reciprocal[k], 1 / sum) << round;
    }
  }
  EXPECT_GT(certain, 400);
  EXPECT_GT(uncertain, 100);
}

struct Value {
  ValueFilter filter;
  Ring determinant{1};
  Batch<double> computed{};
};

/// Values of vertices and computed values, many of them equal; some huge, some subnormal.
Value random_value(Dice& dice, const Edges& edges) {
  Value value;
  const float common = dice.real(-3, 3);
  const auto attribute = [&] {
    return dice.one_in(2) ? common
                          : dice.pick({dice.real(-3, 3), dice.real(90, 100), dice.real(-149, -130),
                                       moved(common, 1), 0.0F, -0.0F});
  };
  ValueFilter& filter = value.filter;
  for (std::size_t i = 0; i < 3; ++i) {
    filter.s[i] = attribute();
    filter.edge_error[i] = edges.lines[i].band * (1 + 0x1p-40);
  }
  filter.is_perspective = dice.one_in(3);
  const bool is_depth = !filter.is_perspective && dice.one_in(2);
  for (std::size_t i = 0; i < 3 && !filter.is_perspective; ++i) {
    const float w = dice.real(-20, 20);
    (is_depth ? filter.p[i] : filter.t[i]) = w;
    if (is_depth) filter.s[i] *= w;
  }
  if (!filter.is_perspective) {
    value.determinant = magnitude(long_number(dice, dice.pick({-60, 0, 60}))) + Ring(0x1p-80);
    filter.determinant = near_double(value.determinant);
    filter.determinant_error = kNearDoubleError * filter.determinant;
  }
  double largest = 0x1p-126;
  for (const double s : filter.s) largest = std::max(largest, std::abs(s));
  filter.units = std::ldexp(1.0, 23 - (is_depth ? dice.between(-126, 0) : std::ilogb(largest)));
  for (double& f : value.computed) f = dice.one_in(2) ? common : attribute();
  return value;
}

// Kills: an edge's band, or the error of D, that is left out; a radius without the roundings of its
// quotient.
TEST_P(FilterKernels, ErrorsOfValuesAreEnclosed) {
  Dice dice(3);
  int narrow = 0;
  int zero = 0;
  for (int round = 0; round < 1500; ++round) {
    const Edges edges = random_edges(dice);
    BatchWeights weights;
    weigh_samples(edges.lines, edges.x, edges.y, edges.count, weights);
    const Value value = random_value(dice, edges);
    Batch<double> lo;
    Batch<double> hi;
    value_errors(value.filter, weights, value.computed, edges.count, lo, hi);
    for (const std::size_t k : some_lanes(dice, edges.count)) {
      ASSERT_EQ(std::isnan(lo[k]) || std::isnan(hi[k]) || std::isinf(hi[k]) || std::isinf(lo[k]),
                std::isnan(weights.reciprocal[k]))
          << round;
      if (std::isnan(lo[k])) continue;
      const std::array<Field, 3> e = exact_edges(edges, k);
      Field sum = 0;
      bool is_constant = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const Field g =
            (Field(value.computed[k]) * Field(value.filter.p[i]) - Field(value.filter.s[i])) *
            Field(value.filter.t[i]);
        sum += g * e[i];
        is_constant = is_constant && sign_of(g) == 0;
      }
      const Field divisor =
          value.filter.is_perspective ? Field(e[0] + e[1] + e[2]) : Field(value.determinant);
      const Field error = sum / divisor * Field(value.filter.units);
      // The error lies strictly inside, unless it is 0: an enclosure that ends at a limit counts as
      // below it.
      const bool is_zero = lo[k] == 0 && hi[k] == 0;
      ASSERT_TRUE(is_zero || (Field(lo[k]) < error && error < Field(hi[k]))) << round;
      ASSERT_TRUE(is_zero ? sign_of(error) == 0 : !is_constant) << round;
      narrow += hi[k] - lo[k] <= 0x1p-40 * std::abs(hi[k]) ? 1 : 0;
      zero += is_constant ? 1 : 0;
    }
  }
  EXPECT_GT(narrow, 1000);
  EXPECT_GT(zero, 50);
}

TEST_P(FilterKernels, WhatIsNoNumberHasNoFiniteEnclosure) {
  BatchWeights weights;
  const Batch<double> ones = [] {
    Batch<double> all;
    all.fill(1);
    return all;
  }();
  weigh_samples({{{1, 0, 0, 0x1p-50}, {0, 1, 0, 0x1p-50}, {0, 0, 1, 0x1p-50}}}, ones, ones, 1,
                weights);
  for (const double f : {kNaN, kInfinity, -kInfinity}) {
    Batch<double> computed;
    computed.fill(f);
    Batch<double> lo;
    Batch<double> hi;
    value_errors(ValueFilter(), weights, computed, 1, lo, hi);
    CountedErrors counted;
    count_errors({kInfinity, -kInfinity, kInfinity}, lo, hi, 1, counted);
    EXPECT_EQ(counted.is_counted[0], 0U);
  }
}

/// Ends of enclosures that are hardest to count: borders of buckets, limits, and their neighbours.
double random_end(Dice& dice, double bound) {
  const auto border = [&dice] {
    const int last = static_cast<int>(records::Histogram::kBorderCount) - 1;
    return records::Histogram::borders_begin()[dice.between(0, last)];
  };
  double size = dice.pick({0.0, bound, kMostSummed, 0x1p-1074, 0x1p-33, dice.between(0, 999) / 97.0,
                           border(), border(), border(), kInfinity, kNaN});
  if (dice.one_in(2)) size = std::nextafter(size, dice.one_in(2) ? 0 : kInfinity);
  return dice.one_in(2) ? size : -size;
}

// Kills: a border counted in the next bucket; a sum rounded inwards or to nearest.
TEST_P(FilterKernels, ErrorsAreCountedAsHistogramAndSumCountThem) {
  Dice dice(4);
  int counted_in_all = 0;
  for (int round = 0; round < 2000; ++round) {
    const double bound = dice.pick({0.5, 4.0, 0x1p23, 0x1p30});
    const ErrorLimits limits{bound, -dice.pick({0.0, 0.25, 3.0, 0x1p50}),
                             dice.pick({0.0, 0.25, 3.0, 0x1p50})};
    const int count = dice.pick({1, 5, 63, 64, 65, 127, 128});
    Batch<double> lo;
    Batch<double> hi;
    for (std::size_t k = 0; k < lo.size(); ++k) {
      lo[k] = random_end(dice, bound);
      // Usually in the same bucket.
      hi[k] = dice.one_in(3) ? random_end(dice, bound)
                             : std::nextafter(lo[k], dice.one_in(2) ? kInfinity : lo[k]);
      if (lo[k] > hi[k]) std::swap(lo[k], hi[k]);
    }
    CountedErrors counted;
    count_errors(limits, lo, hi, count, counted);
    records::SignedSum sum;
    for (std::size_t k = 0; k < lo.size(); ++k) {
      const double most = std::max(std::abs(lo[k]), std::abs(hi[k]));
      const double least =
          lo[k] <= 0 && hi[k] >= 0 ? 0 : std::min(std::abs(lo[k]), std::abs(hi[k]));
      const bool keeps_limits = k < static_cast<std::size_t>(count) && lo[k] >= limits.least &&
                                hi[k] <= limits.most && most <= std::min(bound, kMostSummed);
      const bool is_expected = keeps_limits && records::Histogram::bucket_of(least) ==
                                                   records::Histogram::bucket_of(most);
      ASSERT_EQ((counted.is_counted[k / 64] >> (k % 64) & 1U) != 0, is_expected)
          << lo[k] << " " << hi[k];
      if (!is_expected) continue;
      ASSERT_EQ(static_cast<std::size_t>(counted.bucket[k]), records::Histogram::bucket_of(most))
          << most;
      sum.add({lo[k], hi[k]});
      ++counted_in_all;
    }
    ASSERT_TRUE(counted.sum_lo == sum.lo() && counted.sum_hi == sum.hi()) << round;
  }
  EXPECT_GT(counted_in_all, 1000);
}

/// Everything that the kernels compute for some batches, to the bit.
std::vector<std::uint64_t> all_bits() {
  std::vector<std::uint64_t> bits;
  const auto add = [&bits](const Batch<double>& batch, int count) {
    std::transform(batch.begin(), batch.begin() + count, std::back_inserter(bits), [](double d) {
      return std::bit_cast<std::uint64_t>(std::isnan(d) ? kNaN : d);  // any NaN will do
    });
  };
  Dice dice(5);
  for (int round = 0; round < 300; ++round) {
    const Edges edges = random_edges(dice);
    std::vector<std::uint64_t> rows(6);
    classify_row(edges.lines, 0.5, edges.y[0], 150, rows.data(), rows.data() + 3);
    bits.insert(bits.end(), rows.begin(), rows.end());
    BatchWeights weights;
    weigh_samples(edges.lines, edges.x, edges.y, edges.count, weights);
    for (const auto* batch :
         {&weights.e[0], &weights.e[1], &weights.e[2], &weights.reciprocal, &weights.error}) {
      add(*batch, edges.count);
    }
    const Value value = random_value(dice, edges);
    Batch<double> lo{};
    Batch<double> hi{};
    value_errors(value.filter, weights, value.computed, edges.count, lo, hi);
    add(lo, edges.count);
    add(hi, edges.count);
    CountedErrors counted;
    count_errors({0x1p23, -0x1p20, 0x1p20}, lo, hi, edges.count, counted);
    bits.insert(bits.end(), counted.is_counted.begin(), counted.is_counted.end());
    bits.push_back(static_cast<std::uint64_t>(counted.sum_lo));
    bits.push_back(static_cast<std::uint64_t>(counted.sum_hi));
  }
  return bits;
}

TEST_P(FilterKernels, GiveTheSameBitsAsOnAnyOther) {
  const std::vector<std::uint64_t> here = all_bits();
  const OnTarget first(all_targets().front());
  EXPECT_TRUE(here == all_bits());
}

}  // namespace
}  // namespace rastercheck::oracle::filter_kernels_test
