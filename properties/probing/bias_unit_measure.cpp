// Measures r, what the constant of a depth bias is multiplied by.
//
// Draws planes of constant depth d with a constant C and no slope. A depth that is stored as k in a
// unorm format of b bits says
//
//   r C ∈ [(k − greatest) / (2^b − 1), (k − least) / (2^b − 1)] − d,
//
// with the errors of storing that were measured before. What limits a depth, 0 or 1, bounds r C on
// one side only. All depths and constants together leave an interval for r. Depths of float32 are
// drawn in several binades, and r is measured in units of 2^(e−23), where e is the depth's
// exponent. If no r explains all samples exactly, each sum may be off by float32 rounding.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "cases/names.h"
#include "properties/probing/depth_planes.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

using cases::BiasUnit;
using cases::DepthFormat;

/// Product, sum and conversion, each of a number up to 1: 2^-25, and once more in reserve.
constexpr double kFloatArithmetic = 4 * 0x1p-25;
/// The same in float32, in units of 2^(e−23), where sums stay below 2^(e+1).
constexpr double kFloatSum = 4 * 0.5;

/// Values of r that one sample permits, in units of the format: 2^-b or 2^(e−23).
struct UnitRange {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool has(double ratio) const { return lo <= ratio && ratio <= hi; }
};

/// A sample: r · C in units of the format lies in `sum`, and C is known.
struct UnitSample {
  UnitRange sum;
  double constant = 0;
  double rounding = 0;  ///< what float32 arithmetic may change in `sum`

  UnitRange range(bool is_rounded) const {
    const double more = is_rounded ? rounding : 0;
    const UnitRange wide{(sum.lo - more) / constant, (sum.hi + more) / constant};
    return constant > 0 ? wide : UnitRange{wide.hi, wide.lo};
  }
};

struct UnitReading {
  std::vector<UnitSample> samples;
  std::uint64_t no_numbers = 0;
};

double unit_of_format(DepthFormat format, double depth) {
  const int bits = cases::unorm_bits(format);
  return std::ldexp(1.0, bits > 0 ? -bits : exponent_of(depth) - 23);
}

/// Depths from 1/4 to 1/2 or, of float32, in four binades and in their lower half.
std::vector<DepthTriangle> planes_to_lift(Draw& draw, DepthFormat format) {
  std::vector<DepthTriangle> all;
  for (std::size_t cell = 0; cell < kDepthCells; ++cell) {
    double depth = std::ldexp(draw.between(1 << 23, (1 << 24) - 1), -25);
    if (cases::unorm_bits(format) == 0) {
      // Few digits, so that OpenGL's z = 2 d − 1 is exact in all binades.
      depth = std::ldexp(draw.between(1 << 18, (1 << 18) + (1 << 17)),
                         -19 - static_cast<int>(cell % 4));
    }
    all.push_back(triangle_in_cell(cell, depth, 0, 0));
  }
  return all;
}

/// Adds the samples of a drawing with this constant under these rules.
void read_unit(Subject& subject, cases::Rules rules, DepthFormat format, float constant,
               const StoredError& error, UnitReading& reading) {
  MeasureDraw draw(subject, fmt::format("unit in {}", cases::name_of(format)),
                   static_cast<std::uint64_t>(std::llround(std::fabs(constant))));
  const std::vector<DepthTriangle> triangles = planes_to_lift(draw, format);
  const auto drawn =
      draw_planes(subject, triangles, {.bias = {constant, 0, 0}, .format = format, .rules = rules});
  const int bits = cases::unorm_bits(format);
  const double steps = std::ldexp(1.0, bits) - 1;
  for (std::size_t i = 0; drawn && i < drawn->size(); ++i) {
    const double depth = triangles[drawn->triangle[i]].depth[0];
    const double unit = unit_of_format(format, depth);
    UnitSample sample{{}, double{constant}, bits > 0 ? kFloatArithmetic / unit : kFloatSum};
    if (bits == 0) {
      const double offset = (double{drawn->depth[i]} - depth) / unit;
      sample.sum = {offset, offset};
    } else if (const auto k = number_of_depth(drawn->depth[i], bits)) {
      if (*k > 0) sample.sum.lo = ((*k - error.greatest) / steps - depth) / unit;
      if (*k < steps) sample.sum.hi = ((*k - error.least) / steps - depth) / unit;
    } else {
      ++reading.no_numbers;
      continue;
    }
    reading.samples.push_back(sample);
  }
}

