#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <vector>

#include "backends/gl/internal/layers.h"

namespace rastercheck::backends::gl {

/// Turns what layers hold into what can be read where OpenGL does not: samples one by one, and all
/// of it in OpenGL ES, which reads four floats at a time and from colours only.
class LayerCopy {
 public:
  static Result<LayerCopy> create(const CopyProgram& program, const LayerShape& shape);

  /// Reads a layer of images: numbers, depth, varyings.
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
