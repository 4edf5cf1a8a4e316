#include "cli/gallery/internal/scenes.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace rastercheck::gallery {
namespace {

constexpr double kNear = 0.25;
constexpr double kFar = 64;

/// Converts a matrix from GLM's column-major order.
cases::Matrix4 row_major(const glm::dmat4& matrix) {
  cases::Matrix4 rows{};
  std::size_t next = 0;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      rows[next++] = static_cast<float>(matrix[column][row]);
    }
  }
  return rows;
}

std::uint32_t add_corner(cases::Case& scene, const Corner& corner) {
  const auto index = static_cast<std::uint32_t>(scene.positions.size());
  scene.positions.push_back({static_cast<float>(corner.position.x),
                             static_cast<float>(corner.position.y),
                             static_cast<float>(corner.position.z), 1});
  for (const double value : corner.attributes) {
    scene.attribute_values.push_back(static_cast<float>(value));
  }
  return index;
}

Corner sheet_corner(const Sheet& sheet, double s, double t) {
  const glm::dvec2 uv = sheet.from + (sheet.to - sheet.from) * glm::dvec2(s, t);
  return {sheet.corner + s * sheet.along_u + t * sheet.along_v, {uv.x, uv.y}};
}

}  // namespace

cases::Case empty_scene(const Canvas& canvas, std::span<const std::string> attributes) {
  cases::Case scene;
  scene.rules = cases::Rules::vulkan;
  scene.fill_rule = cases::default_fill_rule(scene.rules);
  scene.framebuffer = {canvas.size, canvas.size, canvas.samples};
  scene.viewport.width = static_cast<float>(canvas.size);
  scene.viewport.height = static_cast<float>(canvas.size);
  for (const std::string& name : attributes) {
    scene.attributes.push_back({name, cases::Interpolation::smooth, cases::Location::sample});
  }
  return scene;
}

cases::Case empty_textured_scene(const Canvas& canvas) {
  return empty_scene(canvas, std::array<std::string, 2>{"u", "v"});
}

cases::Camera camera_of(const View& view) {
  const glm::dmat4 rolled =
      glm::rotate(glm::dmat4(1), glm::radians(view.roll), glm::dvec3(0, 0, 1));
  glm::dmat4 projection = glm::perspectiveRH_ZO(glm::radians(view.field_of_view), 1.0, kNear, kFar);
  projection[1][1] *= -1;  // Vulkan's y points down
  cases::Camera camera;
  camera.view = row_major(rolled * glm::lookAt(view.eye, glm::dvec3(0), glm::dvec3(0, 1, 0)));
  camera.projection = row_major(projection);
  return camera;
}

void add_quad(cases::Case& scene, const std::array<Corner, 4>& corners) {
  std::array<std::uint32_t, 4> at{};
  for (std::size_t i = 0; i < 4; ++i) at[i] = add_corner(scene, corners[i]);
  scene.triangles.push_back({at[0], at[1], at[2]});
  scene.triangles.push_back({at[0], at[2], at[3]});
}

void add_sheet(cases::Case& scene, const Sheet& sheet, int cells) {
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const double s = static_cast<double>(column) / cells;
      const double t = static_cast<double>(row) / cells;
      const double step = 1.0 / cells;
      add_quad(scene, {sheet_corner(sheet, s, t), sheet_corner(sheet, s + step, t),
                       sheet_corner(sheet, s + step, t + step), sheet_corner(sheet, s, t + step)});
    }
  }
}

cases::Case leaning_rectangle(const Canvas& canvas, double field_of_view, double roll) {
  cases::Case scene = empty_textured_scene(canvas);
  scene.name = "a checkerboard in perspective";
  // In the paper's figure two corners are on the left, in rows well apart.
  constexpr double kOwnRoll = 130;
  scene.camera = camera_of({{0, 0, 2.25}, field_of_view, kOwnRoll + roll});
  // The plane's axes, perpendicular to each other.
  const glm::dvec3 a = glm::dvec3(2, 1, -2) / 3.0;
  const glm::dvec3 b = glm::dvec3(1, 2, 2) / 3.0;
  add_sheet(scene, {-a - b, 2.0 * a, 2.0 * b});
  return scene;
}

std::vector<double> corner_rows(const cases::Case& clip) {
  std::vector<double> rows;
  for (const cases::ClipVertex& p : clip.positions) {
    const double height = clip.viewport.height;
    rows.push_back(double{clip.viewport.y} + (double{p.y} / double{p.w} + 1) * height / 2);
  }
  return rows;
}

cases::Case cube(const Canvas& canvas, int cells) {
  cases::Case scene = empty_textured_scene(canvas);
  scene.name = "a textured cube";
  scene.camera = camera_of({{1.85, 1.55, 2.15}, 46, 0});
  scene.cull = cases::Cull::back;
  // For each face: the outward normal, and two edges a, b such that a × b points outwards.
  for (const int axis : {0, 1, 2}) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 normal(0);
      glm::dvec3 a(0);
      glm::dvec3 b(0);
      normal[axis] = side;
      a[(axis + 1) % 3] = side;
      b[(axis + 2) % 3] = 1;
      add_sheet(scene, {normal * 0.7 - 0.7 * a - 0.7 * b, 1.4 * a, 1.4 * b}, cells);
    }
  }
  return scene;
}

}  // namespace rastercheck::gallery
