// A triangle without area covers its pixels, where the contract says so
// (cases::Conservative::covers_degenerates): each pixel that has one of the triangle's vertices
// strictly inside it is drawn, with all its samples; else they are `missing`.
//
// Why. The vertex is a point of the triangle in the pixel's open square, which so meets the
// triangle. Where a vertex lies is decided without rounding, from sums of exact products: u > i iff
// x W + w (2 x0 + W − 2 i) > 0, for w > 0.
//
// Left out are triangles with a vertex that is not in front of the eye or lies on or beyond a clip
// plane or the viewport's sides, with equal indices, and cases with culling, as a triangle without
// area has neither a front nor a back. If the contract snaps vertices, positions are open, and
// nothing is checked. Each triangle is drawn as if alone: the case's depth test is removed.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>

#include "properties/exact_sum.h"
#include "properties/judged_law.h"
#include "properties/laws/internal/drawn_fragments.h"
#include "properties/laws/internal/tally.h"
#include "properties/laws/internal/verdicts.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::degenerate_covers_its_pixels_law {
namespace {

using cases::ClipVertex;
using records::FragmentClass;

/// The sign of a window coordinate minus a whole number, for w > 0.
int side_of(double coordinate, double w, double origin, double size, double whole) {
  const std::array terms{coordinate * size, w * (2 * origin), w * size, -2 * whole * w};
  return sign_of_sum(terms);
}

/// The pixel that has a window coordinate strictly inside it; empty for a border.
std::optional<int> pixel_along(double coordinate, double w, double origin, double size) {
  const double about = std::floor((coordinate / w + 1) * size / 2 + origin);
  // A pixel beyond the framebuffer is of no use, and the rounded position may be one pixel off.
  const bool is_near = about >= -1 && about <= cases::kMaxSize;  // false for NaN
  if (!is_near) return std::nullopt;
  for (const double pixel : {about - 1, about, about + 1}) {
    if (side_of(coordinate, w, origin, size, pixel) > 0 &&
        side_of(coordinate, w, origin, size, pixel + 1) < 0) {
      return static_cast<int>(pixel);
    }
  }
  return std::nullopt;
}

/// True if a vertex lies strictly inside all clip planes and the viewport. Floats are compared, and
/// sums of two floats have the right sign in double.
bool is_inside(const cases::Case& c, std::uint32_t vertex) {
  const ClipVertex& p = c.positions[vertex];
  const double w{p.w};
  const double near = c.rules == cases::Rules::opengl ? w + double{p.z} : double{p.z};
  const bool is_in_depth = c.depth_clamp || (near > 0 && w - double{p.z} > 0);
  const auto distances = c.clip_distances_of(vertex);
  return w > 0 && is_in_depth && w - std::abs(double{p.x}) > 0 && w - std::abs(double{p.y}) > 0 &&
         std::all_of(distances.begin(), distances.end(), [](float d) { return d > 0; });
}

class PixelSearch {
 public:
  PixelSearch(const cases::Case& c, const cases::Fragments& drawn) : case_(&c), tally_(c) {
    for (std::size_t i = 0; i < drawn.size(); ++i) drawn_.insert(drawn.place_of(i));
  }

  Check run(Verdicts& verdicts) {
    for (std::uint32_t t = 0; t < case_->triangles.size(); ++t) {
      const cases::Triangle& v = case_->triangles[t];
      const bool is_promised = v[0] != v[1] && v[1] != v[2] && v[2] != v[0] &&
                               std::all_of(v.begin(), v.end(), [this](std::uint32_t vertex) {
                                 return is_inside(*case_, vertex);
                               });
      if (!is_promised || verdicts.truth(t).orientation() != 0) continue;
      for (const std::uint32_t vertex : v) check_vertex(t, vertex);
    }
    if (!has_found_) return not_applicable("no triangle has no area and a pixel inside");
    return tally_.finish();
  }

