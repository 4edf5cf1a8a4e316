#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <vector>

#include "backends/gl/internal/layers.h"

namespace rastercheck::backends::gl {

/// Copies layers into a readable form where OpenGL cannot read them directly. OpenGL cannot read
/// single samples. OpenGL ES reads only colours, four floats at a time, so everything needs a copy
/// there.
class LayerCopy {
 public:
  static Result<LayerCopy> create(const CopyProgram& program, const LayerShape& shape);

  /// Reads a layer of the images: numbers, depth and the chosen varyings.
  Result<void> read(std::span<const GLuint> images, GLint layer, const std::vector<bool>& varyings,
                    LayerContent& content) const;

 private:
  LayerCopy() = default;

  int width() const { return shape_.size.width * shape_.size.samples; }

  LayerShape shape_;
  CopyProgram program_;
  Object vertex_array_;
  std::vector<Object> copies_;
  Object framebuffer_;
};

}  // namespace rastercheck::backends::gl
