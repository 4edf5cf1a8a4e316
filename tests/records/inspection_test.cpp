#include "records/inspection.h"

#include <gtest/gtest.h>

namespace rastercheck::records::inspection_test {
namespace {

// Kills: returning a neighbouring pixel, or another sample of the pixel.
TEST(InspectedSampleOf, IsTheOneThatWasLookedFor) {
  Inspection inspection;
  inspection.place.x = 2;
  inspection.place.y = 3;
  inspection.place.sample = 1;
  EXPECT_EQ(inspected_sample(inspection), nullptr);
  inspection.samples.resize(4);
  for (InspectedSample& sample : inspection.samples) {
    sample.place.x = 2;
    sample.place.y = 3;
    sample.place.sample = 1;
  }
  inspection.samples[0].place.x = 3;
  inspection.samples[1].place.y = 2;
  inspection.samples[2].place.sample = 0;
  EXPECT_EQ(inspected_sample(inspection), &inspection.samples[3]);
}

}  // namespace
}  // namespace rastercheck::records::inspection_test
