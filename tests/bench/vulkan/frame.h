#pragma once

// Whole frames, as programs draw them, to be timed.

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::vulkan::bench {

/// Attributes of a vertex.
inline constexpr std::size_t kFrameAttributes = 2;

/// Indexed triangles in clip space, 0 <= z <= w.
struct FrameMesh {
  std::span<const cases::ClipVertex> positions;
  std::span<const float> attributes;  ///< [vertex][kFrameAttributes]
  std::span<const cases::Triangle> triangles;
};

/// What was drawn: colours are the attributes, 0 and 1. Row 0 is that of the least window y.
struct FramePicture {
  std::span<const float> color;  ///< [y][x][sample][4]
  std::span<const float> depth;  ///< [y][x][sample]
};

/// A mesh on a device, and a target of float32 colours and depths to draw it into.
class Frame {
 public:
  /// By a device as the backend's specification names it, without "vulkan:".
  static Result<Frame> create(const std::string& device);

  Frame(Frame&& other) noexcept;
  Frame& operator=(Frame&& other) noexcept;
  ~Frame();

  /// Device, driver and version of the API, on one line.
  std::string description() const;

  /// In place of the mesh and the target before. Fails where the device lacks the size or the
  /// number of samples, or memory runs out.
  Result<void> take(const FrameMesh& mesh, const cases::FramebufferSize& size);

  /// Clears and draws what was taken, all triangles whatever their facing, where depth is less.
  /// NDC (−1, −1) is window (0, 0). Returns when all is drawn.
  Result<void> draw();

  /// What draw() draws, which is drawn once more; valid until anything else is.
  Result<FramePicture> read();

 private:
  struct Impl;
  explicit Frame(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan::bench