 private:
  void check_vertex(std::uint32_t triangle, std::uint32_t vertex) {
    const ClipVertex& p = case_->positions[vertex];
    const cases::Viewport& viewport = case_->viewport;
    const double turn = case_->rules == cases::Rules::d3d ? -1 : 1;
    const auto x =
        pixel_along(double{p.x}, double{p.w}, double{viewport.x}, double{viewport.width});
    const auto y =
        pixel_along(turn * double{p.y}, double{p.w}, double{viewport.y}, double{viewport.height});
    if (!x || !y || !is_target(*x, *y)) return;
    has_found_ = true;
    for (int s = 0; s < case_->framebuffer.samples; ++s) {
      const cases::SamplePlace place{triangle, static_cast<std::uint32_t>(*y),
                                     static_cast<std::uint32_t>(*x), static_cast<std::uint32_t>(s)};
      if (!seen_.insert(place).second) continue;
      if (drawn_.contains(place)) {
        tally_.pass_required(triangle);
        continue;
      }
      ++tally_.counts().required;
      tally_.report(violation_at(place, FragmentClass::missing,
                                 "required: a vertex of the triangle lies in the pixel",
                                 "a triangle without area covers the pixels that it touches"));
    }
  }

  bool is_target(int x, int y) const {
    const auto holds = [](int at, int first, int size) { return at >= first && at - first < size; };
    const cases::FramebufferSize& size = case_->framebuffer;
    if (!holds(x, 0, size.width) || !holds(y, 0, size.height)) return false;
    if (!case_->scissor) return true;
    const cases::Scissor& s = *case_->scissor;
    return holds(x, s.x, s.width) && holds(y, s.y, s.height);
  }

  const cases::Case* case_;
  std::set<cases::SamplePlace> drawn_;
  std::set<cases::SamplePlace> seen_;
  bool has_found_ = false;
  Tally tally_;
};

bool covers_degenerates(backends::Backend& backend) {
  const cases::Contract contract = backend.contract({});
  return contract.conservative && contract.conservative->covers_degenerates;
}

Result<Check> check(const cases::ClipCase& c, backends::Backend& backend, std::uint64_t /*index*/) {
  if (!covers_degenerates(backend)) return not_applicable();
  if (c.cull != cases::Cull::none) return not_applicable("the case culls faces");
  cases::ClipCase clip = c;
  clip.depth_test = cases::DepthTest::none;
  const Result<backends::Drawn> drawn = draw_promised(clip, backend);
  if (!drawn) return tl::unexpected(drawn.error());
  if (drawn->contract.coverage) return not_applicable("the contract snaps vertices");
  Verdicts verdicts(clip, drawn->contract);
  return PixelSearch(clip, drawn->fragments).run(verdicts);
}

// --- the law's own cases: points and segments ---------------------------------------------------

Generated generate(Draw& draw) {
  StateRequest request;
  request.is_on_grid = true;
  request.most_side = 32;
  Generated made;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  c.depth_test = cases::DepthTest::none;
  c.cull = cases::Cull::none;
  const bool are_points = draw.one_in(3);
  const int count = draw.between(1, 4);
  for (int i = 0; i < count; ++i) {
    // Sums of a few sixteenths, and weights that are powers of two, keep all positions exact.
    const WindowPoint from = visible_sample(draw, c);
    const int du = are_points ? 0 : draw.between(-6, 6);
    const int dv = are_points ? 0 : draw.between(-6, 6);
    std::array<cases::ClipVertex, 3> vertices;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto step = static_cast<double>(k) / 2;
      const float w = draw.pick(std::array{0.5F, 1.0F, 2.0F});
      vertices[k] = at_window(c, {from.u + step * du, from.v + step * dv}, 0.5F, w);
    }
    add_triangle(c, vertices[0], vertices[1], vertices[2]);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  made.stratum = are_points ? "points" : count == 1 ? "a segment" : "segments";
  return made;
}

const LawRegistration kRegistration(
    {.id = "triangles-without-area-cover-their-pixels-if-promised",
     .sentence = "triangles without area cover their pixels, if that is promised",
     .reason = "A vertex in a pixel's open square is a point that both have in common "
               "(RULES §11).",
     .exceptions = "clipped triangles, equal indices, culling and snapped positions",
     .generate = &generate,
     .check = &check,
     .is_promised = &covers_degenerates,
     .unpromised = "the backend does not promise to cover triangles without area",
     .covers = {cover(15, "several samples")}});

}  // namespace
}  // namespace rastercheck::properties::degenerate_covers_its_pixels_law
