#include "reports/internal/report_laws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::report_laws_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string laws(const records::Run& run) { return laws_of(run, records::summarize(run)); }

TEST(Laws, OnlyViolatedOnesAreOpen) {
  const std::string page = laws(sample_run());
  EXPECT_THAT(page, HasSubstr("id=\"law=coverage+is+exact\" data-law=\"coverage is exact\">"));
  EXPECT_THAT(page, HasSubstr("data-law=\"values are within bounds\" open>"));
  EXPECT_THAT(page, HasSubstr("data-law=\"a law &lt;that&gt; says | nothing\">"));
}

TEST(Laws, ALawHasAllItsBackends) {
  const std::string page = laws(sample_run());
  EXPECT_THAT(page, HasSubstr("<span class=\"title\">values are within bounds</span> "
                              "<span class=\"held\">✓</span> <small>cpu</small> "
                              "<span class=\"violated\">✗</span> <small>method:float32</small>"));
  EXPECT_THAT(page, HasSubstr("<h3>coverage is exact <small>on method:float32</small></h3>"));
}

// Kills: a law that a reader cannot select on the command line, because its id is not shown.
TEST(Laws, AreIntroducedByTheirSentences) {
  const std::string page = laws(sample_run());
  EXPECT_THAT(page, HasSubstr("<span class=\"title\">coverage is &lt;that&gt; of the "
                              "contract</span> <code>coverage is exact</code> <span"));
  EXPECT_THAT(page, Not(HasSubstr("<code>values are within bounds</code>")));
}

// Kills: using the bound of another law's violation.
TEST(Laws, DrawTheBoundThatWasExceeded) {
  records::Run run = sample_run();
  run.counterexamples.resize(1);
  run.counterexamples[0].violations[0].bound = {0.625, 0.625};
  EXPECT_THAT(laws(run), HasSubstr(">bound 0.625</text>"));
  run.counterexamples[0].source.found->law = "another law";
  EXPECT_THAT(laws(run), Not(HasSubstr("0.625")));
}

TEST(Laws, ShowErrorsByStageWhereTheyWereSplit) {
  records::Run run = sample_run();
  for (auto& [key, record] : run.records) {
    if (key.attribute_kind != records::AttributeKind::smooth) continue;
    record.errors.stages[records::Stratum::sliver][records::Stage::set_up].add({1, 1});
  }
  EXPECT_THAT(laws(run), HasSubstr("<h4>Errors by stage</h4>"));
}

}  // namespace
}  // namespace rastercheck::reports::report_laws_test
