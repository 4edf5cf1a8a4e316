#include "backends/api_promise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "cases/case.h"
#include "oracle/rational.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::backends::api_promise_test {
namespace {

constexpr ApiLimits kEightBits{8};

cases::Case case_of(const std::array<cases::ClipVertex, 3>& triangle) {
  cases::Case c;
  c.framebuffer = {64, 64, 1};
  c.viewport = {0, 0, 64, 64, 0, 1};
  c.positions.assign(triangle.begin(), triangle.end());
  c.triangles = {{0, 1, 2}};
  return c;
}

constexpr std::array<cases::ClipVertex, 3> kPlain{
    {{-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {0, 0.5F, 0.5F, 1}}};

TEST(ApiPromise, LeavesOpenWhatTheSpecificationsLeaveOpen) {
  const cases::Contract contract = api_promise(case_of(kPlain), {4});
  ASSERT_TRUE(contract.coverage);
  EXPECT_EQ(contract.coverage->subpixel_bits, 4);
  EXPECT_EQ(contract.coverage->rounding, cases::Rounding::unspecified);
  EXPECT_EQ(contract.basis, cases::Basis::unspecified);
  EXPECT_EQ(contract.tie_rule, cases::TieRule::unspecified);
  EXPECT_FALSE(contract.is_on_grid);
  EXPECT_FALSE(contract.keeps_constants);
  EXPECT_FALSE(contract.keeps_equal_depth);
  EXPECT_FALSE(contract.keeps_vertex_values);
  EXPECT_FALSE(contract.keeps_sign_of_zero);
  EXPECT_FALSE(contract.is_invariant);
}

TEST(ApiPromise, OfPositionsIsThatOfFiveOperations) {
  // 10^-5 (4 · 16 + 2 · 32) pixels, 256 units each.
  const cases::Contract contract = api_promise(case_of(kPlain), kEightBits);
  EXPECT_NEAR(contract.coverage->position_error, 1e-5 * 128 * 256 * 1.01, 1e-6);
  // What a triangle is not cut by does not matter.
  EXPECT_NEAR(contract.clip_tolerance, 1e-5 * 128 * 256 * 1.01 + 1, 1e-6);
}

TEST(ApiPromise, OfDepthIsThatOfThePlane) {
  // Window x 16, 48, 32 and y 16, 16, 48, so det = 32 · 32; |X| = 48, 48, 32 and |Y| = 48 thrice;
  // |E|(64, 64) = 15104, 15104, 16896; K = 47104 / 1024 = 46.
  const cases::Contract contract = api_promise(case_of(kPlain), kEightBits);
  EXPECT_NEAR(contract.bounds.depth.constant, (55 * 46 + 5) * 1e-5 * 0x1p24 * 1.01 + 0.5, 0.1);
  EXPECT_NEAR(contract.bounds.smooth.constant, 2 * 1e-5 * 0x1p24 * 1.01 + 0.5, 1e-3);
  EXPECT_NEAR(contract.bounds.smooth.per_condition, 55 * 1e-5 * 0x1p24 * 1.01, 1e-2);
  EXPECT_EQ(contract.bounds.noperspective, contract.bounds.smooth);
}

TEST(ApiPromise, OfNewVerticesDependsOnTheLeastW) {
  // The near plane z = 0 cuts where w is 1/4 · 1 + 3/4 · 0.2 = 0.4; the greatest |y| is 1/4, w
  // is 1.
  const std::array<cases::ClipVertex, 3> near{{{0, 0.25F, 0.75F, 1},
                                               {-0.0625F, -0.0625F, -0.25F, 0.2F},
                                               {0.0625F, -0.0625F, -0.25F, 0.2F}}};
  const cases::Contract contract = api_promise(case_of(near), kEightBits);
  const double position = 1e-5 * (4 * 0.0625 / 0.2F * 32 + 2 * 32);
  const double cut = 14 * 1e-5 / 0.4 * (0.25 + 1) * 32;
  EXPECT_NEAR(contract.coverage->position_error, position * 256 * 1.01, 1e-4);
  EXPECT_NEAR(contract.clip_tolerance, (position + cut) * 256 * 1.01 + 1, 1e-4);
}

TEST(ApiPromise, OfVerticesBesideTheViewportCountsAsOfNewOnes) {
  std::array<cases::ClipVertex, 3> wide = kPlain;
  wide[1].x = 3;
  const cases::Contract contract = api_promise(case_of(wide), kEightBits);
  const double position = 1e-5 * (4 * 96 + 2 * 32);
  const double cut = 14 * 1e-5 * (3 + 1) * 32;
  EXPECT_NEAR(contract.coverage->position_error, (position + cut) * 256 * 1.01, 1e-4);
}

TEST(ApiPromise, OfWhatReachesTheEyeIsNothing) {
  // All of the clipped triangle's edge through the eye is left: w comes down to 0 there.
  const std::array<cases::ClipVertex, 3> through{{{0, 0, 0, 0}, {0.5F, 0, 0, 1}, {0, 0.5F, 0, 1}}};
  const cases::Case c = case_of(through);
  EXPECT_FALSE(cases::makes_promises_of(api_promise(c, kEightBits), c));
}

TEST(ApiPromise, OfWhatIsSeenEdgeOnAndCutIsNothing) {
  // The edge from p to −p passes through the eye.
  const std::array<cases::ClipVertex, 3> opposite{
      {{0.5F, 0.25F, 0.5F, 1}, {-0.5F, -0.25F, -0.5F, -1}, {0, 0.5F, 0.5F, 1}}};
  const cases::Case c = case_of(opposite);
  EXPECT_FALSE(cases::makes_promises_of(api_promise(c, kEightBits), c));
  // Whole, it only loses its values.
  const std::array<cases::ClipVertex, 3> thin{
      {{-0.5F, 0, 0.5F, 1}, {0.5F, 0, 0.5F, 1}, {0, 0, 0.5F, 1}}};
  EXPECT_LT(api_promise(case_of(thin), kEightBits).clip_tolerance, 2);
  EXPECT_EQ(api_promise(case_of(thin), kEightBits).bounds.depth.constant, 0x1p24F);
  EXPECT_EQ(api_promise(case_of(thin), kEightBits).bounds.smooth.constant, 0x1p24F);
}

TEST(ApiPromise, OfNumbersWhoseProductsAreTooLargeIsNothing) {
  cases::Case c = case_of(kPlain);
  EXPECT_TRUE(cases::makes_promises_of(api_promise(c, kEightBits), c));
  c.positions[0].x = -0x1.8p16F;
  EXPECT_FALSE(cases::makes_promises_of(api_promise(c, kEightBits), c));
  c.positions[0].x = 0x1p-17F;
  EXPECT_FALSE(cases::makes_promises_of(api_promise(c, kEightBits), c));
  c.positions[0].x = -0.0F;
  EXPECT_TRUE(cases::makes_promises_of(api_promise(c, kEightBits), c));
}

/// Arithmetic each of whose results is off by 10^-5 of itself, one way or the other.
class Sloppy {
 public:
  explicit Sloppy(unsigned seed) : random_(seed) {}
  double operator()(double exact) { return exact * (random_() % 2 == 0 ? 1 + 1e-5 : 1 - 1e-5); }

 private:
  std::mt19937 random_;
};

/// A vertex as an implementation has it: window position, 1/w and value.
struct Seen {
  double x = 0;
  double y = 0;
  double inverse_w = 0;
  double value = 0;
};

/// A smooth value at a place, by planes through the window's origin.
double interpolate(const std::array<Seen, 3>& v, double x, double y, Sloppy& sloppy) {
  double numerator = 0;
  double denominator = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Seen& p = v[(i + 1) % 3];
    const Seen& q = v[(i + 2) % 3];
    const double a = sloppy(p.y - q.y);
    const double b = sloppy(q.x - p.x);
    const double c = sloppy(sloppy(p.x * q.y) - sloppy(q.x * p.y));
    const double area = sloppy(sloppy(sloppy(a * x) + sloppy(b * y)) + c);
    const double weight = sloppy(area * v[i].inverse_w);
    numerator = sloppy(numerator + sloppy(weight * v[i].value));
    denominator = sloppy(denominator + weight);
  }
  return sloppy(numerator / denominator);
}

TEST(ApiPromise, HoldsForSloppyArithmetic) {
  std::mt19937 random(1);
  const auto unit = [&random] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
  int judged = 0;
  double worst = 0;
  for (unsigned round = 0; round < 3000; ++round) {
    std::array<cases::ClipVertex, 3> triangle;
    for (cases::ClipVertex& p : triangle) {
      p.w = 0.5F + 2 * unit();
      p.x = (2 * unit() - 1) * p.w;
      p.y = (2 * unit() - 1) * p.w;
      p.z = unit() * p.w;
    }
    cases::Case c = case_of(triangle);
    c.attributes = {{"r"}};
    for (int i = 0; i < 3; ++i) c.attribute_values.push_back(2 * unit() - 1);
    Sloppy sloppy(round);
    std::array<Seen, 3> seen;
    for (std::size_t i = 0; i < 3; ++i) {
      const cases::ClipVertex& p = c.positions[i];
      const double inverse_w = sloppy(1 / double{p.w});
      seen[i] = {sloppy(sloppy(sloppy(double{p.x} * inverse_w) * 32) + 32),
                 sloppy(sloppy(sloppy(double{p.y} * inverse_w) * 32) + 32), inverse_w,
                 double{c.attribute_values[i]}};
    }
    // The exact positions alone, so that only the bound makes up for all errors.
    cases::Contract contract = api_promise(c, kEightBits);
    contract.coverage = std::nullopt;
    contract.basis = cases::Basis::ideal;
    const oracle::SceneTruth scene(c, contract);
    const oracle::TriangleTruth truth(scene, 0);
    for (int y = 2; y < 64; y += 12) {
      for (int x = 2; x < 64; x += 12) {
        if (truth.judge(x, y, 0).verdict != records::Verdict::required) continue;
        const auto bound = truth.value_bound(0, x, y, 0);
        if (!bound) continue;
        const double exact = truth.attribute(0, x, y, 0)->lo.enclosure().lo;
        const double magnitude = truth.attribute_magnitude(0).enclosure().lo;
        const double ulp = std::ldexp(1.0, std::ilogb(magnitude) - 23);
        const double error = std::fabs(interpolate(seen, x + 0.5, y + 0.5, sloppy) - exact) / ulp;
        EXPECT_LE(error, bound->enclosure().lo);
        worst = std::max(worst, error / bound->enclosure().lo);
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 5000);
  // The bound is of the worst that errors can add up to, and not of another size altogether.
  EXPECT_GT(worst, 0.01);
  RecordProperty("judged", judged);
  RecordProperty("worst share", std::to_string(worst));
}

}  // namespace
}  // namespace rastercheck::backends::api_promise_test
