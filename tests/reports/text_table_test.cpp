#include "reports/text_table.h"

#include <gtest/gtest.h>

namespace rastercheck::reports::text_table_test {
namespace {

TEST(TextTable, HasColumnsAsWideAsTheirWidestCell) {
  EXPECT_EQ(text_table({{"law", "of"}, {"a longer one", "cpu", "held"}}),
            "law           of\n"
            "a longer one  cpu  held\n");
  EXPECT_EQ(text_table({}), "");
}

// Kills: measuring widths in bytes.
TEST(TextTable, CountsCharacters) {
  EXPECT_EQ(text_table({{"≤ 1", "x"}, {"abcd", "y"}}), "≤ 1   x\nabcd  y\n");
}

// Kills: leaving it to the terminal to break rows.
TEST(TextTable, IsEntriesWhereItIsWiderThanTheTerminal) {
  const std::vector<std::vector<std::string>> rows{
      {"  law", "worst ULP", "p99", "", "verdict"},
      {"  values at vertices", "≤ 0.5", "–", "and so on", "held"},
      {"  all", "", "-", "", ""}};
  const std::string whole =
      "  law                 worst ULP  p99             verdict\n"
      "  values at vertices  ≤ 0.5      –    and so on  held\n"
      "  all                            -\n";
  EXPECT_EQ(text_table(rows, std::nullopt), whole);
  EXPECT_EQ(text_table(rows, 56), whole);
  EXPECT_EQ(text_table(rows, 55),
            "  values at vertices\n"
            "    worst ULP: ≤ 0.5; and so on; verdict: held\n"
            "  all\n");
  EXPECT_EQ(text_table(rows, 32),
            "  values at vertices\n"
            "    worst ULP: ≤ 0.5; and so on;\n"
            "    verdict: held\n"
            "  all\n");
  EXPECT_EQ(text_table({}, 10), "");
  EXPECT_EQ(text_table({{"law", "of"}, {"", "x"}}, 3), "\n  of:\n  x\n");
}

TEST(TextTable, EndsNoLineWithSpaces) {
  EXPECT_EQ(text_table({{"a", ""}, {"b", "c"}}), "a\nb  c\n");
}

}  // namespace
}  // namespace rastercheck::reports::text_table_test
