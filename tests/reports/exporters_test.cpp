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
  exhibit.backend = "vulkan:mine";
  exhibit.description = "mine_1 *fast*";
  exhibit.property = "values-stay-within-the-bound";
  exhibit.sentence = "values stay within the bound";
  exhibit.rules = {"Vulkan 1.3, Basic Polygon Rasterization (interpolation)"};
  exhibit.known = {"mine-1: it divides too early."};
  exhibit.found_with = "RasterCheck 0.1.0";
  exhibit.pixels = {"y 0 . # .", "x   0 1 2"};
  exhibit.replay = "rastercheck replay case.json --backend vulkan:mine --no-known";
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
  exhibit.places = {{{0, 1, 1, 0}, records::Verdict::permitted, {{0, {0.25F, 0.5F}}}, true},
                    {{0, 2, 2, 0},
                     records::Verdict::required,
                     {{std::nullopt, {0, 1}}, {0, {0.5F, 0.5F}, false}},
                     true},
                    {{0, 3, 3, 0}, records::Verdict::forbidden, {}, true}};
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
  EXPECT_TRUE(text.starts_with("# vulkan:mine: attribute 'u & v' was drawn as 0.75"));
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
            "bound” holds on vulkan:mine");
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
  rude.backend = "gl:\xff\n\x01<b>";
  rude.description = rude.sentence = rude.violations[0].note = "\xff\n\x01<b>";
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

// Kills: "as it may be" said of samples that must not be drawn.
TEST(Svg, TellsSamplesThatMayBeLeftOutFromThoseThatMustBe) {
  records::Exhibit open = exhibit();
  for (records::InspectedSample& sample : open.inspection->samples) {
    sample.is_drawn = false;
    sample.verdict = records::Verdict::forbidden;
  }
  open.violations.clear();
  EXPECT_THAT(written("svg", open), AllOf(HasSubstr("not drawn, correctly</text>"),
                                          Not(HasSubstr("as it may be</text>"))));
  open.inspection->samples.front().verdict = records::Verdict::permitted;
  const std::string text = written("svg", open);
  EXPECT_EQ(count(text, "class=\"l\" cx=\"50\" cy=\"50\""), 1U);
  EXPECT_THAT(text, HasSubstr("not drawn, as it may be</text>"));
}

TEST(Svg, IsRefusedWithoutASample) {
  records::Exhibit blank = exhibit();
  blank.inspection.reset();
  EXPECT_EQ(to_string(find_exporter("svg")->write(blank).error()),
            "case.json: has no sample to show");
}

// Records have three words: how often, depth, 'u'. Pixel (x, y) of the 8 × 8 begins at byte
// 12 (8 y + x): 108, 216, 324.
TEST(ShaderTest, ProbesEachPlace) {
  const std::string text = written("shader_test", exhibit());
  EXPECT_TRUE(
      text.starts_with("# pixel (2, 2) of triangle 0: attribute 'u & v' was drawn as 0.75"));
  EXPECT_THAT(text, AllOf(HasSubstr("\nssbo 0 768\nssbo 0 subdata float 116 0.25\ndraw arrays"),
                          HasSubstr("\n# triangle 0, pixel (1, 1): may be drawn\n"
                                    "probe ssbo uint 0 108 <= 1\n# attribute u & v\n"
                                    "probe ssbo float 0 116 >= 0.25\n"
                                    "probe ssbo float 0 116 <= 0.5\n"),
                          HasSubstr("\nprobe ssbo uint 0 216 == 1\n# depth\n"
                                    "probe ssbo float 0 220 >= 0\nprobe ssbo float 0 220 <= 1\n"),
                          HasSubstr("must not be drawn\nprobe ssbo uint 0 324 == 0\n")));
  EXPECT_THAT(text, AllOf(HasSubstr("fb ms GL_RGBA8 8 8 0\nviewport indexed 0 0 0 8 8\n"),
                          HasSubstr("provoking vertex first\n"),
                          HasSubstr("smooth out float value0;"), Not(HasSubstr("sample out"))));
}

// By hand: Vulkan's z of 1/4, 1/2 and 3/4 with w = 1 are OpenGL's −1/2, 0 and 1/2.
TEST(ShaderTest, HandsOverBitsByOpenglsRules) {
  EXPECT_THAT(written("shader_test", exhibit()),
              AllOf(HasSubstr("[vertex data]\nposition/float/4 attributes0/float/4\n"),
                    HasSubstr("\n0xbf400000 0xbf400000 0xbf000000 0x3f800000 0x00000000 "),
                    HasSubstr(" 0x00000000 0x3f800000 0x3f800000 ")));
}

