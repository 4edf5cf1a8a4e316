#pragma once

#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// Returns the worst cases that a hunt or a run left in its output folder, for a hunt that begins
/// with them. Of a hunt these are the cases in `worst/`; of a run, the case of the largest error of
/// each kind and stratum on one of the plan's backends, or on any if the run had none of these.
/// Leaves out scenes, and cases that no longer exist. Fails if the folder is of neither, or if
/// there is no case.
Result<std::vector<cases::Case>> read_starts(const std::string& folder, const records::Plan& plan);

}  // namespace rastercheck::cli
