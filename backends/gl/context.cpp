#include "backends/gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <utility>

#include "backends/gl/internal/objects.h"

namespace rastercheck::backends::gl {
namespace {

/// EGL's error code, as its specification lists them.
tl::unexpected<Error> egl_failure(const std::string& what) {
  return failure(what + " failed (EGL error " + hexadecimal(static_cast<GLenum>(eglGetError())) +
                 ")");
}

}  // namespace

struct Context::Impl {
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    // The display stays: it is one for the whole process, and others may be at it.
    if (context == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }

  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

Context::Context(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Context::Context(Context&& other) noexcept = default;
Context& Context::operator=(Context&& other) noexcept = default;
Context::~Context() = default;

Result<Context> Context::create() {
  // libepoxy ends the process where it is asked for a function that no library has: each step asks
  // first whether the next one is there.
  if (!epoxy_has_egl()) return failure("there is no EGL here (libEGL.so.1)");
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    return failure("this EGL has no surfaceless platform (EGL_MESA_platform_surfaceless)");
  }
  auto impl = std::make_unique<Impl>();
  impl->display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (impl->display == EGL_NO_DISPLAY) return egl_failure("eglGetPlatformDisplayEXT");
  if (eglInitialize(impl->display, nullptr, nullptr) == EGL_FALSE) {
    return egl_failure("eglInitialize of the surfaceless platform");
  }
  // A context that is never shown needs neither a surface nor a configuration of one.
  if (epoxy_egl_version(impl->display) < 15 ||
      !epoxy_has_egl_extension(impl->display, "EGL_KHR_no_config_context") ||
      !epoxy_has_egl_extension(impl->display, "EGL_KHR_surfaceless_context")) {
    return failure("this EGL is older than 1.5, or makes no contexts without a surface");
  }
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return egl_failure("eglBindAPI of OpenGL");
  constexpr std::array<EGLint, 7> kCore45 = {EGL_CONTEXT_MAJOR_VERSION,
                                             4,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             5,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
  impl->context =
      eglCreateContext(impl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kCore45.data());
  if (impl->context == EGL_NO_CONTEXT) return egl_failure("eglCreateContext of OpenGL 4.5 core");
  if (eglMakeCurrent(impl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl->context) == EGL_FALSE) {
    return egl_failure("eglMakeCurrent");
  }
  return Context(std::move(impl));
}

std::string Context::renderer() const {
  const auto text = [](GLenum what) {
    const GLubyte* const value = glGetString(what);
    return value == nullptr ? std::string("?") : std::string(reinterpret_cast<const char*>(value));
  };
  return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

}  // namespace rastercheck::backends::gl
