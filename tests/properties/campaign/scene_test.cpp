#include "properties/campaign/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "backends/factory.h"
#include "cases/mesh.h"
#include "properties/campaign/check_case.h"
#include "records/run.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::scene_test {
namespace {

using records::AttributeKind;
using records::Counterexample;
using records::PixelState;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kCoverage = "coverage-obeys-the-contract";
constexpr const char* kValues = "values-stay-within-the-bound";
const std::vector<std::string> kLaws{"constants-stay-constant", kCoverage, kValues};

cases::Case scene() {
  cases::Case c = square();
  c.name = "square";
  return c;
}

SceneFindings judged(const cases::Case& c, const Damage& damage = {},
                     const std::vector<std::string>& laws = kLaws) {
  DamagedBackend backend(damage);
  return judge_scene(c, "damaged", backend, 7, laws).value();
}

records::RecordKey key(const char* law, AttributeKind kind = AttributeKind::coverage) {
  return {law, "damaged", kind, "scene square"};
}

PixelState state(const SceneFindings& found, std::size_t x, std::size_t y) {
  return found.map.states[y * 8 + x];
}
float error(const SceneFindings& found, std::size_t x, std::size_t y) {
  return found.map.errors[y * 8 + x];
}

TEST(JudgeScene, RecordsTheTwoLawsThatHoldOfEveryCase) {
  const SceneFindings found = judged(scene());
  EXPECT_THAT(found.findings.counterexamples, IsEmpty());
  EXPECT_EQ(found.findings.fault, std::nullopt);
  const auto& records = found.findings.records;
  EXPECT_EQ(records.at(key(kCoverage)).cases, (records::CaseCounts{1, 0, 0}));
  EXPECT_GE(records.at(key(kCoverage)).counts.required, 56U);  // the diagonal may be open
  EXPECT_EQ(records.at(key(kValues)).cases, (records::CaseCounts{1, 0, 0}));
  // 64 fragments with three attributes each.
  EXPECT_EQ(records.at(key(kValues, AttributeKind::smooth))
                .errors.classes[records::FragmentClass::correct],
            192U);
  EXPECT_FALSE(records.contains(key(kCoverage, AttributeKind::smooth)));
  EXPECT_FALSE(records.contains(key("constants-stay-constant")));
}

// One of 64 samples is missing, one has a wrong value, and one is drawn by both triangles. Kills:
// counting samples that may be drawn or not as judged.
TEST(JudgeScene, CountsWhatWasJudgedAndWhatIsWrong) {
  const cases::Case c = scene();
  const auto cpu = backends::make_backend("cpu").value();
  const SceneFindings right = judge_scene(c, "cpu", *cpu, 7, kLaws).value();
  EXPECT_EQ(right.result, (records::SceneResult{"square", "cpu", 2, 64, 64, 0, 0, false, {}, 256}));
  DamagedBackend backend(
      [](const cases::Case&, cases::Fragments& drawn) {
        drop(drawn, 0, 1, 1);
        value(drawn, 0, 2, 3, 1) = 1.5F;
        add(drawn, 0, 7, 7);
      },
      "cpu");
  const SceneFindings wrong = judge_scene(c, "cpu", backend, 7, kLaws).value();
  EXPECT_EQ(wrong.result, (records::SceneResult{"square", "cpu", 2, 64, 65, 0, 3, false, {}, 252}));
}

TEST(JudgeScene, RecordsOnlyWhatIsAskedFor) {
  const SceneFindings found = judged(scene(), {}, {kCoverage});
  EXPECT_TRUE(found.findings.records.contains(key(kCoverage)));
  EXPECT_FALSE(found.findings.records.contains(key(kValues)));
}

TEST(JudgeScene, MapsWhatBecameOfPixels) {
  cases::Case c = scene();
  c.triangles.resize(1);  // A alone: pixels with x + y < 7, and perhaps the diagonal
  const SceneFindings found = judged(c, [](const cases::Case&, cases::Fragments& drawn) {
    drop(drawn, 0, 1, 1);
    add(drawn, 0, 6, 6);
    value(drawn, 0, 2, 3, 1) = 1.5F;
  });
  ASSERT_EQ(found.map.width, 8);
  ASSERT_EQ(found.map.height, 8);
  EXPECT_EQ(state(found, 0, 0), PixelState::correct);
  EXPECT_EQ(error(found, 0, 0), 0);  // 1/2, 1 and 0 are floats
  EXPECT_EQ(state(found, 7, 7), PixelState::empty);
  EXPECT_EQ(error(found, 7, 7), 0);
  EXPECT_EQ(state(found, 1, 1), PixelState::violated);  // missing
  EXPECT_EQ(error(found, 1, 1), 0);
  EXPECT_EQ(state(found, 6, 6), PixelState::violated);  // extra
  EXPECT_EQ(state(found, 2, 3), PixelState::violated);
  EXPECT_EQ(error(found, 2, 3), 0x1p22F);  // one half, in ulps of 1
  EXPECT_EQ(state(found, 3, 2), PixelState::correct);
}

// Kills: the error of a fragment that is hidden in the picture.
TEST(JudgeScene, MapsTheErrorOfTheNearestFragment) {
  cases::Case c = scene();
  c.triangles = {{0, 1, 2}, {4, 5, 6}};
  for (int i = 0; i < 3; ++i) {  // a copy of A, farther away
    c.positions.push_back(c.positions[static_cast<std::size_t>(i)]);
    c.positions.back().z = 0.5F;
  }
  c.attribute_values.insert(c.attribute_values.end(), {0, 1, 0, 8, 1, 0, 0, 1, 0});
  const auto damaged = [&c](std::uint32_t triangle) {
    return judged(c, [triangle](const cases::Case&, cases::Fragments& drawn) {
      // A case that is shrunk to one triangle lacks the other.
      if (is_drawn(drawn, triangle, 2, 3)) value(drawn, triangle, 2, 3, 1) = 1.5F;
    });
  };
  EXPECT_EQ(state(damaged(0), 2, 3), PixelState::violated);
  EXPECT_EQ(error(damaged(0), 2, 3), 0x1p22F);
  EXPECT_EQ(state(damaged(1), 2, 3), PixelState::violated);
  EXPECT_EQ(error(damaged(1), 2, 3), 0);
}

void lose_last(const cases::Case& /*c*/, cases::Fragments& drawn) {
  drop(drawn, drawn.triangle.back(), 7, 7);
}

TEST(JudgeScene, MakesCounterexamplesOfOneTriangle) {
  const SceneFindings found = judged(scene(), &lose_last);
  EXPECT_EQ(found.findings.records.at(key(kCoverage)).cases, (records::CaseCounts{1, 0, 1}));
  EXPECT_EQ(found.findings.records.at(key(kValues)).cases, (records::CaseCounts{1, 0, 0}));
  ASSERT_THAT(found.findings.counterexamples, SizeIs(1));
  const Counterexample& one = found.findings.counterexamples[0];
  EXPECT_EQ(one.source.found,
            (cases::Found{kCoverage, "damaged", "missing", 7, 1, "coverage", "ordinary"}));
  EXPECT_EQ(one.source.name, "scene square");
  EXPECT_THAT(one.source.triangles, SizeIs(1));
  EXPECT_THAT(one.source.positions,
              ElementsAre(scene().positions[2], scene().positions[1], scene().positions[3]));
}

// Kills: two counterexamples with the same file name if the corpus also has the scene.
TEST(JudgeScene, GivesWayToTheCorpus) {
  cases::Case c = scene();
  c.triangles = {{2, 1, 3}};
  DamagedBackend backend(&lose_last);
  Findings findings = judge_scene(c, "damaged", backend, 7, kLaws).value().findings;
  EXPECT_EQ(findings.counterexamples.at(0).origin, records::Origin::scene);
  const NumberedCase of_corpus{c, "corpus", 0, records::Origin::corpus};
  check_case(*find_law(kCoverage), "damaged", backend, 7, of_corpus, findings);
  ASSERT_THAT(findings.counterexamples, SizeIs(1));
  EXPECT_EQ(findings.counterexamples[0].origin, records::Origin::corpus);
}

TEST(JudgeScene, HoldsADrawingThatFailsAgainstTheBackend) {
  const auto backend = backends::make_backend("damaged:refuses").value();
  const SceneFindings found = judge_scene(scene(), "damaged", *backend, 7, kLaws).value();
  EXPECT_EQ(found.findings.records.at(key(kCoverage)).cases, (records::CaseCounts{1, 0, 1}));
  EXPECT_EQ(found.findings.records.at(key(kValues)).cases, (records::CaseCounts{1, 0, 1}));
  ASSERT_THAT(found.findings.counterexamples, SizeIs(2));
  EXPECT_EQ(found.findings.counterexamples[0].violations[0].note, "out of memory");
  EXPECT_FALSE(found.drawn.has_value());
  EXPECT_EQ(found.result, (records::SceneResult{
                              "square", "damaged", 2, 0, 0, 0, 0, false, {{"out of memory", 2}}}));
  EXPECT_THAT(found.map.states, SizeIs(64));
}

/// Six triangles on the square, three of them farther away.
cases::Case layered_scene() {
  cases::Case c = scene();
  const std::size_t count = c.positions.size();
  for (std::size_t v = 0; v < count; ++v) {
    cases::ClipVertex p = c.positions[v];
    p.z = 0.75F * p.w;
    c.positions.push_back(p);
    const auto values = c.attributes_of(v);
    const std::vector<float> copy(values.begin(), values.end());
    c.attribute_values.insert(c.attribute_values.end(), copy.begin(), copy.end());
  }
  const cases::Triangle first = c.triangles[0];
  const cases::Triangle second = c.triangles[1];
  const auto n = static_cast<std::uint32_t>(count);
  c.triangles.push_back({first[0] + n, first[1] + n, first[2] + n});
  c.triangles.push_back(second);
  c.triangles.push_back({second[0] + n, second[1] + n, second[2] + n});
  c.triangles.push_back(first);
  return c;
}

/// Adds up the levels that answered for values. Which level answers depends on the largest error so
/// far, and so on where a part begins.
records::RecordSet with_levels_added_up(records::RecordSet all) {
  for (auto& [key, record] : all) {
    records::LevelCounts& values = record.levels.values;
    values = {values.filter + values.interval + values.exact, 0, 0};
  }
  return all;
}

// Kills: a part's triangle number used as the scene's, in places of errors, in counterexamples and
// in the picture; a part that is judged twice or not at all.
TEST(JudgeScene, GivesTheSameInParts) {
  const cases::Case c = layered_scene();
  const Damage damage = [](const cases::Case&, cases::Fragments& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      float& value = drawn.attributes[i * drawn.attribute_count];
      value = std::nextafter(value, value + static_cast<float>(drawn.x[i]) - 3);
    }
  };
  DamagedBackend whole_backend(damage);
  const SceneFindings whole = judge_scene(c, "damaged", whole_backend, 7, kLaws).value();
  for (const PartLimits& limits :
       {PartLimits{.triangles = 1}, PartLimits{.triangles = 4}, PartLimits{.samples = 100}}) {
    DamagedBackend backend(damage);
    const SceneFindings parts = judge_scene_in(limits, c, "damaged", backend, 7, kLaws).value();
    EXPECT_EQ(parts.result, whole.result);
    EXPECT_EQ(with_levels_added_up(parts.findings.records),
              with_levels_added_up(whole.findings.records));
    ASSERT_EQ(parts.findings.counterexamples.size(), whole.findings.counterexamples.size());
    for (std::size_t i = 0; i < whole.findings.counterexamples.size(); ++i) {
      EXPECT_EQ(parts.findings.counterexamples[i].source, whole.findings.counterexamples[i].source);
    }
    EXPECT_EQ(parts.map.states, whole.map.states);
    EXPECT_EQ(parts.map.errors, whole.map.errors);
    EXPECT_EQ(parts.drawn->triangle, whole.drawn->triangle);
    EXPECT_EQ(parts.drawn->depth, whole.drawn->depth);
    EXPECT_EQ(parts.drawn->attributes, whole.drawn->attributes);
  }
}

