#pragma once

// What a baseline kept of a part of a drawing beside the part as it is drawn now, pixel by pixel.

#include <cstdint>
#include <optional>
#include <vector>

#include "records/closer_look.h"

namespace rastercheck::reports {

/// One value of one sample, then and now. Sizes are magnitudes in scale ULP, to be shown: their
/// relative error is below 2^-20.
struct CropCell {
  cases::SamplePlace place = {};
  std::optional<double> exact;  ///< the nearest double; nothing where it has no value
  std::optional<float> before;  ///< nothing: not drawn, or not kept; may be no number
  std::optional<float> after;   ///< nothing: not drawn; may be no number
  /// Against the exact value; nothing where there is none, or no number was drawn.
  std::optional<double> error_before;
  std::optional<double> error_after;
  /// From the one drawing to the other: 0 for the same bits only; infinite where it is drawn in one
  /// only, or either is no number. Nothing where it is drawn in neither, or nothing was kept.
  std::optional<double> change;
};

/// Of each pixel of the part that is looked at, by y and x, the sample whose value changed most, or
/// of equals that which is farther off now, or the first. The value is the one looked at, or depth.
std::vector<CropCell> crop_cells(const records::CloserLook& look);

}  // namespace rastercheck::reports
