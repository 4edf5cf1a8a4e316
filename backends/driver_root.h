#pragma once

// Drivers of another release, unpacked into a folder: the root of `gl:llvmpipe@ROOT` and
// `vulkan:lavapipe@ROOT`. docs/judge-a-driver.md tells how to unpack one.
//
// A driver needs the C library, the compiler and the API's loader that it was built for. So the
// process that draws with it is started by the root's own dynamic loader, which looks for libraries
// in the root first. What the root does not have, such as this program's libraries, is this
// system's.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/error.h"

namespace rastercheck::backends {

/// Options of a driver, and the root that it comes from.
struct RootedOptions {
  std::string options;         ///< without the root
  std::filesystem::path root;  ///< absolute; empty: this system
};

/// Splits "llvmpipe@/unpacked". The root is what follows the first `@`, the current folder if that
/// is nothing.
RootedOptions split_root(const std::string& options);

/// The folder of a root's libraries, the one that its dynamic loader is in. Fails if there is none.
Result<std::filesystem::path> libraries_of(const std::filesystem::path& root);

/// What precedes a program's name in the command of a process that draws with the backend of a
/// specification: nothing, or the root's loader and its options.
Result<std::vector<std::string>> loader_command(const std::string& specification);

/// Fails unless this process was started by the root's loader. Always succeeds without a root.
Result<void> check_started_by(const std::filesystem::path& root);

/// The first of some loaded libraries that is part of a driver and not in the root; empty if there
/// is none.
std::filesystem::path foreign_driver(const std::filesystem::path& root,
                                     const std::vector<std::filesystem::path>& libraries);

/// Fails if this process has loaded a foreign_driver(). Always succeeds without a root.
Result<void> check_loaded_from(const std::filesystem::path& root);

}  // namespace rastercheck::backends
