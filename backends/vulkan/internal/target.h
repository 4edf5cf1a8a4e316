#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/memory.h"
#include "backends/vulkan/internal/object.h"
#include "backends/vulkan/internal/sample_reader.h"

namespace rastercheck::backends::vulkan {

struct TargetShape {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  int samples = 1;
  std::size_t slots = 0;
  std::size_t layers = 1;
  cases::DepthFormat depth = cases::DepthFormat::float32;  ///< one that the device has
  bool has_numbers = true;             ///< if false, there is no image of triangle numbers
  VkFormat slot_format = kSlotFormat;  ///< or kByteFormat
  bool resolves = false;               ///< if true, the mean of a pixel's samples is read of slots
  bool operator==(const TargetShape&) const = default;

  std::size_t layer_samples() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(samples);
  }
  /// The bytes of the images and of the buffer that they are read back to.
  std::size_t bytes() const;
};

/// Images of several layers, which are drawn into one after the other and read back together:
/// triangle numbers, depths and slots. The colour attachments of a pass are the numbers, then the
/// slots.
class Target {
 public:
  static Result<Target> create(const Device& device, const SampleReader& reader,
                               const TargetShape& shape);

  const TargetShape& shape() const { return shape_; }

  /// Call while recording, before drawing: discards the old content of the images.
  void begin(VkCommandBuffer commands) const;
  /// Likewise, but keeps the depths. Call after end().
  void begin_over_depths(VkCommandBuffer commands) const;
  /// Call both while recording, around the drawing into one layer. begin_layer() clears the layer,
  /// and its depths to `clear_depth`; if that is empty, it keeps the depths.
  void begin_layer(VkCommandBuffer commands, std::size_t layer,
                   std::optional<float> clear_depth) const;
  static void end_layer(VkCommandBuffer commands);
  /// Call while recording, after drawing: reads `layers` layers back.
  void end(VkCommandBuffer commands, const SampleReader& reader, std::size_t layers) const;

  /// The content that was read back from a layer: [y][x][sample].
  std::span<const float> numbers(std::size_t layer) const;
  /// Depths are as stored or, of a unorm format with several samples, as a shader fetches them.
  std::vector<float> depths(std::size_t layer) const;
  /// [y][x][sample][kSlotSize].
  std::span<const float> slot(std::size_t slot, std::size_t layer) const;
  /// Likewise, of a slot in any format: a byte k is the float nearest to k/255. If the target
  /// resolves, there is one sample per pixel.
  std::vector<float> colors(std::size_t slot, std::size_t layer) const;

 private:
  struct Part {
    DeviceImage image;
    std::vector<ImageView> views;  ///< one for each layer
    ImageView whole;               ///< all layers, for reading samples
    DeviceImage resolved;          ///< the mean of samples, if it is read instead of samples
    VkDescriptorSet set = VK_NULL_HANDLE;  ///< for reading samples; owned by bindings_
    bool is_depth = false;
    bool has_stencil = false;
    std::size_t components = 1;
    std::size_t begin = 0;  ///< offset in the buffer, in bytes
  };

  Target() = default;
  Result<void> add_part(const Device& device, VkFormat format, std::size_t components);
  Result<void> bind_samples(const Device& device, const SampleReader& reader);
  bool resolves(const Part& part) const;
  bool has_samples_read(const Part& part) const;
  void resolve(VkCommandBuffer commands, const Part& part, std::size_t layers) const;
  enum class Change { discard, reuse, read };
  void barrier(VkCommandBuffer commands, const Part& part, Change change) const;
  std::span<const float> read(const Part& part, std::size_t layer) const;

  TargetShape shape_;
  std::vector<Part> parts_;  ///< depths, slots, and numbers if present
  HostBuffer buffer_;
  SampleReader::Bindings bindings_;
};

}  // namespace rastercheck::backends::vulkan
