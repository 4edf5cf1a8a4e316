// The law catches constants that are drawn with another value although the contract promises the
// constant.

#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::constants_stay_constant_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "constants-stay-constant";

TEST(ConstantsStayConstant, FindsOneUlpAndTheOtherZero) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 2, 3, 1) = std::nextafter(1.0F, 2.0F);
    value(drawn, 1, 6, 6, 2) = -0.0F;
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::beyond_bound, AttributeKind::smooth, 0, 2, 3);
  EXPECT_EQ(check.violations[0].attribute, 1U);
  EXPECT_EQ(check.violations[0].exact, "1");
  EXPECT_EQ(check.violations[0].error, (records::Enclosure{1, 1}));
  EXPECT_EQ(check.violations[0].note, "all three vertices have 1 (0x1p+0)");
  expect_at(check.violations[1], FragmentClass::wrong_sign_of_zero, AttributeKind::smooth, 1, 6, 6);
}

TEST(ConstantsStayConstant, JudgesNoOtherAttribute) {
  const Check check = check_of(
      kLaw, square(), [](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 0) = 77; });
  EXPECT_EQ(check.violation_count, 0U);
}

// With a bound of 3/4, rounding may give the neighbour below a power of two.
TEST(ConstantsStayConstant, JudgesWhatTheContractPromisesOnly) {
  DamagedBackend backend(
      [](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 1) = std::nextafter(1.0F, 2.0F); });
  cases::Contract contract = backend.contract(square());
  const auto violations = [&](cases::ValueBound smooth) {
    contract.bounds.smooth = smooth;
    backend.promised = contract;
    return check_of(kLaw, square(), backend).violation_count;
  };
  EXPECT_EQ(violations({0.5F, 0}), 1U);
  EXPECT_EQ(violations({0x1.7ffffep-1F, 0}), 1U);
  EXPECT_EQ(violations({0.75F, 0}), 0U);
  EXPECT_EQ(violations({0.5F, 0.125F}), 1U);  // g = 1 because all w are equal
  EXPECT_EQ(violations({0.5F, 0.25F}), 0U);
}

// A contract may keep constants although its bound is several ULP, as for attributes in float32.
TEST(ConstantsStayConstant, JudgesWhatIsPromisedToBeKeptWhateverTheBound) {
  DamagedBackend backend([](const Case&, Fragments& drawn) {
    value(drawn, 0, 2, 3, 1) = std::nextafter(1.0F, 2.0F);
    value(drawn, 1, 6, 6, 2) = -0.0F;
  });
  cases::Contract contract = backend.contract(square());
  contract.bounds.smooth = {6.84F, 0};
  const auto violations = [&](bool keeps_constants) {
    contract.keeps_constants = keeps_constants;
    backend.promised = contract;
    return check_of(kLaw, square(), backend).violation_count;
  };
  EXPECT_EQ(violations(false), 0U);
  EXPECT_EQ(violations(true), 2U);
  contract.keeps_sign_of_zero = false;
  EXPECT_EQ(violations(true), 1U);
}

TEST(ConstantsStayConstant, SaysNothingOfACaseWithoutConstants) {
  Case c = square();
  c.attributes.resize(1);
  c.attribute_values = {0, 8, 0, 8};
  EXPECT_FALSE(check_of(kLaw, c, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::constants_stay_constant_test
