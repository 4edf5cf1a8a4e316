#pragma once

// Tests of depths as a driver stores them, with a bias and in unorm formats, by cases whose results
// are known by hand. Where APIs leave results open, StoredDepths says which a driver has.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/names.h"

namespace rastercheck::backends {

/// How one version of a driver stores depths.
struct StoredDepths {
  bool truncates = false;        ///< to a unorm format; else rounds to the nearest
  double unit = 2;               ///< r of a unorm format of b bits, times 2^b
  bool clamps_bias = true;       ///< heeds DepthBias::clamp; otherwise refuses it
  bool has_unorm24 = true;       ///< otherwise refuses it
  bool biases_vertices = false;  ///< clamps biased depths to [0, 1] at vertices (a fault)
};

/// As Mesa 22.3.6 and SwiftShader 5.0.0 do. llvmpipe is also lavapipe's rasterizer.
inline StoredDepths stored_depths_of(const Backend& backend) {
  const std::string name = backend.about().driver->name;
  // SwiftShader's unit for 16 bits is 1.01 · 2^-16.
  if (name == "swiftshader") return {false, 1.01, true, false, false};
  if (name == "softpipe") return {true, 2, false, true, true};
  return {};
}

inline constexpr int kDepthSide = 16;

/// A case of 16 × 16 pixels without triangles, whose depth range is [0, 1].
inline cases::Case depth_case(cases::DepthFormat format, int samples = 1) {
  cases::Case c;
  c.rules = cases::Rules::vulkan;
  c.framebuffer = {kDepthSide, kDepthSide, samples};
  c.viewport = {0, 0, kDepthSide, kDepthSide, 0, 1};
  c.depth_format = format;
  return c;
}

/// Adds a triangle that covers everything, with depth z + z_x u + z_y v at window (u, v). It ends
/// at u = 32 and at v = 32.
inline void add_plane(cases::Case& c, double z, double z_x = 0, double z_y = 0) {
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (const auto& [u, v] : {std::pair(0.0, 0.0), std::pair(32.0, 0.0), std::pair(0.0, 32.0)}) {
    c.positions.push_back({static_cast<float>(u / 8 - 1), static_cast<float>(v / 8 - 1),
                           static_cast<float>(z + z_x * u + z_y * v), 1});
  }
  c.triangles.push_back({first, first + 1, first + 2});
}

inline double steps_of(cases::DepthFormat format) {
  return std::ldexp(1.0, cases::unorm_bits(format)) - 1;
}

/// The depth that all fragments of a case have; −1 if there are none, or several depths.
inline float only_depth(Backend& backend, const cases::Case& c) {
  const Result<cases::Fragments> drawn = fragments_of(backend.draw(c));
  EXPECT_TRUE(drawn) << to_string(drawn.error());
  if (!drawn || drawn->size() == 0) return -1;
  const std::set<float> depths(drawn->depth.begin(), drawn->depth.end());
  return depths.size() == 1 ? *depths.begin() : -1;
}

/// The number of steps of a case's unorm format that all fragments have. Expects depths to be the
/// floats nearest to such a number of steps.
inline double only_steps(Backend& backend, const cases::Case& c) {
  const float depth = only_depth(backend, c);
  const double steps = std::round(double{depth} * steps_of(c.depth_format));
  EXPECT_EQ(depth, static_cast<float>(steps / steps_of(c.depth_format)));
  return steps;
}

inline std::vector<cases::DepthFormat> unorm_formats(const StoredDepths& expected) {
  if (!expected.has_unorm24) return {cases::DepthFormat::unorm16};
  return {cases::DepthFormat::unorm16, cases::DepthFormat::unorm24};
}

/// Kills: reading depths in other bits; rounding them again; a format that is forgotten.
inline void expect_stored_depths(Backend& backend) {
  const StoredDepths expected = stored_depths_of(backend);
  for (const cases::DepthFormat format : unorm_formats(expected)) {
    for (const int samples : backend.about().capabilities.sample_counts) {
      // 0.5 is 32767.5 or 8388607.5 steps, and 0.25 is 3/4 above an integer. The float before 1 is
      // stored as 1 or as a step less.
      for (const float z : {0.0F, 0.25F, 0.5F, 0x1p-12F, 0x1.fffffep-1F, 1.0F}) {
        SCOPED_TRACE(testing::Message() << name_of(format) << " " << samples << " " << z);
        cases::Case c = depth_case(format, samples);
        add_plane(c, double{z});
        const double exact = double{z} * steps_of(format);
        EXPECT_EQ(only_steps(backend, c),
                  expected.truncates ? std::floor(exact) : std::floor(exact + 0.5));
      }
    }
  }
}

/// Kills: swapping constant, slope and clamp; a bias that stays on or is forgotten; the bias of one
/// format in another.
inline void expect_biased_depths(Backend& backend) {
  const StoredDepths expected = stored_depths_of(backend);
  for (const int samples : backend.about().capabilities.sample_counts) {
    // In float32, r is 2^-24 for depths from 0.5 to 1, and 2^-25 below.
    cases::Case c = depth_case(cases::DepthFormat::float32, samples);
    add_plane(c, 0.5);
    c.depth_bias = {64, 0, 0};
    EXPECT_EQ(only_depth(backend, c), 0.5F + 0x1p-18F);
    c.depth_bias = {-64, 0, 0};
    EXPECT_EQ(only_depth(backend, c), 0.5F - 0x1p-18F);
    c.depth_bias = {};
    EXPECT_EQ(only_depth(backend, c), 0.5F);
    c = depth_case(cases::DepthFormat::float32, samples);
    add_plane(c, 0.25);
    c.depth_bias = {64, 0, 0};
    EXPECT_EQ(only_depth(backend, c), 0.25F + 0x1p-19F);
    for (const cases::DepthFormat format : unorm_formats(expected)) {
      SCOPED_TRACE(name_of(format));
      c = depth_case(format, samples);
      add_plane(c, 0.25);
      c.depth_bias = {8, 0, 0};
      const double exact = 0.25 * steps_of(format) + 8 * expected.unit;
      EXPECT_EQ(only_steps(backend, c),
                expected.truncates ? std::floor(exact) : std::floor(exact + 0.5));
    }
  }
}

/// Every driver here takes the larger derivative for the slope.
inline void expect_slopes(Backend& backend) {
  for (const float slope : {4.0F, -4.0F}) {
    cases::Case c = depth_case(cases::DepthFormat::float32);
    add_plane(c, 0.5, 0x1p-7, -0x1p-6);
    const Result<cases::Fragments> plain = fragments_of(backend.draw(c));
    c.depth_bias = {0, slope, 0};
    const Result<cases::Fragments> biased = fragments_of(backend.draw(c));
    ASSERT_TRUE(plain && biased);
    ASSERT_EQ(plain->size(), 256U);
    ASSERT_EQ(biased->size(), 256U);
    for (std::size_t i = 0; i < plain->size(); ++i) {
      EXPECT_EQ(biased->depth[i] - plain->depth[i], slope * 0x1p-6F);
    }
  }
}

/// A positive clamp is an upper limit of the offset, a negative one a lower limit.
inline void expect_clamped_bias(Backend& backend) {
  cases::Case c = depth_case(cases::DepthFormat::float32);
  add_plane(c, 0.5);
  c.depth_bias = {0x1p22F, 0, 0.125F};
  if (!stored_depths_of(backend).clamps_bias) {
    const Result<Drawn> refused = backend.draw(c);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().failure, Failure::unsupported);
    EXPECT_NE(refused.error().reason.find("no clamp of the depth bias"), std::string::npos);
    c.depth_bias.constant = 0;  // no bias at all, so that its clamp is of no account
    EXPECT_EQ(only_depth(backend, c), 0.5F);
    return;
  }
  // 2^22 · 2^-24 = 0.25.
  EXPECT_EQ(only_depth(backend, c), 0.625F);
  c.depth_bias = {-0x1p22F, 0, 0.125F};
  EXPECT_EQ(only_depth(backend, c), 0.25F);
  c.depth_bias = {0x1p22F, 0, -0.125F};
  EXPECT_EQ(only_depth(backend, c), 0.75F);
  c.depth_bias = {-0x1p22F, 0, -0.125F};
  EXPECT_EQ(only_depth(backend, c), 0.375F);
  c.depth_bias = {0, 0, 0.125F};
  EXPECT_EQ(only_depth(backend, c), 0.5F);
}

