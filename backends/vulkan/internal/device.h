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

/// Which of the devices that an instance has: all that is asked for has to be so. Of several the
/// first, a GPU before what draws on the CPU unless the index says otherwise.
struct DeviceChoice {
  std::optional<std::size_t> index;  ///< in the loader's order
  std::string name;                  ///< a part of the device's name, in either case; empty: any
  std::string driver;                ///< Driver::name; empty: any
};

/// What images and pictures are made of.
inline constexpr VkFormat kNumberFormat = VK_FORMAT_R32_SFLOAT;
inline constexpr VkFormat kSlotFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

/// A device with one queue that draws, and what goes with it.
class Device {
 public:
  /// Fails where there is no such device, or it has no Vulkan 1.3, as Failure::unavailable.
  static Result<Device> create(Instance instance, const DeviceChoice& choice);

  Device(Device&& other) noexcept;
  Device& operator=(Device&& other) noexcept;
  ~Device();

  VkDevice get() const;
  VkPhysicalDevice physical() const;
  VkQueue queue() const;
  std::uint32_t queue_family() const;
  const Limits& limits() const;
  /// Device, driver and version of the API, on one line.
  std::string description() const;
  Driver driver() const;
  /// Whether it draws with the processor.
  bool is_software() const;
  /// Instance::take_messages.
  std::string take_messages();

 private:
  struct Impl;
  explicit Device(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan
