#include "cases/error.h"

#include <gtest/gtest.h>

namespace rastercheck::error_test {
namespace {

TEST(ErrorText, LeavesOutWhatIsEmpty) {
  EXPECT_EQ(to_string(Error{"a.json", "/b", "c"}), "a.json: /b: c");
  EXPECT_EQ(to_string(Error{"a.json", "", "c"}), "a.json: c");
  EXPECT_EQ(to_string(Error{"", "", "c"}), "c");
}

// Kills: leaving the parts of an error unescaped that quote text from outside.
TEST(ErrorText, IsOneLineWhateverItQuotes) {
  EXPECT_EQ(to_string(Error{"a\nb", "/c\x1b", "d\r\xc2\x85"}), "a\\nb: /c\\u001b: d\\r\\u0085");
}

}  // namespace
}  // namespace rastercheck::error_test