std::string refusal(const std::string& format, const records::Exhibit& from) {
  const auto text = find_exporter(format)->write(from);
  return text ? "" : to_string(text.error());
}

// Kills: a test that passes where the defect is.
TEST(ExportedTest, IsRefusedIfItWouldNotFail) {
  records::Exhibit seam = exhibit();
  seam.places[1].values[1].is_right = true;
  for (const char* const format : {"c", "shader_test"}) {
    EXPECT_THAT(refusal(format, seam),
                HasSubstr("it breaks “values stay within the bound”, but no sample"));
  }
  records::Exhibit clamped = seam;
  clamped.source.depth_clamp = true;
  clamped.places[1].values[0].is_right = false;
  EXPECT_THAT(refusal("c", clamped), HasSubstr("only its depth is wrong, and that cannot be read"));
  // One that holds is a test that passes.
  seam.violations.clear();
  seam.violation_count = 0;
  EXPECT_THAT(written("c", seam), HasSubstr("“values stay within the bound” holds on vulkan:mine"));
}

TEST(ExportedTest, IsRefusedIfItsFormatCannotSayTheCase) {
  records::Exhibit other = exhibit();
  other.source.rules = cases::Rules::d3d;
  EXPECT_THAT(refusal("c", other),
              HasSubstr("case.json: a C program cannot say it: it is drawn by Di"));
  EXPECT_THAT(refusal("shader_test", other),
              HasSubstr("shader_test cannot say it: it is drawn by Dir"));
  // Kills: lines that a program draws as triangles without an area, and calls right.
  for (const cases::Primitive primitive : {cases::Primitive::lines, cases::Primitive::points}) {
    other = exhibit();
    other.source.primitive = primitive;
    for (const char* const format : {"c", "shader_test", "amber"}) {
      EXPECT_THAT(refusal(format, other), HasSubstr("cannot say it: it has no triangles"));
    }
  }
  other = exhibit();
  other.source.scissor = {{0, 0, 4, 4}};
  EXPECT_THAT(refusal("shader_test", other), HasSubstr("no scissor"));
  EXPECT_EQ(refusal("c", other), "");
  other = exhibit();
  other.source.cull = cases::Cull::back;
  EXPECT_THAT(refusal("shader_test", other), HasSubstr("does not cull"));
  other = exhibit();
  other.source.positions[0].z = 0x1p-30F;  // 2^-29 − 1 has 29 digits
  EXPECT_THAT(refusal("shader_test", other), HasSubstr("more digits than a float32"));
  other = exhibit();
  other.source.viewport.height = -8;
  EXPECT_EQ(refusal("c", other), "");
  other.backend = "gl:llvmpipe";
  EXPECT_THAT(refusal("c", other), HasSubstr("negative height"));
  other = exhibit();
  other.places.clear();
  other.violations.clear();
  other.violation_count = 0;
  EXPECT_THAT(refusal("c", other), HasSubstr("nothing is promised"));
}

// Vulkan for its rules, unless an OpenGL driver drew.
TEST(CProgram, IsOfTheApiThatDrew) {
  records::Exhibit by = exhibit();
  EXPECT_THAT(written("c", by), AllOf(HasSubstr("#include <vulkan/vulkan.h>"),
                                      HasSubstr("layout(location = 1) in vec4 attributes0;"),
                                      HasSubstr("{2, \"attribute u & v\", 0x1p-2F, 0x1p-1F},"),
                                      HasSubstr("\nint main(")));
  by.backend = "gl";
  EXPECT_THAT(written("c", by), AllOf(HasSubstr("#include <EGL/egl.h>"), HasSubstr("IS_VULKAN 1"),
                                      HasSubstr("static int check(int triangle")));
  by.source.rules = cases::Rules::opengl;
  EXPECT_THAT(written("c", by), HasSubstr("IS_VULKAN 0"));
  by.backend = "vulkan";
  EXPECT_THAT(refusal("c", by), HasSubstr("no depths by OpenGL's rules"));
}

