#include <gtest/gtest.h>
#include <vulkan/vulkan_core.h>

#include "backends/vulkan/driver_name.h"

namespace rastercheck::backends::vulkan::vulkan_driver_name_test {
namespace {

TEST(VulkanDriverName, IsTheProjectsWithItsVersion) {
  // These are the names and versions that vulkaninfo shows.
  EXPECT_EQ(driver_named({VK_DRIVER_ID_MESA_LLVMPIPE, "llvmpipe", "Mesa 22.3.6 (LLVM 15.0.6)", 1}),
            (Driver{"lavapipe", "Mesa 22.3.6"}));
  EXPECT_EQ(driver_named({VK_DRIVER_ID_GOOGLE_SWIFTSHADER, "SwiftShader driver", "",
                          VK_MAKE_API_VERSION(0, 5, 0, 0)}),
            (Driver{"swiftshader", "5.0.0"}));
  EXPECT_EQ(driver_named({VK_DRIVER_ID_MESA_RADV, "radv", "Mesa 23.1.0-devel (git-9f2b1c4)", 7}),
            (Driver{"radv", "Mesa 23.1.0-devel"}));
  EXPECT_EQ(driver_named({VK_DRIVER_ID_INTEL_OPEN_SOURCE_MESA, "Intel open-source Mesa driver",
                          "Mesa 22.3.6", 7}),
            (Driver{"anv", "Mesa 22.3.6"}));
  EXPECT_EQ(driver_named({VK_DRIVER_ID_NVIDIA_PROPRIETARY, "NVIDIA", "535.54.03", 7}),
            (Driver{"nvidia", "535.54.03"}));
}

TEST(VulkanDriverName, OfOneThatIsNotKnownIsItsFirstWord) {
  EXPECT_EQ(driver_named({VK_DRIVER_ID_MOLTENVK, "MoltenVK", "1.2.4", 0}),
            (Driver{"moltenvk", "1.2.4"}));
  EXPECT_EQ(driver_named({9999, "Qualcomm Technologies", "", VK_MAKE_API_VERSION(0, 0, 512, 3)}),
            (Driver{"qualcomm", "0.512.3"}));
  EXPECT_EQ(driver_named({}), (Driver{"unknown", "0.0.0"}));
}

}  // namespace
}  // namespace rastercheck::backends::vulkan::vulkan_driver_name_test
