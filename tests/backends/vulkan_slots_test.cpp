#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>
#include <vector>

#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan::vulkan_slots_test {
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

TEST(VulkanSlots, AreThoseOfFewShaders) {
  using enum Interpolation;
  using enum Location;
  EXPECT_TRUE(widened({}, 1).empty());
  EXPECT_TRUE(widened({}, 4).empty());
  const Slot plain{{smooth, center}, {0}};
  EXPECT_THAT(widened({plain}, 1), ElementsAre(plain));
  const Slot copied{{flat, center}, {1}};
  EXPECT_THAT(widened({plain, copied}, 1),
              ElementsAre(plain, Slot{{noperspective, center}, {}}, copied));
  const Slot sampled{{smooth, sample}, {2}};
  EXPECT_THAT(widened({sampled}, 4), ElementsAre(sampled));
  EXPECT_THAT(widened({plain}, 4),
              ElementsAre(plain, Slot{{smooth, centroid}, {}}, Slot{{noperspective, center}, {}},
                          Slot{{noperspective, centroid}, {}}, Slot{{flat, center}, {}}));
  const auto all = widened({sampled, copied}, 4);
  ASSERT_EQ(all.size(), 7);
  EXPECT_EQ(all.front(), sampled);
  EXPECT_EQ(all.back(), copied);
  // Kills: losing the attributes of a second slot of the same kind.
  const std::vector<Slot> many{{{flat, center}, {0, 1, 2, 3}}, {{flat, center}, {4}}};
  EXPECT_EQ(widened(many, 1), many);
}

}  // namespace
}  // namespace rastercheck::backends::vulkan::vulkan_slots_test
