#pragma once

// The folder of a bisection: all that is drawn and said, outside of what git checks out.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/error.h"

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

  /// Words of a command in which files and folders that lie below `work_tree` are copies of them as
  /// they are now: other commits may have others there, or none. Only those that `options` name:
  /// their values.
  Result<std::vector<std::string>> with_copies(std::vector<std::string> words,
                                               const std::vector<std::string>& options,
                                               const std::string& work_tree) const;

 private:
  BisectFolder(std::filesystem::path path, std::vector<std::filesystem::path> made,
               bool is_temporary);

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< that make() made, the innermost first
  bool is_temporary_;
};

}  // namespace rastercheck::gate
