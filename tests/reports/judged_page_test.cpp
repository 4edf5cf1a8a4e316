// The page of a judged picture. Its viewer is tested in a browser (tests/browser/judged.test.js).

#include "reports/judged_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "reports/internal/viewer.h"
#include "tests/approved_file.h"
#include "tests/reports/sample_judged.h"

namespace rastercheck::reports::judged_page_test {
namespace {

using records::PixelVerdict;
using testing::HasSubstr;
using testing::Not;

std::string page_of(const JudgedPage& page) {
  const Result<std::string> text = judged_html(page);
  return text ? *text : to_string(text.error());
}

/// The page without the parts that it shares with report.html, and without the bytes of pictures,
/// which differ between versions of zlib.
std::string without_viewer(std::string text) {
  for (const std::string& part : {viewer_scripts(), viewer_policy(), std::string(kViewerStyle)}) {
    if (const std::size_t at = text.find(part); at != std::string::npos) {
      text.erase(at, part.size());
    }
  }
  const std::string start = "base64,";
  for (std::size_t at = 0; (at = text.find(start, at)) != std::string::npos;) {
    at += start.size();
    text.erase(at, text.find('"', at) - at);
  }
  return text;
}

/// A page without parts, for a picture of this size that has no wrong pixel.
JudgedPage right_page(int width, int height) {
  JudgedPage page = sample_judged();
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  page.view.size = {width, height, 1};
  page.picture.width = width;
  page.picture.height = height;
  page.picture.values.assign(pixels * 2, 0.5F);
  page.judged = records::JudgedPicture();
  page.judged.width = width;
  page.judged.height = height;
  page.judged.pixels.assign(pixels, PixelVerdict::right);
  page.judged.steps.assign(pixels, 0);
  page.judged.counts[0] = pixels;
  page.parts.clear();
  return page;
}

TEST(JudgedPage, IsWhatWasApproved) {
  EXPECT_TRUE(is_approved(without_viewer(page_of(sample_judged())),
                          RASTERCHECK_SOURCE_DIR "/tests/reports/approved/judged.html"));
}

TEST(JudgedPage, BeginsWithTheVerdictAndThePixelThatIsFarthestOff) {
  JudgedPage page = sample_judged();
  page.judged.worst.erase(page.judged.worst.begin());
  const std::string text = page_of(page);
  EXPECT_THAT(text, HasSubstr("<h1 class=\"violated\">Wrong: 5 of 8 pixels</h1>"));
  EXPECT_THAT(text, HasSubstr("Farthest off is <b>pixel (0, 0)</b>, wrong value: R was drawn as "
                              "0.141 and must be 0.161 to 0.165 (36, not 41 to 42, of 255); "
                              "<strong>off by 5 steps</strong>, compared with triangle 0."));
  EXPECT_THAT(text,
              HasSubstr("&#39;a &lt;case&gt;.json&#39; --backend cpu --pixel 0,0 --triangle 0"));
  EXPECT_THAT(text, HasSubstr("on a grid of 1/256 pixel, either neighbour, after an error of up to "
                              "0.25 grid units"));
}

// `explain` takes the framebuffer's pixel. In a flipped file, y and the row run opposite ways.
TEST(JudgedPage, NamesTheFramebuffersPixelInCommands) {
  JudgedPage page = sample_judged();
  page.view.is_flipped = true;
  EXPECT_THAT(page_of(page), HasSubstr("--pixel 3,1 --triangle 0"));
}

TEST(JudgedPage, SaysWhatWasNotJudgedAndWhy) {
  JudgedPage page = right_page(4, 2);
  EXPECT_THAT(page_of(page), HasSubstr("<h1 class=\"held\">Right: all 8 pixels</h1>"));
  EXPECT_THAT(page_of(page), HasSubstr("Every pixel was judged."));
  page.judged.pixels[3] = PixelVerdict::not_judged;
  page.judged.counts = {7, 0, 0, 0, 0, 0, 1};
  page.judged.unpromised_triangles = 2;
  const std::string text = page_of(page);
  EXPECT_THAT(text,
              HasSubstr("<h1 class=\"mixed\">Not judged: 1 of 8 pixels; the others are right"));
  EXPECT_THAT(text, HasSubstr("1 pixel was not judged. Nothing is promised about 2 triangles"));
}

TEST(JudgedPage, LetsNoTextBecomeMarkup) {
  const std::string text = without_viewer(page_of(sample_judged()));
  EXPECT_THAT(text, HasSubstr("“a &lt;case&gt;”"));
  for (const char* raw : {"a <case>", "<somebody>", "a <picture>", "u<v"}) {
    EXPECT_THAT(text, Not(HasSubstr(raw))) << raw;
  }
}

// Kills: not shrinking a picture of noise, which PNG cannot compress.
TEST(JudgedPage, StaysSmallForALargePicture) {
  JudgedPage page = right_page(1920, 1080);
  std::uint32_t state = 1;
  for (float& value : page.picture.values) {
    state = state * 1664525U + 1013904223U;
    value = static_cast<float>(state >> 24U) / 255.0F;
  }
  page.judged.pixels[1919] = PixelVerdict::missing;
  page.judged.steps[1919] = 3;
  const std::string text = page_of(page);
  EXPECT_LT(text.size(), 3'000'000U);
  EXPECT_THAT(text, HasSubstr("Shown smaller: 1 pixel for"));
}

}  // namespace
}  // namespace rastercheck::reports::judged_page_test