// Kills: a part that could not be drawn, left out without a message.
TEST(JudgeScene, JudgesTheOtherPartsWhereOneFails) {
  class FailsOnce : public DamagedBackend {
   public:
    FailsOnce(int which, Failure failure) : which_(which), failure_(failure) {}

   private:
    Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
      if (++drawings_ == which_) return tl::unexpected(Error{"", "", "no room", failure_});
      return DamagedBackend::draw_fragments(c);
    }
    int drawings_ = 0;
    int which_;
    Failure failure_;
  };
  const cases::Case c = layered_scene();
  const PartLimits limits{.triangles = 2};
  FailsOnce refuses(2, Failure::refused);
  const SceneFindings refused = judge_scene_in(limits, c, "damaged", refuses, 7, kLaws).value();
  EXPECT_EQ(refused.result.fragments, 128U);
  EXPECT_EQ(refused.result.not_judged, (std::map<std::string, std::uint64_t>{{"no room", 2}}));
  EXPECT_EQ(refused.findings.records.at(key(kCoverage)).cases, (records::CaseCounts{1, 0, 1}));
  ASSERT_THAT(refused.findings.counterexamples, SizeIs(2));
  EXPECT_EQ(refused.findings.counterexamples[0].source.found->verdict, "failed");
  EXPECT_THAT(refused.findings.counterexamples[0].source.triangles, SizeIs(2));

  FailsOnce hangs(2, Failure::hang);
  const SceneFindings hung = judge_scene_in(limits, c, "damaged", hangs, 7, kLaws).value();
  EXPECT_EQ(hung.result.not_judged.at("no room"), 4U);  // the third part is not tried
}

