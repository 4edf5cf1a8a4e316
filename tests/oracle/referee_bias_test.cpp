// Holds the referee's depths, biased and stored, against cases that are calculated by hand
// (tests/oracle/bias_cases), and against laws of the bias.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_reader.h"
#include "cases/files.h"
#include "cases/json.h"
#include "oracle/referee.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::referee_bias_test {
namespace {

using nlohmann::json;

const std::string kFolder = RASTERCHECK_SOURCE_DIR "/tests/oracle/bias_cases/";
const std::string kDepths = RASTERCHECK_SOURCE_DIR "/tests/oracle/bias_depths.json";

json expected_fragments() {
  const auto text = cases::read_text(kDepths);
  return text ? json::parse(*text) : json::object();
}

std::vector<std::string> case_files() {
  std::vector<std::string> files;
  const json expected = expected_fragments();
  for (const auto& [file, fragments] : expected.items()) files.push_back(file);
  return files;
}

/// The referee's fragments in the words of bias_depths.json, each triangle drawn alone.
json fragments_of(const cases::Case& c) {
  json found = json::array();
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    for (int y = 0; y < c.framebuffer.height; ++y) {
      for (int x = 0; x < c.framebuffer.width; ++x) {
        const auto fragment = referee(c, t, x, y, 0);
        if (!fragment) continue;
        json one = {{"triangle", t}, {"x", x}, {"y", y}, {"depth", fragment->depth.to_string()}};
        if (!fragment->stored.empty()) one["nearest"] = fragment->stored;
        found.push_back(one);
      }
    }
  }
  return found;
}

class BiasCases : public testing::TestWithParam<std::string> {};

TEST_P(BiasCases, HaveTheDepthsCalculatedByHand) {
  const auto text = cases::read_text(kFolder + GetParam());
  ASSERT_TRUE(text);
  const auto c = cases::parse_case(*text, GetParam());
  ASSERT_TRUE(c) << to_string(c.error());
  json expected = expected_fragments().at(GetParam());
  for (json& fragment : expected) {
    fragment.erase("nearly_nearest");
    fragment.erase("either");
  }
  const json found = fragments_of(*c);
  if (c->depth_test == cases::DepthTest::none) {
    EXPECT_EQ(found, expected);
    return;
  }
  // The referee draws each triangle alone: what a depth test leaves must be among its fragments.
  EXPECT_FALSE(found.empty());
  for (const json& fragment : expected) {
    EXPECT_NE(std::find(found.begin(), found.end(), fragment), found.end()) << fragment << found;
  }
}

INSTANTIATE_TEST_SUITE_P(Referee, BiasCases, testing::ValuesIn(case_files()), [](const auto& file) {
  std::string name = "n" + file.param.substr(0, file.param.size() - 5);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(BiasCaseFolder, HoldsAllCases) { EXPECT_EQ(case_files().size(), 27U); }

/// The first fragment's depth; empty if the case covers nothing.
std::optional<RefereeFragment> first_fragment(const cases::Case& c) {
  for (int y = 0; y < c.framebuffer.height; ++y) {
    for (int x = 0; x < c.framebuffer.width; ++x) {
      if (auto fragment = referee(c, 0, x, y, 0)) return fragment;
    }
  }
  return std::nullopt;
}

RC_GTEST_PROP(RefereeBias, IsWithinItsClampAndLeavesDepthsInTheirLimits, ()) {
  cases::Case c = random_exact_case();
  cover_most(c);
  const auto plain = first_fragment(c);
  c.depth_bias.constant = ordinary_float(0x1p20F);
  c.depth_bias.slope = ordinary_float(4);
  c.depth_bias.clamp = ordinary_float(0.25F);
  const auto biased = first_fragment(c);
  RC_ASSERT(plain.has_value() == biased.has_value());
  RC_PRE(plain.has_value());
  // Doubles are near enough to see a bias on the wrong side of its clamp by more than a rounding.
  const double moved = biased->depth.nearest_double() - plain->depth.nearest_double();
  constexpr double kRounding = 0x1p-50;
  if (c.depth_bias.clamp > 0) RC_ASSERT(moved <= c.depth_bias.clamp + kRounding);
  if (c.depth_bias.clamp < 0) RC_ASSERT(moved >= c.depth_bias.clamp - kRounding);
  const bool is_limited_to_range = c.depth_clamp || c.rules == cases::Rules::d3d;
  const float least = is_limited_to_range ? c.viewport.min_depth : 0.0F;
  const float greatest = is_limited_to_range ? c.viewport.max_depth : 1.0F;
  RC_ASSERT(biased->depth >= Rational(least));
  RC_ASSERT(biased->depth <= Rational(greatest));
}

RC_GTEST_PROP(RefereeBias, StoresWhatIsWithinHalfAStep, ()) {
  cases::Case c = random_exact_case();
  cover_most(c);
  c.depth_format = one_of({cases::DepthFormat::unorm16, cases::DepthFormat::unorm24});
  const auto fragment = first_fragment(c);
  RC_PRE(fragment.has_value());
  const double steps = std::ldexp(1, cases::unorm_bits(c.depth_format)) - 1;
  RC_ASSERT(!fragment->stored.empty());
  for (const std::uint32_t k : fragment->stored) {
    RC_ASSERT(k <= steps);
    // The product has an error of at most 2^24 · 2^-53.
    RC_ASSERT(std::abs(fragment->depth.nearest_double() * steps - k) <= 0.5 + 0x1p-28);
  }
}

}  // namespace
}  // namespace rastercheck::oracle::referee_bias_test
