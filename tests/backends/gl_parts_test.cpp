// What of the backend `gl` needs no driver.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "backends/gl/driver_name.h"
#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/case_state.h"
#include "backends/gl/internal/varyings.h"

namespace rastercheck::backends::gl {
namespace {

using cases::Interpolation;
using cases::Location;
using testing::HasSubstr;

TEST(DriverName, OfMesasSoftwareDrivers) {
  EXPECT_EQ(driver_of("llvmpipe (LLVM 15.0.6, 256 bits)", "4.5 (Core Profile) Mesa 22.3.6"),
            (Driver{"llvmpipe", "Mesa 22.3.6"}));
  EXPECT_EQ(driver_of("softpipe", "3.3 (Core Profile) Mesa 22.3.6"),
            (Driver{"softpipe", "Mesa 22.3.6"}));
  EXPECT_EQ(driver_of("llvmpipe (LLVM 15.0.6, 256 bits)", "OpenGL ES 3.2 Mesa 22.3.6"),
            (Driver{"llvmpipe", "Mesa 22.3.6"}));
}

TEST(DriverName, OfGpus) {
  EXPECT_EQ(driver_of("NVIDIA H200/PCIe/SSE2", "4.6.0 NVIDIA 550.54.15"),
            (Driver{"nvidia", "NVIDIA 550.54.15"}));
  EXPECT_EQ(driver_of("GeForce GTX 1080/PCIe/SSE2", "4.6.0 NVIDIA 460.39"),
            (Driver{"nvidia", "NVIDIA 460.39"}));
  EXPECT_EQ(
      driver_of("AMD Radeon RX 6800 XT (radeonsi, navi21, LLVM 15.0.6, DRM 3.49, 6.1.0-13-amd64)",
                "4.6 (Core Profile) Mesa 22.3.6"),
      (Driver{"radeonsi", "Mesa 22.3.6"}));
  EXPECT_EQ(driver_of("Mesa Intel(R) UHD Graphics 620 (KBL GT2)",
                      "4.6 (Core Profile) Mesa 23.1.0-devel (git-1234567)"),
            (Driver{"intel", "Mesa 23.1.0-devel (git-1234567)"}));
  EXPECT_EQ(driver_of("V3D 4.2", "OpenGL ES 3.1 Mesa 22.3.6"), (Driver{"v3d", "Mesa 22.3.6"}));
}

TEST(DriverName, OfStringsThatSayLittle) {
  EXPECT_EQ(driver_of("", ""), (Driver{"unknown", ""}));
  EXPECT_EQ(driver_of("?", "4.5"), (Driver{"unknown", "4.5"}));
}

cases::Attribute attribute(Interpolation interpolation, Location location) {
  return {"a", interpolation, location};
}

/// The varying that an attribute is in, and the pass of it; fails where it is in none or in two.
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
    // Ten flat ones take three vectors of four, and so three passes of one such vector each.
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

TEST(Varyings, OfNoAttributesAreOnePass) {
  EXPECT_EQ(pack({}, 1, true).size(), 1U);
  // smooth, noperspective and flat, whose programs are few.
  EXPECT_EQ(pack({}, 1, true).front().size(), 3U);
  EXPECT_EQ(pack({}, 1, false).front().size(), 2U);
}

/// A triangle with one attribute and one clip distance.
cases::Case small_case() {
  cases::Case c;
  c.rules = cases::Rules::opengl;
  c.framebuffer = {8, 8, 1};
  c.viewport = {0, 0, 8, 8, 0, 1};
  c.attributes = {attribute(Interpolation::smooth, Location::sample)};
  c.positions = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}};
  c.attribute_values = {20, 21, 22};
  c.clip_distance_count = 1;
  c.clip_distances = {30, 31, 32};
  c.triangles = {{2, 0, 1}};
  return c;
}

Capabilities all_there() {
  Capabilities has;
  has.api = "OpenGL 4.6";
  has.has_clip_control = has.has_provoking_vertex = has.has_depth_clamp = true;
  has.has_noperspective = has.has_sample_qualifier = has.has_sample_targets = true;
  has.has_viewport_fractions = has.clears_beyond_one = true;
  has.viewport_subpixel_bits = 8;
  has.max_clip_distances = 8;
  has.max_draw_buffers = 8;
  has.max_size = 16384;
  has.max_samples = 16;
  has.viewport_bounds = {-32768, 32767};
  has.max_viewport = {16384, 16384};
  return has;
}

