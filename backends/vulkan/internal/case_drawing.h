#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "backends/vulkan/internal/drawing_resources.h"
#include "cases/case.h"
#include "cases/draw_by.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "cases/picture.h"

namespace rastercheck::backends::vulkan {

/// Draws cases for which lacks() (limits.h) is empty, each triangle in the case's own viewport.
/// Either each triangle goes into a layer of its own, and many layers are drawn, read back and
/// searched together; or all fragments are appended to a buffer (backends/appended_drawing.h). With
/// a depth test, all triangles go into one layer. Layers include an image of triangle numbers,
/// which shows what is covered, whatever the values are.
class CaseDrawing {
 public:
  /// `resources` must outlive the result.
  static Result<CaseDrawing> create(DrawingResources& resources);

  CaseDrawing(CaseDrawing&& other) noexcept;
  CaseDrawing& operator=(CaseDrawing&& other) noexcept;
  ~CaseDrawing();

  /// The ways of drawing that the device supports.
  std::vector<cases::DrawBy> ways() const;

  /// Draws a case. If no way is given, appends fragments when layers would take long. Calls `go_on`
  /// after each part of the drawing. Fails with Failure::unsupported if the case needs more memory
  /// than one case may take, or if the way cannot draw it.
  Result<cases::Fragments> draw(
      const cases::Case& c, std::optional<cases::DrawBy> way = std::nullopt,
      const std::function<void()>& go_on = [] {});

  /// Draws indices in place of the case's triangles, as Assembler::draw_assembled() does, in one
  /// draw: into a layer if there is a depth test, or else appending fragments. Fails with
  /// Failure::unsupported if neither can draw the case. A triangle whose depth appending does not
  /// tell, or that has too many fragments by itself, is drawn once more, as a list of one.
  Result<cases::Fragments> draw_assembled(
      const cases::Case& c, cases::Topology topology, std::span<const std::uint32_t> indices,
      const std::function<void()>& go_on = [] {});

 private:
  struct Impl;
  explicit CaseDrawing(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan
