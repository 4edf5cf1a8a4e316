#pragma once

// A set of layers of one size to draw into: one triangle per layer, or a picture, which is a single
// layer.

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
#include "cases/picture.h"

namespace rastercheck::backends::gl {

/// The most driver memory that a single layer may take.
inline constexpr std::size_t kMostBytesOfLayer = std::size_t{1} << 30U;

struct LayerShape {
  cases::FramebufferSize size;
  int layers = 1;
  std::size_t varyings = 0;  ///< colour targets of four channels, besides the target for numbers
  cases::DepthFormat depth = cases::DepthFormat::float32;   ///< one that a case may ask for
  bool has_numbers = true;                                  ///< false for pictures
  cases::ColorFormat format = cases::ColorFormat::float32;  ///< of the varyings
  bool operator==(const LayerShape&) const = default;

  /// The number of samples in one layer.
  std::size_t samples() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
           static_cast<std::size_t>(size.samples);
  }
  /// The driver memory that one layer takes.
  std::size_t bytes_of_layer() const { return samples() * (8 + 16 * varyings); }
};

/// The content of a layer, [y][x][sample], with samples in the driver's order.
struct LayerContent {
  /// Of triangles in the draw, from 1; 0 where nothing was drawn. Empty if the layer has none.
  std::vector<float> numbers;
  std::vector<float> depth;  ///< as stored, or as a shader fetches it (Layers::fetches_depth())
  std::vector<std::vector<std::array<float, 4>>> values;  ///< [varying]
  bool is_empty = true;  ///< there are numbers, all 0, and nothing else was read
};

/// A program that copies a layer.
struct CopyProgram {
  GLuint name = 0;
  GLint layer = -1;  ///< location of the uniform `layer`
};

/// Copy programs, each made on first request.
class CopyPrograms {
 public:
  /// `has` must outlive this object.
  explicit CopyPrograms(const Capabilities& has) : has_(&has) {}
  Result<CopyProgram> get(int samples, std::size_t varyings);

 private:
  const Capabilities* has_;
  std::map<std::pair<int, std::size_t>, Object> made_;
};

class LayerCopy;

/// Layers that hold a number, if the shape has numbers, a depth and varyings for each sample. All
/// are float32, except that depth may have a unorm format and varyings may be rgba8.
class Layers {
 public:
  /// `has` and `programs` must outlive the layers. Fails with Failure::unsupported if the driver
  /// has no such targets, or does not give exactly this number of samples or bits of depth.
  static Result<Layers> create(const Capabilities& has, CopyPrograms& programs,
                               const LayerShape& shape);

  Layers(Layers&& other) noexcept;
  Layers& operator=(Layers&& other) noexcept;
  ~Layers();

  const LayerShape& shape() const { return shape_; }
  /// The draw buffers of every framebuffer: one for the numbers, if there are any, then one per
  /// varying.
  const std::vector<GLenum>& buffers() const { return buffers_; }
  /// The GL name of a layer's framebuffer object.
  GLuint framebuffer(std::size_t layer) const { return framebuffers_[layer].name(); }

  /// The driver's index of each sample of the standard pattern. Fails with Failure::unsupported if
  /// the driver places its samples elsewhere.
  Result<std::vector<std::size_t>> sample_order() const;

  /// True if a shader fetches the depths that read() returns.
  bool fetches_depth() const { return copy_ != nullptr; }

  /// Reads a layer, with the values of the chosen varyings; a byte k of rgba8 as a float that is
  /// near k/255. Changes GL state.
  Result<void> read(std::size_t layer, const std::vector<bool>& varyings, LayerContent& content);

 private:
  Layers(const Capabilities& has, const LayerShape& shape);

  Result<void> make_images();
  Result<void> make_framebuffers();
  bool is_multisampled() const { return shape_.size.samples > 1; }
  GLenum target() const;
  Object make_image(GLenum format, GLenum channels, GLenum type = GL_FLOAT) const;
  Result<void> make_depth();
  void read_depth(std::vector<float>& depth) const;

  LayerShape shape_;
  const Capabilities* has_;
  Object numbers_;
  Object depth_;
  std::vector<Object> values_;
  std::vector<GLenum> buffers_;
  std::vector<Object> framebuffers_;
  std::unique_ptr<LayerCopy> copy_;  ///< only if layers of this kind need copying
};

}  // namespace rastercheck::backends::gl
