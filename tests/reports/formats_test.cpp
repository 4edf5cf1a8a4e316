// Compares the files that the formats write for the sample run with approved files, byte by byte.
// To approve new output, look at it first, then run this program with UPDATE_APPROVED=1.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "reports/format.h"
#include "reports/internal/viewer.h"
#include "tests/approved_file.h"
#include "tests/reports/sample_run.h"

namespace rastercheck::reports::formats_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string written(std::string_view format, const records::Run& run) {
  return find_format(format).value().write(run);
}

/// The page without the scripts and styles of its viewer, which has tests of its own
/// (tests/browser/).
std::string without_viewer(std::string text) {
  for (const std::string& part : {viewer_scripts(), viewer_policy(), std::string(kViewerStyle)}) {
    if (const std::size_t at = text.find(part); at != std::string::npos)
      text.erase(at, part.size());
  }
  return text;
}

class ApprovedFormat : public ::testing::TestWithParam<std::string> {};

TEST_P(ApprovedFormat, WritesWhatWasApproved) {
  const Format format = find_format(GetParam()).value();
  const std::string file = std::string(RASTERCHECK_SOURCE_DIR "/tests/reports/approved/") +
                           std::string(format.file_name);
  EXPECT_TRUE(is_approved(without_viewer(format.write(sample_run())), file));
}

INSTANTIATE_TEST_SUITE_P(Formats, ApprovedFormat, ::testing::ValuesIn(format_names()),
                         [](const auto& format) { return format.param; });

TEST(Formats, TellWhatIsKnownOfDrivers) {
  records::Run run = sample_run();
  run.unreached.clear();
  add_known_defects(run);
  const std::string page = written("html", run);
  EXPECT_THAT(page, HasSubstr("≈ known in 3 cases"));
  EXPECT_THAT(page, HasSubstr("<td>driver-1</td><td>cpu</td><td class=\"number\" "
                              "data-name=\"cases\">3</td><td>Depth &lt;is&gt; wrong.</td>"));
  EXPECT_THAT(page, HasSubstr("nothing on cpu: the backend &lt;draws&gt; no pictures</li>"));
  EXPECT_THAT(page, HasSubstr("Unexpected pass: the case of driver-2 no longer violates"));
  EXPECT_THAT(page,
              HasSubstr("The known defects of cpu were found with Mesa 22; this is Mesa 23."));
  const std::string summary = written("markdown", run);
  EXPECT_THAT(summary, HasSubstr("| driver-1 | cpu | 3 | Depth \\<is\\> wrong. | 14.6.1 |"));
  EXPECT_THAT(summary, HasSubstr("| driver-2 | cpu | **unexpected pass** |"));
  EXPECT_THAT(summary, HasSubstr("| not checked: the backend \\<draws\\> no pictures |"));
  EXPECT_THAT(summary, HasSubstr("| known in 3 cases |"));
  EXPECT_THAT(summary, HasSubstr("- Unexpected pass: the case of driver-2"));
}

// Kills: a text that is inserted into the page unescaped.
TEST(HtmlFormat, EscapesEveryText) {
  records::Run run = sample_run();
  add_known_defects(run);
  const std::string attack = "<script>'\"&";
  run.plan.laws.push_back(attack);
  run.plan.backends = {attack};
  run.plan.scene = attack;
  add_sample_records(run.records, attack, attack, 1);
  for (auto& [key, record] : run.records) {
    record.labels[attack] = 1;
    for (records::ErrorSizes* sizes : {&record.errors.ideal, &record.errors.excess}) {
      records::WorstError worst = sample_worst(100);
      worst.case_name = worst.exact = attack;
      keep(sizes->extremes, worst);
    }
  }
  for (records::Counterexample& counterexample : run.counterexamples) {
    counterexample.source.name = attack;
    counterexample.source.attributes[0].name = attack;
    counterexample.source.found = {attack, attack, attack, 1, 1};
    for (records::Violation& violation : counterexample.violations) {
      violation.exact = violation.actual = violation.note = attack;
    }
  }
  for (records::Picture& picture : run.pictures) picture.name = picture.caption = attack;
  run.environment[attack] = attack;
  for (records::Inspection& inspection : run.inspections) {
    inspection.law = inspection.backend = inspection.source.name = attack;
    inspection.source.attributes[0].name = attack;
    for (auto& row : inspection.q_matrix.emplace()) row.fill(attack);
    for (records::InspectedSample& sample : inspection.samples) {
      for (records::InspectedValue& value : sample.values) value.exact = attack;
    }
  }
  std::string page = without_viewer(written("html", run));
  // For HTML, the viewer's data is only text, whatever it contains.
  constexpr std::string_view kData = "<script type=\"application/json\">";
  for (std::size_t at = page.find(kData); at != std::string::npos; at = page.find(kData)) {
    const std::size_t end = page.find("</script>", at);
    EXPECT_EQ(page.substr(at + 1, end - at - 1).find('<'), std::string::npos);
    page.erase(at, end - at);
  }
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("'\"")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;&#39;&quot;&amp;"));
}

