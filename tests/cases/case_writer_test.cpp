#include "cases/case_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cases/case_reader.h"
#include "cases/names.h"

namespace rastercheck::cases::case_writer_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr float kMax = std::numeric_limits<float>::max();
constexpr float kLeast = std::numeric_limits<float>::denorm_min();

Case read_back(const Case& c) {
  const Result<Case> read = parse_case(to_json(c), "written.json");
  EXPECT_TRUE(read.has_value()) << to_string(read.error()) << "\n" << to_json(c);
  return read.value_or(Case{});
}

/// The bit patterns of all floats of a case, because == does not tell -0 from 0.
std::vector<std::uint32_t> bits_of(const Case& c) {
  std::vector<std::uint32_t> bits;
  const auto add = [&bits](std::span<const float> values) {
    for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  };
  const Viewport& v = c.viewport;
  add(std::array{v.x, v.y, v.width, v.height, v.min_depth, v.max_depth});
  add(std::array{c.depth_bias.constant, c.depth_bias.slope, c.depth_bias.clamp});
  if (c.coverage) add(std::array{c.coverage->position_error});
  if (c.camera) {
    add(c.camera->model);
    add(c.camera->view);
    add(c.camera->projection);
  }
  for (const ClipVertex& p : c.positions) add(std::array{p.x, p.y, p.z, p.w});
  add(c.attribute_values);
  add(c.clip_distances);
  return bits;
}

void expect_read_back_the_same(const Case& c) {
  const Case read = read_back(c);
  EXPECT_EQ(read, c) << to_json(c);
  EXPECT_EQ(bits_of(read), bits_of(c)) << to_json(c);
}

Case one_triangle() {
  Case c;
  c.framebuffer = {64, 48, 1};
  c.viewport = {0, 0, 64, 48, 0, 1};
  c.positions = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  c.triangles = {{0, 1, 2}};
  return c;
}

/// A case in which no key has its default value.
Case every_key() {
  Case c;
  c.name = "all of it";
  c.framebuffer = {1, 16384, 16};
  c.viewport = {-0.5F, 1e6F, 16384, -16384, 1, 0.25F};
  c.rules = Rules::opengl;
  c.coverage = Snapping{16, Rounding::unspecified, 0x1.99999ap-4F};
  c.basis = Basis::snapped;
  c.fill_rule = TieRule::top_left;
  c.cull = Cull::back;
  c.front_face = FrontFace::cw;
  c.scissor = Scissor{-16384, 3, 0, 16384};
  c.depth_test = DepthTest::less;
  c.depth_clear = 0.1F;
  c.depth_clamp = true;
  c.depth_bias = {16777217.0F * 2, -0.1F, 0x1p-24F};
  c.depth_format = DepthFormat::unorm24;
  c.attributes = {{"u", Interpolation::noperspective, Location::centroid},
                  {"v", Interpolation::flat, Location::center}};
  c.camera = Camera{};
  for (std::size_t i = 0; i < 16; ++i) {
    c.camera->model[i] = static_cast<float>(i) / 3;
    c.camera->view[i] = -static_cast<float>(i) / 7;
    c.camera->projection[i] = static_cast<float>(i) * 1e30F;
  }
  c.positions = {{1, 2, 3, 4}, {5, 6, 7, -8}};
  c.attribute_values = {0.1F, 0.2F, 0.3F, 0.4F};
  c.clip_distances = {1, 2, 3, 4, 5, 6, 7, 8, -1, -2, -3, -4, -5, -6, -7, -8};
  c.clip_distance_count = 8;
  c.triangles = {{0, 1, 1}, {1, 0, 0}};
  c.found = Found{"law",
                  "cpu:threads=2",
                  "violated",
                  std::numeric_limits<std::uint64_t>::max(),
                  std::uint64_t{1} << 63,
                  "depth",
                  "several samples"};
  c.essential = {"samples", "nonpositive_w"};
  c.choices = 0xfedcba9876543210U;
  c.picture = PictureLayout{{{"R", "u", 0.1F}, {"id", "triangle", std::nullopt}},
                            Storage::srgb8,
                            StoreRounding::either,
                            FirstRow::bottom,
                            ResolveOf::stored,
                            Alpha::premultiplied,
                            Blend::additive};
  return c;
}

TEST(CaseWriter, ReadBackGivesTheSameCaseWithEveryKeySet) {
  expect_read_back_the_same(every_key());
}

TEST(CaseWriter, ReadBackGivesTheSameCaseWithEveryKeyAtItsDefault) {
  expect_read_back_the_same(one_triangle());
}

