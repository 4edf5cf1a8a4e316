#pragma once

#include <array>
#include <memory>
#include <vector>

#include "backends/gl/context.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends::gl::bench {

/// The shape of a target, whose depth is always float32.
struct TargetShape {
  int width = 0;    ///< in pixels
  int height = 0;   ///< in pixels
  int samples = 1;  ///< per pixel
  cases::ColorFormat color = cases::ColorFormat::float32;
};

/// Red, green, blue and alpha. Bytes become multiples of 1/255.
using Color = std::array<float, 4>;

/// The content of a target. Row 0 has the least window y.
struct Picture {
  TargetShape shape;
  std::vector<Color> color;  ///< [y][x][sample]
  std::vector<float> depth;  ///< [y][x][sample]
};

/// Memory to draw into.
class Target {
 public:
  /// Fails if the driver does not support the size, or does not give exactly this number of
  /// samples.
  static Result<Target> create(const Context& context, const TargetShape& shape);

  Target(Target&& other) noexcept;
  Target& operator=(Target&& other) noexcept;
  ~Target();

  const TargetShape& shape() const;
  /// The GL name of the framebuffer object.
  unsigned framebuffer() const;

  /// Reads the content when all drawing has finished.
  Result<Picture> read() const;

 private:
  struct Impl;
  explicit Target(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl::bench
