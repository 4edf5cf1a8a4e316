#pragma once

// The words that enumerators have in files and on the command line: one table for reader, writer
// and messages.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "cases/case.h"

namespace rastercheck::cases {

template <typename Enum>
using NameTable = std::span<const std::pair<std::string_view, Enum>>;

/// The words of an enumeration, in the order they are shown.
template <typename Enum>
NameTable<Enum> names();
template <>
NameTable<Rules> names();
template <>
NameTable<Cull> names();
template <>
NameTable<FrontFace> names();
template <>
NameTable<Interpolation> names();
template <>
NameTable<Location> names();
template <>
NameTable<DepthTest> names();
template <>
NameTable<Rounding> names();
template <>
NameTable<Basis> names();
template <>
NameTable<TieRule> names();

template <typename Enum>
std::string_view name_of(Enum value) {
  for (const auto& [name, candidate] : names<Enum>()) {
    if (candidate == value) return name;
  }
  return "?";
}

template <typename Enum>
std::optional<Enum> from_name(std::string_view word) {
  for (const auto& [name, candidate] : names<Enum>()) {
    if (name == word) return candidate;
  }
  return std::nullopt;
}

/// "opengl, vulkan or d3d", for messages.
template <typename Enum>
std::string name_list() {
  std::string list;
  const auto table = names<Enum>();
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (i > 0) list += i + 1 == table.size() ? " or " : ", ";
    list += table[i].first;
  }
  return list;
}

}  // namespace rastercheck::cases
