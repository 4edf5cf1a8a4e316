#pragma once

#include "cases/contract.h"

namespace rastercheck::properties {

/// Bounds of pictures as a driver has them. It looks up its textures at coordinates that it does
/// not round to float32, as the backend `cpu` does.
inline cases::PictureBounds driver_bounds() {
  cases::PictureBounds bounds;
  bounds.float_error = 3;
  bounds.byte_store = 0.6F;
  bounds.byte_blend = 2;
  bounds.byte_mean = 1;
  bounds.texel_share = 0x1p-23F;
  bounds.texel_distance = 0x1p-8F;
  return bounds;
}

}  // namespace rastercheck::properties
