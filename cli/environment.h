#pragma once

#include <map>
#include <string>

namespace rastercheck::cli {

/// What of a run depends on machine and time (records::Run::environment): this program and its
/// build, the machine, the time now, and what the run took.
std::map<std::string, std::string> environment(int jobs, double seconds);

}  // namespace rastercheck::cli
