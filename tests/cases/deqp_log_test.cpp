// Logs of dEQP: which drawings are read, how exact their numbers are, and which cases they become.

#include "cases/deqp_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cases/files.h"

namespace rastercheck::cases::deqp_log_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTest = "dEQP-GLES3.functional.rasterization.interpolation.basic.";

/// A 1 × 1 picture of raw bytes: red 1, green 2, blue 3.
std::string image(const std::string& bytes = "AQID") {
  return "<ImageSet Name=\"Verification result\" Description=\"Result of rendering\">\n"
         "<Image Name=\"Result\" Width=\"1\" Height=\"1\" Format=\"RGB888\" "
         "CompressionMode=\"None\" Description=\"Result\">\n" +
         bytes + "\n</Image></ImageSet>\n";
}

std::string log_of(const std::string& path, const std::string& body) {
  return "#sessionInfo releaseName x\n#beginSession\n\n#beginTestCaseResult " + path +
         "\n<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<TestCaseResult Version=\"0.3.4\">\n" +
         body + "<Result StatusCode=\"Pass\">Pass</Result>\n</TestCaseResult>\n\n" +
         "#endTestCaseResult\n\n#endSession\n";
}

std::string vertices(const std::string& x = "0.5", const std::string& w = "1") {
  std::string text = "<Text>Generated vertices:</Text>\n";
  for (const char* color : {"1, 0, 0, 1", "0, 1, 0, 1", "0, 0, 1, 1", "1, 0, 0, 1"}) {
    text += "<Text>\t(" + x + ", -0.25, 0, " + w + "),\tcolor= (" + color + ")</Text>\n";
  }
  return text;
}

DeqpTest test_of(const std::string& path, const std::string& body) {
  const auto tests = parse_deqp_log(log_of(path, body), "log");
  EXPECT_TRUE(tests.has_value()) << (tests ? "" : to_string(tests.error()));
  EXPECT_EQ(tests ? tests->size() : 0, 1);
  return tests && !tests->empty() ? tests->front() : DeqpTest();
}

std::string error_of(const std::string& text) {
  const auto tests = parse_deqp_log(text, "log");
  return tests ? "" : to_string(tests.error());
}

TEST(DeqpLog, SaysWhatWasDrawn) {
  const DeqpTest test =
      test_of("dEQP-GLES3.functional.rasterization.primitives.triangles",
              "<Text>Sample count = 0</Text><Text>SUBPIXEL_BITS = 8</Text>\n"
              "<Section Name=\"a\" Description=\"Test iteration 1 / 3\">\n"
              "<Text>Rendering 1 triangle(s):</Text>\n<Text>Triangle 1:\n\t(0.2, 0.8, 0, 1)\n"
              "\t(-1.5, 0.2, 0, 1)\n\t(0.5, 1e-05, 0, 1)</Text>\n" +
                  image() + "</Section>\n");
  EXPECT_EQ(test.status, "Pass");
  EXPECT_EQ(test.reason, "");
  EXPECT_EQ(test.subpixel_bits, 8);
  ASSERT_EQ(test.drawings.size(), 1);
  const DeqpDrawing& drawing = test.drawings[0];
  EXPECT_EQ(drawing.section, "Test iteration 1 / 3");
  EXPECT_EQ(drawing.image.bytes, std::string("\1\2\3"));
  const Case c = case_of(test, drawing);
  EXPECT_EQ(c.rules, Rules::opengl);
  EXPECT_EQ(c.positions[1], (ClipVertex{-1.5F, 0.2F, 0, 1}));
  EXPECT_EQ(c.positions[2], (ClipVertex{0.5F, 1e-5F, 0, 1}));
  EXPECT_EQ(c.picture->channels[0].shows, "coverage");
  EXPECT_EQ(c.picture->first_row, FirstRow::bottom);
  const auto open = uncertainty_of(drawing);
  ASSERT_TRUE(open.has_value());
  EXPECT_EQ(open->pixels, 0) << "fewer than six digits are exact";
}

