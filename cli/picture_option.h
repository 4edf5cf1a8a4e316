#pragma once

// Options of the commands that judge pictures or say what they may show.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/error.h"
#include "cases/picture_file.h"
#include "cases/picture_view.h"
#include "cli/exit_code.h"

namespace rastercheck::cli {

/// The options that describe a picture. Each overrides the case's key `picture`.
struct PictureFlags {
  std::vector<std::string> channels;  ///< NAME=WHAT
  std::vector<float> background;      ///< [channel]
  std::string storage;
  std::string rounding;
  std::string first_row;
  std::string resolve;
  std::string alpha;
  std::string blend;
};

void add_picture_flags(CLI::App& app, PictureFlags& flags);

/// Returns the command-line arguments that set these options.
std::vector<std::string> words_of(const PictureFlags& flags);

/// The layout of a case's pictures; fails if an option makes no sense.
Result<cases::PictureLayout> layout_of(const cases::Case& c, const PictureFlags& flags);

/// Reads a picture file, or standard input for "-", in a separate process, `rastercheck picture`.
Result<cases::PictureFile> picture_from_file(const std::string& file, bool is_chw);

/// Options that say what a picture is judged by.
struct PicturePromise {
  std::string contract;  ///< a contract file
  std::string backend;   ///< a backend whose promise counts
};

/// Returns the command-line arguments that set these options.
std::vector<std::string> words_of(const PicturePromise& promise);
/// Says for people who makes the promise: "what gl:llvmpipe promises".
std::string promise_text(const PicturePromise& promise);

void add_picture_promise(CLI::App& app, PicturePromise& promise);

/// The contract that a picture of a case is judged by: the case's own or the backend's. Terms that
/// the contract file sets replace theirs. If the file cannot be read or the backend cannot be made,
/// prints the error and returns the exit code.
tl::expected<cases::Contract, ExitCode> contract_by(const PicturePromise& promise,
                                                    const cases::Case& c);

}  // namespace rastercheck::cli
