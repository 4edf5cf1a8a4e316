// Which samples of an occludee are certainly visible past occluders, and which certainly hidden.
// Expected verdicts and depths are calculated by hand; random cases hold the levels equal.

#include "oracle/occlusion_truth.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "oracle/referee.h"
#include "tests/oracle/random_case.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::occlusion_truth_test {
namespace {

using cases::SamplePlace;
using records::Verdict;

/// Half an ulp of 1, the bound of depths under a case's own contract.
constexpr float kHalfUlp = 0x1p-24F;

using Corners = std::array<std::array<float, 2>, 3>;
/// The pixels x + y < 3 of a 4×4 target; the diagonal's pixel centres, x + y = 3, lie on its edge,
/// which does not own them.
constexpr Corners kCorner{{{-1, -1}, {1, -1}, {-1, 1}}};
/// All 16 pixels.
constexpr Corners kAll{{{-1, -1}, {3, -1}, {-1, 3}}};

void add(cases::Case& c, const Corners& corners, float depth) {
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (const auto& [x, y] : corners) c.positions.push_back({x, y, depth, 1});
  c.triangles.push_back({first, first + 1, first + 2});
}

/// An empty case of 4×4 pixels, in which row 0 is at the top and y points down.
cases::Case target() {
  cases::Case c;
  c.framebuffer = {4, 4, 1};
  c.viewport = {0, 0, 4, 4, 0, 1};
  return c;
}

/// One occluder over six pixels, and an occludee over all.
cases::Case corner_before_all(float occluder, float occludee) {
  cases::Case c = target();
  add(c, kCorner, occluder);
  add(c, kAll, occludee);
  return c;
}

struct Counts {
  int required = 0;
  int permitted = 0;
  int forbidden = 0;
  bool operator==(const Counts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& counts) {
  return out << counts.required << " required, " << counts.permitted << " permitted, "
             << counts.forbidden << " forbidden";
}

std::map<SamplePlace, Verdict> verdicts(const OcclusionTruth& truth) {
  std::map<SamplePlace, Verdict> all;
  records::LevelCounts levels;
  truth.for_each_sample(
      [&all](const SamplePlace& place, Verdict verdict) {
        EXPECT_TRUE(all.emplace(place, verdict).second);
      },
      levels);
  return all;
}

/// The verdicts of the last triangle's samples, which are also those of judge().
Counts counts(const cases::Case& c, const cases::Contract& contract) {
  const SceneTruth scene(c, contract);
  const OcclusionTruth truth(scene, c.triangles.size() - 1);
  Counts counted;
  for (const auto& [place, verdict] : verdicts(truth)) {
    ++(verdict == Verdict::required    ? counted.required
       : verdict == Verdict::permitted ? counted.permitted
                                       : counted.forbidden);
    EXPECT_EQ(truth.judge(place), verdict);
  }
  return counted;
}

Counts counts(const cases::Case& c) { return counts(c, cases::contract_of(c)); }

/// The case's own contract, under which depths are exact.
cases::Contract exact_depths(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth.constant = 0;
  return contract;
}

TEST(OcclusionTruth, HidesWhatIsBehind) {
  EXPECT_EQ(counts(corner_before_all(0.5F, 0.75F)), (Counts{10, 0, 6}));
  EXPECT_EQ(counts(corner_before_all(0.5F, 0.25F)), (Counts{16, 0, 0}));
  cases::Case alone = target();
  add(alone, kCorner, 0.5F);
  EXPECT_EQ(counts(alone), (Counts{6, 0, 0}));
}

// Kills: an occluder among the occludee's own triangles.
TEST(OcclusionTruth, LetsNoOccludeeHideItself) {
  cases::Case c = corner_before_all(0.5F, 0.75F);
  add(c, kAll, 0.875F);
  const SceneTruth scene(c, cases::contract_of(c));
  const OcclusionTruth truth(scene, 1);
  std::map<std::uint32_t, int> visible;
  for (const auto& [place, verdict] : verdicts(truth)) {
    if (verdict == Verdict::required) ++visible[place.triangle];
  }
  EXPECT_EQ(visible, (std::map<std::uint32_t, int>{{1, 10}, {2, 10}}));
}

// Kills: "less or equal"; a bound that moves only one of the two depths.
TEST(OcclusionTruth, LeavesDepthsOpenThatTheBoundDoesNotTellApart) {
  EXPECT_EQ(counts(corner_before_all(0.5F, 0.5F)), (Counts{10, 6, 0}));
  // Nearer by exactly both bounds, and by the next float more.
  EXPECT_EQ(counts(corner_before_all(0.5F, 0.5F - 2 * kHalfUlp)), (Counts{10, 6, 0}));
  EXPECT_EQ(counts(corner_before_all(0.5F, 0.5F - 2.5F * kHalfUlp)), (Counts{16, 0, 0}));
  // Farther by as much: not nearer under any reading.
  EXPECT_EQ(counts(corner_before_all(0.5F, 0.5F + kHalfUlp)), (Counts{10, 6, 0}));
  EXPECT_EQ(counts(corner_before_all(0.5F, 0.5F + 2 * kHalfUlp)), (Counts{10, 0, 6}));
}

TEST(OcclusionTruth, HidesAnEqualDepthWhereDepthsAreExact) {
  const cases::Case c = corner_before_all(0.5F, 0.5F);
  EXPECT_EQ(counts(c, exact_depths(c)), (Counts{10, 0, 6}));
  const cases::Case nearer = corner_before_all(0.5F, 0.5F - 0.5F * kHalfUlp);
  EXPECT_EQ(counts(nearer, exact_depths(nearer)), (Counts{16, 0, 0}));
}

// Nearer by 2^-20: more than two steps of 2^-24, less than one of 2^-16.
TEST(OcclusionTruth, ComparesAsFinelyAsTheDepthFormat) {
  const cases::Case c = corner_before_all(0.5F, 0.5F - 0x1p-20F);
  cases::Contract contract = cases::contract_of(c);
  for (const cases::DepthFormat format :
       {cases::DepthFormat::float32, cases::DepthFormat::float64, cases::DepthFormat::unorm24}) {
    contract.depth_format = format;
    EXPECT_EQ(counts(c, contract), (Counts{16, 0, 0}));
  }
  contract.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(counts(c, contract), (Counts{10, 6, 0}));
}

TEST(OcclusionTruth, HidesWhatIsNotNearerThanTheClearedDepth) {
  cases::Case c = corner_before_all(0.5F, 0.75F);
  c.depth_clear = 0.625F;
  EXPECT_EQ(counts(c), (Counts{0, 0, 16}));
  c.depth_clear = 0.75F;
  EXPECT_EQ(counts(c), (Counts{0, 10, 6}));
  EXPECT_EQ(counts(c, exact_depths(c)), (Counts{0, 0, 16}));
  c.depth_clear = 1;
  EXPECT_EQ(counts(c), (Counts{10, 0, 6}));
  // A buffer whose first value is not named begins at 1 or beyond.
  c = corner_before_all(0.5F, 1);
  EXPECT_EQ(counts(c, exact_depths(c)), (Counts{0, 10, 6}));
  c.depth_clear = 1;
  EXPECT_EQ(counts(c, exact_depths(c)), (Counts{0, 0, 16}));
}

// The format may round the cleared depth by a step, but not 1.
TEST(OcclusionTruth, RoundsTheClearedDepth) {
  cases::Case c = corner_before_all(0.125F, 0.5F);
  cases::Contract contract = exact_depths(c);
  contract.depth_format = cases::DepthFormat::unorm16;
  c.depth_clear = 0.5F + 0x1.8p-16F;  // one and a half steps farther: the slack is two
  EXPECT_EQ(counts(c, contract), (Counts{0, 10, 6}));
  c.depth_clear = 0.5F + 0x1.2p-15F;  // two and a quarter
  EXPECT_EQ(counts(c, contract), (Counts{10, 0, 6}));
  c = corner_before_all(0.125F, 1 - 0x1.8p-16F);
  c.depth_clear = 1;
  EXPECT_EQ(counts(c, contract), (Counts{10, 0, 6}));
}

// Kills: the farthest depth of a reversed range taken for the greatest.
TEST(OcclusionTruth, ComparesWindowDepths) {
  cases::Case c = corner_before_all(0.5F, 0.75F);
  c.viewport.min_depth = 1;
  c.viewport.max_depth = 0;
  EXPECT_EQ(counts(c), (Counts{16, 0, 0}));
}

TEST(OcclusionTruth, NamesTheDepthsThatDecide) {
  cases::Case c = corner_before_all(0.5F, 0.25F);
  const SceneTruth scene(c, cases::contract_of(c));
  const OcclusionTruth truth(scene, 1);
  const OcclusionDepths behind = truth.depths({1, 0, 0, 0});
  EXPECT_EQ(behind.occludee, Rational(0.25 + 0x1p-24));
  EXPECT_EQ(behind.occluders, Rational(0.5 - 0x1p-24));
  EXPECT_EQ(behind.nearest, 0U);
  const OcclusionDepths beside = truth.depths({1, 3, 3, 0});
  EXPECT_EQ(beside.occludee, Rational(0.25 + 0x1p-24));
  EXPECT_EQ(beside.occluders, Rational(1));
  EXPECT_EQ(beside.nearest, std::nullopt);
}

// Kills: occluders that count although they must not be drawn there, or do not count although they
// may. With its hypotenuse 1/512 pixel beyond the four centres of the diagonal, the occluder covers
// these; on a grid of 1/256 pixel, its vertices may move so that it does not.
TEST(OcclusionTruth, CountsEveryPermittedOccluder) {
  cases::Case c = target();
  constexpr float kBeyond = 1 + 0x1p-10F;  // 1/512 pixel of half a viewport of 2 pixels
  add(c, {{{-1, -1}, {kBeyond, -1}, {-1, kBeyond}}}, 0.5F);
  add(c, kAll, 0.75F);
  EXPECT_EQ(counts(c), (Counts{6, 0, 10}));
  cases::Contract contract = cases::contract_of(c);
  contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  EXPECT_EQ(counts(c, contract), (Counts{6, 4, 6}));
  // As far before the centres, the occluder may still come to lie on them, which its tie rule
  // leaves uncovered; with an open tie rule it may cover them.
  c.positions[1].x = 1 - 0x1p-10F;
  c.positions[2].y = 1 - 0x1p-10F;
  EXPECT_EQ(counts(c, contract), (Counts{10, 0, 6}));
  contract.tie_rule = cases::TieRule::unspecified;
  EXPECT_EQ(counts(c, contract), (Counts{6, 4, 6}));
}

// The occludee's samples on the diagonal are permitted, not required.
TEST(OcclusionTruth, RequiresNothingOfAnOccludeeThatNeedNotCover) {
  cases::Case c = target();
  constexpr float kBeyond = 1 + 0x1p-10F;
  add(c, {{{-1, -1}, {kBeyond, -1}, {-1, kBeyond}}}, 0.5F);
  cases::Contract contract = cases::contract_of(c);
  EXPECT_EQ(counts(c, contract), (Counts{10, 0, 0}));
  contract.coverage = cases::Snapping{8, cases::Rounding::unspecified, 0};
  EXPECT_EQ(counts(c, contract), (Counts{6, 4, 0}));
}

// z/w runs from −1/2 at the left to 1/2 at the right, and is 0 in the middle: the near plane cuts
// two of four columns.
TEST(OcclusionTruth, ShowsWhatIsBehindTheCutPart) {
  cases::Case c = target();
  add(c, kAll, 0);
  c.positions[0].z = -0.5F;
  c.positions[1].z = 1.5F;
  c.positions[2].z = -0.5F;
  add(c, kAll, 0.75F);
  EXPECT_EQ(counts(c), (Counts{8, 0, 8}));
  c.depth_clamp = true;
  EXPECT_EQ(counts(c), (Counts{0, 0, 16}));
}

TEST(OcclusionTruth, RequiresNothingBehindAnOccluderWithoutAPromise) {
  cases::Case c = corner_before_all(0.5F, 0.75F);
  cases::Contract contract = cases::contract_of(c);
  contract.numbers.greatest = 3;
  EXPECT_EQ(counts(c, contract), (Counts{10, 0, 6}));
  add(c, {{{-1, -1}, {-4, -1}, {-1, -4}}}, 0.5F);  // outside of the viewport
  std::swap(c.triangles[1], c.triangles[2]);
  EXPECT_EQ(counts(c, contract), (Counts{0, 10, 6}));
  EXPECT_TRUE(OcclusionTruth(SceneTruth(c, contract), 2).has_unpromised_occluder());
  std::swap(c.triangles[1], c.triangles[2]);
  EXPECT_EQ(counts(c, contract), (Counts{0, 0, 0}));  // nothing is promised about the occludee
}

TEST(OcclusionTruth, LeavesAllOpenWhereAnyDepthIsRight) {
  const cases::Case c = corner_before_all(0.5F, 0.25F);
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.depth.constant = 0x1p24F;
  EXPECT_EQ(counts(c, contract), (Counts{0, 16, 0}));
}

/// Some triangles before and behind each other, exact or snapped, of vertices anywhere.
cases::Case random_scene() {
  cases::Case c = random_exact_case();
  c.attributes.clear();
  c.attribute_values.clear();
  c.clip_distance_count = 0;
  c.clip_distances.clear();
  cover_most(c);
  const int more = *rc::gen::inRange(1, 4);
  for (int i = 0; i < more; ++i) {
    const auto first = static_cast<std::uint32_t>(c.positions.size());
    for (std::uint32_t k = 0; k < 3; ++k) {
      const bool is_like = *rc::gen::inRange(0, 3) == 0;
      const cases::ClipVertex like = c.positions[k];
      c.positions.push_back(is_like ? like : random_vertex());
    }
    c.triangles.push_back({first, first + 1, first + 2});
  }
  if (*rc::gen::inRange(0, 3) == 0) c.depth_clear = one_of({0.0F, 0.5F, 1.0F});
  return c;
}

cases::Contract random_contract(const cases::Case& c) {
  cases::Contract contract = cases::contract_of(c);
  if (*rc::gen::inRange(0, 2) == 0) {
    contract.coverage = cases::Snapping{
        4, one_of({cases::Rounding::nearest_even, cases::Rounding::unspecified}), 0};
    contract.basis =
        one_of({cases::Basis::ideal, cases::Basis::snapped, cases::Basis::unspecified});
  }
  contract.depth_format = one_of({cases::DepthFormat::float32, cases::DepthFormat::unorm16});
  contract.bounds.depth.constant = one_of({0.0F, 0.5F, 64.0F});
  return contract;
}

// Kills: bounds of doubles that are too narrow; samples that are left out.
RC_GTEST_PROP(OcclusionTruth, LevelsGiveTheVerdictsOfEachSample, ()) {
  const cases::Case c = random_scene();
  const cases::Contract contract = random_contract(c);
  const SceneTruth scene(c, contract);
  const std::size_t occluders = c.triangles.size() - 1;
  const std::map<SamplePlace, Verdict> all = verdicts(OcclusionTruth(scene, occluders));
  RC_ASSERT(verdicts(OcclusionTruth(scene, occluders, Level::exact)) == all);
  const OcclusionTruth truth(scene, occluders);
  const auto& [width, height, samples] = c.framebuffer;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int s = 0; s < samples; ++s) {
        const SamplePlace place{static_cast<std::uint32_t>(occluders),
                                static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                                static_cast<std::uint32_t>(s)};
        const auto found = all.find(place);
        RC_ASSERT(truth.judge(place) == (found == all.end() ? Verdict::forbidden : found->second));
      }
    }
  }
  for (const auto& [place, verdict] : all) {
    if (verdict != Verdict::required) continue;
    const OcclusionDepths depths = truth.depths(place);
    RC_ASSERT(depths.occludee < depths.occluders);
  }
}

