#include "reports/internal/html.h"

#include <gtest/gtest.h>

namespace rastercheck::reports::html_test {
namespace {

TEST(Html, EscapesMarkup) {
  EXPECT_EQ(html("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(html("é – 日本\n\t/\\"), "é – 日本\n\t/\\");
  EXPECT_EQ(html(""), "");
}

TEST(Html, ReplacesWhatHasNoPlaceInAPage) {
  EXPECT_EQ(html("a\x01"
                 "b\x7f"),
            "a\uFFFDb\uFFFD");
  EXPECT_EQ(html("a\xff"), "a\uFFFD");
  EXPECT_EQ(html("a\xef\xbf\xbe\xef\xbf\xbf"
                 "b"),
            "a\uFFFD\uFFFDb");
}

}  // namespace
}  // namespace rastercheck::reports::html_test
