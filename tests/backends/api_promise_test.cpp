#include "backends/api_promise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "backends/internal/plane_error.h"
#include "cases/case.h"
#include "oracle/rational.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::backends::api_promise_test {
namespace {

constexpr ApiLimits kEightBits{8};
constexpr auto kSpec = cases::DriverPromise::spec;

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
  const cases::Contract contract = api_promise(case_of(kPlain), {4}, kSpec);
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

TEST(ApiPromise, PositionErrorCountsFiveOperations) {
  // 10^-5 (4 · 16 + 2 · 32) pixels, 256 units each.
  const cases::Contract contract = api_promise(case_of(kPlain), kEightBits, kSpec);
  EXPECT_NEAR(contract.coverage->position_error, 1e-5 * 128 * 256 * 1.01, 1e-6);
  // Planes that do not cut do not matter. A new vertex is also rounded, in addition to the position
  // error.
  EXPECT_NEAR(contract.clip_tolerance, 1, 1e-6);
}

// A side moves by less than one unit of the viewport's grid. If origin and size are rounded
// separately, the far side moves by less than two.
TEST(ApiPromise, LeavesOpenHowViewportsAreRounded) {
  const auto error = [](const cases::Viewport& viewport, int bits) {
    cases::Case c = case_of(kPlain);
    c.viewport = viewport;
    return api_promise(c, {8, false, bits}, kSpec).viewport_error;
  };
  EXPECT_EQ(error({3, -5, 64, 64, 0, 1}, 0), 0);
  EXPECT_EQ(error({0.5F, 0, 64, 64, 0, 1}, 0), 1);
  EXPECT_EQ(error({0, 0, 64, 63.5F, 0, 1}, 0), 1);
  EXPECT_EQ(error({0, 0.5F, 64, 63.5F, 0, 1}, 0), 2);
  EXPECT_EQ(error({0, 0.5F, 64, 63.5F, 0, 1}, 1), 0);
  EXPECT_EQ(error({0, 0.25F, 64, 64, 0, 1}, 1), 0.5);
  // With a positive width, the same viewport begins at 8.5.
  EXPECT_EQ(error({40, 0, -31.5F, 64, 0, 1}, 0), 2);
}

/// Computed by hand for a right-angled triangle with legs of 32 pixels and w = 1, whose vertices
/// are not moved: about the corners of its bounding box, Σ s_i is 5, 8, 8 and 11 times 32², and D
/// is 32².
TEST(ApiPromise, ValueErrorsAreBoundedByThePlanes) {
  const WindowTriangle triangle{{0, 32, 0}, {0, 0, 32}, {1, 1, 1}};
  const PlaneError error = plane_error(triangle, {.operation = 1e-6});
  EXPECT_NEAR(error.affine, 31 * 11e-6 / (1 - 5 * 11e-6), 1e-12);
  EXPECT_NEAR(error.constant, 2e-6, 1e-15);
  EXPECT_NEAR(error.per_horizon, 68 * 11e-6 / (1 - 38 * 11e-6), 1e-12);
  // With w from 1 to 2, the greatest 1/w is twice the least.
  const PlaneError in_depth = plane_error({{0, 32, 0}, {0, 0, 32}, {1, 1, 2}}, {.operation = 1e-6});
  EXPECT_NEAR(in_depth.per_horizon, 68 * 11e-6 / (1 - 5 * 11e-6 - 33 * 11e-6 * 2), 1e-12);
}

TEST(ApiPromise, PromisesNoValuesIfTheAreaMayVanish) {
  const WindowTriangle triangle{{0, 32, 16}, {0, 0, 0.01}, {1, 1, 1}};
  EXPECT_LT(plane_error(triangle, {.operation = 1e-9}).affine, 1);
  EXPECT_TRUE(std::isinf(plane_error(triangle, {.operation = 1e-9, .reach = 0.01}).affine));
}

TEST(ApiPromise, BoundsPicturesAsTheSpecificationsDo) {
  cases::Case c = case_of(kPlain);
  const cases::PictureBounds spec = api_promise(c, {8, true}, kSpec).picture_bounds.value();
  EXPECT_FALSE(spec.keeps_fragments);
  EXPECT_FALSE(spec.resolves_to_mean);
  EXPECT_EQ(spec.byte_store, 1);  // either neighbour
  EXPECT_EQ(spec.byte_blend, 4);
  EXPECT_EQ(spec.texel_distance, 0x1p-4F);
  EXPECT_NEAR(spec.float_error, 3.03e-5 * 0x1p24, 1);

  const ApiLimits limits{.is_software = true, .subtexel_bits = 8};
  constexpr auto kIeee = cases::DriverPromise::ieee;
  const cases::PictureBounds ieee = api_promise(c, limits, kIeee).picture_bounds.value();
  EXPECT_TRUE(ieee.keeps_fragments);
  EXPECT_TRUE(ieee.resolves_to_mean);
  EXPECT_EQ(ieee.byte_store, 0.6F);
  EXPECT_EQ(ieee.byte_blend, 2);
  EXPECT_EQ(ieee.byte_mean, 0.6F);
  EXPECT_EQ(ieee.texel_distance, 0x1p-8F);
  EXPECT_NEAR(ieee.float_error, 3.03, 1e-5);
  c.framebuffer.samples = 8;  // seven sums and a product
  const cases::PictureBounds eight = api_promise(c, limits, kIeee).picture_bounds.value();
  EXPECT_NEAR(eight.float_error, 8.08, 1e-5);
  EXPECT_EQ(eight.byte_mean, 1.5F);  // three means, each off by half a byte
  EXPECT_TRUE(eight.keeps_fragments);
  c.attributes = {{"a", cases::Interpolation::smooth, cases::Location::centroid}};
  EXPECT_FALSE(api_promise(c, limits, kIeee).picture_bounds->keeps_fragments);
}

TEST(ApiPromise, DepthBoundFollowsFromThePlaneError) {
  // The error of positions reduces the area only a little: K is 11 · 32²/2 or slightly more.
  const cases::Contract contract = api_promise(case_of(kPlain), kEightBits, kSpec);
  ASSERT_EQ(contract.triangles.size(), 1U);
  const WindowTriangle window{{16, 48, 32}, {16, 16, 48}, {1, 1, 1}};
  const double reach = (1 + contract.coverage->position_error) / 256;
  const PlaneError error = plane_error(window, {.operation = 1e-5, .reach = reach});
  EXPECT_NEAR(contract.bounds.depth.constant, (error.affine + 5e-5) * 0x1p24 * 1.01 + 0.5, 0.1);
  EXPECT_NEAR(contract.bounds.smooth.constant, 2 * 1e-5 * 0x1p24 * 1.01 + 0.5, 1e-3);
  EXPECT_NEAR(contract.bounds.smooth.per_horizon, error.per_horizon * 0x1p24 * 1.01, 0.1);
  EXPECT_EQ(contract.triangles[0].bounds, contract.bounds);
}

TEST(ApiPromise, ClipToleranceDependsOnTheLeastW) {
  // The near plane z = 0 cuts where w is 1/4 · 1 + 3/4 · 0.2 = 0.4. The greatest |y| is 1/4, and
  // the greatest w is 1.
  const std::array<cases::ClipVertex, 3> near{{{0, 0.25F, 0.75F, 1},
                                               {-0.0625F, -0.0625F, -0.25F, 0.2F},
                                               {0.0625F, -0.0625F, -0.25F, 0.2F}}};
  const cases::Contract contract = api_promise(case_of(near), kEightBits, kSpec);
  const double position = 1e-5 * (4 * 0.0625 / 0.2F * 32 + 2 * 32);
  const double cut = 14 * 1e-5 / 0.4 * (0.25 + 1) * 32;
  EXPECT_NEAR(contract.coverage->position_error, position * 256 * 1.01, 1e-4);
  EXPECT_NEAR(contract.clip_tolerance, cut * 256 * 1.01 + 1, 1e-4);
}

TEST(ApiPromise, VerticesBesideTheViewportCountAsNewOnes) {
  std::array<cases::ClipVertex, 3> wide = kPlain;
  wide[1].x = 3;
  const cases::Contract contract = api_promise(case_of(wide), kEightBits, kSpec);
  const double position = 1e-5 * (4 * 96 + 2 * 32);
  const double cut = 14 * 1e-5 * (3 + 1) * 32;
  // A new vertex is rounded as well.
  EXPECT_NEAR(contract.coverage->position_error, (position + cut) * 256 * 1.01 + 1, 1e-4);
  EXPECT_EQ(contract.triangles[0].clip_tolerance, 0);
  EXPECT_EQ(contract.triangles[0].side_tolerance, double{contract.coverage->position_error});
}

// Of this triangle the near plane leaves the edge between the given vertices at z = -w, which the
// left side does not cut. A driver that cuts at the left side first has a new vertex 3/4 of an ulp
// outside of the near plane, which floats place on it.
TEST(ApiPromise, CountsPlanesThatAnotherPlaneLeavesNothingToCut) {
  const std::array<cases::ClipVertex, 3> beyond{
      {{-0.96875F, 0, -1, 1}, {-1.03125F, 1, -0x1.000002p+0F, 1}, {0, 0, -1, 1}}};
  cases::Case c = case_of(beyond);
  c.rules = cases::Rules::opengl;
  EXPECT_GE(api_promise(c, kEightBits, cases::DriverPromise::ieee).clip_error, 0x1p-24);
  c.positions[1].x = -0.5F;  // cut by the near plane alone
  EXPECT_EQ(api_promise(c, kEightBits, cases::DriverPromise::ieee).clip_error, 0);
}

TEST(ApiPromise, PromisesNothingForTrianglesThroughTheEye) {
  // The clipped triangle keeps its whole edge through the eye, where w falls to 0.
  const std::array<cases::ClipVertex, 3> through{{{0, 0, 0, 0}, {0.5F, 0, 0, 1}, {0, 0.5F, 0, 1}}};
  const cases::Case c = case_of(through);
  EXPECT_FALSE(cases::promises_all_of(api_promise(c, kEightBits, kSpec), c));
}

TEST(ApiPromise, PromisesNothingForCutTrianglesSeenEdgeOn) {
  // The edge from p to −p passes through the eye.
  const std::array<cases::ClipVertex, 3> opposite{
      {{0.5F, 0.25F, 0.5F, 1}, {-0.5F, -0.25F, -0.5F, -1}, {0, 0.5F, 0.5F, 1}}};
  const cases::Case c = case_of(opposite);
  EXPECT_FALSE(cases::promises_all_of(api_promise(c, kEightBits, kSpec), c));
  // If the triangle is not cut, just the promise about its values is lost.
  const std::array<cases::ClipVertex, 3> thin{
      {{-0.5F, 0, 0.5F, 1}, {0.5F, 0, 0.5F, 1}, {0, 0, 0.5F, 1}}};
  EXPECT_LT(api_promise(case_of(thin), kEightBits, kSpec).clip_tolerance, 2);
  EXPECT_EQ(api_promise(case_of(thin), kEightBits, kSpec).bounds.depth.constant, 0x1p24F);
  EXPECT_EQ(api_promise(case_of(thin), kEightBits, kSpec).bounds.smooth.constant, 0x1p24F);
}

cases::Case case_of_line(cases::LineMode mode) {
  cases::Case c = case_of(kPlain);
  c.primitive = cases::Primitive::lines;
  c.line_mode = mode;
  c.triangles = {{0, 1, 1}};
  return c;
}

// The ends of lines are off as vertices of triangles are; bounds of values need three planes.
TEST(ApiPromise, PromisesOfLinesWhereTheyAre) {
  cases::Case c = case_of_line(cases::LineMode::rectangular);
  const cases::TrianglePromise line = api_promise(c, kEightBits, kSpec).triangles.at(0);
  EXPECT_TRUE(line.is_made);
  EXPECT_NEAR(line.position_error, 1e-5 * 128 * 256 * 1.01, 1e-6);
  for (const cases::ValueBound& bound :
       {line.bounds.smooth, line.bounds.noperspective, line.bounds.depth}) {
    EXPECT_EQ(bound.constant, 0x1p24F);
  }
  c.positions[1].x = 1.5F;  // beyond a side
  EXPECT_FALSE(api_promise(c, kEightBits, kSpec).triangles.at(0).is_made);
}

TEST(ApiPromise, PromisesNothingOfLinesThatApisLeaveOpen) {
  const auto is_made = [](cases::LineMode mode, cases::DriverPromise promised) {
    return api_promise(case_of_line(mode), kEightBits, promised).triangles.at(0).is_made;
  };
  constexpr auto kIeee = cases::DriverPromise::ieee;
  EXPECT_FALSE(is_made(cases::LineMode::parallelogram, kSpec));
  EXPECT_TRUE(is_made(cases::LineMode::parallelogram, kIeee));
  // The oracle leaves the pixels of this one open.
  EXPECT_TRUE(is_made(cases::LineMode::bresenham, kSpec));
}

// Five operations each, of values that are all the vertex's.
TEST(ApiPromise, BoundsValuesOfPoints) {
  cases::Case c = case_of(kPlain);
  c.primitive = cases::Primitive::points;
  c.triangles = {{0, 0, 0}};
  const cases::ValueBounds spec = api_promise(c, kEightBits, kSpec).triangles.at(0).bounds;
  EXPECT_NEAR(spec.smooth.constant, 5e-5 * 0x1p24 * 1.01 + 0.5, 1e-3);
  EXPECT_EQ(spec.noperspective, spec.smooth);
  EXPECT_EQ(spec.depth, spec.smooth);
  const auto ieee = api_promise(c, kEightBits, cases::DriverPromise::ieee).triangles.at(0);
  EXPECT_NEAR(ieee.bounds.smooth.constant, 5.55, 1e-3);
  c.positions[0].z = 1.5F;
  EXPECT_FALSE(api_promise(c, kEightBits, kSpec).triangles.at(0).is_made);
}

TEST(ApiPromise, PromisesNothingForNumbersOutOfRange) {
  cases::Case c = case_of(kPlain);
  EXPECT_TRUE(cases::promises_all_of(api_promise(c, kEightBits, kSpec), c));
  c.positions[0].x = -0x1.8p16F;
  EXPECT_FALSE(cases::promises_all_of(api_promise(c, kEightBits, kSpec), c));
  c.positions[0].x = 0x1p-17F;
  EXPECT_FALSE(cases::promises_all_of(api_promise(c, kEightBits, kSpec), c));
  c.positions[0].x = -0.0F;
  EXPECT_TRUE(cases::promises_all_of(api_promise(c, kEightBits, kSpec), c));
}

/// Arithmetic in which each result has a relative error: either 10^-5 in a random direction, or
/// that of rounding to float32.
class Arithmetic {
 public:
  Arithmetic(bool is_float32, unsigned seed) : is_float32_(is_float32), random_(seed) {}
  double operator()(double exact) {
    if (is_float32_) return static_cast<double>(static_cast<float>(exact));
    return exact * (random_() % 2 == 0 ? 1 + 1e-5 : 1 - 1e-5);
  }
  bool coin() { return random_() % 2 == 0; }

