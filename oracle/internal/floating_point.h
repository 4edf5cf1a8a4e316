#pragma once

#include <cfenv>

namespace rastercheck::oracle {

/// As long as it lives, this thread computes as IEEE 754 has it by default: rounds to nearest, and
/// neither flushes subnormals nor takes them for zero. What the caller had comes back, its sticky
/// flags included.
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;
  ~DefaultFloatingPoint() { std::fesetenv(&callers_); }

 private:
  std::fenv_t callers_;
};

}  // namespace rastercheck::oracle
