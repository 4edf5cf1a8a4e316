#include "backends/vulkan/internal/open_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "backends/driver_root.h"
#include "backends/vulkan/internal/error.h"
#include "backends/vulkan/internal/instance.h"

namespace rastercheck::backends::vulkan {
namespace {

/// A driver that can be requested by name.
struct KnownDriver {
  std::string_view name;
  std::array<std::string_view, 2> folders;  ///< folders of the files that describe the driver
  std::string_view file;                    ///< start of those files' names
  std::string_view package;                 ///< the Debian package that has the driver
};
constexpr std::array<KnownDriver, 2> kKnownDrivers{{
    {"lavapipe",
     {"/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"},
     "lvp_icd",
     "mesa-vulkan-drivers"},
    {"swiftshader",
     {"/usr/lib/chromium", "/usr/lib/chromium-browser"},
     "vk_swiftshader_icd",
     "chromium-common"},
}};

/// The request that a specification makes.
struct Wanted {
  DeviceChoice device;
  const KnownDriver* driver = nullptr;
  bool validates = false;
};

Wanted wanted(const std::string& options) {
  constexpr std::string_view kValidate = "validate";
  Wanted wanted;
  std::string which = options;
  if (which == kValidate) {
    which.clear();
    wanted.validates = true;
  } else if (which.ends_with("," + std::string(kValidate))) {
    which.resize(which.size() - kValidate.size() - 1);
    wanted.validates = true;
  }
  const auto known = std::find_if(kKnownDrivers.begin(), kKnownDrivers.end(),
                                  [&](const KnownDriver& d) { return d.name == which; });
  std::size_t index = 0;
  const auto [end, problem] = std::from_chars(which.data(), which.data() + which.size(), index);
  if (known != kKnownDrivers.end()) {
    wanted.driver = &*known;
    wanted.device.driver = which;
  } else if (problem == std::errc() && end == which.data() + which.size()) {
    wanted.device.index = index;
  } else {
    wanted.device.name = which;
  }
  return wanted;
}

std::vector<std::string> files_of(const KnownDriver& driver, const std::filesystem::path& root) {
  std::vector<std::string> files;
  for (const std::string_view folder : driver.folders) {
    std::error_code problem;
    const std::filesystem::path where = root / folder.substr(root.empty() ? 0 : 1);
    for (const auto& entry : std::filesystem::directory_iterator(where, problem)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(driver.file) && name.ends_with(".json")) {
        files.push_back(entry.path().string());
      }
    }
  }
  return files;
}

}  // namespace

std::vector<std::string_view> driver_names() {
  std::vector<std::string_view> names;
  names.reserve(kKnownDrivers.size());
  for (const KnownDriver& driver : kKnownDrivers) names.push_back(driver.name);
  return names;
}

Result<Device> open_device(const std::string& options) {
  const RootedOptions rooted = split_root(options);
  if (const Result<void> started = check_started_by(rooted.root); !started) {
    return tl::unexpected(started.error());
  }
  const Wanted which = wanted(rooted.options);
  if (!rooted.root.empty() && which.driver == nullptr) {
    return failed("only lavapipe and swiftshader may come from a root", Failure::unavailable);
  }
  InstanceOptions instance_options;
  instance_options.validates = which.validates;
  if (which.driver != nullptr) {
    instance_options.driver_files = files_of(*which.driver, rooted.root);
    if (instance_options.driver_files.empty()) {
      return failed(
          fmt::format("no {}*.json in {}{} (Debian's {} has it)", which.driver->file,
                      rooted.root.string(), which.driver->folders[0], which.driver->package),
          Failure::unavailable);
    }
  }
  Result<Instance> instance = Instance::create(instance_options);
  if (!instance) return tl::unexpected(instance.error());
  Result<Device> device = Device::create(*std::move(instance), which.device);
  if (!device) return device;
  if (const Result<void> loaded = check_loaded_from(rooted.root); !loaded) {
    return tl::unexpected(loaded.error());
  }
  return device;
}

}  // namespace rastercheck::backends::vulkan
