// A probe finds what rasterizers of other kinds than a GPU promise: depth tests of another
// function, triangles left out instead of clipped, guard bands about the viewport, conservative
// coverage, depths on one side. The backends are `cpu`, bent to draw so.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "backends/factory.h"
#include "properties/probing/probe.h"
#include "tests/properties/probing/bent.h"

namespace rastercheck::properties::contract_members_test {
namespace {

using cases::Case;
using cases::ClipVertex;
using cases::Contract;

records::Probe probed(backends::Backend& backend, const cases::Coverage& coverage) {
  ProbeOptions options;
  options.cases = 2;
  options.asked = {coverage, cases::Basis::ideal, cases::TieRule::top_left};
  Result<records::Probe> result = probe("bent", backend, options, {});
  EXPECT_TRUE(result.has_value()) << to_string(result.error());
  return std::move(result).value_or(records::Probe());
}

records::Measured row_of(const records::Probe& probe, const std::string& what) {
  for (const records::Measured& row : probe.rows) {
    if (row.what == what) return row;
  }
  return {what, "", "no such row", ""};
}

/// Makes triangles degenerate that have a vertex for which `is_beyond` holds.
Bending leaving_out(const std::function<bool(const Case& c, const ClipVertex& p)>& is_beyond) {
  Bending bending;
  bending.before = [is_beyond](Case c) {
    for (cases::Triangle& t : c.triangles) {
      const bool is_out = std::any_of(t.begin(), t.end(), [&](std::uint32_t vertex) {
        return is_beyond(c, c.positions[vertex]);
      });
      if (is_out) t = {t[0], t[0], t[0]};
    }
    return c;
  };
  return bending;
}

bool is_beyond_planes(const Case& c, const ClipVertex& p) {
  const float near = c.rules == cases::Rules::opengl ? -p.w : 0.0F;
  return !(p.w > 0) || p.z < near || p.z > p.w;
}

// Kills: a probe that believes in `less`.
TEST(DepthTestOf, AReversedBackendIsGreater) {
  Bending bending;
  bending.before = [](Case c) {
    // z' = w − z turns depths of the other rules around.
    for (ClipVertex& p : c.positions) {
      p.z = c.rules == cases::Rules::opengl ? -p.z : p.w - p.z;
    }
    c.depth_clear.reset();
    return c;
  };
  bending.after = [](cases::Fragments& drawn) {
    for (float& depth : drawn.depth) depth = 1 - depth;
  };
  Bent backend(bending);
  const records::Probe probe = probed(backend, cases::Coverage());
  EXPECT_EQ(row_of(probe, "depth test").measured, "greater");
  EXPECT_TRUE(row_of(probe, "depth test").contradicts);
  EXPECT_EQ(probe.terms.depth_function, cases::KeptDepth::greater);
}

TEST(DepthTestOf, CpuIsLess) {
  const auto cpu = backends::make_backend("cpu");
  const records::Probe probe = probed(**cpu, cases::Coverage());
  EXPECT_EQ(row_of(probe, "depth test").measured, "less");
  EXPECT_FALSE(probe.terms.depth_function);
  EXPECT_EQ(row_of(probe, "triangles that a plane cuts").measured, "clipped");
  EXPECT_FALSE(row_of(probe, "triangles that a plane cuts").contradicts);
  EXPECT_FALSE(probe.terms.culls_instead_of_clipping);
}

TEST(CutTriangles, AreLeftOutByABackendThatDoesNotClip) {
  Bent backend(leaving_out(&is_beyond_planes));
  const records::Probe probe = probed(backend, cases::Snapping{8});
  EXPECT_EQ(row_of(probe, "triangles that a plane cuts").measured, "left out");
  EXPECT_TRUE(row_of(probe, "triangles that a plane cuts").contradicts);
  EXPECT_EQ(probe.terms.culls_instead_of_clipping, true);
}

// As a console does: whatever is 64 pixels outside the viewport is left out.
TEST(GuardBand, LiesAboutTheViewportIfItIsMeasuredThere) {
  Bent backend(leaving_out([](const Case& c, const ClipVertex& p) {
    constexpr float kBeyond = 64;
    const auto is_far = [&](float clip, float size) {
      const float pixels = (clip / p.w / 2 + 0.5F) * size;
      return pixels < -kBeyond || pixels > size + kBeyond;
    };
    return is_beyond_planes(c, p) || is_far(p.x, c.viewport.width) ||
           is_far(p.y, c.viewport.height);
  }));
  const records::Probe probe = probed(backend, cases::Snapping{8});
  EXPECT_EQ(row_of(probe, "guard band").measured, "64 pixels beyond the viewport");
  EXPECT_EQ(probe.terms.guard_beyond_viewport, 64.0F);
}

TEST(ConservativeCoverage, IsKeptByCpu) {
  const auto outer = backends::make_backend("cpu:conservative=outer");
  const records::Probe probe = probed(**outer, cases::Snapping{8});
  EXPECT_THAT(row_of(probe, "conservative coverage").measured, ::testing::StartsWith("outer"));
  EXPECT_FALSE(row_of(probe, "conservative coverage").contradicts);
  EXPECT_FALSE(probe.terms.conservative);
  EXPECT_EQ(row_of(probe, "tie rule").measured, "no such row");
}

TEST(ConservativeCoverage, IsNotKeptByOneThatCoversSamples) {
  Bent backend({});
  backend.declares = [](Contract& contract) {
    contract.conservative = cases::Conservative{cases::ConservativeKind::inner};
  };
  const records::Probe probe = probed(backend, cases::Coverage());
  EXPECT_EQ(row_of(probe, "conservative coverage").measured, "not kept");
  EXPECT_TRUE(probe.terms.conservative && !*probe.terms.conservative);
  EXPECT_NE(row_of(probe, "tie rule").measured, "no such row");
}

// `cpu` rounds to the nearest float, which may be nearer than the exact depth.
TEST(SideOfDepth, IsNotKeptByOneThatRoundsToTheNearest) {
  Bent backend({});
  backend.declares = [](Contract& contract) {
    contract.depth_error = cases::DepthError::never_nearer;
  };
  const records::Probe probe = probed(backend, cases::Coverage());
  EXPECT_EQ(row_of(probe, "side of depth").measured, "not kept");
  EXPECT_EQ(probe.terms.depth_error, cases::DepthError::either_side);
}

}  // namespace
}  // namespace rastercheck::properties::contract_members_test
