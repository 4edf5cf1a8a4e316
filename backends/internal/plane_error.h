#pragma once

// Bounds the errors of values that an implementation evaluates by planes over a triangle in the
// window, if each operation is off by a share of its result. plane_error.cpp derives the bounds.

#include <array>
#include <cstddef>

namespace rastercheck::backends {

/// A triangle in window coordinates, with all w > 0.
struct WindowTriangle {
  std::array<double, 3> x{};  ///< pixels
  std::array<double, 3> y{};  ///< pixels
  std::array<double, 3> w{};
};

/// How values are assumed to be evaluated.
struct Evaluation {
  double operation = 0;  ///< δ, the relative error of one operation
  /// How far the point about which planes are evaluated may lie from the triangle's bounding box,
  /// along each axis, in pixels.
  std::array<double, 2> away{};
  double reach = 0;  ///< how far a vertex may have been moved, along each axis; pixels
  /// How far outside the triangle a value may be evaluated, along each axis; pixels.
  double beyond = 0;
};

/// Errors of values as shares of max|r_i|, where r_i are the values at the vertices. Infinite if
/// nothing is promised.
struct PlaneError {
  double affine = 0;  ///< for values linear in window space, including depth
  /// For values linear in clip space: where 1/w is 1/g times the greatest 1/w of the vertices, the
  /// bound is constant + per_horizon · g.
  double constant = 0;
  double per_horizon = 0;
};

PlaneError plane_error(const WindowTriangle& triangle, const Evaluation& evaluation);

/// How steep a plane of values is in the window, max(|r_x|, |r_y|) or sqrt(r_x² + r_y²) of its
/// derivatives by window x and y. Infinite if no bound is known.
struct SlopeError {
  double most = 0;   ///< upper bound on the root, for the triangle as it may have been moved
  double error = 0;  ///< of either, as computed from the moved triangle
};

/// `values` are those of the vertices, each of which an implementation has with an error of up to
/// `value_error`.
SlopeError slope_error(const WindowTriangle& triangle, const std::array<double, 3>& values,
                       double value_error, const Evaluation& evaluation);

/// Bounds how much the clip-space weights of a triangle's vertices differ between two places that
/// are `distance` pixels apart along each axis, summed over the vertices: Σ max |ω_i(p) − ω_i(q)|
/// for the weights ω_i. Infinite if no bound is known.
double weight_change(const WindowTriangle& triangle, double reach, double distance);

}  // namespace rastercheck::backends
