#include "cli/corpus_folder.h"

#include <filesystem>
#include <system_error>

#include "cli/own_program.h"

namespace rastercheck::cli {

std::string corpus_folder() {
  std::error_code problem;
  const auto program = std::filesystem::read_symlink(kOwnProgram, problem);
  if (!problem) {
    const auto installed = program.parent_path().parent_path() / RASTERCHECK_INSTALLED_CORPUS;
    if (std::filesystem::is_directory(installed, problem)) return installed.string();
  }
  return RASTERCHECK_SOURCE_CORPUS;
}

}  // namespace rastercheck::cli
