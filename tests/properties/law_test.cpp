// Laws are found by their ids, make valid cases, and do not apply if nothing is promised. What each
// law catches is tested in tests/properties/laws/.

#include "properties/law.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/factory.h"
#include "cases/case_reader.h"
#include "cases/case_writer.h"
#include "cases/clip_case.h"
#include "properties/judged_law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::law_test {
namespace {

using cases::Case;
using cases::Fragments;

/// The square with a clip distance that is positive everywhere, so that each law on fragments
/// applies.
Case kept_square() {
  Case c = square();
  c.clip_distance_count = 1;
  c.clip_distances = {1, 1, 1, 1};
  return c;
}

// Each law has labels that its cases must reach; without labels, nobody would notice cases that
// test nothing.
TEST(Laws, AreKnownByTheirIds) {
  std::vector<std::string_view> ids;
  for (const Law& law : laws()) {
    ids.push_back(law.id);
    EXPECT_EQ(find_law(law.id)->id, law.id);
    EXPECT_EQ(law.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), law.id.npos)
        << law.id;
    EXPECT_NE(law.sentence, "") << law.id;
    EXPECT_NE(law.reason, "") << law.id;
    EXPECT_NE(law.exceptions, "") << law.id;
    EXPECT_FALSE(law.covers.empty()) << law.id;
  }
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
  EXPECT_EQ(find_law("a-law"), nullptr);
}

TEST(Laws, AskForNoMoreThanChanceAllows) {
  EXPECT_EQ(least_reached(cover(10, "tie"), 0), 0U);
  EXPECT_EQ(least_reached(cover(10, "tie"), 100), 0U);    // 10 − √276
  EXPECT_EQ(least_reached(cover(10, "tie"), 1000), 48U);  // 100 − √2763 = 47.4…
  EXPECT_EQ(least_reached(cover(100, "tie"), 1000000), 994744U);
}

// Kills: a backend that leaves ties or placements open but is required to reach labels about them.
TEST(Laws, KnowWhichBackendsDrawWhatIsAskedFor) {
  const auto draws = [](const char* specification) {
    return draws_what_is_asked_for(*backends::make_backend(specification).value());
  };
  EXPECT_TRUE(draws("cpu"));
  EXPECT_TRUE(draws("cpu:precision=float32"));
  EXPECT_FALSE(draws("method:rational-linear"));
  DamagedBackend snapped({}, "cpu");
  snapped.promised = cases::Contract();
  snapped.promised->coverage = cases::Snapping();
  EXPECT_FALSE(draws_what_is_asked_for(snapped));
}

TEST(Laws, MakeCasesThatComeBackFromTheirFilesAndNameTheirStratum) {
  for (const Law& law : laws()) {
    std::set<std::string> strata;
    for (std::uint64_t i = 0; i < 200; ++i) {
      Draw first = draw_of(law, 7, i);
      Draw second = draw_of(law, 7, i);
      const Generated made = law.generate(first);
      EXPECT_EQ(made.source, law.generate(second).source) << law.id << i;
      const Result<Case> read = cases::parse_case(cases::to_json(made.source), "");
      ASSERT_TRUE(read.has_value()) << law.id << i << ": " << to_string(read.error());
      EXPECT_EQ(*read, made.source) << law.id << i;
      strata.insert(made.stratum);
    }
    // The kinds of lines are three; points have one, and so may laws that make a kind of their own.
    EXPECT_GE(strata.size(), law.takes_lines_and_points ? 1U : 3U) << law.id;
    EXPECT_FALSE(strata.contains("")) << law.id;
  }
}

