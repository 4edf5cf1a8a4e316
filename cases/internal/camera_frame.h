#pragma once

// The cameras of meshes: those that frame them, and those of their own files.

#include <array>
#include <optional>
#include <span>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/mesh_camera.h"

namespace rastercheck::cases {

/// Returns the perspective camera of a view; clip space follows `rules`. `points` are the mesh's
/// vertices, at least one, all finite. Without an eye, every point lies inside the clip volume, and
/// some are as near to a side of it as kFreeSide says, unless the target or the depth of the mesh
/// keep the camera farther away. The near and the far plane enclose the points; the near plane is
/// at least 1/4096 of the way to the far plane from the eye. Fails, with a reason only, if the view
/// has no direction or no up, if everything lies behind the eye, or if no float32 matrix can hold
/// the camera.
Result<Camera> frame(std::span<const std::array<float, 3>> points, const View& view, Rules rules,
                     double width_over_height);

/// The part of the picture's width and height that frame() leaves free at each side.
inline constexpr double kFreeSide = 0x1p-8;

/// Returns a file's camera. The picture shows all of the camera's field of view, neither cropped
/// nor stretched (glTF 2.0, section 3.10.3): if the picture has another aspect ratio, it shows more
/// at two sides. The node's scale is ignored (section 3.10.2). Fails, with a reason only, if the
/// camera's numbers make no sense.
Result<Camera> place(const MeshCamera& camera, Rules rules, double width_over_height);

/// The aspect ratio that a file's camera asks for; empty if it leaves that to the picture.
std::optional<double> aspect_ratio_of(const MeshCamera& camera);

}  // namespace rastercheck::cases
