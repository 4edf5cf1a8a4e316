#pragma once

// Reads a file in a separate process, because the file may be malicious: a crash, a hang or
// excessive memory use over a broken file becomes an error of the file. This keeps a broken file
// from bringing the program down. It is no sandbox: the process has all rights of the user except
// to write files.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/child_process.h"
#include "cases/error.h"

namespace rastercheck::cases {

/// Half of the machine's memory and two minutes: enough to read any usable file.
ProcessLimits default_reader_limits();

/// Runs `command` (program and arguments), which must call serve_reply(), and returns its answer.
/// `file` is the name used in errors, and `what` the kind of file: "mesh".
Result<std::string> reply_of_reader(const std::vector<std::string>& command,
                                    const std::string& file, std::string_view what,
                                    const ProcessLimits& limits);

/// The child's side: limits this process, and writes the answer to the original standard output.
/// Anything printed while `answer` runs goes to standard error.
Result<void> serve_reply(const std::function<std::string()>& answer, const ProcessLimits& limits);

}  // namespace rastercheck::cases
