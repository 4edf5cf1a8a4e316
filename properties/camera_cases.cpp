#include "properties/camera_cases.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "properties/camera_matrices.h"
#include "properties/window_position.h"

namespace rastercheck::properties {
namespace {

using cases::Matrix4;
using Vector = std::array<double, 3>;

Matrix4 to_rows(const glm::mat4& m) {
  Matrix4 rows{};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      rows[static_cast<std::size_t>(row) * 4 + static_cast<std::size_t>(column)] = m[column][row];
    }
  }
  return rows;
}

// --- the view ------------------------------------------------------------------------------------

/// A rotation matrix from a quaternion of integers: nine integers over a common divisor.
struct Rotation {
  std::array<Vector, 3> rows{};
  double divisor = 1;
};

Rotation random_rotation(Draw& draw) {
  // Half of the rotations are arbitrary, roll included; the others are about x or y, or none at
  // all.
  const int axis = draw.between(0, 5);
  std::array<double, 4> q{};
  q[0] = draw.between(1, 8);
  for (int i = 1; i <= 3; ++i) {
    const int n = draw.between(-8, 8);
    q[static_cast<std::size_t>(i)] = axis >= 3 || axis == i ? n : 0;
  }
  const auto [a, b, c, d] = q;
  Rotation r;
  r.rows[0] = {a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)};
  r.rows[1] = {2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)};
  r.rows[2] = {2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d};
  r.divisor = a * a + b * b + c * c + d * d;
  return r;
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Returns the view matrix for an eye whose coordinates have few bits, so that the sums are exact
/// before the division.
Matrix4 exact_view(const Rotation& rotation, const Vector& eye) {
  Matrix4 matrix = cases::kIdentity;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      matrix[4 * i + k] = static_cast<float>(rotation.rows[i][k] / rotation.divisor);
    }
    matrix[4 * i + 3] = static_cast<float>(-dot(rotation.rows[i], eye) / rotation.divisor);
  }
  return matrix;
}

glm::vec3 to_glm(const Vector& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// The world-space position of the camera-space point `p`, computed in double.
Vector in_world(const Rotation& rotation, const Vector& eye, const Vector& p) {
  Vector world{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double turned =
        rotation.rows[0][k] * p[0] + rotation.rows[1][k] * p[1] + rotation.rows[2][k] * p[2];
    world[k] = eye[k] + turned / rotation.divisor;
  }
  return world;
}

/// Returns the same view as exact_view(), built by glm::lookAt as users would.
Matrix4 look_at(const Rotation& rotation, const Vector& eye) {
  const glm::vec3 target = to_glm(in_world(rotation, eye, {0, 0, -4}));
  const glm::vec3 up = to_glm(rotation.rows[1]);
  return to_rows(glm::lookAtRH(to_glm(eye), target, up));
}

// --- the projection ------------------------------------------------------------------------------

/// Field of view and depth planes. In perspective, a point at distance d is in view if |x| <= d /
/// cot_x and |y| <= d / cot_y.
struct Lens {
  float cot_x = 1;
  float cot_y = 1;
  float near = 1;
  float far = 10;
  bool is_by_glm = false;
};

Lens random_lens(Draw& draw) {
  Lens lens;
  // The cotangent of half the field of view: 1 at 90°, 2^-10 at 179.9°, 2^6 at 1.8°.
  const bool is_extreme = draw.one_in(4);
  const int exponent = is_extreme ? draw.between(-10, 6) : draw.between(-1, 1);
  lens.cot_y = draw.uniform(1, 2);
  for (int e = 0; e < exponent; ++e) lens.cot_y *= 2;
  for (int e = exponent; e < 0; ++e) lens.cot_y /= 2;
  lens.cot_x = lens.cot_y * draw.pick(std::array{1.0F, 0.75F, 0.5625F});
  lens.near = draw.pick(std::array{0.001F, 0.01F, 0.1F, 0.5F, 1.0F});
  const float ratio = draw.pick(std::array{2.0F, 10.0F, 1e3F, 1e5F, 1e7F});
  lens.far = lens.near * ratio;
  lens.is_by_glm = draw.one_in(2);
  return lens;
}

/// Returns a perspective between planes at distances `first` and `last`; `first` maps to the near
/// depth. With GLM, uses frustum() with the near plane's sides: glm::perspective would compute its
/// own tangent.
Matrix4 perspective(const Lens& lens, float near_z, float first, float last) {
  if (lens.is_by_glm && first < last) {
    const float x = first / lens.cot_x;
    const float y = first / lens.cot_y;
    return to_rows(near_z < 0 ? glm::frustumRH_NO(-x, x, -y, y, first, last)
                              : glm::frustumRH_ZO(-x, x, -y, y, first, last));
  }
  // z = a d + b, with z = near_z · first at d = first and z = last at d = last.
  const double a = (double{last} - double{near_z} * first) / (double{last} - double{first});
  const double b = double{last} * (1 - a);
  Matrix4 matrix{};
  matrix[0] = lens.cot_x;
  matrix[5] = lens.cot_y;
  matrix[10] = static_cast<float>(-a);
  matrix[11] = static_cast<float>(b);
  matrix[14] = -1;
  return matrix;
}

/// Returns a perspective with the far plane at infinity: z = d − (1 − near_z) near or, reversed, z
/// = near_z d + (1 − near_z) near.
Matrix4 infinite_perspective(Draw& draw, const Lens& lens, float near_z) {
  Matrix4 matrix = perspective(lens, near_z, lens.near, 2 * lens.near);
  const bool is_reversed = draw.one_in(2);
  matrix[10] = is_reversed ? -near_z : -1.0F;
  matrix[11] = is_reversed ? (1 - near_z) * lens.near : -(1 - near_z) * lens.near;
  return matrix;
}

Matrix4 orthographic(const Lens& lens, float near_z, float half_height) {
  const float x = half_height * lens.cot_y / lens.cot_x;
  return to_rows(near_z < 0
                     ? glm::orthoRH_NO(-x, x, -half_height, half_height, lens.near, lens.far)
                     : glm::orthoRH_ZO(-x, x, -half_height, half_height, lens.near, lens.far));
}

/// Makes the plane n·p = distance (in camera space) the near plane, where z = near_z w. The point
/// (0, 0, −far) gets the greatest depth, z = w.
void make_oblique(Matrix4& projection, float near_z, const std::array<float, 3>& n, float distance,
                  float far) {
  // z = near_z w + k (n·p − distance), and z = w at (0, 0, −far).
  const float at_far = -n[2] * far - distance;
  const float k = (1 - near_z) * far / at_far;
  projection[8] = k * n[0];
  projection[9] = k * n[1];
  projection[10] = near_z * projection[14] + k * n[2];
  projection[11] = -k * distance;
}

// --- the model -----------------------------------------------------------------------------------

/// Adds a cube with corners at ±1; each face is two triangles.
void add_box(Draw& draw, cases::Case& c) {
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (int i = 0; i < 8; ++i) {
    add_vertex(c, {(i & 1) != 0 ? 1.0F : -1.0F, (i & 2) != 0 ? 1.0F : -1.0F,
                   (i & 4) != 0 ? 1.0F : -1.0F, 1});
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  const bool has_both_diagonals = draw.one_in(2);
  for (const auto& face : kFaces) {
    const bool is_other = has_both_diagonals && draw.one_in(2);
    const std::uint32_t a = first + face[is_other ? 1 : 0];
    const std::uint32_t b = first + face[is_other ? 2 : 1];
    const std::uint32_t d = first + face[is_other ? 3 : 2];
    const std::uint32_t e = first + face[is_other ? 0 : 3];
    c.triangles.push_back({a, b, d});
    c.triangles.push_back({a, d, e});
  }
}

/// Adds random triangles within [−1, 1]³.
void add_shards(Draw& draw, cases::Case& c) {
  const int triangles = draw.between(2, 4 + draw.size() / 25);
  for (int i = 0; i < triangles; ++i) {
    std::array<cases::ClipVertex, 3> corners;
    for (cases::ClipVertex& p : corners) {
      const float x = draw.uniform(-1, 1);
      const float y = draw.uniform(-1, 1);
      const float z = draw.uniform(-1, 1);
      p = {x, y, z, 1};
    }
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
}

/// Adds a square with corners at x, y = ±1 in the plane z = 0.
void add_sheet(cases::Case& c) {
  const std::uint32_t first = add_vertex(c, {-1, -1, 0, 1});
  add_vertex(c, {1, -1, 0, 1});
  add_vertex(c, {1, 1, 0, 1});
  add_vertex(c, {-1, 1, 0, 1});
  c.triangles.push_back({first, first + 1, first + 2});
  c.triangles.push_back({first, first + 2, first + 3});
}

/// Adds a model and places it in view by the model matrix: turned, moved, and scaled to a size
/// between 1/4 and 2 times the view's half height.
void place_model(Draw& draw, CameraCase& made, const Rotation& rotation, const Vector& eye,
                 const Lens& lens) {
  cases::Case& c = made.source;
  switch (draw.between(0, 2)) {
    case 0:
      add_box(draw, c);
      break;
    case 1:
      add_shards(draw, c);
      break;
    default:
      add_sheet(c);
  }
  // Picks the model's distance, which is between the planes and more often close to the camera, and
  // then its offset to the sides.
  const double reach = double{draw.pick(std::array{1.5F, 4.0F, 32.0F, 1024.0F})};
  const double far_end =
      double{lens.far} < reach * double{lens.near} ? double{lens.far} : reach * double{lens.near};
  const double distance = double{lens.near} + double{draw.unit()} * (far_end - double{lens.near});
  // A perspective view widens with the distance. An orthographic view has the same width
  // everywhere: that of a perspective view at twice the near distance.
  const double depth_of_view =
      made.kind == CameraKind::orthographic ? 2 * double{lens.near} : distance;
  const double aside_x = double{draw.uniform(-0.5F, 0.5F)} * depth_of_view / double{lens.cot_x};
  const double aside_y = double{draw.uniform(-0.5F, 0.5F)} * depth_of_view / double{lens.cot_y};
  const Vector at = in_world(rotation, eye, {aside_x, aside_y, -distance});
  const double size =
      depth_of_view / double{lens.cot_y} * double{draw.pick(std::array{0.25F, 0.5F, 1.0F, 2.0F})};
  const Rotation turn = random_rotation(draw);
  Matrix4& model = c.camera->model;
  model = cases::kIdentity;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      model[4 * i + k] = static_cast<float>(turn.rows[i][k] * size / turn.divisor);
    }
    model[4 * i + 3] = static_cast<float>(at[i]);
  }
}

/// Adds triangles with corners a, b and e + m (e − a) + n (e − b), where e is the eye. Since
/// coordinates are sixteenths and m and n are small integers, e lies exactly in the triangle's
/// plane. In two of three triangles one coordinate then changes, by one float or by up to 1.
/// Positions are in world space; the model matrix moves them by −e, so that the view only turns.
void add_planes_through_eye(Draw& draw, CameraCase& made, const Rotation& rotation,
                            const Vector& eye) {
  cases::Case& c = made.source;
  cases::Camera& camera = *c.camera;
  camera.view = exact_view(rotation, {0, 0, 0});
  camera.model = translation(static_cast<float>(-eye[0]), static_cast<float>(-eye[1]),
                             static_cast<float>(-eye[2]));
  const int triangles = draw.between(3, 6 + draw.size() / 25);
  for (int i = 0; i < triangles; ++i) {
    const int m = draw.between(-2, 2);
    const int n = draw.between(-2, 2);
    std::array<std::array<float, 3>, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = eye[k] + draw.between(-64, 64) / 16.0;
      const double b = eye[k] + draw.between(-64, 64) / 16.0;
      p[0][k] = static_cast<float>(a);
      p[1][k] = static_cast<float>(b);
      p[2][k] = static_cast<float>(eye[k] + m * (eye[k] - a) + n * (eye[k] - b));
    }
    if (!draw.one_in(3)) {
      const int corner = draw.between(0, 2);
      const int axis = draw.between(0, 2);
      float& number = p[static_cast<std::size_t>(corner)][static_cast<std::size_t>(axis)];
      // Moves the coordinate by one float, or far enough that part of the triangle is visible.
      number =
          draw.one_in(2) ? stepped(number, draw.one_in(2) ? 1 : -1) : number + draw.uniform(-1, 1);
    }
    add_triangle(c, {p[0][0], p[0][1], p[0][2], 1}, {p[1][0], p[1][1], p[1][2], 1},
                 {p[2][0], p[2][1], p[2][2], 1});
  }
}

