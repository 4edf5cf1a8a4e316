#include "cli/environment.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>

#include "cases/json.h"
#include "records/run.h"

namespace rastercheck::cli {

namespace {

/// Names the widest vector instructions that the processor supports: libraries choose their code by
/// these.
std::string instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return "avx512";
  if (__builtin_cpu_supports("avx2")) return "avx2";
  return __builtin_cpu_supports("sse4.2") ? "sse4" : "sse2";
#elif defined(__aarch64__)
  return "neon";
#else
  return "";
#endif
}

}  // namespace

std::map<std::string, std::string> environment(int jobs, double seconds) {
  utsname machine{};
  ::uname(&machine);
  const std::time_t now = std::time(nullptr);
  return {{"version", RASTERCHECK_VERSION},
          {"compiler", RASTERCHECK_COMPILER},
          {"build", RASTERCHECK_BUILD_TYPE},
          {"architecture", machine.machine},
          {"instruction_set", instruction_set()},
          {"machine", fmt::format("{} {} {}", machine.sysname, machine.release, machine.machine)},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
          {"jobs", std::to_string(jobs)},
          {"seconds", fmt::format("{:.1f}", seconds)}};
}

std::map<std::string, std::string> environment_of(const records::Plan& plan,
                                                  const backends::BackendFactory& factory, int jobs,
                                                  double seconds) {
  std::map<std::string, std::string> all = environment(jobs, seconds);
  for (const std::string& specification : plan.backends) {
    const auto backend = factory.make(specification);
    if (!backend) continue;
    const std::string description = cases::one_line((*backend)->about().description);
    if (!description.empty()) all[records::drawn_by_key(specification)] = description;
  }
  return all;
}

}  // namespace rastercheck::cli
