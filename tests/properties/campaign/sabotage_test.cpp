#include "properties/campaign/sabotage.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "backends/api_promise.h"
#include "backends/factory.h"

namespace rastercheck::properties::sabotage_test {
namespace {

/// A triangle of 24 pixels in a window of 32, drawn exactly.
class SabotageTest : public testing::Test {
 protected:
  SabotageTest() : backend_(*backends::make_backend("cpu")) {
    case_.framebuffer = {32, 32, 1};
    case_.viewport = {0, 0, 32, 32, 0, 1};
    case_.rules = cases::Rules::vulkan;
    case_.attributes = {{"r"}};
    case_.positions = {{-0.75F, -0.75F, 0.25F, 1}, {1.5F, -1.5F, 1, 2}, {-0.5F, 0.75F, 0.75F, 1}};
    case_.attribute_values = {0.25F, 1, 0.5F};
    case_.triangles = {{0, 1, 2}};
  }

  std::optional<cases::Fragments> drawn(const cases::Case& c) const {
    auto drawn = backend_->draw(c);
    if (!drawn) return std::nullopt;
    return std::move(drawn->fragments);
  }
  /// Draws the case with a defect.
  std::optional<cases::Fragments> damaged(const Sabotage& sabotage) const {
    const cases::ClipCase c(case_);
    const auto right = drawn(c);
    return sabotage.apply({&c, &*right, [this](const cases::Case& other) { return drawn(other); }});
  }
  static const Sabotage& of(std::string_view name) {
    for (const Sabotage& one : sabotages()) {
      if (one.name == name) return one;
    }
    throw std::invalid_argument(std::string(name));
  }

  std::unique_ptr<backends::Backend> backend_;
  cases::Case case_;
};

TEST_F(SabotageTest, ARightDrawingIsNotNoticed) {
  const cases::ClipCase c(case_);
  EXPECT_FALSE(is_noticed(c, cases::contract_of(c), *drawn(c)));
}

TEST_F(SabotageTest, AllChangeTheDrawingAndAreNoticedByAnExactContract) {
  const cases::ClipCase c(case_);
  for (const Sabotage& sabotage : sabotages()) {
    const auto wrong = damaged(sabotage);
    ASSERT_TRUE(wrong) << sabotage.name;
    EXPECT_TRUE(is_noticed(c, cases::contract_of(c), *wrong)) << sabotage.name;
  }
}

// With one w affine values are the right ones, but for rounding.
TEST_F(SabotageTest, AffineIsForPerspectiveOnly) {
  case_.positions[1] = {0.75F, -0.75F, 0.5F, 1};
  const cases::ClipCase c(case_);
  const auto wrong = damaged(of("affine for perspective"));
  EXPECT_TRUE(!wrong || !is_noticed(c, cases::contract_of(c), *wrong));
}

// Kills: a defect that needs values and claims to have changed a drawing without.
TEST_F(SabotageTest, WithoutAttributesThereAreNoWrongValues) {
  case_.attributes.clear();
  case_.attribute_values.clear();
  EXPECT_FALSE(damaged(of("values × 0.97")));
  EXPECT_FALSE(damaged(of("values NaN")));
  EXPECT_TRUE(damaged(of("depth × 0.9")));
}

// The smallest triangles that `spec` has to say something of, and what drivers must not draw there.
TEST_F(SabotageTest, NoNumbersAreNoticedInTrianglesOfFourPixelsUnderEveryPromise) {
  case_.framebuffer = {1024, 1024, 1};
  case_.viewport = {0, 0, 1024, 1024, 0, 1};
  const auto at = [](float x, float y) {
    return cases::ClipVertex{x / 512 - 1, y / 512 - 1, 0.5F, 1};
  };
  case_.positions = {at(1000, 1000), at(1004, 1000), at(1000, 1004)};
  const cases::ClipCase c(case_);
  for (const auto promise : {cases::DriverPromise::spec, cases::DriverPromise::conformance,
                             cases::DriverPromise::ieee}) {
    const cases::Contract contract = backends::api_promise(c, {8}, promise);
    EXPECT_FALSE(is_noticed(c, contract, *drawn(c)));
    for (const char* const name : {"values NaN", "values 12345"}) {
      EXPECT_TRUE(is_noticed(c, contract, *damaged(of(name)))) << name;
    }
  }
}

}  // namespace
}  // namespace rastercheck::properties::sabotage_test
