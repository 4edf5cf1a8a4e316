#include "reports/internal/bisect_folder.h"

#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace rastercheck::reports {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> failure(const std::string& file, const std::string& what,
                              const std::error_code& why) {
  return tl::unexpected(Error{file, "", what + ": " + why.message()});
}

/// Whether a path that is there lies below a folder, links followed.
bool is_below(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  const fs::path real = fs::weakly_canonical(path, ignored);
  const fs::path top = fs::weakly_canonical(folder, ignored);
  return std::mismatch(top.begin(), top.end(), real.begin(), real.end()).first == top.end();
}

}  // namespace

BisectFolder::BisectFolder(fs::path path, bool is_temporary)
    : path_(std::move(path)), is_temporary_(is_temporary) {}

BisectFolder::BisectFolder(BisectFolder&& other) noexcept
    : path_(std::move(other.path_)), is_temporary_(std::exchange(other.is_temporary_, false)) {}

BisectFolder::~BisectFolder() {
  std::error_code ignored;
  if (is_temporary_) fs::remove_all(path_, ignored);
}

Result<BisectFolder> BisectFolder::make(const std::string& output) {
  std::error_code why;
  if (output.empty()) {
    std::string name = (fs::temp_directory_path(why) / "rastercheck-bisect-XXXXXX").string();
    if (!why && ::mkdtemp(name.data()) != nullptr) return BisectFolder(name, true);
    return tl::unexpected(Error{name, "", "a temporary folder cannot be made"});
  }
  const fs::path path = fs::absolute(output, why);
  if (!why) fs::create_directories(path, why);
  if (why) return failure(output, "cannot be made", why);
  const bool is_empty = fs::is_empty(path, why);
  if (why) return failure(output, "cannot be read", why);
  if (!is_empty) return tl::unexpected(Error{output, "", "is not empty"});
  return BisectFolder(path, false);
}

Result<std::vector<std::string>> BisectFolder::with_copies(std::vector<std::string> words,
                                                           const std::vector<std::string>& options,
                                                           const std::string& work_tree) const {
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (std::find(options.begin(), options.end(), words[i]) == options.end()) continue;
    std::string& value = words[++i];
    if (!is_below(value, work_tree)) continue;
    const fs::path copy = path_ / "given" / std::to_string(i);
    std::error_code why;
    fs::create_directories(copy.parent_path(), why);
    if (!why) fs::copy(value, copy, fs::copy_options::recursive, why);
    if (why) return failure(value, "cannot be copied", why);
    value = copy.string();
  }
  return words;
}

}  // namespace rastercheck::reports
