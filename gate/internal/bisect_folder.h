#pragma once

// The folder of a bisection: all that is drawn and said, outside of what git checks out.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/error.h"
#include "records/plan.h"

namespace rastercheck::gate {

class BisectFolder {
 public:
  /// The folder `output`, which is made where it is missing and has to be empty; where it has no
  /// name a temporary one, which goes with this.
  static Result<BisectFolder> make(const std::string& output);

  /// Removes what is in it, and what make() made: as if there had been no bisection.
  void discard() const;

  BisectFolder(BisectFolder&& other) noexcept;
  BisectFolder& operator=(BisectFolder&&) = delete;
  BisectFolder(const BisectFolder&) = delete;
  BisectFolder& operator=(const BisectFolder&) = delete;
  ~BisectFolder();

  const std::string& path() const { return path_.native(); }  ///< absolute

  /// A plan whose folders, where they lie below `work_tree`, are copies of them as they are now:
  /// other commits may have others there, or none. The contract's file is one in this folder.
  Result<records::Plan> with_copies(records::Plan plan, const std::string& work_tree) const;

 private:
  BisectFolder(std::filesystem::path path, std::vector<std::filesystem::path> made,
               bool is_temporary);

  /// Puts a copy in the place of a folder below the work tree.
  Result<void> copy(std::string& folder, const std::string& name,
                    const std::string& work_tree) const;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< that make() made, the innermost first
  bool is_temporary_;
};

}  // namespace rastercheck::gate
