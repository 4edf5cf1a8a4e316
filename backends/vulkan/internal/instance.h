#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <string>
#include <vector>

#include "cases/error.h"

namespace rastercheck::backends::vulkan {

struct InstanceOptions {
  /// Files that describe drivers, these and no others; empty: what the loader finds.
  std::vector<std::string> driver_files;
  bool validates = false;  ///< with the validation layer
};

class Instance {
 public:
  /// Fails where there is no driver or no layer, as Failure::unavailable.
  static Result<Instance> create(const InstanceOptions& options);

  Instance(Instance&& other) noexcept;
  Instance& operator=(Instance&& other) noexcept;
  ~Instance();

  VkInstance get() const;
  /// What the validation layer has said since it was asked last; empty without it.
  std::string take_messages();

 private:
  struct Impl;
  explicit Instance(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace rastercheck::backends::vulkan
