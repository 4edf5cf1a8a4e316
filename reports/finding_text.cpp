#include "reports/finding_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "cases/json.h"
#include "records/enclosure.h"
#include "reports/internal/exact_text.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

using records::AttributeKind;
using records::FragmentClass;
using records::Violation;

/// "0.161 to 0.164", or the text of an answer that is not a number.
std::string right_text(const Violation& violation, const std::optional<NumberRange>& right,
                       int digits) {
  constexpr std::size_t kLongest = 60;  // characters
  if (!right) return elided(cases::printable(violation.exact), kLongest);
  if (right->lo == right->hi) return fmt::format("{:.{}g}", right->lo, digits);
  return fmt::format("{:.{}g} to {:.{}g}", right->lo, digits, right->hi, digits);
}

std::string value_fault(const Violation& violation, const cases::Case& source) {
  const std::optional<NumberRange> right = numbers_in(violation.exact);
  const std::optional<NumberRange> drawn = numbers_in(violation.actual);
  if (violation.fragment_class == FragmentClass::wrong_sign_of_zero) {
    return fmt::format("{} was drawn as the zero of the other sign",
                       finding_value(violation, source));
  }
  constexpr int kFloatDigits = 9;  // these tell any two float32 numbers apart
  const int digits = right && drawn ? distinct_digits(drawn->lo, *right) : kFloatDigits;
  std::string actual = cases::printable(violation.actual);
  if (drawn) actual = fmt::format("{:.{}g}", drawn->lo, digits);
  if (violation.fragment_class == FragmentClass::not_a_number) actual = "NaN";
  return fmt::format("{} was drawn as {} and must be {}", finding_value(violation, source), actual,
                     right_text(violation, right, digits));
}

/// Why a coverage verdict is as it is: "forbidden: outside" → "outside".
std::string reason_of(const std::string& exact) {
  const std::size_t colon = exact.find(": ");
  return cases::printable(colon == std::string::npos ? exact : exact.substr(colon + 2));
}

/// True if the sample lies exactly on the edge or plane that decides its coverage.
bool is_tie(const Violation& violation) {
  return violation.distance && violation.distance->lo == 0 && violation.distance->hi == 0;
}

std::string coverage_fault(const Violation& violation) {
  switch (violation.fragment_class) {
    case FragmentClass::missing:
      // Answers to occlusion queries have this text in place of "not drawn".
      if (violation.actual == "called occluded") {
        return fmt::format("the triangle is called occluded, but the sample is visible ({})",
                           reason_of(violation.exact));
      }
      if (is_tie(violation) && violation.exact == "required: tie") {
        return "the sample is not drawn and must be: it lies exactly on an edge, and the fill rule "
               "gives it to this triangle";
      }
      return fmt::format("the sample is not drawn and must be ({})", reason_of(violation.exact));
    case FragmentClass::extra:
      if (violation.exact.starts_with("required") || violation.exact.starts_with("permitted")) {
        return "the sample is drawn more than once";
      }
      if (is_tie(violation) && violation.exact == "forbidden: outside") {
        return "the sample is drawn and must not be: it lies exactly on an edge, and the fill rule "
               "gives it to the other side";
      }
      return fmt::format("the sample is drawn and must not be ({})", reason_of(violation.exact));
    case FragmentClass::wrong_triangle:
      return "the triangle is visible and must not be: another one is nearest here";
    default:
      break;
  }
  return fmt::format("drawn: {}; must be: {}", cases::printable(violation.actual),
                     cases::printable(violation.exact));
}

