#include "reports/internal/page.h"

#include <gtest/gtest.h>

namespace rastercheck::reports::page_test {
namespace {

using records::LawSummary;
using records::LawVerdict;

// As URLSearchParams writes and reads it.
TEST(LawLink, IsFormEncoded) {
  EXPECT_EQ(law_link("a law, 50% of it"), "property=a+law%2C+50%25+of+it");
  EXPECT_EQ(law_link("\"<&>+='\xc3\xa9"), "property=%22%3C%26%3E%2B%3D%27%C3%A9");
  EXPECT_EQ(law_link("a-b_c.d*9"), "property=a-b_c.d*9");
}

TEST(NumberCell, SaysWhereThereIsNothing) {
  EXPECT_EQ(number_cell("p99", "0.5"), "<td class=\"number\" data-name=\"p99\">0.5</td>");
  EXPECT_EQ(number_cell("p99", "–"), "<td class=\"number none\" data-name=\"p99\">–</td>");
}

TEST(VerdictWord, HasASign) {
  LawSummary row;
  EXPECT_EQ(verdict_word(row), "<span class=\"unchecked\">– not checked</span>");
  row.verdict = LawVerdict::held;
  EXPECT_EQ(verdict_word(row), "<span class=\"held\">✓ held</span>");
  row.verdict = LawVerdict::violated;
  row.cases.violations = 2;
  EXPECT_EQ(verdict_word(row), "<span class=\"violated\">✗ violated in 2 cases</span>");
}

}  // namespace
}  // namespace rastercheck::reports::page_test
