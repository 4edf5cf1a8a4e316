#include "backends/gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <utility>

#include "backends/gl/internal/display.h"
#include "backends/gl/internal/objects.h"

namespace rastercheck::backends::gl {
namespace {

std::string text(GLenum what) {
  const GLubyte* const value = glGetString(what);
  return value == nullptr ? std::string("?") : std::string(reinterpret_cast<const char*>(value));
}

EGLContext make_context(EGLDisplay display, const ContextRequest& request) {
  const bool is_es = request.api == Api::opengl_es;
  const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION, request.major,
                                            EGL_CONTEXT_MINOR_VERSION, request.minor,
                                            // OpenGL ES has no profiles, so the list ends here for
                                            // it.
                                            is_es ? EGL_NONE : EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

struct Context::Impl {
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    // Does not terminate the display: the whole process shares it, and other code may be using it.
    if (context == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }

  Result<void> open(const ContextRequest& request);

  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

/// Creates a context on the display and makes it current.
Result<void> Context::Impl::open(const ContextRequest& request) {
  if (display == EGL_NO_DISPLAY) return failure("no such display");
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) return egl_failure("eglInitialize");
  // A context whose output is never shown needs neither a surface nor a surface configuration.
  for (const char* const extension : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
    if (!epoxy_has_egl_extension(display, extension)) {
      return failure(
          fmt::format("its EGL cannot create contexts without a surface (no {})", extension));
    }
  }
  if (epoxy_egl_version(display) < 15 &&
      !epoxy_has_egl_extension(display, "EGL_KHR_create_context")) {
    return failure("its EGL cannot create contexts of a given version (no EGL_KHR_create_context)");
  }
  const std::string what = fmt::format("OpenGL{} {}.{}", request.api == Api::opengl_es ? " ES" : "",
                                       request.major, request.minor);
  if (eglBindAPI(request.api == Api::opengl_es ? EGL_OPENGL_ES_API : EGL_OPENGL_API) == EGL_FALSE) {
    return egl_failure("eglBindAPI of " + what);
  }
  context = make_context(display, request);
  if (context == EGL_NO_CONTEXT) return egl_failure("eglCreateContext of " + what);
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    return egl_failure("eglMakeCurrent");
  }
  const std::string got = text(GL_RENDERER);
  if (got.starts_with(request.renderer)) return {};
  return failure(fmt::format("asked for {}, got {}", request.renderer, got));
}

Context::Context(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Context::Context(Context&& other) noexcept = default;
Context& Context::operator=(Context&& other) noexcept = default;
Context::~Context() = default;

Result<Context> Context::create(const ContextRequest& request) {
  const Result<std::vector<Display>> displays = find_displays(request.prefer);
  if (!displays) return tl::unexpected(displays.error());
  std::string reasons;
  for (const Display& candidate : *displays) {
    auto impl = std::make_unique<Impl>();
    impl->display = candidate.name;
    const Result<void> opened = impl->open(request);
    if (opened) return Context(std::move(impl));
    reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", candidate.place,
                           opened.error().reason);
  }
  // On a machine with EGL but no driver, EGL reports only an error number, so name the packages.
  return failure(reasons + " (llvmpipe and softpipe are in Debian's libgl1-mesa-dri)");
}

std::string Context::renderer() const { return renderer_name() + ", " + version(); }
std::string Context::renderer_name() const { return text(GL_RENDERER); }
std::string Context::version() const { return text(GL_VERSION); }

}  // namespace rastercheck::backends::gl