/// True if the second oracle finds the triangle's fragment nearer than the cleared depth and all
/// fragments of triangles before it.
bool is_seen_by_referee(const cases::Case& c, const RefereeFragment& own, const SamplePlace& at) {
  if (!(own.depth < Rational(double{c.depth_clear.value_or(1)}))) return false;
  for (std::size_t t = 0; t < at.triangle; ++t) {
    const auto other =
        referee(c, t, static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.sample));
    if (other && !(own.depth < other->depth)) return false;
  }
  return true;
}

// Exact depths and coverage leave nothing open, except samples on the viewport's far border and
// depths of 1 before a buffer that may begin there.
RC_GTEST_PROP(OcclusionTruth, IsTheRefereesWhereNothingIsOpen, ()) {
  const cases::Case c = random_scene();
  const SceneTruth scene(c, exact_depths(c));
  const std::size_t occluders = c.triangles.size() - 1;
  const TriangleTruth occludee(scene, occluders);
  for (const auto& [place, verdict] : verdicts(OcclusionTruth(scene, occluders))) {
    const auto x = static_cast<int>(place.x);
    const auto y = static_cast<int>(place.y);
    const auto s = static_cast<int>(place.sample);
    if (occludee.judge(x, y, s).verdict == Verdict::permitted) continue;
    const auto own = referee(c, occluders, x, y, s);
    RC_ASSERT(own.has_value());
    const bool is_seen = is_seen_by_referee(c, *own, place);
    RC_ASSERT((verdict == Verdict::required) == is_seen);
    const bool is_farthest = !c.depth_clear && own->depth == Rational(1);
    RC_ASSERT(is_seen || is_farthest || verdict == Verdict::forbidden);
  }
}

}  // namespace
}  // namespace rastercheck::oracle::occlusion_truth_test