void set_projection(Draw& draw, CameraCase& made, const Lens& lens, float near_z) {
  Matrix4& projection = made.source.camera->projection;
  switch (made.kind) {
    case CameraKind::infinite_far:
      projection = infinite_perspective(draw, lens, near_z);
      return;
    case CameraKind::reversed_depth:
      projection = perspective(lens, near_z, lens.far, lens.near);
      return;
    case CameraKind::orthographic:
      projection = orthographic(lens, near_z, lens.near / lens.cot_y * 2);
      return;
    case CameraKind::oblique_near: {
      projection = perspective(lens, near_z, lens.near, lens.far);
      const float x = draw.uniform(-0.5F, 0.5F);
      const float y = draw.uniform(-0.5F, 0.5F);
      make_oblique(projection, near_z, {x, y, -1}, lens.near * 1.25F, lens.far);
      return;
    }
    default:
      projection = perspective(lens, near_z, lens.near, lens.far);
  }
}

}  // namespace

CameraCase camera_case(Draw& draw, const StateRequest& request) {
  CameraCase made;
  cases::Case& c = made.source;
  c = random_state(draw, request);
  c.camera.emplace();
  made.kind = draw.pick(std::array{CameraKind::perspective, CameraKind::perspective,
                                   CameraKind::infinite_far, CameraKind::reversed_depth,
                                   CameraKind::orthographic, CameraKind::oblique_near,
                                   CameraKind::eye_in_the_plane});
  const Lens lens = random_lens(draw);
  const Rotation rotation = random_rotation(draw);
  Vector eye{};
  for (double& coordinate : eye) coordinate = draw.between(-128, 128) / 16.0;
  set_projection(draw, made, lens, near_depth(c));
  if (made.kind == CameraKind::eye_in_the_plane) {
    add_planes_through_eye(draw, made, rotation, eye);
  } else {
    c.camera->view = draw.one_in(2) ? look_at(rotation, eye) : exact_view(rotation, eye);
    place_model(draw, made, rotation, eye, lens);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return made;
}

}  // namespace rastercheck::properties
