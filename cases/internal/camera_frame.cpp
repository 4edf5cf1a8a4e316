#include "cases/internal/camera_frame.h"

// A mesh is fitted to the picture exactly, not by a sphere or a box around it. In view axes, with
// the eye at e and z pointing to the eye, a point p lies within the sides of slope s to the right
// and left if
//
//   p.x − e.x <= s (e.z − p.z)   and   e.x − p.x <= s (e.z − p.z),
//
// that is, if e.z >= (p.x / s + p.z) − e.x / s and e.z >= (−p.x / s + p.z) + e.x / s. Only the
// maxima of the terms in parentheses over all points matter, R and L. Both hold from
// e.z = (R + L) / 2 on, which e.x = s (R − L) / 2 reaches; height is treated alike.
//
// The axes are rounded to float32 first, and the eye's place along them next, so that rounding
// matrices moves nothing out of the picture: only the projection's two slopes are rounded
// afterwards, by 2^-24 of themselves, far less than kFreeSide.
//
// Without --fov only +, −, ×, ÷ and sqrt occur, which IEEE 754 rounds correctly, so the same mesh
// gives the same camera, bit for bit, on every machine.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "cases/internal/vectors.h"

namespace rastercheck::cases {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

tl::unexpected<Error> refuse_view(std::string reason) {
  return tl::unexpected(Error{"", "", std::move(reason)});
}

Vector3 rounded(const Vector3& a) {
  return {double{static_cast<float>(a[0])}, double{static_cast<float>(a[1])},
          double{static_cast<float>(a[2])}};
}

Matrix4 to_float(const std::array<double, 16>& values) {
  Matrix4 matrix{};
  std::transform(values.begin(), values.end(), matrix.begin(),
                 [](double value) { return static_cast<float>(value); });
  return matrix;
}

/// 0 − x in place of −x keeps zeros from becoming −0.
Matrix4 view_matrix(const ViewAxes& axes, const Vector3& eye_in_axes) {
  const auto& [right, up, back] = axes;
  return to_float({right[0], right[1], right[2], 0 - eye_in_axes[0],  //
                   up[0], up[1], up[2], 0 - eye_in_axes[1],           //
                   back[0], back[1], back[2], 0 - eye_in_axes[2],     //
                   0, 0, 0, 1});
}

/// Half the picture's width and height, as slopes of its sides or, if orthographic, in object
/// space.
struct HalfSize {
  double width = 0;
  double height = 0;
};

/// z/w is −1 (OpenGL) or 0 at the near plane, and 1 at the far plane.
double nearest_ndc(Rules rules) { return rules == Rules::opengl ? -1 : 0; }
/// Vulkan's NDC y points down.
double upward_ndc(Rules rules) { return rules == Rules::vulkan ? -1 : 1; }

/// w = −z_view. `far` may be infinite.
Matrix4 perspective(const HalfSize& slopes, double near, double far, Rules rules) {
  const double ratio = near / far;
  const double scale = (nearest_ndc(rules) * ratio - 1) / (1 - ratio);
  const double offset = (nearest_ndc(rules) - 1) * near / (1 - ratio);
  return to_float({1 / slopes.width, 0, 0, 0,                   //
                   0, upward_ndc(rules) / slopes.height, 0, 0,  //
                   0, 0, scale, offset,                         //
                   0, 0, -1, 0});
}

Matrix4 orthographic(const HalfSize& half, double near, double far, Rules rules) {
  const double scale = (nearest_ndc(rules) - 1) / (far - near);
  return to_float({1 / half.width, 0, 0, 0,                   //
                   0, upward_ndc(rules) / half.height, 0, 0,  //
                   0, 0, scale, nearest_ndc(rules) + scale * near, 0, 0, 0, 1});
}

/// The middle of a mesh, and a length that stands for its size.
struct Middle {
  Vector3 center{};
  double size = 0;
};

Middle middle_of(std::span<const std::array<float, 3>> points) {
  Vector3 lo{kInfinity, kInfinity, kInfinity};
  Vector3 hi{-kInfinity, -kInfinity, -kInfinity};
  for (const std::array<float, 3>& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], double{p[i]});
      hi[i] = std::max(hi[i], double{p[i]});
    }
  }
  Middle middle;
  double farthest = 0;
  Vector3 half{};
  for (std::size_t i = 0; i < 3; ++i) {
    middle.center[i] = (lo[i] + hi[i]) / 2;
    half[i] = (hi[i] - lo[i]) / 2;
    farthest = std::max({farthest, std::abs(lo[i]), std::abs(hi[i])});
  }
  // A single point has no size, and far from the origin float32 cannot place an eye near it.
  middle.size = std::max({std::sqrt(dot(half, half)), 0x1p-20 * farthest, 0x1p-64});
  return middle;
}

