#pragma once

#include <functional>
#include <memory>

#include "backends/vulkan/internal/device.h"
#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends::vulkan {

/// Draws cases that the device lacks nothing of (limits.h). Each triangle goes into a layer of its
/// own, in the case's own viewport, and many layers are drawn, read back and looked through
/// together; with a depth test all go into one. A target for each triangle's number says what is
/// covered, whatever the values.
class CaseDrawing {
 public:
  /// Of the device, which has to outlive it.
  static Result<CaseDrawing> create(const Device& device);

  CaseDrawing(CaseDrawing&& other) noexcept;
  CaseDrawing& operator=(CaseDrawing&& other) noexcept;
  ~CaseDrawing();

  /// Fails as Failure::unsupported where the case takes more memory than there is for one.
  /// Calls `go_on` after each batch of layers.
  Result<cases::Fragments> draw(
      const cases::Case& c, const std::function<void()>& go_on = [] {});

 private:
  struct Impl;
  explicit CaseDrawing(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan
