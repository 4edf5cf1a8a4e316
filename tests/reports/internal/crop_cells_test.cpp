#include "reports/internal/crop_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/records/sample_look.h"

namespace rastercheck::reports::crop_cells_test {
namespace {

using testing::SizeIs;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(CropCells, HoldOldAgainstNewAndExact) {
  records::CloserLook look = records::sample_look();
  look.before = records::sample_specimen();
  const std::vector<CropCell> cells = crop_cells(look);
  ASSERT_THAT(cells, SizeIs(2));
  EXPECT_EQ(cells[0].place.x, 3U);
  EXPECT_EQ(cells[0].place.y, 5U);
  EXPECT_EQ(cells[0].exact, 0.5);
  EXPECT_EQ(cells[0].before, 0.5F - records::kSampleUlp);
  EXPECT_EQ(cells[0].error_before, 1);
  EXPECT_EQ(cells[0].error_after, 3);
  EXPECT_EQ(cells[0].change, 4);
  EXPECT_EQ(cells[1].place.x, 4U);
  EXPECT_FALSE(cells[1].before || cells[1].error_before);
  EXPECT_EQ(cells[1].change, kInfinite) << "drawn only now";
}

// Kills: showing a change although nothing is known about before.
TEST(CropCells, SayNothingOfWhatWasNotKept) {
  const std::vector<CropCell> cells = crop_cells(records::sample_look());
  ASSERT_THAT(cells, SizeIs(2));
  EXPECT_FALSE(cells[0].before || cells[0].error_before || cells[0].change);
  EXPECT_EQ(cells[0].error_after, 3);
}

TEST(CropCells, TellTheSameBitsFromTheSameNumber) {
  records::CloserLook look = records::sample_look();
  look.before = records::sample_specimen();
  look.inspection.samples[0].values[1].actual = 0.0F;
  look.before->bits[1] = 0;
  EXPECT_EQ(crop_cells(look)[0].change, 0);
  look.before->bits[1] = std::bit_cast<std::uint32_t>(-0.0F);
  EXPECT_GT(crop_cells(look)[0].change, 0);
  look.before->bits[1] = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(crop_cells(look)[0].change, kInfinite);
  EXPECT_FALSE(crop_cells(look)[0].error_before);
}

// For depth, the scale is that of the depth range, 0 to 1.
TEST(CropCells, AreOfTheValueThatIsLookedAt) {
  records::CloserLook look = records::sample_look();
  look.before = records::sample_specimen();
  look.inspection.attribute.reset();
  look.before->bits[0] = std::bit_cast<std::uint32_t>(0.25F + 2 * records::kSampleUlp);
  const std::vector<CropCell> cells = crop_cells(look);
  EXPECT_EQ(cells[0].after, 0.25F);
  EXPECT_EQ(cells[0].error_before, 2);
  EXPECT_EQ(cells[0].change, 2);
}

// Kills: showing a pixel by a sample that did not change, or by the last sample.
TEST(CropCells, ShowOfEachPixelTheSampleThatChangedMost) {
  records::CloserLook look = records::sample_look();
  look.inspection.samples[1].place.x = 3;
  look.inspection.samples[1].place.sample = 1;
  look.inspection.pattern.push_back({0.25, 0.25});
  std::vector<CropCell> cells = crop_cells(look);
  ASSERT_THAT(cells, SizeIs(1));
  EXPECT_EQ(cells[0].place.sample, 0U) << "that which is farther off, where nothing was kept";
  look.before = records::sample_specimen();
  look.before->width = 1;
  look.before->samples = 2;
  cells = crop_cells(look);
  ASSERT_THAT(cells, SizeIs(1));
  EXPECT_EQ(cells[0].place.sample, 1U);
}

}  // namespace
}  // namespace rastercheck::reports::crop_cells_test
