#include "reports/internal/report_laws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::report_laws_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string laws(const records::Run& run) {
  return properties_section(run, records::summarize(run));
}

// Kills: rows in the order of the properties; rows without figures.
TEST(Properties, TheMostUrgentComesFirst) {
  const std::string page = laws(sample_run());
  const std::size_t violated = page.find("✗ violated in 2 cases");
  const std::size_t thin = page.find("(✓) thin");
  const std::size_t held = page.find("✓ held");
  EXPECT_LT(violated, thin);
  EXPECT_LT(thin, held);
  EXPECT_NE(held, std::string::npos);
  EXPECT_THAT(page, Not(HasSubstr("not checked")));
}

// Kills: an id of two elements; a property whose sentence is not shown.
TEST(Properties, EachRowOpensWithItsFigures) {
  const std::string page = laws(sample_run());
  const std::string first =
      "<details class=\"property\" id=\"property=coverage+is+exact\" "
      "data-property=\"coverage is exact\">\n<summary>coverage is &lt;that&gt; of the "
      "contract</summary>";
  EXPECT_THAT(page, HasSubstr(first));
  EXPECT_EQ(page.find("id=\"property=coverage+is+exact\"", page.find(first) + first.size()),
            std::string::npos);
  EXPECT_THAT(page, HasSubstr("<details class=\"property\" data-property=\"coverage is exact\">"));
}

// Kills: using the bound of another law's violation.
TEST(Properties, DrawTheBoundThatWasExceeded) {
  records::Run run = sample_run();
  run.counterexamples.resize(1);
  run.counterexamples[0].violations[0].bound = {0.625, 0.625};
  EXPECT_THAT(laws(run), HasSubstr(">bound 0.625</text>"));
  run.counterexamples[0].source.found->law = "another law";
  EXPECT_THAT(laws(run), Not(HasSubstr("0.625")));
}

TEST(Properties, ShowErrorsByStageWhereTheyWereSplit) {
  records::Run run = sample_run();
  for (auto& [key, record] : run.records) {
    if (key.attribute_kind != records::AttributeKind::smooth) continue;
    record.errors.stages[records::Stratum::sliver][records::Stage::set_up].add({1, 1});
  }
  EXPECT_THAT(laws(run), HasSubstr("<h4>Errors by stage</h4>"));
}

}  // namespace
}  // namespace rastercheck::reports::report_laws_test