// Kills: leaving out a key that has the default value of other rules.
TEST(CaseWriter, DefaultsThatDependOnTheRulesSurviveUnderAllRules) {
  for (const Rules rules : {Rules::opengl, Rules::vulkan, Rules::d3d}) {
    for (const Basis basis : {Basis::ideal, Basis::snapped, Basis::unspecified}) {
      for (const TieRule tie : {TieRule::top_left, TieRule::bottom_left}) {
        Case c = one_triangle();
        c.rules = rules;
        c.basis = basis;
        c.fill_rule = tie;
        expect_read_back_the_same(c);
      }
    }
  }
}

TEST(CaseWriter, ExtremeFloatsSurvive) {
  Case c = one_triangle();
  c.attributes = {{"a"}, {"b"}};
  c.positions = {{kMax, -kMax, kLeast, -kLeast},
                 {0.0F, -0.0F, std::nextafter(0x1p-126F, 0.0F), 0x1p-126F},
                 {0.1F, 16777215.0F, -0.0F, 1}};
  c.attribute_values = {-0.0F, 0.0F, kMax, kLeast, 0x1.fffffcp-127F, -0.0F};
  c.clip_distance_count = 1;
  c.clip_distances = {-0.0F, kLeast, -kMax};
  c.viewport.x = -0.0F;
  c.viewport.min_depth = -0.0F;
  expect_read_back_the_same(c);
}

// Kills: comparing a float with zero to find out whether it has its default value.
TEST(CaseWriter, APositionErrorOfMinusZeroKeepsItsSign) {
  Case c = one_triangle();
  c.coverage = Snapping{8, Rounding::nearest_even, -0.0F};
  expect_read_back_the_same(c);
}

TEST(CaseWriter, EveryPartOfADepthBiasSurvives) {
  for (const DepthBias& bias : {DepthBias{1, 0, 0}, DepthBias{0, -1, 0}, DepthBias{0, 0, 0.5F},
                                DepthBias{-0.0F, 0, 0}, DepthBias{0, 0, -0.0F}}) {
    Case c = one_triangle();
    c.depth_bias = bias;
    expect_read_back_the_same(c);
  }
  for (const DepthFormat format : kDepthFormatsOfCases) {
    Case c = one_triangle();
    c.depth_format = format;
    expect_read_back_the_same(c);
  }
}

TEST(CaseWriter, NamesOfAnyTextSurvive) {
  for (const std::string& name :
       {std::string("quote \" backslash \\ slash /"), std::string("line\nline\r\n\ttab"),
        std::string("gr\xc3\xb6\xc3\x9f"
                    "e \xe2\x82\xac \xf0\x9f\x98\x80"),
        std::string("\0\x01", 2), std::string("{} {0} %s"), std::string("</script>"),
        std::string()}) {
    Case c = every_key();
    c.name = name;
    c.attributes[0].name = name;
    c.found = Found{name, name, name, 0, 0};
    expect_read_back_the_same(c);
  }
}

TEST(CaseWriter, LinesAndPointsSurvive) {
  Case c;
  c.framebuffer = {4, 4, 1};
  c.viewport = {0, 0, 4, 4, 0, 1};
  c.rules = Rules::opengl;
  c.fill_rule = default_fill_rule(c.rules);
  c.positions = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  c.primitive = Primitive::lines;
  c.triangles = {{0, 1, 1}, {2, 0, 0}};
  c.line_width = 0x1.99999ap-4F;
  for (const LineMode mode :
       {LineMode::rectangular, LineMode::parallelogram, LineMode::bresenham}) {
    c.line_mode = mode;
    EXPECT_EQ(parse_case(to_json(c), "").value(), c);
  }
  c.primitive = Primitive::points;
  c.triangles = {{2, 2, 2}};
  c.line_width = 1;
  c.line_mode = LineMode::rectangular;
  c.point_size = 3.5F;
  EXPECT_EQ(parse_case(to_json(c), "").value(), c);
}

TEST(CaseWriter, ACaseWithNothingToDrawSurvives) {
  Case c = one_triangle();
  c.triangles.clear();
  expect_read_back_the_same(c);
  c.positions.clear();
  expect_read_back_the_same(c);
}

TEST(CaseWriter, WritingAgainWhatWasReadGivesTheSameText) {
  const std::string text = to_json(every_key());
  EXPECT_EQ(to_json(read_back(every_key())), text);
}

TEST(CaseWriter, FloatsAreHexAndVerticesOnLinesOfTheirOwn) {
  const std::string text = to_json(one_triangle());
  EXPECT_THAT(
      text, HasSubstr("\n    {\"position\": [\"0x1p+0\", \"0x0p+0\", \"0x0p+0\", \"0x1p+0\"]},\n"));
  EXPECT_THAT(text, HasSubstr("\n    [0, 1, 2]\n"));
  EXPECT_TRUE(text.ends_with("}\n"));
}

