#include "oracle/transform.h"

#include <gtest/gtest.h>

#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::transform_test {
namespace {

using cases::ClipVertex;

cases::Case with_projection(const cases::Matrix4& projection, const ClipVertex& first) {
  cases::Case c = small_case(cases::Rules::vulkan, 4, 4, {{first, {0, 0, 0, 1}, {1, 0, 0, 1}}});
  c.camera.emplace();
  c.camera->projection = projection;
  return c;
}

TEST(Transform, MultipliesRowsByTheColumnOfThePosition) {
  const auto c =
      with_projection({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}, {1, 2, 3, 1});
  const auto clip = to_clip_case(c, "f");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->positions[0], (ClipVertex{18, 46, 74, 102}));
  EXPECT_FALSE(clip->camera);
}

TEST(Transform, AppliesModelThenViewThenProjection) {
  auto c = with_projection({2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 0, 0, 1});
  c.camera->view = {1, 0, 0, 10, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // x + 10
  c.camera->model = {3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // 3 x
  EXPECT_EQ(to_clip_case(c, "f")->positions[0].x, 2 * (3 * 1 + 10));
}

TEST(Transform, RoundsOnceToEven) {
  // 1 + 2^-24 is a tie, which rounds to 1; 2^-60 more is not a tie. A sum in float32 would give 1
  // for both.
  const auto tie =
      with_projection({1, 0x1p-24F, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 1, 0, 1});
  EXPECT_EQ(to_clip_case(tie, "f")->positions[0].x, 1.0F);
  const auto above =
      with_projection({1, 0x1p-24F, 0x1p-60F, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 1, 1, 1});
  EXPECT_EQ(to_clip_case(above, "f")->positions[0].x, 0x1.000002p0F);
}

TEST(Transform, KeepsSubnormals) {
  const auto c = with_projection({0x1p-100F, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                 {0x1p-49F, 0, 0, 1});
  EXPECT_EQ(to_clip_case(c, "f")->positions[0].x, 0x1p-149F);
}

TEST(Transform, RefusesOverflowAtTheVertex) {
  const auto c =
      with_projection({1, 0, 0, 0, 0x1p127F, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {2, 0, 0, 1});
  const auto clip = to_clip_case(c, "scene.json");
  ASSERT_FALSE(clip);
  EXPECT_EQ(to_string(clip.error()),
            "scene.json: /vertices/0/position: its clip y overflows float32");
}

TEST(Transform, LeavesAClipCaseAsItIs) {
  const auto c = small_case(cases::Rules::d3d, 4, 4, {{{1, 2, 3, 4}, {0, 0, 0, 1}, {1, 0, 0, 1}}});
  EXPECT_EQ(to_clip_case(c, "f").value(), c);
}

}  // namespace
}  // namespace rastercheck::oracle::transform_test
