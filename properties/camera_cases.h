#pragma once

// Cases with a camera like those of programs that draw: a model in front of it, within it or behind
// it, the matrices computed in float32 by GLM as users do, or from whole numbers, rounded at the
// end.

#include "cases/case.h"
#include "properties/draw.h"
#include "properties/random_state.h"

namespace rastercheck::properties {

/// What of a camera is drawn where. Numbers are as in camera space, in which it looks along −z.
enum class CameraKind {
  perspective,       ///< fields of view from a degree to nearly 180, far/near from 2 to 10^7
  infinite_far,      ///< z/w → 1 with the distance, or → 0 where depth is reversed
  reversed_depth,    ///< near at the depth of the far plane
  orthographic,      ///< w = 1
  oblique_near,      ///< the near plane is any plane in front of the camera
  eye_in_the_plane,  ///< a perspective whose eye lies in triangles' planes, or a float beside
};

struct CameraCase {
  cases::Case source;  ///< valid, with a camera, without a name
  CameraKind kind = CameraKind::perspective;
};

/// No clip position of it is beyond float32.
CameraCase camera_case(Draw& draw, const StateRequest& request = {});

}  // namespace rastercheck::properties
