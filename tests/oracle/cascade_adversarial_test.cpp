// The cascade where its levels are most likely to disagree: ties and samples beside them, errors at
// and beside their bound, numbers at the ends of their ranges. Expected results are calculated by
// hand or in rationals.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "cases/sample_pattern.h"
#include "oracle/internal/rational_number.h"
#include "tests/oracle/cascade.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::cascade_adversarial_test {
namespace {

using records::AttributeKind;
using records::Enclosure;
using records::FragmentClass;
using records::Histogram;
using records::Reason;
using records::Verdict;

/// A case whose clip-space origin lies (du, dv) away from a sample of pixel (1, 1), so that edges
/// through the origin pass the sample as closely as float32 can express.
cases::Case around_sample(cases::Rules rules, int samples, std::size_t sample, float du, float dv,
                          const std::array<cases::ClipVertex, 3>& positions,
                          const std::array<std::vector<float>, 3>& values = {}) {
  cases::Case c = small_case(rules, 4, 4, positions, values);
  const cases::SamplePosition& at = cases::standard_pattern(samples)[sample];
  c.framebuffer.samples = samples;
  c.viewport.x = du;
  c.viewport.y = dv;
  c.viewport.width = 2 + static_cast<float>(at.x) / 8;
  c.viewport.height = 2 + static_cast<float>(at.y) / 8;
  return c;
}

/// A number with a random exponent between 2^-149 and `most`, or 0.
float random_offset(float most) {
  if (*rc::gen::inRange(0, 3) == 0) return 0;
  const int exponent = *rc::gen::inRange(-149, 1);
  const float size = std::max(0x1p-149F, most * std::ldexp(1.0F, exponent));
  return *rc::gen::arbitrary<bool>() ? size : -size;
}

// ---- coverage

/// The verdict of a judgement that starts at this level, for one sample, which is drawn.
Verdict verdict_at(const SceneTruth& scene, Level level, int x, int y, int sample) {
  cases::Fragments drawn;
  push(drawn, 0, x, y, sample, 0, std::vector<float>(scene.source().attributes.size()));
  Verdict verdict = Verdict::forbidden;
  judge(scene, drawn, from(level), [&](const JudgedSample& s, const TriangleTruth*) {
    if (s.fragment_class == FragmentClass::correct) verdict = s.decision.verdict;
  });
  return verdict;
}

// By hand. Every edge below runs through the origin, which lies on the sample, or 2^-60 or 2^-149
// pixels to either side of it. In Vulkan's window y runs downwards, and ties belong to left and top
// edges: the triangle lies to the right of its left edges and below its top edges.
TEST(CascadeNearEdges, ASampleBesideAnEdgeIsOnItsSide) {
  struct Edge {
    std::array<cases::ClipVertex, 3> triangle;
    float du;  ///< moves the triangle so that the sample lies inside
    float dv;
    bool owns_ties;
  };
  const float s = 0x1p-30F;
  const std::array<Edge, 6> edges{{
      {{{{0, -1, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}}, -1, 0, true},        // left
      {{{{0, -1, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}}}, 1, 0, false},       // right
      {{{{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}}}, 0, -1, true},        // top
      {{{{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, -1, 0, 1}}}, 0, 1, false},       // bottom
      {{{{-1, -1, 0, 1}, {1, 1, 0, 1}, {1, -1, 0, 1}}}, -1, 1, true},      // left, falling
      {{{{-s, -s, 0, s}, {9, 9, 0, 9}, {s, -3 * s, 0, s}}}, -1, 1, true},  // the same edge, other w
  }};
  for (const int samples : {1, 4, 16}) {
    const int last = samples - 1;
    for (const Edge& edge : edges) {
      for (const float side : {-0x1p-60F, 0.0F, 0x1p-60F, 0x1p-149F, -0x1p-149F}) {
        cases::Case c = around_sample(cases::Rules::vulkan, samples, static_cast<std::size_t>(last),
                                      edge.du * side, edge.dv * side, edge.triangle);
        c.depth_clamp = true;
        const SceneTruth scene(c, cases::contract_of(c));
        const bool is_inside = side > 0 || (side == 0 && edge.owns_ties);
        for (const Level level : kLevels) {
          EXPECT_EQ(verdict_at(scene, level, 1, 1, last),
                    is_inside ? Verdict::required : Verdict::forbidden)
              << side << " of edge " << &edge - edges.data() << ", " << samples << " samples";
        }
      }
    }
  }
}

/// A vertex on the grid of samples, at any w that keeps its coordinates exact.
cases::ClipVertex grid_vertex() {
  const float x = grid_float(2);
  const float y = grid_float(2);
  const auto w = one_of({1.0F, 1.0F, 1.0F, 0.25F, 4.0F, 0x1p-100F, 0x1p60F, -1.0F});
  return {x * w, y * w, 0, w};
}

// Kills: ties at edges or clip distances that are not recognised, or are given to the wrong side.
RC_GTEST_PROP(CascadeNearEdges, VerdictsAtAndBesideTiesAreTheReferees, ()) {
  const auto rules = one_of({cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d});
  const auto samples = one_of({1, 4, 16});
  const auto sample = static_cast<std::size_t>(*rc::gen::inRange(0, samples));
  const float du = random_offset(1);
  const float dv = random_offset(1);
  const cases::ClipVertex a = grid_vertex();
  cases::ClipVertex b = grid_vertex();
  const cases::ClipVertex c = grid_vertex();
  // In half of the cases the edge from a runs through the origin.
  if (*rc::gen::arbitrary<bool>()) b = {-a.x, -a.y, 0, std::abs(a.w)};
  cases::Case tried = around_sample(rules, samples, sample, du, dv, {a, b, c});
  tried.depth_clamp = true;
  tried.fill_rule = one_of({cases::TieRule::top_left, cases::TieRule::bottom_left});
  if (*rc::gen::arbitrary<bool>()) {
    // The distance is zero at the origin, except for the offset.
    tried.clip_distance_count = 1;
    const float slope = grid_float(1);
    for (const auto& p : tried.positions) tried.clip_distances.push_back(p.x + slope * p.y);
  }
  const SceneTruth scene(tried, cases::contract_of(tried));
  RC_CLASSIFY(TriangleTruth(scene, 0).judge(1, 1, static_cast<int>(sample)).reason == Reason::tie,
              "a tie at the origin");
  const std::string wrong = wrong_verdict(scene);
  RC_ASSERT(wrong == "");
}

/// An ordinary triangle with values of all kinds.
cases::Case all_kinds() {
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 8,
                 {{{-0.875F, -0.75F, 0, 1}, {2, 0.25F, 0, 2}, {-0.5F, 0.875F, 0.25F, 1}}},
                 {{{1, 1, 1}, {2, 2, 2}, {4, 4, 4}}});
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  c.attributes[2].interpolation = cases::Interpolation::flat;
  return c;
}

/// The case of all_kinds() with clip positions 2^exponent times as large; a camera scales them if
/// float32 cannot hold them.
cases::Case scaled(int exponent) {
  cases::Case c = all_kinds();
  int rest = exponent;
  const auto take = [&rest](int least, int most) {
    const int part = std::clamp(rest, least, most);
    rest -= part;
    return std::ldexp(1.0F, part);
  };
  const float factor = take(-146, 126);
  for (cases::ClipVertex& p : c.positions) {
    for (float* coordinate : {&p.x, &p.y, &p.z, &p.w}) *coordinate *= factor;
  }
  if (rest == 0) return c;
  c.camera.emplace();
  for (cases::Matrix4* matrix : {&c.camera->model, &c.camera->view, &c.camera->projection}) {
    const float part = take(-149, 127);
    for (std::size_t i = 0; i < 4; ++i) (*matrix)[5 * i] = part;
  }
  return c;
}

// An edge function has degree two in the positions: its coefficients leave the filter's range at
// 2^±600, and the range of doubles below 2^-1074 and above 2^1024. The factor does not change
// window positions.
TEST(CascadeScale, AFactorOfAllPositionsChangesNothing) {
  const cases::Case unscaled = all_kinds();
  const SceneTruth scene(unscaled, cases::contract_of(unscaled));
  const cases::Fragments drawn = perfect(scene);
  ASSERT_GT(drawn.size(), 20U);
  const Outcome expected = outcome_of(scene, drawn, from(Level::exact));
  for (const int exponent : {-593, -570, -560, -550, -545, -540, -535, -530, -520, -510, -303,
                             -302, -301, -300, -299, -298, -146, -130, -75,  75,   126,  295,
                             296,  297,  298,  299,  300,  301,  381,  500,  505,  507}) {
    const cases::Case c = scaled(exponent);
    const SceneTruth other(c, cases::contract_of(c));
    for (const Level level : kLevels) {
      EXPECT_EQ(difference(expected, outcome_of(other, drawn, from(level))), "") << exponent;
    }
    EXPECT_EQ(wrong_verdict(other), "") << exponent;
  }
}

// If the grid is coarser than the triangle is wide, some placements of the triangle reverse its
// orientation, and a culled triangle may be drawn.
TEST(CascadeSnapping, ATriangleThatIsCulledMayBePlacedTheOtherWay) {
  for (const float width : {0x1p-6F, 0.125F, 0.25F, 0.5F, 0.75F, 1.0F, 1.5F}) {
    for (const cases::Basis basis : {cases::Basis::snapped, cases::Basis::unspecified}) {
      for (const cases::Cull cull : {cases::Cull::back, cases::Cull::front}) {
        cases::Case c =
            small_case(cases::Rules::vulkan, 4, 4,
                       {{{-0.75F, -0.75F, 0, 1}, {0.75F, 0.75F, 0, 1}, {width, -width, 0, 1}}});
        c.coverage = cases::Snapping{0, cases::Rounding::unspecified, 0};
        c.basis = basis;
        c.cull = cull;
        const SceneTruth scene(c, cases::contract_of(c));
        EXPECT_EQ(wrong_verdict(scene), "") << width;
        const bool may_be_drawn = verdict_at(scene, Level::filter, 1, 1, 0) == Verdict::permitted;
        EXPECT_TRUE(may_be_drawn || width > 0x1p-6F);
      }
    }
  }
}

// Vertices at (1.5, 1.5), (4.7, 1.5) and (1.5, 4.7) may be placed on (3, 3), (4, 0) and (0, 4),
// which reverses the orientation, although no vertex can be moved as far as the opposite edge is
// away.
TEST(CascadeSnapping, SoMayOneThatIsAsHighAsItIsWide) {
  for (const cases::Cull cull : {cases::Cull::back, cases::Cull::front}) {
    cases::Case c =
        small_case(cases::Rules::vulkan, 4, 4,
                   {{{-0.25F, -0.25F, 0, 1}, {1.35F, -0.25F, 0, 1}, {-0.25F, 1.35F, 0, 1}}});
    c.coverage = cases::Snapping{0, cases::Rounding::nearest_even, 1};
    c.basis = cases::Basis::snapped;
    c.cull = cull;
    const SceneTruth scene(c, cases::contract_of(c));
    EXPECT_EQ(wrong_verdict(scene), "");
    EXPECT_EQ(verdict_at(scene, Level::filter, 2, 2, 0), Verdict::permitted);
  }
}

// ---- values

// Triangle 0 may be placed in several ways, so that its values lie within the permitted range
// although they are far from those of the exact triangle. Triangle 1, on the grid, has one
// placement. The worst excess is triangle 1's, however large triangle 0's ideal errors are.
TEST(CascadeExtremes, AnExcessIsKeptBesideLargerIdealErrors) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 4, 4,
                 {{{-1 + 0x1p-10F, -1 + 0x1p-10F, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}}},
                 {{{0}, {1}, {0.3F}}});
  c.positions.insert(c.positions.end(), {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}});
  c.attribute_values.insert(c.attribute_values.end(), {0.1F, 0.7F, 0.3F});
  c.triangles.push_back({3, 4, 5});
  c.coverage = cases::Snapping{8, cases::Rounding::nearest_even, 0.125F};
  c.basis = cases::Basis::snapped;
  const SceneTruth scene(c, cases::contract_of(c));
  cases::Fragments drawn = perfect(scene);
  // These are the least permitted values; so triangle 0's values, moved upwards, stay permitted.
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn.triangle[i] == 0) drawn.attributes[i] = moved(drawn.attributes[i], 8);
  }
  EXPECT_EQ(disagreement(scene, drawn), "");
  const records::ErrorStatistics errors =
      judge(scene, drawn).judgement.errors.at(records::AttributeKind::smooth);
  ASSERT_TRUE(errors.excess.extremes.most_negative);
  EXPECT_EQ(errors.excess.extremes.most_negative->place.triangle, 1U);
  EXPECT_LT(errors.ideal.extremes.most_negative->error.hi,
            10 * errors.excess.extremes.most_negative->error.lo);
}

/// The statistics of an attribute kind by definition: the errors of each covered fragment in
/// rationals.
struct Tally {
  std::uint64_t correct = 0;
  std::uint64_t beyond = 0;
  Histogram histogram;
  Enclosure most;  ///< enclosures of the largest errors of either sign,
  Enclosure least;
  std::size_t most_at = 0;  ///< and the first fragments that have these errors
  std::size_t least_at = 0;
};

/// True if a zero is drawn and all vertices have the zero of the other sign.
bool is_other_zero(const cases::Case& c, std::uint32_t triangle, std::size_t attribute,
                   float actual) {
  const cases::Triangle& vertices = c.triangles[triangle];
  return actual == 0 && std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t vertex) {
           const float value = c.attributes_of(vertex)[attribute];
           return value == 0 && std::signbit(value) != std::signbit(actual);
         });
}

/// Tallies a drawing under an exact contract. The drawing has finite values, is ordered by place,
/// and has each place once.
std::map<AttributeKind, Tally> tally_of(const SceneTruth& scene, const cases::Fragments& drawn) {
  std::map<AttributeKind, Tally> tallies;
  const cases::Case& c = scene.source();
  std::optional<std::size_t> prepared;
  std::optional<TriangleTruth> truth;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (prepared != drawn.triangle[i]) {
      prepared = drawn.triangle[i];
      truth.emplace(scene, *prepared);
    }
    const int x = drawn.x[i];
    const int y = drawn.y[i];
    const int sample = drawn.sample[i];
    if (truth->judge(x, y, sample).verdict == Verdict::forbidden) continue;
    const auto add = [&](AttributeKind kind, const std::optional<ValueRange>& value, float actual,
                         const Field& magnitude_of_vertices, float bound, bool is_wrong_zero) {
      if (!value) return;
      const Field exact = to_field(value->lo);
      const Field size = std::max(magnitude(exact), magnitude_of_vertices);
      const long exponent = sign_of(size) == 0 ? -126 : std::max(floor_log2(size), -126L);
      const Field error = (exact_field(actual) - exact) * power_of_two(23 - exponent);
      Tally& tally = tallies[kind];
      if (!is_wrong_zero) {
        ++(magnitude(error) <= exact_field(bound) ? tally.correct : tally.beyond);
      }
      const Enclosure around = enclose(error);
      tally.histogram.add(records::magnitude_bound(around));
      if (std::pair(around.hi, around.lo) > std::pair(tally.most.hi, tally.most.lo)) {
        tally.most = around;
        tally.most_at = i;
      }
      if (std::pair(around.lo, around.hi) < std::pair(tally.least.lo, tally.least.hi)) {
        tally.least = around;
        tally.least_at = i;
      }
    };
    const float far = std::max(c.viewport.min_depth, c.viewport.max_depth);
    add(AttributeKind::depth, truth->depth(x, y, sample), drawn.depth[i], exact_field(far),
        scene.contract().bounds.depth.constant, false);
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      if (truth->is_value_free(a)) continue;
      Field largest = 0;
      for (const std::uint32_t vertex : c.triangles[drawn.triangle[i]]) {
        largest = std::max(largest, magnitude(exact_field(c.attributes_of(vertex)[a])));
      }
      const AttributeKind kind = records::kind_of(c.attributes[a].interpolation);
      const float bound = kind == AttributeKind::smooth ? scene.contract().bounds.smooth.constant
                          : kind == AttributeKind::noperspective
                              ? scene.contract().bounds.noperspective.constant
                              : 0.0F;
      const float actual = drawn.attributes_of(i)[a];
      add(kind, truth->attribute(a, x, y, sample), actual, largest, bound,
          is_other_zero(c, drawn.triangle[i], a, actual));
    }
  }
  return tallies;
}

