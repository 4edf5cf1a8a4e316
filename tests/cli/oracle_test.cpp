#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace rastercheck::cli::oracle_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The corner triangle of a 4 × 4 Vulkan framebuffer with r = u/4; its window corners are (0,0),
/// (4,0), (0,4). `keys` are further keys of the case.
std::string corner_case(const std::string& keys = "") {
  return R"({"format": "rastercheck-case", "version": 1, "name": "corner \"quoted\"",
    "framebuffer": {"width": 4, "height": 4}, "rules": "vulkan",
    "viewport": {"x": 0, "y": 0, "width": 4, "height": 4}, )" +
         keys + R"("attributes": [{"name": "r"}],
    "vertices": [{"position": [-1, -1, 0, 1], "attributes": [0]},
                 {"position": [1, -1, 0, 1], "attributes": [1]},
                 {"position": [-1, 1, 0, 1], "attributes": [0]}],
    "triangles": [[0, 1, 2]]})";
}

TEST(OracleCommand, PrintsTheContractsJson) {
  const Outcome outcome = run_program({"oracle", "--json", "-"}, corner_case());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json document = json::parse(outcome.out);
  EXPECT_EQ(document.at("format"), "rastercheck-oracle");
  EXPECT_EQ(document.at("version"), 1);
  EXPECT_EQ(document.at("case"), "corner \"quoted\"");
  EXPECT_EQ(document.at("fragments").size(), 6U);
  const json second = {{"triangle", 0},
                       {"x", 1},
                       {"y", 0},
                       {"sample", 0},
                       {"verdict", "required"},
                       {"reason", "inside"},
                       {"depth", "0"},
                       {"attributes", {"3/8"}}};
  EXPECT_EQ(document.at("fragments").at(1), second);
}

TEST(OracleCommand, AddsDetailsWhenAsked) {
  const Outcome outcome = run_program({"oracle", "--json", "--details", "-"}, corner_case());
  const json first = json::parse(outcome.out).at("fragments").at(0);
  EXPECT_EQ(first.at("distance"), (json{0.5, 0.5}));
  EXPECT_EQ(first.at("derivatives"), json::parse(R"([["1/4", "0"]])"));
  EXPECT_EQ(first.at("kappa"), json{"1"});
  EXPECT_EQ(first.at("kappa_d"), json{"5/4"});
}

TEST(OracleCommand, PrintsATableForPeople) {
  const Outcome outcome = run_program({"oracle", "-"}, corner_case());
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("4 x 4 pixels, 1 sample, vulkan rules, exact coverage"));
  EXPECT_THAT(outcome.out, HasSubstr("0.375 = 3/8"));
  EXPECT_THAT(outcome.out, HasSubstr("6 fragments: 6 required, 0 permitted"));
}

TEST(OracleCommand, QuietlyPrintsRowsOnly) {
  const Outcome outcome = run_program({"oracle", "--quiet", "-"}, corner_case());
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 6);
}

TEST(OracleCommand, ClipsRoundOnce) {
  // The exact x is −(1 + 3·2^-24) at vertices 0 and 2 and 1 + 2^-24 at vertex 1; with e = 2^-24, r
  // at u = 1/2 is (1/2 + 6e)/(4 + 8e). Rounded with ties to even, x is −(1 + 2^-22) and 1: r = (1/2
  // + 2^-21)/(4 + 2^-21).
  const std::string camera =
      R"("camera": {"projection": ["0x1.000002p+0", 0, 0, "-0x1p-24", 0,1,0,0, 0,0,1,0, 0,0,0,1]}, )";
  const auto value = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"oracle", "--json", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_program(arguments, corner_case(camera));
    return json::parse(outcome.out).at("fragments").at(0).at("attributes").at(0);
  };
  EXPECT_EQ(value({}), "4194307/33554436");
  EXPECT_EQ(value({"--clip"}), "1048577/8388609");
}

TEST(OracleCommand, WantsAllForManySamples) {
  std::string text = corner_case();
  const std::string from = R"({"width": 4, "height": 4}, "rules")";
  text.replace(text.find(from), from.size(), R"({"width": 16384, "height": 8192}, "rules")");
  const Outcome refused = run_program({"oracle", "-"}, text);
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("-: /framebuffer: 134217728 samples exceed the limit of 2^26"));
  const Outcome all = run_program({"oracle", "--all", "--json", "-"}, text);
  EXPECT_EQ(all.code, 0);
  EXPECT_EQ(json::parse(all.out).at("fragments").size(), 6U);
}

TEST(OracleCommand, RefusesAClipPositionBeyondFloat32) {
  const std::string camera =
      R"("camera": {"projection": ["0x1p+127",0,0,0, 0,1,0,0, 0,0,1,"0x1p+127", 0,0,0,1],
                    "model": [4,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}, )";
  const Outcome outcome = run_program({"oracle", "--clip", "-"}, corner_case(camera));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "rastercheck: -: /vertices/0/position: its clip x overflows float32\n");
  EXPECT_EQ(run_program({"oracle", "-"}, corner_case(camera)).code, 0);
}

TEST(OracleCommand, GivesRangesUnderAnUnspecifiedContract) {
  const std::string keys =
      R"("coverage": {"subpixel_bits": 8, "rounding": "unspecified"}, "basis": "unspecified", )";
  const Outcome outcome = run_program({"oracle", "--json", "-"}, corner_case(keys));
  const json first = json::parse(outcome.out).at("fragments").at(0);
  EXPECT_EQ(first.at("attributes"), json::parse(R"([["1/8", "1/8"]])"));
  EXPECT_EQ(first.at("depth"), json::parse(R"(["0", "0"])"));
}

}  // namespace
}  // namespace rastercheck::cli::oracle_test
