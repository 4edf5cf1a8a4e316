#include "gate/internal/bisect_folder.h"

#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cases/contract_json.h"
#include "cases/files.h"

namespace rastercheck::gate {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> folder_failure(const std::string& file, const std::string& what,
                                     const std::error_code& why) {
  return tl::unexpected(Error{file, "", what + ": " + why.message()});
}

/// True if an existing path lies below a folder, with links resolved.
bool is_below(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  const fs::path real = fs::weakly_canonical(path, ignored);
  const fs::path top = fs::weakly_canonical(folder, ignored);
  return std::mismatch(top.begin(), top.end(), real.begin(), real.end()).first == top.end();
}

/// Returns the missing folders on the way to a path, including the path itself, innermost first.
std::vector<fs::path> missing(fs::path path) {
  std::error_code why;
  std::vector<fs::path> all;
  while (!path.empty() && path != path.root_path() && !fs::exists(path, why) && !why) {
    all.push_back(path);
    path = path.parent_path();
  }
  return all;
}

}  // namespace

BisectFolder::BisectFolder(fs::path path, std::vector<fs::path> made, bool is_temporary)
    : path_(std::move(path)), made_(std::move(made)), is_temporary_(is_temporary) {}

BisectFolder::BisectFolder(BisectFolder&& other) noexcept
    : path_(std::move(other.path_)),
      made_(std::move(other.made_)),
      is_temporary_(std::exchange(other.is_temporary_, false)) {}

BisectFolder::~BisectFolder() {
  std::error_code ignored;
  if (is_temporary_) fs::remove_all(path_, ignored);
}

void BisectFolder::discard() const {
  std::error_code ignored;
  std::error_code end;
  for (fs::directory_iterator entry(path_, end); !end && entry != fs::directory_iterator();
       entry.increment(end)) {
    fs::remove_all(entry->path(), ignored);
  }
  // A folder stays if somebody else put something into it.
  for (const fs::path& folder : made_) fs::remove(folder, ignored);
}

Result<BisectFolder> BisectFolder::make(const std::string& output) {
  std::error_code why;
  if (output.empty()) {
    std::string name = (fs::temp_directory_path(why) / "rastercheck-bisect-XXXXXX").string();
    if (!why && ::mkdtemp(name.data()) != nullptr) return BisectFolder(name, {}, true);
    return tl::unexpected(Error{name, "", "a temporary folder cannot be created"});
  }
  fs::path path = fs::absolute(output, why);
  if (!path.has_filename()) path = path.parent_path();  // without a '/' at its end
  std::vector<fs::path> made = missing(path);
  if (!why) fs::create_directories(path, why);
  if (why) return folder_failure(output, "cannot be created", why);
  const bool is_empty = fs::is_empty(path, why);
  if (why) return folder_failure(output, "cannot be read", why);
  if (!is_empty)
    return tl::unexpected(Error{output, "", "is not empty; give a new or empty folder"});
  return BisectFolder(path, std::move(made), false);
}

Result<void> BisectFolder::copy(std::string& folder, const std::string& name,
                                const std::string& work_tree) const {
  if (folder.empty() || !is_below(folder, work_tree)) return {};
  const fs::path copy = path_ / "given" / name;
  std::error_code why;
  fs::create_directories(copy.parent_path(), why);
  if (!why) fs::copy(folder, copy, fs::copy_options::recursive, why);
  if (why) return folder_failure(folder, "cannot be copied", why);
  folder = copy.string();
  return {};
}

Result<records::Plan> BisectFolder::with_copies(records::Plan plan,
                                                const std::string& work_tree) const {
  const Result<void> copied = copy(plan.corpus, "corpus", work_tree);
  if (!copied) return tl::unexpected(copied.error());
  for (std::size_t i = 0; i < plan.known.size(); ++i) {
    std::string& source = plan.known[i];
    const fs::path folder = "known-" + std::to_string(i);
    // Entries of a list of known defects name case files relative to the list, so the folder
    // `known` is copied, too. The copy of the list keeps its file name, which tells whether the
    // list is an expectation list.
    std::string shown = (fs::path(source).parent_path() / "known").string();
    const fs::path name = folder / fs::path(source).filename();
    const bool is_file = !fs::is_directory(source);
    Result<void> made = copy(source, (is_file ? name : folder).string(), work_tree);
    if (made && is_file && fs::is_directory(shown)) {
      made = copy(shown, (folder / "known").string(), work_tree);
    }
    if (!made) return tl::unexpected(made.error());
  }
  if (!plan.contract) return plan;
  const fs::path file = path_ / "given" / "contract.json";
  std::error_code why;
  fs::create_directories(file.parent_path(), why);
  if (why) return folder_failure(file.string(), "cannot be created", why);
  plan.contract->file = file.string();
  return cases::write_file(file.string(), cases::to_json(plan.contract->terms)).map([&plan] {
    return plan;
  });
}

}  // namespace rastercheck::gate