/// True if `extreme` reports this error at the place of fragment i.
bool is_extreme(const std::optional<records::WorstError>& extreme, const Enclosure& error,
                const cases::Fragments& drawn, std::size_t i) {
  if (!extreme) return error == Enclosure{0, 0};
  return extreme->error == error && extreme->place.triangle == drawn.triangle[i] &&
         extreme->place.y == drawn.y[i] && extreme->place.x == drawn.x[i] &&
         extreme->place.sample == drawn.sample[i];
}

/// Returns where a judgement differs from the definition; empty if nowhere.
std::string wrong_statistics(const SceneTruth& scene, const cases::Fragments& drawn) {
  const std::map<AttributeKind, Tally> tallies = tally_of(scene, drawn);
  for (const Level level : kLevels) {
    const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
    for (const auto& [kind, tally] : tallies) {
      const std::string where =
          std::to_string(static_cast<int>(level)) + " " + std::string(to_string(kind)) + ": ";
      const records::ErrorStatistics& errors = judgement.errors.at(kind);
      if (errors.classes[FragmentClass::correct] != tally.correct) return where + "correct";
      if (errors.classes[FragmentClass::beyond_bound] != tally.beyond) return where + "beyond";
      for (const auto* sizes : {&errors.excess, &errors.ideal}) {
        if (!(sizes->histogram == tally.histogram)) return where + "histogram";
        const records::Extremes& extremes = sizes->extremes;
        if (!is_extreme(extremes.most_positive, tally.most, drawn, tally.most_at)) {
          return where + "most positive";
        }
        if (!is_extreme(extremes.most_negative, tally.least, drawn, tally.least_at)) {
          return where + "most negative";
        }
      }
    }
  }
  return {};
}