TEST(HtmlFormat, NeedsNothingFromElsewhere) {
  const std::string page = written("html", sample_run());
  EXPECT_THAT(page, HasSubstr("content=\"default-src 'none'; img-src data:;"));
  for (const char* elsewhere : {"<link", "@import", "src=\"/", "src=\"h", "url(h"}) {
    EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
  }
  // Scripts contain the addresses of namespaces and of their authors.
  for (const char* elsewhere : {"http://", "https://"}) {
    EXPECT_THAT(without_viewer(page), Not(HasSubstr(elsewhere)));
  }
}

// Kills: a page that says nothing unless scripts run.
TEST(HtmlFormat, SaysWhatIsWrongWithoutScripts) {
  const std::string page = without_viewer(written("html", sample_run()));
  EXPECT_THAT(page, HasSubstr("u &amp; v is exactly "
                              "<span class=\"value\">97/70</span>"));
  EXPECT_THAT(page, HasSubstr("most of this error is from <strong>set-up</strong>"));
  EXPECT_THAT(page, HasSubstr("<tr class=\"largest\"><th scope=\"row\">set-up</th>"
                              "<td class=\"number\">+6.5</td>"));
  EXPECT_THAT(page, HasSubstr("by stage <small>(this backend does not report its stages: "));
}

TEST(HtmlFormat, SaysWhichStageASampleIsMissingFrom) {
  records::Run run = sample_run();
  records::Inspection& inspection = run.inspections[0];
  inspection.place.x = 2;
  inspection.place.y = 5;
  inspection.attribute.reset();
  inspection.splits.clear();
  inspection.coverage_stage = records::Stage::snap;
  const std::string page = without_viewer(written("html", run));
  EXPECT_THAT(page,
              HasSubstr("Pixel (2, 5) of triangle 0 is <strong>missing</strong>: it is required "
                        "(inside), 0.707107 pixels from the boundary"));
  EXPECT_THAT(page, HasSubstr("the first stage to say otherwise is <strong>snap</strong>"));
}

// Kills: an exception for text that is not UTF-8; control characters that break a line.
TEST(AllFormats, TakeAnyBytes) {
  records::Run run = sample_run();
  run.counterexamples[0].source.name = "\xff\n\x01";
  run.environment["\xc3"] = "\xe2\x82";
  for (const Format& format : formats()) {
    const std::string text = format.write(run);
    EXPECT_THAT(text, Not(HasSubstr("\xff"))) << format.name;
    EXPECT_THAT(text, Not(HasSubstr("\x01"))) << format.name;
  }
}

// Kills: giving a sample or an exact answer although nothing was drawn.
TEST(AllFormats, TellOfNoDrawingOnlyWhy) {
  records::Violation crash;
  crash.fragment_class = records::FragmentClass::crash;
  crash.exact = "a drawing";
  crash.note = "its process ended";
  records::Run run = sample_run();
  run.counterexamples[0].violations = {crash};
  EXPECT_THAT(written("markdown", run), HasSubstr("\n- its process ended\n"));
  const std::string page = written("html", run);
  EXPECT_THAT(page, HasSubstr("crash<br><small>its process ended</small>"));
  EXPECT_THAT(page, Not(HasSubstr("a drawing")));
}

TEST(AllFormats, AnEmptyRunIsNotChecked) {
  EXPECT_THAT(written("markdown", {}), HasSubstr("**Nothing was checked**"));
  EXPECT_THAT(written("html", {}), HasSubstr("<h1 class=\"mixed\">Nothing was checked</h1>"));
}

TEST(MarkdownFormat, SaysHowToDoItAgain) {
  const std::string text = written("markdown", sample_run());
  EXPECT_THAT(text, HasSubstr("    rastercheck run --backend cpu --backend method:float32 --cases "
                              "1000 --seed 18446744073709551615 --scene 'it'\\''s a bunny' "
                              "--property '*<values>*' --timeout 2.5\n"));
  EXPECT_THAT(text, HasSubstr("    rastercheck replay "
                              "counterexamples/values-are-within-bounds-method-float32-"
                              "beyond-bound.json --timeout 2.5\n"));
}

}  // namespace
}  // namespace rastercheck::reports::formats_test
