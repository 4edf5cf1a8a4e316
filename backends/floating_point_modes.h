#pragma once

namespace rastercheck::backends {

/// Saves the floating-point modes that change results, and restores them on destruction.
class FloatingPointModes {
 public:
  FloatingPointModes();
  FloatingPointModes(const FloatingPointModes&) = delete;
  FloatingPointModes& operator=(const FloatingPointModes&) = delete;
  ~FloatingPointModes();

  /// True if the rounding mode or, on x86, FTZ or DAZ have changed since construction.
  bool have_changed() const;

 private:
  int rounding_;
  unsigned control_;  ///< MXCSR; 0 on machines without it
};

}  // namespace rastercheck::backends