/// A small number, a tiny one, an arbitrary one, or one that other values are likely to equal.
float hard_float() {
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return any_float();
    case 1:
      return std::ldexp(grid_float(1), one_of({-149, -143, -126, -60, 40}));
    default:
      return one_of({0.0F, -0.0F, 1.0F, 1.0F, 1 + 0x1p-23F, -1.0F, 0x1p-149F, 0x1p-126F, 3e38F});
  }
}

// Kills: any fault that makes a value's enclosure too narrow, counts the value in a wrong bucket or
// class, or loses an extreme.
RC_GTEST_PROP(CascadeValues, StatisticsAreThoseOfTheDefinition, ()) {
  cases::Case c = random_exact_case();
  if (*rc::gen::inRange(0, 4) > 0) {
    cover_most(c);
    c.viewport.x = random_offset(1);
    c.viewport.y = random_offset(1);
    c.viewport.height = 5;
  }
  for (float& value : c.attribute_values) value = hard_float();
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth.constant = one_of({0.5F, 0.0F, 1.0F, 0x1p30F});
  const SceneTruth scene(c, contract);
  cases::Fragments drawn = perfect(scene);
  RC_CLASSIFY(drawn.size() > 10, "covers much");
  Dice dice(*rc::gen::arbitrary<std::uint64_t>());
  for (auto* values : {&drawn.depth, &drawn.attributes}) {
    for (float& value : *values) {
      if (!std::isfinite(value)) value = 0;
      const float other = moved(value, dice.pick({0, 0, 0, -1, 1, 1, 5}));
      if (std::isfinite(other)) value = other;
    }
  }
  const std::string wrong = wrong_statistics(scene, drawn);
  RC_ASSERT(wrong == "");
}

/// A triangle over the whole target, with values from 1 at the viewport's left side to 1 + 2^-23 at
/// its right side: the value at the sample is 1 + 2^-24 (1 − du/1.5), its ulp 2^-23.
cases::Case half_way(float du) {
  return around_sample(cases::Rules::vulkan, 1, 0, du, 0,
                       {{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 3, 0, 1}}},
                       {{{1}, {1 + 0x1p-23F}, {1}}});
}

// By hand: the errors of the two neighbouring floats are 1/2 + du/3 and −1/2 + du/3 ULP; the bound
// is 1/2.
TEST(CascadeValues, AnErrorAtTheBoundIsWithinItAndOneBesideIsNot) {
  for (const float du :
       {0.0F, 3 * 0x1p-40F, -3 * 0x1p-40F, 3 * 0x1p-60F, -3 * 0x1p-60F, 0x1p-149F, -0x1p-149F}) {
    const SceneTruth scene(half_way(du), cases::contract_of(half_way(du)));
    for (const float actual : {1.0F, 1 + 0x1p-23F}) {
      cases::Fragments drawn;
      push(drawn, 0, 1, 1, 0, 0, {actual});
      const Field error = (actual > 1 ? Field(1, 2) : Field(-1, 2)) + exact_field(du) / Field(3);
      const bool is_within = magnitude(error) <= Field(1, 2);
      for (const Level level : kLevels) {
        const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
        const records::ErrorStatistics& errors = judgement.errors.at(AttributeKind::smooth);
        EXPECT_EQ(errors.classes[FragmentClass::correct], is_within ? 1U : 0U) << du;
        EXPECT_EQ(errors.classes[FragmentClass::beyond_bound], is_within ? 0U : 1U) << du;
        const std::size_t half = Histogram::bucket_of(0.5);
        EXPECT_EQ(errors.excess.histogram.count_in(is_within ? half : half + 1), 1U) << du;
        const records::Extremes& extremes = errors.excess.extremes;
        EXPECT_EQ((actual > 1 ? extremes.most_positive : extremes.most_negative)->error,
                  enclose(error));
      }
    }
  }
}

