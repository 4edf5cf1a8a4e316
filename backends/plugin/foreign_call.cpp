#include "backends/plugin/foreign_call.h"

#include <fmt/format.h>

#include <cstring>
#include <exception>
#include <string_view>

#include "backends/floating_point_modes.h"
#include "backends/plugin/plugin.h"
#include "cases/json.h"

namespace rastercheck::backends {

Result<void> ForeignCall::operator()(const std::function<std::uint32_t()>& call,
                                     const std::function<Result<void>()>& check) const {
  const FloatingPointModes modes;
  std::uint32_t status = RASTERCHECK_FAILED;
  try {
    status = call();
  } catch (const std::exception& problem) {
    return fail(
        fmt::format("{}() threw an exception: {}", function, cases::printable(problem.what())));
  } catch (...) {
    return fail(fmt::format("{}() threw an exception", function));
  }
  if (Result<void> checked = check(); !checked) return checked;
  if (modes.have_changed()) {
    return fail(fmt::format("{}() changed the rounding mode or the treatment of subnormal numbers",
                            function));
  }
  if (status == RASTERCHECK_OK) return {};
  const auto* const written = message->as<const char>();
  std::string text = cases::one_line(std::string_view(written, ::strnlen(written, kMessageSize)));
  if (text.empty()) text = "(no message)";
  if (status == RASTERCHECK_UNSUPPORTED) {
    return fail(fmt::format("{}() reported unsupported: {}", function, text), Failure::unsupported);
  }
  if (status == RASTERCHECK_FAILED) {
    return fail(fmt::format("{}() reported failed: {}", function, text));
  }
  return fail(
      fmt::format("{}() returned {}, which is not RASTERCHECK_OK, RASTERCHECK_UNSUPPORTED "
                  "or RASTERCHECK_FAILED; its message: {}",
                  function, status, text));
}

}  // namespace rastercheck::backends
