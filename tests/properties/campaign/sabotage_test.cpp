#include "properties/campaign/sabotage.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "backends/api_promise.h"
#include "backends/factory.h"

namespace rastercheck::properties::sabotage_test {
namespace {

using records::Defect;

/// Two triangles that cover 24 pixels, share an edge, have 4 samples, and are drawn exactly.
class SabotageTest : public testing::Test {
 protected:
  SabotageTest() : backend_(*backends::make_backend("cpu")) {
    case_.framebuffer = {32, 32, 4};
    case_.viewport = {0, 0, 32, 32, 0, 1};
    case_.rules = cases::Rules::vulkan;
    case_.attributes = {{"r"}, {"s", cases::Interpolation::smooth, cases::Location::center}};
    case_.positions = {{-0.75F, -0.71F, 0.25F, 1},
                       {1.5F, -1.53F, 1, 2},
                       {-0.52F, 0.75F, 0.75F, 1},
                       {0.81F, 0.62F, 0.5F, 1}};
    case_.attribute_values = {0.25F, 1, 1, 0.5F, 0.5F, 0.75F, 0.125F, 0.25F};
    case_.triangles = {{0, 1, 2}, {2, 1, 3}};
  }

  std::optional<cases::Fragments> drawn(const cases::Case& c) const {
    auto drawn = backend_->draw(c);
    if (!drawn) return std::nullopt;
    return std::move(drawn->fragments);
  }
  /// Draws the case with a defect, if the defect can be applied.
  std::optional<cases::Fragments> damaged(const Sabotage& sabotage) const {
    const cases::ClipCase c(case_);
    const auto right = drawn(c);
    return sabotage.apply({&c, &*right, [this](const cases::Case& other) { return drawn(other); }});
  }
  static const Sabotage& of(Defect defect) { return sabotages()[static_cast<std::size_t>(defect)]; }

  std::unique_ptr<backends::Backend> backend_;
  cases::Case case_;
};

TEST_F(SabotageTest, ARightDrawingIsNotNoticed) {
  const cases::ClipCase c(case_);
  EXPECT_FALSE(has_wrong(c, cases::contract_of(c), *drawn(c)));
}

TEST_F(SabotageTest, AllChangeTheDrawingAndAreNoticedByAnExactContract) {
  const cases::ClipCase c(case_);
  for (const Sabotage& sabotage : sabotages()) {
    const auto wrong = damaged(sabotage);
    ASSERT_TRUE(wrong) << to_string(sabotage.defect);
    EXPECT_TRUE(has_wrong(c, cases::contract_of(c), *wrong, sabotage.changes))
        << to_string(sabotage.defect);
  }
}

TEST_F(SabotageTest, AreInTheOrderOfTheirDefects) {
  for (std::size_t i = 0; i < sabotages().size(); ++i) {
    EXPECT_EQ(sabotages()[i].defect, static_cast<Defect>(i));
  }
}

// Kills: an extra sample that adds several fragments; a missing sample whose place keeps another
// fragment.
TEST_F(SabotageTest, OneSampleIsOne) {
  const std::size_t count = drawn(cases::ClipCase(case_))->size();
  EXPECT_EQ(damaged(of(Defect::extra_16th))->size(), count + 1);
  EXPECT_EQ(damaged(of(Defect::missing_16th))->size(), count - 1);
}

// Kills: noticing defects in parts that are not looked at.
TEST_F(SabotageTest, OnlyWhatIsWatchedIsNoticed) {
  const cases::ClipCase c(case_);
  const auto contract = cases::contract_of(c);
  const auto nan = damaged(of(Defect::values_nan));
  EXPECT_FALSE(has_wrong(c, contract, *nan, kCoverageAlone));
  EXPECT_TRUE(has_wrong(c, contract, *nan, kValuesAlone));
  const auto cracked = damaged(of(Defect::crack));
  EXPECT_TRUE(has_wrong(c, contract, *cracked, kCoverageAlone));
  EXPECT_FALSE(has_wrong(c, contract, *cracked, kValuesAlone));
}

// If all w are equal, affine values are right, except for rounding.
TEST_F(SabotageTest, AffineIsForPerspectiveOnly) {
  case_.positions[1] = {0.75F, -0.75F, 0.5F, 1};
  case_.triangles = {{0, 1, 2}};
  const cases::ClipCase c(case_);
  const auto wrong = damaged(of(Defect::values_affine));
  EXPECT_TRUE(!wrong || !has_wrong(c, cases::contract_of(c), *wrong));
}

// Kills: a defect of values that claims to have changed a drawing without attributes.
TEST_F(SabotageTest, WithoutAttributesThereAreNoWrongValues) {
  case_.attributes.clear();
  case_.attribute_values.clear();
  EXPECT_FALSE(damaged(of(Defect::values_97)));
  EXPECT_FALSE(damaged(of(Defect::values_nan)));
  EXPECT_TRUE(damaged(of(Defect::depth_90)));
}

// The smallest triangles that the promise `spec` covers, and values that drivers must not draw
// there.
TEST_F(SabotageTest, NoNumbersAreNoticedInTrianglesOfFourPixelsUnderEveryPromise) {
  case_.framebuffer = {1024, 1024, 1};
  case_.viewport = {0, 0, 1024, 1024, 0, 1};
  const auto at = [](float x, float y) {
    return cases::ClipVertex{x / 512 - 1, y / 512 - 1, 0.5F, 1};
  };
  case_.positions = {at(1000, 1000), at(1004, 1000), at(1000, 1004)};
  case_.attribute_values.resize(6);
  case_.triangles = {{0, 1, 2}};
  const cases::ClipCase c(case_);
  for (const auto promise : {cases::DriverPromise::spec, cases::DriverPromise::conformance,
                             cases::DriverPromise::ieee}) {
    const cases::Contract contract = backends::api_promise(c, {8}, promise);
    EXPECT_FALSE(has_wrong(c, contract, *drawn(c)));
    for (const Defect defect : {Defect::values_nan, Defect::values_12345}) {
      EXPECT_TRUE(has_wrong(c, contract, *damaged(of(defect)))) << to_string(defect);
    }
  }
}

}  // namespace
}  // namespace rastercheck::properties::sabotage_test
