#include "tests/backends/drivers.h"

namespace rastercheck::backends::drivers_test {
namespace {

TEST(RequiredBackends, AreThoseOfTheList) {
  EXPECT_FALSE(is_required("", "gl"));
  EXPECT_TRUE(is_required("all", "gl:llvmpipe"));
  EXPECT_TRUE(is_required("gl:llvmpipe", "gl:llvmpipe"));
  EXPECT_TRUE(is_required("gl,gl:softpipe,gl:llvmpipe", "gl:llvmpipe"));
  EXPECT_FALSE(is_required("gl,gl:softpipe", "gl:llvmpipe"));
  EXPECT_FALSE(is_required("gl:llvmpipe", "gl"));
}

TEST(RequiredBackends, AreSoWhateverOptionsFollow) {
  EXPECT_TRUE(is_required("gl:llvmpipe", "gl:llvmpipe,gles"));
  EXPECT_FALSE(is_required("gl:llvm", "gl:llvmpipe"));
  EXPECT_FALSE(is_required(",,", "gl"));
}

}  // namespace
}  // namespace rastercheck::backends::drivers_test
