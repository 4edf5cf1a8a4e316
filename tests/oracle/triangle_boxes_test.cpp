// Boxes of pixels computed in doubles, against the exact truth of every sample.

#include "oracle/internal/triangle_boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>
#include <vector>

#include "tests/oracle/pictures.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::triangle_boxes_test {
namespace {

bool holds(const PixelBox& box, int x, int y) {
  return x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
}

// Kills: a triangle taken for culled that some placement turns round or a clip plane cuts; a box
// without the error of positions.
RC_GTEST_PROP(TriangleBoxes, HoldEverySampleThatIsNotForbidden, ()) {
  cases::Case c = two_triangles();
  c.cull = one_of({cases::Cull::none, cases::Cull::front, cases::Cull::back});
  cases::Contract contract = cases::contract_of(c);
  if (*rc::gen::arbitrary<bool>()) {
    contract.coverage = cases::Snapping{one_of({0, 4, 8}), cases::Rounding::unspecified,
                                        one_of({0.0F, 0.5F, 2.0F})};
    contract.basis =
        one_of({cases::Basis::ideal, cases::Basis::snapped, cases::Basis::unspecified});
  }
  const SceneTruth scene(c, contract);
  const std::vector<PixelBox> boxes = boxes_of_triangles(scene);
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const TriangleTruth truth(scene, t);
    const bool is_empty = boxes[t].x1 <= boxes[t].x0;
    RC_CLASSIFY(is_empty, "empty");
    for (int y = 0; y < c.framebuffer.height; ++y) {
      for (int x = 0; x < c.framebuffer.width; ++x) {
        if (holds(boxes[t], x, y)) continue;
        for (int s = 0; s < c.framebuffer.samples; ++s) {
          RC_ASSERT(truth.judge(x, y, s).verdict == records::Verdict::forbidden);
        }
      }
    }
  }
}

/// A triangle on 8 × 8 pixels with a side of 4 pixels along x; the third vertex is `height` pixels
/// from it. Of the two ways of culling, one leaves it out.
cases::Case thin_case(float height, cases::Cull cull) {
  cases::Case c = small_case(cases::Rules::vulkan, 8, 8,
                             {{{-0.5F, 0, 0.5F, 1}, {0.5F, 0, 0.5F, 1}, {0, height / 4, 0.5F, 1}}});
  c.cull = cull;
  return c;
}

/// The number of ways of culling that leave the case's triangle without a box.
int left_out(float height, const std::optional<cases::Snapping>& snapping, float z = 0.5F) {
  int count = 0;
  for (const cases::Cull cull : {cases::Cull::none, cases::Cull::front, cases::Cull::back}) {
    cases::Case c = thin_case(height, cull);
    c.positions[2].z = z;
    cases::Contract contract = cases::contract_of(c);
    contract.coverage = snapping;
    const PixelBox box = boxes_of_triangles(SceneTruth(c, contract)).at(0);
    count += box.x1 <= box.x0 || box.y1 <= box.y0 ? 1 : 0;
  }
  return count;
}

// If each vertex moves by up to 1/256 pixel, a height below 2/256 may be turned round. Three sides
// of 8 pixels in all, and twice the area is 4 h: from a little more than h = 2/256 on it may not.
TEST(TriangleBoxes, LeaveOutWhatIsCulledHoweverItIsPlaced) {
  const cases::Snapping snapping{8, cases::Rounding::unspecified, 0};
  EXPECT_EQ(left_out(3.0F / 256, snapping), 1);
  EXPECT_EQ(left_out(1.0F / 256, snapping), 0);
  EXPECT_EQ(left_out(1.0F / 256, std::nullopt), 1);
  EXPECT_EQ(left_out(0, std::nullopt), 0);
}

// A snapped triangle that is cut has new corners.
TEST(TriangleBoxes, KeepWhatIsCutUnlessItIsExact) {
  const cases::Snapping snapping{8, cases::Rounding::unspecified, 0};
  EXPECT_EQ(left_out(2, snapping, -0.5F), 0);
  EXPECT_EQ(left_out(2, std::nullopt, -0.5F), 1);
}

}  // namespace
}  // namespace rastercheck::oracle::triangle_boxes_test
