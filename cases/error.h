#pragma once

#include <string>
#include <tl/expected.hpp>

namespace rastercheck {

/// The kind of a failure, for callers that treat some kinds differently.
enum class Failure {
  refused,      ///< any other failure; only the text says what went wrong
  unavailable,  ///< the requested thing cannot run here
  unsupported,  ///< a backend does not draw cases of this kind, and does not claim to
  crash,        ///< the process ended before it answered
  hang,         ///< the process did not answer in time
};

/// Why an input was refused. Errors are values throughout RasterCheck; no library prints, exits, or
/// throws across folders.
struct Error {
  /// The file as the user named it; "-" for standard input; empty if no file is involved.
  std::string file;
  /// Where in the file: a JSON pointer ("/vertices/0/position/2", "/" for the whole document) or
  /// "line:column" for syntax errors; empty if the error concerns the whole file.
  std::string place;
  /// Says what is wrong there, in one line of plain words.
  std::string reason;
  Failure failure = Failure::refused;
};

/// "file: place: reason" on one line, without empty parts.
std::string to_string(const Error& error);

template <typename T>
using Result = tl::expected<T, Error>;

}  // namespace rastercheck