TEST(CaseWriter, OptionalKeysThatAreNotSetAreLeftOut) {
  const std::string text = to_json(one_triangle());
  for (const char* key :
       {"\"basis\"", "\"fill_rule\"", "\"scissor\"", "\"depth_test\"", "\"depth_clamp\"",
        "\"depth_clear\"", "\"depth_bias\"", "\"depth_format\"", "\"essential\"", "\"choices\"",
        "\"attributes\"", "\"camera\"", "\"clip_distances\"", "\"found\"", "\"position_error\""}) {
    EXPECT_THAT(text, Not(HasSubstr(key)));
  }
}

/// Finite floats in which each bit is as likely to be set as not.
rc::Gen<float> any_float() {
  return rc::gen::map(rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint32_t>()),
                      [](std::uint32_t pattern) {
                        // An exponent of all ones means NaN or infinity: clear one of its bits.
                        if ((pattern & 0x7f800000U) == 0x7f800000U) pattern &= ~0x00800000U;
                        return std::bit_cast<float>(pattern);
                      });
}

rc::Gen<std::vector<float>> floats(std::size_t count) {
  return rc::gen::container<std::vector<float>>(count, any_float());
}

Viewport random_viewport() {
  Viewport viewport;
  viewport.x = *any_float();
  viewport.y = *any_float();
  viewport.width = static_cast<float>(*rc::gen::inRange(-kMaxSize, kMaxSize + 1));
  viewport.height = static_cast<float>(*rc::gen::inRange(-(1 << 23), 1 << 23)) * 0x1p-10F;
  // The ends lie in separate halves of 0…1, so that the rules of every API accept the depth range.
  viewport.min_depth = static_cast<float>(*rc::gen::inRange(0, 1 << 23)) * 0x1p-24F;
  viewport.max_depth = 1 - static_cast<float>(*rc::gen::inRange(0, 1 << 23)) * 0x1p-24F;
  return viewport;
}

Case random_case() {
  Case c;
  c.rules = *rc::gen::element(Rules::opengl, Rules::vulkan, Rules::d3d);
  c.viewport = random_viewport();
  c.framebuffer.width = *rc::gen::inRange(1, kMaxSize + 1);
  c.framebuffer.height = *rc::gen::inRange(1, kMaxSize + 1);
  c.framebuffer.samples = *rc::gen::element(1, 2, 4, 8, 16);
  c.basis = *rc::gen::element(Basis::ideal, Basis::snapped, Basis::unspecified);
  c.fill_rule = *rc::gen::element(TieRule::top_left, TieRule::bottom_left);
  if (*rc::gen::arbitrary<bool>()) {
    Snapping snapping;
    snapping.subpixel_bits = *rc::gen::inRange(0, kMaxSubpixelBits + 1);
    snapping.position_error = static_cast<float>(*rc::gen::inRange(0, 1 << 24)) * 0x1p-12F;
    c.coverage = snapping;
  }
  c.depth_bias = {*any_float(), *any_float(), *any_float()};
  c.depth_format = *rc::gen::elementOf(kDepthFormatsOfCases);
  const auto attributes = *rc::gen::inRange<std::size_t>(0, 4);
  for (std::size_t i = 0; i < attributes; ++i) {
    const auto interpolation =
        *rc::gen::element(Interpolation::smooth, Interpolation::noperspective, Interpolation::flat);
    const auto location = *rc::gen::element(Location::sample, Location::center, Location::centroid);
    c.attributes.push_back({"a" + std::to_string(i), interpolation, location});
  }
  if (*rc::gen::arbitrary<bool>()) {
    c.camera = Camera{};
    for (Matrix4* matrix : {&c.camera->model, &c.camera->view, &c.camera->projection}) {
      for (float& element : *matrix) element = *any_float();
    }
  }
  const auto vertices = *rc::gen::inRange<std::size_t>(1, 8);
  const auto numbers = *floats(4 * vertices);
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    c.positions.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  }
  c.attribute_values = *floats(attributes * vertices);
  c.clip_distance_count = *rc::gen::inRange<std::size_t>(0, kMaxClipDistances + 1);
  c.clip_distances = *floats(c.clip_distance_count * vertices);
  const auto indices = *rc::gen::container<std::vector<std::uint32_t>>(
      9, rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(vertices)));
  for (std::size_t i = 0; i < 9; i += 3) {
    c.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  }
  return c;
}

// Kills: a float written with a digit too few; a key left out, misspelt or swapped with another.
RC_GTEST_PROP(CaseWriter, ReadBackGivesTheSameBitsForRandomCases, ()) {
  const Case c = random_case();
  const Result<Case> read = parse_case(to_json(c), "written.json");
  RC_ASSERT(read.has_value());
  RC_ASSERT(*read == c);
  RC_ASSERT(bits_of(*read) == bits_of(c));
}

}  // namespace
}  // namespace rastercheck::cases::case_writer_test
