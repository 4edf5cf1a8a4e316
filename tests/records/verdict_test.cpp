#include "records/verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace rastercheck::records::verdict_test {
namespace {

constexpr std::array kReasons{Reason::inside,    Reason::tie,           Reason::snapping,
                              Reason::clip_edge, Reason::nonpositive_w, Reason::depth,
                              Reason::outside,   Reason::clipped,       Reason::viewport,
                              Reason::culled,    Reason::degenerate};

// Output files contain these words, so changing one breaks their readers.
TEST(Verdict, HasTheWordsOfTheOutputFormat) {
  EXPECT_EQ(to_string(Verdict::required), "required");
  EXPECT_EQ(to_string(Verdict::forbidden), "forbidden");
  EXPECT_EQ(to_string(Verdict::permitted), "permitted");
}

TEST(Reason, HasTheWordsOfTheOutputFormat) {
  EXPECT_EQ(to_string(Reason::inside), "inside");
  EXPECT_EQ(to_string(Reason::tie), "tie");
  EXPECT_EQ(to_string(Reason::snapping), "snapping");
  EXPECT_EQ(to_string(Reason::clip_edge), "clip edge");
  EXPECT_EQ(to_string(Reason::nonpositive_w), "w <= 0");
  EXPECT_EQ(to_string(Reason::depth), "depth");
  EXPECT_EQ(to_string(Reason::outside), "outside");
  EXPECT_EQ(to_string(Reason::clipped), "clipped");
  EXPECT_EQ(to_string(Reason::viewport), "viewport");
  EXPECT_EQ(to_string(Reason::culled), "culled");
  EXPECT_EQ(to_string(Reason::degenerate), "degenerate");
}

TEST(Reason, NoTwoShareAWord) {
  std::set<std::string_view> words;
  for (const Reason reason : kReasons) words.insert(to_string(reason));
  EXPECT_EQ(words.size(), kReasons.size());
}

// The words are used unquoted in JSON strings, tables and HTML attributes.
TEST(Reason, WordsAreShortPlainAscii) {
  for (const Reason reason : kReasons) {
    const std::string_view word = to_string(reason);
    EXPECT_FALSE(word.empty());
    EXPECT_TRUE(std::all_of(word.begin(), word.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || c == ' ' || c == '<' || c == '=' || c == '0';
    })) << word;
  }
}

}  // namespace
}  // namespace rastercheck::records::verdict_test