/// From the mesh to the eye if the user does not say where the eye is: 48° above the horizon, 27°
/// round to the right. Lower, or farther round, a level square fills less of the picture; higher,
/// or less far round, less of a cube's sides is seen.
Vector3 usual_back(const Vector3& up) {
  // To the right is the first of the axes that are farthest from `up`: x, if y or z is up.
  const auto size = [](double a, double b) { return std::abs(a) < std::abs(b); };
  Vector3 aside{};
  aside[static_cast<std::size_t>(std::min_element(up.begin(), up.end(), size) - up.begin())] = 1;
  const std::optional<ViewAxes> level = view_axes(cross(aside, up), up);
  if (!level) return {};
  return scaled_sum(level->up, 5, scaled_sum(level->back, 4, scaled_sum(level->right, 2, {})));
}

/// The view's axes, as float32.
Result<ViewAxes> axes_of(const View& view, const Vector3& target) {
  const Vector3 up = view.up.value_or(Vector3{0, 1, 0});
  if (up == Vector3{}) return refuse_view("0,0,0 is no direction (--up)");
  const Vector3 back = view.eye ? minus(*view.eye, target) : usual_back(up);
  if (back == Vector3{}) {
    return refuse_view(fmt::format("the eye lies at the target, {},{},{} (--eye, --target)",
                                   target[0], target[1], target[2]));
  }
  const std::optional<ViewAxes> axes = view_axes(back, up);
  if (!axes) {
    return refuse_view(fmt::format(
        "the view goes along {},{},{}, which is to point up (--up X,Y,Z names another direction)",
        up[0], up[1], up[2]));
  }
  return ViewAxes{rounded(axes->right), rounded(axes->up), rounded(axes->back)};
}

HalfSize slopes_of(const View& view, double width_over_height) {
  if (view.fov) {
    const double slope = std::tan(*view.fov * std::numbers::pi / 360);
    return {slope * width_over_height, slope};
  }
  const double slope = 2 - std::sqrt(3.0);  // tan(30° / 2)
  return {slope * std::max(width_over_height, 1.0), slope * std::max(1 / width_over_height, 1.0)};
}

/// The maxima over all points that the fit above asks for.
struct Reach {
  double right = -kInfinity;
  double left = -kInfinity;
  double top = -kInfinity;
  double bottom = -kInfinity;
  double nearest = -kInfinity;  ///< z of the point nearest to the eye
  double farthest = kInfinity;
};

Reach reach_of(std::span<const std::array<float, 3>> points, const ViewAxes& axes,
               const HalfSize& slopes) {
  Reach reach;
  for (const std::array<float, 3>& point : points) {
    const Vector3 p{point[0], point[1], point[2]};
    const double x = dot(axes.right, p) / slopes.width;
    const double y = dot(axes.up, p) / slopes.height;
    const double z = dot(axes.back, p);
    reach.right = std::max(reach.right, z + x);
    reach.left = std::max(reach.left, z - x);
    reach.top = std::max(reach.top, z + y);
    reach.bottom = std::max(reach.bottom, z - y);
    reach.nearest = std::max(reach.nearest, z);
    reach.farthest = std::min(reach.farthest, z);
  }
  return reach;
}

/// The eye in view axes, as float32, as close as all points and the target allow. `depth` is the
/// least distance along the view.
Vector3 fitted_eye(const Reach& reach, const HalfSize& slopes, const ViewAxes& axes,
                   const std::optional<Vector3>& target, double depth) {
  Vector3 eye{slopes.width * (reach.right - reach.left) / 2,
              slopes.height * (reach.top - reach.bottom) / 2, 0};
  if (target) eye = {dot(axes.right, *target), dot(axes.up, *target), 0};
  eye = rounded(eye);
  const double x = eye[0] / slopes.width;
  const double y = eye[1] / slopes.height;
  double z = std::max(
      {reach.right - x, reach.left + x, reach.top - y, reach.bottom + y, reach.nearest + depth});
  if (target) z = std::max(z, dot(axes.back, *target) + depth);
  auto away = static_cast<float>(z);
  if (double{away} < z) away = std::nextafter(away, std::numeric_limits<float>::infinity());
  eye[2] = away;
  return eye;
}

bool fits_float32(const Camera& camera) {
  const auto finite = [](float value) { return std::isfinite(value); };
  return std::all_of(camera.view.begin(), camera.view.end(), finite) &&
         std::all_of(camera.projection.begin(), camera.projection.end(), finite);
}

