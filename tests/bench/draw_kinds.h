#pragma once

// Kinds of draw that shaded frames are timed with, for both sides alike. Colours that have no
// texture are the attributes as red and green, blue 0, and the kind's alpha.

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
  std::optional<cases::Filter> filter = {};  ///< there is a texture (texture_scenes.h), repeated
  std::optional<float> discard_below = {};   ///< fragments with less alpha are not drawn
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

/// The kind of that name; nullptr where there is none.
constexpr const DrawKind* draw_kind(std::string_view name) {
  for (const DrawKind& kind : kDrawKinds) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

}  // namespace rastercheck::bench
