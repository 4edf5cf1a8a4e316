#pragma once

// OpenGL without a window: the first part of the backends that judge drivers, and the peer that
// rastercheck-bench measures. Whoever includes this needs no GL header.
//
// A process has one context at a time; all of this folder is called on the thread that made it, and
// every Target, Program, Mesh and CaseDrawer goes before it.

#include <memory>
#include <string>

#include "cases/error.h"

namespace rastercheck::backends::gl {

enum class Api { opengl, opengl_es };

/// Which of several drivers is taken: that of EGL's surfaceless platform, which is Mesa's choice
/// (GALLIUM_DRIVER, LIBGL_ALWAYS_SOFTWARE), or rather a device that draws by itself.
enum class Prefer { surfaceless, hardware };

/// What a context has to be.
struct ContextRequest {
  Api api = Api::opengl;
  /// At least; of OpenGL the core profile.
  int major = 4;
  int minor = 5;
  Prefer prefer = Prefer::surfaceless;
  /// What GL_RENDERER has to begin with.
  std::string renderer;
};

/// A context of OpenGL or OpenGL ES, current, on EGL's surfaceless or device platform.
class Context {
 public:
  /// Fails, saying which step of EGL did not work where, if there is no EGL, no platform without
  /// windows or no driver for what is asked for.
  static Result<Context> create(const ContextRequest& request = {});

  Context(Context&& other) noexcept;
  Context& operator=(Context&& other) noexcept;
  ~Context();

  /// What draws, as the driver names itself (GL_RENDERER), with its version (GL_VERSION).
  std::string renderer() const;
  /// GL_RENDERER and GL_VERSION by themselves.
  std::string renderer_name() const;
  std::string version() const;

 private:
  struct Impl;
  explicit Context(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl
