#pragma once

// Compares, pixel by pixel, the crop that a baseline kept with the same part as it is drawn now.

#include <cstdint>
#include <optional>
#include <vector>

#include "records/closer_look.h"

namespace rastercheck::reports {

/// One value of one sample, before and now. Sizes are magnitudes in scale ULP, for display only,
/// with a relative error below 2^-20.
struct CropCell {
  cases::SamplePlace place = {};
  std::optional<double> exact;  ///< the nearest double; empty if there is no exact value
  std::optional<float> before;  ///< empty if not drawn or not kept; may be NaN
  std::optional<float> after;   ///< empty if not drawn; may be NaN
  /// Errors against the exact value. Empty if there is no exact value, or if NaN or nothing was
  /// drawn.
  std::optional<double> error_before;
  std::optional<double> error_after;
  /// The difference between the two drawings: 0 only if the bits are the same, infinite if only one
  /// has the sample or either value is NaN. Empty if neither has the sample, or if nothing was
  /// kept.
  std::optional<double> change;
};

/// For each pixel of the inspected part, by y and x, the sample whose value changed most. Among
/// equal changes, the sample with the larger error now is chosen, or else the first. The value is
/// the inspected value, or depth.
std::vector<CropCell> crop_cells(const records::CloserLook& look);

}  // namespace rastercheck::reports
