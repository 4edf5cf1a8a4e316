#pragma once

#include <string>

#include "cases/error.h"
#include "properties/campaign/plan_run.h"
#include "records/plan.h"
#include "records/run.h"

namespace rastercheck::cli {

/// Returns how this program carries out a plan: with its own processes for tasks and foreign
/// backends, and with the plan's folders. The run saves its findings so far in `directory`.
properties::Conduct conduct_of(const records::Plan& plan, const std::string& directory, int jobs);

/// Carries out a plan and inspects its results, as `rastercheck run` does. The plan must have no
/// scene; its patterns choose the laws. If ended early (see Run::cases_left), skips the inspection.
/// `directory` must exist.
Result<records::Run> run_plan(const records::Plan& plan, const std::string& directory, int jobs,
                              const properties::IsToEnd& is_to_end);

}  // namespace rastercheck::cli
