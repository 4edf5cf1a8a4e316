#include "cli/environment.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>

namespace rastercheck::cli {

std::map<std::string, std::string> environment(int jobs, double seconds) {
  utsname machine{};
  ::uname(&machine);
  const std::time_t now = std::time(nullptr);
  return {{"version", RASTERCHECK_VERSION},
          {"compiler", RASTERCHECK_COMPILER},
          {"build", RASTERCHECK_BUILD_TYPE},
          {"machine", fmt::format("{} {} {}", machine.sysname, machine.release, machine.machine)},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
          {"jobs", std::to_string(jobs)},
          {"seconds", fmt::format("{:.1f}", seconds)}};
}

}  // namespace rastercheck::cli