std::vector<ScenePart> parts_of(const cases::Case& c, const PartLimits& limits) {
  std::vector<ScenePart> parts;
  for (std::size_t first = 0; first < c.triangles.size(); first += parts.back().count) {
    parts.push_back(next_part(c, first, limits));
  }
  return parts;
}

// Kills: triangles that the backend refuses, and that keep others from being drawn; a refusal of
// the whole case treated as a refusal of one triangle.
TEST(JudgeScene, JudgesTrianglesBesideThoseThatAreNotDrawn) {
  class DrawsSome : public DamagedBackend {
   public:
    explicit DrawsSome(std::size_t least) : least_(least) {}
    int drawings = 0;

   private:
    Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
      ++drawings;
      const auto is_far = [&c](const cases::Triangle& t) {
        return c.positions[t[0]].z == 0.75F * c.positions[t[0]].w;
      };
      const bool has_far = std::any_of(c.triangles.begin(), c.triangles.end(), is_far);
      if (has_far || c.triangles.size() < least_) {
        return tl::unexpected(Error{"", "", "too far", Failure::unsupported});
      }
      return DamagedBackend::draw_fragments(c);
    }
    std::size_t least_;
  };
  DrawsSome near(0);
  const SceneFindings found = judge_scene(layered_scene(), "damaged", near, 7, kLaws).value();
  EXPECT_EQ(found.result.not_judged, (std::map<std::string, std::uint64_t>{{"too far", 2}}));
  EXPECT_GT(found.result.judged, 0U);
  EXPECT_THAT(found.findings.counterexamples, IsEmpty());
  EXPECT_EQ(found.findings.records.at(key(kCoverage)).cases, (records::CaseCounts{1, 0, 0}));

  DrawsSome none(1000);
  const SceneFindings nothing = judge_scene(layered_scene(), "damaged", none, 7, kLaws).value();
  EXPECT_EQ(nothing.result.not_judged.at("too far"), 6U);
  EXPECT_EQ(none.drawings, 2);
}

