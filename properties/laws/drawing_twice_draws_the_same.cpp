// Drawing twice draws the same bits: a case that is drawn three times by one backend, twice in
// succession and once more after another case was drawn, comes out the same each time.
//
// Why. What is drawn depends on the case alone. What differs between two drawings of it is what the
// drawings before have left behind: memory that is not initialised or not cleared, tables kept of
// another draw's samples, attributes or viewport, a list that still has something in it. The other
// case is unlike this one in all of these: larger, of other rules, samples, attributes, clip
// distances and coverage, without a scissor or culling, and its triangles are other ones. Where a
// backend does not support such a case the other one is this one, turned; where it does not support
// that, there is no other case.
//
// Samples: all, values and derivatives too, whatever the contract leaves open. Backends that draw
// pictures draw one each time as well, by a pipeline of the case's numbers. The drawing in the
// middle, which has the same case before it, is what the other two are held against.

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

/// A larger case that shares no state with this one. All of it is seen in a few pixels of its far
/// corner, as nothing is asked of it but what it leaves behind.
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

/// The same case with other triangles.
cases::Case turned_case(cases::Case c) {
  for (cases::ClipVertex& p : c.positions) p = {-p.y, p.x, p.z, p.w};
  return c;
}

/// What is drawn of a case at a time: fragments, and a picture where the backend draws some.
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

/// Draws something else, for what it leaves behind.
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
  compare(clip, *second, *first, "drawn the first time; the second time it was the other", check);
  compare(clip, *second, *third, "drawn after another case; before, it was the other", check);
  return check;
}

/// Most have several triangles, one above the other.
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
     .covers = {cover(40, "drawn"), cover(10, "clipped"), cover(15, "several samples"),
                cover(7, "w <= 0")}});

}  // namespace
}  // namespace rastercheck::properties::drawing_twice_draws_the_same_law