/// The reason why a file's camera makes no sense, or "".
std::string fault_of_camera(const MeshCamera& camera) {
  if (camera.is_orthographic) {
    if (!(camera.xmag > 0)) return fmt::format("its xmag, {}, is not above 0", camera.xmag);
    if (!(camera.ymag > 0)) return fmt::format("its ymag, {}, is not above 0", camera.ymag);
    if (!(camera.znear >= 0)) return fmt::format("its znear, {}, is below 0", camera.znear);
    if (!camera.zfar) return "it has no zfar";
  } else {
    const bool is_angle = camera.yfov > 0 && camera.yfov < std::numbers::pi;
    if (!is_angle) {
      return fmt::format("its yfov, {} radians, is not between 0 and π", camera.yfov);
    }
    if (camera.aspect_ratio && !(*camera.aspect_ratio > 0)) {
      return fmt::format("its aspectRatio, {}, is not above 0", *camera.aspect_ratio);
    }
    if (!(camera.znear > 0)) return fmt::format("its znear, {}, is not above 0", camera.znear);
  }
  if (camera.zfar && !(*camera.zfar > camera.znear)) {
    return fmt::format("its zfar, {}, is not above its znear, {}", *camera.zfar, camera.znear);
  }
  return "";
}

}  // namespace

Result<Camera> frame(std::span<const std::array<float, 3>> points, const View& view, Rules rules,
                     double width_over_height) {
  const Middle middle = middle_of(points);
  const Vector3 target = view.target.value_or(middle.center);
  const Result<ViewAxes> axes = axes_of(view, target);
  if (!axes) return tl::unexpected(axes.error());

  const HalfSize slopes = slopes_of(view, width_over_height);
  // Fits into a picture that is narrower by kFreeSide on both sides.
  constexpr double kUsed = 1 - 2 * kFreeSide;
  const HalfSize used{kUsed * slopes.width, kUsed * slopes.height};
  const Reach reach = reach_of(points, *axes, used);
  // The near and far plane keep this distance from the mesh.
  const double free_depth = middle.size / 16;
  const Vector3 eye = view.eye ? rounded({dot(axes->right, *view.eye), dot(axes->up, *view.eye),
                                          dot(axes->back, *view.eye)})
                               : fitted_eye(reach, used, *axes, view.target, 2 * free_depth);

  const double far = eye[2] - reach.farthest + free_depth;
  if (far <= free_depth) return refuse_view("all of it lies behind the eye (--eye, --target)");
  const double near = std::max(eye[2] - reach.nearest - free_depth, far / 4096);
  // Rounding the two numbers of the projection's third row by 2^-24 of themselves is like moving a
  // point by 2^-23 far at most towards the near plane, or by far / near times as much towards the
  // far plane. Both planes are at most 34 free_depth apart. If far is above twice that, far / near
  // is below 2; else 2^-23 far² / near is at most 2^-23 · 68 · 4096 free_depth, less than
  // free_depth. So no point leaves the clip volume if 2^-22 far is below free_depth.
  if (!(far * 0x1p-22 < free_depth)) {
    return refuse_view("too large for a float32 camera to frame, or too far away from the eye");
  }
  const Camera camera{kIdentity, view_matrix(*axes, eye), perspective(slopes, near, far, rules)};
  if (!fits_float32(camera)) return refuse_view("too large for a float32 camera to frame");
  return camera;
}

Result<Camera> place(const MeshCamera& camera, Rules rules, double width_over_height) {
  if (const std::string fault = fault_of_camera(camera); !fault.empty()) return refuse_view(fault);
  const auto column = [&camera](std::size_t i) {
    return Vector3{camera.to_object[i], camera.to_object[4 + i], camera.to_object[8 + i]};
  };
  // The camera looks along its −z, with its +y up. Unit vectors of these directions have no scale.
  const std::optional<ViewAxes> axes = view_axes(column(2), column(1));
  if (!axes) return refuse_view("its node has no direction");
  const Vector3 eye = column(3);

  HalfSize half{camera.xmag, camera.ymag};
  if (!camera.is_orthographic) {
    half.height = std::tan(camera.yfov / 2);
    half.width = half.height * camera.aspect_ratio.value_or(width_over_height);
  }
  // Shows more at two sides rather than less, or something stretched.
  half = {std::max(half.width, half.height * width_over_height),
          std::max(half.height, half.width / width_over_height)};
  const double far = camera.zfar.value_or(kInfinity);
  const Camera placed{
      kIdentity,
      view_matrix(*axes, {dot(axes->right, eye), dot(axes->up, eye), dot(axes->back, eye)}),
      camera.is_orthographic ? orthographic(half, camera.znear, far, rules)
                             : perspective(half, camera.znear, far, rules)};
  if (!fits_float32(placed)) return refuse_view("it is too large for float32");
  return placed;
}

std::optional<double> aspect_ratio_of(const MeshCamera& camera) {
  return camera.is_orthographic ? camera.xmag / camera.ymag : camera.aspect_ratio;
}

}  // namespace rastercheck::cases
