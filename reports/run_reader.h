#pragma once

#include <string>
#include <string_view>

#include "cases/error.h"
#include "records/run.h"

namespace rastercheck::reports {

/// The run that a run.json (reports/formats/run_json.cpp) holds; writing it again gives the same
/// bytes. Unknown and missing keys, other versions and whatever its members cannot hold exactly are
/// refused. `file` names the source in errors.
Result<records::Run> parse_run(std::string_view text, const std::string& file);

/// The same from a file, or from standard input for "-".
Result<records::Run> read_run(const std::string& file);

}  // namespace rastercheck::reports
