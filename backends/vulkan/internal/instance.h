#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <string>
#include <vector>

#include "cases/error.h"

namespace rastercheck::backends::vulkan {

struct InstanceOptions {
  /// The files that describe the only drivers to use; if empty, the loader chooses.
  std::vector<std::string> driver_files;
  bool validates = false;  ///< load the validation layer
};

class Instance {
 public:
  /// Fails with Failure::unavailable if the loader finds no driver, or lacks the requested
  /// validation layer.
  static Result<Instance> create(const InstanceOptions& options);

  Instance(Instance&& other) noexcept;
  Instance& operator=(Instance&& other) noexcept;
  ~Instance();

  VkInstance get() const;
  /// Returns the validation layer's messages since the last call. Empty without that layer.
  std::string take_messages();

 private:
  struct Impl;
  explicit Instance(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan
