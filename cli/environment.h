#pragma once

#include <map>
#include <string>

namespace rastercheck::cli {

/// The facts of a run that depend on machine and time (records::Run::environment): program and
/// build, machine, current time and duration.
std::map<std::string, std::string> environment(int jobs, double seconds);

}  // namespace rastercheck::cli
