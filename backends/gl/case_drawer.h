#pragma once

// Cases through OpenGL.

#include <functional>
#include <memory>

#include "backends/gl/context.h"
#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends::gl {

/// Draws cases without a camera: each triangle in the case's own viewport and into a layer of its
/// own, or, with a depth test, all of them in one draw into one. Attributes are varyings, drawn
/// into colours of float32; positions are handed through by the vertex shader. Cases of the rules
/// of Vulkan are drawn with OpenGL's clip control.
class CaseDrawer {
 public:
  /// Fails where the driver does not draw into float32. `context` must outlive it.
  static Result<CaseDrawer> create(const Context& context);

  CaseDrawer(CaseDrawer&& other) noexcept;
  CaseDrawer& operator=(CaseDrawer&& other) noexcept;
  ~CaseDrawer();

  /// GL_SUBPIXEL_BITS
  int subpixel_bits() const;

  /// Failure::unsupported where the context lacks something that the case needs.
  /// Calls `go_on` after each batch of layers.
  Result<cases::Fragments> draw(
      const cases::Case& c, const std::function<void()>& go_on = [] {});

 private:
  struct Impl;
  explicit CaseDrawer(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl
