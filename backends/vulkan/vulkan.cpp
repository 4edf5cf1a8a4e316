// The backend `vulkan`: any device that the Vulkan loader finds. `vulkan` is the machine's best,
// `vulkan:N` the Nth of them, `vulkan:NAME` one with that in its name; `vulkan:lavapipe` and
// `vulkan:swiftshader` are drivers that draw on the CPU, whose files are looked for where Debian
// has them. `,validate` behind any of these turns the validation layer on: whatever it has to say
// fails the case.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "backends/api_promise.h"
#include "backends/backend.h"
#include "backends/vulkan/internal/case_drawing.h"
#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/instance.h"
#include "backends/vulkan/limits.h"
#include "cases/json.h"

namespace rastercheck::backends {
namespace {

using vulkan::CaseDrawing;
using vulkan::Device;
using vulkan::DeviceChoice;
using vulkan::Instance;
using vulkan::InstanceOptions;

/// A driver that is asked for by name.
struct KnownDriver {
  std::string_view name;
  std::array<std::string_view, 2> folders;  ///< where files that describe it lie
  std::string_view file;                    ///< what their names begin with
  std::string_view package;                 ///< that has it in Debian
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

/// What a specification asks for.
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

std::vector<std::string> files_of(const KnownDriver& driver) {
  std::vector<std::string> files;
  for (const std::string_view folder : driver.folders) {
    std::error_code problem;
    for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(driver.file) && name.ends_with(".json")) {
        files.push_back(entry.path().string());
      }
    }
  }
  return files;
}

class VulkanBackend : public Backend {
 public:
  VulkanBackend(std::string specification, std::unique_ptr<Device> device, CaseDrawing drawing)
      : specification_(std::move(specification)),
        device_(std::move(device)),
        drawing_(std::move(drawing)) {}

  std::string description() const override { return device_->description(); }
  std::optional<Driver> driver() const override { return device_->driver(); }
  bool has_limits() const override { return true; }
  cases::Contract contract(const cases::Case& c) const override {
    return api_promise(c, {.subpixel_bits = device_->limits().subpixel_bits});
  }

  Result<cases::Framebuffer> draw(const cases::Case& c) override {
    const std::string missing = vulkan::lacks(device_->limits(), c);
    if (!missing.empty()) return fail({"", "", "it lacks " + missing, Failure::unsupported});
    Result<cases::Framebuffer> drawn = drawing_.draw(c);
    const std::string said = device_->take_messages();
    if (!said.empty()) return fail({"", "", "the validation layer says: " + cases::one_line(said)});
    if (!drawn) return fail(drawn.error());
    return drawn;
  }

 private:
  tl::unexpected<Error> fail(Error error) const {
    error.file = specification_;
    return tl::unexpected(std::move(error));
  }

  std::string specification_;
  std::unique_ptr<Device> device_;
  CaseDrawing drawing_;
};

Result<std::unique_ptr<Backend>> make_wanted(const std::string& specification,
                                             const Wanted& wanted) {
  InstanceOptions options;
  options.validates = wanted.validates;
  if (wanted.driver != nullptr) {
    options.driver_files = files_of(*wanted.driver);
    if (options.driver_files.empty()) {
      return tl::unexpected(
          Error{"", "",
                fmt::format("there is no {}*.json in {} (Debian's {} has it)", wanted.driver->file,
                            wanted.driver->folders[0], wanted.driver->package),
                Failure::unavailable});
    }
  }
  Result<Instance> instance = Instance::create(options);
  if (!instance) return tl::unexpected(instance.error());
  Result<Device> made = Device::create(*std::move(instance), wanted.device);
  if (!made) return tl::unexpected(made.error());
  auto device = std::make_unique<Device>(*std::move(made));
  Result<CaseDrawing> drawing = CaseDrawing::create(*device);
  if (!drawing) {
    Error error = drawing.error();
    error.failure = Failure::unavailable;
    return tl::unexpected(std::move(error));
  }
  return std::make_unique<VulkanBackend>(specification, std::move(device), *std::move(drawing));
}

Result<std::unique_ptr<Backend>> make(const std::string& options) {
  const std::string specification = "vulkan" + (options.empty() ? "" : ":" + options);
  Result<std::unique_ptr<Backend>> made = make_wanted(specification, wanted(options));
  if (made) return made;
  Error error = made.error();
  error.file = specification;
  return tl::unexpected(std::move(error));
}

Listing row_of(const std::string& specification) {
  const Result<std::unique_ptr<Backend>> made = make_backend(specification);
  if (made) return {specification, (*made)->description(), ""};
  Error error = made.error();
  error.file.clear();
  return {specification, "through Vulkan", to_string(error)};
}

std::vector<Listing> list() {
  std::vector<Listing> rows{row_of("vulkan")};
  for (const KnownDriver& driver : kKnownDrivers) {
    rows.push_back(row_of(fmt::format("vulkan:{}", driver.name)));
  }
  return rows;
}

const BackendRegistration kRegistration({"vulkan", &make, &list, true});

}  // namespace
}  // namespace rastercheck::backends
