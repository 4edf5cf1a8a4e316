// Parts of judged pictures: which parts are chosen, and what they say about their pixels.

#include "oracle/picture_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "cases/drawn_picture.h"
#include "oracle/picture_judge.h"
#include "tests/oracle/drawing.h"
#include "tests/oracle/small_case.h"

namespace rastercheck::oracle::picture_parts_test {
namespace {

using records::JudgedPicture;
using records::PicturePart;
using records::PixelVerdict;

/// The verdicts of a large picture: right, except at the places passed to spoil().
class LargePicture {
 public:
  LargePicture() {
    judged_.width = 200;
    judged_.height = 100;
    judged_.pixels.assign(200 * 100, PixelVerdict::right);
    judged_.steps.assign(judged_.pixels.size(), 0);
    judged_.counts[0] = judged_.pixels.size();
  }

  void spoil(int x, int row, PixelVerdict verdict, float steps) {
    const auto place = static_cast<std::size_t>(row * judged_.width + x);
    judged_.pixels[place] = verdict;
    judged_.steps[place] = steps;
    --judged_.counts[0];
    ++judged_.counts[static_cast<std::size_t>(verdict)];
  }

  const JudgedPicture& judged() const { return judged_; }

 private:
  JudgedPicture judged_;
};

TEST(PictureParts, ALargePictureThatIsRightHasNone) {
  EXPECT_TRUE(choose_parts(LargePicture().judged()).empty());
}

// Kills: a frequent kind that displaces others; one part per neighbour; parts beyond the border.
TEST(PictureParts, ShowEveryKindOfWrongPixelTheFarthestOffFirst) {
  LargePicture picture;
  for (int x = 0; x < 200; ++x) picture.spoil(x, 50, PixelVerdict::missing, 100);
  picture.spoil(199, 99, PixelVerdict::wrong_value, 1);
  picture.spoil(198, 98, PixelVerdict::wrong_value, 2);
  const std::vector<PicturePart> parts = choose_parts(picture.judged());
  ASSERT_FALSE(parts.empty());
  EXPECT_LE(parts.size(), kMostParts);
  EXPECT_EQ(parts.front().row, 50);
  EXPECT_EQ(parts.back().x, 198);
  EXPECT_EQ(parts.back().row, 98);
  EXPECT_EQ(parts.back().left + parts.back().width, 200);
  EXPECT_EQ(parts.back().top + parts.back().height, 100);
}

/// A triangle over most of an 8 × 4 picture, whose attribute is a window position.
cases::Case ramp_case(cases::Rules rules) {
  return small_case(rules, 8, 4, {{{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}}},
                    {{{0}, {2}, {0}}});
}

// Kills: parts upside down; answers of other pixels; answers that are not sorted by distance.
TEST(PictureParts, AgreeWithTheJudge) {
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan}) {
    const cases::Case c = ramp_case(rules);
    const SceneTruth scene(c, cases::contract_of(c));
    const cases::PictureLayout layout;
    const cases::PictureFile plan = cases::planned_picture(c, layout);
    const auto view = cases::view_of(c, layout, plan, "picture");
    ASSERT_TRUE(view.has_value());
    cases::PictureFile picture = cases::picture_of(*view, plan, perfect(scene));
    picture.values[3] += 1;  // pixel (3, 0)
    const JudgedPicture judged = judge_picture(scene, *view, picture);
    std::vector<PicturePart> parts = choose_parts(judged);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].x, 3);
    EXPECT_EQ(parts[0].row, 0);
    detail_parts(scene, *view, picture, judged, parts);
    for (int row = 0; row < 4; ++row) {
      for (int x = 0; x < 8; ++x) {
        const records::DetailedPixel& pixel = parts[0].at(x, row);
        EXPECT_EQ(pixel.verdict == PixelVerdict::right, x != 3 || row != 0);
        EXPECT_EQ(pixel.stored[0], *picture.pixel(x, row));
        ASSERT_FALSE(pixel.answers.empty());
        EXPECT_EQ(pixel.answers[0].steps > 0, x == 3 && row == 0);
      }
    }
    EXPECT_EQ(judged.steps[3], static_cast<float>(judged.worst.at(0).steps));
    EXPECT_EQ(parts[0].at(3, 0).answers[0].steps, judged.worst[0].steps);
  }
}

}  // namespace
}  // namespace rastercheck::oracle::picture_parts_test
