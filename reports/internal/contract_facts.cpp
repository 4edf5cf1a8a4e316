#include "reports/internal/contract_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "cases/names.h"

namespace rastercheck::reports {
namespace {

using cases::Contract;
using cases::Interpolation;

std::string vertices_text(const Contract& contract) {
  if (!contract.coverage) return "exactly where the case puts them";
  const cases::Snapping& grid = *contract.coverage;
  std::string text = fmt::format("on a grid of 1/{} pixel", std::uint32_t{1} << grid.subpixel_bits);
  if (!contract.is_on_grid) text = "between the points of " + text.substr(3);
  switch (grid.rounding) {
    case cases::Rounding::nearest_even:
      text += ", the nearest point, of two the even one";
      break;
    case cases::Rounding::half_up:
      text += ", the nearest point, of two the greater one";
      break;
    case cases::Rounding::unspecified:
      text += ", either neighbour";
      break;
  }
  if (grid.position_error > 0) {
    text += fmt::format(", after an error of up to {:.3g} grid units", grid.position_error);
  }
  return text;
}

std::string_view ties_text(cases::TieRule rule) {
  switch (rule) {
    case cases::TieRule::top_left:
      return "top and left edges own their samples";
    case cases::TieRule::bottom_left:
      return "bottom and left edges own their samples";
    case cases::TieRule::unspecified:
      break;
  }
  return "open: either triangle may own the samples on an edge";
}

/// The bounds of one kind of value: the contract's own, and one for each promised triangle.
struct KindOfBound {
  cases::ValueBound of_all;
  /// One for each triangle for which the contract makes a promise of its own; empty if it makes
  /// none.
  std::vector<cases::ValueBound> of_triangles;
};

KindOfBound bounds_of(const Contract& contract, cases::ValueBound cases::ValueBounds::*kind) {
  KindOfBound bounds{contract.bounds.*kind, {}};
  for (const cases::TrianglePromise& promise : contract.triangles) {
    if (promise.is_made) bounds.of_triangles.push_back(promise.bounds.*kind);
  }
  return bounds;
}

/// At this bound or above, all digits may be lost, so nothing is promised (ValueBound).
constexpr float kNoBound = 0x1p24F;

std::string bound_text(const KindOfBound& bounds) {
  float least = bounds.of_all.constant;
  float greatest = bounds.of_triangles.empty() ? least : 0;
  for (const cases::ValueBound& bound : bounds.of_triangles) {
    least = std::min(least, bound.constant);
    greatest = std::max(greatest, bound.constant);
  }
  if (least >= kNoBound) return "nothing is promised";
  std::string text = fmt::format("within {:.3g} scale ULP", least);
  if (greatest >= kNoBound) {
    text += " or more, by triangle; nothing is promised about some";
  } else if (greatest > least) {
    text = fmt::format("within {:.3g} to {:.3g} scale ULP, by triangle", least, greatest);
  }
  if (bounds.of_all.per_horizon > 0) text += ", more towards the horizon";
  if (bounds.of_all.per_condition > 0) text += ", more where weights cancel";
  if (bounds.of_all.range_share > 0) {
    text += fmt::format(", plus {:.3g} of the triangle's range", bounds.of_all.range_share);
  }
  return text;
}

bool has_values(const cases::Case& source, Interpolation interpolation) {
  return std::any_of(
      source.attributes.begin(), source.attributes.end(),
      [&](const cases::Attribute& one) { return one.interpolation == interpolation; });
}

}  // namespace

std::vector<std::pair<std::string, std::string>> contract_facts(const Contract& contract,
                                                                const cases::Case& source) {
  std::vector<std::pair<std::string, std::string>> facts{
      {"vertices", vertices_text(contract)},
      {"samples on an edge", std::string(ties_text(contract.tie_rule))}};
  if (has_values(source, Interpolation::smooth)) {
    facts.emplace_back("smooth values",
                       bound_text(bounds_of(contract, &cases::ValueBounds::smooth)));
  }
  if (has_values(source, Interpolation::noperspective)) {
    facts.emplace_back("noperspective values",
                       bound_text(bounds_of(contract, &cases::ValueBounds::noperspective)));
  }
  facts.emplace_back("depth", bound_text(bounds_of(contract, &cases::ValueBounds::depth)));
  return facts;
}

}  // namespace rastercheck::reports
