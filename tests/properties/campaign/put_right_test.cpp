#include "properties/campaign/internal/put_right.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

#include "backends/factory.h"
#include "properties/campaign/sabotage.h"

namespace rastercheck::properties::put_right_test {
namespace {

using records::DrawnPart;

/// A triangle of 6 samples in a target of 4 × 4 pixels; its attribute is its window x.
cases::ClipCase small_case() {
  cases::Case c;
  c.framebuffer = {4, 4, 1};
  c.viewport = {0, 0, 4, 4, 0, 1};
  c.positions = {{-1, -1, 0, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0, 1}};
  c.attributes = {{"x"}};
  c.attribute_values = {0, 4, 0};
  c.triangles = {{0, 1, 2}};
  return cases::ClipCase(c);
}

class PutRight : public testing::Test {
 protected:
  PutRight()
      : backend_(*backends::make_backend("cpu")),
        right_(backend_->draw(case_).value()),
        drawn_(right_.fragments) {}

  bool is_wrong(const JudgeRequest& request = {}) const {
    return has_wrong(case_, right_.contract, drawn_, request);
  }
  void put(const DrawnParts& parts) { put_right(case_, right_.contract, parts, drawn_); }
  void erase_first() {
    drawn_.triangle.erase(drawn_.triangle.begin());
    drawn_.x.erase(drawn_.x.begin());
    drawn_.y.erase(drawn_.y.begin());
    drawn_.sample.erase(drawn_.sample.begin());
    drawn_.depth.erase(drawn_.depth.begin());
    drawn_.attributes.erase(drawn_.attributes.begin());
    drawn_.derivatives.clear();
  }

  cases::ClipCase case_ = small_case();
  std::unique_ptr<backends::Backend> backend_;
  backends::Drawn right_;
  cases::Fragments drawn_;
};

TEST_F(PutRight, LeavesARightDrawingAsItIs) {
  put({DrawnPart::coverage, DrawnPart::depth, DrawnPart::values});
  EXPECT_EQ(drawn_.triangle, right_.fragments.triangle);
  EXPECT_EQ(drawn_.attributes, right_.fragments.attributes);
  EXPECT_EQ(drawn_.derivatives, right_.fragments.derivatives);
}

TEST_F(PutRight, PutsInWhatIsMissing) {
  erase_first();
  ASSERT_TRUE(is_wrong());
  put({DrawnPart::depth, DrawnPart::values});
  EXPECT_TRUE(is_wrong());
  put({DrawnPart::coverage});
  EXPECT_FALSE(is_wrong());
  EXPECT_EQ(drawn_.x, right_.fragments.x);
  EXPECT_EQ(drawn_.y, right_.fragments.y);
}

TEST_F(PutRight, TakesOutWhatIsTooMuch) {
  drawn_.x.back() = 3;
  drawn_.y.back() = 3;
  put({DrawnPart::coverage});
  EXPECT_FALSE(is_wrong());
  EXPECT_EQ(drawn_.size(), right_.fragments.size());
  EXPECT_EQ(drawn_.x, right_.fragments.x);
}

// Kills: removing both fragments of a sample that is drawn twice.
TEST_F(PutRight, LeavesOneOfTwo) {
  drawn_.x[1] = drawn_.x[0];
  drawn_.y[1] = drawn_.y[0];
  put({DrawnPart::coverage});
  EXPECT_EQ(drawn_.x, right_.fragments.x);
  EXPECT_EQ(drawn_.y, right_.fragments.y);
}

TEST_F(PutRight, MendsOnlyThePartsThatItIsTold) {
  drawn_.depth[2] = 0.75F;
  drawn_.attributes[1] = std::numeric_limits<float>::quiet_NaN();
  put({DrawnPart::depth});
  EXPECT_EQ(drawn_.depth[2], right_.fragments.depth[2]);
  EXPECT_TRUE(std::isnan(drawn_.attributes[1]));
  put({DrawnPart::values});
  EXPECT_EQ(drawn_.attributes[1], right_.fragments.attributes[1]);
}

TEST_F(PutRight, OfNoPartChangesNothing) {
  erase_first();
  const std::size_t size = drawn_.size();
  put({});
  EXPECT_EQ(drawn_.size(), size);
}

// Kills: correcting a fault that was not asked for along with one that was.
TEST_F(PutRight, LeavesWhatIsNotMeant) {
  erase_first();
  drawn_.depth.back() = 7;
  put_right(
      case_, right_.contract,
      [](const records::Violation& violation) {
        return violation.fragment_class == records::FragmentClass::missing;
      },
      drawn_);
  EXPECT_EQ(drawn_.triangle, right_.fragments.triangle);
  EXPECT_EQ(drawn_.depth.back(), 7);
}

// Kills: a sample left empty because the fragment that hid it is removed, which is another failure
// than the known one.
TEST(PutRightWithDepthTest, PutsInWhatWasHidden) {
  cases::Case c = small_case();
  c.depth_test = cases::DepthTest::less;
  c.positions.insert(c.positions.end(), {{-1, -1, 0.5F, 1}, {3, -1, 0.5F, 1}, {-1, 3, 0.5F, 1}});
  c.positions[1].z = 0;
  c.attribute_values = {0, 4, 0, 0, 8, 0};
  c.triangles = {{0, 1, 2}, {3, 4, 5}};
  const cases::ClipCase clip(c);
  const auto backend = *backends::make_backend("cpu");
  const backends::Drawn right = backend->draw(clip).value();
  cases::Fragments drawn = right.fragments;
  std::size_t last = drawn.size();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn.triangle[i] == 1) last = i;
  }
  ASSERT_LT(last, drawn.size());
  // The nearer triangle is drawn in a place that it does not cover, in place of the other triangle.
  drawn.triangle[last] = 0;
  drawn.depth[last] = 0;
  put_right(
      clip, right.contract,
      [](const records::Violation& violation) {
        return violation.fragment_class == records::FragmentClass::extra ||
               violation.fragment_class == records::FragmentClass::wrong_triangle;
      },
      drawn);
  EXPECT_FALSE(has_wrong(clip, right.contract, drawn, {}));
}

}  // namespace
}  // namespace rastercheck::properties::put_right_test
