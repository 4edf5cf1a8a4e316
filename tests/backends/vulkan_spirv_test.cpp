#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "backends/vulkan/spirv.h"

namespace rastercheck::backends::vulkan::vulkan_spirv_test {
namespace {

using Words = std::vector<std::uint32_t>;
using cases::Interpolation;
using cases::Location;
using testing::ElementsAreArray;

constexpr Qualifier kSmoothCenter{Interpolation::smooth, Location::center};
constexpr Qualifier kSmoothSample{Interpolation::smooth, Location::sample};
constexpr Qualifier kLinearCentroid{Interpolation::noperspective, Location::centroid};
constexpr Qualifier kFlat{Interpolation::flat, Location::center};

// The words of a shader, as in the SPIR-V specification: the header, then instructions of several
// words each.
const Words kHeader{0x07230203, 0x00010300, 0, 9, 0};
const Words kShader{0x00020011, 1};
const Words kSampleRate{0x00020011, 35};
constexpr std::uint32_t kDecorate3 = 0x00030047;
constexpr std::uint32_t kDecorate4 = 0x00040047;
const Words kOutput{kDecorate4, 7, 30, 1};  // location 1
const Words kNumber{kDecorate3, 8, 14};     // flat
const Words kFirst{kDecorate4, 5, 30, 0};   // location 0
const Words kSecond{kDecorate4, 6, 30, 1};  // location 1
const Words kReturn{0x000100fd};

Words joined(std::initializer_list<Words> parts) {
  Words all;
  for (const Words& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// A shader whose inputs 5 and 6 are at locations 0 and 1. It also decorates other ids.
Words shader() {
  const Words linear_5{kDecorate3, 5, 13};
  const Words sample_5{kDecorate3, 5, 17};
  const Words linear_6{kDecorate3, 6, 13};
  const Words sample_6{kDecorate3, 6, 17};
  return joined({kHeader, kShader, kSampleRate, kOutput, kNumber, linear_5, sample_5, kFirst,
                 linear_6, sample_6, kSecond, kReturn});
}

TEST(VulkanSpirv, HasTheQualifiersOfTheCase) {
  EXPECT_THAT(qualified(shader(), std::vector{kSmoothSample, kLinearCentroid}),
              ElementsAreArray(joined({kHeader,
                                       kShader,
                                       kSampleRate,
                                       kOutput,
                                       kNumber,
                                       {kDecorate3, 5, 17},
                                       kFirst,
                                       {kDecorate3, 6, 13},
                                       {kDecorate3, 6, 16},
                                       kSecond,
                                       kReturn})));
}

// Kills: requiring sampleRateShading from a device without it.
TEST(VulkanSpirv, AsksForNoSamplesWhereItNeedsNone) {
  EXPECT_THAT(
      qualified(shader(), std::vector{kFlat, kSmoothCenter}),
      ElementsAreArray(joined(
          {kHeader, kShader, kOutput, kNumber, {kDecorate3, 5, 14}, kFirst, kSecond, kReturn})));
}

TEST(VulkanSpirv, OfBrokenWordsEndsAll) {
  // An instruction of length 0, and one that extends beyond the end.
  EXPECT_EQ(qualified(joined({kHeader, {0}}), {}).size(), 6);
  EXPECT_EQ(qualified(joined({kHeader, {0x00090001}}), {}).size(), 6);
}

}  // namespace
}  // namespace rastercheck::backends::vulkan::vulkan_spirv_test
