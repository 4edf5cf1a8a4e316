#pragma once

#include <string_view>
#include <vector>

#include "cases/mesh_camera.h"

namespace rastercheck::cases {

/// Returns the cameras that the nodes of a glTF 2.0 file's scene have, text or binary, at most
/// kMaxMeshCameras: in the order of the file's cameras, and those of several nodes in the order of
/// the nodes. Any other content has none. Reads the file's own JSON, because assimp 5.2 loses what
/// is not in its cameras: a missing zfar, which means infinity, becomes 100, a camera's name its
/// node's, and a camera of several nodes one of one node.
std::vector<MeshCamera> gltf_cameras(std::string_view content);

}  // namespace rastercheck::cases
