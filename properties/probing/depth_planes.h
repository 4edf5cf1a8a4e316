#pragma once

// Triangles with known planes of depth, drawn with a depth bias or into a unorm format, for the
// measures of both. All vertices lie at whole pixels, which belong to every subpixel grid.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/probing/measures.h"
#include "properties/probing/subject.h"
#include "properties/window_position.h"

namespace rastercheck::properties {

/// How far a backend's depths may be off for other reasons than the measured one: a float32 plane
/// about a point 256 pixels away loses 8 bits of 24. Measures tell apart depths that differ by
/// more.
inline constexpr double kPlaneError = 0x1p-16;

struct DepthTriangle {
  std::array<WindowPoint, 3> at;    ///< window positions, pixels
  std::array<double, 3> depth{};    ///< window depths: after the depth range, before any bias
  std::array<float, 3> w{1, 1, 1};  ///< powers of two
};

/// The state that a case of DepthTriangles asks for.
struct DepthState {
  cases::DepthBias bias = {};
  cases::DepthFormat format = cases::DepthFormat::float32;
  float min_depth = 0;
  float max_depth = 1;
  bool depth_clamp = false;
  std::optional<cases::Rules> rules = {};  ///< empty: the probe's own
};

/// Cells of a 64×64 case, for small triangles that do not overlap.
inline constexpr std::size_t kDepthCells = 64;
/// A right triangle that fills half of a cell of 8×8 pixels, with this depth at its right angle and
/// these derivatives by window x and y, per pixel.
DepthTriangle triangle_in_cell(std::size_t cell, double depth, double along_x, double along_y);

/// Exact if the depths are multiples of 2^-25 up to 1/2 and of 2^-24 beyond, and the depth range
/// divides by a power of two.
cases::Case case_of_planes(const Subject& subject, const std::vector<DepthTriangle>& triangles,
                           const DepthState& state);

/// Draws the case that case_of_planes() makes; empty as Subject::draw() is.
std::optional<cases::Fragments> draw_planes(Subject& subject,
                                            const std::vector<DepthTriangle>& triangles,
                                            const DepthState& state);

/// The triangle's depth, before any bias and limit, at a fragment's only sample.
double depth_of_plane(const DepthTriangle& triangle, const WindowPoint& at);
/// Where a fragment's only sample lies.
WindowPoint sample_of(const Subject& subject, const cases::Fragments& drawn, std::size_t fragment);

/// A fragment that two drawings of the same triangles have: without and with a bias.
struct BiasedFragment {
  std::size_t triangle = 0;
  WindowPoint at;
  double without = 0;
  double with = 0;
  double offset() const { return with - without; }
};
/// The fragments that both drawings have and whose depths are numbers.
std::vector<BiasedFragment> biased_fragments(const Subject& subject,
                                             const cases::Fragments& without,
                                             const cases::Fragments& with);

/// The exponent e of a depth z: 2^e <= |z| < 2^(e+1). z must not be 0.
int exponent_of(double z);

/// The findings of the measures of a bias so far.
struct BiasSight {
  /// Becomes the contract's term if any of it differs from what is declared.
  cases::BiasPromise found;
  bool differs = false;
  /// r in float32 divided by 2^(e−23), from planes of constant depth; empty if there is no such
  /// number.
  std::optional<double> float_ratio;
};

/// Measures r in all formats.
void measure_bias_unit(Subject& subject, const Sight& seen, BiasSight& sight);
/// Measures by which formula slopes count, and on which sides the clamp limits.
void measure_bias_slope(Subject& subject, BiasSight& sight);
/// Measures whose exponent r has in float32. Needs `float_ratio`.
void measure_bias_exponent(Subject& subject, BiasSight& sight);
/// Measures the limits of biased depths. Needs `float_ratio`.
void measure_bias_limits(Subject& subject, const BiasSight& sight);
/// Holds random biased depths against the contract measured so far, which `sight.found` is part of.
void check_biased_depths(Subject& subject, const BiasSight& sight);

}  // namespace rastercheck::properties
