#include "properties/campaign/corpus.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cases/case_reader.h"
#include "cases/json.h"

namespace rastercheck::properties {
namespace {

/// Returns the case files of a folder, in the order of their names.
Result<std::vector<std::filesystem::path>> case_files(const std::string& directory) {
  std::error_code problem;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(directory, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  if (problem) {
    return tl::unexpected(Error{directory, "", "cannot be read: " + problem.message()});
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<std::vector<cases::Case>> read_corpus(const std::string& directory) {
  const auto files = case_files(directory);
  if (!files) return tl::unexpected(files.error());
  std::vector<cases::Case> corpus;
  for (const std::filesystem::path& file : *files) {
    Result<cases::Case> c = cases::read_case(file.string());
    if (!c) return tl::unexpected(c.error());
    if (c->name.empty()) c->name = cases::valid_utf8(file.stem().string());
    corpus.push_back(*std::move(c));
  }
  return corpus;
}

Result<std::vector<cases::Case>> corpus_of(const records::Plan& plan,
                                           const std::string& directory) {
  return read_corpus(directory).map([&plan](std::vector<cases::Case> corpus) {
    corpus.insert(corpus.end(), plan.hunted.begin(), plan.hunted.end());
    return corpus;
  });
}

SavedCases read_saved(const std::string& directory, const std::vector<std::string>& laws,
                      const std::vector<std::string>& backends) {
  SavedCases saved;
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored)) return saved;
  const auto files = case_files(directory);
  if (!files) {
    saved.unreadable.push_back(files.error());
    return saved;
  }
  const auto is_among = [](const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  for (const std::filesystem::path& file : *files) {
    Result<cases::Case> c = cases::read_case(file.string());
    if (!c) {
      saved.unreadable.push_back(c.error());
    } else if (c->found && is_among(laws, c->found->law) && is_among(backends, c->found->backend)) {
      saved.cases.push_back(*std::move(c));
    }
  }
  return saved;
}

}  // namespace rastercheck::properties
