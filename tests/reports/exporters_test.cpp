// Findings as what works without RasterCheck: nothing that a reader needs is missing, and no text
// of the user's is taken for markup.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/case_reader.h"
#include "reports/exporter.h"
#include "tests/reports/sample_inspections.h"

namespace rastercheck::reports::exporters_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A pixel whose attribute is wrong, one that is missing.
records::Exhibit exhibit() {
  records::Exhibit exhibit;
  SampleInspection sample({1, 1, 1}, {{8, 8}});
  sample.at(3, 3).is_drawn = false;
  exhibit.inspection = sample.inspection();
  exhibit.inspection->place = {0, 2, 2, 0};
  exhibit.file = "case.json";
  exhibit.source = exhibit.inspection->source;
  exhibit.backend = "plugin:mine.so";
  exhibit.description = "mine_1 *fast*";
  exhibit.property = "values-stay-within-the-bound";
  exhibit.sentence = "values stay within the bound";
  exhibit.rules = {"Vulkan 1.3, Basic Polygon Rasterization (interpolation)"};
  exhibit.known = {"mine-1: it divides too early."};
  exhibit.found_with = "RasterCheck 0.1.0";
  exhibit.pixels = {"y 0 . # .", "x   0 1 2"};
  exhibit.replay = "rastercheck replay case.json --backend plugin:mine.so --no-known";
  records::Violation violation;
  violation.fragment_class = records::FragmentClass::beyond_bound;
  violation.kind = records::AttributeKind::smooth;
  violation.attribute = 0;
  violation.place = {0, 2, 2, 0};
  violation.exact = "1/2";
  violation.actual = "0.75 (0x1.8p-1)";
  violation.error = {4194304, 4194304};
  violation.bound = {0.5, 0.5};
  exhibit.violations = {violation};
  exhibit.violation_count = 1;
  return exhibit;
}

std::string written(const std::string& format, const records::Exhibit& from) {
  const Result<std::string> text = find_exporter(format)->write(from);
  EXPECT_TRUE(text) << to_string(text.error());
  return text.value_or("");
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++found;
  return found;
}

TEST(Exporters, AreFoundByName) {
  EXPECT_NE(find_exporter("bug"), nullptr);
  EXPECT_EQ(find_exporter("none"), nullptr);
  for (std::size_t i = 1; i < exporters().size(); ++i) {
    EXPECT_LT(exporters()[i - 1].name, exporters()[i].name);
  }
}

TEST(BugReport, SaysAllThatAnAuthorNeeds) {
  const std::string text = written("bug", exhibit());
  EXPECT_TRUE(text.starts_with("# plugin:mine.so: attribute 'u & v' was drawn as 0.75"));
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("\nPixel (2, 2) of triangle 0: "), HasSubstr("mine\\_1 \\*fast\\*"),
            HasSubstr("Found with RasterCheck 0.1.0."), HasSubstr("y 0 . # .\nx   0"),
            HasSubstr("Rule: Vulkan 1.3, Basic Polygon Rasterization (inter"),
            HasSubstr("Known: mine-1: it divides too early."), HasSubstr("--no-known\n```\n")));
  // The case can be taken out of the report again.
  const std::size_t begin = text.find("```json\n") + 8;
  const auto c = cases::parse_case(text.substr(begin, text.find("```", begin) - begin), "report");
  ASSERT_TRUE(c) << to_string(c.error());
  EXPECT_EQ(c->positions, exhibit().source.positions);
}

TEST(BugReport, NamesTheSpecificationsSectionWhereNoEntryDoes) {
  records::Exhibit without = exhibit();
  without.rules.clear();
  without.known.clear();
  without.source.rules = cases::Rules::opengl;
  EXPECT_THAT(written("bug", without), HasSubstr("Rule: OpenGL 4.6, 14.6.1 Basic Polygon"));
}

// Kills: a report of nothing.
TEST(BugReport, IsRefusedIfNothingIsWrong) {
  records::Exhibit held = exhibit();
  held.violations.clear();
  const auto text = find_exporter("bug")->write(held);
  ASSERT_FALSE(text);
  EXPECT_EQ(to_string(text.error()),
            "case.json: nothing is wrong with it: “values stay within the "
            "bound” holds on plugin:mine.so");
}

// Kills: a block that a text of the user's ends.
TEST(BugReport, TextsEndNoBlock) {
  records::Exhibit rude = exhibit();
  rude.violations[0].note = "``` # over";
  const std::string text = written("bug", rude);
  EXPECT_EQ(count(text, "\n````\n"), 2U);
}

TEST(Exporters, TakeAnyBytes) {
  records::Exhibit rude = exhibit();
  rude.backend = rude.description = rude.sentence = rude.violations[0].note = "\xff\n\x01<b>";
  rude.source.name = rude.source.attributes[0].name = "\xff\n\x01</title>";
  rude.known = rude.rules = {"\xff\n\x01"};
  for (const Exporter& exporter : exporters()) {
    const std::string text = written(std::string(exporter.name), rude);
    EXPECT_THAT(text, Not(HasSubstr("\xff"))) << exporter.name;
    EXPECT_THAT(text, Not(HasSubstr("\x01"))) << exporter.name;
  }
  EXPECT_THAT(written("svg", rude), Not(HasSubstr("<b>")));
}

// One dot for each of 64 samples, a ring about the one in focus, the triangle in its place: pixel
// (1, 1) begins at 30 + 40.
TEST(Svg, ShowsSamplesTriangleAndFaults) {
  const std::string text = written("svg", exhibit());
  EXPECT_EQ(count(text, "r=\"7\""), 64U);
  EXPECT_EQ(count(text, "class=\"w\" cx=\"130\" cy=\"130\" r=\"7\""), 1U);
  EXPECT_EQ(count(text, "class=\"m\" cx=\"170\" cy=\"170\" r=\"7\""), 1U);
  EXPECT_EQ(count(text, "r=\"11\""), 1U);
  EXPECT_THAT(text, AllOf(HasSubstr("points=\"70,70 310,110 110,310 \""),
                          HasSubstr("drawn with a wrong value</text>"), HasSubstr("missing</text>"),
                          Not(HasSubstr("and must not be")), Not(HasSubstr("are marked"))));
}

// Kills: a sample that a neighbour's property misses, shown as rightly left out.
TEST(Svg, ShowsWhatOnlyThePropertyKnows) {
  records::Exhibit seam = exhibit();
  records::Violation& violation = seam.violations[0];
  violation.kind = records::AttributeKind::coverage;
  violation.place = {0, 0, 0, 0};
  seam.violation_count = 3;
  const std::string text = written("svg", seam);
  EXPECT_EQ(count(text, "class=\"m\" cx=\"50\" cy=\"50\""), 1U);
  EXPECT_THAT(text, HasSubstr("Only 1 of 3 faults are marked."));
  violation.place = {0, 2, 2, 0};
  EXPECT_EQ(count(written("svg", seam), "class=\"x\" cx=\"130\" cy=\"130\" r=\"7\""), 1U);
}

TEST(Svg, IsRefusedWithoutASample) {
  records::Exhibit blank = exhibit();
  blank.inspection.reset();
  EXPECT_EQ(to_string(find_exporter("svg")->write(blank).error()),
            "case.json: has no sample to show");
}

}  // namespace
}  // namespace rastercheck::reports::exporters_test
