#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

#include "cli/gallery/figure.h"
#include "tests/cli/gallery/small_gallery.h"

namespace rastercheck::gallery::registry_test {
namespace {

TEST(Figures, AreInTheOrderOfTheirNames) {
  std::string_view before;
  EXPECT_GE(figures().size(), 8U);
  for (const Figure& figure : figures()) {
    EXPECT_LT(before, figure.name);
    before = figure.name;
  }
}

// Kills: a figure that does not say what it is of, and two pictures in one file.
TEST(Figures, SayWhatTheyAreOfAndShow) {
  std::set<std::string> names;
  ASSERT_EQ(small_gallery().size(), figures().size());
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const reports::GalleryFigure& figure = small_gallery()[i];
    const std::string name(figures()[i].name);
    EXPECT_NE(figure.title, "") << name;
    EXPECT_THAT(figure.source, testing::HasSubstr(name.substr(0, 3))) << name;
    EXPECT_FALSE(figure.sentences.empty()) << name;
    EXPECT_FALSE(figure.pictures.empty() && figure.plots.empty()) << name;
    for (const reports::GalleryPicture& picture : figure.pictures) {
      EXPECT_TRUE(names.insert(picture.name).second) << picture.name;
      EXPECT_THAT(picture.name, testing::StartsWith(name.substr(0, 3)));
      EXPECT_NE(picture.title, "");
    }
  }
}

}  // namespace
}  // namespace rastercheck::gallery::registry_test
