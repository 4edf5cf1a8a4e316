#pragma once

// Layers of one size to draw triangles into, each by itself, and what was drawn there.

#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/objects.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::gl {

struct LayerShape {
  cases::FramebufferSize size;
  int layers = 1;
  std::size_t varyings = 0;  ///< colour targets of four floats besides that of numbers
  bool operator==(const LayerShape&) const = default;

  /// Of a layer's pixels.
  std::size_t samples() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
           static_cast<std::size_t>(size.samples);
  }
  /// Of the driver's memory for a layer.
  std::size_t bytes_of_layer() const { return samples() * (8 + 16 * varyings); }
};

/// What a layer holds, [y][x][sample], samples in the driver's order.
struct LayerContent {
  std::vector<float> numbers;  ///< of the triangles in the draw, from 1; 0 where none was drawn
  std::vector<float> depth;
  std::vector<std::vector<std::array<float, 4>>> values;  ///< [varying]
  bool is_empty = true;  ///< the numbers are all 0, and the rest was not read
};

/// A program that copies a layer.
struct CopyProgram {
  GLuint name = 0;
  GLint layer = -1;  ///< location of the uniform
};

/// Those that there are, made where they are asked for first.
class CopyPrograms {
 public:
  /// `has` must outlive it.
  explicit CopyPrograms(const Capabilities& has) : has_(&has) {}
  Result<CopyProgram> get(int samples, std::size_t varyings);

 private:
  const Capabilities* has_;
  std::map<std::pair<int, std::size_t>, Object> made_;
};

class LayerCopy;

/// float32 throughout: a number, varyings and depth for each sample.
class Layers {
 public:
  /// `has` and `programs` must outlive it. Failure::unsupported where the driver has no such
  /// targets, or not exactly this number of samples.
  static Result<Layers> create(const Capabilities& has, CopyPrograms& programs,
                               const LayerShape& shape);

  Layers(Layers&& other) noexcept;
  Layers& operator=(Layers&& other) noexcept;
  ~Layers();

  const LayerShape& shape() const { return shape_; }
  /// GL's name of the framebuffer object of a layer.
  GLuint framebuffer(std::size_t layer) const { return framebuffers_[layer].name(); }

  /// The driver's index of each of the standard pattern's samples. Failure::unsupported where its
  /// samples are elsewhere.
  Result<std::vector<std::size_t>> sample_order() const;

  /// What was drawn into a layer, and the values of those varyings that are asked for. Changes the
  /// state of GL.
  Result<void> read(std::size_t layer, const std::vector<bool>& varyings, LayerContent& content);

 private:
  Layers(const Capabilities& has, const LayerShape& shape);

  Result<void> make_images();
  Result<void> make_framebuffers();
  bool is_multisampled() const { return shape_.size.samples > 1; }
  GLenum target() const;
  Object make_image(GLenum format, GLenum channels) const;

  LayerShape shape_;
  const Capabilities* has_;
  Object numbers_;
  Object depth_;
  std::vector<Object> values_;
  std::vector<Object> framebuffers_;
  std::unique_ptr<LayerCopy> copy_;  ///< where it is needed
};

}  // namespace rastercheck::backends::gl
