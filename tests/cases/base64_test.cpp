#include "cases/base64.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace rastercheck::cases::base64_test {
namespace {

// RFC 4648, section 10. Kills: padding that is too short by one; reading beyond the last byte.
TEST(Base64, IsThatOfTheRfc) {
  EXPECT_EQ(to_base64(""), "");
  EXPECT_EQ(to_base64("f"), "Zg==");
  EXPECT_EQ(to_base64("fo"), "Zm8=");
  EXPECT_EQ(to_base64("foo"), "Zm9v");
  EXPECT_EQ(to_base64("foob"), "Zm9vYg==");
  EXPECT_EQ(to_base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(to_base64(std::string("\0\xfb\xff\xfe", 4)), "APv//g==");
}

// Kills: signed bytes; taking zero bytes for the end, or for padding.
RC_GTEST_PROP(Base64, GivesBackAnyBytes, (const std::string& bytes)) {
  const Result<std::string> again = from_base64(to_base64(bytes));
  RC_ASSERT(again.has_value());
  RC_ASSERT(again.value() == bytes);
  const std::string with_zeros = bytes + std::string(2, '\0');
  RC_ASSERT(from_base64(to_base64(with_zeros)).value() == with_zeros);
}

class BadBase64 : public ::testing::TestWithParam<const char*> {};

TEST_P(BadBase64, IsRefused) {
  const Result<std::string> bytes = from_base64(GetParam());
  ASSERT_FALSE(bytes.has_value());
  EXPECT_EQ(bytes.error().reason, "must be base64, with padding and without white space");
}

INSTANTIATE_TEST_SUITE_P(Base64, BadBase64,
                         ::testing::Values("Zg", "Zg=", "Zg===", "====", "Zm9v=", "Z===", "Zm9v\n",
                                           "Zm 9", "Zm9-", "Zm9_", "Z=g=", "=Zm9",
                                           "Zh==", "Zm9=", "Zg==Zg=="));

}  // namespace
}  // namespace rastercheck::cases::base64_test