std::string unit_words(BiasUnit unit, int bits) {
  switch (unit) {
    case BiasUnit::power:
      return fmt::format("2^{}", -bits);
    case BiasUnit::double_power:
      return fmt::format("2^{}", 1 - bits);
    case BiasUnit::either_power:
      return fmt::format("2^{} to 2^{}", -bits, 1 - bits);
    case BiasUnit::least_value:
      return fmt::format("1/(2^{} - 1)", bits);
    case BiasUnit::open:
      break;
  }
  return fmt::format("up to 2^{}", 1 - bits);
}

/// A value of r with a name.
struct NamedUnit {
  BiasUnit unit = BiasUnit::open;
  double ratio = 0;  ///< in units of 2^-b
  std::string words;
  bool is_permitted = true;  ///< by `unit`
};

std::vector<NamedUnit> named_units(int bits) {
  const double least = double{static_cast<float>(1 / (std::ldexp(1.0, bits) - 1))};
  const double ratio = std::ldexp(least, bits);
  std::vector<NamedUnit> all{{BiasUnit::power, 1, ""},
                             {BiasUnit::double_power, 2, ""},
                             {BiasUnit::least_value, ratio, ""}};
  for (NamedUnit& one : all) one.words = unit_words(one.unit, bits);
  // Mesa's. A little more than any API permits, nearest to 2^(1−b).
  all.push_back({BiasUnit::double_power, 2 * ratio, fmt::format("2/(2^{} - 1)", bits), false});
  return all;
}

/// The r that explains all samples together, if one does.
struct FittedUnit {
  UnitRange range;          ///< if no r explains all samples: how far apart they are
  bool is_any = false;      ///< some r explains all samples
  bool is_rounded = false;  ///< sums may be rounded
  double middle() const { return (range.lo + range.hi) / 2; }
};

FittedUnit fit_unit(const UnitReading& reading, bool is_rounded) {
  UnitRange range;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const UnitSample& sample : reading.samples) {
    const UnitRange one = sample.range(is_rounded);
    range = {std::max(range.lo, one.lo), std::min(range.hi, one.hi)};
    if (std::isfinite(one.lo)) greatest = std::max(greatest, one.lo);
    if (std::isfinite(one.hi)) least = std::min(least, one.hi);
  }
  const bool is_any = !reading.samples.empty() && range.lo <= range.hi;
  return {is_any ? range : UnitRange{least, greatest}, is_any, is_rounded};
}

records::Sureness sureness_of(const UnitReading& reading, const FittedUnit& fitted, double ratio) {
  std::uint64_t in_favour = 0;
  for (const UnitSample& sample : reading.samples) {
    if (sample.range(fitted.is_rounded).has(ratio)) ++in_favour;
  }
  return sure_of("samples", in_favour, reading.samples.size() - in_favour + reading.no_numbers);
}

std::string number_words(const FittedUnit& fitted, const std::string& unit) {
  if (!fitted.is_any) {
    return fmt::format("{:.4g} to {:.4g} · {}", fitted.range.lo, fitted.range.hi, unit);
  }
  return fmt::format("{:.6g} · {}", fitted.middle(), unit);
}

/// The unit that permits what the samples show of r where it has no name; empty if none does.
std::optional<BiasUnit> permitting(const FittedUnit& fitted) {
  const double least = fitted.is_any ? fitted.middle() : fitted.range.lo;
  const double greatest = fitted.is_any ? fitted.middle() : fitted.range.hi;
  if (least < 0 || greatest > 2) return std::nullopt;
  return least >= 1 ? BiasUnit::either_power : BiasUnit::open;
}

bool allows(BiasUnit declared, BiasUnit measured) {
  if (declared == measured || declared == BiasUnit::open) return true;
  return declared == BiasUnit::either_power && measured != BiasUnit::open;
}

/// The unit that permits both.
BiasUnit joined(BiasUnit a, BiasUnit b) {
  if (a == b) return a;
  return a == BiasUnit::open || b == BiasUnit::open ? BiasUnit::open : BiasUnit::either_power;
}

/// The r that the samples show for a unorm format.
struct SeenUnit {
  BiasUnit unit = BiasUnit::open;
  bool is_permitted = true;  ///< by `unit`
  std::string words;
  std::string detail;
  records::Sureness sureness;
};

