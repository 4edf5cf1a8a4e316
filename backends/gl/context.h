#pragma once

// OpenGL without a window: the first part of the backends that judge drivers, and the peer that
// rastercheck-bench measures. Whoever includes this needs no GL header.
//
// A process has one context at a time; all of this folder is called on the thread that made it, and
// every Target, Program and Mesh goes before it.

#include <memory>
#include <string>

#include "cases/error.h"

namespace rastercheck::backends::gl {

/// An OpenGL 4.5 core context on EGL's surfaceless platform. Which driver it is, is the
/// environment's choice (for Mesa: GALLIUM_DRIVER, LIBGL_ALWAYS_SOFTWARE).
class Context {
 public:
  /// Fails, saying which step of EGL did not work, where there is no EGL, no surfaceless platform
  /// or no driver for this version of OpenGL.
  static Result<Context> create();

  Context(Context&& other) noexcept;
  Context& operator=(Context&& other) noexcept;
  ~Context();

  /// What draws, as the driver names itself (GL_RENDERER), with its version (GL_VERSION).
  std::string renderer() const;

 private:
  struct Impl;
  explicit Context(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl
