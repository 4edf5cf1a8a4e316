#pragma once

namespace rastercheck::records {

/// The float32 numbers from `least` to `greatest`, inclusive; the ends may be infinite. Empty if
/// `least` is greater than `greatest`.
struct FloatRange {
  float least = 0;
  float greatest = 0;
  bool operator==(const FloatRange&) const = default;
};

}  // namespace rastercheck::records