// Except for the offset, 1/w vanishes at the sample, because w is 1/x. The triangle lies where w is
// positive and covers the second of four samples, whose values are taken at the pixel centre.
// Beyond the horizon even an affine value is undefined.
TEST(CascadeValues, AreUndefinedFromTheHorizonOn) {
  for (const float du : {0.0F, 0x1p-24F, -0x1p-24F, 0x1p-60F, -0x1p-60F, 0x1p-149F, -0x1p-149F}) {
    cases::Case c = around_sample(cases::Rules::vulkan, 1, 0, du, 0,
                                  {{{1, -8, 0.5F, 1}, {1, 8, 0.5F, 1}, {1, 0, 0.5F, 32}}},
                                  {{{1, 2}, {1, 2}, {1, 2}}});
    c.framebuffer.samples = 4;
    for (cases::Attribute& attribute : c.attributes) attribute.location = cases::Location::center;
    c.attributes[1].interpolation = cases::Interpolation::noperspective;
    const SceneTruth scene(c, cases::contract_of(c));
    ASSERT_EQ(TriangleTruth(scene, 0).judge(1, 1, 1).verdict, Verdict::required);
    cases::Fragments drawn;
    push(drawn, 0, 1, 1, 1, 0, {1, 2});
    for (const Level level : kLevels) {
      const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
      for (const AttributeKind kind : {AttributeKind::smooth, AttributeKind::noperspective}) {
        const records::ErrorStatistics& errors = judgement.errors.at(kind);
        // If the triangle is moved right, the centre lies to the left of the horizon.
        const bool is_judged = du < 0;
        EXPECT_EQ(errors.not_judged.contains(records::NotJudged::undefined), !is_judged) << du;
        EXPECT_EQ(errors.excess.histogram.count_in(Histogram::kZeroBucket), is_judged ? 1U : 0U)
            << du;
        EXPECT_EQ(errors.excess.histogram.count(), is_judged ? 1U : 0U) << du;
      }
    }
  }
}

