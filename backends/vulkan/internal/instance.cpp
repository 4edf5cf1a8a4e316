#include "backends/vulkan/internal/instance.h"

#include <cstdlib>
#include <optional>
#include <utility>

#include "backends/vulkan/internal/error.h"

namespace rastercheck::backends::vulkan {
namespace {

/// Sets an environment variable during its lifetime; the loader cannot be configured in another
/// way.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const before = std::getenv(name); before != nullptr) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() {
    if (before_) {
      ::setenv(name_, before_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::string joined(const std::vector<std::string>& files) {
  std::string all;
  for (const std::string& file : files) all += (all.empty() ? "" : ":") + file;
  return all;
}

VkBool32 VKAPI_PTR hear(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                        VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                        const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  auto& all = *static_cast<std::string*>(messages);
  all += (all.empty() ? "" : "; ") + std::string(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::string* messages) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = &hear;
  info.pUserData = messages;
  return info;
}

template <typename Function>
Function function_of(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

struct Instance::Impl {
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (messenger != VK_NULL_HANDLE) {
      const auto destroy = function_of<PFN_vkDestroyDebugUtilsMessengerEXT>(
          instance, "vkDestroyDebugUtilsMessengerEXT");
      if (destroy != nullptr) destroy(instance, messenger, nullptr);
    }
    if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
  }

  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  std::string messages;
};

Instance::Instance(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Instance::Instance(Instance&& other) noexcept = default;
Instance& Instance::operator=(Instance&& other) noexcept = default;
Instance::~Instance() = default;

VkInstance Instance::get() const { return impl_->instance; }
std::string Instance::take_messages() { return std::exchange(impl_->messages, std::string()); }

Result<Instance> Instance::create(const InstanceOptions& options) {
  std::optional<Variable> drivers;
  if (!options.driver_files.empty()) {
    drivers.emplace("VK_DRIVER_FILES", joined(options.driver_files));
  }
  // Implicit layers, such as overlays, must not affect the drawings that are judged.
  const Variable no_layers("VK_LOADER_LAYERS_DISABLE", "~implicit~");

  auto impl = std::make_unique<Impl>();
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "rastercheck";
  application.apiVersion = VK_API_VERSION_1_3;
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(&impl->messages);
  const char* const layer = "VK_LAYER_KHRONOS_validation";
  const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (options.validates) {
    info.pNext = &messenger;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  const VkResult made = vkCreateInstance(&info, nullptr, &impl->instance);
  if (made == VK_ERROR_LAYER_NOT_PRESENT) {
    return failed("missing " + std::string(layer), Failure::unavailable);
  }
  if (made == VK_ERROR_INCOMPATIBLE_DRIVER) {
    return failed("the Vulkan loader finds no driver (Debian's mesa-vulkan-drivers has one)",
                  Failure::unavailable);
  }
  if (made != VK_SUCCESS) {
    Error error = failed("vkCreateInstance", made).value();
    error.failure = Failure::unavailable;
    return tl::unexpected(std::move(error));
  }
  if (options.validates) {
    const auto create = function_of<PFN_vkCreateDebugUtilsMessengerEXT>(
        impl->instance, "vkCreateDebugUtilsMessengerEXT");
    if (create == nullptr ||
        create(impl->instance, &messenger, nullptr, &impl->messenger) != VK_SUCCESS) {
      return failed("the validation layer accepts no message callback", Failure::unavailable);
    }
  }
  return Instance(std::move(impl));
}

}  // namespace rastercheck::backends::vulkan
