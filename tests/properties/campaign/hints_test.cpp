#include "properties/campaign/internal/hints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "backends/factory.h"
#include "properties/campaign/internal/simple_changes.h"
#include "properties/judged_law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::hints_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;

const DrawnParts kAll{records::DrawnPart::coverage, records::DrawnPart::depth,
                      records::DrawnPart::values};

/// Two triangles with two attributes; the near plane cuts one of the triangles.
cases::Case scene() {
  cases::Case c;
  c.framebuffer = {16, 12, 1};
  c.viewport = {0, 0, 16, 12, 0.125F, 0.75F};
  c.positions = {{-0.9F, -0.8F, 0.25F, 1},
                 {1.4F, -1.3F, 0.5F, 2},
                 {-0.8F, 0.7F, 0.75F, 1},
                 {0.6F, 1.3F, -0.25F, 1.5F}};
  c.attributes = {{"a0"}, {"a1"}};
  c.attribute_values = {0.25F, -3, 0.5F, 7, 1, 2, -0.375F, 5};
  c.triangles = {{0, 1, 2}, {2, 1, 3}};
  return c;
}

/// A backend that draws each case as `cpu` would draw a changed case.
class Mistaken {
 public:
  template <typename Change>
  explicit Mistaken(const Change& change)
      : backend_(
            [this, change](const cases::Case& c, cases::Fragments& drawn) {
              cases::Case other = c;
              change(other);
              drawn = std::move(right_->draw(other).value().fragments);
            },
            "cpu") {}

  /// Makes the backend promise the contract of `c` from now on, whatever is asked for.
  void promises(const cases::Case& c) { backend_.promised = right_->contract(c); }

  std::optional<std::vector<std::string>> hints(const cases::Case& c) {
    return hints_of(c, backend_, kAll, {});
  }

 private:
  std::unique_ptr<backends::Backend> right_ = backends::make_backend("cpu").value();
  DamagedBackend backend_;
};

TEST(HintsOf, WhatIsRightNeedsNone) {
  DamagedBackend right({}, "cpu");
  EXPECT_EQ(hints_of(scene(), right, kAll, {}), std::nullopt);
}

TEST(HintsOf, AnotherAttributeInItsPlace) {
  DamagedBackend backend(
      [](const cases::Case& /*c*/, cases::Fragments& drawn) {
        for (std::size_t i = 0; i < drawn.attributes.size(); i += 2) {
          drawn.attributes[i] = drawn.attributes[i + 1];
        }
      },
      "cpu");
  EXPECT_THAT(hints_of(scene(), backend, kAll, {}),
              Optional(ElementsAre("“a1” is in the place of “a0”")));
}

TEST(HintsOf, RowsTheOtherWay) {
  DamagedBackend backend(
      [](const cases::Case& c, cases::Fragments& drawn) {
        for (auto& y : drawn.y) y = static_cast<std::uint16_t>(c.framebuffer.height - 1 - y);
      },
      "cpu");
  EXPECT_THAT(hints_of(scene(), backend, kAll, {}),
              Optional(testing::UnorderedElementsAre(
                  "y points in the other direction", "the target is upside down",
                  "the viewport is upside down in the target", "the rules are Direct3D's")));
}

TEST(HintsOf, HalfAPixelOff) {
  Mistaken backend([](cases::Case& c) { c.viewport.x -= 0.5F; });
  EXPECT_THAT(backend.hints(scene()),
              Optional(ElementsAre("everything is moved by (-1/2, 0) pixels")));
}

TEST(HintsOf, PositionsOnACoarseGrid) {
  cases::Case c = scene();
  Mistaken backend([](cases::Case& other) {
    other.coverage = cases::Snapping{4, cases::Rounding::nearest_even, 0};
    other.basis = cases::Basis::snapped;
  });
  EXPECT_THAT(backend.hints(c), Optional(Contains("positions are snapped to 1/16 pixel")));
}

