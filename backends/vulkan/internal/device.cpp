#include "backends/vulkan/internal/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/vulkan/driver_name.h"
#include "backends/vulkan/internal/error.h"
#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {
namespace {

struct Properties {
  VkPhysicalDeviceProperties device{};
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                          nullptr,
                                          VK_DRIVER_ID_MAX_ENUM,  // matches no driver
                                          {},
                                          {},
                                          {}};
};

Properties properties_of(VkPhysicalDevice physical) {
  Properties all;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  // Devices of older versions report nothing about their driver.
  VkPhysicalDeviceProperties plain{};
  vkGetPhysicalDeviceProperties(physical, &plain);
  if (plain.apiVersion >= VK_API_VERSION_1_2) properties.pNext = &all.driver;
  vkGetPhysicalDeviceProperties2(physical, &properties);
  all.device = properties.properties;
  all.driver.pNext = nullptr;
  return all;
}

Driver driver_of(const Properties& properties) {
  return driver_named({static_cast<std::uint32_t>(properties.driver.driverID),
                       properties.driver.driverName, properties.driver.driverInfo,
                       properties.device.driverVersion});
}

bool has_part(std::string_view text, std::string_view part) {
  const auto alike = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), alike) != text.end();
}

/// The rank of a type of device; lower is better.
int rank_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    default:
      return 3;
  }
}

std::string in_words(const DeviceChoice& choice) {
  std::string words;
  if (choice.index) words += fmt::format(" with index {}", *choice.index);
  if (!choice.name.empty()) words += fmt::format(" with '{}' in its name", choice.name);
  if (!choice.driver.empty()) words += fmt::format(" with the driver {}", choice.driver);
  return words;
}

Result<VkPhysicalDevice> choose(VkInstance instance, const DeviceChoice& choice) {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> all(count);
  const VkResult listed = vkEnumeratePhysicalDevices(instance, &count, all.data());
  if (listed != VK_SUCCESS) return failed("vkEnumeratePhysicalDevices", listed);
  VkPhysicalDevice best = VK_NULL_HANDLE;
  int best_rank = 0;
  std::string there;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Properties properties = properties_of(all[i]);
    there += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, properties.device.deviceName);
    const int rank = rank_of(properties.device.deviceType);
    if ((choice.index && *choice.index != i) ||
        !has_part(properties.device.deviceName, choice.name) ||
        (!choice.driver.empty() && driver_of(properties).name != choice.driver) ||
        (best != VK_NULL_HANDLE && rank >= best_rank)) {
      continue;
    }
    best = all[i];
    best_rank = rank;
  }
  if (best != VK_NULL_HANDLE) return best;
  return failed(fmt::format("no Vulkan device{}; devices: {}", in_words(choice),
                            there.empty() ? "none" : there),
                Failure::unavailable);
}

std::set<std::string> extensions_of(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> all(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, all.data());
  std::set<std::string> names;
  for (const VkExtensionProperties& extension : all) names.insert(extension.extensionName);
  return names;
}

/// The features that are used, in structs that point at each other: not copyable or movable.
struct Features {
  VkPhysicalDeviceFeatures2 core{};
  VkPhysicalDeviceVulkan13Features vulkan13{};
  VkPhysicalDeviceDepthClipControlFeaturesEXT depth_clip_control{};
  VkPhysicalDeviceProvokingVertexFeaturesEXT provoking_vertex{};
  VkPhysicalDeviceLineRasterizationFeaturesEXT lines{};
  std::vector<const char*> extensions;

