#include "reports/internal/report_front.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::report_front_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string front(const records::Run& run) { return front_of(run, records::summarize(run)); }

TEST(Front, WhatIsViolatedComesFirst) {
  const std::string all = front(sample_run());
  const std::string page = all.substr(all.find("<table class=\"verdicts"));
  const std::size_t violated = page.find("✗ violated in 2 cases");
  const std::size_t unchecked = page.find("– not checked");
  const std::size_t held = page.find("✓ held");
  EXPECT_LT(violated, held);
  EXPECT_LT(held, unchecked);
  EXPECT_NE(unchecked, std::string::npos);
}

TEST(Front, HasTheFiguresOfTheWholeRun) {
  const std::string page = front(sample_run());
  // Four rows with 1,000 cases each, and with 2 · 3,012,040 samples each.
  EXPECT_THAT(page, HasSubstr("<dt>cases checked</dt><dd><strong>4,000</strong>"));
  EXPECT_THAT(page, HasSubstr("<dt>samples judged</dt><dd><strong>24,096,320</strong>"));
}

TEST(Front, TellsBackendsApart) {
  EXPECT_THAT(front(sample_run()),
              HasSubstr("<td>method:float32</td><td><span class=\"violated\">✗ Violated: 1 of 3 "
                        "checks; 1 not checked.</span></td><td class=\"number\" "
                        "data-name=\"worst error\">0.7</td>"));
  records::Run one = sample_run();
  one.plan.backends = {"cpu"};
  EXPECT_THAT(front(one), HasSubstr("<dt>worst error</dt><dd><strong>0.5</strong> <small>scale ULP"
                                    "</small>"));
  EXPECT_THAT(front(one), Not(HasSubstr("class=\"backends\"")));
}

TEST(Front, SaysWhatWasNotChecked) {
  records::Run run = sample_run();
  add_known_defects(run);
  const std::string page = front(run);
  EXPECT_THAT(page, HasSubstr("<li>Not reached: coverage is exact on cpu: "));
  EXPECT_THAT(page, HasSubstr("<li>a law &lt;that&gt; says | nothing on method:float32: no case "
                              "says anything of it</li>"));
  EXPECT_THAT(page, HasSubstr("nothing on cpu: the backend &lt;draws&gt; no pictures</li>"));
  EXPECT_THAT(page, HasSubstr("<li>320 samples were permitted either way"));
}

TEST(Front, SaysOfSeveralLawsOnce) {
  records::Run run = sample_run();
  run.plan.laws.emplace_back("another law");
  EXPECT_THAT(front(run), HasSubstr("<li>2 laws on cpu: no case says anything of it</li>"));
}

TEST(Front, SaysThatNothingWasLeftOut) {
  records::Run run;
  run.plan.laws = {"a law"};
  run.plan.backends = {"cpu"};
  records::Record& record = run.records[{"a law", "cpu", records::AttributeKind::coverage, ""}];
  record.cases.checked = 1;
  record.errors.classes[records::FragmentClass::correct] = 1;
  EXPECT_THAT(front(run), HasSubstr("<li>Nothing was left out.</li>"));
}

// Kills: a first screen without the scene's drawing, or with a scene although there was none.
TEST(Front, ShowsTheScene) {
  const std::string page = front(sample_run());
  EXPECT_THAT(page, HasSubstr("<h2>The scene</h2>"));
  EXPECT_THAT(page, HasSubstr("alt=\"bunny-cpu\""));
  EXPECT_THAT(page, HasSubstr("<figcaption>What cpu draws &lt;of it&gt;.</figcaption>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"#pictures\">"));
  EXPECT_THAT(page, Not(HasSubstr("bunny-error")));
  records::Run run = sample_run();
  run.scenes.clear();
  EXPECT_THAT(front(run), Not(HasSubstr("<h2>The scene</h2>")));
  run = sample_run();
  run.pictures.clear();
  EXPECT_THAT(front(run), Not(HasSubstr("<figure>")));
  EXPECT_THAT(front(run),
              HasSubstr("nothing was judged of its 3 triangles, as it &lt;is&gt; far."));
}

TEST(Front, SaysHowToDoItAgainAndWhereItWasDone) {
  const std::string page = front(sample_run());
  EXPECT_THAT(page, HasSubstr("<code>rastercheck run --backend cpu --backend method:float32 "));
  EXPECT_THAT(page, HasSubstr("<dt>seed</dt><dd>18446744073709551615</dd>"));
  EXPECT_THAT(page, HasSubstr("<dt>compiler</dt><dd>g++ &lt;12&gt; &amp; more</dd>"));
}

}  // namespace
}  // namespace rastercheck::reports::report_front_test