// Kills: a crash hidden by triangles that are not drawn; parts that are tried after a crash.
TEST(JudgeScene, TellsOfACrashAfterTrianglesThatAreNotDrawn) {
  class EndsBadly : public DamagedBackend {
   public:
    int drawings = 0;

   private:
    Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
      ++drawings;
      if (c.triangles.empty()) return DamagedBackend::draw_fragments(c);
      const Failure how = drawings == 1 ? Failure::unsupported : Failure::crash;
      return tl::unexpected(Error{"", "", drawings == 1 ? "too far" : "it ended", how});
    }
  };
  EndsBadly backend;
  const SceneFindings found =
      judge_scene_in({.triangles = 1}, layered_scene(), "damaged", backend, 7, kLaws).value();
  EXPECT_EQ(backend.drawings, 2);
  EXPECT_EQ(found.result.not_judged,
            (std::map<std::string, std::uint64_t>{{"too far", 1}, {"it ended", 5}}));
  ASSERT_THAT(found.findings.counterexamples, SizeIs(2));
  EXPECT_EQ(found.findings.counterexamples[0].source.found->verdict, "crash");
}

TEST(JudgeScene, IsDrawnAtOnceWithADepthTest) {
  cases::Case c = layered_scene();
  EXPECT_EQ(parts_of(c, {.triangles = 4}), (std::vector<ScenePart>{{0, 4}, {4, 2}}));
  EXPECT_EQ(parts_of(c, {.samples = 130}), (std::vector<ScenePart>{{0, 2}, {2, 2}, {4, 2}}));
  c.depth_test = cases::DepthTest::less;
  EXPECT_EQ(parts_of(c, {.triangles = 4}), (std::vector<ScenePart>{{0, 6}}));
}

