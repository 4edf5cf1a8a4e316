#include "records/judged.h"

#include <gtest/gtest.h>

namespace rastercheck::records::judged_test {
namespace {

/// 10 correct fragments, 2 of another class, and 3 that were not judged.
ErrorStatistics some() {
  ErrorStatistics errors;
  errors.classes[FragmentClass::correct] = 10;
  errors.classes[FragmentClass::beyond_bound] = 2;
  errors.not_judged[NotJudged::without_bound] = 3;
  return errors;
}

TEST(Judged, CountsValuesAndWhatIsNotJudgedOfThem) {
  Judged judged;
  add(judged, AttributeKind::smooth, some());
  add(judged, AttributeKind::depth, some());
  EXPECT_EQ(judged, (Judged{0, 0, 0, 24, {{"without bound", 6}}}));
  EXPECT_EQ(judged.all_not_judged(), 6U);
  EXPECT_EQ(judged.share_not_judged(), 6.0 / 30);
}

// Kills: counting fragments as judged because they have a class.
TEST(Judged, CountsFragmentsThatAreNotJudgedOnce) {
  Judged judged;
  add(judged, AttributeKind::coverage, some());
  EXPECT_EQ(judged, (Judged{0, 0, 9, 0, {{"without bound", 3}}}));
}

TEST(Judged, AddsUp) {
  Judged all{5, 4, 100, 200, {{"undefined", 1}}};
  merge(all, {1, 1, 10, 20, {{"left free", 1500}, {"undefined", 2}}});
  EXPECT_EQ(all, (Judged{6, 5, 110, 220, {{"left free", 1500}, {"undefined", 3}}}));
  EXPECT_EQ(not_judged_words(all), "1,500 left free, 3 undefined");
  EXPECT_EQ(not_judged_words({}), "");
  EXPECT_EQ(Judged().share_not_judged(), 0);
}

}  // namespace
}  // namespace rastercheck::records::judged_test