TEST(DeqpLog, NumbersOfSixDigitsWereRounded) {
  const DeqpTest one =
      test_of(kTest + std::string("triangle_strip"), vertices("0.123456", "1") + image());
  ASSERT_EQ(one.drawings.size(), 1);
  const auto open = uncertainty_of(one.drawings[0]);
  ASSERT_TRUE(open.has_value());
  // One unit of NDC is half a pixel here, and the last digit leaves half a unit of 1e-6.
  EXPECT_NEAR(open->pixels, 0.5 * 0.5e-6, 1e-8);
  EXPECT_EQ(open->weights, 0);

  const DeqpTest projected =
      test_of(kTest + std::string("triangle_strip"), vertices("0.5", "2.00001") + image());
  const auto wide = uncertainty_of(projected.drawings.at(0));
  ASSERT_TRUE(wide.has_value());
  EXPECT_NEAR(wide->weights, 2 * 0.5e-5 / 2, 2e-7);
  EXPECT_GT(wide->pixels, 0);

  const DeqpTest lost =
      test_of(kTest + std::string("triangle_strip"), vertices("0.123456", "0") + image());
  EXPECT_FALSE(uncertainty_of(lost.drawings.at(0)).has_value());
}

TEST(DeqpLog, TopologyFollowsTheTestsName) {
  const auto triangles = [](const std::string& path) {
    const DeqpTest test = test_of(path, vertices() + image());
    return test.drawings.empty() ? std::vector<Triangle>()
                                 : case_of(test, test.drawings[0]).triangles;
  };
  EXPECT_EQ(triangles(kTest + std::string("triangle_strip")),
            (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(triangles(kTest + std::string("triangle_fan")),
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  // The provoking vertex of Vulkan is the first.
  EXPECT_EQ(triangles("dEQP-VK.rasterization.flatshading.triangle_fan"),
            (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}}));
  EXPECT_EQ(test_of(kTest + std::string("line_strip"), vertices() + image()).reason,
            "draws lines or points");
  EXPECT_EQ(test_of(kTest + std::string("triangles"), vertices() + image()).reason,
            "the log lacks vertices");
}

TEST(DeqpLog, SaysWhyADrawingCannotBeJudged) {
  const std::string strip = kTest + std::string("triangle_strip");
  const auto reason = [&](const std::string& body) { return test_of(strip, body).reason; };
  EXPECT_THAT(reason("<Text>Sample count = 4</Text>" + vertices() + image()),
              HasSubstr("4 samples per pixel"));
  EXPECT_THAT(reason(vertices()), HasSubstr("--deqp-log-images=enable"));
  EXPECT_THAT(reason("<Text>Drawing gray triangles with shared edges.</Text>"),
              HasSubstr("positions of its vertices"));
  EXPECT_THAT(
      reason(vertices() + "<Text>Verifying rasterization result. Native format is RGB565</Text>" +
             image()),
      HasSubstr("8 bits"));
  EXPECT_THAT(reason("<Text>unrelated &lt;b&gt; &amp; so on</Text>"), HasSubstr("no drawing"));
  EXPECT_THAT(reason(vertices("nan") + image()), HasSubstr("cannot be read"));
}

TEST(DeqpLog, ATestThatCrashedHasTheVerdictOfItsLastLine) {
  const auto tests = parse_deqp_log(
      "#beginTestCaseResult a\n<?xml version=\"1.0\"?>\n<TestCaseResult>\n<ShaderSource>#version "
      "300 es\n#endif</ShaderSource><Text>half\n#terminateTestCaseResult Crash\n",
      "log");
  ASSERT_TRUE(tests.has_value());
  EXPECT_EQ(tests->front().status, "Crash");
}

TEST(DeqpLog, BrokenLogsAreRefusedInOneLine) {
  const std::string strip = kTest + std::string("triangle_strip");
  EXPECT_THAT(error_of("<html>"), HasSubstr("not a log of dEQP"));
  EXPECT_THAT(error_of(log_of(strip, "<Text>a</Number>")), HasSubstr("ends nothing"));
  EXPECT_THAT(error_of(log_of(strip, "<Text a=b>")), HasSubstr("not XML as dEQP writes it"));
  EXPECT_THAT(error_of(log_of(strip, "<Section>")), HasSubstr("ends nothing"));
  EXPECT_THAT(error_of(log_of(strip, vertices() + image("AQI"))), HasSubstr("not base64"));
  EXPECT_THAT(error_of(log_of(strip, vertices() + image("A=ID"))), HasSubstr("not base64"));
  std::string deep;
  for (int i = 0; i < 40; ++i) deep += "<a>";
  EXPECT_THAT(error_of(log_of(strip, deep)), HasSubstr("too deep"));
}

TEST(DeqpLog, TheSmallLogHasSixTests) {
  const std::string file = std::string(RASTERCHECK_SOURCE_DIR) + "/tests/cases/deqp/small.qpa";
  const auto tests = parse_deqp_log(read_text(file).value(), file);
  ASSERT_TRUE(tests.has_value());
  EXPECT_EQ(tests->size(), 6);
}

}  // namespace
}  // namespace rastercheck::cases::deqp_log_test
