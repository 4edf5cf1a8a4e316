#include "properties/laws/internal/indexed_vertices.h"

#include <algorithm>
#include <bit>

#include "cases/picture.h"

namespace rastercheck::properties {
namespace {

/// The greatest number of a case's vertices that are drawn; without a limit, a mesh would take
/// hours.
constexpr std::size_t kMostVertices = 48;

}  // namespace

PositionChoices::PositionChoices(const cases::Case& c) {
  for (const cases::ClipVertex& p : c.positions) {
    for (const float coordinate : {p.x, p.y, p.z, p.w}) {
      take(std::bit_cast<std::uint32_t>(coordinate));
    }
  }
}

bool PositionChoices::one_in(std::uint64_t n) {
  take(1);
  return (state_ >> 32) % n == 0;
}

std::vector<std::uint32_t> indices_with_restarts(const cases::Case& c, PositionChoices& choices) {
  std::vector<std::uint32_t> indices;
  const auto count = static_cast<std::uint32_t>(std::min(c.positions.size(), kMostVertices));
  for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
    if (choices.one_in(9)) indices.push_back(cases::kRestart);
    indices.push_back(vertex);
    if (choices.one_in(9)) indices.push_back(vertex);
  }
  return indices;
}

std::string index_text(const std::vector<std::uint32_t>& indices) {
  std::string text;
  for (const std::uint32_t index : indices) {
    text += text.empty() ? "" : " ";
    text += index == cases::kRestart ? "R" : std::to_string(index);
  }
  return text;
}

}  // namespace rastercheck::properties
