// Strips and fans are their triangles: a strip, fan or list of indices draws the same as the
// triangles that the API makes of it, in the API's order of vertices. A wrong winding shows if one
// side is culled, a wrong provoking vertex in flat attributes, a wrong triangle anywhere.
//
// The rules, for the vertices v_0, v_1, … since the last restart (Vulkan 1.3, Triangle Strips and
// Triangle Fans; the same in Direct3D 9; OpenGL 4.6, table of provoking vertices, last convention):
//
//   strip  Vulkan, D3D  (v_i, v_{i + 1 + i mod 2}, v_{i + 2 − i mod 2})
//          OpenGL       (v_i, v_{i + 1}, v_{i + 2}), the first two swapped where i is odd
//   fan    Vulkan, D3D  (v_{i + 1}, v_{i + 2}, v_0)
//          OpenGL       (v_0, v_{i + 1}, v_{i + 2})
//
// The vertices' positions choose the topology and the indices: all vertices in turn, with
// occasional repeats and restarts. The case's own triangles have no influence; in generated cases
// they are the triangles that the rules make from the indices.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "properties/choices.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/indexed_vertices.h"
#include "properties/laws/internal/tally.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::strips_and_fans_are_their_triangles_law {
namespace {

using cases::Topology;

Indexed indices_of(const cases::Case& c) {
  PositionChoices choices(c);
  Indexed chosen;
  if (choices.one_in(5)) {
    chosen.topology = Topology::triangles;
  } else if (choices.one_in(2)) {
    chosen.topology = Topology::fan;
  }
  chosen.indices = indices_with_restarts(c, choices);
  return chosen;
}

cases::Triangle triangle_of_rules(cases::Rules rules, Topology topology, std::size_t i,
                                  const std::vector<std::uint32_t>& v) {
  const bool is_odd = i % 2 == 1;
  switch (topology) {
    case Topology::triangles:
      return {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
    case Topology::strip: {
      if (rules == cases::Rules::opengl) {
        return is_odd ? cases::Triangle{v[i + 1], v[i], v[i + 2]}
                      : cases::Triangle{v[i], v[i + 1], v[i + 2]};
      }
      const std::size_t parity = is_odd ? 1 : 0;
      return {v[i], v[i + 1 + parity], v[i + 2 - parity]};
    }
    case Topology::fan:
      break;
  }
  if (rules == cases::Rules::opengl) return {v[0], v[i + 1], v[i + 2]};
  return {v[i + 1], v[i + 2], v[0]};
}

std::vector<cases::Triangle> triangles_of(cases::Rules rules, const Indexed& indexed) {
  std::vector<cases::Triangle> all;
  std::vector<std::uint32_t> run;
  const auto end_run = [&] {
    const std::size_t count = indexed.topology == Topology::triangles
                                  ? run.size() / 3
                                  : std::max<std::size_t>(run.size(), 2) - 2;
    for (std::size_t i = 0; i < count; ++i) {
      all.push_back(triangle_of_rules(rules, indexed.topology, i, run));
    }
    run.clear();
  };
  for (const std::uint32_t index : indexed.indices) {
    if (index == cases::kRestart) {
      end_run();
    } else {
      run.push_back(index);
    }
  }
  end_run();
  return all;
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  cases::ClipCase expanded = c;
  const Indexed indexed = indices_of(expanded);
  expanded.triangles = triangles_of(c.rules, indexed);
  if (expanded.triangles.empty()) return not_applicable("the case's vertices make no triangle");
  Result<Check> judged = check_assembled(expanded, indexed, backend, index);
  if (judged && expanded.cull != cases::Cull::none) add_label(*judged, "culled");
  return judged;
}

bool is_promised(backends::Backend& backend) { return backend.assembler() != nullptr; }

/// Adds a flat attribute that names its vertex, and a smooth attribute.
void add_telling_attributes(Draw& draw, cases::Case& c) {
  c.attributes.push_back({"vertex", cases::Interpolation::flat, cases::Location::sample});
  c.attributes.push_back({"shade", cases::Interpolation::smooth, cases::Location::sample});
  add_attribute_values(draw, c);
  const std::size_t count = c.attributes.size();
  for (std::size_t v = 0; v < c.positions.size(); ++v) {
    c.attribute_values[v * count + count - 2] = static_cast<float>(v);
    c.attribute_values[v * count + count - 1] = draw.uniform(-1, 1);
  }
}

void add_random_vertex(Draw& draw, cases::Case& c) {
  const WindowPoint p = point_about(draw, c);
  const float depth = random_depth(draw, c);
  const float w = draw.one_in(3) ? 1.0F : draw.uniform(0.125F, 4);
  add_vertex(c, at_window(c, p, depth, draw.one_in(24) ? -w : w));
}

Generated generate(Draw& draw) {
  StateRequest request;
  request.least_side = 16;
  request.most_side = 40;
  cases::Case c = random_state(draw, request);
  const int vertices = draw.between(3, 5 + draw.size() / 12);
  for (int i = 0; i < vertices; ++i) add_random_vertex(draw, c);
  // Restarts may have left no triangle.
  while (triangles_of(c.rules, indices_of(c)).empty()) add_random_vertex(draw, c);
  const Indexed indexed = indices_of(c);
  c.triangles = triangles_of(c.rules, indexed);
  add_telling_attributes(draw, c);
  add_clip_distances(draw, c);
  const char* const rules = c.rules == cases::Rules::opengl   ? "opengl"
                            : c.rules == cases::Rules::vulkan ? "vulkan"
                                                              : "d3d";
  return {std::move(c), fmt::format("{} of {}", word(indexed.topology), rules)};
}

const LawRegistration kRegistration(
    {.id = "strips-and-fans-are-their-triangles",
     .sentence = "strips and fans are their triangles",
     .reason = "The APIs say which vertices, in which order, each triangle of a strip or fan has.",
     .exceptions = "backends that assemble none",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not assemble strips and fans",
     .covers = {cover(7, "clipped"), cover(9, "culled"), cover(42, "drawn"), cover(19, "fan"),
                cover(10, "list"), cover(21, "restart"), cover(16, "several samples"),
                cover(20, "strip"), cover(6, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::strips_and_fans_are_their_triangles_law
