// A fitted case draws the same picture by other rules: the oracle's fragments of both cases are the
// same, and the case keeps what it is about.

#include "properties/fitted_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "cases/capabilities.h"
#include "cases/case_reader.h"
#include "oracle/fragments.h"
#include "oracle/transform.h"

namespace rastercheck::properties::fitted_case_test {
namespace {

using cases::Capabilities;
using cases::Case;
using cases::Feature;
using cases::Rules;

const std::vector<Case>& corpus() {
  static const std::vector<Case> all = [] {
    std::vector<Case> read;
    for (const auto& entry :
         std::filesystem::directory_iterator(RASTERCHECK_SOURCE_DIR "/cases/corpus")) {
      read.push_back(cases::read_case(entry.path().string()).value());
    }
    return read;
  }();
  return all;
}

Capabilities with_rules(Rules rules) {
  Capabilities has;
  has.rules = {rules};
  return has;
}

/// Lists everything that the oracle says about a case, as text.
std::vector<std::string> truth_of(const Case& c) {
  std::vector<std::string> all;
  const cases::ClipCase clip = oracle::to_clip_case(c, "").value();
  oracle::for_each_fragment(
      oracle::SceneTruth(clip, cases::contract_of(clip)),
      [&](const oracle::Fragment& f, const oracle::TriangleTruth&) {
        std::string text = std::to_string(f.place.triangle) + " " + std::to_string(f.place.x) +
                           " " + std::to_string(f.place.y) + " " + std::to_string(f.place.sample) +
                           " " + std::string(to_string(f.decision.verdict));
        if (f.depth) text += " " + f.depth->lo.to_string() + " " + f.depth->hi.to_string();
        for (const auto& value : f.attributes) {
          text += value ? " " + value->lo.to_string() + " " + value->hi.to_string() : " none";
        }
        all.push_back(text);
        return all.size() < 2000;
      });
  return all;
}

/// True if the rules do not change the values of the case: only D3D takes the first covered sample
/// for a centroid.
bool is_the_same_by_all_rules(const Case& c) {
  return std::none_of(c.attributes.begin(), c.attributes.end(),
                      [](const auto& a) { return a.location == cases::Location::centroid; });
}

// Kills: depth mapped wrongly; a fill rule or face that is not changed with the rules; another
// provoking vertex.
TEST(FittedCase, IsTheSamePictureByOtherRules) {
  std::size_t changed = 0;
  std::size_t asked = 0;
  for (const Case& c : corpus()) {
    if (c.framebuffer.width > 64 || c.triangles.size() > 4 || c.camera) continue;
    for (const Rules rules : {Rules::opengl, Rules::vulkan, Rules::d3d}) {
      if (rules == c.rules) continue;
      ++asked;
      const Case fitted = fitted_case(with_rules(rules), c);
      if (fitted.rules == c.rules) {
        EXPECT_EQ(fitted, c) << c.name;
        continue;
      }
      ++changed;
      ASSERT_EQ(fitted.rules, rules);
      if (!is_the_same_by_all_rules(c)) continue;
      EXPECT_EQ(truth_of(fitted), truth_of(c)) << c.name;
    }
  }
  EXPECT_GT(changed, asked * 3 / 4);
}

TEST(FittedCase, OfACameraIsTheSamePicture) {
  std::size_t changed = 0;
  for (const Case& c : corpus()) {
    if (!c.camera || c.framebuffer.width > 64 || c.triangles.size() > 4) continue;
    const Rules rules = c.rules == Rules::opengl ? Rules::vulkan : Rules::opengl;
    const Case fitted = fitted_case(with_rules(rules), c);
    if (fitted.rules != rules) continue;
    ++changed;
    // Clip positions are rounded to float32, and z is rounded differently than before.
    const auto covered = [](const Case& one) { return truth_of(one).size(); };
    EXPECT_EQ(covered(fitted), covered(c)) << c.name;
  }
  EXPECT_GT(changed, 3U);
}

TEST(FittedCase, IsLeftAsItIsForWhoDrawsIt) {
  for (const Case& c : corpus()) {
    EXPECT_EQ(fitted_case({}, c), c);
    EXPECT_EQ(fitted_case(with_rules(c.rules), c), c);
  }
}

// By hand: z = 0.25 with w = 1 becomes 2 · 0.25 − 1 = −0.5 under OpenGL; 2^-30 would need 31 bits.
TEST(FittedCase, ChangesDepthExactlyOrNotAtAll) {
  Case c;
  c.framebuffer = {8, 8, 1};
  c.viewport = {0, 0, 8, 8, 0, 1};
  c.positions = {{-1, -1, 0.25F, 1}, {1, -1, 0.25F, 1}, {-1, 1, 0.25F, 1}};
  c.triangles = {{0, 1, 2}};
  const Case fitted = fitted_case(with_rules(Rules::opengl), c);
  EXPECT_EQ(fitted.positions[0], (cases::ClipVertex{-1, -1, -0.5F, 1}));
  EXPECT_EQ(fitted.fill_rule, cases::TieRule::bottom_left);
  EXPECT_EQ(fitted.front_face, cases::FrontFace::cw);
  EXPECT_EQ(fitted.triangles[0], (cases::Triangle{1, 2, 0}));  // the last vertex provokes
  EXPECT_EQ(fitted_case(with_rules(Rules::vulkan), fitted), c);
  EXPECT_EQ(fitted_case(with_rules(Rules::d3d), c).positions[0].y, 1);
  c.positions[0].z = 0x1p-30F;
  EXPECT_EQ(fitted_case(with_rules(Rules::opengl), c), c);
}

TEST(FittedCase, KeepsWhatTheCaseIsAbout) {
  Case c;
  c.framebuffer = {8, 8, 4};
  c.viewport = {0, 0, 8, 8, 0, 1};
  c.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
  c.triangles = {{0, 1, 2}};
  c.scissor = cases::Scissor{0, 0, 4, 4};
  Capabilities has;
  has.sample_counts = {1, 2};
  EXPECT_EQ(fitted_case(has, c).framebuffer.samples, 2);
  has.lacks = {Feature::scissor};
  EXPECT_EQ(fitted_case(has, c), c);  // the scissor may be what the case is about
  c.essential.emplace();
  EXPECT_EQ(lacked_by(has, fitted_case(has, c)), "");
  EXPECT_FALSE(fitted_case(has, c).scissor.has_value());
  for (const char* const what : {"samples", "scissor"}) {
    c.essential = {what};
    EXPECT_EQ(fitted_case(has, c), c) << what;
  }
  c.essential = {"rules"};
  has.rules = {Rules::opengl};
  EXPECT_EQ(fitted_case(has, c), c);
}

TEST(FittedCase, GivesAttributesWhatTheBackendHas) {
  Case c;
  c.framebuffer = {8, 8, 1};
  c.viewport = {0, 0, 8, 8, 0, 1};
  c.attributes = {{"a", cases::Interpolation::noperspective, {}},
                  {"b", cases::Interpolation::flat, {}}};
  c.essential.emplace();
  Capabilities has;
  has.lacks = {Feature::noperspective};
  const Case fitted = fitted_case(has, c);
  EXPECT_EQ(fitted.attributes[0].interpolation, cases::Interpolation::smooth);
  EXPECT_EQ(fitted.attributes[1].interpolation, cases::Interpolation::flat);
}

}  // namespace
}  // namespace rastercheck::properties::fitted_case_test
