#pragma once

// A case in exact numbers: the conventions of its rules, its viewport, its clip positions.

#include <array>
#include <cstddef>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "cases/sample_pattern.h"
#include "oracle/internal/number.h"
#include "oracle/internal/projective_map.h"
#include "oracle/pixel_box.h"

namespace rastercheck::oracle {

PixelBox intersection(const PixelBox& a, const PixelBox& b);

/// The position of a sample relative to the viewport rectangle. `far_border`: exactly on the side
/// of largest u or v, which half-open rectangles exclude.
enum class ViewportSide { inside, far_border, outside };

/// The conventions of an API (RULES §4).
struct Conventions {
  bool window_y_up;             ///< if false, down
  bool ndc_y_follows_window_y;  ///< Y = +y H/2 + …; if false (D3D), −y H/2 + …
  int near_z;                   ///< the near plane is z = near_z · w
  bool depth_is_halved;         ///< depth = n + (f−n)(z/w + 1)/2; else n + (f−n) z/w
  bool depth_always_clamped;
  std::size_t provoking_vertex;
  bool clip_distance_zero_inside;  ///< if false (not D3D), a zero is a tie
  bool far_border_permitted;       ///< if false, the far border is outside
  bool centroid_is_a_sample;       ///< as in D3D; if false, any point of the pixel
};

/// Exact clip positions of all vertices: projection · view · model · position, or the positions
/// themselves without a camera.
std::vector<RingVector4> clip_positions(const cases::Case& c);

/// Which edges own a sample on them (cases::TieRule), by the signs of the inward normal (A, B).
struct TieOrder {
  bool asks_a_first = true;
  int sign_a = 1;  ///< an edge owns its samples if A has this sign
  int sign_b = 1;
};

/// Everything that all triangles of a case share.
///
/// All window positions inside the oracle are in window units, of which a pixel has
/// units_per_pixel(). That is 1 unless a contract names a grid or a sample position whose fractions
/// of a pixel are not dyadic: the units are then so small that all positions are.
class Scene {
 public:
  /// The case and the contract must outlive the scene.
  Scene(const cases::Case& c, const cases::Contract& contract);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  const cases::Case& source() const { return *case_; }
  const cases::Contract& contract() const { return *contract_; }
  const Conventions& conventions() const { return conventions_; }

  /// (X, Y, w) of a vertex: window position times w, and w (RULES §1).
  RingVector3 window_column(std::size_t vertex) const;
  RingVector4 clip_position(std::size_t vertex) const;

  const Ring& units_per_pixel() const { return units_per_pixel_; }
  /// False if a pixel has several units. Positions in doubles, which are in pixels, may then not be
  /// mixed with window positions.
  bool is_in_pixels() const { return is_in_pixels_; }
  /// The spacing of the contract's subpixel grid, in window units; exact.
  double grid_unit() const { return grid_unit_; }

  /// The positions of the samples, in 1/16 window unit.
  std::span<const cases::SamplePosition> pattern() const { return pattern_; }
  /// The exact position of a sample, and of a pixel's centre or, if the contract has a sample
  /// position of its own, of the sample instead.
  Point sample_point(int x, int y, int sample) const;
  Point center_point(int x, int y) const;
  /// The middle of a pixel, wherever its samples are.
  Point pixel_middle(int x, int y) const;
  /// True if pixels have one sample at a position of the contract's own.
  bool has_own_sample() const {
    return contract_->sample_position.has_value() && case_->framebuffer.samples == 1;
  }
  /// True if a covered sample may lie outside what covers its pixel: under conservative coverage,
  /// and of Bresenham's lines.
  bool covers_outside() const {
    return contract_->conservative || (case_->primitive == cases::Primitive::lines &&
                                       case_->line_mode == cases::LineMode::bresenham);
  }
  /// Where an attribute is evaluated: at the sample, if the contract has a position of its own.
  cases::Location location_of(const cases::Attribute& attribute) const {
    return has_own_sample() ? cases::Location::sample : attribute.location;
  }

