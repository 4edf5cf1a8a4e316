#pragma once

// Reads picture files in a separate process (reader_process.h). The answer is one line of JSON
// followed by the picture's numbers (PictureFile::values, float32):
//
//   {"width": 4, "height": 2, "channels": ["R", "G"], "stored": ["float32", "float32"]}
//
// or one line alone, {"error": {"file": "…", "place": "…", "reason": "…"}}.

#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "cases/picture_reader.h"
#include "cases/reader_process.h"

namespace rastercheck::cases {

/// Returns the picture that `command` (program and arguments) reads; the command must call
/// serve_picture(). `file` is the name used in errors.
Result<PictureFile> picture_of_process(const std::vector<std::string>& command,
                                       const std::string& file, const ProcessLimits& limits);

/// The child's side: limits this process, reads the picture and writes it, or the error.
Result<void> serve_picture(const std::string& file, ArrayOrder order, const ProcessLimits& limits);

/// Formats the child's answer.
std::string picture_to_reply(const Result<PictureFile>& picture);

/// Parses an answer: returns its picture or its error. An invalid answer is an error of `file`.
Result<PictureFile> picture_from_reply(std::string_view reply, const std::string& file);

}  // namespace rastercheck::cases
