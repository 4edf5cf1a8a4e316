#include "backends/driver_root.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace rastercheck::backends {
namespace {

namespace fs = std::filesystem;

/// The loader's name for programs like this one: a root may have libraries of several
/// architectures.
constexpr const char* kLoader =
#if defined(__x86_64__)
    "ld-linux-x86-64.so.2";
#elif defined(__aarch64__)
    "ld-linux-aarch64.so.1";
#else
    "ld.so.1";
#endif

/// The loader in a folder of Debian's: /usr/lib/x86_64-linux-gnu and the like.
Result<fs::path> loader_of(const fs::path& root) {
  for (const char* const parent : {"usr/lib", "lib"}) {
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(root / parent, problem)) {
      fs::path loader = entry.path() / kLoader;
      if (fs::exists(loader, problem)) return loader;
    }
  }
  return tl::unexpected(Error{root.string(), "",
                              fmt::format("is no unpacked system: no usr/lib/*/{} in it", kLoader),
                              Failure::unavailable});
}

/// Beginnings of the names of libraries that are part of a driver.
constexpr std::array<std::string_view, 6> kOfDrivers{
    "libEGL_mesa", "libgallium", "swrast_dri", "libvulkan_lvp", "libvk_swiftshader", "libLLVM"};

bool is_of_driver(const fs::path& library) {
  const std::string name = library.filename().string();
  return std::any_of(kOfDrivers.begin(), kOfDrivers.end(),
                     [&name](std::string_view begin) { return name.starts_with(begin); });
}

/// True if a library lies in the root, or if the root has a link to it in the same place.
bool is_in(const fs::path& root, const fs::path& library) {
  const auto [end, other] = std::mismatch(root.begin(), root.end(), library.begin(), library.end());
  std::error_code problem;
  return end == root.end() || fs::equivalent(root / library.relative_path(), library, problem);
}

/// The files of all libraries that are loaded.
std::vector<fs::path> loaded_libraries() {
  std::vector<fs::path> all;
  const auto add = [](dl_phdr_info* info, std::size_t, void* to) {
    static_cast<std::vector<fs::path>*>(to)->emplace_back(info->dlpi_name);
    return 0;
  };
  ::dl_iterate_phdr(add, &all);
  return all;
}

}  // namespace

RootedOptions split_root(const std::string& options) {
  const std::size_t at = options.find('@');
  if (at == std::string::npos) return {options, {}};
  const fs::path root = (fs::current_path() / options.substr(at + 1)).lexically_normal();
  return {options.substr(0, at), root.has_filename() ? root : root.parent_path()};
}

Result<fs::path> libraries_of(const fs::path& root) {
  return loader_of(root).map([](const fs::path& loader) { return loader.parent_path(); });
}

Result<std::vector<std::string>> loader_command(const std::string& specification) {
  // Other kinds of backends may have an @ in a file's name.
  const bool is_driver = specification.starts_with("gl:") || specification.starts_with("vulkan:");
  const fs::path root = is_driver ? split_root(specification).root : fs::path();
  if (root.empty()) return std::vector<std::string>();
  const Result<fs::path> loader = loader_of(root);
  if (!loader) return tl::unexpected(loader.error());
  return std::vector<std::string>{loader->string(), "--library-path",
                                  loader->parent_path().string()};
}

Result<void> check_started_by(const fs::path& root) {
  if (root.empty()) return {};
  const Result<fs::path> libraries = libraries_of(root);
  if (!libraries) return tl::unexpected(libraries.error());
  // Any function of the C library tells where that was loaded from.
  Dl_info info{};
  const bool is_known = ::dladdr(reinterpret_cast<const void*>(&std::getenv), &info) != 0;
  std::error_code problem;
  if (is_known && fs::equivalent(fs::path(info.dli_fname).parent_path(), *libraries, problem)) {
    return {};
  }
  return tl::unexpected(Error{root.string(), "",
                              "its drivers draw only in processes that its loader started; use "
                              "`rastercheck`, which starts one",
                              Failure::unavailable});
}

fs::path foreign_driver(const fs::path& root, const std::vector<fs::path>& libraries) {
  const auto found = std::find_if(
      libraries.begin(), libraries.end(),
      [&root](const fs::path& library) { return is_of_driver(library) && !is_in(root, library); });
  return found == libraries.end() ? fs::path() : *found;
}

Result<void> check_loaded_from(const fs::path& root) {
  const fs::path foreign = root.empty() ? root : foreign_driver(root, loaded_libraries());
  if (foreign.empty()) return {};
  return tl::unexpected(Error{root.string(), "",
                              fmt::format("{} was loaded instead of a library of the root, perhaps "
                                          "because a file of the root names it by its whole path",
                                          foreign.string()),
                              Failure::unavailable});
}

}  // namespace rastercheck::backends
