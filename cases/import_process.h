#pragma once

// Runs importers (importer.h) in a separate process, as meshes are read (mesh_process.h). The
// answer is one line of JSON and a case file:
//
//   {"notes": ["…"]}
//   {"format": "rastercheck-case", …}
//
// or one line alone, {"error": {"file": "…", "place": "…", "reason": "…"}}.

#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "cases/importer.h"
#include "cases/reader_process.h"

namespace rastercheck::cases {

/// Returns what `command` (program and arguments) imports; the command must call serve_import() and
/// takes the options, as text, after its other arguments. `file` is the name used in errors.
Result<Imported> import_of_process(const std::vector<std::string>& command, const std::string& file,
                                   const ProcessLimits& limits);

/// The child's side: limits this process, imports the file, or standard input for "-", and writes
/// the answer to the original standard output. The importer is the one with that name; for an empty
/// name, the one that recognises the file.
Result<void> serve_import(const std::string& file, const std::string& importer,
                          const ImportOptions& options, const ProcessLimits& limits);

/// Options as one line of JSON, for the command line of the process.
std::string to_json(const ImportOptions& options);
Result<ImportOptions> import_options_from_json(std::string_view text);

/// Formats and parses the answer. An invalid answer is an error of `file`.
std::string import_to_reply(const Result<Imported>& imported);
Result<Imported> import_from_reply(std::string_view reply, const std::string& file);

}  // namespace rastercheck::cases
