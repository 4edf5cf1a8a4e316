#include "properties/laws/internal/indexed_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>

#include "properties/laws/internal/tally.h"

namespace rastercheck::properties {
namespace {

/// The greatest number of a case's vertices that are drawn; without a limit, a mesh would take
/// hours.
constexpr std::size_t kMostVertices = 48;

/// The indices as text, "0 1 R 2 3", with R for a restart.
std::string index_text(const std::vector<std::uint32_t>& indices) {
  std::string text;
  for (const std::uint32_t index : indices) {
    text += text.empty() ? "" : " ";
    text += index == cases::kRestart ? "R" : std::to_string(index);
  }
  return text;
}

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

std::string_view word(cases::Topology topology) {
  switch (topology) {
    case cases::Topology::triangles:
      return "list";
    case cases::Topology::strip:
      return "strip";
    case cases::Topology::fan:
      break;
  }
  return "fan";
}

Result<Check> check_assembled(const cases::ClipCase& expanded, const Indexed& indexed,
                              backends::Backend& backend, std::uint64_t index) {
  const Result<cases::Fragments> drawn =
      draw_assembled(expanded, indexed.topology, indexed.indices, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  Check judged = judge_drawn(expanded, backend.contract(expanded), *drawn, {}, index);
  add_to_notes(judged, [&](const records::Violation& violation) {
    const bool is_of_triangles = expanded.primitive == cases::Primitive::triangles;
    std::string text = fmt::format("a {} of vertices {} (R: restart) instead of the case's {}",
                                   word(indexed.topology), index_text(indexed.indices),
                                   is_of_triangles ? "triangles" : "lines");
    if (violation.place.triangle >= expanded.triangles.size()) return text;
    const auto& [a, b, c] = expanded.triangles[violation.place.triangle];
    text += is_of_triangles
                ? fmt::format(", its triangle {} of vertices {}, {}, {}", violation.place.triangle,
                              a, b, c)
                : fmt::format(", its line {} of vertices {}, {}", violation.place.triangle, a, b);
    return text;
  });
  add_label(judged, std::string(word(indexed.topology)));
  if (std::ranges::count(indexed.indices, cases::kRestart) > 0) add_label(judged, "restart");
  return judged;
}

}  // namespace rastercheck::properties
