// Measures the magnitudes of numbers that draw correctly: subnormal ones, and those next to
// overflow.
//
// Multiplying all clip positions by 2^e leaves the picture the same (RULES §1), and multiplying
// attribute values by 2^e multiplies the drawn values by 2^e. The numbers have few digits, so both
// products stay exact even if they are subnormal. e goes up and down from 0 in steps until the
// picture changes; then the last step is repeated in single steps. Infinities and NaN are not
// tried: cases have finite numbers only.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "cases/names.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {
namespace {

/// Exponents of the greatest and least scale: positions are at most 4, in steps of 1/8 or more.
constexpr int kGreatest = 125;
constexpr int kLeast = -146;
/// Exponent of the least normal float.
constexpr int kNormal = -126;

/// Returns a case of triangles whose numbers have few bits, with an attribute from 1 to 8.
cases::Case short_numbers(const Subject& subject) {
  constexpr int kTriangles = 12;
  MeasureDraw draw(subject, "numbers");
  cases::Case c = subject.base();
  c.attributes.push_back({"value"});
  for (int i = 0; i < kTriangles; ++i) {
    for (int k = 0; k < 3; ++k) {
      const float w = draw.pick(std::array{1.0F, 1.0F, 2.0F});
      const auto eighths = [&draw] { return static_cast<float>(draw.between(-9, 9)) / 8; };
      const float x = eighths() * w;
      const float y = eighths() * w;
      add_vertex(c, {x, y, w / 2, w});
      c.attribute_values.push_back(static_cast<float>(draw.between(8, 64)) / 8);
    }
    const auto end = static_cast<std::uint32_t>(c.positions.size());
    c.triangles.push_back({end - 3, end - 2, end - 1});
  }
  return c;
}

struct ExponentRange {
  int least = 1;  ///< exponents; greater than `greatest` if even 2^0 draws wrong
  int greatest = 0;
  int tried = 1;  ///< scales drawn
};

ExponentRange range_of(const std::function<bool(int)>& is_right) {
  int tried = 0;
  const auto holds = [&](int e) {
    ++tried;
    return is_right(e);
  };
  if (!holds(0)) return {};
  const auto last = [&holds](int end, int step) {
    int good = 0;
    for (int e = step; step > 0 ? e <= end : e >= end; e += step) {
      if (!holds(e)) break;
      good = e;
    }
    const int one = step > 0 ? 1 : -1;
    for (int e = good + one; step > 0 ? e <= end : e >= end; e += one) {
      if (e == good + step || !holds(e)) break;
      good = e;
    }
    return good;
  };
  const int least = last(kLeast, -9);
  const int greatest = last(kGreatest, 9);
  return {least, greatest, tried};
}

cases::Case with_scaled_positions(cases::Case c, int exponent) {
  for (cases::ClipVertex& p : c.positions) {
    for (float* number : {&p.x, &p.y, &p.z, &p.w}) *number = std::ldexp(*number, exponent);
  }
  return c;
}

cases::Case with_scaled_values(cases::Case c, int exponent) {
  // The greatest value is 8.
  for (float& value : c.attribute_values) value = std::ldexp(value, exponent - 3);
  return c;
}

/// Returns the greatest error of smooth values, in scale ULP; infinite if a value is no number.
double worst_smooth(const Subject& subject, const DrawnCase& drawn) {
  cases::ContractTerms lax = subject.result.terms;
  lax.smooth = cases::ValueBound{0x1.fffffep23F};  // a bound of 2^24 or more turns judging off
  records::Judgement judged = subject.judgement(drawn, lax);
  const records::ErrorStatistics& errors = judged.errors[records::AttributeKind::smooth];
  double worst = 0;
  for (const auto& end :
       {errors.excess.extremes.most_negative, errors.excess.extremes.most_positive}) {
    if (end) worst = std::max({worst, std::abs(end->error.lo), std::abs(end->error.hi)});
  }
  const bool has_wrong = errors.classes[records::FragmentClass::not_a_number] > 0 ||
                         errors.classes[records::FragmentClass::infinite] > 0;
  return has_wrong ? HUGE_VAL : worst;
}

std::string range_text(const ExponentRange& range, const char* unit) {
  if (range.least > range.greatest) return "none draw right";
  const auto word = [&](int e, int end, const char* beyond) {
    return fmt::format("{}2^{}{}", unit, e, e == end ? beyond : "");
  };
  return fmt::format("{} to {}", word(range.least, kLeast, ", the least tried"),
                     word(range.greatest, kGreatest, ", the greatest tried"));
}

std::string subnormal_text(const ExponentRange& range) {
  if (range.least > range.greatest) return "not seen";
  return range.least < kNormal ? "kept" : "lost";
}

/// True if some promised numbers do not come out right: the declared range contains a power of two
/// outside `range`.
bool loses_promised(const cases::MagnitudeRange& declared, const ExponentRange& range) {
  if (range.least > range.greatest) return true;
  return (range.least > kLeast && declared.least <= std::ldexp(1.0, range.least - 1)) ||
         (range.greatest < kGreatest && declared.greatest >= std::ldexp(1.0, range.greatest + 1));
}

}  // namespace

void measure_numbers(Subject& subject) {
  const cases::Case c = short_numbers(subject);
  const std::optional<DrawnCase> plain = subject.drawn(c);
  if (!plain) {
    subject.add("numbers", kNotDeclared, "not drawn");
    return;
  }
  const cases::ContractTerms& terms = subject.result.terms;
  const ExponentRange positions = range_of([&](int e) {
    const auto drawn = subject.drawn(with_scaled_positions(c, e));
    return drawn && subject.holds({*drawn}, terms);
  });
  // Values off by more than twice the usual error count as lost.
  const double usual = 2 * std::max(worst_smooth(subject, *plain), 0.5);
  const ExponentRange values = range_of([&](int e) {
    const auto drawn = subject.drawn(with_scaled_values(c, e));
    return drawn && worst_smooth(subject, *drawn) <= usual;
  });
  const cases::MagnitudeRange declared = subject.declared().numbers;
  const std::string says = fmt::format("{:g} to {:g}", declared.least, declared.greatest);
  subject
      .add("clip positions that draw right", says, range_text(positions, ""), "",
           sure_of("scales", positions.tried))
      .contradicts = loses_promised(declared, positions);
  subject
      .add("attribute values that come back", says, range_text(values, ""), "",
           sure_of("scales", values.tried))
      .contradicts = loses_promised(declared, values);
  subject.add("subnormal clip positions", kNotDeclared, subnormal_text(positions), "",
              sure_of("scales", positions.tried));
  subject.add("subnormal attribute values", kNotDeclared, subnormal_text(values), "",
              sure_of("scales", values.tried));
  subject.add("infinities and NaN", kNotDeclared, "not measured",
              "cases contain finite numbers only");
  if (positions.least > positions.greatest || values.least > values.greatest) return;
  cases::MagnitudeRange numbers;
  const int least = std::max(positions.least, values.least);
  if (least > kLeast) numbers.least = std::ldexp(1.0F, least);
  const int greatest = std::min(positions.greatest, values.greatest);
  if (greatest < kGreatest) numbers.greatest = std::ldexp(1.0F, greatest);
  subject.result.terms.numbers = numbers;
}

}  // namespace rastercheck::properties
