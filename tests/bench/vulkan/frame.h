#pragma once

// Whole frames for timing, drawn as programs draw them.

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::vulkan::bench {

/// The number of attributes of a vertex.
inline constexpr std::size_t kFrameAttributes = 2;

/// Indexed triangles in clip space, 0 <= z <= w.
struct FrameMesh {
  std::span<const cases::ClipVertex> positions;
  std::span<const float> attributes;  ///< [vertex][kFrameAttributes]
  std::span<const cases::Triangle> triangles;
};

/// The picture that was drawn. Colours are the attributes, 0 and 1. Row 0 has the least window y.
struct FramePicture {
  std::span<const float> color;  ///< [y][x][sample][4]
  std::span<const float> depth;  ///< [y][x][sample]
};

/// A mesh on a device, and a target of float32 colours and depths to draw it into.
class Frame {
 public:
  /// `device` names the device as in the backend's specification, without "vulkan:".
  static Result<Frame> create(const std::string& device);

  Frame(Frame&& other) noexcept;
  Frame& operator=(Frame&& other) noexcept;
  ~Frame();

  /// The device, driver and API version, in one line.
  std::string description() const;

  /// Replaces the mesh and the target. Fails if the device lacks the size or the number of samples,
  /// or if memory runs out.
  Result<void> take(const FrameMesh& mesh, const cases::FramebufferSize& size);

  /// Clears the target and draws all triangles of the mesh, whatever their facing, where depth is
  /// less. NDC (−1, −1) is window (0, 0). Returns when drawing has finished.
  Result<void> draw();

  /// Draws once more, and returns the picture, which is valid until the next draw.
  Result<FramePicture> read();

 private:
  struct Impl;
  explicit Frame(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan::bench
