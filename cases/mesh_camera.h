#pragma once

// How a mesh is looked at: as the user says, or by a camera of the mesh's own file.

#include <array>
#include <optional>
#include <string>

namespace rastercheck::cases {

/// A perspective view of a mesh, in object space. Every number is finite and at most as large as
/// the largest float32. Empty members are chosen so that the whole mesh is in the picture, as large
/// as it can be; with an eye nothing is fitted.
struct View {
  std::optional<std::array<double, 3>> eye;     ///< else above the side of the target
  std::optional<std::array<double, 3>> target;  ///< in the middle of the picture
  std::optional<std::array<double, 3>> up;      ///< appears up; else +y
  /// Vertical field of view in degrees, within (0, 180); else 30° along the picture's shorter side.
  std::optional<double> fov;
  bool operator==(const View&) const = default;
};

/// A camera of a mesh's file, in glTF's terms (glTF 2.0, section 3.10, and the properties
/// camera.perspective and camera.orthographic). The numbers are the file's; they may make no sense.
struct MeshCamera {
  std::string name;  ///< the camera's, else its node's; may be empty
  bool is_orthographic = false;
  double yfov = 0;                     ///< perspective: vertical field of view in radians
  std::optional<double> aspect_ratio;  ///< perspective: width over height; empty: the picture's
  double xmag = 0;                     ///< orthographic: half the width, in object space
  double ymag = 0;                     ///< orthographic: half the height
  double znear = 0;
  std::optional<double> zfar;  ///< empty: infinitely far away (perspective only)
  /// The upper three rows of the matrix from camera to object space, row by row.
  std::array<double, 12> to_object{};
  bool operator==(const MeshCamera&) const = default;
};

/// The most cameras that are read of one file.
inline constexpr std::size_t kMaxMeshCameras = 32;

}  // namespace rastercheck::cases
