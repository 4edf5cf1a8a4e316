#pragma once

// Draws cases through OpenGL.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "backends/gl/context.h"
#include "cases/capabilities.h"
#include "cases/case.h"
#include "cases/draw_by.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/picture.h"

namespace rastercheck::backends::gl {

/// Draws cases without a camera, each triangle in the case's own viewport. Either each triangle
/// goes into a layer of its own, where varyings carry attributes into float32 colours, or all
/// fragments are appended to a buffer (backends/appended_drawing.h). With a depth test, all
/// triangles go into one layer in one draw. The vertex shader passes positions through. Cases with
/// Vulkan's rules use OpenGL's clip control.
class CaseDrawer {
 public:
  /// Fails if the driver cannot draw into float32. `context` must outlive the drawer.
  static Result<CaseDrawer> create(const Context& context);

  CaseDrawer(CaseDrawer&& other) noexcept;
  CaseDrawer& operator=(CaseDrawer&& other) noexcept;
  ~CaseDrawer();

  /// GL_SUBPIXEL_BITS.
  int subpixel_bits() const;
  int viewport_subpixel_bits() const;
  cases::Capabilities capabilities() const;

  /// The ways of drawing that the context supports.
  std::vector<cases::DrawBy> ways() const;

  /// Draws a case. If no way is given, appends fragments when layers would take long. Calls `go_on`
  /// after each part of the drawing. Fails with Failure::unsupported if the context or the way
  /// lacks something that the case needs.
  Result<cases::Fragments> draw(
      const cases::Case& c, std::optional<cases::DrawBy> way = std::nullopt,
      const std::function<void()>& go_on = [] {});

  /// Draws indices in place of the case's triangles, as Assembler::draw_assembled() does, in one
  /// draw call: into a layer if there is a depth test, or else appending fragments. Fails with
  /// Failure::unsupported if neither can draw the case. A triangle whose depth appending does not
  /// tell, or that has too many fragments by itself, is drawn once more, as a list of one.
  Result<cases::Fragments> draw_assembled(
      const cases::Case& c, cases::Topology topology, std::span<const std::uint32_t> indices,
      const std::function<void()>& go_on = [] {});

  /// Draws all triangles of a case in one draw call, as PictureDrawer::draw_picture() does.
  Result<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline);

 private:
  struct Impl;
  explicit CaseDrawer(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl
