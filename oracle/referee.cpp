#include "oracle/referee.h"

#include <Eigen/LU>
#include <algorithm>

#include "cases/sample_pattern.h"
#include "oracle/internal/camera_form.h"
#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle {

using FieldVector4 = Eigen::Matrix<Field, 4, 1>;

struct Referee::Plane {
  std::array<FieldVector4, 3> clip;
  FieldMatrix3 q;
  Field depth_offset = Field(0);  ///< what the depth bias adds to all depths

  Field e(Eigen::Index i, const Field& u, const Field& v) const {
    return q(i, 0) * u + q(i, 1) * v + q(i, 2);
  }
  /// Sums of the rows of Q weighted by s: the slopes and the value of Σ s_i e_i.
  Field slope_u(const std::array<Field, 3>& s) const {
    return s[0] * q(0, 0) + s[1] * q(1, 0) + s[2] * q(2, 0);
  }
  Field slope_v(const std::array<Field, 3>& s) const {
    return s[0] * q(0, 1) + s[1] * q(1, 1) + s[2] * q(2, 1);
  }
  Field sum(const std::array<Field, 3>& s, const Field& u, const Field& v) const {
    return s[0] * e(0, u, v) + s[1] * e(1, u, v) + s[2] * e(2, u, v);
  }
};

namespace {

using cases::Rules;
using FieldMatrix4 = Eigen::Matrix<Field, 4, 4>;

FieldMatrix4 field_matrix(const cases::Matrix4& rows) {
  FieldMatrix4 matrix;
  for (std::size_t i = 0; i < 16; ++i) {
    matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) =
        exact_field(rows[i]);
  }
  return matrix;
}

FieldVector4 clip_position(const cases::Case& c, std::uint32_t vertex) {
  const cases::ClipVertex& p = c.positions[vertex];
  FieldVector4 position(exact_field(p.x), exact_field(p.y), exact_field(p.z), exact_field(p.w));
  if (!c.camera) return position;
  position = (field_matrix(c.camera->model) * position).eval();
  position = (field_matrix(c.camera->view) * position).eval();
  return field_matrix(c.camera->projection) * position;
}

/// The image plane of a viewport: window = V (x, y, w)^T, so a, b, c are the columns of V^-1. Empty
/// for a viewport without area.
std::optional<ImagePlane> image_plane(const cases::Case& c) {
  const Field half_width = exact_field(c.viewport.width) / Field(2);
  const Field half_height = exact_field(c.viewport.height) / Field(2);
  const Field scale_y = c.rules == Rules::d3d ? -half_height : half_height;
  if (sign_of(half_width) == 0 || sign_of(half_height) == 0) return std::nullopt;
  const Field center_x = exact_field(c.viewport.x) + half_width;
  const Field center_y = exact_field(c.viewport.y) + half_height;
  return ImagePlane{.eye = {0, 0, 0},
                    .a = {Field(1) / half_width, 0, 0},
                    .b = {0, Field(1) / scale_y, 0},
                    .c = {-center_x / half_width, -center_y / scale_y, 1}};
}

/// Returns the sign of a functional after moving the point by (ε, ±ε²) with a vanishing ε > 0. This
/// sign is the tie rule's answer for a sample exactly on a boundary. It is 0 only if the functional
/// is 0 everywhere.
int perturbed_sign(const Field& value, const Field& slope_u, const Field& slope_v, bool v_up) {
  if (sign_of(value) != 0) return sign_of(value);
  if (sign_of(slope_u) != 0) return sign_of(slope_u);
  return v_up ? sign_of(slope_v) : -sign_of(slope_v);
}

bool is_drawn_facing(const cases::Case& c, int facing) {
  if (c.cull == cases::Cull::none) return true;
  const bool y_up = c.rules == Rules::opengl;
  const bool ccw = y_up ? facing > 0 : facing < 0;
  const bool front = c.front_face == cases::FrontFace::ccw ? ccw : !ccw;
  return c.cull == cases::Cull::back ? front : !front;
}

bool is_inside_viewport(const cases::Case& c, const Field& u, const Field& v) {
  const auto within = [](const Field& at, float from, float extent) {
    const Field first = exact_field(from);
    const Field second = first + exact_field(extent);
    return std::min(first, second) <= at && at < std::max(first, second);
  };
  return within(u, c.viewport.x, c.viewport.width) && within(v, c.viewport.y, c.viewport.height);
}

bool is_covered(const cases::Case& c, const cases::Triangle& indices, const Referee::Plane& plane,
                const Field& u, const Field& v) {
  // The top-left rule moves the sample right and, by far less, down; the bottom-left rule moves it
  // right and, by far less, up.
  const bool moved_up = c.fill_rule == cases::TieRule::bottom_left;
  const bool moves_towards_greater_v = moved_up == (c.rules == Rules::opengl);
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (perturbed_sign(plane.e(i, u, v), plane.q(i, 0), plane.q(i, 1), moves_towards_greater_v) <=
        0) {
      return false;
    }
  }
  const std::array<Field, 3> z{plane.clip[0][2], plane.clip[1][2], plane.clip[2][2]};
  if (!c.depth_clamp) {
    // Divided by w > 0, the depth planes bound z/w = Σ z_i e_i by constants, as Σ w_i e_i = 1.
    const Field z_over_w = plane.sum(z, u, v);
    const Field least = c.rules == Rules::opengl ? Field(-1) : Field(0);
    if (z_over_w < least || z_over_w > Field(1)) return false;
  }
  for (std::size_t d = 0; d < c.clip_distance_count; ++d) {
    std::array<Field, 3> distance;
    for (std::size_t i = 0; i < 3; ++i)
      distance[i] = exact_field(c.clip_distances_of(indices[i])[d]);
    const Field value = plane.sum(distance, u, v);
    const Field du = plane.slope_u(distance);
    const Field dv = plane.slope_v(distance);
    const bool everywhere_zero = sign_of(value) == 0 && sign_of(du) == 0 && sign_of(dv) == 0;
    if (c.rules == Rules::d3d || everywhere_zero) {
      if (sign_of(value) < 0) return false;
    } else if (perturbed_sign(value, du, dv, moves_towards_greater_v) <= 0) {
      return false;
    }
  }
  return true;
}

/// Interpolates r at (u, v) with k and l.
std::optional<Field> value_at(bool is_linear_in_window, const std::array<Field, 3>& r,
                              const Referee::Plane& plane, const Field& u, const Field& v) {
  const Field one_over_w = plane.sum({Field(1), Field(1), Field(1)}, u, v);
  if (sign_of(one_over_w) <= 0) return std::nullopt;
  if (is_linear_in_window) {
    // The weights e_i w_i sum to 1.
    return plane.sum({r[0] * plane.clip[0][3], r[1] * plane.clip[1][3], r[2] * plane.clip[2][3]}, u,
                     v);
  }
  const Field w = Field(1) / one_over_w;
  const Field k = plane.e(1, u, v) * w;
  const Field l = plane.e(2, u, v) * w;
  return r[0] + (r[1] - r[0]) * k + (r[2] - r[0]) * l;
}

Field window_depth(const cases::Case& c, const Field& z_over_w) {
  const Field n = exact_field(c.viewport.min_depth);
  const Field f = exact_field(c.viewport.max_depth);
  return n + (f - n) * (c.rules == Rules::opengl ? (z_over_w + Field(1)) / Field(2) : z_over_w);
}

/// The depth of the triangle's plane, neither biased nor clamped.
Field plane_depth(const cases::Case& c, const Referee::Plane& plane, const Field& u,
                  const Field& v) {
  return window_depth(c, plane.sum({plane.clip[0][2], plane.clip[1][2], plane.clip[2][2]}, u, v));
}

Field clamped_to_range(const cases::Case& c, const Field& depth) {
  const Field n = exact_field(c.viewport.min_depth);
  const Field f = exact_field(c.viewport.max_depth);
  return std::clamp(depth, std::min(n, f), std::max(n, f));
}

/// The greatest of |z_x| and |z_y|, in depths per pixel. Depths lie in a plane, so their
/// differences from pixel to pixel are the derivatives.
Field steepness(const cases::Case& c, const Referee::Plane& plane) {
  const Field here = plane_depth(c, plane, Field(0), Field(0));
  return std::max(magnitude(plane_depth(c, plane, Field(1), Field(0)) - here),
                  magnitude(plane_depth(c, plane, Field(0), Field(1)) - here));
}

/// The depth that a constant bias of 1 adds.
Field bias_unit(const cases::Case& c, const Referee::Plane& plane) {
  const int bits = cases::unorm_bits(c.depth_format);
  if (bits > 0 && c.rules == Rules::d3d) {
    return exact_field(nearest_float(Field(1) / (power_of_two(bits) - Field(1))));
  }
  if (bits > 0) return power_of_two(-bits);
  Field greatest(0);
  for (const FieldVector4& vertex : plane.clip) {
    // In front of the eye a vertex has a depth; behind it, it counts as far away.
    const bool has_depth = sign_of(vertex[3]) > 0;
    greatest = std::max(
        greatest, has_depth ? clamped_to_range(c, window_depth(c, vertex[2] / vertex[3]))
                            : exact_field(std::max(c.viewport.min_depth, c.viewport.max_depth)));
  }
  constexpr long kFractionBits = 23;  // of a float32
  if (sign_of(greatest) == 0) return Field(0);
  return power_of_two(floor_log2(greatest) - kFractionBits);
}

