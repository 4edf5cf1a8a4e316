#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>

#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {
namespace {

using cases::Interpolation;
using cases::Location;
using testing::ElementsAre;

cases::Case case_of(int samples, std::initializer_list<std::pair<Interpolation, Location>> kinds) {
  cases::Case c;
  c.framebuffer = {4, 4, samples};
  for (const auto& [interpolation, location] : kinds) {
    c.attributes.push_back({"a", interpolation, location});
  }
  return c;
}

TEST(VulkanSlots, AreByQualifier) {
  using enum Interpolation;
  using enum Location;
  EXPECT_THAT(slots_of(case_of(4, {{flat, sample},
                                   {smooth, centroid},
                                   {noperspective, sample},
                                   {smooth, centroid},
                                   {flat, center},
                                   {smooth, sample}})),
              ElementsAre(Slot{{smooth, sample}, {5}}, Slot{{smooth, centroid}, {1, 3}},
                          Slot{{noperspective, sample}, {2}}, Slot{{flat, center}, {0, 4}}));
}

TEST(VulkanSlots, OfOneSampleAreAtTheCentre) {
  using enum Interpolation;
  using enum Location;
  EXPECT_THAT(slots_of(case_of(1, {{smooth, sample}, {smooth, centroid}, {smooth, center}})),
              ElementsAre(Slot{{smooth, center}, {0, 1, 2}}));
}

TEST(VulkanSlots, HaveRoomForFour) {
  using enum Interpolation;
  using enum Location;
  EXPECT_TRUE(slots_of(case_of(1, {})).empty());
  const auto slots = slots_of(
      case_of(1, {{flat, sample}, {flat, sample}, {flat, sample}, {flat, sample}, {flat, sample}}));
  EXPECT_THAT(slots, ElementsAre(Slot{{flat, center}, {0, 1, 2, 3}}, Slot{{flat, center}, {4}}));
}

}  // namespace
}  // namespace rastercheck::backends::vulkan