SeenUnit seen_unit(const UnitReading& reading, int bits, BiasUnit declared) {
  // A name that needs rounding is better than a number that needs none.
  for (const bool is_rounded : {false, true}) {
    const FittedUnit fitted = fit_unit(reading, is_rounded);
    if (!fitted.is_any) continue;
    std::vector<NamedUnit> named;
    for (const NamedUnit& one : named_units(bits)) {
      if (fitted.range.has(one.ratio)) named.push_back(one);
    }
    if (named.empty()) continue;
    // If several explain all samples, takes the declared one.
    std::stable_partition(named.begin(), named.end(),
                          [&](const NamedUnit& one) { return one.unit == declared; });
    const NamedUnit& best = named.front();
    SeenUnit seen{best.unit, best.is_permitted, best.words, "",
                  sureness_of(reading, fitted, best.ratio)};
    for (std::size_t i = 1; i < named.size(); ++i) {
      seen.detail += (i == 1 ? "cannot be told from " : ", ") + named[i].words;
    }
    return seen;
  }
  const FittedUnit exact = fit_unit(reading, false);
  const FittedUnit fitted = exact.is_any ? exact : fit_unit(reading, true);
  const std::optional<BiasUnit> unit = permitting(fitted);
  return {unit.value_or(BiasUnit::open), unit.has_value(),
          number_words(fitted, fmt::format("2^{}", -bits)), "",
          sureness_of(reading, fitted, fitted.middle())};
}

/// Measures one unorm format: under the probe's own rules and, with fewer drawings, under the
/// others, which have a row if they differ. Adds to `unit` what the contract has to permit.
void measure_unorm_unit(Subject& subject, DepthFormat format, const StoredError& error,
                        std::optional<BiasUnit>& unit, BiasSight& sight) {
  const int bits = cases::unorm_bits(format);
  const cases::Rules own = subject.base().rules;
  std::vector<cases::Rules> all = subject.capabilities().rules;
  std::stable_partition(all.begin(), all.end(), [&](cases::Rules one) { return one == own; });
  std::string own_words;
  for (const cases::Rules rules : all) {
    // A large constant shows r to many digits, and a small one that r is the same for both. Sums
    // stay below 1 even if r is twice 2^-b.
    std::vector<float> constants{std::ldexp(1.0F, bits - 2)};
    if (rules == own) constants.insert(constants.end(), {-std::ldexp(1.0F, bits - 4), 5});
    UnitReading reading;
    for (const float constant : constants) {
      read_unit(subject, rules, format, constant, error, reading);
    }
    const BiasUnit declared = subject.declared(rules).depth_bias.unit;
    std::string what = fmt::format("unit of bias in {}", cases::name_of(format));
    if (reading.samples.empty()) {
      if (rules == own) subject.add(what, unit_words(declared, bits), "not drawn");
      continue;
    }
    const SeenUnit seen = seen_unit(reading, bits, declared);
    unit = unit ? joined(*unit, seen.unit) : seen.unit;
    if (seen.unit != declared) sight.differs = true;
    const std::string words = unit_words(declared, bits) + seen.words;
    if (rules == own) {
      own_words = words;
    } else {
      if (words == own_words) continue;
      what += fmt::format(", {}", cases::name_of(rules));
    }
    subject.add(what, unit_words(declared, bits), seen.words, seen.detail, seen.sureness)
        .contradicts = !seen.is_permitted || !allows(declared, seen.unit);
  }
}

void measure_float_unit(Subject& subject, BiasSight& sight) {
  UnitReading reading;
  for (const float constant : {0x1p16F, -0x1p12F, 5.0F}) {
    read_unit(subject, subject.base().rules, DepthFormat::float32, constant, {}, reading);
  }
  const std::string unit = "2^(e-23)";
  const std::string what = "unit of bias in float32";
  if (reading.samples.empty()) {
    subject.add(what, unit, "not drawn");
    return;
  }
  FittedUnit fitted = fit_unit(reading, false);
  if (!fitted.is_any) fitted = fit_unit(reading, true);
  const bool is_declared = fitted.is_any && fitted.range.has(1);
  const double ratio = is_declared ? 1 : fitted.middle();
  subject
      .add(what, unit, is_declared ? unit : number_words(fitted, unit), "",
           sureness_of(reading, fitted, ratio))
      .contradicts = !is_declared;
  if (fitted.is_any && ratio > 0) sight.float_ratio = ratio;
}

}  // namespace

void measure_bias_unit(Subject& subject, const Sight& seen, BiasSight& sight) {
  measure_float_unit(subject, sight);
  std::optional<BiasUnit> unit;
  for (const auto& [format, error] : seen.stored) {
    measure_unorm_unit(subject, format, error, unit, sight);
  }
  if (unit) sight.found.unit = *unit;
}

}  // namespace rastercheck::properties