// The model scales the square to a quarter, in the middle: pixels 3 and 4. Kills: a camera's case
// handed to a law as it was given; the given case derived from what the law has changed.
TEST(Laws, GetClipPositionsAndKnowTheCamera) {
  Case c = square();
  c.camera.emplace();
  c.camera->model = {0.25F, 0, 0, 0, 0, 0.25F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  Law law;
  law.check = [](const cases::ClipCase& clip, backends::Backend& backend, std::uint64_t) {
    EXPECT_FALSE(clip.camera.has_value());
    EXPECT_TRUE(clip.given().camera.has_value());
    cases::ClipCase changed = clip;
    changed.positions.clear();
    EXPECT_EQ(changed.given(), clip.given());
    return check_drawn(clip, backend, [](const cases::ClipCase&, const backends::Drawn& drawn) {
      Check check;
      check.violation_count = drawn.fragments.size();
      return check;
    });
  };
  DamagedBackend backend;
  EXPECT_EQ(check_law(law, c, backend, 0).value().violation_count, 4U);
  const cases::ClipCase plain(square());
  EXPECT_EQ(plain.given(), square());
}

// Kills: a law about vertex stages that is not checked on positions that no float holds, although
// it is about them.
TEST(Laws, OfCamerasAloneGetPositionsBeyondFloats) {
  Case c = square();
  c.camera.emplace();
  c.camera->model = {0x1p127F, 0, 0, 0x1p127F, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  DamagedBackend backend;
  Law law;
  law.check = [](const cases::ClipCase&, backends::Backend&, std::uint64_t) {
    return Result<Check>(Check());
  };
  EXPECT_FALSE(check_law(law, c, backend, 0).has_value());
  law.check_given = [](const Case& given, backends::Backend&, std::uint64_t) {
    EXPECT_TRUE(given.camera.has_value());
    return Result<Check>(Check());
  };
  EXPECT_TRUE(check_law(law, c, backend, 0).has_value());
}

// Laws about a property that method:rational-linear promises are checked on that method, and the
// others on `cpu`.
TEST(Laws, HoldOfTheSquare) {
  int checked = 0;
  for (const Law& law : laws()) {
    DamagedBackend method;
    DamagedBackend cpu({}, "cpu");
    DamagedBackend& backend = is_promised(law, method) ? method : cpu;
    const Check check = check_law(law, kept_square(), backend, 0).value();
    EXPECT_EQ(check.violation_count, 0U) << law.id;
    EXPECT_TRUE(std::is_sorted(check.labels.begin(), check.labels.end())) << law.id;
    if (!check.is_applicable) continue;
    ++checked;
    EXPECT_GT(check.judgement.counts.required, 0U) << law.id;
  }
  EXPECT_GE(checked, 12);
}

TEST(Laws, SayNothingOfWhatIsNotPromised) {
  const auto method = backends::make_backend("method:rational-linear").value();
  std::vector<std::string_view> not_promised;
  for (const Law& law : laws()) {
    if (is_promised(law, *method)) continue;
    not_promised.push_back(law.id);
    for (std::uint64_t i = 0; i < 20; ++i) {
      Draw draw = draw_of(law, 1, i);
      const Case c = law.generate(draw).source;
      EXPECT_FALSE(check_law(law, c, *method, i).value().is_applicable) << law.id << i;
    }
  }
  EXPECT_THAT(
      not_promised,
      testing::IsSupersetOf(
          {"a-picture-is-what-its-fragments-leave", "additive-blending-counts-overdraw",
           "differences-across-quads-stay-within-the-bound",
           "discarding-draws-what-keeping-the-kept-texels-draws",
           "filtered-colours-stay-within-the-bound", "normals-stay-within-their-bound",
           "screen-derivatives-stay-within-the-bound", "strips-and-fans-are-their-triangles",
           "texels-are-those-of-the-exact-coordinates", "the-vertex-stage-stays-within-its-bound",
           "values-at-vertices-come-back", "what-is-visible-is-not-called-occluded"}));
}

// Kills: a law about samples, or about triangles with an area, that is held against whole pixels.
TEST(Laws, AboutSamplesSayNothingOfWholePixels) {
  const auto outer = backends::make_backend("cpu:conservative=outer").value();
  const auto inner = backends::make_backend("cpu:conservative=inner").value();
  const Law& shared_edge = *find_law("a-shared-edge-covers-each-sample-once");
  const Law& range = *find_law("values-stay-in-the-range-of-their-vertices");
  const Law& judged = *find_law("coverage-obeys-the-contract");
  EXPECT_FALSE(is_promised(shared_edge, *outer));
  EXPECT_FALSE(is_promised(shared_edge, *inner));
  EXPECT_FALSE(is_promised(range, *outer));
  EXPECT_TRUE(is_promised(range, *inner));
  EXPECT_TRUE(is_promised(judged, *outer));
  EXPECT_EQ(why_unpromised(shared_edge, *inner), "the backend covers whole pixels, not samples");
  EXPECT_FALSE(check_law(shared_edge, square(), *outer, 0).value().is_applicable);
  EXPECT_FALSE(check_law(range, square(), *outer, 0).value().is_applicable);
}

TEST(Laws, PassOnWhatABackendCannotDraw) {
  class Refuses : public DamagedBackend {
   public:
    Refuses() : DamagedBackend({}, "cpu") {}
    Result<Fragments> draw_fragments(const Case& /*c*/) override {
      return tl::unexpected(Error{"", "", "no triangles today"});
    }
    Result<Fragments> draw_assembled(const Case& c, cases::Topology /*topology*/,
                                     std::span<const std::uint32_t> /*indices*/) override {
      return draw_fragments(c);
    }
    Result<cases::Picture> draw_picture(const Case& c,
                                        const cases::Pipeline& /*pipeline*/) override {
      return tl::unexpected(draw_fragments(c).error());
    }
    Result<bool> is_occluded(const Case& c, std::size_t /*occluders*/) override {
      return tl::unexpected(draw_fragments(c).error());
    }
    Result<std::vector<cases::ClipVertex>> transform(const Case& c) override {
      return tl::unexpected(draw_fragments(c).error());
    }
    Result<std::vector<cases::Normal>> transform_normals(
        const cases::Matrix4& /*model*/, std::span<const cases::Normal> /*normals*/) override {
      return tl::unexpected(draw({}).error());
    }
  };
  Case c = kept_square();
  c.camera.emplace();
  int asked = 0;
  for (const Law& law : laws()) {
    Refuses backend;
    if (!is_promised(law, backend)) continue;
    const Result<Check> check = check_law(law, c, backend, 0);
    if (check && !check->is_applicable) continue;
    ASSERT_FALSE(check.has_value()) << law.id;
    EXPECT_EQ(check.error().reason, "no triangles today");
    ++asked;
  }
  EXPECT_GE(asked, 12);
}

}  // namespace
}  // namespace rastercheck::properties::law_test
