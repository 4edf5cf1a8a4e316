#pragma once

// Cases with a camera, as in real programs: a model in front of, around or behind the camera.
// Matrices are computed in float32 by GLM, as users do, or from whole numbers with one final
// rounding.

#include "cases/case.h"
#include "properties/draw.h"
#include "properties/random_state.h"

namespace rastercheck::properties {

/// The kind of camera. In camera space the view direction is −z.
enum class CameraKind {
  perspective,       ///< fields of view from a degree to nearly 180, far/near from 2 to 10^7
  infinite_far,      ///< the far plane is at infinity; depth may be reversed
  reversed_depth,    ///< the near plane has the far plane's depth, and vice versa
  orthographic,      ///< w = 1
  oblique_near,      ///< the near plane is tilted
  eye_in_the_plane,  ///< the eye lies in the triangles' planes or near them
};

struct CameraCase {
  cases::Case source;  ///< valid, with a camera, without a name
  CameraKind kind = CameraKind::perspective;
};

/// Makes a case with a camera; every clip position fits float32.
CameraCase camera_case(Draw& draw, const StateRequest& request = {});

}  // namespace rastercheck::properties
