#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"

namespace rastercheck::backends::vulkan {

/// Copies multisampled images to buffers with shaders/samples.comp.
class SampleReader {
 public:
  /// An image, and the buffer that it is copied to, from the byte `begin` on.
  struct Source {
    VkImageView image = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize begin = 0;
    VkDeviceSize size = 0;
  };
  struct Bindings {
    DescriptorPool pool;
    std::vector<VkDescriptorSet> sets;  ///< one for each source
  };
  /// The size of an image, with the same members as in the shader.
  struct Shape {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t samples = 0;
    std::uint32_t components = 0;
  };

  static Result<SampleReader> create(const Device& device);

  Result<Bindings> bind(const Device& device, std::span<const Source> sources) const;
  /// Call while recording. The image must be in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL.
  void record(VkCommandBuffer commands, VkDescriptorSet source, const Shape& shape,
              std::size_t layers) const;

 private:
  SampleReader() = default;

  DescriptorSetLayout bindings_;
  PipelineLayout layout_;
  Pipeline pipeline_;
};

}  // namespace rastercheck::backends::vulkan
