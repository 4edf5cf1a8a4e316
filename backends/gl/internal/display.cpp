#include "backends/gl/internal/display.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "backends/gl/internal/objects.h"

namespace rastercheck::backends::gl {
namespace {

bool client_has(const char* extension) {
  return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension);
}

/// Appends EGL devices. Devices with hardware of their own precede those that draw on the
/// processor.
void append_devices(std::vector<Display>& displays, bool only_hardware) {
  if (!client_has("EGL_EXT_platform_device") ||
      !(client_has("EGL_EXT_device_base") || client_has("EGL_EXT_device_enumeration"))) {
    return;
  }
  EGLint count = 0;
  if (eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE || count < 1) return;
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (eglQueryDevicesEXT(count, devices.data(), &count) == EGL_FALSE) return;
  devices.resize(static_cast<std::size_t>(std::max(count, 0)));
  const bool tells = client_has("EGL_EXT_device_base") || client_has("EGL_EXT_device_query");
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const char* const said = tells ? eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS) : nullptr;
    const std::string_view extensions = said != nullptr ? said : "";
    const bool is_hardware = extensions.find("EGL_MESA_device_software") == std::string_view::npos;
    if (is_hardware != only_hardware) continue;
    displays.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr),
                        "device " + std::to_string(i)});
  }
}

}  // namespace

tl::unexpected<Error> egl_failure(const std::string& what) {
  return failure(what + " failed (EGL error " + hexadecimal(static_cast<GLenum>(eglGetError())) +
                 ")");
}

Result<std::vector<Display>> find_displays(Prefer prefer) {
  // libepoxy ends the process if asked for a function that no library has, so each step first
  // checks that the function it calls exists.
  if (!epoxy_has_egl()) {
    return failure("EGL is not installed (libEGL.so.1, in Debian's libegl1)");
  }
  std::vector<Display> displays;
  if (!client_has("EGL_EXT_platform_base"))
    return failure("this EGL does not support platforms (no EGL_EXT_platform_base)");
  append_devices(displays, true);
  const auto surfaceless = prefer == Prefer::hardware ? displays.end() : displays.begin();
  if (client_has("EGL_MESA_platform_surfaceless")) {
    displays.insert(surfaceless, {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                           EGL_DEFAULT_DISPLAY, nullptr),
                                  "the surfaceless platform"});
  }
  append_devices(displays, false);
  if (displays.empty()) {
    return failure(
        "this EGL has neither a surfaceless platform (EGL_MESA_platform_surfaceless) nor devices "
        "(EGL_EXT_platform_device)");
  }
  return displays;
}

}  // namespace rastercheck::backends::gl
