#pragma once

#include <string>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::cli {

/// Refuses a case of more than 2^26 samples, so that nobody waits for them by mistake; `all`, the
/// option --all, allows it. `file` is where the case is from.
Result<void> check_sample_count(const cases::Case& c, const std::string& file, bool all);

}  // namespace rastercheck::cli
