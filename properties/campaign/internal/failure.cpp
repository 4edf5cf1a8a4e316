#include "properties/campaign/internal/failure.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "oracle/transform.h"
#include "properties/judged_law.h"

namespace rastercheck::properties {
namespace {

using records::AttributeKind;
using records::Violation;

bool is_tie(const Violation& violation) {
  return violation.distance && violation.distance->lo == 0 && violation.distance->hi == 0;
}

bool is_clamped(const cases::ClipCase& c, const Violation& violation) {
  if (violation.kind != AttributeKind::depth) return false;
  if (!c.depth_clamp && c.rules != cases::Rules::d3d) return false;
  const cases::Triangle& triangle = c.triangles[violation.place.triangle];
  return std::any_of(triangle.begin(), triangle.end(), [&c](std::uint32_t vertex) {
    const cases::ClipVertex& p = c.positions[vertex];
    const float near = c.rules == cases::Rules::opengl ? -p.w : 0.0F;
    return p.z < near || p.z > p.w;
  });
}

std::string_view condition_of(const cases::ClipCase& c, const Violation& violation) {
  if (is_tie(violation)) return "tie";
  if (violation.place.triangle >= c.triangles.size()) return "ordinary";
  if (is_clamped(c, violation)) return "clamped";
  std::set<std::string> labels;
  add_state_labels(c, {violation.place.triangle}, labels);
  if (labels.contains("clipped") || labels.contains("w <= 0")) return "clipped";
  return labels.contains("several samples") ? "several samples" : "ordinary";
}

}  // namespace

void set_failure(cases::Found& found, const cases::Case& c, const Violation& violation) {
  found.verdict = to_string(violation.fragment_class);
  found.kind.clear();
  found.condition.clear();
  if (!violation.has_place()) return;
  found.kind = to_string(violation.kind);
  const Result<cases::ClipCase> clip = oracle::to_clip_case(c, "");
  found.condition = clip ? condition_of(*clip, violation) : "ordinary";
}

std::string without_numbers(std::string_view why) {
  constexpr std::string_view kDigits = "0123456789";
  std::string text;
  while (!why.empty()) {
    const std::size_t end = std::min(why.find(' '), why.size());
    const std::string_view word = why.substr(0, end);
    const bool has_number = word.find_first_of(kDigits) != std::string_view::npos;
    text += has_number ? std::string_view("#") : word;
    if (end < why.size()) text += ' ';
    why.remove_prefix(std::min(end + 1, why.size()));
  }
  return text;
}

}  // namespace rastercheck::properties
