// The law on differences across quads: held by `cpu`, broken by helpers that are not on the
// triangle's own map, silent of what the map says nothing about.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

using cases::Case;
using cases::Picture;
using cases::Pipeline;
using cases::Shading;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "differences across quads stay within the bound";

/// `cpu`, going wrong in one way with its pictures.
class DifferencesBackend : public DamagedBackend {
 public:
  DifferencesBackend() : DamagedBackend({}, "cpu"), cpu_(backends::make_backend("cpu").value()) {}

  bool draws_pictures() const override { return true; }
  Result<Picture> draw_picture(const Case& c, const Pipeline& pipeline) override {
    Pipeline changed = pipeline;
    if (pipeline_damage) pipeline_damage(changed);
    Result<Picture> picture = cpu_->draw_picture(c, changed);
    if (picture && picture_damage) picture_damage(pipeline, *picture);
    return picture;
  }

  std::function<void(Pipeline&)> pipeline_damage;
  std::function<void(const Pipeline&, Picture&)> picture_damage;

 private:
  std::unique_ptr<backends::Backend> cpu_;
};

Check checked(const Case& c, DifferencesBackend& backend) {
  return find_law(kLaw)->check(c, backend, {}).value();
}

Case case_of(std::uint64_t index) {
  Draw draw(1, kLaw, index);
  return find_law(kLaw)->generate(draw).source;
}

/// How many of a hundred cases of the law a backend breaks.
int broken(DifferencesBackend& backend) {
  int count = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    count += checked(case_of(i), backend).violation_count > 0 ? 1 : 0;
  }
  return count;
}

TEST(QuadDifferences, HoldOfCpuAndMeetWhatTheyAreAbout) {
  DifferencesBackend backend;
  std::set<std::string> labels;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Check check = checked(case_of(i), backend);
    EXPECT_EQ(check.violation_count, 0U) << i;
    labels.insert(check.labels.begin(), check.labels.end());
  }
  EXPECT_THAT(labels,
              testing::IsSupersetOf({"along x", "along y", "beyond the framebuffer",
                                     "beyond the triangle", "no one difference", "cancellation",
                                     "next to the horizon", "several samples", "w <= 0"}));
}

// Attribute 0 is the window x: differences are 1, or 0 along y. Pixels of even x have theirs with
// the next, those of odd x with the one before, of the other triangle too: it has the same map.
TEST(QuadDifferences, OfTheSquareAreOneOrZero) {
  DifferencesBackend backend;
  bool is_along_x = false;
  backend.picture_damage = [&is_along_x](const Pipeline& pipeline, Picture& picture) {
    is_along_x = pipeline.shading == Shading::differences_along_x;
    picture.color[3 * 9] = std::nextafter(is_along_x ? 1.0F : 0.0F, 2.0F);
    picture.color[3 * 10 + 1] = std::numeric_limits<float>::quiet_NaN();
  };
  const Check check = checked(square(), backend);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  // An ulp of 1 is more than half an ulp and 16 · 2^-29; 2^-149 is less.
  ASSERT_EQ(check.violation_count, is_along_x ? 2U : 1U);
  const records::Violation& last = check.violations.back();
  EXPECT_EQ(last.fragment_class, FragmentClass::not_a_number);
  EXPECT_EQ(last.kind, AttributeKind::smooth);
  EXPECT_EQ(last.attribute, 1U);
  EXPECT_EQ(last.x, 2U);
  EXPECT_EQ(last.y, 1U);
  EXPECT_EQ(last.exact, "0");
}

TEST(QuadDifferences, ShowTheOtherAxisAndTheOtherDirection) {
  DifferencesBackend other_axis;
  other_axis.pipeline_damage = [](Pipeline& pipeline) {
    pipeline.shading = pipeline.shading == Shading::differences_along_x
                           ? Shading::differences_along_y
                           : Shading::differences_along_x;
  };
  EXPECT_GT(broken(other_axis), 50);
  DifferencesBackend backwards;
  backwards.picture_damage = [](const Pipeline&, Picture& picture) {
    for (float& color : picture.color) color = -color;
  };
  EXPECT_GT(broken(backwards), 50);
}

// Helpers that have the value of the fragment beside them.
TEST(QuadDifferences, ShowHelpersThatAreHeldToTheEdge) {
  DifferencesBackend backend;
  backend.picture_damage = [](const Pipeline& pipeline, Picture& picture) {
    const auto samples = static_cast<std::size_t>(picture.size.samples);
    const auto width = static_cast<std::size_t>(picture.size.width);
    const bool is_along_x = pipeline.shading == Shading::differences_along_x;
    for (std::size_t at = 0; at < picture.depth.size(); ++at) {
      const std::size_t x = at / samples % width;
      const std::size_t y = at / samples / width;
      const std::size_t other_x = is_along_x ? x ^ 1 : x;
      const std::size_t other_y = is_along_x ? y : y ^ 1;
      const std::size_t other = (other_y * width + other_x) * samples + at % samples;
      const bool is_drawn =
          other_x < width && other < picture.depth.size() && std::isfinite(picture.depth[other]);
      for (std::size_t k = 0; !is_drawn && k < picture.channels; ++k) {
        picture.color[at * picture.channels + k] = 0;
      }
    }
  };
  EXPECT_GT(broken(backend), 40);
}

TEST(QuadDifferences, AreOfBackendsThatPromiseThem) {
  DifferencesBackend backend;
  EXPECT_TRUE(is_promised(*find_law(kLaw), backend));
  EXPECT_TRUE(checked(square(), backend).is_applicable);
  Case c = square();
  c.attributes.clear();
  c.attribute_values.clear();
  EXPECT_FALSE(checked(c, backend).is_applicable);
  backend.promised = backend.contract(square());
  backend.promised->quad_share.reset();
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
  EXPECT_FALSE(checked(square(), backend).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties
