#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/memory.h"
#include "backends/vulkan/internal/object.h"
#include "cases/picture.h"

namespace rastercheck::backends::vulkan {

/// A texture with its sampler, bound as set 0 of a pipeline layout.
class TextureImage {
 public:
  /// The texture must have a positive size and four bytes for each texel. `set_layout` is a layout
  /// of one sampled image with its sampler. For trilinear filtering, also makes all smaller levels:
  /// each has half the size of the level before, rounded down, but at least one texel.
  static Result<TextureImage> create(const Device& device, VkDescriptorSetLayout set_layout,
                                     const cases::Texturing& texturing);

  /// True if the image was made for the same texture, wraps and filter.
  bool is_for(const cases::Texturing& texturing) const;

  /// Call while recording, before rendering begins: copies the texels to the image.
  void fill(VkCommandBuffer commands) const;
  /// Call while recording, before draws with a pipeline of this layout.
  void bind(VkCommandBuffer commands, VkPipelineLayout layout) const;

 private:
  struct Level {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t begin = 0;  ///< offset of the texels in the buffer, in bytes
  };

  TextureImage() = default;
  Result<void> make_texels(const Device& device, const cases::Texturing& texturing);
  Result<void> make_view(const Device& device);
  Result<void> make_set(const Device& device, VkDescriptorSetLayout layout);
  void barrier(VkCommandBuffer commands, bool is_filled) const;

  cases::Texturing source_;
  std::vector<Level> levels_;
  HostBuffer texels_;
  DeviceImage image_;
  ImageView view_;
  Sampler sampler_;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;  ///< owned by the pool
};

}  // namespace rastercheck::backends::vulkan
