// Case files with decimals, rounded once.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/importer.h"

namespace rastercheck::cases::case_file_test {
namespace {

constexpr const char* kDecimals = R"({"format": "rastercheck-case", "version": 1,
  "framebuffer": {"width": 8, "height": 4}, "viewport": {"x": 0, "y": 0, "width": 8, "height": 4},
  "rules": "vulkan", "triangles": [[0, 1, 2]], "vertices": [
  {"position": [0.1, 0, 0, 1]}, {"position": [1, 0.2, 0, 1]}, {"position": [0, 1, 0, 1]}]})";

TEST(CaseFile, IsRoundedOnlyIfAsked) {
  const Importer* importer = importer_of(kDecimals);
  ASSERT_NE(importer, nullptr);
  EXPECT_EQ(importer->name, "case");
  EXPECT_FALSE(importer->import(kDecimals, "a.json", {}));
  ImportOptions options;
  options.round = true;
  const Result<Imported> rounded = importer->import(kDecimals, "a.json", options);
  ASSERT_TRUE(rounded) << to_string(rounded.error());
  EXPECT_EQ(rounded->drawn.positions[0].x, 0x1.99999ap-4F);
  EXPECT_THAT(rounded->notes, testing::ElementsAre("2 numbers rounded to the nearest float32"));
}

TEST(CaseFile, TakesNoOtherOption) {
  ImportOptions options;
  options.width = 4;
  const auto refused = find_importer("case")->import(kDecimals, "a.json", options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.error()), "a.json: is a case, which takes no option but --round");
}

}  // namespace
}  // namespace rastercheck::cases::case_file_test