/// The span of the numbers between which a triangle's values lie. 0 if unknown.
double range_of(const Violation& violation, const cases::Case& source) {
  if (violation.kind == AttributeKind::depth) {
    return std::abs(static_cast<double>(source.viewport.max_depth) - source.viewport.min_depth);
  }
  if (!violation.attribute || *violation.attribute >= source.attributes.size() ||
      violation.place.triangle >= source.triangles.size()) {
    return 0;
  }
  double lo = std::numeric_limits<double>::infinity();
  double hi = -lo;
  for (const std::uint32_t vertex : source.triangles[violation.place.triangle]) {
    const double value = source.attributes_of(vertex)[*violation.attribute];
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  return hi - lo;
}

/// "1/18 of the attribute's range", "3.5 times the depth range"; empty if unknown.
std::string share_text(const Violation& violation, const cases::Case& source) {
  constexpr double kLeast = 1e-3;  // below it a share says less than the number of ULP
  const std::optional<NumberRange> right = numbers_in(violation.exact);
  const std::optional<NumberRange> drawn = numbers_in(violation.actual);
  const double range = range_of(violation, source);
  if (!right || !drawn || !(range > 0)) return "";
  const double share = std::max(right->lo - drawn->lo, drawn->lo - right->hi) / range;
  if (!(share >= kLeast) || std::isinf(share)) return "";
  const std::string of = violation.kind == AttributeKind::depth
                             ? fmt::format("the depth range ({:.3g} to {:.3g})",
                                           source.viewport.min_depth, source.viewport.max_depth)
                             : std::string("the attribute's range");
  const double parts = std::round(1 / share);
  if (share > 1.05) return fmt::format("{:.2g} times {}", share, of);
  if (share > 0.95) return fmt::format("all of {}", of);
  return parts < 2 ? fmt::format("{:.2g} of {}", share, of) : fmt::format("1/{} of {}", parts, of);
}

/// "0.7", "2.3 million", "8.4 × 10^12".
std::string rounded_count(const records::Enclosure& error) {
  constexpr double kMillion = 1e6;
  constexpr double kBillion = 1e9;
  constexpr double kTrillion = 1e12;
  constexpr int kDigits = 3;
  const double size = records::magnitude_bound(error);
  if (size < kMillion) return number_text(records::magnitude(error));
  if (size < kBillion) return fmt::format("{:.2g} million", size / kMillion);
  if (size < kTrillion) return fmt::format("{:.2g} billion", size / kBillion);
  return fmt::format("{:.{}g}", size, kDigits);
}

}  // namespace

std::string finding_value(const Violation& violation, const cases::Case& source) {
  if (!violation.attribute) return "depth";
  const std::size_t attribute = *violation.attribute;
  if (attribute >= source.attributes.size() || source.attributes[attribute].name.empty()) {
    return fmt::format("attribute {}", attribute);
  }
  return fmt::format("attribute '{}'", cases::printable(source.attributes[attribute].name));
}

std::string finding_place(const Violation& violation, const cases::Case& source) {
  return fmt::format("pixel ({}, {}){} of triangle {}", violation.place.x, violation.place.y,
                     source.framebuffer.samples > 1
                         ? fmt::format(", sample {},", violation.place.sample)
                         : std::string(),
                     violation.place.triangle);
}

std::string finding_fault(const Violation& violation, const cases::Case& source) {
  if (!violation.has_place()) {
    return violation.note.empty() ? std::string(to_string(violation.fragment_class))
                                  : cases::printable(violation.note);
  }
  return violation.kind == AttributeKind::coverage ? coverage_fault(violation)
                                                   : value_fault(violation, source);
}

std::string finding_severity(const Violation& violation, const cases::Case& source) {
  if (!violation.has_place()) return "";
  if (violation.distance) {
    if (is_tie(violation)) return "";
    return fmt::format("{} pixels from the boundary", number_text(violation.distance));
  }
  if (!violation.error || violation.error->hi == 0) return "";
  const std::string_view unit = violation.kind == AttributeKind::depth ? "ULP" : "scale ULP";
  std::string count = fmt::format("{} {}", rounded_count(*violation.error), unit);
  const std::string share = share_text(violation, source);
  if (violation.bound && share.empty()) {
    return fmt::format("off by {}, {} allowed", count, number_text(violation.bound));
  }
  if (violation.bound) count += fmt::format(", {} allowed", number_text(violation.bound));
  return share.empty() ? "off by " + count : fmt::format("off by {} ({})", share, count);
}

std::string finding_text(const Violation& violation, const cases::Case& source) {
  if (!violation.has_place()) return finding_fault(violation, source);
  std::string text =
      fmt::format("{}: {}", finding_place(violation, source), finding_fault(violation, source));
  const std::string severity = finding_severity(violation, source);
  if (!severity.empty()) text += "; " + severity;
  if (!violation.note.empty()) text += "; " + cases::printable(violation.note);
  return text;
}

}  // namespace rastercheck::reports