 private:
  bool is_float32_;
  std::mt19937 random_;
};

/// A vertex as the implementation computes it: window position, 1/w and value.
struct Seen {
  double x = 0;
  double y = 0;
  double inverse_w = 0;
  double value = 0;
};

/// The forms in which values may be evaluated.
enum class Form { weights, pivot, gradient };

/// Evaluates, about the point (p_x, p_y), the function that is linear in the window and f_i at the
/// vertices.
double linear(const std::array<Seen, 3>& v, const std::array<double, 3>& f, double p_x, double p_y,
              double x, double y, Form form, Arithmetic& op) {
  std::array<double, 3> u{};
  std::array<double, 3> w{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = op(v[i].x - p_x);
    w[i] = op(v[i].y - p_y);
  }
  const double at_u = op(x - p_x);
  const double at_v = op(y - p_y);
  const auto cross = [&](std::size_t j, std::size_t k) {
    return op(op(u[j] * w[k]) - op(u[k] * w[j]));
  };
  const double area = op(op(cross(1, 2) + cross(2, 0)) + cross(0, 1));
  if (form == Form::gradient) {
    const double f1 = op(f[1] - f[0]);
    const double f2 = op(f[2] - f[0]);
    const double y1 = op(v[1].y - v[0].y);
    const double y2 = op(v[2].y - v[0].y);
    const double x1 = op(v[1].x - v[0].x);
    const double x2 = op(v[2].x - v[0].x);
    const double twice = op(op(x1 * y2) - op(x2 * y1));
    const double du = op(op(op(f1 * y2) - op(f2 * y1)) / twice);
    const double dv = op(op(op(f2 * x1) - op(f1 * x2)) / twice);
    const double at_p = op(f[0] - op(op(du * u[0]) + op(dv * w[0])));
    return op(op(at_p + op(du * at_u)) + op(dv * at_v));
  }
  std::array<double, 3> weight{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const double e = op(op(op(op(w[j] - w[k]) * at_u) + op(op(u[k] - u[j]) * at_v)) + cross(j, k));
    weight[i] = op(e * op(1 / area));
  }
  if (form == Form::pivot) {
    return op(op(f[0] + op(weight[1] * op(f[1] - f[0]))) + op(weight[2] * op(f[2] - f[0])));
  }
  return op(op(op(weight[0] * f[0]) + op(weight[1] * f[1])) + op(weight[2] * f[2]));
}

/// Evaluates a smooth value.
double interpolate(const std::array<Seen, 3>& v, double p_x, double p_y, double x, double y,
                   Form form, Arithmetic& op) {
  std::array<double, 3> n{};
  std::array<double, 3> d{};
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = v[i].inverse_w;
    n[i] = op(v[i].value * v[i].inverse_w);
  }
  return op(linear(v, n, p_x, p_y, x, y, form, op) *
            op(1 / linear(v, d, p_x, p_y, x, y, form, op)));
}