  explicit Features(const std::set<std::string>& available) {
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    depth_clip_control.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_CONTROL_FEATURES_EXT;
    provoking_vertex.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT;
    lines.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT;
    core.pNext = &vulkan13;
    if (available.contains(VK_EXT_DEPTH_CLIP_CONTROL_EXTENSION_NAME)) {
      depth_clip_control.pNext = std::exchange(core.pNext, &depth_clip_control);
      extensions.push_back(VK_EXT_DEPTH_CLIP_CONTROL_EXTENSION_NAME);
    }
    if (available.contains(VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME)) {
      provoking_vertex.pNext = std::exchange(core.pNext, &provoking_vertex);
      extensions.push_back(VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME);
    }
    if (available.contains(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME)) {
      lines.pNext = std::exchange(core.pNext, &lines);
      extensions.push_back(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
    }
  }
  Features(const Features&) = delete;
  Features& operator=(const Features&) = delete;
  ~Features() = default;

  /// Drops the device's features that are not used.
  void keep_used() {
    const VkPhysicalDeviceFeatures has = core.features;
    core.features = {};
    core.features.depthClamp = has.depthClamp;
    core.features.depthBiasClamp = has.depthBiasClamp;
    core.features.shaderClipDistance = has.shaderClipDistance;
    core.features.sampleRateShading = has.sampleRateShading;
    core.features.fragmentStoresAndAtomics = has.fragmentStoresAndAtomics;
    core.features.wideLines = has.wideLines;
    core.features.largePoints = has.largePoints;
    void* const next = vulkan13.pNext;
    const VkBool32 dynamic = vulkan13.dynamicRendering;
    vulkan13 = {};
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    vulkan13.pNext = next;
    vulkan13.dynamicRendering = dynamic;
    provoking_vertex.transformFeedbackPreservesProvokingVertex = VK_FALSE;
    lines.smoothLines = lines.stippledRectangularLines = VK_FALSE;
    lines.stippledBresenhamLines = lines.stippledSmoothLines = VK_FALSE;
  }
};

/// The first family of queues that can both draw and compute.
std::optional<std::uint32_t> drawing_family(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> all(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, all.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    constexpr VkQueueFlags kBoth = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    if ((all[i].queueFlags & kBoth) == kBoth) return i;
  }
  return std::nullopt;
}

/// The sample counts of images that are attachments and that shaders read; 0 if there are no such
/// images.
unsigned sample_counts_of(VkPhysicalDevice physical, VkFormat format,
                          VkImageUsageFlagBits attachment) {
  VkImageFormatProperties properties{};
  const VkResult known = vkGetPhysicalDeviceImageFormatProperties(
      physical, format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
      static_cast<VkImageUsageFlags>(attachment) | VK_IMAGE_USAGE_SAMPLED_BIT, 0, &properties);
  return known == VK_SUCCESS ? properties.sampleCounts : 0U;
}

/// The sample counts that all images of a target support, whose depths are float32.
unsigned sample_counts_of(VkPhysicalDevice physical) {
  unsigned counts = ~0U;
  for (const auto& [format, attachment] :
       {std::pair(kNumberFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT),
        std::pair(kSlotFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT),
        std::pair(kFloatDepth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT)}) {
    counts &= sample_counts_of(physical, format, attachment) | 1U;
  }
  return counts;
}

/// The sample counts of images with this format of depth that can also be copied from; 0 if the
/// device cannot draw into such images and read them.
unsigned depth_sample_counts_of(VkPhysicalDevice physical, VkFormat format) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
  constexpr VkFormatFeatureFlags kNeeded = VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                           VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
                                           VK_FORMAT_FEATURE_TRANSFER_SRC_BIT;
  if ((properties.optimalTilingFeatures & kNeeded) != kNeeded) return 0;
  return sample_counts_of(physical, format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
}

bool blends(VkPhysicalDevice physical, VkFormat format) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
  constexpr VkFormatFeatureFlags kBlends = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
  return (properties.optimalTilingFeatures & kBlends) != 0;
}

/// The format with 24 bits of depth that supports most sample counts; undefined if there is none.
VkFormat unorm24_of(VkPhysicalDevice physical) {
  const unsigned of_depth = depth_sample_counts_of(physical, VK_FORMAT_X8_D24_UNORM_PACK32);
  const unsigned of_both = depth_sample_counts_of(physical, VK_FORMAT_D24_UNORM_S8_UINT);
  if (of_depth == 0 && of_both == 0) return VK_FORMAT_UNDEFINED;
  return of_depth >= of_both ? VK_FORMAT_X8_D24_UNORM_PACK32 : VK_FORMAT_D24_UNORM_S8_UINT;
}

/// Reads what lines and points the device has.
void read_primitives(const VkPhysicalDeviceLimits& device, const Features& features,
                     Limits& limits) {
  if (features.core.features.wideLines == VK_TRUE) {
    limits.line_widths = {device.lineWidthRange[0], device.lineWidthRange[1],
                          device.lineWidthGranularity};
  }
  if (features.core.features.largePoints == VK_TRUE) {
    limits.point_sizes = {device.pointSizeRange[0], device.pointSizeRange[1],
                          device.pointSizeGranularity};
  }
  limits.strict_lines = device.strictLines == VK_TRUE;
  limits.rectangular_lines = features.lines.rectangularLines == VK_TRUE;
  limits.bresenham_lines = features.lines.bresenhamLines == VK_TRUE;
}

