#pragma once

namespace rastercheck::backends {

/// The floating-point modes that change results, as they are when it is made; put back when it goes
/// out of scope.
class FloatingPointModes {
 public:
  FloatingPointModes();
  FloatingPointModes(const FloatingPointModes&) = delete;
  FloatingPointModes& operator=(const FloatingPointModes&) = delete;
  ~FloatingPointModes();

  /// Whether the rounding mode or, on x86, FTZ or DAZ are others by now.
  bool have_changed() const;

 private:
  int rounding_;
  unsigned control_;  ///< MXCSR; 0 where there is none
};

}  // namespace rastercheck::backends
