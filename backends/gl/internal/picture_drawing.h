#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/layer_store.h"
#include "backends/gl/internal/layers.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/picture_program.h"
#include "backends/unorm_depth.h"
#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends::gl {

/// The number of channels of a picture.
std::size_t channels_of(const cases::Case& c, const cases::Pipeline& pipeline);

/// Why the pipeline makes no sense for the case; empty if it does.
std::string fault_of(const cases::Case& c, const cases::Pipeline& pipeline);

/// Draws pictures: all triangles into one layer, in one draw call. The driver does the depth test,
/// the blending, the texture lookups and the resolve.
class PictureDrawing {
 public:
  /// `has` and `store` must outlive this object.
  PictureDrawing(const Capabilities& has, LayerStore& store);

  /// The case's viewport must not have a negative size. Fails with Failure::unsupported if the
  /// context lacks something that the case or the pipeline needs.
  Result<cases::Picture> draw(const cases::Case& c, const cases::Pipeline& pipeline);

 private:
  /// What a picture was drawn into, with the driver's index of each standard sample.
  struct Target {
    LayerShape shape;
    std::vector<std::size_t> order;
    DepthReading depth;
  };

  Result<Target> target_of(const cases::Case& c, const cases::Pipeline& pipeline);
  Result<void> draw_into(const Layers& layers, const cases::Case& c,
                         const cases::Pipeline& pipeline);
  Result<void> take_colors(Layers& layers, const Target& target, cases::Picture& picture);
  Result<void> take_depths(Layers& layers, const Target& target, cases::Picture& picture);

  const Capabilities* has_;
  LayerStore* store_;
  PicturePrograms programs_;
  Object vertex_array_;
  Object vertices_;
  LayerContent content_;
};

}  // namespace rastercheck::backends::gl
