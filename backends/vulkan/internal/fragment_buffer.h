#pragma once

// A storage buffer that fragments are appended to (shaders/append.frag).

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/memory.h"
#include "backends/vulkan/internal/object.h"
#include "backends/vulkan/internal/pipelines.h"
#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::backends::vulkan {

class FragmentBuffer {
 public:
  static Result<FragmentBuffer> create(const Device& device, const Pipelines& pipelines);

  /// Words of records that there may be room for.
  std::size_t most_words() const { return most_words_; }

  /// Makes room for so many words of records, without any so far.
  Result<void> make_room(const Device& device, std::size_t words);

  /// Recorded before a draw by a pipeline of appending_layout(): `room` is in records.
  void bind(VkCommandBuffer commands, VkPipelineLayout layout, std::size_t room) const;
  /// Recorded after it, for this process to see what was written.
  static void show_host(VkCommandBuffer commands);

  /// How many fragments there were.
  std::size_t count() const { return all_words().front(); }
  /// The records; what is behind the last is undefined.
  std::span<const std::uint32_t> words() const { return all_words().subspan(1); }

 private:
  FragmentBuffer() = default;
  std::span<const std::uint32_t> all_words() const;

  std::size_t most_words_ = 0;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;  ///< the pool's
  HostBuffer buffer_;
};

/// Begins to draw with neither colours nor depth.
void begin_without_images(VkCommandBuffer commands, const cases::FramebufferSize& size);

}  // namespace rastercheck::backends::vulkan
