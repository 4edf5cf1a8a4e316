#pragma once

namespace rastercheck::backends {

/// Saves the floating-point modes that change results, and restores them on destruction.
class FloatingPointModes {
 public:
  FloatingPointModes();
  FloatingPointModes(const FloatingPointModes&) = delete;
  FloatingPointModes& operator=(const FloatingPointModes&) = delete;
  ~FloatingPointModes();

  /// True if the rounding mode or the treatment of subnormal numbers has changed since
  /// construction. Subnormal numbers are watched on x86 and arm64 only.
  bool have_changed() const;

 private:
  int rounding_;
  unsigned control_;  ///< MXCSR or FPCR; 0 on machines without them
};

}  // namespace rastercheck::backends
