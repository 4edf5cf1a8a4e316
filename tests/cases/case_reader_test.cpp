// Tests what the reader accepts; broken_inputs_test.cpp tests what it refuses.

#include "cases/case_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases/case_writer.h"
#include "cases/json_node.h"

namespace rastercheck::cases::case_reader_test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A document with only the required keys.
json minimal() {
  return json::parse(R"({
    "format": "rastercheck-case", "version": 1,
    "framebuffer": {"width": 8, "height": 4},
    "viewport": {"x": 0, "y": 0, "width": 8, "height": 4},
    "rules": "vulkan",
    "vertices": [{"position": [0, 0, 0, 1]}, {"position": [1, 0, 0, 1]}, {"position": [0, 1, 0, 1]}],
    "triangles": [[0, 1, 2]]
  })");
}

Case read(const std::string& text) {
  const Result<Case> c = parse_case(text, "test.json");
  EXPECT_TRUE(c.has_value()) << to_string(c.error());
  return c.value_or(Case{});
}

/// Reads the minimal document with one key replaced or added.
Case read_with(const std::string& key, const std::string& value) {
  json document = minimal();
  document[key] = json::parse(value);
  return read(document.dump());
}

/// Reads the minimal document with this text as its first position.
ClipVertex read_position(const std::string& numbers) {
  // Edits the text, because a document would lose how the numbers are written.
  std::string text = minimal().dump();
  const std::string before = R"({"position":[0,0,0,1]})";
  text.replace(text.find(before), before.size(), R"({"position":[)" + numbers + "]}");
  return read(text).positions.at(0);
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

TEST(CaseReader, OptionalKeysHaveTheirDefaults) {
  const Case c = read(minimal().dump());
  EXPECT_EQ(c.name, "");
  EXPECT_EQ(c.framebuffer.samples, 1);
  EXPECT_EQ(c.viewport.min_depth, 0);
  EXPECT_EQ(c.viewport.max_depth, 1);
  EXPECT_FALSE(c.coverage.has_value());
  EXPECT_EQ(c.cull, Cull::none);
  EXPECT_EQ(c.front_face, FrontFace::ccw);
  EXPECT_FALSE(c.scissor.has_value());
  EXPECT_EQ(c.depth_test, DepthTest::none);
  EXPECT_FALSE(c.depth_clear.has_value());
  EXPECT_FALSE(c.depth_clamp);
  EXPECT_EQ(c.depth_bias, DepthBias());
  EXPECT_TRUE(c.depth_bias.is_none());
  EXPECT_EQ(c.depth_format, DepthFormat::float32);
  EXPECT_FALSE(c.essential.has_value());
  EXPECT_FALSE(c.choices.has_value());
  EXPECT_TRUE(c.attributes.empty());
  EXPECT_FALSE(c.camera.has_value());
  EXPECT_EQ(c.clip_distance_count, 0U);
  EXPECT_FALSE(c.found.has_value());
}

TEST(CaseReader, DefaultsOfTieAndBasisFollowTheRules) {
  const Case opengl = read_with("rules", R"("opengl")");
  EXPECT_EQ(opengl.fill_rule, TieRule::bottom_left);
  EXPECT_EQ(opengl.basis, Basis::ideal);
  const Case vulkan = read_with("rules", R"("vulkan")");
  EXPECT_EQ(vulkan.fill_rule, TieRule::top_left);
  EXPECT_EQ(vulkan.basis, Basis::ideal);
  const Case d3d = read_with("rules", R"("d3d")");
  EXPECT_EQ(d3d.fill_rule, TieRule::top_left);
  EXPECT_EQ(d3d.basis, Basis::snapped);
}

TEST(CaseReader, DefaultsWithinObjects) {
  const Case c = read_with("coverage", R"({"subpixel_bits": 0})");
  ASSERT_TRUE(c.coverage.has_value());
  EXPECT_EQ(c.coverage.value(), (Snapping{0, Rounding::nearest_even, 0}));
  EXPECT_EQ(read_with("camera", "{}").camera, Camera{});
  EXPECT_EQ(read_with("found", "{}").found, Found{});
  EXPECT_EQ(read_with("depth_bias", "{}").depth_bias, DepthBias());
  EXPECT_EQ(read_with("depth_bias", R"({"constant": 0})").depth_bias, DepthBias());
  EXPECT_EQ(read_with("depth_bias", R"({"slope": 2})").depth_bias, (DepthBias{0, 2, 0}));

  json document = minimal();
  document["attributes"] = json::parse(R"([{"name": "u"}])");
  for (json& vertex : document["vertices"]) vertex["attributes"] = {0};
  EXPECT_THAT(read(document.dump()).attributes,
              ElementsAre(Attribute{"u", Interpolation::smooth, Location::sample}));
}

TEST(CaseReader, EveryKeyOfTheStateIsReadIntoItsField) {
  EXPECT_EQ(read_with("name", R"("a \"b\" \u20ac")").name, "a \"b\" \xe2\x82\xac");
  EXPECT_EQ(read_with("framebuffer", R"({"width": 3, "height": 16384, "samples": 16})").framebuffer,
            (FramebufferSize{3, 16384, 16}));
  EXPECT_EQ(read_with("viewport", R"({"x": -1, "y": 2.5, "width": 3, "height": -4,
                                      "min_depth": 0.75, "max_depth": 0.25})")
                .viewport,
            (Viewport{-1, 2.5F, 3, -4, 0.75F, 0.25F}));
  EXPECT_EQ(read_with("rules", R"("d3d")").rules, Rules::d3d);
  EXPECT_FALSE(read_with("coverage", R"("exact")").coverage.has_value());
  EXPECT_EQ(read_with("coverage", R"({"subpixel_bits": 16, "rounding": "half_up",
                                      "position_error": "0x1p-3"})")
                .coverage,
            (Snapping{16, Rounding::half_up, 0.125F}));
  EXPECT_EQ(read_with("basis", R"("unspecified")").basis, Basis::unspecified);
  EXPECT_EQ(read_with("fill_rule", R"("bottom_left")").fill_rule, TieRule::bottom_left);
  EXPECT_EQ(read_with("cull", R"("front")").cull, Cull::front);
  EXPECT_EQ(read_with("front_face", R"("cw")").front_face, FrontFace::cw);
  EXPECT_EQ(read_with("scissor", R"({"x": -5, "y": 6, "width": 0, "height": 8})").scissor,
            (Scissor{-5, 6, 0, 8}));
  EXPECT_EQ(read_with("depth_test", R"("less")").depth_test, DepthTest::less);
  EXPECT_EQ(read_with("depth_clear", "0.75").depth_clear, 0.75F);
  EXPECT_THAT(*read_with("essential", R"(["rules", "centroid"])").essential,
              ElementsAre("rules", "centroid"));
  EXPECT_THAT(*read_with("essential", "[]").essential, IsEmpty());
  EXPECT_EQ(read_with("choices", "18446744073709551615").choices, 18446744073709551615U);
  EXPECT_TRUE(read_with("depth_clamp", "true").depth_clamp);
  EXPECT_FALSE(read_with("depth_clamp", "false").depth_clamp);
  EXPECT_EQ(
      read_with("depth_bias", R"({"constant": -3, "slope": 0.5, "clamp": "-0x1p-8"})").depth_bias,
      (DepthBias{-3, 0.5F, -0x1p-8F}));
  EXPECT_EQ(read_with("found", R"({"property": "l", "backend": "b", "verdict": "v", "seed": 1,
                                   "index": 2})")
                .found,
            (Found{"l", "b", "v", 1, 2}));
}

