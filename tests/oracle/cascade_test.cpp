// Compares the levels of the judge's cascade with each other on random drawings, and checks that
// each level decides something.

#include "tests/oracle/cascade.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/oracle/drawing.h"
#include "tests/oracle/random_case.h"
#include "tests/simd_targets.h"

namespace rastercheck::oracle::cascade_test {
namespace {

/// Adds up to two triangles that share vertices with earlier ones.
void add_triangles(cases::Case& c) {
  const int more = *rc::gen::inRange(0, 3);
  for (int i = 0; i < more; ++i) {
    const auto vertex = static_cast<std::uint32_t>(c.positions.size());
    c.positions.push_back(random_vertex());
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      c.attribute_values.push_back(random_float(4));
    }
    for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
      c.clip_distances.push_back(grid_float(1));
    }
    c.triangles.push_back({vertex - 2, vertex, vertex - 1});
  }
}

void randomise_state(cases::Case& c) {
  if (*rc::gen::inRange(0, 4) == 0) c.scissor = cases::Scissor{1, 2, 4, 3};
  c.viewport.min_depth = one_of({0.0F, 0.0F, 0.25F, 1.0F, 0.3F});
  c.viewport.max_depth = one_of({1.0F, 1.0F, 0.75F, 0.25F});
  if (c.rules == cases::Rules::d3d && c.viewport.min_depth > c.viewport.max_depth) {
    std::swap(c.viewport.min_depth, c.viewport.max_depth);
  }
  for (cases::Attribute& attribute : c.attributes) {
    attribute.location = one_of({cases::Location::sample, cases::Location::sample,
                                 cases::Location::center, cases::Location::centroid});
  }
  if (*rc::gen::inRange(0, 4) == 0) c.depth_test = cases::DepthTest::less;
  if (*rc::gen::inRange(0, 2) == 0) return;
  c.coverage = cases::Snapping{one_of({0, 4, 8}),
                               one_of({cases::Rounding::nearest_even, cases::Rounding::nearest_even,
                                       cases::Rounding::half_up, cases::Rounding::unspecified}),
                               one_of({0.0F, 0.0F, 0.125F})};
  c.basis = one_of({cases::Basis::ideal, cases::Basis::snapped, cases::Basis::unspecified});
}

cases::Contract random_contract(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  if (*rc::gen::inRange(0, 4) == 0) contract.tie_rule = cases::TieRule::unspecified;
  contract.bounds.smooth = one_of<cases::ValueBound>({{0.5F, 0}, {2, 0}, {0.5F, 0.25F}});
  contract.bounds.noperspective.constant = one_of({0.5F, 0.0F, 3.0F});
  contract.bounds.depth.constant = one_of({0.5F, 1.0F, 1e30F});
  return contract;
}

struct RandomScene {
  SceneTruth scene;
  std::uint64_t seed;  ///< of the drawings
};

RandomScene random_scene() {
  cases::Case c = random_exact_case();
  if (*rc::gen::arbitrary<bool>()) cover_most(c);
  add_triangles(c);
  randomise_state(c);
  const cases::Contract contract = random_contract(c);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  return {SceneTruth(std::move(c), contract), seed};
}

// Kills: a bound of the filter that is too small; a level that answers a question with less
// information than the answer needs.
RC_GTEST_PROP(Cascade, LevelsAgreeOnFaultlessDrawings, ()) {
  const RandomScene random = random_scene();
  const std::string difference = disagreement(random.scene, perfect(random.scene));
  RC_ASSERT(difference == "");
}

RC_GTEST_PROP(Cascade, LevelsAgreeOnSpoiledDrawings, ()) {
  const RandomScene random = random_scene();
  Dice dice(random.seed);
  const cases::Fragments drawn = perfect(random.scene);
  RC_CLASSIFY(drawn.size() > 0, "covers something");
  const std::string difference = disagreement(random.scene, spoiled(random.scene, drawn, dice));
  RC_ASSERT(difference == "");
}

// Arbitrary values of every size, also at samples that the case does not cover.
RC_GTEST_PROP(Cascade, LevelsAgreeOnDrawingsOfEverything, ()) {
  const RandomScene random = random_scene();
  Dice dice(random.seed);
  const cases::Fragments drawn = spoiled(random.scene, everything(random.scene), dice);
  const std::string difference = disagreement(random.scene, drawn);
  RC_ASSERT(difference == "");
}

// The products of a camera's matrices leave the range of doubles.
RC_GTEST_PROP(Cascade, LevelsAgreeThroughCameras, ()) {
  cases::Case c = random_exact_case();
  c.camera.emplace();
  for (cases::Matrix4* matrix : {&c.camera->model, &c.camera->view, &c.camera->projection}) {
    for (float& element : *matrix) element = random_float(1);
  }
  const SceneTruth scene(c, cases::contract_of(c));
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  const std::string difference = disagreement(scene, spoiled(scene, perfect(scene), dice));
  RC_ASSERT(difference == "");
}

