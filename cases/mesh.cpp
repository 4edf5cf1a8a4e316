#include "cases/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "cases/internal/camera_frame.h"
#include "cases/json.h"

namespace rastercheck::cases {
namespace {

Bounds bounds_of(const std::vector<ClipVertex>& positions) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const ClipVertex& p : positions) {
    const std::array<double, 3> xyz{p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = std::min(bounds.lo[axis], xyz[axis]);
      bounds.hi[axis] = std::max(bounds.hi[axis], xyz[axis]);
    }
  }
  return bounds;
}

bool is_finite_camera(const Camera& camera) {
  const auto finite = [](float value) { return std::isfinite(value); };
  return std::all_of(camera.view.begin(), camera.view.end(), finite) &&
         std::all_of(camera.projection.begin(), camera.projection.end(), finite);
}

/// A case without vertices and triangles.
Case empty_case(const std::string& file, const MeshOptions& options, bool textured) {
  Case c;
  c.name = printable(std::filesystem::path(file).filename().string());
  c.rules = options.rules;
  c.fill_rule = default_fill_rule(c.rules);
  c.basis = default_basis(c.rules);
  c.framebuffer = {options.width, options.height, 1};
  c.viewport.width = static_cast<float>(options.width);
  c.viewport.height = static_cast<float>(options.height);
  c.attributes = {{textured ? "u" : "x", Interpolation::smooth, Location::sample},
                  {textured ? "v" : "y", Interpolation::smooth, Location::sample}};
  return c;
}

}  // namespace

Result<Case> case_of_mesh(const Mesh& mesh, const std::string& file, const MeshOptions& options) {
  const auto refuse = [&file](const std::string& reason) {
    return tl::unexpected(Error{file, "", reason});
  };
  if (mesh.triangles.empty()) return refuse("has no triangles");
  Case c = empty_case(file, options, mesh.is_textured);
  c.triangles = mesh.triangles;
  c.positions.reserve(mesh.positions.size());
  c.attribute_values.reserve(2 * mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto [x, y, z] = mesh.positions[i];
    const std::array<float, 2> attributes = mesh.is_textured ? mesh.texture[i] : std::array{x, y};
    c.positions.push_back({x, y, z, 1});
    c.attribute_values.insert(c.attribute_values.end(), attributes.begin(), attributes.end());
  }
  c.camera =
      frame(bounds_of(c.positions), c.rules, double{c.viewport.width} / double{c.viewport.height});
  if (!is_finite_camera(*c.camera)) return refuse("too large for a float32 camera to frame");
  return c;
}

}  // namespace rastercheck::cases
