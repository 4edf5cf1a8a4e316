#pragma once

// C code that draws a case and checks it, without the case: the files of
// reports/exporters/programs/.

#include <string_view>

namespace rastercheck::reports {

extern const std::string_view kCheckProgram;   ///< compares records with what is permitted
extern const std::string_view kOpenglProgram;  ///< draws through EGL and OpenGL
extern const std::string_view kVulkanProgram;  ///< draws through Vulkan

}  // namespace rastercheck::reports
