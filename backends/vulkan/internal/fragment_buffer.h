#pragma once

// A storage buffer to which shaders/append.frag appends fragments.

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

  /// The most words of records that the buffer can hold.
  std::size_t most_words() const { return most_words_; }

  /// Makes room for `words` words of records. The buffer is empty afterwards.
  Result<void> make_room(const Device& device, std::size_t words);

  /// Call while recording, before a draw with a pipeline of appending_layout(). `room` is a number
  /// of records.
  void bind(VkCommandBuffer commands, VkPipelineLayout layout, std::size_t room) const;
  /// Call while recording, after the draw: makes the records visible to this process.
  static void show_host(VkCommandBuffer commands);

  /// The number of fragments that were drawn.
  std::size_t count() const { return all_words().front(); }
  /// The records. The words after the last record are undefined.
  std::span<const std::uint32_t> words() const { return all_words().subspan(1); }

 private:
  FragmentBuffer() = default;
  std::span<const std::uint32_t> all_words() const;

  std::size_t most_words_ = 0;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;  ///< owned by the pool
  HostBuffer buffer_;
};

/// Begins rendering without colour or depth images.
void begin_without_images(VkCommandBuffer commands, const cases::FramebufferSize& size);

}  // namespace rastercheck::backends::vulkan
