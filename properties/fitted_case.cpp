#include "properties/fitted_case.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "cases/names.h"
#include "properties/exact_sum.h"
#include "properties/fitting.h"

namespace rastercheck::properties {
namespace {

using cases::Capabilities;
using cases::Case;
using cases::Feature;
using cases::Rules;

/// Computes a depth for other rules from clip z and w; nothing if the result is not a float32.
using Depth = std::optional<float> (*)(float z, float w);

std::optional<float> to_float_sum(double a, double b) {
  const std::optional<double> sum = exact_sum(a, b);
  if (!sum || !is_float(*sum)) return std::nullopt;
  return static_cast<float>(*sum);
}

/// OpenGL's −w <= z <= w becomes 0 <= z <= w.
std::optional<float> from_opengl(float z, float w) {
  const std::optional<double> twice = exact_sum(double{z}, double{w});
  return twice ? to_float_sum(*twice / 2, 0) : std::nullopt;
}

std::optional<float> to_opengl(float z, float w) { return to_float_sum(2 * double{z}, -double{w}); }

/// Changes all clip positions, directly or through the projection's rows. False if a new depth is
/// not a float32.
bool change_positions(Case& c, Depth depth, bool turns_y) {
  const auto change = [&](float& y, float& z, float w) {
    if (turns_y) y = -y;
    if (depth == nullptr) return true;
    const std::optional<float> changed = depth(z, w);
    if (changed) z = *changed;
    return changed.has_value();
  };
  if (!c.camera) {
    return std::all_of(c.positions.begin(), c.positions.end(),
                       [&](cases::ClipVertex& p) { return change(p.y, p.z, p.w); });
  }
  const std::span<float, 16> rows(c.camera->projection);
  for (std::size_t column = 0; column < 4; ++column) {
    if (!change(rows[4 + column], rows[8 + column], rows[12 + column])) return false;
  }
  return true;
}

/// Call after window y has changed direction: the fill rule and the front face refer to the
/// displayed picture, so both are swapped.
void turn_display(Case& c) {
  c.fill_rule = c.fill_rule == cases::TieRule::top_left ? cases::TieRule::bottom_left
                                                        : cases::TieRule::top_left;
  c.front_face =
      c.front_face == cases::FrontFace::ccw ? cases::FrontFace::cw : cases::FrontFace::ccw;
}

/// Translates the case to other rules; nothing if that cannot be done exactly.
std::optional<Case> by_rules(Case c, Rules rules) {
  const bool was_opengl = c.rules == Rules::opengl;
  const bool is_opengl = rules == Rules::opengl;
  const bool turns_y = (c.rules == Rules::d3d) != (rules == Rules::d3d);
  Depth depth = nullptr;
  if (was_opengl != is_opengl) depth = is_opengl ? &to_opengl : &from_opengl;
  if (!change_positions(c, depth, turns_y)) return std::nullopt;
  if (was_opengl != is_opengl) {
    turn_display(c);
    // The provoking vertex must stay the same: it is the last one in OpenGL and the first under the
    // other rules.
    if (c.primitive == cases::Primitive::lines && needs(c, cases::Feature::flat)) {
      return std::nullopt;  // turned round, it would be another line
    }
    for (cases::Triangle& t : c.triangles) {
      if (c.primitive != cases::Primitive::triangles) break;
      std::rotate(t.begin(), t.begin() + (is_opengl ? 1 : 2), t.end());
    }
  }
  c.rules = rules;
  const bool is_ordered = c.viewport.min_depth <= c.viewport.max_depth;
  if (rules == Rules::d3d && !is_ordered) return std::nullopt;
  return c;
}

bool is_about(const Case& c, std::string_view what) {
  if (!c.essential) return what != "rules" && what != "samples";
  return std::find(c.essential->begin(), c.essential->end(), what) != c.essential->end();
}

template <typename T>
bool is_one_of(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Translates the case to the first of the backend's rules that allow an exact translation.
std::optional<Case> by_some_rules(const Capabilities& has, const Case& c) {
  if (is_one_of(has.rules, c.rules)) return c;
  if (is_about(c, "rules")) return std::nullopt;
  for (const Rules rules : has.rules) {
    if (std::optional<Case> changed = by_rules(c, rules)) return changed;
  }
  return std::nullopt;
}

}  // namespace

cases::Case fitted_case(const Capabilities& capabilities, const Case& c) {
  if (capabilities.is_everything() || lacked_by(capabilities, c).empty()) return c;
  std::optional<Case> changed = by_some_rules(capabilities, c);
  if (!changed) return c;
  const auto& counts = capabilities.sample_counts;
  if (!is_one_of(counts, changed->framebuffer.samples) && !is_about(c, "samples")) {
    // The largest supported count below the case's, or else the smallest supported count.
    const auto more = std::upper_bound(counts.begin(), counts.end(), changed->framebuffer.samples);
    changed->framebuffer.samples = more == counts.begin() ? *more : *(more - 1);
  }
  if (!is_about(c, "size")) {
    cases::FramebufferSize& size = changed->framebuffer;
    size = fitted_size(capabilities, size);
  }
  for (const Feature feature : capabilities.lacks) {
    if (!needs(*changed, feature)) continue;
    if (is_about(c, cases::name_of(feature)) || !leave_out(*changed, feature, capabilities)) {
      return c;
    }
  }
  return lacked_by(capabilities, *changed).empty() ? *std::move(changed) : c;
}

}  // namespace rastercheck::properties
