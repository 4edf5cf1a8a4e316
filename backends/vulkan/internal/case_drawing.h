#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "cases/case.h"
#include "cases/draw_by.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends::vulkan {

/// Draws cases that the device lacks nothing of (limits.h), each triangle in the case's own
/// viewport: into a layer of its own, of which many are drawn, read back and looked through
/// together, or by appending all fragments to a buffer (backends/appended_drawing.h). With a depth
/// test all triangles go into one layer. A target for each triangle's number says what is covered,
/// whatever the values.
class CaseDrawing {
 public:
  /// Of the device, which has to outlive it.
  static Result<CaseDrawing> create(const Device& device);

  CaseDrawing(CaseDrawing&& other) noexcept;
  CaseDrawing& operator=(CaseDrawing&& other) noexcept;
  ~CaseDrawing();

  /// The ways that the device has.
  std::vector<cases::DrawBy> ways() const;

  /// Fails as Failure::unsupported where the case takes more memory than there is for one, or the
  /// way does not draw such cases. Without a way, fragments are appended where layers would take
  /// long. Calls `go_on` after each part of the drawing.
  Result<cases::Fragments> draw(
      const cases::Case& c, std::optional<cases::DrawBy> way = std::nullopt,
      const std::function<void()>& go_on = [] {});

 private:
  struct Impl;
  explicit CaseDrawing(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan
