// Tests the promises of the backends `method:NAME` against results by hand.

#include <gtest/gtest.h>

#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::backends::method_test {
namespace {

/// A case with one triangle and 2×2 pixels.
cases::Case small_case(const cases::ClipVertex& a, const cases::ClipVertex& b,
                       const cases::ClipVertex& c) {
  cases::Case made;
  made.framebuffer = {2, 2, 1};
  made.viewport.width = 2;
  made.viewport.height = 2;
  made.positions = {a, b, c};
  made.triangles = {{0, 1, 2}};
  return made;
}

cases::Contract contract_of(const char* name, const cases::Case& c) {
  return (*make_backend(name))->contract(c);
}

TEST(MethodContract, OfAnOrdinaryTriangleGrantsTheLeast) {
  const cases::Case c = small_case({-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1});
  const cases::Contract contract = contract_of("method:rational-linear", c);
  EXPECT_EQ(contract.clip_tolerance, 1);
  // 1/2 + 2^-22, and a little for clipping, rounded up to a float.
  EXPECT_EQ(contract.bounds.smooth.constant, 0.5F + 0x1p-22F + 0x1p-24F);
  EXPECT_EQ(contract.coverage->position_error, 0x1p-8F);
  EXPECT_EQ(contract.claims, cases::Claim::perspective);
}

// By hand: for the vertices a = (−1/2, −2^-65, −3/2), b = (1, 1/4, 1), c = (−1, −1/2, 1), given as
// (x, y, w), the sum 2 a + 2 b + c is 0 except for −2^-64 in y. So the part of the triangle that
// clipping leaves lies about 2^-65 from the eye, which doubles of ordinary size cannot resolve.
// Kills: granting the tolerance of ordinary triangles if the plane almost passes through the eye.
TEST(MethodContract, OfATriangleAllButThroughTheEyeGrantsAnything) {
  const cases::Case c =
      small_case({-0.5F, -0x1p-65F, 0, -1.5F}, {1, 0.25F, 0, 1}, {-1, -0.5F, 0, 1});
  EXPECT_EQ(contract_of("method:rational-linear", c).clip_tolerance, 0x1p480);
}

// On the edge from (2^78, 1) to (−2^66, −2^53), the w = y/2^10 of a new vertex is the difference of
// two products that agree in 53 digits. Kills: a bounded tolerance for vertices whose w may have
// any sign.
TEST(MethodContract, OfATriangleOfHugeCoordinatesGrantsAnything) {
  const cases::Case c =
      small_case({-1, 0x1p100F, 0, 1}, {0x1p78F, 1, 0, 1}, {-0x1p66F, -0x1p53F, 0, 1});
  EXPECT_EQ(contract_of("method:rational-linear", c).clip_tolerance, 0x1p480);
}

// Kills: a NaN, from 0 times infinity.
TEST(MethodContract, OfAViewportWithoutAreaIsANumber) {
  cases::Case c = small_case({-1, 0x1p100F, 0, 1}, {0x1p78F, 1, 0, 1}, {-0x1p66F, -0x1p53F, 0, 1});
  c.viewport.width = 0;
  c.viewport.height = 0;
  EXPECT_EQ(contract_of("method:rational-linear", c).clip_tolerance, 0x1p480);
}

// The method clips at 1024 half heights, which are few pixels here. The contract's band is as wide
// along y as along x.
TEST(MethodContract, OfAVertexThatOnlyTheMethodClipsGrantsTheClipTolerance) {
  cases::Case c = small_case({-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 0x1p30F, 0, 1});
  c.viewport.width = 16384;
  c.viewport.height = 0x1p-10F;
  const cases::Contract contract = contract_of("method:rational-linear", c);
  EXPECT_GT(contract.coverage->position_error, 1);
  EXPECT_EQ(contract.clip_tolerance, 0);
}

// A triangle that crosses the eye's plane well away from the eye is as certain as any other.
TEST(MethodContract, OfATriangleWellPastTheEyeGrantsTheLeast) {
  const cases::Case c = small_case({-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 2, 0, -1});
  const cases::Contract contract = contract_of("method:rational-linear", c);
  EXPECT_EQ(contract.clip_tolerance, 1);
  EXPECT_LT(contract.bounds.smooth.constant, 0.51F);
}

TEST(MethodContract, SaysWhatAMethodClaims) {
  const cases::Case c = small_case({-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1});
  const cases::Contract contract = contract_of("method:screen-linear", c);
  EXPECT_EQ(contract.claims, cases::Claim::affine);
  EXPECT_FALSE(contract.coverage);
  EXPECT_GT(contract.bounds.smooth.per_condition, 0);
  EXPECT_GT(contract.bounds.smooth.constant, 0.5F);  // 1/2 + 2^-29 is no float
}

}  // namespace
}  // namespace rastercheck::backends::method_test
