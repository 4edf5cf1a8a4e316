#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "backends/vulkan/internal/drawing_resources.h"
#include "backends/vulkan/internal/texture_image.h"
#include "cases/case.h"
#include "cases/error.h"
#include "cases/picture.h"

namespace rastercheck::backends::vulkan {

/// Draws pictures of cases for which lacks() and lacks_for_picture() (limits.h) are empty.
///
/// All triangles are drawn by one draw call, so their order is the order of submission. A picture
/// has an image of depths and an image of four channels. If there are more channels, the whole
/// draw is repeated for each group of four, so their number has no limit; all draws must leave the
/// same depths.
class PictureDrawing {
 public:
  /// `resources` must outlive the drawing.
  explicit PictureDrawing(DrawingResources& resources) : shared_(&resources) {}

  /// Fails if the pipeline has no meaning for the case, such as a texture with one attribute. Fails
  /// with Failure::unsupported if the case needs more memory than one case may take, or if its
  /// depths cannot be read. Calls `go_on` after each draw.
  Result<cases::Picture> draw(const cases::Case& c, const cases::Pipeline& pipeline,
                              const std::function<void()>& go_on);

 private:
  struct Group;

  Result<void> make_texture(const cases::Texturing& texturing);
  Result<void> draw_group(const cases::Case& c, const cases::Pipeline& pipeline, const Group& group,
                          const Target& target);
  Result<std::vector<float>> depths_of(const Target& target, const DepthReading& reading,
                                       bool resolves) const;

  DrawingResources* shared_;
  /// The last texture. Drawing it again reuses the image, because drivers may keep code for each
  /// image view that they have seen.
  std::optional<TextureImage> texture_;
};

}  // namespace rastercheck::backends::vulkan
