#pragma once

// Support for tests of drivers, which not every machine has. If a test's driver cannot run, the
// test is skipped, or fails if the environment requires the driver. RASTERCHECK_REQUIRE_BACKENDS is
// `all` or a comma-separated list of specifications without further options:
// `gl:llvmpipe,vulkan:lavapipe`.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "backends/backend.h"
#include "backends/isolation.h"
#include "cases/error.h"

namespace rastercheck::backends {

/// True if `list`, a value of RASTERCHECK_REQUIRE_BACKENDS, names the specification, whatever
/// options follow it.
inline bool is_required(std::string_view list, std::string_view specification) {
  if (list == "all") return true;
  while (!list.empty()) {
    const std::string_view name = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), name.size() + 1));
    if (name.empty() || !specification.starts_with(name)) continue;
    if (specification.size() == name.size() || specification[name.size()] == ',') return true;
  }
  return false;
}

/// Skips or fails the test whose SetUp() calls this function.
inline void skip_or_fail(const std::string& specification, const Error& why) {
  const char* const list = std::getenv("RASTERCHECK_REQUIRE_BACKENDS");
  const bool may_skip = why.failure == Failure::unavailable &&
                        !is_required(list != nullptr ? list : "", specification);
  if (!may_skip) FAIL() << to_string(why);
  GTEST_SKIP() << to_string(why);
}

/// A test with a backend that draws in a separate process, as in a campaign. The test's parameter
/// is the backend's specification. The program must have RASTERCHECK_PROGRAM defined.
class DriverTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    Isolation isolation;
    isolation.command = {RASTERCHECK_PROGRAM, "worker"};
    Result<std::unique_ptr<Backend>> made = make_isolated_backend(GetParam(), isolation);
    if (!made) return skip_or_fail(GetParam(), made.error());
    backend_ = *std::move(made);
  }

  Backend& backend() const { return *backend_; }

 private:
  std::unique_ptr<Backend> backend_;
};

/// "gl:llvmpipe" as part of a test's name: "gl_llvmpipe".
inline std::string test_name(const testing::TestParamInfo<const char*>& info) {
  std::string name = info.param;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

}  // namespace rastercheck::backends
