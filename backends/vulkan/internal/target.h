#pragma once

#include <cstddef>
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
  bool has_numbers = true;  ///< else there are no numbers()
  bool operator==(const TargetShape&) const = default;

  std::size_t layer_samples() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(samples);
  }
  /// Of images and of what they are read back to.
  std::size_t bytes() const;
};

/// Images of several layers that are drawn into one after the other and read back together: the
/// triangles' numbers, depths, and the slots; colours of a pass in this order, numbers first.
class Target {
 public:
  static Result<Target> create(const Device& device, const SampleReader& reader,
                               const TargetShape& shape);

  const TargetShape& shape() const { return shape_; }

  /// Recorded before drawing: what was in the images is lost.
  void begin(VkCommandBuffer commands) const;
  /// Recorded around the drawing into one layer, which is cleared, its depths to `clear_depth`.
  void begin_layer(VkCommandBuffer commands, std::size_t layer, float clear_depth) const;
  static void end_layer(VkCommandBuffer commands);
  /// Recorded after drawing: reads so many layers back.
  void end(VkCommandBuffer commands, const SampleReader& reader, std::size_t layers) const;

  /// What was read back of a layer, once that has been done: [y][x][sample].
  std::span<const float> numbers(std::size_t layer) const;
  std::span<const float> depths(std::size_t layer) const;
  /// [y][x][sample][kSlotSize].
  std::span<const float> slot(std::size_t slot, std::size_t layer) const;

 private:
  struct Part {
    DeviceImage image;
    std::vector<ImageView> views;  ///< one for each layer
    ImageView whole;               ///< all layers, to read samples from
    bool is_depth = false;
    std::size_t components = 1;
    std::size_t begin = 0;  ///< in the buffer, bytes
  };

  Target() = default;
  Result<void> add_part(const Device& device, VkFormat format, std::size_t components);
  void barrier(VkCommandBuffer commands, const Part& part, bool is_before) const;
  std::span<const float> read(const Part& part, std::size_t layer) const;

  TargetShape shape_;
  std::vector<Part> parts_;  ///< depths, slots, numbers where there are some
  HostBuffer buffer_;
  SampleReader::Bindings bindings_;
};

}  // namespace rastercheck::backends::vulkan
