#pragma once

// How far values may be off that an implementation evaluates by planes over a triangle in the
// window, whose operations are each off by a share of their result. plane_error.cpp derives it.

#include <array>
#include <cstddef>

namespace rastercheck::backends {

/// A triangle as its window has it; all w > 0.
struct WindowTriangle {
  std::array<double, 3> x{};  ///< pixels
  std::array<double, 3> y{};  ///< pixels
  std::array<double, 3> w{};
};

/// Says how values are assumed to be evaluated.
struct Evaluation {
  double operation = 0;  ///< δ: how far the result of one may be off, as a share of it
  /// How far from the triangle's bounding box the point may lie, along each axis, that planes are
  /// evaluated about; pixels.
  std::array<double, 2> away{};
  double reach = 0;  ///< how far a vertex may have been moved, along each axis; pixels
  /// How far outside the triangle a value may be evaluated, along each axis; pixels.
  double beyond = 0;
};

/// Errors of values as shares of max|r_i|, r the vertices' values; infinite where nothing is
/// promised.
struct PlaneError {
  double affine = 0;  ///< of what is linear in window space, depths among it
  /// Bounds values that are linear in clip space: at a place where 1/w is 1/g of the vertices'
  /// greatest, constant + per_horizon · g.
  double constant = 0;
  double per_horizon = 0;
};

PlaneError plane_error(const WindowTriangle& triangle, const Evaluation& evaluation);

/// The most by which the weights of a triangle's vertices, those in clip space, differ between two
/// places that are `distance` pixels apart along each axis, each for itself: Σ max |λ_i(p) −
/// λ_i(q)|. Infinite where there is no telling.
double weight_change(const WindowTriangle& triangle, double reach, double distance);

}  // namespace rastercheck::backends
