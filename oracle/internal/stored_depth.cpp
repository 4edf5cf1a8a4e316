#include "oracle/internal/stored_depth.h"

#include <algorithm>
#include <cmath>

#include "oracle/internal/triangle_setup.h"

namespace rastercheck::oracle {

double steps_of(int bits) { return std::ldexp(1.0, bits) - 1; }

/// Two float32 differ by more than a rounding of the product, which has at most 24 bits before the
/// point.
std::optional<double> stored_number(float depth, int bits) {
  const double k = std::round(double{depth} * steps_of(bits));
  const bool is_one = k >= 0 && k <= steps_of(bits) && stored_float(k, bits) == depth;
  return is_one ? std::optional(k) : std::nullopt;
}

/// The quotient is rounded twice. That gives the nearest float32: k/(2^n − 1) has the binary digits
/// of k over and over, so unless it is 0 or 1, it is farther than 2^-53 from the middle between two
/// float32, of which the digits after the 24th are a 1 and zeros.
float stored_float(double k, int bits) { return static_cast<float>(k / steps_of(bits)); }

Fraction exact_reach(cases::DepthStore store) {
  switch (store) {
    case cases::DepthStore::nearest:
      return {Ring(1), Ring(2)};
    case cases::DepthStore::nearly_nearest:
      return {Ring(3), Ring(5)};
    case cases::DepthStore::either:
      break;
  }
  return {Ring(1), Ring(1)};
}

StoredRange stored_range(const Field& lo, const Field& hi, int bits, cases::DepthStore store) {
  const Field steps(steps_of(bits));
  const auto clamped = [&](const Field& depth) {
    return std::clamp(depth, Field(0), Field(1)) * steps;
  };
  if (store == cases::DepthStore::either) {
    return {static_cast<double>(floor_to_long(clamped(lo))),
            static_cast<double>(ceil_to_long(clamped(hi)))};
  }
  const Field reach = exact_reach(store).value();
  return {static_cast<double>(ceil_to_long(std::max(Field(0), Field(clamped(lo) - reach)))),
          static_cast<double>(floor_to_long(std::min(steps, Field(clamped(hi) + reach))))};
}

bool has_open_depths(const TriangleSetup& triangle) {
  const cases::Contract& contract = triangle.scene->contract();
  if (contract.is_unspecified() || triangle.value_map() == nullptr ||
      contract.depth_error != cases::DepthError::either_side) {
    return true;
  }
  if (!triangle.scene->has_depth_bias()) return false;
  const std::optional<DepthOffset>& offset = triangle.depth_offset();
  return !offset || !offset->is_single;
}

}  // namespace rastercheck::oracle