  ViewportSide viewport_side(const Point& p) const;
  /// True if a point, inside or outside the viewport, is within `distance` pixels of one of its
  /// sides.
  bool is_within(const Ring& distance, const Point& p) const;
  /// True if samples within `distance` pixels of a side may exist.
  bool has_samples_within(double distance) const;
  /// The pixels of the framebuffer inside the scissor.
  const PixelBox& target_pixels() const { return target_pixels_; }
  /// The pixels that can hold samples in or on the viewport, framebuffer and scissor.
  const PixelBox& pixels() const { return pixels_; }
  /// The part of pixels() whose samples all lie in the viewport.
  const PixelBox& inner_pixels() const { return inner_pixels_; }
  /// The viewport rectangle, sorted.
  const Point& viewport_lo() const { return viewport_lo_; }
  const Point& viewport_hi() const { return viewport_hi_; }
  /// The corners of the closed box in which the contract leaves vertices unclipped. Along each
  /// axis, the box is the viewport, extended to the guard band if viewport and guard band overlap
  /// there.
  const Point& guard_band_lo() const { return guard_band_lo_; }
  const Point& guard_band_hi() const { return guard_band_hi_; }

  /// True if a point exactly on a boundary is inside. The signs of the boundary's inward normal (A,
  /// B) decide; for the top-left rule, inside iff A > 0, or A = 0 and ±B > 0 (RULES §2, §13).
  /// Meaningless under an unspecified tie rule.
  bool owns_tie(int sign_a, int sign_b) const {
    if (contract_->tie_rule == cases::TieRule::all) return true;
    if (contract_->tie_rule == cases::TieRule::none) return false;
    const int by_a = ties_.sign_a * sign_a;
    const int by_b = ties_.sign_b * sign_b;
    const int first = ties_.asks_a_first ? by_a : by_b;
    const int second = ties_.asks_a_first ? by_b : by_a;
    return first > 0 || (first == 0 && second > 0);
  }
  /// True if a triangle of orientation ±1 is culled, by the case or by the contract.
  bool is_culled(int orientation) const;
  bool culls_anything() const {
    return case_->cull != cases::Cull::none || contract_->culls != cases::Winding::none;
  }

  /// A vertex's share in the depth: Σ E_i numerator_i / |det M| is the depth at a point, and
  /// numerator / w is the depth at the vertex itself.
  Ring depth_numerator(std::size_t vertex) const;
  /// Like above, for a clip position with the given z and w.
  Ring depth_numerator(const Ring& z, const Ring& w) const;
  const Ring& least_depth() const { return least_depth_; }
  const Ring& greatest_depth() const { return greatest_depth_; }
  bool clamps_depth() const;
  /// The ends that depths are clamped to, if clamps_depth(): the viewport's depth range, or 0
  /// and 1.
  const Ring& clamp_least() const { return clamp_least_; }
  const Ring& clamp_greatest() const { return clamp_greatest_; }
  bool has_depth_bias() const { return !case_->depth_bias.is_none(); }
  /// True if a depth is not simply that of the triangle's plane.
  bool stores_depths() const { return has_depth_bias() || unorm_bits() != 0; }
  /// The bits of the unorm format that depths are stored in; 0 for float32.
  int unorm_bits() const { return cases::unorm_bits(case_->depth_format); }

  /// True if the contract claims that the attribute, which must not be flat, is linear in window
  /// space.
  bool is_affine(std::size_t attribute) const;

 private:
  void set_units();
  void set_guard_band();

  const cases::Case* case_;
  const cases::Contract* contract_;
  Conventions conventions_;
  std::vector<RingVector4> transformed_;  ///< clip positions of a case with a camera
  /// Half of the viewport's signed size; y in the direction of window y.
  std::array<Ring, 2> half_size_;
  std::array<Ring, 2> middle_;  ///< the viewport's middle
  Ring units_per_pixel_{1};
  bool is_in_pixels_ = true;
  double grid_unit_ = 1;
  std::vector<cases::SamplePosition> pattern_;
  Point viewport_lo_;
  Point viewport_hi_;
  Point guard_band_lo_;
  Point guard_band_hi_;
  PixelBox target_pixels_;
  PixelBox pixels_;
  PixelBox inner_pixels_;
  TieOrder ties_;
  Ring min_depth_;
  Ring depth_range_;  ///< max_depth − min_depth
  Ring least_depth_;
  Ring greatest_depth_;
  Ring clamp_least_;
  Ring clamp_greatest_;
};

}  // namespace rastercheck::oracle
