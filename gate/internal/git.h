#pragma once

// Accesses a user's repository, only through the program git.

#include <string>
#include <vector>

#include "cases/error.h"
#include "gate/bisect.h"
#include "gate/internal/outside_command.h"

namespace rastercheck::gate {

/// git in the current folder. If a command fails, the error quotes git's message.
class Git {
 public:
  /// `folder` receives git's output: answers, and a log of everything else.
  explicit Git(std::string folder);

  /// Returns a command's standard output, without the final newline.
  Result<std::string> ask(const std::vector<std::string>& words) const;
  /// Runs a command and returns how it ended; a failing exit status is not an error.
  Result<cases::ProcessEnd> run(const std::vector<std::string>& words,
                                const std::function<bool()>& is_to_end) const;
  /// Returns the last output of the command that run() ran.
  std::string last_said() const;

  /// Returns the full hash of a named commit.
  Result<std::string> commit(const std::string& name) const;
  Result<records::CommitTitle> title(const std::string& commit) const;
  /// Returns true if a file such as "BISECT_LOG" exists in git's own folder.
  Result<bool> has_file(const std::string& name) const;
  /// Returns the tracked files of the work tree that differ from the commit.
  Result<std::string> changed_files() const;
  /// Returns the checked-out branch, or the commit if detached.
  Result<std::string> head() const;
  Result<void> check_out(const std::string& what) const;

 private:
  std::string folder_;
};

}  // namespace rastercheck::gate