Limits limits_of(VkPhysicalDevice physical, const Features& features) {
  const VkPhysicalDeviceLimits device = properties_of(physical).device.limits;
  const VkPhysicalDeviceFeatures& core = features.core.features;
  Limits limits;
  limits.max_width =
      static_cast<int>(std::min(device.maxFramebufferWidth, device.maxImageDimension2D));
  limits.max_height =
      static_cast<int>(std::min(device.maxFramebufferHeight, device.maxImageDimension2D));
  limits.sample_counts = sample_counts_of(physical);
  limits.standard_sample_locations = device.standardSampleLocations == VK_TRUE;
  limits.max_viewport = {static_cast<float>(device.maxViewportDimensions[0]),
                         static_cast<float>(device.maxViewportDimensions[1])};
  limits.viewport_bounds = {device.viewportBoundsRange[0], device.viewportBoundsRange[1]};
  limits.viewport_subpixel_bits = static_cast<int>(device.viewportSubPixelBits);
  limits.subpixel_bits = static_cast<int>(device.subPixelPrecisionBits);
  limits.subtexel_bits = static_cast<int>(device.subTexelPrecisionBits);
  limits.clip_distances =
      core.shaderClipDistance == VK_TRUE ? static_cast<int>(device.maxClipDistances) : 0;
  limits.sample_rate_shading = core.sampleRateShading == VK_TRUE;
  limits.fragment_stores = core.fragmentStoresAndAtomics == VK_TRUE;
  limits.max_storage = device.maxStorageBufferRange;
  limits.depth_clamp = core.depthClamp == VK_TRUE;
  limits.depth_bias_clamp = core.depthBiasClamp == VK_TRUE;
  limits.unorm16_samples = depth_sample_counts_of(physical, VK_FORMAT_D16_UNORM);
  if (const VkFormat format = unorm24_of(physical); format != VK_FORMAT_UNDEFINED) {
    limits.unorm24_samples = depth_sample_counts_of(physical, format);
  }
  limits.depth_clip_control = features.depth_clip_control.depthClipControl == VK_TRUE;
  limits.provoking_vertex_last = features.provoking_vertex.provokingVertexLast == VK_TRUE;
  // One attachment is needed for the triangle's number.
  limits.slots = static_cast<int>(std::min<std::size_t>(
      std::min(device.maxColorAttachments, device.maxFragmentOutputAttachments) - 1, kMaxSlots));
  limits.float_blending = blends(physical, kSlotFormat);
  limits.byte_samples =
      sample_counts_of(physical, kByteFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) | 1U;
  limits.max_texture = static_cast<int>(device.maxImageDimension2D);
  read_primitives(device, features, limits);
  return limits;
}

tl::unexpected<Error> unavailable(const std::string& name, const std::string& what) {
  return failed(name + " has no " + what, Failure::unavailable);
}

}  // namespace

struct Device::Impl {
  explicit Impl(Instance the_instance) : instance(std::move(the_instance)) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (device != VK_NULL_HANDLE) vkDestroyDevice(device, nullptr);
  }

  Instance instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t family = 0;
  Limits limits;
  VkFormat unorm24 = VK_FORMAT_UNDEFINED;
  Properties properties;
};

Device::Device(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Device::Device(Device&& other) noexcept = default;
Device& Device::operator=(Device&& other) noexcept = default;
Device::~Device() = default;

VkDevice Device::get() const { return impl_->device; }
VkPhysicalDevice Device::physical() const { return impl_->physical; }
VkQueue Device::queue() const { return impl_->queue; }
std::uint32_t Device::queue_family() const { return impl_->family; }
const Limits& Device::limits() const { return impl_->limits; }
VkFormat Device::depth_format(cases::DepthFormat format) const {
  switch (cases::unorm_bits(format)) {
    case 0:
      return kFloatDepth;
    case 16:
      return impl_->limits.unorm16_samples == 0 ? VK_FORMAT_UNDEFINED : VK_FORMAT_D16_UNORM;
    case 24:
      return impl_->unorm24;
    default:
      return VK_FORMAT_UNDEFINED;
  }
}
Driver Device::driver() const { return driver_of(impl_->properties); }
std::string Device::take_messages() { return impl_->instance.take_messages(); }

std::string Device::description() const {
  const Driver by = driver();
  const std::uint32_t api = impl_->properties.device.apiVersion;
  return fmt::format("{}, {} {}, Vulkan {}.{}.{}", impl_->properties.device.deviceName, by.name,
                     by.version, VK_API_VERSION_MAJOR(api), VK_API_VERSION_MINOR(api),
                     VK_API_VERSION_PATCH(api));
}

bool Device::is_software() const {
  return impl_->properties.device.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

Result<Device> Device::create(Instance instance, const DeviceChoice& choice) {
  const Result<VkPhysicalDevice> physical = choose(instance.get(), choice);
  if (!physical) return tl::unexpected(physical.error());
  auto impl = std::make_unique<Impl>(std::move(instance));
  impl->physical = *physical;
  impl->properties = properties_of(*physical);
  const std::string name = impl->properties.device.deviceName;
  if (impl->properties.device.apiVersion < VK_API_VERSION_1_3) {
    return unavailable(name, "Vulkan 1.3");
  }
  const std::optional<std::uint32_t> family = drawing_family(*physical);
  if (!family) return unavailable(name, "graphics queue");
  impl->family = *family;

  Features features(extensions_of(*physical));
  vkGetPhysicalDeviceFeatures2(*physical, &features.core);
  features.keep_used();
  impl->limits = limits_of(*physical, features);
  impl->unorm24 = unorm24_of(*physical);
  constexpr float kPriority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = *family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &kPriority;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features.core;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(features.extensions.size());
  info.ppEnabledExtensionNames = features.extensions.data();
  if (const VkResult made = vkCreateDevice(*physical, &info, nullptr, &impl->device);
      made != VK_SUCCESS) {
    impl->device = VK_NULL_HANDLE;
    Error error = failed(("vkCreateDevice of " + name).c_str(), made).value();
    error.failure = Failure::unavailable;
    return tl::unexpected(std::move(error));
  }
  vkGetDeviceQueue(impl->device, *family, 0, &impl->queue);
  return Device(std::move(impl));
}

}  // namespace rastercheck::backends::vulkan