TEST(CaseReader, VerticesAreReadInOrderWithAttributesAndClipDistances) {
  json document = minimal();
  document["attributes"] = json::parse(
      R"([{"name": "u", "interpolation": "noperspective", "location": "center"},
          {"name": "v", "interpolation": "flat", "location": "centroid"}])");
  document["vertices"] = json::parse(
      R"([{"position": [1, 2, 3, 4], "attributes": [10, 11], "clip_distances": [20]},
          {"position": [5, 6, 7, 8], "attributes": [12, 13], "clip_distances": ["0x1p4"]}])");
  document["triangles"] = json::parse("[[1, 0, 0], [0, 1, 1]]");
  const Case c = read(document.dump());
  EXPECT_THAT(c.attributes,
              ElementsAre(Attribute{"u", Interpolation::noperspective, Location::center},
                          Attribute{"v", Interpolation::flat, Location::centroid}));
  EXPECT_THAT(c.positions, ElementsAre(ClipVertex{1, 2, 3, 4}, ClipVertex{5, 6, 7, 8}));
  EXPECT_THAT(c.attribute_values, ElementsAre(10, 11, 12, 13));
  EXPECT_THAT(c.attributes_of(1), ElementsAre(12, 13));
  EXPECT_EQ(c.clip_distance_count, 1U);
  EXPECT_THAT(c.clip_distances_of(1), ElementsAre(16));
  EXPECT_THAT(c.triangles, ElementsAre(Triangle{1, 0, 0}, Triangle{0, 1, 1}));
}

