#pragma once

#include <string>

#include "cases/case.h"
#include "cases/error.h"

namespace rastercheck::cli {

/// Refuses a case of more than 2^26 samples, so that nobody waits for one by mistake, unless `all`
/// (the option --all) is set. `file` is where the case comes from.
Result<void> check_sample_count(const cases::Case& c, const std::string& file, bool all);

}  // namespace rastercheck::cli
