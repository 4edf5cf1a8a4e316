#include "reports/internal/contract_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "cases/names.h"

namespace rastercheck::reports {
namespace {

using cases::Contract;
using cases::Interpolation;

std::string_view rounding_text(cases::Rounding rounding) {
  switch (rounding) {
    case cases::Rounding::nearest_even:
      return "the nearest point, of two the even one";
    case cases::Rounding::half_up:
      return "the nearest point, of two the greater one";
    case cases::Rounding::half_down:
      return "the nearest point, of two the lesser one";
    case cases::Rounding::floor:
      return "the next point towards lesser coordinates";
    case cases::Rounding::ceil:
      return "the next point towards greater coordinates";
    case cases::Rounding::toward_zero:
      return "the next point towards 0";
    case cases::Rounding::unspecified:
      break;
  }
  return "either neighbour";
}

std::string vertices_text(const Contract& contract) {
  if (!contract.coverage) return "exactly where the case puts them";
  const cases::Snapping& grid = *contract.coverage;
  std::string text = fmt::format("on a grid of 1/{} pixel", grid.steps());
  if (!contract.is_on_grid) text = "between the points of " + text.substr(3);
  text += fmt::format(", {}", rounding_text(grid.rounding));
  if (grid.rounding_of_y) text += fmt::format(" (along y {})", rounding_text(*grid.rounding_of_y));
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
    case cases::TieRule::top_right:
      return "top and right edges own their samples";
    case cases::TieRule::bottom_right:
      return "bottom and right edges own their samples";
    case cases::TieRule::top_then_left:
      return "top edges, and left ones that are vertical, own their samples";
    case cases::TieRule::top_then_right:
      return "top edges, and right ones that are vertical, own their samples";
    case cases::TieRule::bottom_then_left:
      return "bottom edges, and left ones that are vertical, own their samples";
    case cases::TieRule::bottom_then_right:
      return "bottom edges, and right ones that are vertical, own their samples";
    case cases::TieRule::all:
      return "every edge owns its samples";
    case cases::TieRule::none:
      return "no edge owns its samples";
    case cases::TieRule::unspecified:
      break;
  }
  return "open: either triangle may own the samples on an edge";
}

/// Facts that only unusual contracts have.
void add_rare_facts(const Contract& contract,
                    std::vector<std::pair<std::string, std::string>>& facts) {
  if (contract.sample_position) {
    const cases::PixelFraction& at = *contract.sample_position;
    facts.emplace_back("sample",
                       fmt::format("at {}/{}, {}/{} of the pixel", at.x, at.parts, at.y, at.parts));
  }
  if (contract.culls_instead_of_clipping) {
    facts.emplace_back("clipping", "triangles beyond the guard band or a depth plane are left out");
  } else if (contract.guard_beyond_viewport) {
    facts.emplace_back("clipping", fmt::format("{:g} pixels beyond the viewport",
                                               *contract.guard_beyond_viewport));
  }
  if (contract.culls != cases::Winding::none) {
    const bool is_clockwise = contract.culls == cases::Winding::clockwise;
    facts.emplace_back("culls", is_clockwise ? "clockwise triangles, whatever is asked"
                                             : "counter-clockwise triangles, whatever is asked");
  }
  if (contract.least_area > 0) {
    facts.emplace_back("left out",
                       fmt::format("triangles below {:g} square pixels", contract.least_area));
  }
  if (contract.depth_error != cases::DepthError::either_side) {
    const bool is_nearer = contract.depth_error == cases::DepthError::never_nearer;
    facts.emplace_back("depth is", is_nearer ? "never nearer than the exact one"
                                             : "never farther than the exact one");
  }
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
  if (bounds.of_all.absolute > 0) {
    text += fmt::format(", plus {:.3g} in units of the value", bounds.of_all.absolute);
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
  add_rare_facts(contract, facts);
  return facts;
}

}  // namespace rastercheck::reports
