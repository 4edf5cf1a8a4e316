#include "records/inspection.h"

#include <gtest/gtest.h>

namespace rastercheck::records::inspection_test {
namespace {

// Kills: a neighbour, another sample of the pixel.
TEST(InspectedSampleOf, IsTheOneThatWasLookedFor) {
  Inspection inspection;
  inspection.x = 2;
  inspection.y = 3;
  inspection.sample = 1;
  EXPECT_EQ(inspected_sample(inspection), nullptr);
  inspection.samples.resize(4);
  for (InspectedSample& sample : inspection.samples) {
    sample.x = 2;
    sample.y = 3;
    sample.sample = 1;
  }
  inspection.samples[0].x = 3;
  inspection.samples[1].y = 2;
  inspection.samples[2].sample = 0;
  EXPECT_EQ(inspected_sample(inspection), &inspection.samples[3]);
}

}  // namespace
}  // namespace rastercheck::records::inspection_test
