#include "backends/vulkan/driver_name.h"

#include <fmt/format.h>
#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace rastercheck::backends::vulkan {
namespace {

constexpr std::array<std::pair<VkDriverId, std::string_view>, 9> kNames{{
    {VK_DRIVER_ID_MESA_LLVMPIPE, "lavapipe"},
    {VK_DRIVER_ID_GOOGLE_SWIFTSHADER, "swiftshader"},
    {VK_DRIVER_ID_MESA_RADV, "radv"},
    {VK_DRIVER_ID_AMD_OPEN_SOURCE, "amdvlk"},
    {VK_DRIVER_ID_AMD_PROPRIETARY, "amd"},
    {VK_DRIVER_ID_NVIDIA_PROPRIETARY, "nvidia"},
    {VK_DRIVER_ID_INTEL_OPEN_SOURCE_MESA, "anv"},
    {VK_DRIVER_ID_MESA_TURNIP, "turnip"},
    {VK_DRIVER_ID_MESA_V3DV, "v3dv"},
}};

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string first_word(const std::string& text) {
  std::string word = text.substr(0, text.find(' '));
  std::transform(word.begin(), word.end(), word.begin(), lower);
  return word.empty() ? "unknown" : word;
}

std::string name_of(const DriverFacts& facts) {
  for (const auto& [id, name] : kNames) {
    if (facts.id == static_cast<std::uint32_t>(id)) return std::string(name);
  }
  return first_word(facts.name);
}

}  // namespace

Driver driver_named(const DriverFacts& facts) {
  // The text in brackets names the compiler, or the commit that the driver was built from.
  std::string version = facts.info.substr(0, facts.info.find(" ("));
  if (version.empty()) {
    version = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(facts.version),
                          VK_API_VERSION_MINOR(facts.version), VK_API_VERSION_PATCH(facts.version));
  }
  return {name_of(facts), std::move(version)};
}

}  // namespace rastercheck::backends::vulkan
