// The rasterizer and its methods as backends: depth bias, and depths in unorm formats.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::backends::cpu_depth_test {
namespace {

constexpr float kSteps16 = 65535;
const std::vector<std::string> kOwnWays{
    "cpu", "cpu:output=framebuffer", "cpu:output=framebuffer,threads=2", "cpu:precision=float32"};
const std::vector<std::string> kExactMethods{"method:clipless-homogeneous", "method:screen-linear",
                                             "method:q-matrix"};

/// Triangles over all of 4×4 pixels, with these depths everywhere.
cases::Case levels(const std::vector<float>& depths) {
  cases::Case c;
  c.framebuffer = {4, 4, 1};
  c.viewport = {0, 0, 4, 4, 0, 1};
  for (const float z : depths) {
    const auto first = static_cast<std::uint32_t>(c.positions.size());
    c.positions.insert(c.positions.end(), {{-1, -1, z, 1}, {4, -1, z, 1}, {-1, 4, z, 1}});
    c.triangles.push_back({first, first + 1, first + 2});
  }
  return c;
}

/// The depth of the first pixel, and the triangle that is seen there.
struct Seen {
  float depth;
  std::uint32_t triangle;
  bool operator==(const Seen&) const = default;
};
Seen seen(const std::string& name, const cases::Case& c) {
  const cases::Fragments drawn = make_backend(name).value()->draw(c).value().fragments;
  EXPECT_EQ(drawn.size() % 16, 0U) << name;
  if (drawn.size() == 0) return {-1, 0};
  return {drawn.depth[0], drawn.triangle[0]};
}

// Kills: a bias, a clamp or a format that does not reach the rasterizer.
TEST(CpuDepth, AddsTheBiasAndStores) {
  cases::Case c = levels({0.25F});
  c.positions[1].z = 0.25F + 0.625F;  // 1/16 more for each pixel of x: 9/32 at the first
  std::vector<std::string> all = kOwnWays;
  all.insert(all.end(), kExactMethods.begin(), kExactMethods.end());
  for (const std::string& name : all) {
    c.depth_format = cases::DepthFormat::float32;
    c.depth_bias = {0, 2, 0};
    EXPECT_EQ(seen(name, c).depth, 0.28125F + 0.125F) << name;
    c.depth_bias = {0, 2, 0.0625F};
    EXPECT_EQ(seen(name, c).depth, 0.28125F + 0.0625F) << name;
    c.depth_bias = {0x1p20F, 0, 0};  // the greatest depth is 7/8: r = 2^-24
    EXPECT_EQ(seen(name, c).depth, 0.28125F + 0.0625F) << name;
    c.depth_format = cases::DepthFormat::unorm16;
    c.depth_bias = {0x1p12F, 0, 0};  // r = 2^-16; 11/32 · 65535 = 22527.66
    EXPECT_EQ(seen(name, c).depth, 22528 / kSteps16) << name;
    c.depth_format = cases::DepthFormat::unorm24;
    c.depth_bias = {};  // 9/32 · 16777215 = 4718591.72
    EXPECT_EQ(seen(name, c).depth, 4718592 / 16777215.0F) << name;
  }
}

// Kills: depths compared before they are stored; the later of equals; a depth buffer whose
// beginning is not stored.
TEST(CpuDepth, TestsWhatIsStored) {
  // 0.25 and 0.25 − 2^-20 are both 16384/65535.
  cases::Case c = levels({0.25F, 0.25F - 0x1p-20F});
  c.depth_test = cases::DepthTest::less;
  for (const std::string& name : kOwnWays) {
    c.depth_format = cases::DepthFormat::float32;
    c.depth_clear = 0.25F;
    EXPECT_EQ(seen(name, c), (Seen{0.25F - 0x1p-20F, 1})) << name;
    c.depth_format = cases::DepthFormat::unorm16;
    EXPECT_EQ(seen(name, c).depth, -1) << name;
    c.depth_clear = 0.25F + 0x1p-17F;  // 16384.25 steps
    EXPECT_EQ(seen(name, c).depth, -1) << name;
    c.depth_clear = 0.25F + 0x1p-15F;
    EXPECT_EQ(seen(name, c), (Seen{16384 / kSteps16, 0})) << name;
    c.depth_clear.reset();
    EXPECT_EQ(seen(name, c), (Seen{16384 / kSteps16, 0})) << name;
    c.depth_clear = 1.0F;
    cases::Case far = levels({1.0F - 0x1p-20F});
    far.depth_test = cases::DepthTest::less;
    far.depth_format = c.depth_format;
    EXPECT_EQ(seen(name, far), (Seen{1, 0})) << name;  // begins farther than all depths
    far.depth_clear = 1.0F;
    EXPECT_EQ(seen(name, far).depth, -1) << name;
  }
}

// Kills: an occludee compared before its depth is stored, or with a clear depth that is not.
TEST(CpuDepth, OccludesByWhatIsStored) {
  for (const std::string& name : kOwnWays) {
    cases::Case c = levels({0.25F, 0.25F - 0x1p-20F});
    const auto is_occluded = [&](std::size_t occluders) {
      return make_backend(name).value()->occlusion_culler()->is_occluded(c, occluders).value();
    };
    EXPECT_FALSE(is_occluded(1)) << name;
    c.depth_format = cases::DepthFormat::unorm16;
    EXPECT_TRUE(is_occluded(1)) << name;
    c.depth_clear = 0.25F + 0x1p-17F;  // 16384.25 steps
    EXPECT_TRUE(is_occluded(0)) << name;
  }
}

// Kills: pictures without bias or format; a cleared picture that the format cannot hold.
TEST(CpuDepth, DrawsPicturesWithStoredDepths) {
  cases::Case c = levels({0.25F});
  c.scissor = cases::Scissor{0, 0, 2, 4};
  c.depth_format = cases::DepthFormat::unorm16;
  c.depth_bias = {0x1p12F, 0, 0};
  cases::Pipeline pipeline;
  pipeline.clear_depth = 0.5F;
  const auto backend = make_backend("cpu").value();
  const cases::Picture picture = backend->picture_drawer()->draw_picture(c, pipeline).value();
  EXPECT_EQ(picture.depth[0], 20480 / kSteps16);  // 5/16 · 65535 = 20479.7
  EXPECT_EQ(picture.depth[3], 32768 / kSteps16);
}

TEST(CpuDepth, PromisesWhatItDraws) {
  cases::Case c = levels({0.25F});
  std::vector<std::string> all = kOwnWays;
  all.insert(all.end(), kExactMethods.begin(), kExactMethods.end());
  for (const std::string& name : all) {
    const auto backend = make_backend(name).value();
    c.rules = cases::Rules::vulkan;
    c.depth_format = cases::DepthFormat::float32;
    EXPECT_EQ(backend->contract(c).bounds.depth, (cases::ValueBound{0.51F}));
    EXPECT_EQ(backend->contract(c).depth_bias, cases::BiasPromise());
    c.depth_format = cases::DepthFormat::unorm24;
    c.rules = cases::Rules::d3d;
    const cases::Contract contract = backend->contract(c);
    EXPECT_EQ(contract.bounds.depth, (cases::ValueBound{0.01F}));
    EXPECT_EQ(contract.depth_format, cases::DepthFormat::unorm24);
    EXPECT_EQ(contract.depth_store, cases::DepthStore::nearest);
    EXPECT_EQ(contract.depth_bias.unit, cases::BiasUnit::least_value);
    EXPECT_EQ(contract.depth_bias.slope, cases::BiasSlope::greatest);
    EXPECT_EQ(contract.depth_bias.exponent, cases::BiasExponent::vertices);
    EXPECT_TRUE(backend->about().capabilities.is_everything()) << name;
  }
}

// Kills: methods that ignore what they cannot draw.
TEST(CpuDepth, MethodsThatScanPolygonsHaveNeitherBiasNorSteps) {
  for (const char* const name :
       {"method:rational-linear", "method:edge-then-span", "method:scanline-linear"}) {
    const auto backend = make_backend(name).value();
    const cases::Capabilities& has = backend->about().capabilities;
    EXPECT_FALSE(has.has(cases::Feature::depth_bias)) << name;
    EXPECT_FALSE(has.has(cases::Feature::unorm_depth)) << name;
    cases::Case c = levels({0.25F});
    EXPECT_TRUE(backend->draw(c)) << name;
    c.depth_bias = {1, 0, 0};
    const auto biased = backend->draw(c);
    ASSERT_FALSE(biased) << name;
    EXPECT_EQ(biased.error().failure, Failure::unsupported);
    EXPECT_NE(to_string(biased.error()).find("depth bias"), std::string::npos);
    c.depth_bias = {};
    c.depth_format = cases::DepthFormat::unorm16;
    EXPECT_FALSE(backend->draw(c)) << name;
  }
}

}  // namespace
}  // namespace rastercheck::backends::cpu_depth_test
