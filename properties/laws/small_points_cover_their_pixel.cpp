// A point of size 1 at a pixel's centre covers that pixel and nothing else: all of its samples, and
// no sample of another pixel.
//
// Why. The square around the centre is the pixel itself (RULES §9). Samples lie on a border of
// their pixel, as two of the pattern of 16 do, or at least a sixteenth of a pixel from every
// border. The former are left out, and so are contracts that may move a vertex by a sixteenth.
//
// Points: those of the case that are inside, after a move to the centre of the pixel that they are
// in, which float32 must hold exactly.

#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/primitive_cases.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"

namespace rastercheck::properties::small_points_cover_their_pixel_law {
namespace {

/// Moves a vertex to the middle of its pixel; false if that is not possible exactly.
bool move_to_middle(cases::Case& c, std::uint32_t vertex) {
  cases::ClipVertex& p = c.positions[vertex];
  if (!(p.w > 0)) return false;
  const WindowPoint at = window_point(c, p);
  const WindowPoint middle{std::floor(at.u) + 0.5, std::floor(at.v) + 0.5};
  const cases::ClipVertex moved = at_window(c, middle, 0, p.w);
  p.x = moved.x;
  p.y = moved.y;
  return is_exactly_at(c, p, middle) && middle.u > 0 && middle.u < c.framebuffer.width &&
         middle.v > 0 && middle.v < c.framebuffer.height;
}

bool is_scissored(const cases::Case& c, int x, int y) {
  if (!c.scissor) return false;
  return x < c.scissor->x || y < c.scissor->y || x >= c.scissor->x + c.scissor->width ||
         y >= c.scissor->y + c.scissor->height;
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  if (clip.primitive != cases::Primitive::points) return not_applicable(kNotPoints);
  cases::ClipCase c = clip;
  c.depth_test = cases::DepthTest::none;
  c.point_size = 1;
  std::erase_if(c.triangles, [&c](const cases::Triangle& point) {
    return !move_to_middle(c, point[0]) || !is_inside(c, point);
  });
  if (c.triangles.empty())
    return not_applicable("no point is at the centre of a pixel, and inside");
  const cases::Contract contract = backend.contract(c);
  if (contract.coverage && placement_reach(*contract.coverage) >= 1 / 16.0) {
    return not_applicable("the contract may move points by a sixteenth of a pixel");
  }
  const Result<backends::Drawn> drawn = draw_promised(c, backend);
  if (!drawn) return tl::unexpected(drawn.error());

  Tally tally(c);
  const std::vector<WindowPoint> pattern = sample_points(c, contract);
  const double reach = contract.coverage ? placement_reach(*contract.coverage) : 0;
  const auto is_on_border = [&](std::size_t sample) {
    const auto is_beside = [reach](double at) { return at <= reach || at >= 1 - reach; };
    return is_beside(pattern[sample].u) || is_beside(pattern[sample].v);
  };
  int inside = 0;  // samples of a pixel that are on no border
  for (std::size_t s = 0; s < pattern.size(); ++s) inside += is_on_border(s) ? 0 : 1;
  const auto pixel_of = [&c](std::uint32_t point) {
    const WindowPoint at = window_point(c, c.positions[c.triangles[point][0]]);
    return std::array{static_cast<int>(std::floor(at.u)), static_cast<int>(std::floor(at.v))};
  };
  std::map<std::uint32_t, int> counts;
  for (std::size_t i = 0; i < drawn->fragments.size(); ++i) {
    const cases::SamplePlace place = drawn->fragments.place_of(i);
    if (!is_of_case(c, place) || is_on_border(place.sample)) continue;
    const auto [x, y] = pixel_of(place.triangle);
    if (std::cmp_equal(place.x, x) && std::cmp_equal(place.y, y)) {
      tally.pass_required(place.triangle);
      ++counts[place.triangle];
      continue;
    }
    tally.report(
        violation_at(place, records::FragmentClass::extra, "forbidden: the point is another pixel",
                     "its pixel is (" + std::to_string(x) + ", " + std::to_string(y) + ")"));
  }
  for (std::uint32_t point = 0; point < c.triangles.size(); ++point) {
    const auto [x, y] = pixel_of(point);
    if (is_scissored(c, x, y) || counts[point] >= inside) continue;
    tally.report(
        violation_at({point, static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x), 0},
                     records::FragmentClass::missing, "required: all samples of the point's pixel",
                     std::to_string(counts[point]) + " of " + std::to_string(inside) + " drawn"));
  }
  tally.label_drawn();
  return tally.finish();
}

Generated generate(Draw& draw) {
  Generated made = random_points(draw);
  set_square_viewport(draw, made.source);
  for (cases::ClipVertex& p : made.source.positions) {
    if (draw.one_in(2)) p.w = 1;
  }
  return made;
}

const LawRegistration kRegistration(
    {.id = "a-point-at-a-centre-covers-its-pixel",
     .sentence = "a point of size 1 at a pixel's centre covers that pixel",
     .reason = "The square around the centre is the pixel, which has its samples inside or on its "
               "border.",
     .exceptions =
         "samples on the border of their pixel; points that are clipped, not exactly at a "
         "centre, or moved by a sixteenth of a pixel",
     .generate = &generate,
     .check = &check,
     .is_promised = &draws_points,
     .unpromised = kDrawsNoPoints,
     .takes_lines_and_points = true,
     .covers = {cover(30, "drawn"), cover(15, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::small_points_cover_their_pixel_law
