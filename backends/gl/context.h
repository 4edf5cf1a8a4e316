#pragma once

// OpenGL without a window, for the backends that judge drivers and for the peer that
// rastercheck-bench measures. Including this file needs no GL header.
//
// A process has one context at a time. Call everything in this folder on the thread that made the
// context, and destroy every Target, Program, Mesh and CaseDrawer before the context.

#include <memory>
#include <string>

#include "cases/error.h"

namespace rastercheck::backends::gl {

enum class Api { opengl, opengl_es };

/// The display to try first: EGL's surfaceless platform, whose driver Mesa chooses (GALLIUM_DRIVER,
/// LIBGL_ALWAYS_SOFTWARE), or a device with hardware of its own.
enum class Prefer { surfaceless, hardware };

/// The requirements on a context.
struct ContextRequest {
  Api api = Api::opengl;
  /// Lowest version accepted. For OpenGL, the core profile is used.
  int major = 4;
  int minor = 5;
  Prefer prefer = Prefer::surfaceless;
  /// The text that GL_RENDERER must start with.
  std::string renderer;
};

/// A context of OpenGL or OpenGL ES on EGL's surfaceless or device platform. It is made current.
class Context {
 public:
  /// Fails if EGL is missing, no platform works without windows, or no driver fits the request. The
  /// error says which step of EGL failed on which platform.
  static Result<Context> create(const ContextRequest& request = {});

  Context(Context&& other) noexcept;
  Context& operator=(Context&& other) noexcept;
  ~Context();

  /// The driver's own name (GL_RENDERER) and version (GL_VERSION).
  std::string renderer() const;
  /// Only GL_RENDERER and only GL_VERSION.
  std::string renderer_name() const;
  std::string version() const;

 private:
  struct Impl;
  explicit Context(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl
