#include "backends/driver_root.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>

namespace rastercheck::backends {
namespace {

namespace fs = std::filesystem;

bool is_loader(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with("ld-linux") && name.find(".so") != std::string::npos;
}

/// The dynamic loader among a folder's files.
std::optional<fs::path> loader_in(const fs::path& folder) {
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    if (is_loader(entry.path())) return entry.path();
  }
  return std::nullopt;
}

/// The loader in a folder of Debian's: /usr/lib/x86_64-linux-gnu and the like.
Result<fs::path> loader_of(const fs::path& root) {
  for (const char* const parent : {"usr/lib", "lib"}) {
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(root / parent, problem)) {
      if (!entry.is_directory(problem)) continue;
      if (const std::optional<fs::path> loader = loader_in(entry.path())) return *loader;
    }
  }
  return tl::unexpected(Error{root.string(), "",
                              "is no unpacked system: no usr/lib/*/ld-linux*.so.* in it",
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
  const fs::path root = fs::absolute(options.substr(at + 1)).lexically_normal();
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
                              "a driver of a root draws only in a process that its loader started",
                              Failure::unavailable});
}

Result<void> check_loaded_from(const fs::path& root) {
  if (root.empty()) return {};
  for (const fs::path& library : loaded_libraries()) {
    if (!is_of_driver(library)) continue;
    if (is_in(root, library)) continue;
    return tl::unexpected(Error{root.string(), "",
                                fmt::format("{} was loaded, which is not the root's: a file of the "
                                            "root names it by its whole path",
                                            library.string()),
                                Failure::unavailable});
  }
  return {};
}

}  // namespace rastercheck::backends
