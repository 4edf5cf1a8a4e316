// Drawing twice draws the same bits: a backend draws a case three times, twice in succession and
// once more after another case, with the same result each time.
//
// Why. A drawing depends on the case alone. Only remains of earlier drawings can make a difference:
// memory that is not initialised or cleared, tables kept from another draw's samples, attributes or
// viewport, a list that is not empty. The other case differs in all of these: it is larger, has
// other rules, samples, attributes, clip distances, coverage and triangles, and no scissor or
// culling. If the backend does not support that case, the other case is the given one with its
// triangles turned; if the backend does not support this either, there is no other case.
//
// Samples: all, with values and derivatives, even those that the contract leaves open. Backends
// that draw pictures also draw a picture each time, with a random pipeline (choices.h). The other
// two drawings are compared with the middle one, which follows a drawing of the same case.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "properties/judged_law.h"
#include "properties/laws/internal/picture_cases.h"
#include "properties/laws/internal/pipelines.h"
#include "properties/laws/internal/same_drawing.h"
#include "properties/laws/internal/same_picture.h"

namespace rastercheck::properties::drawing_twice_draws_the_same_law {
namespace {

cases::Rules other_rules(cases::Rules rules) {
  switch (rules) {
    case cases::Rules::opengl:
      return cases::Rules::d3d;
    case cases::Rules::vulkan:
      return cases::Rules::opengl;
    case cases::Rules::d3d:
      break;
  }
  return cases::Rules::vulkan;
}

/// Returns a larger case whose state differs from the given case's. Its triangles appear in a few
/// pixels of its far corner, since only the remains of drawing it matter.
cases::Case other_case(const cases::Case& c) {
  constexpr int kMoreColumns = 37;
  constexpr int kMoreRows = 21;
  constexpr int kSeen = 12;
  constexpr std::size_t kMostTriangles = 8;
  cases::Case other;
  other.rules = other_rules(c.rules);
  other.fill_rule = c.fill_rule == cases::TieRule::top_left ? cases::TieRule::bottom_left
                                                            : cases::TieRule::top_left;
  if (!c.coverage) other.coverage = cases::Snapping{};
  cases::FramebufferSize& size = other.framebuffer;
  size.width = std::min(c.framebuffer.width + kMoreColumns, cases::kMaxSize);
  size.height = std::min(c.framebuffer.height + kMoreRows, cases::kMaxSize);
  size.samples = c.framebuffer.samples == 1 ? 4 : c.framebuffer.samples;
  other.viewport.x = static_cast<float>(size.width - kSeen);
  other.viewport.y = static_cast<float>(size.height - kSeen);
  other.viewport.width = kSeen;
  other.viewport.height = kSeen;
  other.depth_clamp = !c.depth_clamp;
  for (const char* name : {"a", "b", "c", "d", "e"}) other.attributes.push_back({name});
  other.attributes.back().interpolation = cases::Interpolation::noperspective;
  other.clip_distance_count = c.clip_distance_count == 0 ? 1 : 0;
  for (const cases::ClipVertex& p : c.positions) {
    other.positions.push_back({-p.y, p.x, p.z, p.w});
    for (const float value : {p.x, p.y, p.z, p.w, 1.0F}) other.attribute_values.push_back(value);
    if (other.clip_distance_count > 0) other.clip_distances.push_back(p.x);
  }
  for (std::size_t i = 0; i < std::min(c.triangles.size(), kMostTriangles); ++i) {
    const cases::Triangle& triangle = c.triangles[i];
    other.triangles.push_back({triangle[2], triangle[1], triangle[0]});
    other.triangles.push_back({triangle[1], triangle[2], triangle[0]});
  }
  return other;
}

/// Returns the same case with its triangles turned.
cases::Case turned_case(cases::Case c) {
  for (cases::ClipVertex& p : c.positions) p = {-p.y, p.x, p.z, p.w};
  return c;
}

/// The result of drawing a case once: fragments, and a picture if the backend draws pictures.
struct DrawnAtOnce {
  cases::Fragments fragments;
  std::optional<cases::Picture> picture;
};

Result<DrawnAtOnce> draw_all(const cases::Case& c, backends::Backend& backend) {
  Result<backends::Drawn> fragments = draw_promised(c, backend);
  if (!fragments) return tl::unexpected(fragments.error());
  DrawnAtOnce drawing{std::move(fragments->fragments), std::nullopt};
  if (backend.picture_drawer() == nullptr) return drawing;
  Result<cases::Picture> picture = draw_picture(c, backend, pipeline_of(c));
  if (!picture) return tl::unexpected(picture.error());
  drawing.picture = *std::move(picture);
  return drawing;
}

/// Draws another case, which may leave something behind.
Result<void> draw_other(const cases::Case& c, backends::Backend& backend) {
  const auto is_unsupported = [](const Result<DrawnAtOnce>& drawn) {
    return !drawn && drawn.error().failure == Failure::unsupported;
  };
  Result<DrawnAtOnce> other = draw_all(other_case(c), backend);
  if (is_unsupported(other)) other = draw_all(turned_case(c), backend);
  if (!other && !is_unsupported(other)) return tl::unexpected(other.error());
  return {};
}

void compare(const cases::Case& c, const DrawnAtOnce& expected, const DrawnAtOnce& drawn,
             const std::string& note, Check& check) {
  merge(check, compare_drawings(c, expected.fragments, drawn.fragments, note));
  if (!expected.picture || !drawn.picture) return;
  const std::string with = note + "; a picture, " + text_of(pipeline_of(c));
  merge(check, compare_pictures(c, *expected.picture, *drawn.picture, with));
}

Result<Check> check(const cases::ClipCase& clip, backends::Backend& backend,
                    std::uint64_t /*index*/) {
  const Result<DrawnAtOnce> first = draw_all(clip, backend);
  if (!first) return tl::unexpected(first.error());
  const Result<DrawnAtOnce> second = draw_all(clip, backend);
  if (!second) return tl::unexpected(second.error());
  const Result<void> other = draw_other(clip, backend);
  if (!other) return tl::unexpected(other.error());
  const Result<DrawnAtOnce> third = draw_all(clip, backend);
  if (!third) return tl::unexpected(third.error());
  Check check;
  compare(clip, *second, *first, "the first drawing; the second one had the expected value", check);
  compare(clip, *second, *third,
          "the drawing after another case; before, it had the expected value", check);
  return check;
}

/// Most cases have several overlapping triangles.
Generated generate(Draw& draw) {
  return draw.one_in(2) ? generate_any(draw) : overlapping_case(draw);
}

const LawRegistration kRegistration(
    {.id = "drawing-twice-draws-the-same-bits",
     .sentence = "drawing twice draws the same bits",
     .reason = "What is drawn depends on the case alone, and on nothing that other drawings leave "
               "behind.",
     .exceptions = "nothing: every case has something to say",
     .generate = &generate,
     .check = &check,
     .takes_lines_and_points = true,
     .covers = {cover(40, "drawn"), cover(10, "clipped"), cover(15, "several samples"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::drawing_twice_draws_the_same_law
