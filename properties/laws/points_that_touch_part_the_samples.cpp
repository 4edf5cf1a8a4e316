// Points that touch part the samples between them: of a grid of points whose squares meet side by
// side, each sample of the region is covered by exactly one.
//
// Why. The squares of points that are `point_size` apart have common sides, and a sample on a side
// belongs to the square on one side of it by the fill rule, whose normals point in opposite
// directions (RULES §9): so squares share no sample and leave none out.
//
// Points: at places that float32 holds exactly, inside the viewport. Contracts must name a fill
// rule with one owner and, if they snap, a grid that has the places.

#include <cstddef>
#include <map>
#include <string>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"
#include "properties/primitive_state.h"
#include "properties/random_state.h"

namespace rastercheck::properties::points_that_touch_part_the_samples_law {
namespace {

/// A grid of points that touch, found in a case whose points are listed row by row.
struct PointGrid {
  WindowPoint first;
  std::size_t columns = 0;
  std::size_t rows = 0;
};

/// The window position of each point, if all are exact.
std::optional<std::vector<WindowPoint>> exact_places(const cases::Case& c) {
  std::vector<WindowPoint> places;
  for (const cases::Triangle& point : c.triangles) {
    const cases::ClipVertex& vertex = c.positions[point[0]];
    if (!(vertex.w > 0)) return std::nullopt;
    const WindowPoint at = window_point(c, vertex);
    if (!is_on_eighths(at) || !is_exactly_at(c, vertex, at)) return std::nullopt;
    places.push_back(at);
  }
  return places;
}

std::optional<PointGrid> grid_of(const cases::Case& c) {
  const std::optional<std::vector<WindowPoint>> places = exact_places(c);
  if (!places || places->empty()) return std::nullopt;
  PointGrid grid;
  grid.first = places->front();
  while (grid.columns < places->size() && (*places)[grid.columns].v == grid.first.v) {
    ++grid.columns;
  }
  if (places->size() % grid.columns != 0) return std::nullopt;
  grid.rows = places->size() / grid.columns;
  const double size = c.point_size;
  for (std::size_t i = 0; i < places->size(); ++i) {
    const std::size_t whole_rows = i / grid.columns;
    const auto row = static_cast<double>(whole_rows);
    const auto column = static_cast<double>(i - whole_rows * grid.columns);
    const WindowPoint& at = (*places)[i];
    if (at.u != grid.first.u + size * column || at.v != grid.first.v + size * row) {
      return std::nullopt;
    }
  }
  return grid;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (clip.primitive != cases::Primitive::points) return not_applicable(kNotPoints);
  cases::ClipCase c = clip;
  c.depth_test = cases::DepthTest::none;
  const std::optional<PointGrid> grid = grid_of(c);
  bool are_all_inside = grid.has_value();
  for (const cases::Triangle& point : c.triangles) {
    are_all_inside = are_all_inside && is_inside(c, point);
  }
  if (!are_all_inside)
    return not_applicable("the points are no grid that touches, inside all planes");
  if (!keeps_eighths(backend.contract(c))) {
    return not_applicable("the contract may move the points, or leaves the owner of sides open");
  }
  const Result<backends::Drawn> drawn = draw_promised(c, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  std::map<cases::SamplePlace, std::uint32_t> owners;  // by pixel and sample
  Tally tally(c);
  for (std::size_t i = 0; i < drawn->fragments.size(); ++i) {
    cases::SamplePlace place = drawn->fragments.place_of(i);
    if (!is_of_case(c, place)) continue;
    const std::uint32_t point = place.triangle;
    place.triangle = 0;
    const auto [owner, is_first] = owners.emplace(place, point);
    tally.see(point);
    if (is_first) continue;
    place.triangle = point;
    tally.report(violation_at(place, records::FragmentClass::extra,
                              "forbidden: points that touch share no sample",
                              "point " + std::to_string(owner->second) + " has it as well"));
  }
  // Strictly inside the whole region.
  const double half = double{c.point_size} / 2;
  const double right = grid->first.u + c.point_size * static_cast<double>(grid->columns) - half;
  const double bottom = grid->first.v + c.point_size * static_cast<double>(grid->rows) - half;
  for_each_sample(c, drawn->contract, [&](const cases::SamplePlace& place, const WindowPoint& at) {
    const bool is_within =
        at.u > grid->first.u - half && at.u < right && at.v > grid->first.v - half && at.v < bottom;
    if (!is_within) return;
    ++tally.counts().required;
    if (owners.contains(place)) return tally.pass(records::AttributeKind::coverage);
    tally.report(violation_at(place, records::FragmentClass::missing,
                              "required: one of the points that touch must cover it",
                              "no point has it"));
  });
  tally.label_drawn();
  return tally.finish();
}

Generated generate(Draw& draw) {
  cases::Case c = random_primitive_state(draw, cases::Primitive::points, true);
  c.coverage.reset();
  c.clip_distance_count = 0;
  set_square_viewport(draw, c);
  set_point_size(draw, c);
  const double size = c.point_size;
  const int columns = draw.between(1, 4);
  const int rows = draw.between(1, 4);
  const WindowPoint middle = visible_middle(c);
  const int u = draw.between(-16, 16);
  const int v = draw.between(-16, 16);
  const WindowPoint first{floor_to_eighths(middle.u - size * columns / 2) + u / 8.0,
                          floor_to_eighths(middle.v - size * rows / 2) + v / 8.0};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float depth = random_depth(draw, c);
      const std::uint32_t index =
          add_vertex(c, at_window(c, {first.u + size * column, first.v + size * row}, depth, 1));
      c.triangles.push_back({index, index, index});
    }
  }
  add_attribute_values(draw, c);
  return {c, "touching points"};
}

const LawRegistration kRegistration(
    {.id = "points-that-touch-part-the-samples",
     .sentence = "points that touch part the samples between them",
     .reason = "Squares side by side have opposite normals at their common side, of which the fill "
               "rule takes one.",
     .exceptions = "points that a contract may move; contracts without a fill rule",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_points,
     .unpromised = kDrawsNoPoints,
     .takes_lines_and_points = true,
     .covers = {cover_decided(30, "drawn")}});

}  // namespace
}  // namespace rastercheck::properties::points_that_touch_part_the_samples_law
