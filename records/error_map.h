#pragma once

#include <cstdint>
#include <vector>

namespace rastercheck::records {

/// What became of a pixel of a drawn scene, the worst of its samples and triangles.
enum class PixelState : std::uint8_t {
  empty,     ///< nothing drawn, nothing missing
  correct,   ///< drawn, and all of it within the contract
  violated,  ///< missing, extra, beyond the bound, or no number
};

/// The error of each pixel: the largest of its nearest fragments' attribute errors.
struct ErrorMap {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  /// [y · width + x], window y as the case's rules have it.
  std::vector<PixelState> states;
  /// [y · width + x]: the largest |error| against the exact triangle over all attributes, in scale
  /// ULP; 0 where nothing is drawn.
  std::vector<float> errors;
};

}  // namespace rastercheck::records
