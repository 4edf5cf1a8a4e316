#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/importer.h"
#include "cases/mesh_camera.h"

namespace rastercheck::cases {

struct MeshOptions {
  int width = 512;   ///< framebuffer and viewport, in pixels, 1…kMaxSize
  int height = 512;  ///< likewise
  Rules rules = Rules::vulkan;
  int samples = 1;  ///< per pixel
  View view = {};   ///< if any member is given, no camera of the file is used
  /// The file's camera to use: its name, its index in Mesh::cameras, or kNoCamera. Empty: the first
  /// one, if the file has any and `view` says nothing.
  std::optional<std::string> camera = {};
};

/// Asks for a view of the whole mesh, whatever cameras its file has.
inline constexpr const char* kNoCamera = "none";

/// A mesh as read from its file: polygons cut into triangles, node transforms applied, triangles in
/// order, vertices with identical bits joined. All numbers are finite.
struct Mesh {
  /// True if every vertex has texture coordinates.
  bool is_textured = false;
  std::vector<std::array<float, 3>> positions;  ///< x, y, z in object space
  std::vector<std::array<float, 2>> texture;    ///< u, v of each vertex; empty if not textured
  std::vector<Triangle> triangles;              ///< indices below the number of vertices
  std::vector<MeshCamera> cameras = {};         ///< of the file, at most kMaxMeshCameras
  bool operator==(const Mesh&) const = default;
};

/// Makes a case that draws a mesh with two smooth attributes: the texture coordinates "u" and "v"
/// if the mesh has any, else object-space "x" and "y". The case has the camera that `options` ask
/// for; by default the file's first, else one that frames the mesh from above the side. A note says
/// which camera of the file was chosen unasked, and how a file's camera was fitted to the picture.
/// `file` names the case, and the source in errors. Fails if the mesh has no triangle, if it has no
/// such camera, or if the view makes no sense or does not fit float32.
Result<Imported> case_of_mesh(const Mesh& mesh, const std::string& file,
                              const MeshOptions& options);

}  // namespace rastercheck::cases
