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

/// A value of r that an API names, in units of 2^-b.
struct NamedUnit {
  BiasUnit unit;
  double ratio;
};

std::vector<NamedUnit> named_units(int bits) {
  const double least = double{static_cast<float>(1 / (std::ldexp(1.0, bits) - 1))};
  return {{BiasUnit::power, 1},
          {BiasUnit::double_power, 2},
          {BiasUnit::least_value, std::ldexp(least, bits)}};
}

std::string words_for(BiasUnit unit, int bits) {
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

/// What all samples together say about r.
struct FittedUnit {
  UnitRange range;
  bool is_any = false;      ///< some r explains all samples
  bool is_rounded = false;  ///< only if sums are rounded
};

FittedUnit fit_unit(const UnitReading& reading) {
  FittedUnit fitted;
  for (const bool is_rounded : {false, true}) {
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
    // If no r explains all, the range says how far apart the samples are.
    fitted = {is_any ? range : UnitRange{least, greatest}, is_any, is_rounded};
    if (is_any) break;
  }
  return fitted;
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
  return fmt::format("{:.6g} · {}", (fitted.range.lo + fitted.range.hi) / 2, unit);
}

/// A unit seen in a unorm format: one of BiasUnit; empty if none of them permits it.
std::optional<BiasUnit> permitting(const FittedUnit& fitted) {
  if (!fitted.is_any) {
    // No r for all samples, but each has one.
    if (fitted.range.lo >= 1 && fitted.range.hi <= 2) return BiasUnit::either_power;
    if (fitted.range.lo >= 0 && fitted.range.hi <= 2) return BiasUnit::open;
    return std::nullopt;
  }
  const double middle = (fitted.range.lo + fitted.range.hi) / 2;
  if (middle >= 1 && middle <= 2) return BiasUnit::either_power;
  return middle >= 0 && middle <= 2 ? std::optional(BiasUnit::open) : std::nullopt;
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

cases::BiasPromise declared_bias(const Subject& subject, cases::Rules rules) {
  return subject.declared(rules).depth_bias;
}

/// Adds the row of a unorm format under some rules and returns what it shows; empty if nothing was
/// drawn.
std::optional<BiasUnit> add_unit(Subject& subject, cases::Rules rules, DepthFormat format,
                                 bool names_rules, const UnitReading& reading) {
  const int bits = cases::unorm_bits(format);
  const BiasUnit declared = declared_bias(subject, rules).unit;
  std::string what = fmt::format("unit of bias in {}", cases::name_of(format));
  if (names_rules) what += fmt::format(", {}", cases::name_of(rules));
  if (reading.samples.empty()) {
    subject.add(what, words_for(declared, bits), "not drawn");
    return std::nullopt;
  }
  const FittedUnit fitted = fit_unit(reading);
  std::vector<NamedUnit> named;
  for (const NamedUnit& one : named_units(bits)) {
    if (fitted.is_any && fitted.range.has(one.ratio)) named.push_back(one);
  }
  // Of several that explain all samples, the declared one.
  const auto chosen = std::find_if(named.begin(), named.end(),
                                   [&](const NamedUnit& one) { return one.unit == declared; });
  const NamedUnit* const best = chosen != named.end() ? &*chosen
                                : named.empty()       ? nullptr
                                                      : &named.front();
  const std::optional<BiasUnit> unit = best ? std::optional(best->unit) : permitting(fitted);
  std::string detail;
  for (const NamedUnit& one : named) {
    if (&one != best) detail += fmt::format("{} explains the same", words_for(one.unit, bits));
  }
  const std::string power = fmt::format("2^{}", -bits);
  const double ratio = best ? best->ratio : (fitted.range.lo + fitted.range.hi) / 2;
  subject
      .add(what, words_for(declared, bits),
           best ? words_for(best->unit, bits) : number_words(fitted, power), detail,
           sureness_of(reading, fitted, ratio))
      .contradicts = !unit || !allows(declared, *unit);
  return unit.value_or(BiasUnit::open);
}

/// Measures unorm formats under the given rules and adds to the sight what the contract has to say.
void measure_unorm_units(Subject& subject, const Sight& seen, cases::Rules rules, bool names_rules,
                         std::optional<BiasUnit>& unit, BiasSight& sight) {
  for (const auto& [format, error] : seen.stored) {
    const int bits = cases::unorm_bits(format);
    UnitReading reading;
    // A large constant shows r to many digits; a small one that r is the same for both. Sums stay
    // below 1 if r is twice 2^-b.
    const std::array<float, 3> constants{std::ldexp(1.0F, bits - 2), -std::ldexp(1.0F, bits - 4),
                                         5};
    // Rules that are not the probe's own differ in r, if at all.
    const std::size_t count = names_rules ? 1 : constants.size();
    for (std::size_t i = 0; i < count; ++i) {
      read_unit(subject, rules, format, constants[i], error, reading);
    }
    const std::optional<BiasUnit> one = add_unit(subject, rules, format, names_rules, reading);
    if (!one) continue;
    unit = unit ? joined(*unit, *one) : *one;
    if (*one != declared_bias(subject, rules).unit) sight.differs = true;
  }
}

void measure_float_unit(Subject& subject, cases::Rules rules, BiasSight& sight) {
  UnitReading reading;
  for (const float constant : {0x1p16F, -0x1p12F, 5.0F}) {
    read_unit(subject, rules, DepthFormat::float32, constant, {}, reading);
  }
  const std::string unit = "2^(e-23)";
  const std::string what = "unit of bias in float32";
  if (reading.samples.empty()) {
    subject.add(what, unit, "not drawn");
    return;
  }
  const FittedUnit fitted = fit_unit(reading);
  const bool is_declared = fitted.is_any && fitted.range.has(1);
  const double ratio = is_declared ? 1 : (fitted.range.lo + fitted.range.hi) / 2;
  subject
      .add(what, unit, is_declared ? unit : number_words(fitted, unit), "",
           sureness_of(reading, fitted, ratio))
      .contradicts = !is_declared;
  if (fitted.is_any && ratio > 0) sight.float_ratio = ratio;
}

}  // namespace

void measure_bias_unit(Subject& subject, const Sight& seen, BiasSight& sight) {
  const cases::Rules own = subject.base().rules;
  measure_float_unit(subject, own, sight);
  std::optional<BiasUnit> unit;
  measure_unorm_units(subject, seen, own, false, unit, sight);
  for (const cases::Rules rules : subject.capabilities().rules) {
    if (rules != own) measure_unorm_units(subject, seen, rules, true, unit, sight);
  }
  if (unit) sight.found.unit = *unit;
}

}  // namespace rastercheck::properties