/// The offset that a depth bias adds to all depths of the triangle.
Field depth_offset(const cases::Case& c, const Referee::Plane& plane) {
  const cases::DepthBias& bias = c.depth_bias;
  if (bias.is_none()) return Field(0);
  Field sum = steepness(c, plane) * exact_field(bias.slope) +
              bias_unit(c, plane) * exact_field(bias.constant);
  if (bias.clamp > 0) return std::min(sum, exact_field(bias.clamp));
  if (bias.clamp < 0) return std::max(sum, exact_field(bias.clamp));
  return sum;
}

Field depth_at(const cases::Case& c, const Referee::Plane& plane, const Field& u, const Field& v) {
  const Field depth = plane_depth(c, plane, u, v) + plane.depth_offset;
  if (c.depth_clamp || c.rules == Rules::d3d) return clamped_to_range(c, depth);
  const bool is_plain = c.depth_bias.is_none() && c.depth_format == cases::DepthFormat::float32;
  return is_plain ? depth : std::clamp(depth, Field(0), Field(1));
}

/// The numbers of the case's format that are nearest to a depth in [0, 1].
std::vector<std::uint32_t> stored_as(const cases::Case& c, const Field& depth) {
  const int bits = cases::unorm_bits(c.depth_format);
  if (bits == 0) return {};
  const Field steps = depth * (power_of_two(bits) - Field(1));
  const auto below = static_cast<std::uint32_t>(floor_to_long(steps));
  const Field twice_above = Field(2) * (steps - floor_of(steps));
  if (twice_above < Field(1)) return {below};
  if (twice_above > Field(1)) return {below + 1};
  return {below, below + 1};
}

}  // namespace

Referee::Referee(const cases::Case& c, std::size_t triangle, cases::Claim claims)
    : case_(&c), triangle_(triangle), claims_(claims) {
  const cases::Triangle& indices = c.triangles[triangle];
  const std::optional<ImagePlane> image = image_plane(c);
  if (!image) return;
  auto plane = std::make_unique<Plane>();
  std::array<FieldVector3, 3> eye_space;
  for (std::size_t i = 0; i < 3; ++i) {
    plane->clip[i] = clip_position(c, indices[i]);
    eye_space[i] = {plane->clip[i][0], plane->clip[i][1], plane->clip[i][3]};
  }
  const std::optional<FieldMatrix3> q = q_matrix(eye_space, *image);
  if (!q) return;
  plane->q = *q;
  // Q = M_cam^-1 [a b c], so sign det Q = sign(det M_cam · det [a b c]), which is the facing.
  if (is_drawn_facing(c, sign_of(plane->q.determinant()))) {
    plane->depth_offset = depth_offset(c, *plane);
    plane_ = std::move(plane);
  }
}

Referee::~Referee() = default;

std::optional<RefereeFragment> Referee::at(int x, int y, int sample) const {
  if (!plane_) return std::nullopt;
  const cases::Case& c = *case_;
  const cases::Triangle& indices = c.triangles[triangle_];
  if (c.scissor && (x < c.scissor->x || x >= c.scissor->x + c.scissor->width || y < c.scissor->y ||
                    y >= c.scissor->y + c.scissor->height)) {
    return std::nullopt;
  }
  const auto at = cases::standard_pattern(c.framebuffer.samples)[static_cast<std::size_t>(sample)];
  const Field u = Field(x) + Field(at.x, 16);
  const Field v = Field(y) + Field(at.y, 16);
  if (!is_inside_viewport(c, u, v) || !is_covered(c, indices, *plane_, u, v)) return std::nullopt;

  const cases::SamplePlace place{static_cast<std::uint32_t>(triangle_),
                                 static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(x),
                                 static_cast<std::uint32_t>(sample)};
  const Field depth = depth_at(c, *plane_, u, v);
  RefereeFragment fragment{place, to_rational(depth), stored_as(c, depth), {}};
  for (std::size_t a = 0; a < c.attributes.size(); ++a) {
    const cases::Attribute& attribute = c.attributes[a];
    std::array<Field, 3> r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = exact_field(c.attributes_of(indices[i])[a]);
    const bool is_linear_in_window =
        attribute.interpolation == cases::Interpolation::noperspective ||
        claims_ == cases::Claim::affine;
    std::optional<Field> value;
    if (attribute.interpolation == cases::Interpolation::flat) {
      value = c.rules == Rules::opengl ? r[2] : r[0];
    } else if (attribute.location == cases::Location::sample) {
      value = value_at(is_linear_in_window, r, *plane_, u, v);
    } else if (attribute.location == cases::Location::center) {
      value =
          value_at(is_linear_in_window, r, *plane_, Field(x) + Field(1, 2), Field(y) + Field(1, 2));
    }
    fragment.attributes.push_back(value ? std::optional(to_rational(*value)) : std::nullopt);
  }
  return fragment;
}

std::optional<RefereeFragment> referee(const cases::Case& c, std::size_t triangle, int x, int y,
                                       int sample, cases::Claim claims) {
  return Referee(c, triangle, claims).at(x, y, sample);
}

}  // namespace rastercheck::oracle
