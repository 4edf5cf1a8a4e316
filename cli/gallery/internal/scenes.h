#pragma once

// The scenes of the figures: rectangles and cubes in front of a camera, as cases.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cli/gallery/figure.h"

namespace rastercheck::gallery {

/// A case without vertices: the canvas's framebuffer, Vulkan's rules, and smooth attributes of
/// these names.
cases::Case empty_scene(const Canvas& canvas, std::span<const std::string> attributes);

/// An empty_scene() with texture coordinates u and v.
cases::Case empty_textured_scene(const Canvas& canvas);

/// A camera at `eye` that looks at the origin, y up, then rolled; both angles in degrees.
struct View {
  glm::dvec3 eye{0, 0, 4};
  double field_of_view = 40;
  double roll = 0;
};
cases::Camera camera_of(const View& view);

/// A vertex in the camera's world.
struct Corner {
  glm::dvec3 position{};
  std::vector<double> attributes;
};

/// Adds a quad as the triangles (0, 1, 2) and (0, 2, 3).
void add_quad(cases::Case& scene, const std::array<Corner, 4>& corners);

/// A parallelogram: a corner, the edges from there, and the texture coordinates at this corner
/// (`from`) and at the opposite one (`to`).
struct Sheet {
  glm::dvec3 corner{};
  glm::dvec3 along_u{};
  glm::dvec3 along_v{};
  glm::dvec2 from{0, 0};
  glm::dvec2 to{1, 1};
};
/// Adds a parallelogram as `cells` · `cells` quads.
void add_sheet(cases::Case& scene, const Sheet& sheet, int cells = 1);

/// The rectangle of figures 2 and 3 of Heckbert & Moreton 1991: turned out of the picture's plane,
/// so that its four corners lie in different rows. With the wider field of view it stays in the
/// picture at any camera roll.
inline constexpr double kFieldOfView = 64;
inline constexpr double kWiderFieldOfView = 74;
cases::Case leaning_rectangle(const Canvas& canvas, double field_of_view = kFieldOfView,
                              double roll = 0);

/// Returns the window y of the rows in which corners lie, in pixels from the top.
std::vector<double> corner_rows(const cases::Case& clip);

/// A cube with three visible faces; each face is `cells` · `cells` squares of two triangles. The 2
/// · cells² triangles of a face are consecutive.
cases::Case cube(const Canvas& canvas, int cells);

}  // namespace rastercheck::gallery
