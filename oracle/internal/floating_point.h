#pragma once

#include <cfenv>

namespace rastercheck::oracle {

/// Switches this thread to IEEE 754 default arithmetic for the object's lifetime: round to nearest,
/// subnormals neither flushed nor read as zero. Restores the caller's environment, with its sticky
/// flags, on destruction.
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
