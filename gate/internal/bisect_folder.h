#pragma once

// The output folder of a bisection, outside the checked-out files.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/error.h"
#include "records/plan.h"

namespace rastercheck::gate {

class BisectFolder {
 public:
  /// Opens the folder `output`, which is created if missing and must be empty. If `output` is
  /// empty, makes a temporary folder, which is removed with this object.
  static Result<BisectFolder> make(const std::string& output);

  /// Removes the folder's content and everything that make() made.
  void discard() const;

  BisectFolder(BisectFolder&& other) noexcept;
  BisectFolder& operator=(BisectFolder&&) = delete;
  BisectFolder(const BisectFolder&) = delete;
  BisectFolder& operator=(const BisectFolder&) = delete;
  ~BisectFolder();

  const std::string& path() const { return path_.native(); }  ///< absolute

  /// Returns the plan with files and folders below `work_tree` replaced by copies of their present
  /// state, as other commits may change or lack them. Writes the plan's contract to a file in this
  /// folder and points the plan to it.
  Result<records::Plan> with_copies(records::Plan plan, const std::string& work_tree) const;

 private:
  BisectFolder(std::filesystem::path path, std::vector<std::filesystem::path> made,
               bool is_temporary);

  /// Replaces a file or folder below the work tree by a copy.
  Result<void> copy(std::string& folder, const std::string& name,
                    const std::string& work_tree) const;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< folders made by make(), innermost first
  bool is_temporary_;
};

}  // namespace rastercheck::gate