TEST(CaseState, PutsVerticesInOrder) {
  const cases::Case c = small_case();
  Pass pass(2);
  pass[1] = {{}, {0}, 1};
  const std::vector<float> corner2 = {9, 10, 11, 12, 0, 0, 0, 0, 22, 0,
                                      0, 0,  32, 1,  1, 1, 1, 1, 1,  1};
  const std::vector<float> all = vertices_of(all_there(), c, c.triangles, pass);
  ASSERT_EQ(all.size(), 3 * corner2.size());
  EXPECT_EQ(std::vector(all.begin(), all.begin() + 20), corner2);
  EXPECT_EQ(all[20], 1);
  EXPECT_EQ(all[40 + 8], 21);
}

TEST(Capabilities, OfACaseWithNothingSpecialLackNothing) {
  EXPECT_EQ(lacks(all_there(), small_case()), "");
}

TEST(Capabilities, NameWhatIsLacking) {
  const auto expect = [](const Capabilities& has, const cases::Case& c, const std::string& what) {
    EXPECT_THAT(lacks(has, c), HasSubstr(what));
  };
  const Capabilities has = all_there();
  cases::Case c = small_case();
  c.rules = cases::Rules::d3d;
  expect(has, c, "the rules of d3d");
  c = small_case();
  c.viewport.height = -8;
  expect(has, c, "negative size");
  c = small_case();
  c.viewport.x = 0.5F;
  EXPECT_EQ(lacks(has, c), "");
  c.viewport.x = 0x1p-9F;
  expect(has, c, "8 fractional bits");
  c = small_case();
  c.viewport.y = 40000;
  expect(has, c, "begins at 40000");
  c.viewport = {0, 0, 20000, 8, 0, 1};
  expect(has, c, "20000 x 8");
  c = small_case();
  c.framebuffer.width = 16384;
  c.framebuffer.samples = 4;
  expect(has, c, "targets of 16384 x 8 with 4 samples");
}

TEST(Capabilities, NameWhatThisContextLacks) {
  const auto expect = [](bool Capabilities::*what, const cases::Case& c, const std::string& text) {
    Capabilities has = all_there();
    has.*what = false;
    EXPECT_THAT(lacks(has, c), HasSubstr(text));
    EXPECT_EQ(lacks(has, small_case()), "") << text;
    EXPECT_EQ(lacks(all_there(), c), "") << text;
  };
  cases::Case c = small_case();
  c.rules = cases::Rules::vulkan;
  expect(&Capabilities::has_clip_control, c, "no clip control");
  c.attributes[0].interpolation = Interpolation::flat;
  expect(&Capabilities::has_provoking_vertex, c, "from the last vertex");
  c = small_case();
  c.attributes[0].interpolation = Interpolation::noperspective;
  expect(&Capabilities::has_noperspective, c, "OpenGL 4.6 has no noperspective");
  c = small_case();
  c.framebuffer.samples = 4;
  expect(&Capabilities::has_sample_qualifier, c, "no qualifier `sample`");
  expect(&Capabilities::has_sample_targets, c, "no arrays of multisampled textures");
  c = small_case();
  c.depth_clamp = true;
  expect(&Capabilities::has_depth_clamp, c, "no depth clamp");
  c = small_case();
  c.depth_test = cases::DepthTest::less;
  expect(&Capabilities::clears_beyond_one, c, "cleared to more than 1");
  c = small_case();
  c.viewport.x = 0.5F;
  expect(&Capabilities::has_viewport_fractions, c, "0 fractional bits");
}

TEST(Capabilities, CountSamplesAndClipDistances) {
  Capabilities has = all_there();
  has.max_samples = 4;
  has.max_clip_distances = 0;
  cases::Case c = small_case();
  EXPECT_THAT(lacks(has, c), HasSubstr("has 0 clip distances, asked for 1"));
  has.max_clip_distances = 8;
  c.framebuffer.samples = 8;
  EXPECT_THAT(lacks(has, c), HasSubstr("4 samples at most, asked for 8"));
}

}  // namespace
}  // namespace rastercheck::backends::gl
