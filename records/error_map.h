#pragma once

#include <cstdint>
#include <vector>

namespace rastercheck::records {

/// The state of a pixel of a drawn scene: the worst over its samples and triangles.
enum class PixelState : std::uint8_t {
  empty,     ///< nothing drawn, nothing missing
  correct,   ///< drawn, and all of it within the contract
  violated,  ///< missing, extra, beyond the bound, or not a number
};

/// The error of each pixel: the largest of its nearest fragments' attribute errors.
struct ErrorMap {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  /// [y · width + x], window y in the direction of the case's rules.
  std::vector<PixelState> states;
  /// [y · width + x]: the largest |error| against the exact triangle over all attributes, in scale
  /// ULP; 0 where nothing is drawn.
  std::vector<float> errors;
};

}  // namespace rastercheck::records
