#pragma once

// A user's repository, through the program git alone.

#include <string>
#include <vector>

#include "cases/error.h"
#include "gate/bisect.h"
#include "gate/internal/outside_command.h"

namespace rastercheck::gate {

/// git in the current folder. A command that fails is an error that says what git said.
class Git {
 public:
  /// `folder` is for what it says: answers, and a log of the rest.
  explicit Git(std::string folder);

  /// What a command says on standard output, without the end of its last line.
  Result<std::string> ask(const std::vector<std::string>& words) const;
  /// How a command ends; how it ends is no error.
  Result<cases::ProcessEnd> run(const std::vector<std::string>& words,
                                const std::function<bool()>& is_to_end) const;
  /// The last of what was said by a command that was run.
  std::string last_said() const;

  /// The full hash of what names a commit.
  Result<std::string> commit(const std::string& name) const;
  Result<records::CommitTitle> title(const std::string& commit) const;
  /// Whether a file is there that git keeps beside the repository, as "BISECT_LOG".
  Result<bool> has_file(const std::string& name) const;
  /// Files of the work tree that git tracks and that are not as they were committed.
  Result<std::string> changed_files() const;
  /// The branch that is checked out, or the commit where none is.
  Result<std::string> head() const;
  Result<void> check_out(const std::string& what) const;

 private:
  std::string folder_;
};

}  // namespace rastercheck::gate
