#include "gate/internal/git.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "cases/files.h"

namespace rastercheck::gate {
namespace {

std::vector<std::string> with_git(const std::vector<std::string>& words) {
  std::vector<std::string> command{"git"};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

}  // namespace

Git::Git(std::string folder) : folder_(std::move(folder)) {}

Result<cases::ProcessEnd> Git::run(const std::vector<std::string>& words,
                                   const std::function<bool()>& is_to_end) const {
  OutsideRun how;
  how.log = folder_ + "/git.log";
  how.is_to_end = is_to_end;
  return run_outside(with_git(words), how);
}

std::string Git::last_said() const {
  return telling_line(cases::read_text(folder_ + "/git.log").value_or(""));
}

Result<std::string> Git::ask(const std::vector<std::string>& words) const {
  OutsideRun how;
  how.log = folder_ + "/git-problem.log";
  how.output = folder_ + "/git-answer.txt";
  std::error_code ignored;
  std::filesystem::remove(how.log, ignored);
  const Result<cases::ProcessEnd> end = run_outside(with_git(words), how);
  if (!end) return tl::unexpected(end.error());
  if (end->signal != 0 || end->exit_code != 0) {
    const std::string said = telling_line(cases::read_text(how.log).value_or(""));
    return tl::unexpected(Error{"git " + words.front(), "", said.empty() ? to_string(*end) : said});
  }
  return cases::read_text(how.output).map([](std::string text) {
    text.erase(text.find_last_not_of('\n') + 1);
    return text;
  });
}

Result<std::string> Git::commit(const std::string& name) const {
  return ask({"rev-parse", "--verify", "--quiet", "--end-of-options", name + "^{commit}"})
      .map_error([&](const Error& error) {
        // Without --quiet, git's message is about a "single revision" that it needs.
        return error.file.empty() ? error : Error{name, "", "is not a commit of this repository"};
      });
}

Result<records::CommitTitle> Git::title(const std::string& commit) const {
  const Result<std::string> text =
      ask({"show", "--no-patch", "--date=short", "--format=%H%n%ad%n%an%n%s", commit});
  if (!text) return tl::unexpected(text.error());
  std::array<std::string, 4> lines;
  std::size_t begin = 0;
  for (std::string& line : lines) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    line = text->substr(begin, end - begin);
    begin = std::min(end + 1, text->size());
  }
  return records::CommitTitle{lines[0], lines[1], lines[2], lines[3]};
}

Result<bool> Git::has_file(const std::string& name) const {
  return ask({"rev-parse", "--git-path", name}).map([](const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
  });
}

Result<std::string> Git::changed_files() const {
  return ask({"status", "--porcelain", "--untracked-files=no"});
}

Result<std::string> Git::head() const {
  // Without the prefix refs/heads/, `git checkout` takes the name as a branch, even if a tag has
  // the same name.
  const std::string branches = "refs/heads/";
  const Result<std::string> branch = ask({"symbolic-ref", "--quiet", "HEAD"});
  if (branch && branch->starts_with(branches)) return branch->substr(branches.size());
  return commit("HEAD");
}

Result<void> Git::check_out(const std::string& what) const {
  return ask({"checkout", "--quiet", what, "--"}).map([](const std::string&) {});
}

}  // namespace rastercheck::gate
