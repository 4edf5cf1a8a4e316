#pragma once

#include <array>
#include <memory>
#include <vector>

#include "backends/gl/context.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends::gl::bench {

/// What a target is. Its depth is float32 throughout.
struct TargetShape {
  int width = 0;    ///< in pixels
  int height = 0;   ///< in pixels
  int samples = 1;  ///< of a pixel
  cases::ColorFormat color = cases::ColorFormat::float32;
};

/// Red, green, blue and alpha; bytes as multiples of 1/255.
using Color = std::array<float, 4>;

/// A target's content. Row 0 is that of the least window y.
struct Picture {
  TargetShape shape;
  std::vector<Color> color;  ///< [y][x][sample]
  std::vector<float> depth;  ///< [y][x][sample]
};

/// Memory to draw into.
class Target {
 public:
  /// Fails where the driver has no such size or not exactly this number of samples.
  static Result<Target> create(const Context& context, const TargetShape& shape);

  Target(Target&& other) noexcept;
  Target& operator=(Target&& other) noexcept;
  ~Target();

  const TargetShape& shape() const;
  /// GL's name of its framebuffer object.
  unsigned framebuffer() const;

  /// What was drawn, once that is finished.
  Result<Picture> read() const;

 private:
  struct Impl;
  explicit Target(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::gl::bench
