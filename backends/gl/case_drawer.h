#pragma once

// Cases through OpenGL.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "backends/gl/context.h"
#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/draw_by.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends::gl {

/// Draws cases without a camera, each triangle in the case's own viewport: into a layer of its own,
/// where attributes are varyings, drawn into colours of float32, or by appending all fragments to a
/// buffer (backends/appended_drawing.h). With a depth test all triangles are drawn into one layer,
/// in one draw. Positions are handed through by the vertex shader. Cases of the rules of Vulkan are
/// drawn with OpenGL's clip control.
class CaseDrawer {
 public:
  /// Fails where the driver does not draw into float32. `context` must outlive it.
  static Result<CaseDrawer> create(const Context& context);

  CaseDrawer(CaseDrawer&& other) noexcept;
  CaseDrawer& operator=(CaseDrawer&& other) noexcept;
  ~CaseDrawer();

  /// GL_SUBPIXEL_BITS
  int subpixel_bits() const;
  int viewport_subpixel_bits() const;
  cases::Capabilities capabilities() const;

  /// The ways that the context has.
  std::vector<cases::DrawBy> ways() const;

  /// Failure::unsupported where the context, or the way, lacks something that the case needs.
  /// Without a way, fragments are appended where layers would take long. Calls `go_on` after each
  /// part of the drawing.
  Result<cases::Fragments> draw(
      const cases::Case& c, std::optional<cases::DrawBy> way = std::nullopt,
      const std::function<void()>& go_on = [] {});

 private:
  struct Impl;
  explicit CaseDrawer(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl
