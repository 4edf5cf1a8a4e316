#include "cases/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "cases/internal/camera_frame.h"
#include "cases/json.h"

namespace rastercheck::cases {
namespace {

/// "0 'front'", as messages name a camera.
std::string shown(const Mesh& mesh, std::size_t index) {
  const std::string& name = mesh.cameras[index].name;
  return name.empty() ? fmt::format("{}", index) : fmt::format("{} '{}'", index, printable(name));
}

/// The index of the camera with that name, else of that index; empty if none.
std::optional<std::size_t> find_camera(const Mesh& mesh, const std::string& wanted) {
  for (std::size_t i = 0; i < mesh.cameras.size(); ++i) {
    if (mesh.cameras[i].name == wanted) return i;
  }
  for (std::size_t i = 0; i < mesh.cameras.size(); ++i) {
    if (std::to_string(i) == wanted) return i;
  }
  return std::nullopt;
}

std::string no_such_camera(const Mesh& mesh, const std::string& wanted) {
  if (mesh.cameras.empty()) return fmt::format("has no cameras, so no '{}'", printable(wanted));
  std::string all;
  for (std::size_t i = 0; i < mesh.cameras.size(); ++i) {
    all += fmt::format("{}{}", i == 0 ? "" : ", ", shown(mesh, i));
  }
  return fmt::format("has no camera '{}', but {}", printable(wanted), all);
}

/// A note that the picture shows more than the camera's own; "" if it does not.
std::string note_on_shape(const MeshCamera& camera, const MeshOptions& options) {
  const std::optional<double> wanted = aspect_ratio_of(camera);
  if (!wanted) return "";
  // The camera's picture as large as it fits into this one.
  const int width =
      static_cast<int>(std::lround(std::min<double>(options.width, options.height * *wanted)));
  const int height =
      static_cast<int>(std::lround(std::min<double>(options.height, options.width / *wanted)));
  if (width == options.width && height == options.height) return "";
  return fmt::format(
      "its camera's picture is {} times as wide as high, so that this one shows more {} "
      "(--width {} --height {} shows what the camera does)",
      *wanted, width == options.width ? "above and below" : "at the sides", std::max(width, 1),
      std::max(height, 1));
}

struct Viewed {
  Camera camera;
  std::vector<std::string> notes;
};

/// The camera with that index.
Result<Viewed> through(const Mesh& mesh, std::size_t index, const MeshOptions& options,
                       double width_over_height) {
  const MeshCamera& chosen = mesh.cameras[index];
  const Result<Camera> camera = place(chosen, options.rules, width_over_height);
  if (!camera) {
    return tl::unexpected(Error{
        "", "",
        fmt::format("camera {} cannot be used: {}", shown(mesh, index), camera.error().reason)});
  }
  Viewed viewed{*camera, {}};
  const std::string note = note_on_shape(chosen, options);
  if (!note.empty()) viewed.notes.push_back(note);
  return viewed;
}

/// The camera that the options ask for. Fails with a reason only.
Result<Viewed> look_at(const Mesh& mesh, const MeshOptions& options) {
  const double width_over_height = double(options.width) / double(options.height);
  if (options.camera && *options.camera != kNoCamera) {
    const std::optional<std::size_t> index = find_camera(mesh, *options.camera);
    if (!index) return tl::unexpected(Error{"", "", no_such_camera(mesh, *options.camera)});
    return through(mesh, *index, options, width_over_height);
  }
  std::vector<std::string> notes;
  if (!options.camera && options.view == View() && !mesh.cameras.empty()) {
    Result<Viewed> first = through(mesh, 0, options, width_over_height);
    if (first) {
      first->notes.insert(first->notes.begin(),
                          fmt::format("camera {} of {} (--camera NAME|INDEX, or none to see all)",
                                      shown(mesh, 0), mesh.cameras.size()));
      return first;
    }
    // A mesh need not be refused for a camera that nobody asked for.
    notes.push_back(first.error().reason + "; all of the mesh is shown instead");
  }
  return frame(mesh.positions, options.view, options.rules, width_over_height)
      .map([&notes](const Camera& camera) {
        return Viewed{camera, std::move(notes)};
      });
}

/// A case without vertices and triangles.
Case empty_case(const std::string& file, const MeshOptions& options, bool textured) {
  Case c;
  c.name = printable(std::filesystem::path(file).filename().string());
  c.rules = options.rules;
  c.fill_rule = default_fill_rule(c.rules);
  c.basis = default_basis(c.rules);
  c.framebuffer = {options.width, options.height, options.samples};
  c.viewport.width = static_cast<float>(options.width);
  c.viewport.height = static_cast<float>(options.height);
  c.attributes = {{textured ? "u" : "x", Interpolation::smooth, Location::sample},
                  {textured ? "v" : "y", Interpolation::smooth, Location::sample}};
  return c;
}

}  // namespace

Result<Imported> case_of_mesh(const Mesh& mesh, const std::string& file,
                              const MeshOptions& options) {
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
  Result<Viewed> viewed = look_at(mesh, options);
  if (!viewed) return refuse(viewed.error().reason);
  c.camera = viewed->camera;
  return Imported{std::move(c), std::move(viewed->notes)};
}

}  // namespace rastercheck::cases
