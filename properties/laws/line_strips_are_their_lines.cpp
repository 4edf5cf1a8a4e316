// Line strips are their lines: a strip of vertices v_0, v_1, … draws the same as the lines
// (v_i, v_{i + 1}), in this order, and so does a list of (v_{2i}, v_{2i + 1}). An end that two
// lines of a strip share is drawn as if both were drawn by themselves, and a line's flat values are
// those of the end that the API names: the second in OpenGL, else the first (OpenGL 4.6,
// section 10.1.2 and table 13.2; Vulkan 1.3, Line Strips).
//
// The vertices' positions choose the topology and the indices: all vertices in turn, with
// occasional repeats and restarts. The case's own lines have no influence; in generated cases they
// are the lines that the rules make from the indices.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "properties/judged_law.h"
#include "properties/laws/internal/indexed_vertices.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"

namespace rastercheck::properties::line_strips_are_their_lines_law {
namespace {

using cases::Topology;

Indexed indices_of(const cases::Case& c) {
  PositionChoices choices(c);
  Indexed chosen;
  if (choices.one_in(4)) chosen.topology = Topology::triangles;  // a list
  chosen.indices = indices_with_restarts(c, choices);
  return chosen;
}

std::vector<cases::Triangle> lines_of(const Indexed& indexed) {
  std::vector<cases::Triangle> lines;
  std::uint32_t before = cases::kRestart;
  for (const std::uint32_t index : indexed.indices) {
    const bool is_line = before != cases::kRestart && index != cases::kRestart;
    if (is_line) lines.push_back({before, index, index});
    // In a list, the end of a line does not begin another.
    before = is_line && indexed.topology == Topology::triangles ? cases::kRestart : index;
  }
  return lines;
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t index) {
  if (c.primitive != cases::Primitive::lines) return not_applicable(kNotLines);
  cases::ClipCase expanded = c;
  const Indexed indexed = indices_of(expanded);
  expanded.triangles = lines_of(indexed);
  if (expanded.triangles.empty()) return not_applicable("the case's vertices make no line");
  return check_assembled(expanded, indexed, backend, index);
}

bool is_promised(backends::Backend& backend) {
  return draws_lines(backend) && backend.assembler() != nullptr;
}

/// Random lines, joined to strips where their vertices allow it.
Generated generate(Draw& draw) {
  Generated made = random_lines(draw);
  const std::vector<cases::Triangle> lines = lines_of(indices_of(made.source));
  // Restarts may have left no line.
  if (!lines.empty()) made.source.triangles = lines;
  return made;
}

const LawRegistration kRegistration(
    {.id = "line-strips-are-their-lines",
     .sentence = "line strips are their lines",
     .reason = "The APIs say which two vertices, in which order, each line of a strip has.",
     .exceptions = "backends that assemble none",
     .generate = &generate,
     .check = &check,
     .is_promised = &is_promised,
     .unpromised = "the backend does not draw lines, or does not assemble strips",
     .takes_lines_and_points = true,
     .covers = {cover(10, "clipped"), cover(30, "drawn"), cover(10, "list"), cover(10, "restart"),
                cover(15, "several samples"), cover(30, "strip")}});

}  // namespace
}  // namespace rastercheck::properties::line_strips_are_their_lines_law
