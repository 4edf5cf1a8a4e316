#include "reports/gallery_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace rastercheck::reports::gallery_page_test {
namespace {

using testing::HasSubstr;
using testing::Not;

GalleryPicture picture() {
  GalleryPicture p;
  p.name = "000-small";
  p.title = "<small>";
  p.method = "method:a&b";
  p.picture = Image::filled(2, 2, {1, 2, 3});
  p.errors = Image::filled(2, 2, {4, 5, 6});
  p.scale = &texel_scale();
  p.worst = 12.341;
  p.p99 = 0;
  p.samples = 1234;
  return p;
}

std::string page_of(const GalleryPicture& picture) {
  GalleryFigure figure;
  figure.title = "A & B";
  figure.source = "seed <000>";
  figure.sentences = {"One > none."};
  figure.pictures = {picture};
  return gallery_html(std::vector<GalleryFigure>{figure}).value();
}

// Kills: texts that are not escaped; numbers rounded down; a picture without its errors.
TEST(GalleryHtml, ShowsAPictureBesideItsErrors) {
  const std::string page = page_of(picture());
  for (const char* part :
       {"<h2>A &amp; B</h2>", "seed &lt;000&gt;", "<p>One &gt; none.</p>", "&lt;small&gt;",
        "<code>method:a&amp;b</code>", "≤ 12.4 texels", "<dd>0 texels</dd>", "1,234",
        "alt=\"&lt;small&gt;, its errors\"", "class=\"legend\""}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  EXPECT_THAT(page, Not(HasSubstr("not as promised")));
}

// Kills: a script, a style sheet, a font or a picture from elsewhere.
TEST(GalleryHtml, NeedsNothingElse) {
  const std::string page = page_of(picture());
  for (const char* from_elsewhere : {"<script", "<link", "http:", "https:", "@import", "file:"}) {
    EXPECT_THAT(page, Not(HasSubstr(from_elsewhere)));
  }
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,"));
}

TEST(GalleryHtml, SaysWhatIsMissing) {
  GalleryPicture missing;
  missing.title = "Quadratic";
  missing.missing = "method:polynomial-quadratic is not in this version";
  const std::string page = page_of(missing);
  EXPECT_THAT(page, HasSubstr("method:polynomial-quadratic is not in this version."));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
}

TEST(GalleryHtml, SaysWhatIsNotAsPromised) {
  GalleryPicture wrong = picture();
  wrong.violations = 1;
  EXPECT_THAT(page_of(wrong), HasSubstr("1 sample"));
}

// The page contains a strip once, and each frame shows its part. Kills: frames off by one.
TEST(GalleryHtml, ShowsEveryFrameOfAStrip) {
  GalleryPicture strip = picture();
  strip.frames = 3;
  strip.picture = Image::filled(6, 2, {1, 2, 3});
  const std::string page = page_of(strip);
  for (const char* place : {"background-position:0.000% 0", "background-position:50.000% 0",
                            "background-position:100.000% 0"}) {
    EXPECT_THAT(page, HasSubstr(place));
  }
  const std::size_t first = page.find("data:image/png");
  const std::size_t second = page.find("data:image/png", first + 1);
  EXPECT_EQ(page.find("data:image/png", second + 1), std::string::npos);
  EXPECT_THAT(page, HasSubstr("--frames:3;"));
}

TEST(GalleryHtml, RefusesWhatIsNoPicture) {
  GalleryPicture none = picture();
  none.errors = {};
  GalleryFigure figure;
  figure.pictures = {none};
  EXPECT_FALSE(gallery_html(std::vector<GalleryFigure>{figure}).has_value());
}

}  // namespace
}  // namespace rastercheck::reports::gallery_page_test