// By hand: the value is 2 − 2x, at most 7/4 at a vertex but 2 at the centre, which lies outside the
// triangle. ulp(2) is 2^-22, twice that of the vertices' values.
TEST(CascadeValues, BeyondTheVerticesUlpGrowWithThem) {
  cases::Case c = around_sample(cases::Rules::vulkan, 1, 0, 0, 0,
                                {{{0.125F, -1, 0, 1}, {0.125F, 1, 0, 1}, {1.125F, 0, 0, 1}}},
                                {{{1.75F, 1.75F}, {1.75F, 1.75F}, {-0.25F, -0.25F}}});
  c.framebuffer.samples = 4;
  for (cases::Attribute& attribute : c.attributes) attribute.location = cases::Location::center;
  c.attributes[1].interpolation = cases::Interpolation::noperspective;
  cases::Contract contract = cases::contract_of(c);
  contract.bounds.smooth.constant = 4;
  contract.bounds.noperspective.constant = 4;
  const SceneTruth scene(c, contract);
  cases::Fragments drawn;
  push(drawn, 0, 1, 1, 1, 0, {2 + 0x1p-22F, 2 + 0x1p-22F});
  for (const Level level : kLevels) {
    const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
    for (const AttributeKind kind : {AttributeKind::smooth, AttributeKind::noperspective}) {
      const records::ErrorStatistics& errors = judgement.errors.at(kind);
      EXPECT_EQ(errors.excess.histogram.count_in(Histogram::bucket_of(1)), 1U);
      EXPECT_EQ(errors.excess.extremes.most_positive->error, (Enclosure{1, 1}));
    }
  }
}

// If all values of a triangle are equal, the first level, too, finds an error of 0 ULP for each,
// and zeros of the wrong sign are reported.
TEST(CascadeValues, ConstantsAndZerosAreExactToTheFirstLevel) {
  cases::Case c =
      small_case(cases::Rules::vulkan, 8, 8,
                 {{{-0.937F, -0.913F, 0.3F, 1}, {3.1F, -2.2F, 0.9F, 3}, {-2, 6, 0.6F, 2}}},
                 {{{0.1F, 0, -0.0F, 0}, {0.1F, 0, -0.0F, -0.0F}, {0.1F, 0, -0.0F, 0}}});
  for (const auto interpolation :
       {cases::Interpolation::smooth, cases::Interpolation::noperspective,
        cases::Interpolation::flat}) {
    for (cases::Attribute& attribute : c.attributes) attribute.interpolation = interpolation;
    const SceneTruth scene(c, cases::contract_of(c));
    cases::Fragments drawn = perfect(scene);
    const std::uint64_t n = drawn.size();
    ASSERT_GT(n, 20U);
    for (std::size_t i = 0; i < n; ++i) {
      for (const std::size_t a : {1U, 2U, 3U}) drawn.attributes[4 * i + a] = -0.0F;
    }
    for (const Level level : kLevels) {
      const records::Judgement judgement = judge(scene, drawn, from(level)).judgement;
      const records::ErrorStatistics& errors = judgement.errors.at(records::kind_of(interpolation));
      EXPECT_EQ(errors.classes[FragmentClass::correct], 3 * n);
      EXPECT_EQ(errors.classes[FragmentClass::wrong_sign_of_zero], n);
      EXPECT_EQ(errors.excess.histogram.count_in(Histogram::kZeroBucket), 4 * n);
      EXPECT_EQ(errors.excess.extremes, records::Extremes());
      EXPECT_EQ(judgement.levels.values.filter >= 3 * n, level == Level::filter);
    }
  }
}

}  // namespace
}  // namespace rastercheck::oracle::cascade_adversarial_test