/// Biased depths are clamped to [0, 1], or to the depth range if depth is clamped.
inline void expect_limited_depths(Backend& backend) {
  cases::Case c = depth_case(cases::DepthFormat::float32);
  add_plane(c, 0.875);
  c.depth_bias = {0x1p22F, 0, 0};
  EXPECT_EQ(only_depth(backend, c), 1);
  c.depth_bias = {-0x1p24F, 0, 0};
  EXPECT_EQ(only_depth(backend, c), 0);
  // 0.25 + 0.5 · 0.875 = 0.6875.
  c.viewport.min_depth = 0.25F;
  c.viewport.max_depth = 0.75F;
  c.depth_bias = {0x1p21F, 0, 0};
  EXPECT_EQ(only_depth(backend, c), 0.8125F);
  c.depth_clamp = true;
  EXPECT_EQ(only_depth(backend, c), 0.75F);

  // The plane goes from 0 to 1 over the viewport, and its vertices lie on the viewport's border.
  c = depth_case(cases::DepthFormat::float32);
  add_plane(c, 0, 0x1p-4);
  for (cases::ClipVertex& p : c.positions) {
    p.x = (p.x - 1) / 2;
    p.y = (p.y - 1) / 2;
    p.z /= 2;
  }
  c.depth_bias = {0x1p22F, 0, 0};  // 0.5, as the greatest depth is 1
  const Result<cases::Fragments> drawn = fragments_of(backend.draw(c));
  ASSERT_TRUE(drawn);
  for (std::size_t i = 0; i < drawn->size(); ++i) {
    const float plane = (static_cast<float>(drawn->x[i]) + 0.5F) / 16;
    // Clamped at the vertices, the plane goes from 0.5 to 1.
    const float expected =
        stored_depths_of(backend).biases_vertices ? 0.5F + plane / 2 : std::min(plane + 0.5F, 1.0F);
    EXPECT_EQ(drawn->depth[i], expected) << drawn->x[i];
  }
}

/// Kills: comparing depths before they are stored; a last fragment that replaces an equal one; an
/// initial depth that is not stored like others.
inline void expect_tests_of_stored_depths(Backend& backend) {
  const StoredDepths expected = stored_depths_of(backend);
  for (const bool has_clear : {false, true}) {
    for (const cases::DepthFormat format : unorm_formats(expected)) {
      for (const int samples : backend.about().capabilities.sample_counts) {
        SCOPED_TRACE(testing::Message() << name_of(format) << " " << samples << " " << has_clear);
        const auto drawn_of = [&](double first, double second) {
          cases::Case c = depth_case(format, samples);
          c.depth_test = cases::DepthTest::less;
          if (has_clear) c.depth_clear = 0.75F;
          add_plane(c, first / steps_of(format));
          add_plane(c, second / steps_of(format));
          Result<cases::Fragments> drawn = fragments_of(backend.draw(c));
          EXPECT_TRUE(drawn) << to_string(drawn.error());
          return drawn.value_or(cases::Fragments());
        };
        const auto count = 256 * static_cast<std::size_t>(samples);
        // The second is nearer, but is stored as the same number.
        cases::Fragments drawn = drawn_of(30000.4, 30000.1);
        EXPECT_EQ(drawn.triangle, std::vector<std::uint32_t>(count, 0));
        EXPECT_EQ(drawn.depth,
                  std::vector<float>(count, static_cast<float>(30000 / steps_of(format))));
        drawn = drawn_of(30000.4, 29999.1);
        EXPECT_EQ(drawn.triangle, std::vector<std::uint32_t>(count, 1));
      }
    }
  }
  // An initial depth of 0.5 is stored as 32768, so 32767 is nearer but 32768 is not.
  for (const double nearer : {0.0, 1.0}) {
    cases::Case c = depth_case(cases::DepthFormat::unorm16);
    c.depth_test = cases::DepthTest::less;
    c.depth_clear = 0.5F;
    add_plane(c, (32768.25 - nearer) / steps_of(c.depth_format));
    const Result<cases::Fragments> drawn = fragments_of(backend.draw(c));
    ASSERT_TRUE(drawn);
    EXPECT_EQ(drawn->size(), nearer == 1 ? 256U : 0U);
  }
}

}  // namespace rastercheck::backends