// Kills: a triangle that is not visible, counted as if it covered the whole window.
TEST(JudgeScene, SizesPartsByWhatIsSeen) {
  cases::Case c = scene();
  c.triangles.assign(5, c.triangles[0]);
  for (cases::ClipVertex& p : c.positions) p.w = -p.w;
  EXPECT_EQ(parts_of(c, {.samples = 1}), (std::vector<ScenePart>{{0, 5}}));
  c.positions[c.triangles[0][0]] = {0, 0, 0, 1};  // the other two are behind the eye
  EXPECT_GT(parts_of(c, {.samples = 1}).size(), 1U);
}

// Kills: an open fragment counted as judged; a judged fragment counted as open.
TEST(JudgeScene, CountsFragmentsThatAreOpen) {
  const cases::Case c = scene();
  DamagedBackend backend;
  cases::Contract promised = backend.promise(c);
  promised.bounds.smooth.constant = 0x1p24F;  // a bound that allows any value
  backend.promised = promised;
  const SceneFindings found = judge_scene(c, "damaged", backend, 7, kLaws).value();
  EXPECT_EQ(found.result.judged, 0U);
  EXPECT_EQ(found.result.open, 64U);
}

TEST(JudgeScene, DrawsAMeshWithItsCamera) {
  cases::Mesh roof;
  roof.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 1}, {-1, 1, 1}};
  roof.triangles = {{0, 1, 2}, {0, 2, 3}};
  const cases::Case mesh =
      cases::case_of_mesh(roof, "roof.obj", {16, 16, cases::Rules::vulkan}).value().drawn;
  ASSERT_TRUE(mesh.camera);
  const auto cpu = backends::make_backend("cpu").value();
  const SceneFindings found = judge_scene(mesh, "cpu", *cpu, 7, kLaws).value();
  EXPECT_THAT(found.findings.counterexamples, IsEmpty());
  EXPECT_FALSE(found.source.camera);
  EXPECT_GT(found.drawn.value().size(), 0U);
  EXPECT_THAT(found.map.states, testing::Contains(PixelState::correct));
  EXPECT_THAT(found.map.states, testing::Not(testing::Contains(PixelState::violated)));
}

TEST(JudgeScene, FailsWherePositionsAreBeyondFloat32) {
  cases::Case c = scene();
  c.camera.emplace();
  c.camera->model[0] = 0x1p127F;
  c.camera->view[0] = 4;
  const auto cpu = backends::make_backend("cpu").value();
  const auto found = judge_scene(c, "cpu", *cpu, 7, kLaws);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().place, "/vertices/0/position");
}

}  // namespace
}  // namespace rastercheck::properties::scene_test
