#include "backends/gl/driver_name.h"

#include <gtest/gtest.h>

namespace rastercheck::backends::gl::driver_name_test {
namespace {

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
            (Driver{"nvidia", "550.54.15"}));
  EXPECT_EQ(driver_of("GeForce GTX 1080/PCIe/SSE2", "4.6.0 NVIDIA 460.39"),
            (Driver{"nvidia", "460.39"}));
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

}  // namespace
}  // namespace rastercheck::backends::gl::driver_name_test
