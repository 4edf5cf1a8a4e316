#pragma once

#include <string>
#include <tl/expected.hpp>

namespace rastercheck {

/// The kind of a failure, for those who treat some differently.
enum class Failure {
  refused,      ///< any other: only the text says what
  unavailable,  ///< what was asked for cannot run here
  unsupported,  ///< a backend does not draw cases of this kind, and does not claim to
  crash,        ///< the process that was asked ended
  hang,         ///< it did not answer in time
};

/// Why an input was refused. Errors are values throughout RasterCheck; no library throws across a
/// folder, prints, or exits.
struct Error {
  /// The file as the user named it; "-" for standard input; empty where there is none.
  std::string file;
  /// Where in the file: a JSON pointer ("/vertices/0/position/2", "/" for the whole document) or
  /// "line:column" for syntax errors; empty where the whole file is meant.
  std::string place;
  /// What is wrong there, as one line in plain words.
  std::string reason;
  Failure failure = Failure::refused;
};

/// "file: place: reason" on one line, without the parts that are empty.
std::string to_string(const Error& error);

template <typename T>
using Result = tl::expected<T, Error>;

}  // namespace rastercheck