TEST(CaseReader, MatricesAreReadRowByRowEachIntoItsOwn) {
  json camera;
  Camera expected;
  float next = 1;
  for (const auto& [key, matrix] :
       {std::pair{"model", &expected.model}, std::pair{"view", &expected.view},
        std::pair{"projection", &expected.projection}}) {
    for (float& element : *matrix) element = next++;
    camera[key] = *matrix;
  }
  EXPECT_EQ(read_with("camera", camera.dump()).camera, expected);
}

// Kills: swapping two words in the table of words, which the writer uses as well.
TEST(CaseReader, EveryWordMeansWhatItSays) {
  EXPECT_EQ(read_with("rules", R"("opengl")").rules, Rules::opengl);
  EXPECT_EQ(read_with("rules", R"("vulkan")").rules, Rules::vulkan);
  EXPECT_EQ(read_with("cull", R"("none")").cull, Cull::none);
  EXPECT_EQ(read_with("cull", R"("back")").cull, Cull::back);
  EXPECT_EQ(read_with("front_face", R"("ccw")").front_face, FrontFace::ccw);
  EXPECT_EQ(read_with("depth_test", R"("none")").depth_test, DepthTest::none);
  EXPECT_EQ(read_with("depth_format", R"("float32")").depth_format, DepthFormat::float32);
  EXPECT_EQ(read_with("depth_format", R"("unorm16")").depth_format, DepthFormat::unorm16);
  EXPECT_EQ(read_with("depth_format", R"("unorm24")").depth_format, DepthFormat::unorm24);
  EXPECT_EQ(read_with("fill_rule", R"("top_left")").fill_rule, TieRule::top_left);
  EXPECT_EQ(read_with("basis", R"("ideal")").basis, Basis::ideal);
  EXPECT_EQ(read_with("basis", R"("snapped")").basis, Basis::snapped);
  const auto rounding = [](const char* word) {
    const Case c = read_with("coverage", json{{"subpixel_bits", 8}, {"rounding", word}}.dump());
    return c.coverage.value_or(Snapping{}).rounding;
  };
  EXPECT_EQ(rounding("nearest_even"), Rounding::nearest_even);
  EXPECT_EQ(rounding("unspecified"), Rounding::unspecified);
}

// Kills: reading integers as integers, which have no minus zero.
TEST(CaseReader, MinusZeroKeepsItsSignHoweverItIsWritten) {
  const ClipVertex p = read_position(R"(-0, "-0x0p0", -0.0, -0e3)");
  for (const float value : {p.x, p.y, p.z, p.w}) EXPECT_EQ(bits(value), bits(-0.0F));
  const ClipVertex q = read_position(R"(0, "0x0p0", 0.0, "+0x0p0")");
  for (const float value : {q.x, q.y, q.z, q.w}) EXPECT_EQ(bits(value), bits(0.0F));
}

TEST(CaseReader, DecimalsThatAreFloatsAreTakenExactly) {
  EXPECT_EQ(read_position("0.5, 16777216, -1.25e-1, 3.4028234663852886e38"),
            (ClipVertex{0.5F, 16777216, -0.125F, std::numeric_limits<float>::max()}));
  EXPECT_EQ(read_position("1.401298464324817e-45, 0.100000001490116119384765625, 1, 1"),
            (ClipVertex{std::numeric_limits<float>::denorm_min(), 0.1F, 1, 1}));
}

// By hand: 0.1 is 0x1.999999…p-4 and 1/3 is 0x1.555555…p-2; the 24th bit of both rounds up.
TEST(CaseReader, DecimalsAreRoundedIfTheCaseSaysSo) {
  json document = minimal();
  document["vertices"][1]["position"] = {0.1, -0.3333333333333333, 0.5, 1};
  const auto refused = parse_case(document.dump(), "test.json");
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.error()),
            "test.json: /vertices/1/position/0: not exactly a float32: 0.1; the nearest is "
            "\"0x1.99999ap-4\", which \"round\": true would take");
  document["round"] = true;
  DecimalRounding rounding;
  const auto rounded = parse_case(document.dump(), "test.json", rounding);
  ASSERT_TRUE(rounded) << to_string(rounded.error());
  EXPECT_EQ(rounded->positions[1], (ClipVertex{0x1.99999ap-4F, -0x1.555556p-2F, 0.5F, 1}));
  EXPECT_EQ(rounding.rounded, 2U);
  // Written, it is a case like any other.
  EXPECT_EQ(read(to_json(*rounded)), *rounded);
}

