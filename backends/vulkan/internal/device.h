#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "backends/backend.h"
#include "backends/vulkan/internal/instance.h"
#include "backends/vulkan/internal/object.h"
#include "backends/vulkan/limits.h"

namespace rastercheck::backends::vulkan {

/// Which device of an instance to use. It must meet every condition. If several do and no index is
/// given, the first is used, where GPUs precede devices that draw on the CPU.
struct DeviceChoice {
  std::optional<std::size_t> index;  ///< in the loader's order
  std::string name;                  ///< part of the device's name, in either case; empty: any
  std::string driver;                ///< Driver::name; empty: any
};

/// The formats of images.
inline constexpr VkFormat kNumberFormat = VK_FORMAT_R32_SFLOAT;
inline constexpr VkFormat kSlotFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kByteFormat = VK_FORMAT_R8G8B8A8_UNORM;
inline constexpr VkFormat kFloatDepth = VK_FORMAT_D32_SFLOAT;

/// A device with one queue that draws, and the objects that belong to them.
class Device {
 public:
  /// Fails with Failure::unavailable if no device fits the choice, or if it lacks Vulkan 1.3.
  static Result<Device> create(Instance instance, const DeviceChoice& choice);

  Device(Device&& other) noexcept;
  Device& operator=(Device&& other) noexcept;
  ~Device();

  VkDevice get() const;
  VkPhysicalDevice physical() const;
  VkQueue queue() const;
  std::uint32_t queue_family() const;
  const Limits& limits() const;
  /// The format of images for a case's depths; undefined if the device has none.
  VkFormat depth_format(cases::DepthFormat format) const;
  /// Names the device, the driver and the API version, in one line.
  std::string description() const;
  Driver driver() const;
  /// True if the device draws on the processor.
  bool is_software() const;
  /// See Instance::take_messages().
  std::string take_messages();

 private:
  struct Impl;
  explicit Device(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan
