#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
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

/// Checks what a figure says about its source. The figure's name begins with the number of the text
/// (docs/bibliography.md).
std::string source_of(const std::string& name) {
  const std::map<std::string, std::string> texts{
      {"000", "Appendix 5"},        {"001", "Rasterization"}, {"002", "Moreton"},
      {"003", "varying variables"}, {"004", "MIT 6.837"},     {"005", "OpenGL"}};
  return texts.at(name.substr(0, 3));
}

// Kills: a figure that does not name its source; two pictures in one file.
TEST(Figures, SayWhatTheyAreOfAndShow) {
  std::set<std::string> names;
  ASSERT_EQ(small_gallery().size(), figures().size());
  for (std::size_t i = 0; i < figures().size(); ++i) {
    const reports::GalleryFigure& figure = small_gallery()[i];
    const std::string name(figures()[i].name);
    EXPECT_NE(figure.title, "") << name;
    EXPECT_THAT(figure.source, testing::HasSubstr(source_of(name))) << name;
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
