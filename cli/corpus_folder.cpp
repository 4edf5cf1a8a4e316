#include "cli/corpus_folder.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "cli/own_program.h"

namespace rastercheck::cli {

namespace {

/// Returns the folder `installed_as`, relative to the installed program, or else the folder in the
/// sources.
std::string data_folder(const char* installed_as, const char* source) {
  std::error_code problem;
  const auto program = std::filesystem::read_symlink(kOwnProgram, problem);
  if (!problem) {
    const auto installed = program.parent_path().parent_path() / installed_as;
    if (std::filesystem::is_directory(installed, problem)) return installed.string();
  }
  return source;
}

}  // namespace

std::string corpus_folder() {
  return data_folder(RASTERCHECK_INSTALLED_CORPUS, RASTERCHECK_SOURCE_CORPUS);
}

std::string known_folder() {
  return data_folder(RASTERCHECK_INSTALLED_KNOWN, RASTERCHECK_SOURCE_KNOWN);
}

std::string accuracy_folder() {
  return data_folder(RASTERCHECK_INSTALLED_ACCURACY, RASTERCHECK_SOURCE_ACCURACY);
}

std::string corpus_folder_of(const records::Plan& plan) {
  return plan.corpus.empty() ? corpus_folder() : plan.corpus;
}

properties::KnownSources known_sources_of(const properties::KnownSources& given) {
  properties::KnownSources sources = given;
  const bool has_folder = std::any_of(given.begin(), given.end(), [](const std::string& source) {
    std::error_code ignored;
    return std::filesystem::is_directory(source, ignored);
  });
  if (!has_folder) sources.insert(sources.begin(), known_folder());
  return sources;
}

properties::KnownSources known_sources_of(const records::Plan& plan) {
  return plan.ignores_known ? properties::KnownSources() : known_sources_of(plan.known);
}

}  // namespace rastercheck::cli