TEST(CaseReader, FloatsThatAreIntegersAreSizesAndIndices) {
  EXPECT_EQ(read_with("framebuffer", R"({"width": 64.0, "height": 1.6e1})").framebuffer,
            (FramebufferSize{64, 16, 1}));
  EXPECT_THAT(read_with("triangles", "[[2.0, 1e0, -0]]").triangles, ElementsAre(Triangle{2, 1, 0}));
  read_with("version", "1.0");
}

TEST(CaseReader, WithACameraPositionsHaveThreeOrFourNumbers) {
  json document = minimal();
  document["camera"] = json::object();
  document["vertices"] = json::parse(
      R"([{"position": [1, 2, 3]}, {"position": [4, 5, 6, 7]}, {"position": [8, 9, 10]}])");
  EXPECT_THAT(read(document.dump()).positions,
              ElementsAre(ClipVertex{1, 2, 3, 1}, ClipVertex{4, 5, 6, 7}, ClipVertex{8, 9, 10, 1}));
}

TEST(CaseReader, SeedAndIndexHaveSixtyFourBits) {
  const Case c =
      read_with("found", R"({"seed": 18446744073709551615, "index": 9223372036854775808})");
  ASSERT_TRUE(c.found.has_value());
  EXPECT_EQ(c.found->seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(c.found->index, std::uint64_t{1} << 63);
}

TEST(CaseReader, NothingToDrawIsACase) {
  const Case c = read_with("triangles", "[]");
  EXPECT_TRUE(c.triangles.empty());
  EXPECT_EQ(c.positions.size(), 3U);
}

/// The minimal document with other primitives than triangles.
json with_primitives(const std::string& key, const std::string& value) {
  json document = minimal();
  document.erase("triangles");
  document[key] = json::parse(value);
  return document;
}

// A line has its second vertex twice and a point its vertex three times, so that whoever asks for
// the vertices of a primitive need not ask what it is.
TEST(CaseReader, LinesAndPointsTakeThePlaceOfTriangles) {
  const Case lines = read(with_primitives("lines", "[[0, 1], [2, 0]]").dump());
  EXPECT_EQ(lines.primitive, Primitive::lines);
  EXPECT_THAT(lines.triangles, ElementsAre(Triangle{0, 1, 1}, Triangle{2, 0, 0}));
  EXPECT_EQ(lines.line_width, 1);
  const Case points = read(with_primitives("points", "[2, 0]").dump());
  EXPECT_EQ(points.primitive, Primitive::points);
  EXPECT_THAT(points.triangles, ElementsAre(Triangle{2, 2, 2}, Triangle{0, 0, 0}));
  EXPECT_EQ(points.point_size, 1);
  EXPECT_EQ(read(minimal().dump()).primitive, Primitive::triangles);
}

TEST(CaseReader, LinesAreWhatTheRulesMakeOfThem) {
  const auto mode = [](const char* rules, int samples) {
    json document = with_primitives("lines", "[]");
    document["rules"] = rules;
    document["framebuffer"]["samples"] = samples;
    return read(document.dump()).line_mode;
  };
  EXPECT_EQ(mode("opengl", 1), LineMode::bresenham);
  EXPECT_EQ(mode("opengl", 4), LineMode::rectangular);
  EXPECT_EQ(mode("vulkan", 1), LineMode::rectangular);
  EXPECT_EQ(mode("d3d", 4), LineMode::bresenham);
  json document = with_primitives("lines", "[]");
  document["line_mode"] = "parallelogram";
  document["line_width"] = 16384;
  EXPECT_EQ(read(document.dump()).line_mode, LineMode::parallelogram);
  EXPECT_EQ(read(document.dump()).line_width, 16384);
}

// What a case says of primitives that it does not have would be ignored without a word.
TEST(CaseReader, KeysOfOtherPrimitivesAreRefused) {
  const auto refusal = [](json document, const std::string& key, const std::string& value) {
    document[key] = json::parse(value);
    const Result<Case> c = parse_case(document.dump(), "f");
    return c ? "" : to_string(c.error());
  };
  EXPECT_EQ(refusal(minimal(), "line_width", "2"),
            "f: /line_width: is of lines only, and the case has triangles");
  EXPECT_EQ(refusal(with_primitives("points", "[]"), "line_mode", "\"rectangular\""),
            "f: /line_mode: is of lines only, and the case has points");
  EXPECT_EQ(refusal(with_primitives("lines", "[]"), "point_size", "2"),
            "f: /point_size: is of points only, and the case has lines");
  EXPECT_EQ(refusal(with_primitives("lines", "[]"), "cull", "\"back\""),
            "f: /cull: is of triangles only, and the case has lines");
  EXPECT_EQ(refusal(with_primitives("points", "[]"), "depth_bias", "{}"),
            "f: /depth_bias: is of triangles only, and the case has points");
  EXPECT_EQ(refusal(minimal(), "points", "[0]"), "f: /points: the case has triangles already");
  EXPECT_EQ(refusal(with_primitives("points", "[]"), "points", "[3]"),
            "f: /points/0: index 3 out of range: there are 3 vertices");
  EXPECT_EQ(refusal(with_primitives("points", "[]"), "point_size", "0"),
            "f: /point_size: must be more than 0");
  json none = minimal();
  none.erase("triangles");
  EXPECT_EQ(refusal(none, "name", "\"\""), "f: /: missing key 'triangles', 'lines' or 'points'");
}

TEST(CaseReader, LimitsAreInclusive) {
  read_with("scissor", R"({"x": -16384, "y": 16384, "width": 16384, "height": 0})");
  read_with("viewport", R"({"x": 1e9, "y": 0, "width": 16384, "height": -16384})");
  read_with("coverage", R"({"subpixel_bits": 16, "position_error": 65536})");
}

// Like the example in docs/case-format.md, but with more members and with one vertex three times.
// A clamp without anything to clamp is no bias, but is kept.
TEST(CaseReader, AClampAloneIsNoBias) {
  const DepthBias bias = read_with("depth_bias", R"({"clamp": 0.5})").depth_bias;
  EXPECT_EQ(bias.clamp, 0.5F);
  EXPECT_TRUE(bias.is_none());
  EXPECT_FALSE(read_with("depth_bias", R"({"slope": "0x1p-149"})").depth_bias.is_none());
  EXPECT_FALSE(read_with("depth_bias", R"({"constant": -1})").depth_bias.is_none());
}

TEST(CaseReader, TheExampleOfTheContractReads) {
  const std::string vertex = R"({"position": [0.5, "0x1.8p-2", 0, 1], "attributes": ["0x1p-3"]})";
  const Case c = read(R"({
      "format": "rastercheck-case", "version": 1, "name": "one vertex behind the eye",
      "framebuffer": {"width": 64, "height": 64, "samples": 1},
      "viewport": {"x": 0, "y": 0, "width": 64, "height": 64, "min_depth": 0, "max_depth": 1},
      "rules": "vulkan",
      "coverage": "exact",
      "cull": "none", "front_face": "ccw",
      "attributes": [{"name": "u", "interpolation": "smooth", "location": "sample"}],
      "vertices": [)" +
                      vertex + "," + vertex + "," + vertex + R"(],
      "triangles": [[0, 1, 2]]
    })");
  EXPECT_EQ(c.name, "one vertex behind the eye");
  EXPECT_EQ(c.positions.at(2), (ClipVertex{0.5F, 0.375F, 0, 1}));
  EXPECT_THAT(c.attributes_of(0), ElementsAre(0.125F));
}

TEST(CaseReader, WhatCannotBeReadAtAllIsAnErrorOfOneLineWithoutAPlace) {
  const std::string missing = testing::TempDir() + "rastercheck_no_such_file.json";
  for (const std::string& file : {missing, testing::TempDir()}) {
    const Result<Case> c = read_case(file);
    ASSERT_FALSE(c.has_value()) << file;
    EXPECT_EQ(c.error().file, file);
    EXPECT_EQ(c.error().place, "");
    EXPECT_THAT(to_string(c.error()), StartsWith(file + ": cannot be read"));
    EXPECT_EQ(to_string(c.error()).find('\n'), std::string::npos);
  }
}

TEST(CaseReader, AnErrorNamesFilePlaceAndReason) {
  json document = minimal();
  document["triangles"][0][1] = 3;
  const Result<Case> c = parse_case(document.dump(), "-");
  ASSERT_FALSE(c.has_value());
  EXPECT_THAT(to_string(c.error()), StartsWith("-: /triangles/0/1: index 3 out of range"));
}

}  // namespace
}  // namespace rastercheck::cases::case_reader_test