// Kills: a triangle that is wrongly culled, or a band that is too narrow, in some reading of the
// contract.
RC_GTEST_PROP(Cascade, VerdictsAreThoseOfTheTriangleAndTheReferee, ()) {
  const RandomScene random = random_scene();
  cases::Case c = random.scene.source();
  c.depth_test = cases::DepthTest::none;
  const SceneTruth scene(c, random.scene.contract());
  const std::string wrong = wrong_verdict(scene);
  RC_ASSERT(wrong == "");
}

/// Two big triangles in perspective, with no number on a grid.
cases::Case ordinary_case(int size) {
  cases::Case c = small_case(cases::Rules::vulkan, size, size,
                             {{{-0.937F, -0.913F, 0.137F, 1.0F},
                               {1.871F, -1.713F, 0.931F, 2.0F},
                               {-1.219F, 1.331F, 0.773F, 1.5F}}},
                             {{{0.11F, 7.3F}, {1.7F, -2.9F}, {-0.23F, 0.37F}}});
  c.positions.push_back({1.37F, 1.4307F, 0.39F, 1.613F});
  c.attribute_values.insert(c.attribute_values.end(), {3.3F, 1.9F});
  c.triangles.push_back({2, 1, 3});
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  return c;
}

double share(std::uint64_t part, const records::LevelCounts& of) {
  return static_cast<double>(part) / static_cast<double>(of.filter + of.interval + of.exact);
}

TEST(CascadeLevels, AnOrdinarySceneIsDecidedByTheFilter) {
  const cases::Case c = ordinary_case(96);
  const SceneTruth scene(c, cases::contract_of(c));
  const cases::Fragments drawn = perfect(scene);
  ASSERT_GT(drawn.size(), 5'000U);
  const records::Levels levels = judge(scene, drawn).judgement.levels;
  EXPECT_GT(share(levels.samples.filter, levels.samples), 0.99);
  // Values that may be extremes go on to the next level; most of them come early.
  EXPECT_GT(share(levels.values.filter, levels.values), 0.97);
  EXPECT_EQ(levels.samples.exact, 0U);
}

// By hand: the diagonal's 16 samples are ties for both triangles of the square; all other numbers
// have few bits. Every error of a value is exactly 0 or 1/2; the first value with the extreme error
// goes on to the next level.
TEST(CascadeLevels, TiesOnGridsAreDecidedByIntervalsAndMidpointsByTheFilter) {
  cases::Case c = small_case(cases::Rules::vulkan, 16, 16,
                             {{{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}}},
                             {{{1}, {1 + 0x1p-19F}, {1}}});
  c.positions.push_back({1, 1, 0.5F, 1});
  c.attribute_values.push_back(1 + 0x1p-19F);
  c.triangles.push_back({1, 3, 2});
  const SceneTruth scene(c, cases::contract_of(c));
  const records::Judgement judgement = judge(scene, perfect(scene)).judgement;
  EXPECT_EQ(judgement.levels.samples, (records::LevelCounts{2 * 256 - 2 * 16, 2 * 16, 0}));
  EXPECT_EQ(judgement.levels.values.exact, 0U);
  EXPECT_GT(share(judgement.levels.values.filter, judgement.levels.values), 0.7);
  const records::ErrorSizes& errors = judgement.errors.at(records::AttributeKind::smooth).excess;
  EXPECT_EQ(errors.histogram.count_in(records::Histogram::bucket_of(0.5)), 256U);
  EXPECT_EQ(errors.extremes.most_positive->error, (records::Enclosure{0.5, 0.5}));
}

// The edge's coefficients have 71 bits, and deciding the tie needs all of them.
TEST(CascadeLevels, SomeTiesTakeExactNumbers) {
  const float a = 1 + 0x1p-23F;
  cases::Case c = small_case(
      cases::Rules::vulkan, 2, 2,
      {{{a * 0x1p-40F, a * 0x1p-41F, 0, 1}, {-2 * a, -a, 0, 1}, {a, -a * 0x1p-9F, 0, 1}}});
  c.viewport.x = 0.5F;
  c.viewport.y = 0.5F;
  const SceneTruth scene(c, cases::contract_of(c));
  ASSERT_EQ(TriangleTruth(scene, 0).judge(1, 1, 0).reason, records::Reason::tie);
  const records::Levels levels = judge(scene, perfect(scene)).judgement.levels;
  EXPECT_GE(levels.samples.exact, 1U);
}

// Every level's answers are the same to the bit, whichever vector instructions the filter uses.
TEST(CascadeTargets, GiveTheSameBits) {
  const cases::Case c = ordinary_case(24);
  const SceneTruth scene(c, cases::contract_of(c));
  Dice dice(1);
  const cases::Fragments drawn = spoiled(scene, perfect(scene), dice);
  const Outcome best = outcome_of(scene, drawn, {});
  for (const std::int64_t target : all_targets()) {
    const OnTarget on_target(target);
    EXPECT_EQ(difference_in_bits(best, outcome_of(scene, drawn, {})), "")
        << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace rastercheck::oracle::cascade_test
