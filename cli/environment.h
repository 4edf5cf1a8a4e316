#pragma once

#include <map>
#include <string>

#include "backends/factory.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// The facts of a run that depend on machine and time (records::Run::environment): program and
/// build, machine, current time and duration.
std::map<std::string, std::string> environment(int jobs, double seconds);

/// environment(), plus facts about each backend of the plan, such as a driver's name and version
/// (records::drawn_by_key()).
std::map<std::string, std::string> environment_of(const records::Plan& plan,
                                                  const backends::BackendFactory& factory, int jobs,
                                                  double seconds);

}  // namespace rastercheck::cli
