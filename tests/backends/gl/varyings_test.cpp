#include "backends/gl/internal/varyings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rastercheck::backends::gl::varyings_test {
namespace {

using cases::Interpolation;
using cases::Location;

cases::Attribute attribute(Interpolation interpolation, Location location) {
  return {"a", interpolation, location};
}

/// The varying that has an attribute, and its pass. Fails if no varying has the attribute, or two
/// do.
struct Found {
  const Varying* varying = nullptr;
  std::size_t pass = 0;
  std::size_t component = 0;
};
Found find(const std::vector<Pass>& passes, std::size_t attribute) {
  Found found;
  for (std::size_t p = 0; p < passes.size(); ++p) {
    for (const Varying& varying : passes[p]) {
      for (std::size_t k = 0; k < varying.count; ++k) {
        if (varying.attributes[k] != attribute) continue;
        EXPECT_EQ(found.varying, nullptr) << attribute;
        found = {&varying, p, k};
      }
    }
  }
  EXPECT_NE(found.varying, nullptr) << attribute;
  return found;
}

TEST(Varyings, HaveEveryAttributeOnceAsItIsDeclared) {
  std::vector<cases::Attribute> all;
  for (int i = 0; i < 5; ++i) {
    for (const auto interpolation :
         {Interpolation::smooth, Interpolation::noperspective, Interpolation::flat}) {
      for (const auto location : {Location::sample, Location::center}) {
        all.push_back(attribute(interpolation, location));
      }
    }
  }
  for (const int samples : {1, 4}) {
    const std::vector<Pass> passes = pack(all, samples, true);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const VaryingClass& varies = find(passes, i).varying->varies;
      EXPECT_EQ(varies.interpolation, all[i].interpolation);
      if (samples > 1 && all[i].interpolation != Interpolation::flat) {
        EXPECT_EQ(varies.location, all[i].location);
      }
    }
    // Ten flat attributes take three vectors of four, and so three passes with one such vector
    // each.
    const auto with_flat = std::count_if(passes.begin(), passes.end(), [](const Pass& pass) {
      return std::any_of(pass.begin(), pass.end(), [](const Varying& varying) {
        return varying.varies.interpolation == Interpolation::flat && varying.count > 0;
      });
    });
    EXPECT_EQ(with_flat, 3);
  }
}

// Kills: `sample` beside `center` in one program, which then runs for each sample.
TEST(Varyings, KeepSamplesApartFromPixels) {
  const std::vector<cases::Attribute> both = {attribute(Interpolation::smooth, Location::sample),
                                              attribute(Interpolation::smooth, Location::center),
                                              attribute(Interpolation::smooth, Location::centroid)};
  const std::vector<Pass> passes = pack(both, 4, true);
  ASSERT_EQ(passes.size(), 2U);
  EXPECT_NE(find(passes, 0).pass, find(passes, 1).pass);
  EXPECT_EQ(find(passes, 1).pass, find(passes, 2).pass);
  EXPECT_EQ(pack(both, 1, true).size(), 1U);
}

TEST(Varyings, MayAllBeInOnePass) {
  std::vector<cases::Attribute> all;
  for (int i = 0; i < 5; ++i) {
    all.push_back(attribute(Interpolation::smooth, Location::sample));
    all.push_back(attribute(Interpolation::smooth, Location::centroid));
    all.push_back(attribute(Interpolation::flat, Location::sample));
  }
  for (const int samples : {1, 4}) {
    const std::vector<Pass> passes = {pack_together(all, samples)};
    // With one sample, the ten smooth attributes are alike and take three vectors; with several,
    // five of each kind take two. Five flat attributes always take two.
    EXPECT_EQ(passes.front().size(), samples == 1 ? 5U : 6U);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const VaryingClass& varies = find(passes, i).varying->varies;
      EXPECT_EQ(varies.interpolation, all[i].interpolation);
    }
  }
  EXPECT_TRUE(pack_together({}, 1).empty());
}

TEST(Varyings, OfNoAttributesAreOnePass) {
  EXPECT_EQ(pack({}, 1, true).size(), 1U);
  // smooth, noperspective and flat, so that programs are few.
  EXPECT_EQ(pack({}, 1, true).front().size(), 3U);
  EXPECT_EQ(pack({}, 1, false).front().size(), 2U);
}

}  // namespace
}  // namespace rastercheck::backends::gl::varyings_test