// Records have three words of four bytes, 8 to a row: pixel (2, 2) begins at byte 216, and its
// count is word 18. Kills: numbers without a point, which Amber takes for integers.
TEST(Amber, ComparesEachPlace) {
  const std::string text = written("amber", exhibit());
  EXPECT_TRUE(text.starts_with("#!amber\n# pixel (2, 2) of triangle 0: attribute 'u & v' was dr"));
  const std::string half = "5.000000000e-01\n";
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("\nBUFFER vertices0 DATA_TYPE vec4<float> DATA\n-7.500000000e-01 -7.5000"),
            HasSubstr(" 2.500000000e-01 0.000000000e+00 "), HasSubstr("START_IDX 0 COUNT 3\n"),
            HasSubstr("\nBUFFER counts0 DATA_TYPE uint32 SIZE 64 FILL 0\n"),
            HasSubstr("EXPECT counts0 IDX 36 LE 1\n# attribute u & v\n"
                      "EXPECT records0 IDX 116 GE 2.500000000e-01\n"),
            HasSubstr("EXPECT counts0 IDX 72 EQ 1\n"),
            HasSubstr("EXPECT records0 IDX 224 GE " + half + "EXPECT records0 IDX 224 LE " + half),
            HasSubstr("EXPECT counts0 IDX 108 EQ 0\n"), HasSubstr("words[at + 2] = value0;"),
            HasSubstr("if (isnan(value0)) atomicAdd(counts[index], 99u);")));
  records::Exhibit several = exhibit();
  several.source.framebuffer.samples = 4;
  EXPECT_THAT(refusal("amber", several), HasSubstr("amber cannot say it: it has several samples"));
}

// With several samples: the mask of the fragment, or its own sample if an attribute has its
// location there; the centre only if it is asked for.
TEST(ExportedTest, RecordsEachSampleOfAFragment) {
  records::Exhibit four = exhibit();
  four.source.framebuffer.samples = 4;
  four.source.attributes[0].location = cases::Location::center;
  EXPECT_THAT(written("c", four),
              AllOf(HasSubstr("if ((gl_SampleMaskIn[0] >> i & 1) != 0) record(i);"),
                    HasSubstr("interpolateAtOffset(value0, vec2(0))"),
                    HasSubstr("(pixel.y * 8 + pixel.x) * 4 + sample_number")));
  four.source.attributes[0].location = cases::Location::sample;
  EXPECT_THAT(written("c", four), AllOf(HasSubstr("smooth sample in float value0;"),
                                        HasSubstr("record(gl_SampleID);")));
  four.source.attributes[0].location = cases::Location::centroid;
  EXPECT_THAT(written("c", four),
              AllOf(HasSubstr("smooth centroid in float value0;"), HasSubstr("gl_SampleMaskIn")));
}

// What an exact rasterizer promises, a driver need not.
TEST(ExportedTest, IsOfADriver) {
  records::Exhibit by = exhibit();
  by.backend = "cpu";
  for (const char* const format : {"amber", "c", "shader_test"}) {
    EXPECT_THAT(refusal(format, by), HasSubstr("cpu is no driver; choose one with --backend"));
  }
  by = exhibit();
  by.subpixel_bits = 8;
  EXPECT_THAT(written("c", by), AllOf(HasSubstr("a driver with 8 subpixel bits may draw"),
                                      HasSubstr("SUBPIXEL_BITS = 8,")));
  by.rules.clear();
  EXPECT_THAT(written("c", by), HasSubstr("Rule: Vulkan 1.3, Basic Polygon Rasterization\n"));
}

// Kills: a sample that may be left out, and starts with a number that is none of the permitted.
TEST(ExportedTest, AsksNoNumberWhereNoneIsRight) {
  records::Exhibit empty = exhibit();
  empty.places[0].values[0].numbers = {1, 0};
  EXPECT_THAT(
      written("shader_test", empty),
      AllOf(Not(HasSubstr("subdata")), HasSubstr("may be drawn\nprobe ssbo uint 0 108 <= 1\n#"),
            Not(HasSubstr("ssbo float 0 116"))));
}

// A name that ends the comment or the string would be code.
TEST(CProgram, TakesNamesForNoCode) {
  records::Exhibit rude = exhibit();
  rude.source.name = "*/ int x; /*";
  rude.source.attributes[0].name = "\"}; int y; // ?\?/";
  const std::string text = written("c", rude);
  EXPECT_THAT(text, AllOf(HasSubstr("Case: * / int x; /*"),
                          HasSubstr("attribute \\\"}; int y; // \\?\\?/\"")));
}

}  // namespace
}  // namespace rastercheck::reports::exporters_test
