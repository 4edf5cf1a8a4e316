#pragma once

// The weights E_i that the values of a triangle are evaluated from: in double, with how far that is
// off, and without rounding.
//
//   ideal   the edge functions of the clip positions (edge_functions.h)
//   placed  those of grid points: E_i = L_i / w_i, L_i the line of whole numbers opposite corner i
//           (grid_line.h). They are 1/(w_0 w_1 w_2) of what the edge functions of the moved clip
//           positions would be, and so is Σ w_i E_i, twice the area.
//
// Placed weights in double: 1/w_i has a rounding, a coefficient one or two more, a term one more
// and at most two of sums: |δE_i| <= 6u S_i, below the band of 8u S_i. Exactly they are taken times
// w_0 w_1 w_2: L_i w_j w_k.
//
// The determinant. Σ w_i c_i in double is off by at most 4u Σ |w_i c_i|: a rounding of c_i, of the
// product and two of sums. Where that is below 2^-33 of it (8u for 4u, for the second order and
// what is rounded of the bound), that is taken; else the sum without rounding.

#include <array>
#include <optional>
#include <span>

#include "rasterizer/internal/edge_functions.h"
#include "rasterizer/internal/grid_piece.h"
#include "rasterizer/internal/sample_frame.h"

namespace rastercheck::rasterizer {

/// The frame of placed weights: U = x, V = y in grid units, T = 1.
SampleFrame grid_frame(const DrawBounds& bounds, int unit_bits);

/// How many times a determinant in double the sum of its terms' sizes may be: 8u of them are then
/// below 2^-33 of it.
inline constexpr double kCertainDeterminant = 0x1p17;

/// What placed weights are made of.
struct PlacedWeights {
  std::array<GridLine, 3> lines;
  std::array<double, 3> w{};
};

class Weights {
 public:
  EdgeFunctions edges;
  const SampleFrame* frame = nullptr;
  double det_t = 0;  ///< Σ w_i E_i, to a relative 2^-33

  void set_ideal(const std::array<glm::vec4, 3>& corners, const EdgeFunctions& of_corners,
                 const SampleFrame& of_draw);
  void set_placed(const GridPiece& piece, std::span<const GridCorner> corners,
                  const SampleFrame& of_grid);

  /// E_i at a window position; off by less than the edges' bands.
  std::array<double, 3> at(double u, double v) const;

  /// A positive multiple of the E_i, the same for all three.
  std::array<ExactSum, 3> exact_at(double u, double v) const;
  /// Σ w_i E_i of these, rounded once or twice.
  double exact_det_t() const;

  /// Widens the bands to what the roundings of values take in as well: 8u S_i >= 8u |E_i|, for
  /// samples where weights of both signs may meet.
  void widen_bands();

 private:
  std::optional<PlacedWeights> placed_;
  std::array<glm::vec4, 3> corners_;  ///< of ideal ones
};

}  // namespace rastercheck::rasterizer
