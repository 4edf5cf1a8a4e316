// Drivers of another release, from a folder.

#include "backends/driver_root.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace rastercheck::backends::driver_root_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A folder with an empty file in the place of the loader.
std::string unpacked(const TemporaryFolder& folder, const std::string& libraries) {
  std::filesystem::create_directories(folder.path("root/" + libraries));
  std::ofstream(folder.path("root/" + libraries + "/ld-linux-x86-64.so.2"));
  return folder.path("root");
}

TEST(DriverRoot, FollowsTheOptions) {
  EXPECT_EQ(split_root("llvmpipe").options, "llvmpipe");
  EXPECT_THAT(split_root("llvmpipe").root.string(), IsEmpty());
  EXPECT_EQ(split_root("gles,llvmpipe@/unpacked").options, "gles,llvmpipe");
  EXPECT_EQ(split_root("gles,llvmpipe@/unpacked").root, "/unpacked");
  EXPECT_EQ(split_root("lavapipe@here").root, std::filesystem::absolute("here"));
  EXPECT_EQ(split_root("lavapipe,validate@here").options, "lavapipe,validate");
  EXPECT_EQ(split_root("llvmpipe@").root, std::filesystem::current_path());
  EXPECT_EQ(split_root("lavapipe@./here/").root, std::filesystem::absolute("here"));
}

// Kills: a root that is ignored, so that this system's driver is judged under another's name.
TEST(DriverRoot, ItsLoaderStartsTheProcess) {
  const TemporaryFolder folder;
  const std::string root = unpacked(folder, "usr/lib/x86_64-linux-gnu");
  const std::string libraries = root + "/usr/lib/x86_64-linux-gnu";
  const auto loader = ElementsAre(libraries + "/ld-linux-x86-64.so.2", "--library-path", libraries);
  EXPECT_THAT(loader_command("gl:llvmpipe@" + root).value(), loader);
  EXPECT_THAT(loader_command("vulkan:lavapipe@" + root).value(), loader);
  EXPECT_THAT(loader_command("gl:llvmpipe").value(), IsEmpty());
  EXPECT_THAT(loader_command("plugin:./a@" + root + ".so").value(), IsEmpty());
}

TEST(DriverRoot, MayHaveItsLibrariesInLib) {
  const TemporaryFolder folder;
  const std::string root = unpacked(folder, "lib/x86_64-linux-gnu");
  EXPECT_EQ(libraries_of(root).value(), root + "/lib/x86_64-linux-gnu");
}

TEST(DriverRoot, WithoutALoaderIsNone) {
  const TemporaryFolder folder;
  const auto command = loader_command("gl:llvmpipe@" + folder.path(""));
  ASSERT_FALSE(command.has_value());
  EXPECT_EQ(command.error().failure, Failure::unavailable);
  EXPECT_EQ(command.error().reason,
            "is no unpacked system: no usr/lib/*/ld-linux-x86-64.so.2 in it");
}

// This process was started by the system's loader.
TEST(DriverRoot, IsRefusedInAProcessThatItDidNotStart) {
  const TemporaryFolder folder;
  const std::string root = unpacked(folder, "usr/lib/x86_64-linux-gnu");
  EXPECT_FALSE(check_started_by(root).has_value());
  EXPECT_TRUE(check_started_by({}).has_value());
  EXPECT_TRUE(check_loaded_from({}).has_value());
  EXPECT_TRUE(check_loaded_from(root).has_value());  // no driver is loaded
}

// Kills: a driver of this system that is judged under the root's name.
TEST(DriverRoot, RefusesTheDriversOfThisSystem) {
  using Libraries = std::vector<std::filesystem::path>;
  const Libraries of_root{"/r/usr/lib/libEGL_mesa.so.0", "/usr/lib/libgmp.so.10", "",
                          "/r/usr/lib/libgallium-25.0.7.so"};
  EXPECT_EQ(foreign_driver("/r", of_root), "");
  for (const char* const foreign : {"/usr/lib/libvulkan_lvp.so", "/other/r/usr/lib/swrast_dri.so",
                                    "/usr/lib/libLLVM-15.so.1"}) {
    Libraries all = of_root;
    all.insert(all.begin() + 2, foreign);
    EXPECT_EQ(foreign_driver("/r", all), foreign);
  }
}

}  // namespace
}  // namespace rastercheck::backends::driver_root_test
