#pragma once

// The kinds of draws for which shaded frames are timed, the same for the rasterizer and for
// drivers. Without a texture, red and green are the attributes, blue is 0, and alpha is the kind's.

#include <optional>
#include <string_view>

#include "cases/picture.h"

namespace rastercheck::bench {

struct DrawKind {
  std::string_view name;
  cases::DepthFunction depth_function = cases::DepthFunction::less;
  bool writes_depth = true;
  float clear_depth = 1;
  cases::Blend blend = cases::Blend::off;
  float alpha = 1;
  /// If set, draws a repeated texture (texture_scenes.h).
  std::optional<cases::Filter> filter = {};
  std::optional<float> discard_below = {};  ///< if set, fragments with less alpha are not drawn
};

inline constexpr DrawKind kDrawKinds[] = {
    {.name = "textured-nearest", .filter = cases::Filter::nearest},
    {.name = "textured-bilinear", .filter = cases::Filter::bilinear},
    {.name = "textured-trilinear", .filter = cases::Filter::trilinear},
    {.name = "discarded", .filter = cases::Filter::bilinear, .discard_below = 0.5F},
    {.name = "blended-over",
     .depth_function = cases::DepthFunction::always,
     .writes_depth = false,
     .blend = cases::Blend::over,
     .alpha = 0.5F},
    {.name = "blended-additive",
     .depth_function = cases::DepthFunction::always,
     .writes_depth = false,
     .blend = cases::Blend::additive,
     .alpha = 0.5F},
    {.name = "depth-less", .depth_function = cases::DepthFunction::less},
    {.name = "depth-less_or_equal", .depth_function = cases::DepthFunction::less_or_equal},
    {.name = "depth-greater", .depth_function = cases::DepthFunction::greater, .clear_depth = 0},
};

/// The kind with that name; nullptr if it does not exist.
constexpr const DrawKind* draw_kind(std::string_view name) {
  for (const DrawKind& kind : kDrawKinds) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

}  // namespace rastercheck::bench