struct Promised {
  cases::DriverPromise promise = kSpec;
  Form form = Form::weights;
  int samples = 1;
  float size = 1;              ///< size of the triangles, relative to the window
  bool has_fractions = false;  ///< the viewport's sides lie between pixels
};

std::string name_of(const testing::TestParamInfo<Promised>& info) {
  const Promised& p = info.param;
  return std::string(cases::to_string(p.promise)) + "Form" +
         std::to_string(static_cast<int>(p.form)) + "Samples" + std::to_string(p.samples) +
         (p.size < 1 ? "Small" : "") + (p.has_fractions ? "Fractions" : "");
}

class ApiPromiseHolds : public testing::TestWithParam<Promised> {};

/// A viewport that may be used for drawing: numbers that are not integers are rounded up or down.
cases::Viewport in_whole_pixels(cases::Viewport viewport, Arithmetic& op) {
  for (float* const number : {&viewport.x, &viewport.y, &viewport.width, &viewport.height}) {
    *number = op.coin() ? std::floor(*number) : std::ceil(*number);
  }
  return viewport;
}

/// Draws random triangles as an implementation may: positions are computed and rounded to either
/// neighbour on the grid. Values are evaluated in a given form, about a point of the bounding box
/// or, as `ieee` allows, the window's origin. All errors must be within the promise.
TEST_P(ApiPromiseHolds, CoversErrorsOfRoundedArithmetic) {
  const Promised param = GetParam();
  const bool is_ieee = param.promise == cases::DriverPromise::ieee;
  std::mt19937 random(1);
  const auto unit = [&random] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
  int judged = 0;
  double worst = 0;
  for (unsigned round = 0; round < 1500; ++round) {
    cases::Case c = case_of(kPlain);
    c.framebuffer.samples = param.samples;
    const float x0 = (2 * unit() - 1) * (1 - param.size);
    const float y0 = (2 * unit() - 1) * (1 - param.size);
    for (cases::ClipVertex& p : c.positions) {
      p.w = 0.5F + 2 * unit();
      p.x = (x0 + (2 * unit() - 1) * param.size) * p.w;
      p.y = (y0 + (2 * unit() - 1) * param.size) * p.w;
      p.z = unit() * p.w;
    }
    c.attributes = {{"r", cases::Interpolation::smooth, cases::Location::center}};
    for (int i = 0; i < 3; ++i) c.attribute_values.push_back(2 * unit() - 1);
    if (param.has_fractions) c.viewport = {0.375F, -0.25F, 62.5F, 64.75F, 0, 1};
    Arithmetic op(is_ieee, round);
    const cases::Viewport drawn_by = in_whole_pixels(c.viewport, op);
    std::array<Seen, 3> seen;
    for (std::size_t i = 0; i < 3; ++i) {
      const cases::ClipVertex& p = c.positions[i];
      const double inverse_w = op(1 / double{p.w});
      const auto in_window = [&](float number, float origin, float size) {
        const double half = double{size} / 2;
        return op(op(op(double{number} * inverse_w) * half) + op(double{origin} + half));
      };
      const auto snapped = [&op](double at) {
        return (op.coin() ? std::floor(at * 256) : std::ceil(at * 256)) / 256;
      };
      // Vulkan's y points down, and so does the case's.
      seen[i] = {snapped(in_window(p.x, drawn_by.x, drawn_by.width)),
                 snapped(in_window(p.y, drawn_by.y, drawn_by.height)), inverse_w,
                 double{c.attribute_values[i]}};
    }
    c.rules = cases::Rules::vulkan;
    const oracle::SceneTruth scene(c, api_promise(c, kEightBits, param.promise));
    const oracle::TriangleTruth truth(scene, 0);
    const oracle::PixelBox box = truth.pixels();
    const double p_x = is_ieee ? 0 : seen[round % 3].x;
    const double p_y = is_ieee ? 0 : seen[round / 3 % 3].y;
    const int step = param.size < 1 ? 1 : 7;
    for (int y = box.y0; y < box.y1; y += step) {
      for (int x = box.x0; x < box.x1; x += step) {
        if (truth.judge(x, y, 0).verdict != records::Verdict::required) continue;
        const auto bound = truth.value_bound(0, x, y, 0);
        if (!bound || truth.is_value_free(0)) continue;
        const auto range = truth.attribute(0, x, y, 0);
        if (!range) continue;
        const double value = interpolate(seen, p_x, p_y, x + 0.5, y + 0.5, param.form, op);
        const double magnitude = truth.attribute_magnitude(0).enclosure().lo;
        const double ulp = std::ldexp(1.0, std::ilogb(magnitude) - 23);
        const double excess =
            std::max({range->lo.enclosure().lo - value, value - range->hi.enclosure().hi, 0.0}) /
            ulp;
        ASSERT_LE(excess, bound->enclosure().lo) << "round " << round << ", " << x << ", " << y;
        worst = std::max(worst, excess / bound->enclosure().lo);
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 2000);
  RecordProperty("judged", judged);
  RecordProperty("worst share", std::to_string(worst));
}

/// Like the test above, but with exact positions and only one placement, so that the bound alone
/// must cover all errors. Kills: a bound that is too small but holds because several placements
/// hide that; a bound that is far larger than the errors.
TEST_P(ApiPromiseHolds, CoversErrorsOfEvaluationClosely) {
  const Promised param = GetParam();
  const bool is_ieee = param.promise == cases::DriverPromise::ieee;
  std::mt19937 random(2);
  const auto unit = [&random] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
  int judged = 0;
  double worst = 0;
  for (unsigned round = 0; round < 1500; ++round) {
    cases::Case c = case_of(kPlain);
    c.rules = cases::Rules::vulkan;
    for (cases::ClipVertex& p : c.positions) {
      p.w = 0.5F + 2 * unit();
      p = {(2 * unit() - 1) * p.w, (2 * unit() - 1) * p.w, unit() * p.w, p.w};
    }
    c.attributes = {{"r"}};
    for (int i = 0; i < 3; ++i) c.attribute_values.push_back(2 * unit() - 1);
    Arithmetic op(is_ieee, round);
    std::array<Seen, 3> seen;
    for (std::size_t i = 0; i < 3; ++i) {
      const cases::ClipVertex& p = c.positions[i];
      seen[i] = {double{p.x} / double{p.w} * 32 + 32, double{p.y} / double{p.w} * 32 + 32,
                 op(1 / double{p.w}), double{c.attribute_values[i]}};
    }
    cases::Contract contract = api_promise(c, kEightBits, param.promise);
    contract.coverage = std::nullopt;
    contract.basis = cases::Basis::ideal;
    const oracle::SceneTruth scene(c, contract);
    const oracle::TriangleTruth truth(scene, 0);
    const double p_x = is_ieee ? 0 : seen[round % 3].x;
    const double p_y = is_ieee ? 0 : seen[round / 3 % 3].y;
    for (int y = 2; y < 64; y += 12) {
      for (int x = 2; x < 64; x += 12) {
        if (truth.judge(x, y, 0).verdict != records::Verdict::required) continue;
        const auto bound = truth.value_bound(0, x, y, 0);
        if (!bound) continue;
        const double value = interpolate(seen, p_x, p_y, x + 0.5, y + 0.5, param.form, op);
        const double exact = truth.attribute(0, x, y, 0)->lo.enclosure().lo;
        const double magnitude = truth.attribute_magnitude(0).enclosure().lo;
        const double ulp = std::ldexp(1.0, std::ilogb(magnitude) - 23);
        const double error = std::fabs(value - exact) / ulp;
        ASSERT_LE(error, bound->enclosure().lo) << "round " << round << ", " << x << ", " << y;
        worst = std::max(worst, error / bound->enclosure().lo);
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 2000);
  // In the sloppy arithmetic, each operation is off by the whole δ; in float32, by half of δ on
  // average. And the bound of `ieee` is for the corner of the framebuffer that is farthest away.
  EXPECT_GT(worst, is_ieee ? 0.0025 : 0.01);
  RecordProperty("worst share", std::to_string(worst));
}

INSTANTIATE_TEST_SUITE_P(
    Forms, ApiPromiseHolds,
    testing::Values(Promised{kSpec, Form::weights}, Promised{kSpec, Form::pivot},
                    Promised{kSpec, Form::gradient}, Promised{kSpec, Form::weights, 4},
                    Promised{kSpec, Form::gradient, 4, 0.125F},
                    Promised{kSpec, Form::pivot, 1, 0.125F},
                    Promised{cases::DriverPromise::ieee, Form::weights},
                    Promised{cases::DriverPromise::ieee, Form::pivot, 4},
                    Promised{cases::DriverPromise::ieee, Form::gradient, 1, 0.125F},
                    Promised{cases::DriverPromise::ieee, Form::gradient, 4, 0.125F},
                    Promised{kSpec, Form::weights, 1, 1, true},
                    Promised{cases::DriverPromise::ieee, Form::gradient, 1, 0.5F, true}),
    name_of);

}  // namespace
}  // namespace rastercheck::backends::api_promise_test
