#pragma once

#include <string>

#include "cases/error.h"
#include "properties/campaign/plan_run.h"
#include "records/plan.h"
#include "records/run.h"

namespace rastercheck::cli {

/// How this program carries a plan out: with processes of its own for tasks and foreign backends,
/// and the folders that the plan means; what is found on the way is kept in `directory`.
properties::Conduct conduct_of(const records::Plan& plan, const std::string& directory, int jobs);

/// Carries out a plan that has no scene, and whose laws are still to be chosen by its patterns, and
/// looks closely at what it gave, as `rastercheck run` does; not where it is ended early, which
/// Run::cases_left tells. `directory` has to be there.
Result<records::Run> run_plan(const records::Plan& plan, const std::string& directory, int jobs,
                              const properties::IsToEnd& is_to_end);

}  // namespace rastercheck::cli
