#include "reports/internal/report_front.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/reports/sample_run.h"

namespace rastercheck::reports::report_front_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string front(const records::Run& run) { return front_of(run, records::summarize(run)); }
std::string judged(const records::Run& run) { return judged_section(run, records::summarize(run)); }
std::string gaps(const records::Run& run) { return gaps_section(run, records::summarize(run)); }

// Kills: a first screen that does not name the backend.
TEST(Front, SaysWhatWasJudgedAndWhatItComesTo) {
  records::Run run = sample_run();
  EXPECT_THAT(front(run),
              HasSubstr("<h1 class=\"violated\">1 of 3 properties violated, 1 cause</h1>"));
  EXPECT_THAT(front(run), HasSubstr("<b>cpu</b>, <b>method:float32</b> · "));
  run.environment[records::drawn_by_key("cpu")] = "a <driver>, 1.0";
  EXPECT_THAT(front(run), HasSubstr("<b>cpu</b> (a &lt;driver&gt;, 1.0), <b>method"));
  EXPECT_THAT(front(run), HasSubstr(" · scene it&#39;s a bunny</p>"));
  run.plan.scene = "";
  EXPECT_THAT(front(run), Not(HasSubstr("scene")));
  run.plan.scene = "<a>.obj";
  EXPECT_THAT(front(run), HasSubstr(" · scene &lt;a&gt;.obj</p>"));
}

TEST(Front, HasTheFiguresOfTheWholeRun) {
  const std::string page = judged(sample_run());
  // Four rows with 1,000 cases each, and with 2 · 3,012,040 samples each.
  EXPECT_THAT(page, HasSubstr("<dt>cases checked</dt><dd><strong>4,000</strong>"));
  EXPECT_THAT(page, HasSubstr("<dt>samples judged</dt><dd><strong>24,096,320</strong>"));
}

TEST(Front, TellsBackendsApart) {
  EXPECT_THAT(
      front(sample_run()),
      HasSubstr("<td>method:float32</td><td><span class=\"violated\">✗ 1 property violated"
                "</span>, <span class=\"held\">✓ 1 held</span>, <span class=\"unchecked\">"
                "– 1 not checked</span></td><td class=\"number\" data-name=\"worst error\">0.7"
                "</td>"));
  records::Run one = sample_run();
  one.plan.backends = {"cpu"};
  EXPECT_THAT(judged(one), HasSubstr("<dt>worst error</dt><dd><strong>0.5</strong> <small>scale ULP"
                                     "</small>"));
  EXPECT_THAT(front(one), Not(HasSubstr("class=\"backends\"")));
}

// Kills: known defects that are counted but not listed.
TEST(Front, TellsTheKnownDefectsThatShow) {
  records::Run run = sample_run();
  EXPECT_THAT(front(run), Not(HasSubstr("Known defects")));
  add_known_defects(run);
  EXPECT_THAT(front(run), HasSubstr("<small>(driver-1, 3 cases)</small></li>"));
}

TEST(Front, SaysWhatWasNotChecked) {
  records::Run run = sample_run();
  add_known_defects(run);
  const std::string page = gaps(run);
  EXPECT_THAT(page, HasSubstr("<li>Not reached: coverage is exact on cpu: "));
  EXPECT_THAT(page, HasSubstr("<li>a law &lt;that&gt; says | nothing on method:float32: no case "
                              "was made for it</li>"));
  EXPECT_THAT(page, HasSubstr("nothing on cpu: the backend &lt;draws&gt; no pictures</li>"));
  EXPECT_THAT(page, HasSubstr("<li>320 samples may be drawn or not, as the contract"));
}

TEST(Front, SaysOfSeveralLawsOnce) {
  records::Run run = sample_run();
  run.plan.laws.emplace_back("another law");
  EXPECT_THAT(gaps(run), HasSubstr("<li>2 properties on cpu: no case was made for it</li>"));
}

// Kills: thirty reasons, open, between the properties and the end of the page; a reason lost.
TEST(Front, ManyReasonsOpenOnAClick) {
  const auto page_of = [](int reasons) {
    records::Run run;
    run.plan.backends = {"cpu"};
    for (int i = 0; i < reasons; ++i) {
      run.plan.laws.push_back("law " + std::to_string(i));
      records::Record& record =
          run.records[{run.plan.laws.back(), "cpu", records::AttributeKind::coverage, ""}];
      record.not_applicable_because["reason " + std::to_string(i)] = 3;
      record.cases.not_applicable = 3;
    }
    return gaps(run);
  };
  const std::string few = page_of(6);
  EXPECT_THAT(few, AllOf(Not(HasSubstr("<details>")), HasSubstr("<li>law 5: reason 5</li>")));
  const std::string many = page_of(7);
  EXPECT_THAT(many, HasSubstr("<details><summary>7 properties, for 7 reasons</summary>\n<ul>\n"
                              "<li>law 0: reason 0</li>\n"));
  EXPECT_THAT(many, HasSubstr("<li>law 6: reason 6</li>\n</ul>\n</details></li>\n"));
}

TEST(Front, SaysThatNothingWasLeftOut) {
  records::Run run;
  run.plan.laws = {"a law"};
  run.plan.backends = {"cpu"};
  records::Record& record = run.records[{"a law", "cpu", records::AttributeKind::coverage, ""}];
  record.cases.checked = 1;
  record.errors.classes[records::FragmentClass::correct] = 1;
  EXPECT_THAT(gaps(run), HasSubstr("<li>Nothing was left out.</li>"));
}

// Kills: a first screen without the scene's drawing, or with a scene although there was none.
TEST(Front, ShowsTheScene) {
  const std::string page = scene_section(sample_run());
  EXPECT_THAT(page, HasSubstr("<h2>The scene</h2>"));
  EXPECT_THAT(page, HasSubstr("alt=\"bunny-cpu\""));
  EXPECT_THAT(page, HasSubstr("<figcaption>What cpu draws &lt;of it&gt;.</figcaption>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"#pictures\">"));
  EXPECT_THAT(page, Not(HasSubstr("bunny-error")));
  records::Run run = sample_run();
  run.scenes.clear();
  EXPECT_THAT(scene_section(run), Not(HasSubstr("<h2>The scene</h2>")));
  run = sample_run();
  run.pictures.clear();
  EXPECT_THAT(scene_section(run), Not(HasSubstr("<figure>")));
  EXPECT_THAT(scene_section(run),
              HasSubstr("its 3 triangles could not be judged: it &lt;is&gt; far."));
}

TEST(Front, SaysHowToRepeatTheRunAndWhereItWasDone) {
  const std::string page = again_section(sample_run());
  EXPECT_THAT(page, HasSubstr("<code>rastercheck run --backend cpu --backend method:float32 "));
  EXPECT_THAT(page, HasSubstr(" --seed 18446744073709551615"));
  EXPECT_THAT(page, HasSubstr("<dt>compiler</dt><dd>g++ &lt;12&gt; &amp; more</dd>"));
}

}  // namespace
}  // namespace rastercheck::reports::report_front_test
