#pragma once

// The names of enumerators in files, in tables and on the command line: one list per enumeration,
// for reader, writer and messages, in the order of its enumerators. The list is names_of() for the
// type, in the enumeration's own namespace. This header has the lists of the case file.

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::cases {

constexpr auto names_of(Rules /*type*/) {
  return std::to_array<std::string_view>({"opengl", "vulkan", "d3d"});
}
constexpr auto names_of(Cull /*type*/) {
  return std::to_array<std::string_view>({"none", "back", "front"});
}
constexpr auto names_of(FrontFace /*type*/) {
  return std::to_array<std::string_view>({"ccw", "cw"});
}
constexpr auto names_of(Interpolation /*type*/) {
  return std::to_array<std::string_view>({"smooth", "noperspective", "flat"});
}
constexpr auto names_of(Location /*type*/) {
  return std::to_array<std::string_view>({"sample", "center", "centroid"});
}
constexpr auto names_of(Primitive /*type*/) {
  return std::to_array<std::string_view>({"triangles", "lines", "points"});
}
constexpr auto names_of(LineMode /*type*/) {
  return std::to_array<std::string_view>({"rectangular", "parallelogram", "bresenham"});
}
constexpr auto names_of(DepthTest /*type*/) {
  return std::to_array<std::string_view>({"none", "less"});
}
constexpr auto names_of(DepthFormat /*type*/) {
  return std::to_array<std::string_view>({"float32", "float64", "unorm16", "unorm24", "unorm32"});
}
constexpr auto names_of(BiasSlope /*type*/) {
  return std::to_array<std::string_view>({"greatest", "root", "between"});
}
constexpr auto names_of(BiasUnit /*type*/) {
  return std::to_array<std::string_view>(
      {"power", "double_power", "either_power", "least_value", "open"});
}
constexpr auto names_of(BiasExponent /*type*/) {
  return std::to_array<std::string_view>({"vertices", "open"});
}
constexpr auto names_of(DepthStore /*type*/) {
  return std::to_array<std::string_view>({"nearest", "nearly_nearest", "either"});
}
constexpr auto names_of(Rounding /*type*/) {
  return std::to_array<std::string_view>(
      {"nearest_even", "half_up", "unspecified", "half_down", "floor", "ceil", "toward_zero"});
}
constexpr auto names_of(Basis /*type*/) {
  return std::to_array<std::string_view>({"ideal", "snapped", "unspecified"});
}
constexpr auto names_of(ConservativeKind /*type*/) {
  return std::to_array<std::string_view>({"outer", "inner"});
}
constexpr auto names_of(ConservativeCorners /*type*/) {
  return std::to_array<std::string_view>({"square", "edges"});
}
constexpr auto names_of(Storage /*type*/) {
  return std::to_array<std::string_view>({"float32", "float16", "unorm8", "unorm16", "srgb8"});
}
constexpr auto names_of(StoreRounding /*type*/) {
  return std::to_array<std::string_view>({"nearest", "either"});
}
constexpr auto names_of(FirstRow /*type*/) {
  return std::to_array<std::string_view>({"top", "bottom"});
}
constexpr auto names_of(ResolveOf /*type*/) {
  return std::to_array<std::string_view>({"linear", "stored"});
}
constexpr auto names_of(Alpha /*type*/) {
  return std::to_array<std::string_view>({"straight", "premultiplied"});
}
constexpr auto names_of(Blend /*type*/) {
  return std::to_array<std::string_view>({"off", "over", "additive"});
}
constexpr auto names_of(TieRule /*type*/) {
  return std::to_array<std::string_view>({"top_left", "bottom_left", "top_right", "bottom_right",
                                          "top_then_left", "top_then_right", "bottom_then_left",
                                          "bottom_then_right", "all", "none", "unspecified"});
}
/// The rules that a case may ask for, and the roundings: the first ones of their enumerations.
inline constexpr std::size_t kTieRulesOfCases = 2;
inline constexpr std::size_t kRoundingsOfCases = 3;
/// The formats of depth that a case may ask for.
inline constexpr std::array kDepthFormatsOfCases{DepthFormat::float32, DepthFormat::unorm16,
                                                 DepthFormat::unorm24};

/// The enumerator's name; "?" if it has none.
template <typename Enum>
constexpr std::string_view name_of(Enum value) {
  const auto names = names_of(value);
  const auto index = static_cast<std::size_t>(value);
  return index < names.size() ? names[index] : "?";
}

template <typename Enum>
constexpr std::optional<Enum> from_name(std::string_view name) {
  const auto names = names_of(Enum{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

}  // namespace rastercheck::cases
