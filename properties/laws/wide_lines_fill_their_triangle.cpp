// Wide lines fill their triangle: three rectangles along the sides of a triangle, at least as wide
// as its inscribed circle, cover all that the triangle covers.
//
// Why. From a point of a triangle, the nearest point of its border is the foot of a perpendicular
// on a side, between the side's ends: the circle around the point through it lies in the triangle
// and touches the side there. That distance is at most the radius of the inscribed circle. So the
// point is in the rectangle along that side if its half width is no less (RULES §10). The circle's
// diameter is twice the triangle's area over half its perimeter, which is at least the longest
// side.
//
// A sample at a vertex is on the end borders of two lines, of which the fill rule gives it to one
// if it gives it to the triangle.
//
// Triangles: with all vertices inside the depth planes, the viewport and positive clip distances,
// so that nothing is cut. Samples: those that the contract does not leave open for the lines.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "properties/generator.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"

namespace rastercheck::properties::wide_lines_fill_their_triangle_law {
namespace {

/// More than the diameter of each triangle's inscribed circle, by two pixels for what snapping
/// moves.
float width_for(const cases::Case& c) {
  double most = 1;
  for (const cases::Triangle& t : c.triangles) {
    std::array<WindowPoint, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = window_point(c, c.positions[t[i]]);
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const WindowPoint& a = at[i];
      const WindowPoint& b = at[(i + 1) % 3];
      longest = std::max(longest, std::max(std::abs(a.u - b.u), std::abs(a.v - b.v)));
    }
    const double twice_area = std::abs((at[1].u - at[0].u) * (at[2].v - at[0].v) -
                                       (at[2].u - at[0].u) * (at[1].v - at[0].v));
    if (longest > 0) most = std::max(most, twice_area / longest);
  }
  return static_cast<float>(std::ceil(most) + 2);
}

/// The sides of the triangles, three lines each, in order.
cases::Case sides_of(const cases::Case& c) {
  cases::Case lines = c;
  lines.primitive = cases::Primitive::lines;
  lines.line_mode = cases::LineMode::rectangular;
  lines.line_width = width_for(c);
  lines.cull = cases::Cull::none;
  lines.triangles.clear();
  for (const cases::Triangle& t : c.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      lines.triangles.push_back({t[i], t[(i + 1) % 3], t[(i + 1) % 3]});
    }
  }
  return lines;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (clip.primitive != cases::Primitive::triangles) {
    return not_applicable("the property is about triangles and their sides");
  }
  cases::ClipCase c = clip;
  c.depth_test = cases::DepthTest::none;
  c.depth_bias = {};
  std::erase_if(c.triangles, [&c](const cases::Triangle& t) { return !is_inside(c, t); });
  if (c.triangles.empty()) return not_applicable("no triangle is inside all planes and sides");
  cases::ClipCase lines = c;
  static_cast<cases::Case&>(lines) = sides_of(c);
  if (lines.line_width > cases::kMostPrimitiveSize) return not_applicable("the lines are too wide");
  const Result<backends::Drawn> of_triangles = draw_promised(c, backend);
  if (!of_triangles) return tl::unexpected(of_triangles.error());
  const Result<backends::Drawn> of_lines = draw_promised(lines, backend);
  if (!of_lines) return tl::unexpected(of_lines.error());

  std::set<cases::SamplePlace> covered;  // by a triangle's lines
  for (std::size_t i = 0; i < of_lines->fragments.size(); ++i) {
    cases::SamplePlace place = of_lines->fragments.place_of(i);
    place.triangle /= 3;
    covered.insert(place);
  }
  Tally tally(c);
  Verdicts verdicts(lines, of_lines->contract);
  for (std::size_t i = 0; i < of_triangles->fragments.size(); ++i) {
    const cases::SamplePlace place = of_triangles->fragments.place_of(i);
    if (!is_of_case(c, place)) continue;
    if (covered.contains(place)) {
      tally.pass_required(place.triangle);
      continue;
    }
    const auto is_open = [&](std::uint32_t side) {
      return verdicts.judge(3 * place.triangle + side, place).verdict ==
             records::Verdict::permitted;
    };
    if (is_open(0) || is_open(1) || is_open(2)) continue;
    tally.report(violation_at(
        place, records::FragmentClass::missing, "required: the triangle has it",
        "the triangle's sides as lines " + value_text(lines.line_width) + " pixels wide do not"));
  }
  tally.label_drawn();
  return tally.finish();
}

Generated generate(Draw& draw) {
  const std::string_view stratum =
      draw.pick(std::array<std::string_view, 4>{"ordinary", "ordinary", "on-grid", "slivers"});
  Generated made{find_generator(stratum)->make(draw), std::string(stratum)};
  made.source.depth_clamp = false;
  return made;
}

const LawRegistration kRegistration(
    {.id = "wide-lines-fill-their-triangle",
     .sentence = "wide lines along its sides fill a triangle",
     .reason = "From a point of a triangle, the nearest point of the border is the foot of a "
               "perpendicular on a side.",
     .exceptions = "triangles that are clipped; samples that the contract leaves open",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_lines,
     .unpromised = kDrawsNoLines,
     .needs_samples = true,
     .covers = {cover(20, "drawn")}});

}  // namespace
}  // namespace rastercheck::properties::wide_lines_fill_their_triangle_law