// Kills: a change of the tie rule that is not tried for a backend whose contract sets its own rule.
TEST(HintsOf, TiesOfTheOtherEdges) {
  cases::Case c = scene();
  c.positions = {
      {-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {-0.5F, 0.5F, 0.5F, 1}, {0, 0, 0, 1}};
  c.triangles = {{0, 1, 2}};
  c.framebuffer = {7, 7, 1};
  c.viewport = {-0.5F, -0.5F, 8, 8, 0, 1};
  Mistaken backend([](cases::Case& other) { other.fill_rule = cases::TieRule::bottom_left; });
  EXPECT_THAT(backend.hints(c), Optional(Contains("ties go to the other edges")));
  backend.promises(c);
  EXPECT_THAT(backend.hints(c), Optional(Contains("ties go to the other edges")));
}

// The corners are the centres of pixels (1, 1), (5, 1) and (1, 5); by hand, 15 pixels have their
// centre in the triangle or on an edge, and 3 within.
TEST(HintsOf, TiesOfAllEdgesAndOfNone) {
  cases::Case c = scene();
  c.positions = {{-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {-0.5F, 0.5F, 0.5F, 1}};
  c.attributes = {{"a0"}};
  c.attribute_values = {2, 2, 2};
  c.triangles = {{0, 1, 2}};
  c.framebuffer = {7, 7, 1};
  c.viewport = {-0.5F, -0.5F, 8, 8, 0, 1};
  // Draws the pixels (x, y) with x, y >= first and x + y <= last.
  const auto hints = [&c](unsigned first, unsigned last, std::size_t count) {
    DamagedBackend backend(
        [&](const cases::Case& /*c*/, cases::Fragments& drawn) {
          drawn = {};
          drawn.attribute_count = 1;
          for (unsigned y = first; y + first <= last; ++y) {
            for (unsigned x = first; x + y <= last; ++x) {
              drawn.triangle.push_back(0);
              drawn.x.push_back(static_cast<std::uint16_t>(x));
              drawn.y.push_back(static_cast<std::uint16_t>(y));
              drawn.sample.push_back(0);
              drawn.depth.push_back(0.5F);
              drawn.attributes.push_back(2);
            }
          }
          EXPECT_EQ(drawn.size(), count);
        },
        "cpu");
    return hints_of(c, backend, kAll, {});
  };
  EXPECT_THAT(hints(1, 6, 15),
              Optional(ElementsAre("every triangle owns the samples on its edges")));
  EXPECT_THAT(hints(2, 5, 3), Optional(Contains("no triangle owns the samples on its edges")));
  // More than all samples on edges.
  EXPECT_THAT(hints(1, 7, 21), Optional(IsEmpty()));
}

// Kills: a hint about any wrong depth; a hint where depth with perspective is the right depth.
TEST(HintsOf, DepthWithPerspective) {
  cases::Case c = scene();
  c.rules = cases::Rules::opengl;
  c.triangles = {{0, 1, 2}};
  const auto hints = [&c](float more) {
    DamagedBackend backend(
        [more](const cases::Case& /*c*/, cases::Fragments& drawn) {
          for (std::size_t i = 0; i < drawn.size(); ++i) {
            drawn.depth[i] = drawn.attributes[i * 2] + more;
          }
        },
        "cpu");
    return hints_of(c, backend, kAll, {});
  };
  // By hand: z/w is 0.25, 0.25 and 0.75, so depth is 0.125 + 0.625 (1 + z/w)/2.
  c.attribute_values = {0.515625F, -3, 0.515625F, 7, 0.671875F, 2, 0, 5};
  EXPECT_THAT(hints(0), Optional(ElementsAre("depth is interpolated with perspective")));
  EXPECT_THAT(hints(0.01F), Optional(IsEmpty()));
  for (cases::ClipVertex& p : c.positions) p.w = 1;
  c.attribute_values = {0.515625F, -3, 0.59375F, 7, 0.671875F, 2, 0, 5};
  EXPECT_THAT(hints(0.01F), Optional(IsEmpty()));
}

// Kills: a hint although a simple change explains only some of the errors; no hint because another
// part is wrong for another reason.
TEST(HintsOf, AreOfThePartsInQuestion) {
  DamagedBackend backend(
      [](const cases::Case& /*c*/, cases::Fragments& drawn) {
        for (std::size_t i = 0; i < drawn.attributes.size(); i += 2) {
          drawn.attributes[i] = drawn.attributes[i + 1];
        }
        if (drawn.size() > 0) drawn.depth[0] += 0.25F;
      },
      "cpu");
  using records::DrawnPart;
  EXPECT_THAT(hints_of(scene(), backend, kAll, {}), Optional(IsEmpty()));
  EXPECT_THAT(hints_of(scene(), backend, {DrawnPart::depth}, {}), Optional(IsEmpty()));
  EXPECT_THAT(hints_of(scene(), backend, {DrawnPart::values}, {}),
              Optional(ElementsAre("“a1” is in the place of “a0”")));
  EXPECT_EQ(hints_of(scene(), backend, {DrawnPart::coverage}, {}), std::nullopt);
}

// Kills: reporting a change under which the correct drawing would be right, too, so that it
// explains nothing. With centroids this is so: a centroid may be any point of a covered pixel, so
// values at samples and at centres are both right.
TEST(HintsOf, OmitsChangesUnderWhichTheRightDrawingIsRight) {
  cases::Case c = scene();
  c.framebuffer.samples = 4;
  c.positions = {{-4, -4, 0.5F, 1}, {12, -4, 0.5F, 1}, {-4, 12, 0.5F, 1}, {0, 0, 0.5F, 1}};
  c.triangles = {{0, 1, 2}};
  Mistaken backend([](cases::Case& other) {
    for (cases::Attribute& a : other.attributes) a.location = cases::Location::center;
  });
  EXPECT_THAT(backend.hints(c), Optional(ElementsAre("attributes are taken at centres")));
}

TEST(HintsOf, NothingIsWrongWithoutAPromise) {
  DamagedBackend backend(
      [](const cases::Case& /*c*/, cases::Fragments& drawn) {
        for (float& value : drawn.attributes) value += 0.5F;
      },
      "cpu");
  cases::Contract nothing = backend.contract(scene());
  cases::TrianglePromise none;
  none.is_made = false;
  nothing.triangles = {none, none};
  EXPECT_THAT(hints_of(scene(), backend, kAll, {}), Optional(IsEmpty()));
  backend.promised = nothing;
  EXPECT_EQ(hints_of(scene(), backend, kAll, {}), std::nullopt);
}

/// A case in which each simple change changes something.
cases::Case rich_scene() {
  cases::Case c = scene();
  c.framebuffer = {10, 10, 2};
  c.viewport = {1, 9, 8, -7, 0.125F, 0.75F};
  c.rules = cases::Rules::opengl;
  c.fill_rule = cases::TieRule::bottom_left;
  c.cull = cases::Cull::back;
  c.scissor = cases::Scissor{2, 1, 7, 8};
  c.attributes = {{"smooth"},
                  {"flat", cases::Interpolation::flat},
                  {"line", cases::Interpolation::noperspective, cases::Location::center}};
  c.attribute_values = {0.25F, 1,     3, 0.5F,    2,    7, 1, 3, -2,
                        -6,    0.75F, 4, 0.3125F, 0.7F, 8, 2, 6, 10};
  c.positions.push_back({0.9F, -0.5F, 1.5F, 1});
  c.positions.push_back({0.3F, -0.4F, 0.1F, -0.5F});
  c.clip_distance_count = 1;
  c.clip_distances = {1, 0.5F, 2, -0.25F, 1, 0.75F};
  // Triangles of both orientations, so that culling leaves one of each pair.
  c.triangles = {{0, 1, 2}, {0, 2, 1}, {2, 1, 3}, {2, 3, 1},
                 {1, 4, 3}, {1, 3, 4}, {0, 1, 5}, {0, 5, 1}};
  return c;
}

/// Moves fragments to where they lie in the changed case. The same call moves them back, because
/// each of these changes is its own inverse.
void move(const SimpleChange& change, cases::Fragments& drawn) {
  if (change.place_of == nullptr) return;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto place = change.place_of(change.source.framebuffer, drawn.place_of(i));
    drawn.x[i] = static_cast<std::uint16_t>(place.x);
    drawn.y[i] = static_cast<std::uint16_t>(place.y);
    drawn.sample[i] = static_cast<std::uint8_t>(place.sample);
  }
}

/// True if the right drawing of a case is wrong for the changed case.
bool tells_apart(const cases::Case& c, const SimpleChange& change, backends::Backend& right) {
  cases::Fragments drawn = right.draw(c).value().fragments;
  move(change, drawn);
  const cases::Contract contract = right.contract(change.source);
  return judge_drawn(change.source, contract, drawn, {}, 0).violation_count > 0;
}

// Each change is reported for a backend that makes it, unless the changed drawing is right.
TEST(HintsOf, EachSimpleChangeIsFound) {
  const WrongParts all{false, true, {0, 1, 2}};
  const std::unique_ptr<backends::Backend> right = backends::make_backend("cpu").value();
  cases::Case snapped = rich_scene();
  snapped.coverage = cases::Snapping{6, cases::Rounding::nearest_even, 0};
  snapped.depth_clamp = true;
  cases::Case tested = rich_scene();
  tested.depth_test = cases::DepthTest::less;
  tested.depth_clear = 0.5F;
  std::set<std::string> found;
  for (const cases::Case& c : {rich_scene(), snapped, tested}) {
    visit_simple_changes(c, all, [&](const SimpleChange& change) {
      if (found.contains(change.change) || !tells_apart(c, change, *right)) return;
      DamagedBackend backend(
          [&](const cases::Case& /*c*/, cases::Fragments& drawn) {
            drawn = right->draw(change.source).value().fragments;
            move(change, drawn);
          },
          "cpu");
      const auto hints = hints_of(c, backend, kAll, {});
      if (!hints) return;
      EXPECT_THAT(*hints, Contains(change.change));
      found.insert(change.change);
    });
  }
  // There are about 90 changes that differ here; no sample of these cases lies on an edge.
  EXPECT_GT(found.size(), 90U);
}

}  // namespace
}  // namespace rastercheck::properties::hints_test
