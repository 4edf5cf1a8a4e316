#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The weights E_i from which a triangle's values are evaluated, both in double with error bounds
// and without rounding.
//
//   ideal   the edge functions of the clip positions (edge_functions.h)
//   placed  the weights of grid points: E_i = L_i / w_i, where L_i is the line of whole numbers
//           opposite corner i (grid_line.h). They are 1/(w_0 w_1 w_2) times the edge functions of
//           the moved clip positions; Σ w_i E_i is scaled likewise, and is twice the area.
//
// Placed weights in double: 1/w_i has one rounding, a coefficient one or two more, a term one more,
// and the sums at most two: |δE_i| <= 6u S_i, below the band of 8u S_i. The weights without
// rounding are scaled by w_0 w_1 w_2: L_i w_j w_k.
//
// The determinant. Σ w_i c_i in double has an error of at most 4u Σ |w_i c_i|: one rounding of c_i,
// one of the product and two of sums. The double is used if this error is below 2^-33 of the
// determinant. The test uses 8u instead of 4u, to cover second-order terms and the bound's own
// rounding. Otherwise the sum without rounding is used.

#include <array>
#include <optional>
#include <span>

#include "rasterizer/internal/edge_functions.h"
#include "rasterizer/internal/grid_piece.h"
#include "rasterizer/internal/sample_frame.h"

namespace rastercheck::rasterizer {

/// The frame of placed weights: U = x, V = y in grid units, T = 1.
SampleFrame grid_frame(const DrawBounds& bounds, int unit_bits);

/// A determinant in double is used only if the sum of its terms' magnitudes is below this multiple
/// of it: 8u of that sum are then below 2^-33 of the determinant.
inline constexpr double kCertainDeterminant = 0x1p17;

/// The inputs of placed weights.
struct PlacedWeights {
  std::array<GridLine, 3> lines;
  std::array<double, 3> w{};
};

class Weights {
 public:
  EdgeFunctions edges;
  const SampleFrame* frame = nullptr;
  double det_t = 0;  ///< Σ w_i E_i, with a relative error of at most 2^-33

  void set_ideal(const std::array<glm::vec4, 3>& corners, const EdgeFunctions& of_corners,
                 const SampleFrame& of_draw);
  void set_placed(const GridPiece& piece, std::span<const GridCorner> corners,
                  const SampleFrame& of_grid);

  /// Returns the E_i at a window position, with errors below the edges' bands.
  std::array<double, 3> at(double u, double v) const;

  /// Returns the E_i without rounding, times a common positive factor.
  std::array<ExactSum, 3> exact_at(double u, double v) const;
  /// Returns Σ w_i E_i of the weights of exact_at(), with at most two roundings for ideal weights
  /// and four for placed ones.
  double exact_det_t() const;

  /// Widens the bands to 8u S_i >= 8u |E_i|, so that they also cover the roundings of values at
  /// samples with weights of both signs.
  void widen_bands();

 private:
  std::optional<PlacedWeights> placed_;
  std::array<glm::vec4, 3> corners_;  ///< for ideal weights
};

}  // namespace rastercheck::rasterizer
